//! Same input, same bytes: whatever a verb writes and prints, in every run and on any number of cores. Standard error is exempt:
//! it tells how far the work is, and how long it took.

use std::collections::BTreeMap;
use std::io::Write as _;
use std::path::Path;
use std::process::{Command, Output};

use crate::verbs::common::{CART, Folder, PENDULUM, URDF, cart_log};

/// Where a run may compute.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Cores {
    All,
    /// This one alone, by its number.
    One(usize),
}

impl Cores {
    /// A program that is started there.
    fn command(self, program: &str) -> Command {
        match self {
            Self::All => Command::new(program),
            Self::One(number) => {
                let mut command = Command::new("taskset");
                command.args(["-c", &number.to_string(), program]);
                command
            }
        }
    }
}

/// The first core that this process may use, where programs can be kept on it and see no other.
fn one_core() -> Option<Cores> {
    let status = std::fs::read_to_string("/proc/self/status").ok()?;
    let mut lines = status.lines();
    let allowed = lines.find_map(|line| line.strip_prefix("Cpus_allowed_list:"))?;
    let first = allowed.trim().split(['-', ',']).next()?;
    let one = Cores::One(first.parse().ok()?);
    let seen = one.command("nproc").output().ok()?;
    (seen.stdout == b"1\n").then_some(one)
}

/// What two runs, and one on one core, are told from each other by.
#[derive(PartialEq, Eq)]
struct Left {
    /// What each command printed.
    printed: Vec<Vec<u8>>,
    /// Files by their paths in the folder, of its folders too.
    files: BTreeMap<String, Vec<u8>>,
}

/// Files below a folder.
fn collect(folder: &Path, below: &str, files: &mut BTreeMap<String, Vec<u8>>) {
    for entry in std::fs::read_dir(folder).expect("a folder") {
        let entry = entry.expect("an entry");
        let name = format!("{below}{}", entry.file_name().to_string_lossy());
        if entry.path().is_dir() {
            collect(&entry.path(), &format!("{name}/"), files);
        } else {
            files.insert(name, std::fs::read(entry.path()).expect("a file"));
        }
    }
}

/// Runs commands one after the other in a folder of their own; all of them succeed.
fn run(cores: Cores, inputs: &[(&str, &str)], commands: &[&[&str]]) -> Left {
    let folder = Folder::new();
    for (name, text) in inputs {
        folder.write(name, text);
    }
    let mut printed = Vec::new();
    for arguments in commands {
        let mut command = cores.command(env!("CARGO_BIN_EXE_robot-model"));
        let command = command.current_dir(folder.path("")).args(*arguments);
        let Output {
            status,
            stdout,
            stderr,
        } = command.output().expect("the program starts");
        let said = String::from_utf8_lossy(&stderr);
        assert!(status.success(), "{arguments:?}: {said}");
        printed.push(stdout);
    }
    let mut files = BTreeMap::new();
    collect(&folder.path(""), "", &mut files);
    Left { printed, files }
}

/// Runs commands twice on all cores and once on one, and fails where a byte differs, or where nothing was written that could.
#[track_caller]
fn same_bytes(inputs: &[(&str, &str)], commands: &[&[&str]], outputs: &[&str]) {
    let first = run(Cores::All, inputs, commands);
    for output in outputs {
        assert!(first.files.contains_key(*output), "no {output}");
    }
    assert_eq!(first.files.len(), inputs.len() + outputs.len());
    let mut others = vec![Cores::All];
    match one_core() {
        Some(one) => others.push(one),
        None => {
            // Past what a test's output is captured by.
            let _ = writeln!(
                std::io::stderr(),
                "no `taskset` that keeps a program on one core: runs are compared, numbers of cores are not"
            );
        }
    }
    for cores in others {
        let other = run(cores, inputs, commands);
        let printed = first.printed.iter().zip(&other.printed);
        for ((arguments, printed), again) in
            commands.iter().zip(printed).map(|(a, (p, o))| ((a, p), o))
        {
            assert_eq!(
                String::from_utf8_lossy(printed),
                String::from_utf8_lossy(again),
                "{arguments:?} prints otherwise, {cores:?}"
            );
        }
        for (name, bytes) in &first.files {
            let again = other.files.get(name);
            assert!(again == Some(bytes), "{name} differs, {cores:?}");
        }
        assert_eq!(first.files.len(), other.files.len(), "{cores:?}");
    }
}

#[test]
fn equations_and_code() {
    same_bytes(
        &[("arm.robot", PENDULUM), ("arm.urdf", URDF)],
        &[
            &["show", "arm.robot"],
            &["show", "arm.robot", "--as", "latex"],
            &["emit", "arm.robot", "--lang", "rust", "--out", "."],
            &["emit", "arm.robot", "--lang", "c", "--out", "."],
            &["export", "arm.robot", "--as", "urdf", "-o", "out.urdf"],
            &["export", "arm.robot", "--as", "mjcf", "-o", "out.xml"],
            &["import", "arm.urdf", "-o", "imported.robot"],
        ],
        &[
            "arm.rs",
            "pendulum.c",
            "pendulum.h",
            "out.urdf",
            "out.xml",
            "imported.robot",
        ],
    );
}

#[test]
fn least_squares() {
    let (log, other) = (cart_log(20, 2.0, 0.0), cart_log(10, 2.0, 0.7));
    let spec = CART.replace(
        "viscous_friction on rail",
        "viscous_friction on rail; coulomb_friction on rail",
    );
    let identify = ["identify", "cart.robot", "log.csv", "other.csv", "--json"];
    let with = |more: &[&'static str]| [identify.as_slice(), more].concat();
    let [wls, bootstrap, factor] = [
        with(&["wls.json"]),
        with(&["bootstrap.json", "--bootstrap", "100"]),
        with(&["reduced.json", "--factor", "factor.json"]),
    ];
    same_bytes(
        &[
            ("cart.robot", &spec),
            ("log.csv", &log),
            ("other.csv", &other),
        ],
        &[
            &wls,
            &bootstrap,
            &factor,
            &[
                "merge",
                "cart.robot",
                "factor.json",
                "--json",
                "merged.json",
            ],
        ],
        &[
            "wls.json",
            "bootstrap.json",
            "reduced.json",
            "factor.json",
            "merged.json",
        ],
    );
}

#[test]
fn simulation_and_output_error() {
    let spec = CART.replace(
        "viscous_friction on rail",
        "viscous_friction on rail; coulomb_friction on rail",
    );
    let values = r#"{"cart.m": 3, "rail.viscous_friction.fv": 5, "rail.coulomb_friction.fc": 2}"#;
    let start = r#"{"cart.m": 2.5, "rail.viscous_friction.fv": 4, "rail.coulomb_friction.fc": 1}"#;
    let motion = cart_log(4, 0.0, 0.0);
    let wanted: String = motion
        .lines()
        .filter_map(|line| line.rsplit_once(',').map(|(kept, _)| format!("{kept}\n")))
        .collect();
    let simulate = [
        "simulate",
        "cart.robot",
        "--parameters",
        "values.json",
        "--trajectory",
        "wanted.csv",
    ];
    let noise = ["--torque-noise", "0.1", "--seed", "3", "--out", "log.csv"];
    let identify = [
        "identify",
        "cart.robot",
        "log.csv",
        "--method",
        "output-error",
    ];
    let more = ["--start", "start.json", "--json", "fit.json"];
    same_bytes(
        &[
            ("cart.robot", &spec),
            ("values.json", values),
            ("start.json", start),
            ("wanted.csv", &wanted),
        ],
        &[
            &[simulate.as_slice(), &noise].concat(),
            &[identify.as_slice(), &more].concat(),
        ],
        &["log.csv", "fit.json"],
    );
}

#[test]
fn tracing() {
    let (log, other) = (cart_log(20, 2.0, 0.0), cart_log(10, 2.0, 0.7));
    let trace = ["trace", "cart.robot", "log.csv", "--validate", "other.csv"];
    let outputs = [
        "--amend",
        "amended.robot",
        "--predict",
        "tau.csv",
        "--json",
        "out.json",
        "--report",
        "page",
    ];
    same_bytes(
        &[
            ("cart.robot", CART),
            ("log.csv", &log),
            ("other.csv", &other),
        ],
        &[&[trace.as_slice(), &outputs].concat()],
        &["amended.robot", "tau.csv", "out.json", "page/index.html"],
    );
}

#[test]
fn excitation() {
    let limits =
        "d = 0; position = -120 deg .. 120 deg; velocity = 4; acceleration = 30; torque = 25; }";
    let spec = PENDULUM.replace("d = 0; }", limits);
    let excite = [
        "excite",
        "arm.robot",
        "--starts",
        "3",
        "--period",
        "5",
        "--harmonics",
        "3",
    ];
    let outputs = [
        "--out",
        "motion.csv",
        "--figure",
        "motion.svg",
        "--json",
        "design.json",
        "--coefficients",
        "fourier.json",
    ];
    same_bytes(
        &[("arm.robot", &spec)],
        &[&[excite.as_slice(), &outputs].concat()],
        &["motion.csv", "motion.svg", "design.json", "fourier.json"],
    );
}

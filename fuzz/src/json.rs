//! JSON of people and of `identify`: parameters, factors, states, through the verbs that read them.
//!
//! The readers are parts of the program, so it is run on each file; what is right is seen from outside.

use std::fmt::Write as _;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use crate::answer::{Answer, skeleton};

/// What stands in such files.
pub(crate) const WORDS: [&str; 46] = [
    "{",
    "}",
    "[",
    "]",
    ",",
    ":",
    "\"",
    "null",
    "true",
    "{}",
    "[]",
    "[[",
    "\"parameters\"",
    "\"name\"",
    "\"value\"",
    "\"std\"",
    "\"unexcited\"",
    "\"possible\"",
    "\"standard\"",
    "\"states\"",
    "\"q\"",
    "\"dq\"",
    "\"rail.viscous_friction.fv\"",
    "\"cart.m\"",
    "\\u0000",
    "\\ud800",
    "1e999",
    "-1e308",
    "1e-320",
    "99999999999999999999",
    "NaN",
    "-",
    "0.0",
    "\"factor\"",
    "\"joints\"",
    "\"position\"",
    "\"columns\"",
    "\"limit\"",
    "\"qref1\"",
    "\"balls\"",
    "\"link\"",
    "\"radius\"",
    "\"box\"",
    "\"planes\"",
    "\"normal\"",
    "[1, 5]",
];

/// What the files are of.
pub const SPEC: &str = "robot Cart { gravity = [0, 0, -9.81]; convention = origin; \
    joint rail: prismatic { xyz = [0, 0, 0]; axis = [1, 0, 0]; link = cart; position = -1 .. 1; velocity = 2; } \
    effects { viscous_friction on rail; coulomb_friction on rail; } }\n";

/// Values of its parameters, in a file `values.json` beside it.
pub const VALUES: &str =
    r#"{"cart.m": 3, "rail.viscous_friction.fv": 5, "rail.coulomb_friction.fc": 2}"#;

/// What the cart was measured to do in two seconds, in a file `log.csv`, with the position that its drive was asked for.
#[must_use]
pub fn log() -> String {
    let mut log = String::from("time,q1,tau1,qref1\n");
    for k in 0..200 {
        let t = 0.01 * f64::from(k);
        let wave = |size: f64, w: f64| {
            let (sin, cos) = (w * t).sin_cos();
            [size * sin, size * w * cos, -size * w * w * sin]
        };
        let [one, other] = [wave(0.2, 3.0), wave(0.05, 7.0)];
        let [q, dq, ddq] = [0, 1, 2].map(|k| one[k] + other[k]);
        let tau = 3.0 * ddq + 5.0 * dq + 2.0 * dq.signum();
        writeln!(log, "{t:.2},{q:.6},{tau:.6},{:.6}", q + tau / 800.0).expect("a string takes all");
    }
    log
}

/// Files that stand beside `f.json`.
#[must_use]
pub fn others() -> [(&'static str, String); 3] {
    [
        ("arm.robot", SPEC.to_owned()),
        ("values.json", VALUES.to_owned()),
        ("log.csv", log()),
    ]
}

/// Commands that read a file `f.json`, beside [`others`].
const COMMANDS: [&str; 8] = [
    "audit arm.robot --parameters f.json",
    "merge arm.robot f.json --json out.json",
    "eval arm.robot --parameters values.json --states f.json",
    "export arm.robot --as urdf --parameters f.json -o out.urdf",
    "identify arm.robot log.csv --method output-error --start f.json --json out.json",
    "identify arm.robot log.csv --method output-error --start values.json --bounds f.json",
    "identify arm.robot log.csv --method output-error --start values.json --controller f.json",
    "excite arm.robot --period 2 --harmonics 2 --room f.json --out out.csv",
];

/// These commands, word by word: a verb and what follows it.
#[must_use]
pub fn verbs() -> [Vec<&'static str>; 8] {
    COMMANDS.map(|command| command.split(' ').collect())
}

/// Sound files of each form.
#[must_use]
pub fn seeds() -> Vec<Vec<u8>> {
    let identified = r#"{"parameters": [{"name": "cart.m", "value": 3.0, "std": 0.01},
        {"name": "rail.viscous_friction.fv", "value": 5.0, "std": 0.02}, {"name": "rail.coulomb_friction.fc", "value": 2.0, "std": 0.1}],
        "unexcited": []}"#;
    let states = r#"{"states": [{"q": [0.1], "dq": [0.2], "ddq": [0.3]}, {"q": [1], "dq": [-2], "ddq": [0]}]}"#;
    let factor = include_str!("factor.json");
    let bounds = r#"{"cart.m": [1, 5], "rail.viscous_friction.fv": [0, 20]}"#;
    let controller =
        r#"{"joints": [{"position": [-800], "columns": {"qref1": [800]}, "limit": 400}]}"#;
    let room = r#"{"balls": [{"link": "cart", "center": [0, 0, 0.1], "radius": 0.08}], "box": {"low": [-2, -2, -1], "high": [2, 2, 2]},
        "planes": [{"normal": [0, 0, 1], "offset": -0.5}], "apart": 0.03}"#;
    [identified, states, VALUES, factor, bounds, controller, room]
        .map(|text| text.as_bytes().to_vec())
        .into()
}

/// The program beside this one: `cargo build --release` puts both into one folder.
///
/// # Panics
/// Where it is not there.
#[must_use]
pub fn program() -> PathBuf {
    let own = std::env::current_exe().expect("a program has a path");
    let beside = own.with_file_name(format!("robot-model{}", std::env::consts::EXE_SUFFIX));
    assert!(
        beside.is_file(),
        "no `{}`: build the program, too",
        beside.display()
    );
    beside
}

/// What the verbs make of a file.
///
/// # Panics
/// Where a verb ends otherwise than with a result or a refusal that names the file.
#[must_use]
pub fn answer(program: &Path, file: &[u8]) -> Answer {
    let folder = tempfile::tempdir().expect("a temporary folder");
    for (name, text) in others() {
        fs::write(folder.path().join(name), text).expect("a file");
    }
    fs::write(folder.path().join("f.json"), file).expect("a file");
    let mut said = Vec::new();
    let mut done = 0;
    for verb in verbs() {
        // No memory without end, and no time without end: the shell's limits are kilobytes and seconds.
        let run = Command::new("sh")
            .args(["-c", "ulimit -v 4000000; ulimit -t 20; exec \"$0\" \"$@\""])
            .arg(program)
            .args(&verb)
            .current_dir(folder.path())
            .stdin(Stdio::null())
            .output()
            .expect("a shell");
        let message = String::from_utf8_lossy(&run.stderr);
        judge(verb[0], run.status.code(), &message);
        if run.status.success() {
            done += 1;
        } else {
            said.push(format!("{}: {}", verb[0], skeleton(&message)));
        }
    }
    said.sort();
    if done == 0 {
        return Answer::Refused(said);
    }
    Answer::Read {
        size: done,
        parts: 1,
        remarks: said,
    }
}

/// Fails where a run ended otherwise than with a result or a refusal that names the file.
///
/// # Panics
/// See above.
pub fn judge(verb: &str, code: Option<i32>, message: &str) {
    assert!(
        matches!(code, Some(0 | 1)),
        "{verb} ends with {code:?}: {}",
        skeleton(message)
    );
    assert!(!message.contains("panicked"), "{verb}: {message}");
    // Numbers that are read and have no arm are told of the spec, or of the log along which it cannot move.
    let names_it = ["f.json", "arm.robot", "log.csv"]
        .iter()
        .any(|name| message.contains(name));
    assert!(
        code == Some(0) || names_it,
        "{verb}: a message that names no file: {}",
        skeleton(message)
    );
}

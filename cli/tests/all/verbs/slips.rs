//! Slips of the hand on the command line, and logs as other programs write them: each is read, or told with the way out.

use std::fmt::Write as _;

use crate::verbs::common::{CART, Folder, cart_log};

/// A folder with an arm and its log.
fn folder() -> Folder {
    let folder = Folder::new();
    folder.write("arm.robot", CART);
    folder.write("log.csv", &cart_log(4, 2.0, 0.0));
    folder
}

#[track_caller]
fn refused(folder: &Folder, arguments: &[&str], words: &[&str]) {
    let said = folder.refuse(arguments);
    for word in words {
        assert!(said.contains(word), "{arguments:?}: {said}");
    }
}

#[test]
fn files_in_the_place_of_a_spec_are_told() {
    let folder = folder();
    folder.write("arm.urdf", "<robot name=\"a\"></robot>");
    std::fs::write(folder.path("log.csv.gz"), b"\x1f\x8b\x08\0").expect("a file");
    for log in ["log.csv", "log.csv.gz"] {
        let way_out = format!(
            "name the spec first and the logs after it, as in `robot-model identify arm.robot {log}`"
        );
        refused(
            &folder,
            &["identify", log, "arm.robot"],
            &["it looks like a log", &way_out],
        );
    }
    refused(
        &folder,
        &["identify", "arm.urdf", "log.csv"],
        &[
            "it looks like a URDF",
            "`robot-model import arm.urdf -o arm.robot`",
        ],
    );
}

#[test]
fn folders_in_the_place_of_files_are_told_with_the_way_out() {
    let folder = folder();
    std::fs::create_dir(folder.path("logs")).expect("a folder");
    for arguments in [
        &["check", "logs"][..],
        &["identify", "logs", "log.csv"],
        &["audit", "arm.robot", "--parameters", "logs"],
    ] {
        refused(
            &folder,
            arguments,
            &["cannot read `logs`: it is a folder; name a file in it"],
        );
    }
}

#[test]
fn files_that_are_not_there_are_told_with_the_nearest() {
    let folder = folder();
    refused(
        &folder,
        &["check", "amr.robot"],
        &["cannot read `amr.robot`: there is no such file; did you mean `arm.robot`?"],
    );
    refused(
        &folder,
        &["check", "specs/arm.robot"],
        &["there is no folder `specs`; check its name"],
    );
    refused(
        &folder,
        &["identify", "arm.robot", "monday.csv"],
        &["cannot open log `monday.csv`: there is no such file; check its name and folder"],
    );
}

#[test]
fn parameters_of_another_arm_are_told() {
    let folder = folder();
    folder.write(
        "fit.json",
        r#"{"a.m": 1, "b.mx": 2, "b.my": 3, "c.izz": 4}"#,
    );
    refused(
        &folder,
        &["audit", "arm.robot", "--parameters", "fit.json"],
        &["the file seems to be for another arm: name the spec that it was identified with"],
    );
}

#[test]
fn figures_are_named_as_what_they_are() {
    let folder = folder();
    refused(
        &folder,
        &[
            "excite",
            "arm.robot",
            "--out",
            "motion.csv",
            "--figure",
            "m.png",
        ],
        &["--figure m.png: figures are written as SVG; name it `m.svg`"],
    );
}

#[test]
fn a_joint_may_be_named_by_its_number() {
    let folder = folder();
    let run = folder.run(&["friction", "arm.robot", "log.csv", "--joint", "1"]);
    assert!(!run.stderr.contains("no such joint"), "{}", run.stderr);
    refused(
        &folder,
        &["friction", "arm.robot", "log.csv", "--joint", "2"],
        &["--joint 2: Cart has no such joint"],
    );
}

/// A program that is killed tells no handler.
#[cfg(unix)]
#[test]
fn the_folder_of_a_report_comes_with_its_page() {
    use std::process::{Command, Stdio};
    let folder = folder();
    let mut work = Command::new(env!("CARGO_BIN_EXE_robot-model"))
        .current_dir(folder.path("."))
        .args([
            "trace",
            "arm.robot",
            "log.csv",
            "--validate",
            "log.csv",
            "--report",
            "page",
        ])
        .stdout(Stdio::null())
        .stderr(Stdio::null())
        .spawn()
        .expect("the program starts");
    std::thread::sleep(std::time::Duration::from_millis(150));
    let ended = work.try_wait().expect("a program of ours").is_some();
    work.kill().expect("a signal");
    work.wait().expect("its end");
    let is_there = folder.path("page").exists();
    assert_eq!(is_there, folder.path("page/index.html").exists(), "{ended}");
}

/// The same parameters from the same numbers, however they are written down.
#[test]
fn logs_of_spreadsheets_give_what_plain_ones_give() {
    let folder = folder();
    let plain = folder.read("log.csv");
    let (header, rows) = plain.split_once('\n').expect("a header");
    let units = header
        .replace("time", "s")
        .replace("tau1", "N")
        .replace("q1", "m");
    let spread = |text: &str| text.replace(',', ";").replace('.', ",");
    let other = format!(
        "sep=;\nRig: 7\n{};\n{};\n{}",
        header.replace(',', ";"),
        units.replace(',', ";"),
        spread(rows).replace('\n', ";\n")
    );
    folder.write("other.csv", &other);
    let identified = |log: &str| folder.run(&["identify", "arm.robot", log]);
    let [own, other] = [identified("log.csv"), identified("other.csv")];
    assert_eq!(
        (own.code, other.code),
        (Some(0), Some(0)),
        "{}{}",
        own.stderr,
        other.stderr
    );
    assert_eq!(
        own.stdout.replace("log.csv", ""),
        other.stdout.replace("other.csv", "")
    );
    for note in [
        "note: other.csv: commas in numbers are read as decimal points",
        "note: other.csv: the header is line 3: 1 line above it is passed over: `Rig: 7`",
        "note: other.csv: line 4 says units: `time` in s, `q1` in m, `tau1` in N are read so",
    ] {
        assert!(other.stderr.contains(note), "{}", other.stderr);
    }
}

/// A gain per ampere makes forces of currents: the line below the names may say these, and no forces, which would be taken times the gain.
#[test]
fn units_below_the_names_are_what_the_gain_takes() {
    let folder = Folder::new();
    let log = cart_log(20, 0.0, 0.0);
    let (header, rows) = log.split_once('\n').expect("rows");
    let identified = |gain: &str, units: &str| {
        let spec = CART.replace(
            "prismatic {",
            &format!("prismatic {{ actuator_gain = {gain};"),
        );
        folder.write("gain.robot", &spec);
        folder.write("units.csv", &format!("{header}\n{units}\n{rows}"));
        folder.run(&["identify", "gain.robot", "units.csv"])
    };
    let amperes = identified("2 N/A", "s,m,A");
    assert_eq!(amperes.code, Some(0), "{}", amperes.stderr);
    // A number with a gain is of any unit.
    assert_eq!(identified("2", "s,m,A").stdout, amperes.stdout);
    let newtons = identified("2 N/A", "s,m,N");
    assert_eq!(newtons.code, Some(1));
    assert!(
        newtons.stderr.contains("units.csv:2: ") && newtons.stderr.contains("write one of `A`"),
        "{}",
        newtons.stderr
    );
}

/// Units in brackets come with them: what the message says to write reads the log in its units.
#[test]
fn units_behind_names_come_with_the_lines_that_say_so() {
    let folder = Folder::new();
    folder.write("cart.robot", CART);
    let log = cart_log(10, 0.0, 0.0);
    let plain = ["identify", "cart.robot", "log.csv"];
    folder.write("log.csv", &log);
    let wanted = folder.succeed(&plain);
    let mut lines = log.lines();
    let mut other = String::from("time [ms],q1 [mm],tau_1 (kN)\n");
    let _ = lines.next();
    for line in lines {
        let fields: Vec<f64> = line
            .split(',')
            .map(|x| x.parse().expect("a number"))
            .collect();
        writeln!(
            other,
            "{},{},{}",
            1e3 * fields[0],
            1e3 * fields[1],
            1e-3 * fields[2]
        )
        .expect("a string takes all");
    }
    folder.write("log.csv", &other);
    let said = folder.refuse(&plain);
    let (_, settings) = said.split_once("\n\n").expect("lines to write");
    assert!(
        settings.contains("q = { columns = [\"q1 [mm]\"], unit = \"mm\" }"),
        "{said}"
    );
    folder.write("robot-model.toml", settings);
    let found = folder.succeed(&plain);
    // Digits that were lost in other units are none that is printed.
    assert_eq!(
        found.lines().take(3).collect::<Vec<_>>(),
        wanted.lines().take(3).collect::<Vec<_>>()
    );
}

/// The message has the settings that read the log as it is.
#[test]
fn names_that_are_nearly_standard_come_with_the_lines_that_say_so() {
    let folder = folder();
    let log = folder
        .read("log.csv")
        .replacen("time", "Time", 1)
        .replacen("q1", "q_1", 1);
    folder.write("log.csv", &log);
    refused(
        &folder,
        &["identify", "arm.robot", "log.csv"],
        &["\n      [log]\n      time = \"Time\"\n      q = [\"q_1\"]\n"],
    );
    folder.write(
        "robot-model.toml",
        "[log]\ntime = \"Time\"\nq = [\"q_1\"]\n",
    );
    folder.succeed(&["identify", "arm.robot", "log.csv"]);
}

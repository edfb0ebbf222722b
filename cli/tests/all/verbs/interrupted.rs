//! Ctrl-C in the middle of long work: the end, with every file whole or absent.

#![cfg(unix)]

use std::io::{BufRead, BufReader, Read};
use std::process::{Command, Stdio};
use std::time::Duration;

use crate::verbs::common::{Folder, cart_with, folding, moved, tones};

/// Runs a command, presses Ctrl-C when a line on standard error begins so and a while after, and says how it ended. The last
/// line tells that no file was written.
fn interrupted(folder: &Folder, arguments: &[&str], at: &str, after: Duration) -> Option<i32> {
    let mut work = Command::new(env!("CARGO_BIN_EXE_robot-model"))
        .current_dir(folder.path("."))
        .args(arguments)
        .stdout(Stdio::null())
        .stderr(Stdio::piped())
        .spawn()
        .expect("the program starts");
    let mut stderr = BufReader::new(work.stderr.take().expect("a pipe"));
    let mut said = String::new();
    loop {
        let mut line = String::new();
        let read = stderr.read_line(&mut line).expect("text");
        assert!(read > 0, "{arguments:?} ended before `{at}`: {said}");
        said += &line;
        if line.starts_with(at) {
            break;
        }
    }
    std::thread::sleep(after);
    let press = Command::new("kill")
        .args(["-INT", &work.id().to_string()])
        .status();
    assert!(press.expect("kill is there").success());
    let code = work.wait().expect("an end").code();
    stderr.read_to_string(&mut said).expect("text");
    assert!(!said.contains("panicked"), "{said}");
    assert!(
        said.ends_with("\ninterrupted: no file was written\n"),
        "{said}"
    );
    code
}

#[test]
fn a_trace_that_is_stopped_leaves_nothing() {
    let folder = Folder::new();
    folder.write(
        "arm.robot",
        &folding("").replace("coulomb_friction on all;", ""),
    );
    let values = r#"{"up.viscous_friction.fv": 1.5, "up.coulomb_friction.fc": 0.8,
        "lo.viscous_friction.fv": 0.6, "lo.coulomb_friction.fc": 0.4}"#;
    moved(&folder, &folding(""), values, |t| {
        [0.9 * (1.1 * t).sin(), 0.7 * (1.7 * t).cos() - 0.4]
    });
    let before = folder.files();
    let trace = ["trace", "arm.robot", "log.csv", "--validate", "log.csv"];
    let out = [
        "--json",
        "out.json",
        "--amend",
        "out.robot",
        "--report",
        "page",
        "--predict",
        "out.csv",
    ];
    let arguments = [&trace[..], &out].concat();
    for at in [
        "reading",
        "identifying the declared model",
        "forming candidate columns",
        "round 1",
    ] {
        let code = interrupted(&folder, &arguments, at, Duration::ZERO);
        assert_eq!(code, Some(130), "{at}");
        assert_eq!(folder.files(), before, "{at}: nothing is left");
    }
    // What was there before is as it was.
    let mine = r#"{"outcome": "mine", "effects": [], "rmse_before": [], "rmse_after": []}"#;
    folder.write("out.json", mine);
    assert_eq!(
        interrupted(&folder, &arguments, "round 1", Duration::ZERO),
        Some(130)
    );
    assert_eq!(folder.read("out.json"), mine);
}

#[test]
fn an_identification_that_is_stopped_leaves_nothing() {
    let folder = Folder::new();
    let spec = crate::verbs::common::CART.replace(
        "viscous_friction on rail;",
        "viscous_friction on rail; stribeck on rail;",
    );
    folder.write("cart.robot", &spec);
    let force = |_: f64, dq: f64| 4.0 * (-(dq / 0.1).powi(2)).exp() * dq.signum();
    folder.write("log.csv", &cart_with(1000, 60, &tones(0.0), force));
    let before = folder.files();
    let identify = [
        "identify",
        "cart.robot",
        "log.csv",
        "--json",
        "fit.json",
        "--method",
    ];
    let arguments = [&identify[..], &["output-error"]].concat();
    let code = interrupted(
        &folder,
        &arguments,
        "simulating",
        Duration::from_millis(200),
    );
    assert_eq!(code, Some(130));
    assert_eq!(folder.files(), before);
}

/// Wherever it is pressed, also while files are put in place: each is whole or absent, and no temporary file stays.
#[test]
fn files_are_whole_or_absent_whenever_it_is_pressed() {
    let folder = Folder::new();
    folder.succeed(&["new", "Arm", "--joints", "4", "-o", "arm.robot"]);
    folder.succeed(&["emit", "arm.robot", "--lang", "rust", "--out", "whole"]);
    let whole = folder.read("whole/arm.rs");
    std::fs::create_dir(folder.path("stopped")).expect("a folder");
    let emit = ["emit", "arm.robot", "--lang", "rust", "--out", "stopped"];
    let (mut ended, mut stopped) = (0, 0);
    let started = std::time::Instant::now();
    folder.succeed(&emit);
    let takes = started.elapsed();
    for part in 1..=20 {
        let _ = std::fs::remove_file(folder.path("stopped/arm.rs"));
        let mut work = Command::new(env!("CARGO_BIN_EXE_robot-model"))
            .current_dir(folder.path("."))
            .args(emit)
            .stdout(Stdio::null())
            .stderr(Stdio::null())
            .spawn()
            .expect("the program starts");
        std::thread::sleep(takes * part / 20);
        // It may have ended before.
        let _ = Command::new("kill")
            .args(["-INT", &work.id().to_string()])
            .stderr(Stdio::null())
            .status();
        match work.wait().expect("an end").code() {
            Some(0) => ended += 1,
            Some(130) => stopped += 1,
            // Before it heeds anything.
            None => {}
            other => panic!("{other:?}"),
        }
        let entries = std::fs::read_dir(folder.path("stopped")).expect("the folder");
        for entry in entries {
            let name = entry.expect("an entry").file_name();
            assert_eq!(name, "arm.rs", "no temporary file stays");
            assert!(folder.read("stopped/arm.rs") == whole);
        }
    }
    assert!(stopped > 0, "{ended} ended");
}

//! Searches that end early.

use super::{ARM, columns, folder, most};
use crate::verbs::common::json;

#[test]
fn a_search_that_is_stopped_gives_the_best_so_far() {
    let folder = folder();
    let many = ["--starts", "100000", "--budget", "0.001"];
    let arguments = [&ARM[..], &many, &["--out", "m.csv", "--json", "m.json"]].concat();
    let said = folder.run(&arguments);
    assert_eq!(said.code, Some(0), "{}", said.stderr);
    assert!(
        said.stderr.contains("stopped after 1 start"),
        "{}",
        said.stderr
    );
    let report = json(&folder.read("m.json"));
    assert_eq!(
        (&report["stopped"], &report["max_violation"]),
        (&true.into(), &0.0.into())
    );
    let (_, table) = columns(&folder.read("m.csv"));
    assert!(most(&table[3]) <= 4.0 && most(&table[4]) > 0.0);
}

/// Somebody who presses Ctrl-C has seen enough.
#[cfg(unix)]
#[test]
fn an_interrupt_gives_the_best_so_far() {
    use std::io::{BufRead, BufReader};
    use std::process::{Command, Stdio};

    let folder = folder();
    let mut search = Command::new(env!("CARGO_BIN_EXE_robot-model"))
        .current_dir(folder.path("."))
        .args([&ARM[..], &["--starts", "1000000", "--out", "m.csv"]].concat())
        .stdout(Stdio::null())
        .stderr(Stdio::piped())
        .spawn()
        .expect("the program starts");
    let mut lines = BufReader::new(search.stderr.take().expect("a pipe")).lines();
    let is_second =
        |line: &std::io::Result<String>| line.as_ref().expect("text").starts_with("start 2 of");
    assert!(lines.any(|line| is_second(&line)), "it looks on");
    let interrupt = Command::new("kill")
        .args(["-INT", &search.id().to_string()])
        .status();
    assert!(interrupt.expect("kill is there").success());
    let rest: Vec<String> = lines.map_while(Result::ok).collect();
    assert_eq!(search.wait().expect("an end").code(), Some(0), "{rest:?}");
    assert!(
        rest.iter().any(|line| line.contains("stopped after")),
        "{rest:?}"
    );
    let (_, table) = columns(&folder.read("m.csv"));
    assert!(most(&table[3]) <= 4.0 && most(&table[3]) > 0.0);
}

//! The example in C++ is built by its Makefile, with C that this command line emits, and run.

use std::path::Path;
use std::process::Command;

/// Whether the machine has the program that the variable or else the name says.
fn is_there(variable: &str, name: &str) -> bool {
    let program = std::env::var(variable).unwrap_or_else(|_| name.to_owned());
    let is_there = Command::new(&program).arg("--version").output().is_ok();
    if !is_there {
        eprintln!("absent: `{program}`, so this run does not test the example in C++");
    }
    is_there
}

#[test]
fn the_arm_is_held() {
    // What make calls by itself.
    if ![("MAKE", "make"), ("CC", "cc"), ("CXX", "g++")]
        .into_iter()
        .all(|(variable, name)| is_there(variable, name))
    {
        return;
    }
    let example = Path::new(env!("CARGO_MANIFEST_DIR")).join("../examples/cpp_control");
    let build = tempfile::tempdir().expect("a temporary folder");
    let output = Command::new(std::env::var_os("MAKE").unwrap_or("make".into()))
        .current_dir(example)
        .arg(format!("BUILD={}", build.path().display()))
        .arg(format!("ROBOT_MODEL={}", env!("CARGO_BIN_EXE_robot-model")))
        .arg("CFLAGS=-O2 -Wall -Wextra -Wpedantic -Werror")
        .arg("CXXFLAGS=-O2 -Wall -Wextra -Wpedantic -Werror")
        .output()
        .expect("make runs");
    assert!(build.path().join("libtwo_link_arm.a").exists());
    let said = String::from_utf8_lossy(&output.stdout);
    let errors = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{said}{errors}");
    assert!(
        said.contains("TwoLinkArm at x = 0.693 m, y = 0.510 m\n"),
        "{said}"
    );
}

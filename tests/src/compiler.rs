//! The C and C++ compilers of this machine.

use std::path::{Path, PathBuf};
use std::process::Command;

/// Flags under which emitted C has no warning.
pub const STRICT: [&str; 7] = [
    "-Wall",
    "-Wextra",
    "-Wpedantic",
    "-Wconversion",
    "-Wdouble-promotion",
    "-Wshadow",
    "-Werror",
];

/// A program that the variable names, or else one of these on `PATH`; where there is none, says so and what is therefore not
/// tested.
#[must_use]
pub fn find(variable: &str, names: &[&str], what: &str) -> Option<PathBuf> {
    if let Some(given) = std::env::var_os(variable) {
        return Some(given.into());
    }
    let folders = std::env::var_os("PATH").unwrap_or_default();
    let found = std::env::split_paths(&folders)
        .flat_map(|folder| names.iter().map(move |name| folder.join(name)))
        .find(|program| program.is_file());
    if found.is_none() {
        let names = names.join("`, `");
        eprintln!("absent: `{names}` on PATH and {variable}, so this run does not test {what}");
    }
    found
}

/// The C compiler.
#[must_use]
pub fn c(what: &str) -> Option<PathBuf> {
    find("CC", &["cc", "gcc", "clang"], what)
}

/// The C++ compiler.
#[must_use]
pub fn cpp(what: &str) -> Option<PathBuf> {
    find("CXX", &["c++", "g++", "clang++"], what)
}

/// Runs a program in a folder, which must succeed; what it prints.
///
/// # Panics
/// Where it does not.
#[must_use]
pub fn run(program: &Path, arguments: &[&str], folder: &Path) -> String {
    let output = Command::new(program)
        .args(arguments)
        .current_dir(folder)
        .output()
        .unwrap_or_else(|error| panic!("{}: {error}", program.display()));
    assert!(
        output.status.success(),
        "{} {arguments:?}:\n{}",
        program.display(),
        String::from_utf8_lossy(&output.stderr)
    );
    String::from_utf8(output.stdout).expect("it prints text")
}

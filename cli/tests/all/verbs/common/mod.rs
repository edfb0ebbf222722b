//! A folder of inputs, the program run on them, and its results.

mod inputs;

use std::path::{Path, PathBuf};
use std::process::Command;

use serde_json::Value;
use tempfile::TempDir;

pub use inputs::{
    CART, MEASURED_PENDULUM, PENDULUM, URDF, cart_breaking_away, cart_log, cart_with, folding,
    moved, tones, two_joints_waving, white,
};

/// What a run left behind.
pub struct Run {
    pub code: Option<i32>,
    pub stdout: String,
    pub stderr: String,
}

/// A folder of its own for each test.
pub struct Folder(TempDir);

impl Folder {
    pub fn new() -> Self {
        Self(tempfile::tempdir().expect("a temporary folder"))
    }

    pub fn path(&self, name: &str) -> PathBuf {
        self.0.path().join(name)
    }

    pub fn write(&self, name: &str, text: &str) {
        std::fs::write(self.path(name), text).expect("a file in the folder");
    }

    pub fn read(&self, name: &str) -> String {
        std::fs::read_to_string(self.path(name)).expect("a file in the folder")
    }

    /// Names of all files, hidden ones too, in order.
    pub fn files(&self) -> Vec<String> {
        let entries = std::fs::read_dir(self.0.path()).expect("the folder");
        let name = |entry: std::io::Result<std::fs::DirEntry>| {
            entry
                .expect("an entry")
                .file_name()
                .into_string()
                .expect("a readable name")
        };
        let mut names: Vec<String> = entries.map(name).collect();
        names.sort();
        names
    }

    /// Runs the program inside the folder.
    pub fn run(&self, arguments: &[&str]) -> Run {
        run_in(self.0.path(), arguments)
    }

    /// Runs the program, which must succeed; what it prints.
    pub fn succeed(&self, arguments: &[&str]) -> String {
        let run = self.run(arguments);
        assert_eq!(run.code, Some(0), "{arguments:?}: {}", run.stderr);
        run.stdout
    }

    /// Runs the program, which must refuse: exit code 1, nothing printed, no file added. What it says.
    pub fn refuse(&self, arguments: &[&str]) -> String {
        let before = self.files();
        let run = self.run(arguments);
        assert_eq!(
            run.code,
            Some(1),
            "{arguments:?}: {}{}",
            run.stdout,
            run.stderr
        );
        assert_eq!(run.stdout, "", "{arguments:?}");
        assert_eq!(self.files(), before, "{arguments:?}: nothing half-written");
        assert!(!run.stderr.contains("panicked"), "{}", run.stderr);
        run.stderr
    }
}

fn run_in(folder: &Path, arguments: &[&str]) -> Run {
    let output = Command::new(env!("CARGO_BIN_EXE_robot-model"))
        .current_dir(folder)
        .args(arguments)
        .output()
        .expect("the program starts");
    let text = |bytes: Vec<u8>| String::from_utf8(bytes).expect("the program writes text");
    Run {
        code: output.status.code(),
        stdout: text(output.stdout),
        stderr: text(output.stderr),
    }
}

/// JSON as the program writes it.
pub fn json(text: &str) -> Value {
    serde_json::from_str(text).expect("the program writes JSON")
}

/// The numbers of a list.
pub fn numbers(value: &Value) -> Vec<f64> {
    value
        .as_array()
        .expect("a list")
        .iter()
        .map(|number| number.as_f64().expect("a number"))
        .collect()
}

/// Fails where a number is further from the expected one than the tolerance.
pub fn close(found: f64, expected: f64, tolerance: f64) {
    assert!(
        (found - expected).abs() <= tolerance,
        "{found} against {expected}"
    );
}

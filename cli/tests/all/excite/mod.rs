//! Motions for arms of the field, with their limits.

mod panda;
mod puma;
mod tx40;

use std::path::Path;
use std::process::Command;

use serde_json::Value;

/// Designs a motion in a folder; what it is worth.
fn design(folder: &Path, arguments: &[&str]) -> Value {
    let output = Command::new(env!("CARGO_BIN_EXE_robot-model"))
        .current_dir(folder)
        .arg("excite")
        .args(arguments)
        .args(["--out", "motion.csv", "--json", "design.json"])
        .output()
        .expect("the program starts");
    let said = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(0), "{said}");
    let text = std::fs::read_to_string(folder.join("design.json")).expect("a report");
    serde_json::from_str(&text).expect("JSON")
}

fn number(report: &Value, key: &str) -> f64 {
    report[key].as_f64().expect("a number")
}

/// A spec of the crate `tests`.
fn spec(name: &str) -> String {
    let root = concat!(env!("CARGO_MANIFEST_DIR"), "/../tests/specs");
    std::fs::read_to_string(format!("{root}/{name}.robot")).expect("in the repository")
}

/// `spec` without its effects.
fn rigid(spec: &str) -> String {
    let start = spec.find("    effects {").expect("a block of effects");
    format!("{}}}\n", &spec[..start])
}

/// `spec` with another limit in each joint.
fn limited(spec: &str, what: &str, limits: &[&str]) -> String {
    let mut limits = limits.iter();
    let line = |line: &str| {
        if !line.trim_start().starts_with("joint ") {
            return line.to_owned();
        }
        let limit = limits.next().expect("a limit a joint");
        line.replacen(" }", &format!(" {what} = {limit}; }}"), 1)
    };
    spec.lines().map(line).collect::<Vec<_>>().join("\n")
}

//! The loop: a log, a doubt, the next experiment, a verdict.

use std::fmt::Write;

use serde_json::Value;

use super::arm;
use crate::verbs::common::{Folder, json};

const VALUES: &str = r#"{"upper.viscous_friction.fv": 0.5, "lower.viscous_friction.fv": 0.3,
    "upper.coulomb_friction.fc": 0.6, "lower.coulomb_friction.fc": 0.4, "lower.quadratic_viscous.c": 0.5}"#;

/// A motion whose lower joint is all at one frequency.
fn plain(phase: f64) -> String {
    let mut text = String::from("time,q1,q2\n");
    for k in 0..=2000 {
        let t = f64::from(k) / 100.0;
        let upper = 0.6 * (1.3 * t + phase).sin() + 0.2 * (2.1 * t).sin();
        let lower = 0.8 * (1.9 * t + phase).sin();
        writeln!(text, "{t},{upper},{lower}").expect("a string takes all");
    }
    text
}

/// What a shell makes of a line with single quotes.
fn words(line: &str) -> Vec<String> {
    let mut words = vec![String::new()];
    for (k, part) in line.split('\'').enumerate() {
        if k % 2 == 1 {
            words.last_mut().expect("a word").push_str(part);
            continue;
        }
        for (k, plain) in part.split(' ').enumerate() {
            if k > 0 {
                words.push(String::new());
            }
            words.last_mut().expect("a word").push_str(plain);
        }
    }
    words.retain(|word| !word.is_empty());
    words
}

#[test]
fn what_a_log_leaves_open_the_next_experiment_settles() {
    let folder = Folder::new();
    folder.write("arm.robot", &arm());
    folder.write(
        "true.robot",
        &arm().replace("on all; }", "on all; quadratic_viscous on lower; }"),
    );
    folder.write("values.json", VALUES);
    let measure = |motion: &str, log: &str| {
        let files = ["--trajectory", motion, "--out", log];
        let sensors = ["--encoder-bits", "18", "--torque-noise", "0.03"];
        let run = ["simulate", "true.robot", "--parameters", "values.json"];
        let drive = ["--controller", "computed-torque"];
        folder.succeed(&[&run[..], &files, &sensors, &drive].concat());
    };
    let trace = |logs: &[&str]| -> (String, Value) {
        let rest = ["--validate", "other.log", "--json", "trace.json"];
        let said = folder.succeed(&[&["trace", "arm.robot"], logs, &rest].concat());
        (said, json(&folder.read("trace.json")))
    };
    for (name, phase) in [("first", 0.3), ("other", 1.7)] {
        folder.write(&format!("{name}.csv"), &plain(phase));
        measure(&format!("{name}.csv"), &format!("{name}.log"));
    }
    let (said, doubtful) = trace(&["first.log"]);
    assert_eq!(doubtful["outcome"], "explained", "{said}");
    assert_eq!(
        doubtful["alternatives"][0]["kind"], "cubic-viscous",
        "{said}"
    );
    let mut lines = said.lines().map(str::trim_start);
    let command = lines.find(|line| {
        line.contains("design the motion that best separates quadratic-viscous from cubic-viscous")
    });
    let command = command.and_then(|line| line.split_once(": robot-model "));
    let command = words(command.unwrap_or_else(|| panic!("a command: {said}")).1);
    let command: Vec<&str> = command.iter().map(String::as_str).collect();
    folder.succeed(&command);
    measure("next.csv", "next.log");
    let (said, settled) = trace(&["first.log", "next.log"]);
    assert_eq!(settled["effects"][0]["kind"], "quadratic-viscous", "{said}");
    let alternatives = settled["alternatives"].as_array().expect("a list");
    assert!(alternatives.is_empty(), "{said}");
}

//! Torque that stands at a limit: rows of that joint there are left out, and what is found is right.

use std::fmt::Write;

use serde_json::Value;

use crate::verbs::common::{Folder, json, numbers};
use crate::verbs::payload::{folder, parameter};
use crate::verbs::turns::TRUTH;

/// Share of the largest torque at which the first joint's is clipped.
const SHARE: f64 = 0.6;

/// A log whose first torque goes no further than [`SHARE`] of its largest.
fn clipped(log: &str) -> String {
    let mut lines = log.lines();
    let header = lines.next().expect("a header");
    let column = header.split(',').position(|name| name == "tau1");
    let column = column.expect("a torque");
    let rows: Vec<Vec<&str>> = lines.map(|row| row.split(',').collect()).collect();
    let torque = |row: &Vec<&str>| row[column].parse::<f64>().expect("a number");
    let most = rows.iter().map(|row| torque(row).abs()).fold(0.0, f64::max);
    let mut text = format!("{header}\n");
    for row in &rows {
        let torque = torque(row).clamp(-SHARE * most, SHARE * most).to_string();
        let mut row = row.clone();
        row[column] = &torque;
        writeln!(text, "{}", row.join(",")).expect("a string takes all");
    }
    text
}

/// Errors over their deviations of all parameters.
fn errors(fit: &Value) -> Vec<f64> {
    let error = |(name, truth): &(&str, f64)| {
        let found = parameter(fit, name);
        let number = |key: &str| found[key].as_f64().expect("a number");
        (number("value") - truth) / number("std")
    };
    TRUTH.iter().map(error).collect()
}

fn largest(errors: &[f64]) -> f64 {
    errors.iter().map(|z| z.abs()).fold(0.0, f64::max)
}

fn arm() -> Folder {
    let folder = folder("");
    folder.write("clipped.csv", &clipped(&folder.read("empty.csv")));
    folder
}

#[test]
fn parameters_are_right_where_a_torque_was_clipped() {
    let folder = arm();
    let identify = ["identify", "arm.robot", "clipped.csv", "--json", "fit.json"];
    let fit = |more: &[&str]| {
        let said = folder.succeed(&[&identify[..], more].concat());
        (json(&folder.read("fit.json")), said)
    };
    let (as_logged, said) = fit(&["--as-logged"]);
    let bias = |fit: &Value| {
        let value = parameter(fit, "up.mxr")["value"].as_f64();
        (value.expect("a number") - 1.0).abs()
    };
    assert!(bias(&as_logged) > 0.03, "{said}");
    assert!(!said.contains("at its limit"), "{said}");
    let factor = ["--factor", "factor.json", "--bands", "10,30,90"];
    for more in [
        &[][..],
        &["--form", "filtered"],
        &["--leave-out-turns"],
        &factor,
    ] {
        let (fit, said) = fit(more);
        assert!(bias(&fit) < 0.005, "{more:?}: {said}");
        // Errors are of samples that are left.
        let rmse = numbers(&fit["rmse"])[0];
        assert!(
            rmse < 0.8 * numbers(&as_logged["rmse"])[0],
            "{more:?}: {said}"
        );
        if more == factor {
            // Its deviations know nothing of turns.
            continue;
        }
        let errors = errors(&fit);
        assert!(largest(&errors) < 3.0, "{more:?}: {errors:?}\n{said}");
        let counts = fit["samples_clipped"].as_array().expect("a list");
        let count = counts[0].as_u64().expect("a count");
        assert!(count > 50 && counts[1] == 0, "{counts:?}");
        assert!(
            said.contains(&format!("at its limit: up {count}, lo 0")),
            "{said}"
        );
    }
    let faults = json(&folder.read("fit.json"))["data_faults"].clone();
    assert_eq!(faults[0]["kind"], "clipped", "{faults}");
}

/// What a saturation says of the samples is a part of the model.
#[test]
fn joints_with_a_declared_saturation_keep_their_rows() {
    let folder = arm();
    let text = folder.read("arm.robot").replace(
        "viscous_friction on all;",
        "viscous_friction on all; torque_saturation(limit = 1000, v0 = 1000) on lo;",
    );
    folder.write("other.robot", &text);
    folder.write("own.robot", &text.replace("1000) on lo;", "1000) on up;"));
    for (spec, is_left_out) in [("other.robot", true), ("own.robot", false)] {
        let identify = [
            "identify",
            spec,
            "clipped.csv",
            "--partial",
            "--json",
            "fit.json",
        ];
        folder.succeed(&identify);
        let fit = json(&folder.read("fit.json"));
        let count = fit["samples_clipped"][0].as_u64().expect("a count");
        assert_eq!(count > 0, is_left_out, "{spec}: {count}");
    }
}

//! `friction`: a joint's friction curve, its law, and its bristles.

mod gravity;
mod motion;
mod seed;

use std::fmt::Write;

use serde_json::Value;

use crate::verbs::common::{Folder, close, json};
use motion::speeds;

/// A rod under gravity that hangs at -90 degrees.
fn rod(effects: &str) -> String {
    format!(
        "robot Rod {{
            gravity = [0, -9.81, 0];
            convention = standard_dh;
            joint elbow: revolute {{ a = 0.21; alpha = 0; d = 0; }}
            link elbow {{ mass = 0.5; com = [-0.105, 0, 0]; inertia = [0, 0, 0, 0, 0, 0.0018375]; }}
            effects {{ {effects} }}
        }}"
    )
}

fn number(value: &Value) -> f64 {
    value.as_f64().unwrap_or_else(|| panic!("{value}"))
}

fn parameter(report: &Value, name: &str) -> f64 {
    let parameters = report["parameters"].as_array().expect("a list");
    let found = parameters.iter().find(|entry| entry["name"] == name);
    number(&found.unwrap_or_else(|| panic!("{name}"))["value"])
}

/// What is written starts a search that has the friction it declares.
#[test]
fn the_result_starts_output_error() {
    let folder = Folder::new();
    let spec = rod("viscous_friction on elbow; coulomb_friction on elbow;");
    folder.write("rod.robot", &spec);
    folder.write(
        "values.json",
        r#"{"elbow.viscous_friction.fv": 0.2, "elbow.coulomb_friction.fc": 0.5}"#,
    );
    folder.write("speeds.csv", &speeds(5, 0.5, 3.0).csv(&[]));
    let simulate = [
        "simulate",
        "rod.robot",
        "--parameters",
        "values.json",
        "--log-rate",
        "250",
    ];
    let out = [
        "--trajectory",
        "speeds.csv",
        "--out",
        "log.csv",
        "--torque-noise",
        "0.01",
    ];
    folder.succeed(&[&simulate[..], &out].concat());
    let friction = ["friction", "rod.robot", "log.csv", "--joint", "elbow"];
    folder.succeed(&[&friction[..], &["--json", "f.json"]].concat());
    let identify = [
        "identify",
        "rod.robot",
        "log.csv",
        "--method",
        "output-error",
    ];
    let start = ["--start", "f.json", "--json", "fit.json"];
    folder.succeed(&[&identify[..], &start].concat());
    let fit = json(&folder.read("fit.json"));
    close(parameter(&fit, "elbow.coulomb_friction.fc"), 0.5, 0.01);

    // Of a body without nominal values the file says nothing.
    let body = spec
        .lines()
        .find(|line| line.contains("link elbow"))
        .expect("a body");
    folder.write("rod.robot", &spec.replace(body, ""));
    let run = folder.run(&[&identify[..], &start].concat());
    let told = "f.json: no value for 3 parameters: the value of `--method wls` on the same logs is used for";
    assert!(
        run.code == Some(0) && run.stderr.contains(told),
        "{}",
        run.stderr
    );
    let fit = json(&folder.read("fit.json"));
    close(parameter(&fit, "elbow.coulomb_friction.fc"), 0.5, 0.01);
    // m (a - 0.105 m)
    close(parameter(&fit, "elbow.mxr"), 0.0525, 0.002);
}

#[test]
fn logs_and_joints_that_do_not_fit_are_refused() {
    let folder = Folder::new();
    folder.write("rod.robot", &rod("viscous_friction on elbow;"));
    let mut motion = String::from("time,q1,tau1");
    let mut slow = String::from("time,q1,tau1");
    for k in 0..2000 {
        let t = 0.005 * f64::from(k);
        write!(motion, "\n{t},{},{}", (6.0 * t).sin(), 0.1 * t.cos()).expect("text");
        write!(slow, "\n{t},{},{}", 0.5 * t, 0.7).expect("text");
    }
    folder.write("swing.csv", &motion);
    folder.write("slow.csv", &slow);
    let said = |log: &str, joint: &str| {
        folder.refuse(&[
            "friction",
            "rod.robot",
            log,
            "--joint",
            joint,
            "--json",
            "f.json",
        ])
    };
    assert!(said("slow.csv", "wrist").contains("its joints are `elbow`"));
    assert!(said("swing.csv", "elbow").contains("never moves at a constant speed"));
    let few = said("slow.csv", "elbow");
    assert!(few.contains("needs 4 speeds, but there are 1"), "{few}");
    folder.write("part.json", r#"{"elbow.m": 0.5}"#);
    let part = [
        "friction",
        "rod.robot",
        "slow.csv",
        "--joint",
        "elbow",
        "--parameters",
        "part.json",
    ];
    // The spec says the rest of the rod, and friction is what is asked for.
    assert!(folder.refuse(&part).contains("there are 1"));
}

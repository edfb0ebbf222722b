//! `identify --method physical`.

use std::fmt::Write;

use robot_model::Inertial;
use serde_json::Value;

use crate::common::{Folder, PENDULUM, json, numbers};

const VALUES: &str = r#"{"upper.viscous_friction.fv": 0.5, "lower.viscous_friction.fv": 0.02}"#;

/// A log of the double pendulum with friction, without CAD in the spec that identifies.
fn folder(noise: &str) -> Folder {
    let folder = Folder::new();
    let arm = PENDULUM.replace("\n}\n", "\n    effects { viscous_friction on all; }\n}\n");
    folder.write("true.robot", &arm);
    let bare: Vec<&str> = arm.lines().filter(|line| !line.contains("link ")).collect();
    folder.write("arm.robot", &bare.join("\n"));
    folder.write("values.json", VALUES);
    let mut motion = String::from("time,q1,q2\n");
    for k in 0..=1200 {
        let t = f64::from(k) / 100.0;
        let upper = 0.6 * (1.3 * t).sin() + 0.2 * (2.9 * t).sin();
        let lower = 0.5 * (1.9 * t).sin() - 0.3 * (3.3 * t).cos();
        writeln!(motion, "{t},{upper},{lower}").expect("a string takes all");
    }
    folder.write("motion.csv", &motion);
    let run = [
        "simulate",
        "true.robot",
        "--parameters",
        "values.json",
        "--trajectory",
        "motion.csv",
    ];
    let rest = [
        "--out",
        "log.csv",
        "--controller",
        "computed-torque",
        "--torque-noise",
        noise,
        "--seed",
        "2",
    ];
    folder.succeed(&[&run[..], &rest].concat());
    folder
}

fn identify(folder: &Folder, method: &str) -> (String, Value) {
    let said = folder.succeed(&[
        "identify",
        "arm.robot",
        "log.csv",
        "--method",
        method,
        "--json",
        "out.json",
    ]);
    (said, json(&folder.read("out.json")))
}

fn value(list: &Value, name: &str) -> f64 {
    let mut list = list.as_array().expect("a list").iter();
    let found = list.find(|entry| entry["name"] == name).expect("the name");
    found["value"].as_f64().expect("a number")
}

fn least_of_link(standard: &Value, link: &str) -> f64 {
    let elements = [
        "m", "mx", "my", "mz", "ixx", "ixy", "ixz", "iyy", "iyz", "izz",
    ];
    let ten = elements.map(|element| value(standard, &format!("{link}.{element}")));
    Inertial::from(ten)
        .pseudo_inertia()
        .symmetric_eigenvalues()
        .min()
}

#[test]
fn noise_makes_no_impossible_arm() {
    let folder = folder("3");
    let (_, free) = identify(&folder, "wls");
    let (said, out) = identify(&folder, "physical");
    // Friction that drives, from this log.
    assert!(
        value(&free["parameters"], "lower.viscous_friction.fv") < 0.0,
        "{free}"
    );
    assert!(
        said.contains("border of what is possible: `lower.viscous_friction.fv`"),
        "{said}"
    );
    let possible = &out["possible"];
    let standard = &possible["standard"];
    for link in ["upper", "lower"] {
        assert!(least_of_link(standard, link) > 0.0, "{standard}");
    }
    for joint in ["upper", "lower"] {
        assert!(value(standard, &format!("{joint}.viscous_friction.fv")) > 0.0);
    }
    let (with, without) = (
        numbers(&out["relative_percent"]),
        numbers(&possible["relative_percent_unconstrained"]),
    );
    for (with, without) in with.iter().zip(&without) {
        assert!(*with < 1.05 * without, "{out}");
    }
    assert!(free["possible"].is_null());
    // What is written can be read: the arm in standard parameters.
    folder.write("standard.json", &format!("{{\"parameters\": {standard}}}"));
    let arguments = [
        "emit",
        "arm.robot",
        "--lang",
        "rust",
        "--parameters",
        "standard.json",
        "--out",
        "page",
    ];
    folder.succeed(&arguments);
}

#[test]
fn what_is_possible_already_stays_as_it_is() {
    let folder = folder("0.001");
    let (_, free) = identify(&folder, "wls");
    let (said, out) = identify(&folder, "physical");
    assert!(!said.contains("border"), "{said}");
    let pairs = free["parameters"].as_array().expect("a list").iter();
    for (free, held) in pairs.zip(out["parameters"].as_array().expect("a list")) {
        let number = |of: &Value, what: &str| of[what].as_f64().expect("a number");
        let moved = (number(free, "value") - number(held, "value")).abs();
        assert!(moved < 0.1 * number(free, "std"), "{free} {held}");
    }
}

#[test]
fn a_robot_of_energies_has_no_bodies() {
    let folder = Folder::new();
    folder.write(
        "swing.robot",
        "robot Swing { coordinates q; parameters i: kg*m^2; kinetic = 1/2 * i * dot(q)^2; potential = 0 * q; }",
    );
    let mut log = String::from("time,q1,tau1\n");
    for k in 0..2000 {
        let t = f64::from(k) / 200.0;
        let (q, tau) = ((2.0 * t).sin(), -8.0 * (2.0 * t).sin());
        writeln!(log, "{t},{q},{tau}").expect("a string takes all");
    }
    folder.write("log.csv", &log);
    let said = folder.refuse(&["identify", "swing.robot", "log.csv", "--method", "physical"]);
    assert!(said.contains("has no links"), "{said}");
}

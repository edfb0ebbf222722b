//! `identify --method physical`.

use std::fmt::Write;

use robot_model::Inertial;
use serde_json::Value;

use crate::verbs::common::{Folder, PENDULUM, json, numbers, white};

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
        said.contains("boundary of physical possibility: `lower.viscous_friction.fv`"),
        "{said}"
    );
    assert!(said.contains("found by Newton's method with log-determinant barriers in "));
    // What is held has no deviation: not in the table, not in the file.
    let held = said
        .lines()
        .find(|line| line.starts_with("lower.viscous_friction.fv"));
    let held: Vec<&str> = held.expect("a row").split_whitespace().skip(2).collect();
    assert_eq!(held, ["-", "-"]);
    let parameters = out["parameters"].as_array().expect("a list");
    for parameter in parameters {
        let is_held = parameter["name"] == "lower.viscous_friction.fv";
        assert_eq!(parameter["std"].is_null(), is_held, "{parameter}");
    }
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
    // The spec has no nominal bodies, so no value is near one.
    let from = standard.as_array().expect("a list").iter();
    let from: Vec<&str> = from.filter_map(|entry| entry["from"].as_str()).collect();
    assert!(from.contains(&"logs") && from.contains(&"assumed"));
    assert!(!from.contains(&"nominal"), "{standard}");
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

/// The lower joint stands, and CAD has half as much again of its link: the logs tell the upper one only together with it.
#[test]
fn what_logs_do_not_tell_is_no_claim_of_the_possible_arm() {
    const LOWER: f64 = 0.4;
    let folder = Folder::new();
    let arm = PENDULUM.replace("\n}\n", "\n    effects { viscous_friction on all; }\n}\n");
    folder.write("true.robot", &arm);
    let heavier = arm.replace("mass = 1; com = [-0.2", "mass = 1.5; com = [-0.2");
    folder.write("arm.robot", &heavier);
    folder.write("values.json", VALUES);
    let mut motion = Vec::new();
    for k in 0..3000 {
        let t = f64::from(k) / 200.0;
        let (slow, fast) = ((1.3 * t).sin_cos(), (2.9 * t).sin_cos());
        let q = 0.6 * slow.0 + 0.2 * fast.0;
        let dq = 0.6 * 1.3 * slow.1 + 0.2 * 2.9 * fast.1;
        let ddq = -0.6 * 1.69 * slow.0 - 0.2 * 8.41 * fast.0;
        motion.push((t, [q, dq, ddq]));
    }
    let states = motion.iter().map(|(_, [q, dq, ddq])| {
        serde_json::json!({"q": [q, LOWER], "dq": [dq, 0.0], "ddq": [ddq, 0.0]})
    });
    let states = serde_json::json!({"states": states.collect::<Vec<Value>>()});
    folder.write("states.json", &states.to_string());
    let torques = |spec: &str, values: &str| -> Vec<Vec<f64>> {
        let eval = ["--states", "states.json", "--parameters", values];
        let out = json(&folder.succeed(&[&["eval", spec][..], &eval].concat()));
        let states = out["states"].as_array().expect("a list").iter();
        states.map(|state| numbers(&state["torque"])).collect()
    };
    let so = torques("true.robot", "values.json");
    let mut noise = 7;
    let mut log = String::from("time,q1,q2,tau1,tau2\n");
    for ((t, [q, ..]), tau) in motion.iter().zip(&so) {
        let upper = tau[0] + 0.1 * white(&mut noise);
        writeln!(log, "{t},{q},{LOWER},{upper},{}", tau[1]).expect("a string takes all");
    }
    folder.write("log.csv", &log);
    let said = folder.refuse(&["identify", "arm.robot", "log.csv"]);
    assert!(said.contains("physical"), "{said}");

    let (table, out) = identify(&folder, "physical");
    let parameters = out["parameters"].as_array().expect("a list");
    let own = |name: &str| parameters.iter().find(|p| p["name"] == name).expect(name);
    for name in ["upper.mxr", "upper.my", "upper.izzr", "lower.mxr"] {
        assert!(own(name)["value"].is_null() && own(name)["std"].is_null());
        let line = table.lines().find(|line| line.starts_with(name));
        assert!(line.expect(name).contains("not separable"), "{table}");
    }
    let friction = &own("upper.viscous_friction.fv")["value"];
    assert!((friction.as_f64().expect("told") - 0.5).abs() < 0.01);
    // up.mxr + cos(0.4) lo.mxr - sin(0.4) lo.my = 1 + 0.2 cos(0.4)
    let combinations = out["combinations"].as_array().expect("a list");
    let first = combinations.iter();
    let mut first = first.filter(|found| found["terms"][0]["name"] == "upper.mxr");
    let first = first.next().expect("a sum");
    let number = |what: &str| first[what].as_f64().expect("a number");
    let truth = 1.0 + 0.2 * LOWER.cos();
    assert!(
        (number("value") - truth).abs() < 4.0 * number("std") && number("std") < 0.01,
        "{first}"
    );
    assert!(table.contains("upper.mxr + 0.9211 lower.mxr - 0.3894 lower.my = "));

    // The possible arm makes that sum, and says where its values are from.
    let standard = &out["possible"]["standard"];
    let from = |name: &str| {
        let mut list = standard.as_array().expect("a list").iter();
        list.find(|entry| entry["name"] == name).expect(name)["from"].clone()
    };
    assert_eq!(from("upper.viscous_friction.fv"), "logs");
    for name in ["upper.mx", "upper.my", "lower.m", "lower.mx"] {
        assert_eq!(from(name), "nominal");
    }
    assert!(table.contains("possible arm (without the constraint): upper "));

    // What reads parameters takes the possible arm: its torque is that of the log.
    let again = torques("arm.robot", "out.json");
    for (again, so) in again.iter().zip(&so) {
        assert!((again[0] - so[0]).abs() < 0.05, "{again:?} {so:?}");
    }
}

/// CAD in grams, on a log that tells little, pulls the arm away from it.
#[test]
fn cad_that_is_far_off_is_told() {
    let folder = folder("0.3");
    let arm = folder
        .read("true.robot")
        .replace(" { mass", ": nominal { mass");
    folder.write("arm.robot", &arm);
    let pulled = |out: &Value| out["possible"]["pulled"].as_array().expect("a list").len();
    let noted = || {
        let arguments = ["identify", "arm.robot", "log.csv", "--method", "physical"];
        let run = folder.run(&arguments);
        run.stderr.contains("the spec's nominal values pull")
    };
    let (_, out) = identify(&folder, "physical");
    assert_eq!((pulled(&out), noted()), (0, false), "{out}");
    let gap = |out: &Value| out["possible"]["gap"].as_f64().expect("a number");
    assert!(gap(&out) < 0.01, "{out}");
    let light = arm.lines().map(|line| match line.split_once("mass = ") {
        Some((before, after)) => {
            let (mass, rest) = after.split_once(';').expect("an end");
            format!("{before}mass = {mass} g;{}", rest.replace("0.0", "0.0000"))
        }
        None => line.to_owned(),
    });
    let light: Vec<String> = light.collect();
    folder.write("arm.robot", &light.join("\n"));
    let (_, far) = identify(&folder, "physical");
    assert!(pulled(&far) > 0 && noted(), "{far}");
    assert!(gap(&far) > 10.0 * gap(&out), "{far}");
}

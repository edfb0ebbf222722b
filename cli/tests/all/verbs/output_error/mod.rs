//! `identify --method output-error`.

mod falling;
mod held;
mod mistakes;

use std::fmt::Write;

use serde_json::Value;

use crate::verbs::common::{Folder, json};

/// A link behind a spring.
fn soft(stiffness: &str) -> String {
    format!(
        "robot Soft {{
            gravity = [0, -9.81, 0];
            convention = standard_dh;
            joint a: revolute {{ a = 0.5; alpha = 0; d = 0; }}
            link a: nominal {{ mass = 3; com = [-0.2, 0, 0]; inertia = [0, 0, 0, 0, 0, 0.06]; }}
            effects {{ motor_inertia on a; viscous_friction on a; joint_elasticity{stiffness} on a; }}
        }}"
    )
}

/// `time,q..` of joints that follow functions of time.
fn wanted(seconds: f64, joints: &[&dyn Fn(f64) -> f64]) -> String {
    let names: Vec<String> = (1..=joints.len()).map(|k| format!("q{k}")).collect();
    let mut text = format!("time,{}\n", names.join(","));
    let mut t = 0.0;
    while t <= seconds + 1e-9 {
        let places: Vec<String> = joints.iter().map(|joint| joint(t).to_string()).collect();
        writeln!(text, "{t},{}", places.join(",")).expect("a string takes all");
        t += 0.005;
    }
    text
}

fn value(report: &Value, name: &str) -> Option<[f64; 2]> {
    let parameters = report["parameters"].as_array().expect("a list");
    let found = parameters.iter().find(|entry| entry["name"] == name)?;
    Some([found["value"].as_f64()?, found["std"].as_f64()?])
}

fn costs(report: &Value) -> Vec<f64> {
    let iterates = report["iterates"].as_array().expect("a list");
    let costs = iterates.iter().map(|iterate| iterate["cost"].as_f64());
    costs.collect::<Option<_>>().expect("numbers")
}

/// Inertia of a first motor and of its link are one base parameter, and least squares bends the spring by both.
#[test]
fn a_spring_behind_a_motor_is_found_with_both_of_its_ends() {
    let folder = Folder::new();
    folder.write("arm.robot", &soft("(stiffness = 500)"));
    folder.write("open.robot", &soft(""));
    folder.write(
        "values.json",
        r#"{"a.motor_inertia.ia": 0.3, "a.viscous_friction.fv": 0.8}"#,
    );
    let swing = |t: f64| 0.6 * (3.0 * t).sin() + 0.2 * (11.0 * t).cos();
    folder.write("wanted.csv", &wanted(2.0, &[&swing]));
    let motion = ["--trajectory", "wanted.csv", "--out", "log.csv"];
    let more = ["--parameters", "values.json", "--frequency", "20"];
    folder.succeed(&[&["simulate", "arm.robot"], &motion[..], &more].concat());
    let start = r#"{"a.motor_inertia.ia": 0.2, "a.viscous_friction.fv": 0.5, "a.joint_elasticity.stiffness": 800}"#;
    folder.write("start.json", start);
    let basics = ["identify", "open.robot", "log.csv", "--json", "fit.json"];
    let options = ["--method", "output-error", "--start", "start.json"];
    folder.succeed(&[&basics[..], &options, &["--window", "2"]].concat());
    let report = json(&folder.read("fit.json"));
    for (name, expected) in [
        ("a.motor_inertia.ia", 0.3),
        ("a.viscous_friction.fv", 0.8),
        ("a.joint_elasticity.stiffness", 500.0),
    ] {
        let [found, std] = value(&report, name).expect("a value");
        assert!(
            (found - expected).abs() < 2e-3 * expected,
            "{name}: {found}"
        );
        assert!(std > 0.0 && std < 0.01 * expected, "{name}: {std}");
    }
    // Mass and inertia of the link are one about its joint, which is said.
    assert_eq!(value(&report, "a.m"), None);
    let silent = report["directions"].as_array().expect("a list");
    assert!(
        silent
            .iter()
            .any(|direction| direction["is_silent"] == true),
        "{report:#}"
    );
    folder.succeed(&[&basics[..], &["--method", "wls"]].concat());
    let report = json(&folder.read("fit.json"));
    let biased = report["parameters"]
        .as_array()
        .expect("a list")
        .last()
        .expect("a shape")["value"]
        .as_f64()
        .expect("a value");
    assert!(biased > 600.0, "{biased}");
    // What has both in one sum is a start, too: of the link the spec says what it takes for it.
    let lumped = ["identify", "open.robot", "log.csv", "--json", "both.json"];
    let options = ["--method", "output-error", "--start", "fit.json"];
    let run = folder.run(&[&lumped[..], &options, &["--window", "2"]].concat());
    assert_eq!(run.code, Some(0), "{}", run.stderr);
    let said = "note: fit.json: springs separate parameters that are one sum there (`a.mxr`, `a.izzr`); the search starts from the spec's \
                values of `a.izz`, `a.m`, and from the remainder of each sum for `a.motor_inertia.ia`, `a.mx`";
    assert!(run.stderr.contains(said), "{}", run.stderr);
    let report = json(&folder.read("both.json"));
    // It begins at three times the stiffness, and comes near along a valley.
    for (name, expected, tolerance) in [
        ("a.motor_inertia.ia", 0.3, 0.05),
        ("a.joint_elasticity.stiffness", 500.0, 25.0),
    ] {
        let [found, _] = value(&report, name).expect("a value");
        assert!((found - expected).abs() < tolerance, "{name}: {found}");
    }
}

/// The spec's link alone has more inertia than the sum of a fit.
#[test]
fn a_motor_has_a_share_of_a_sum_that_is_less_than_the_specs_link() {
    let folder = Folder::new();
    folder.write("open.robot", &soft(""));
    folder.write("arm.robot", &soft("(stiffness = 500)"));
    folder.write(
        "values.json",
        r#"{"a.motor_inertia.ia": 0.3, "a.viscous_friction.fv": 0.8}"#,
    );
    let swing = |t: f64| 0.6 * (3.0 * t).sin() + 0.2 * (11.0 * t).cos();
    folder.write("wanted.csv", &wanted(1.0, &[&swing]));
    let motion = ["--trajectory", "wanted.csv", "--out", "log.csv"];
    let more = ["--parameters", "values.json", "--frequency", "20"];
    folder.succeed(&[&["simulate", "arm.robot"], &motion[..], &more].concat());
    let fit = r#"{"a.mxr": 0.9, "a.my": 0, "a.izzr": -0.6, "a.viscous_friction.fv": 0.5, "a.joint_elasticity.stiffness": 800}"#;
    folder.write("fit.json", fit);
    let basics = ["identify", "open.robot", "log.csv", "--json", "both.json"];
    let options = ["--method", "output-error", "--start", "fit.json"];
    let run = folder.run(&[&basics[..], &options].concat());
    assert_eq!(run.code, Some(0), "{}", run.stderr);
    let said = "note: fit.json: springs separate parameters that are one sum there (`a.mxr`, `a.izzr`); the search starts from \
                scaled-down spec values of `a.izz`, `a.m`, as the full ones would leave no motor inertia, and from the remainder of each sum for \
                `a.motor_inertia.ia`, `a.mx`\n";
    assert!(run.stderr.contains(said), "{}", run.stderr);
    let report = json(&folder.read("both.json"));
    let [found, _] = value(&report, "a.motor_inertia.ia").expect("a value");
    assert!((found - 0.3).abs() < 0.05, "{found}");
}

/// What deviations do not know of is noted: noise of the torque, and torques of the other sign.
#[test]
fn what_moves_the_arm_beside_its_model_is_noted() {
    let folder = Folder::new();
    let spec = "robot Arm {
        gravity = [0, -9.81, 0];
        convention = standard_dh;
        joint a: revolute { a = 0.5; alpha = 0; d = 0; }
        link a { mass = 2; com = [-0.25, 0, 0]; inertia = [0, 0, 0, 0, 0, 0.05]; }
        effects { viscous_friction on a; coulomb_friction on a; }
    }";
    folder.write("arm.robot", spec);
    let values = r#"{"a.viscous_friction.fv": 0.5, "a.coulomb_friction.fc": 1}"#;
    folder.write("values.json", values);
    let swing = |t: f64| 0.6 * (2.0 * t).sin() + 0.3 * (5.0 * t).cos();
    folder.write("wanted.csv", &wanted(3.0, &[&swing]));
    let note = "errors of simulated positions exceed the noise of the logs";
    for (noise, is_noted) in [("0", false), ("0.2", true)] {
        let motion = [
            "--trajectory",
            "wanted.csv",
            "--parameters",
            "values.json",
            "--out",
            "log.csv",
        ];
        let sensors = [
            "--position-noise",
            "1e-4",
            "--torque-noise",
            noise,
            "--rate",
            "500",
        ];
        folder.succeed(&[&["simulate", "arm.robot"], &motion[..], &sensors].concat());
        let run = folder.run(&[
            "identify",
            "arm.robot",
            "log.csv",
            "--method",
            "output-error",
        ]);
        assert_eq!(run.code, Some(0), "{}", run.stderr);
        assert_eq!(
            run.stderr.contains(note),
            is_noted,
            "{}{}",
            run.stdout,
            run.stderr
        );
    }
    // The other sign, and a start that nobody has chosen, set on its bound.
    let log = folder.read("log.csv");
    let mut lines = log.lines();
    let mut turned = format!("{}\n", lines.next().expect("a header"));
    for line in lines {
        let (motion, tau) = line.rsplit_once(',').expect("columns");
        let tau: f64 = tau.parse().expect("a number");
        writeln!(turned, "{motion},{}", -tau).expect("a string takes all");
    }
    folder.write("turned.csv", &turned);
    let run = folder.run(&[
        "identify",
        "arm.robot",
        "turned.csv",
        "--method",
        "output-error",
    ]);
    assert!(
        run.stderr
            .contains("below zero by more than three standard deviations"),
        "{}",
        run.stderr
    );
    folder.write("bounds.json", r#"{"a.coulomb_friction.fc": [2, 3]}"#);
    let bounds = ["--method", "output-error", "--bounds", "bounds.json"];
    let said = folder.succeed(&[&["identify", "arm.robot", "log.csv"], &bounds[..]].concat());
    assert!(
        said.contains(
            "held by a bound, not by the logs: `a.viscous_friction.fv`, `a.coulomb_friction.fc`"
        ),
        "{said}"
    );
}

const TWO: &str = "robot TwoLink {
    gravity = [0, -9.81, 0];
    convention = standard_dh;
    joint shoulder: revolute { a = 0.5 m; alpha = 0; d = 0; }
    joint elbow: revolute { a = 0.4 m; alpha = 0; d = 0; offset = 90 deg; }
    link shoulder { mass = 4; com = [-0.28, 0, 0]; inertia = [0, 0, 0, 0.1, 0, 0.1]; }
    link elbow { mass = 2.5; com = [-0.22, 0, 0]; inertia = [0, 0, 0, 0.05, 0, 0.05]; }
    effects { viscous_friction on all; coulomb_friction on all; }
}";

const FRICTION: &str = r#"{"shoulder.viscous_friction.fv": 1.5, "shoulder.coulomb_friction.fc": 2.0, "elbow.viscous_friction.fv": 0.6, "elbow.coulomb_friction.fc": 0.8}"#;

/// Logs of two joints with dry friction.
pub(crate) fn two(seconds: f64, phase: f64, more: &[&str]) -> Folder {
    let folder = Folder::new();
    folder.write("two.robot", TWO);
    folder.write("friction.json", FRICTION);
    let shoulder = |t: f64| 0.6 * (2.3 * t + phase).sin() + 0.2 * (4.1 * t).sin();
    let elbow = |t: f64| 0.7 * (3.1 * t + phase).sin() + 0.2 * (5.3 * t).cos();
    folder.write("wanted.csv", &wanted(seconds, &[&shoulder, &elbow]));
    let motion = ["--trajectory", "wanted.csv", "--out", "log.csv"];
    let values = ["--parameters", "friction.json", "--torque-noise", "0.02"];
    folder.succeed(&[&["simulate", "two.robot"][..], &motion, &values, more].concat());
    folder
}

/// Along edges of the cost, which turns of dry joints make, a search could creep for hundreds of steps.
#[test]
fn a_search_ends_where_steps_are_within_noise() {
    let folder = two(3.0, 0.3, &["--encoder-bits", "16"]);
    let identify = ["identify", "two.robot", "log.csv", "--json", "fit.json"];
    folder.succeed(&[&identify[..], &["--method", "output-error"]].concat());
    let report = json(&folder.read("fit.json"));
    assert_eq!(report["is_converged"], true);
    let iterates = report["iterates"].as_array().expect("a list");
    let last = iterates.last().expect("one");
    let simulations = last["simulations"].as_u64().expect("a count");
    assert!(simulations < 200, "{simulations}");
    for (name, truth) in [
        ("shoulder.viscous_friction.fv", 1.5),
        ("elbow.coulomb_friction.fc", 0.8),
    ] {
        let [found, std] = value(&report, name).expect("a value");
        assert!((found - truth).abs() < 4.0 * std, "{name}: {found} {std}");
        assert!(std < 0.05 * truth, "{name}: {std}");
    }
}

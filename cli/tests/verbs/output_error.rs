//! `identify --method output-error`.

use std::fmt::Write;

use serde_json::Value;

use crate::common::{Folder, json};

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
}

/// Two links that are let go, as in Trojanova et al., and their parameters.
fn falling() -> (Folder, [(&'static str, f64); 10]) {
    let folder = Folder::new();
    let spec = "robot Arm {
        gravity = [0, -9.81, 0];
        convention = standard_dh;
        joint up: revolute { a = 0.552; alpha = 0; d = 0; }
        joint lo: revolute { a = 0.4; alpha = 0; d = 0; }
        effects { viscous_friction on all; coulomb_friction on all; }
    }";
    folder.write("arm.robot", spec);
    // Of their table 6, about the ends of the links.
    let (m, l, c, i) = ([6.813, 3.361], [0.552, 0.4], [0.346, 0.212], [0.264, 0.012]);
    let about_end = |k: usize| i[k] + m[k] * (c[k] - l[k]) * (c[k] - l[k]) - l[k] * l[k] * m[k];
    let truth = [
        ("up.mxr", m[0] * c[0] + m[1] * l[0]),
        ("up.my", 0.0),
        ("up.izzr", about_end(0) - l[0] * l[0] * m[1]),
        ("lo.mxr", m[1] * c[1]),
        ("lo.my", 0.0),
        ("lo.izzr", about_end(1)),
        ("up.viscous_friction.fv", 0.335),
        ("lo.viscous_friction.fv", 0.279),
        ("up.coulomb_friction.fc", 0.203),
        ("lo.coulomb_friction.fc", 0.076),
    ];
    let write = |file: &str, factor: &dyn Fn(usize) -> f64| {
        let entries = truth.iter().enumerate();
        let entries: Vec<String> = entries
            .map(|(k, (name, value))| format!("\"{name}\": {}", value * factor(k)))
            .collect();
        folder.write(file, &format!("{{{}}}", entries.join(",")));
    };
    write("values.json", &|_| 1.0);
    write("start.json", &|k| match k {
        0 => 1.0,
        k if k % 2 == 0 => 1.1,
        _ => 0.93,
    });
    folder.write("wanted.csv", &wanted(1.5, &[&|_| -1.1, &|_| 0.3]));
    let motion = ["--trajectory", "wanted.csv", "--out", "log.csv"];
    let free = ["--controller", "none", "--rate", "200"];
    let values = ["--parameters", "values.json"];
    folder.succeed(&[&["simulate", "arm.robot"], &motion[..], &free, &values].concat());
    // What is weighed.
    let bounds = format!("{{\"up.mxr\": [{0}, {0}]}}", truth[0].1);
    folder.write("bounds.json", &bounds);
    (folder, truth)
}

#[test]
fn what_falls_freely_needs_a_start() {
    let (folder, _) = falling();
    let identify = ["identify", "arm.robot", "log.csv", "--method"];
    let run = folder.run(&[&identify[..], &["output-error"]].concat());
    assert_ne!(run.code, Some(0));
    let said = &run.stderr;
    assert!(
        said.contains("of an arm that is let go give `--start`"),
        "{said}"
    );
    assert!(!said.contains("does the arm move"), "{said}");
}

/// Without a torque nothing tells how heavy they are.
#[test]
fn what_falls_freely_is_known_up_to_a_common_factor() {
    let (folder, truth) = falling();
    let basics = [
        "identify",
        "arm.robot",
        "log.csv",
        "--method",
        "output-error",
    ];
    let options = [
        "--start",
        "start.json",
        "--window",
        "9",
        "--json",
        "fit.json",
    ];
    let searches = [
        vec!["--search", "levenberg-marquardt"],
        vec!["--search", "trust-region"],
        vec!["--search", "trust-region", "--bounds", "bounds.json"],
    ];
    for (k, search) in searches.iter().enumerate() {
        let said = folder.succeed(&[&basics[..], &options, search].concat());
        let report = json(&folder.read("fit.json"));
        assert_eq!(report["is_converged"], true, "{said}");
        let fits = report["position"]["nrmse_fit_percent"].as_array();
        for fit in fits.expect("a list") {
            assert!(fit.as_f64().expect("a number") > 99.999, "{said}");
        }
        // The rest is known up to a factor, or with what is weighed altogether.
        assert_eq!(report["rank"], truth.len() - 1, "{said}");
        let directions = report["directions"].as_array().expect("a list");
        if k == 2 {
            assert_eq!(report["at_bounds"], serde_json::json!(["up.mxr"]));
            assert!(
                said.contains("held by a bound, not by the logs: `up.mxr`"),
                "{said}"
            );
            assert!(
                directions
                    .iter()
                    .all(|direction| direction["is_silent"] == false)
            );
            for (name, expected) in &truth[1..] {
                let [found, std] = value(&report, name).expect("a value");
                assert!(
                    (found - expected).abs() < 1e-3 && std > 0.0,
                    "{name}: {found}"
                );
            }
        } else {
            let silent = directions.last().expect("one");
            assert_eq!(silent["is_silent"], true, "{said}");
            assert_eq!(silent["is_common_factor"], true, "{said}");
            assert!(said.contains("a common factor of up.mxr,"), "{said}");
            // No value of any is claimed, however little it does.
            for (name, truth) in &truth {
                assert!(
                    *truth == 0.0 || value(&report, name).is_none(),
                    "{name}: {said}"
                );
            }
            // The last iterate has the ratios.
            let last = report["iterates"]
                .as_array()
                .and_then(|all| all.last())
                .expect("one");
            let found = last["values"].as_array().expect("a list");
            let found: Vec<f64> = found
                .iter()
                .map(|x| x.as_f64().expect("a number"))
                .collect();
            for (k, (name, expected)) in truth.iter().enumerate() {
                let ratio = found[k] / found[0] * truth[0].1;
                assert!(
                    (ratio - expected).abs() < 1e-3,
                    "{name}: {ratio} {expected}"
                );
            }
        }
        let costs = costs(&report);
        assert!(costs.len() >= 4, "{said}");
        let stages: Vec<&Value> = report["iterates"]
            .as_array()
            .expect("a list")
            .iter()
            .map(|iterate| &iterate["stage"])
            .collect();
        for (pair, stage) in costs.windows(2).zip(stages.windows(2)) {
            assert!(pair[1] <= pair[0] || stage[0] != stage[1], "{said}");
        }
    }
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
    let note = "simulated positions are off by more than the noise of the logs";
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
            .contains("below zero by more than three deviations"),
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

/// An arm with a log of one joint, and files with mistakes.
fn mistaken() -> Folder {
    let folder = Folder::new();
    folder.write("arm.robot", &soft("(stiffness = 500)"));
    folder.write(
        "start.json",
        r#"{"a.motor_inertia.ia": 0.3, "a.viscous_friction.fv": 0.8}"#,
    );
    let mut log = String::from("time,q1,tau1,ref1\n");
    for k in 0..400 {
        let t = 0.005 * f64::from(k);
        let (q, tau) = (0.3 * (3.0 * t).sin(), 5.0 * (3.0 * t).cos());
        writeln!(log, "{t},{q},{tau},{q}").expect("a string takes all");
    }
    folder.write("log.csv", &log);
    folder.write(
        "two.json",
        r#"{"joints": [{"position": [1]}, {"position": [1]}]}"#,
    );
    folder.write("typo.json", r#"{"joints": [{"positions": [1]}]}"#);
    folder.write("other.json", r#"{"joints": [{"columns": {"qref1": [1]}}]}"#);
    folder.write(
        "limit.json",
        r#"{"joints": [{"position": [-1], "limit": 0}]}"#,
    );
    folder.write("wild.json", r#"{"joints": [{"position": [1e9]}]}"#);
    folder.write("far.json", r#"{"a.viscous_friction.fv": [1, 2]}"#);
    folder.write("name.json", r#"{"a.fv": [1, 2]}"#);
    folder.write("fall.json", r#"{"a.viscous_friction.fv": [2, 1]}"#);
    folder
}

#[test]
fn what_a_simulation_cannot_take_is_told() {
    let folder = mistaken();
    let basics = ["identify", "arm.robot", "log.csv"];
    let simulated = ["--method", "output-error", "--start", "start.json"];
    for (options, word) in [
        (
            &["--start", "start.json"][..],
            "`--start` is of `--method output-error`",
        ),
        (
            &["--method", "wls", "--window", "1"],
            "`--window` is of `--method output-error`",
        ),
        (
            &["--method", "output-error", "--prior", "0.2"],
            "`--prior` is of methods with equations",
        ),
        (
            &["--method", "output-error", "--form", "filtered"],
            "`--form filtered` is of methods",
        ),
        (
            &["--method", "output-error"],
            "nor does the spec: arm.robot: no value for `a.motor_inertia.ia`, ",
        ),
        (
            &[&simulated[..], &["--window", "0.02"]].concat(),
            "too few samples for a motion",
        ),
        (
            &[&simulated[..], &["--window", "0"]].concat(),
            "`--window` has to be positive",
        ),
        (
            &[&simulated[..], &["--controller", "two.json"]].concat(),
            "has 2 laws for an arm with 1 joint",
        ),
        (
            &[&simulated[..], &["--controller", "typo.json"]].concat(),
            "unknown field `positions`",
        ),
        (
            &[&simulated[..], &["--controller", "other.json"]].concat(),
            "no column `qref1`, which the controller reads",
        ),
        (
            &[&simulated[..], &["--controller", "limit.json"]].concat(),
            "joint a: `limit` has to be positive",
        ),
        (
            &[&simulated[..], &["--controller", "wild.json"]].concat(),
            "with the parameters that the search starts from",
        ),
        (
            &[&simulated[..], &["--bounds", "far.json"]].concat(),
            "starts at 0.8, outside of its bounds 1 .. 2",
        ),
        (
            &[
                &simulated[..],
                &["--controller", "limit.json", "--hold", "mean"],
            ]
            .concat(),
            "`--hold` is of arms that the logged torque drives",
        ),
        (
            &[&simulated[..], &["--bounds", "name.json"]].concat(),
            "no parameter is called `a.fv`",
        ),
        (
            &[&simulated[..], &["--bounds", "fall.json"]].concat(),
            "two numbers that rise",
        ),
    ] {
        let said = folder.refuse(&[&basics[..], options].concat());
        assert!(said.contains(word), "{options:?}: {said}");
    }
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

#[test]
fn a_log_without_a_motion_is_refused_at_once() {
    let folder = mistaken();
    let mut log = String::from("time,q1,tau1\n");
    for k in 0..4000 {
        let t = 0.005 * f64::from(k);
        writeln!(log, "{t},0.3,2").expect("a string takes all");
    }
    folder.write("still.csv", &log);
    let identify = ["identify", "arm.robot", "still.csv", "--method"];
    let run = folder.run(&[&identify[..], &["output-error", "--start", "start.json"]].concat());
    assert_ne!(run.code, Some(0));
    assert!(
        run.stderr.contains("no joint moves in these logs"),
        "{}",
        run.stderr
    );
}

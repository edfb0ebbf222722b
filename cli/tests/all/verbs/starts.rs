//! Output error without a start of its own, where the cost has several valleys.

use std::fmt::Write;

use crate::verbs::common::{Folder, json};

/// Least squares sees a Stribeck curve through its filters, and the search from there ends in a valley beside the arm's.
#[test]
fn the_valley_of_a_stribeck_curve_is_found() {
    let folder = Folder::new();
    let arm = |shape: &str| {
        format!(
            "robot A {{
                gravity = [0, -9.81, 0];
                convention = standard_dh;
                joint up: revolute {{ a = 0.5; alpha = 0; d = 0; }}
                link up {{ mass = 2; com = [-0.25, 0, 0]; inertia = [0, 0, 0, 0, 0, 0.05]; }}
                effects {{ viscous_friction on up; coulomb_friction on up; stribeck{shape} on up; }}
            }}"
        )
    };
    folder.write("arm.robot", &arm("(vs = 0.08)"));
    folder.write("open.robot", &arm(""));
    let truth = [
        ("up.viscous_friction.fv", 1.0),
        ("up.coulomb_friction.fc", 1.2),
        ("up.stribeck.fs", 0.8),
    ];
    let values = truth.map(|(name, value)| format!("\"{name}\": {value}"));
    folder.write("values.json", &format!("{{{}}}", values.join(", ")));
    let mut wanted = String::from("time,q1\n");
    for k in 0..=800 {
        let t = 0.005 * f64::from(k);
        let waves = WAVES.map(|(size, rate, shift)| size * f64::sin(rate * t + shift));
        writeln!(wanted, "{t},{}", -1.2 + waves.iter().sum::<f64>()).expect("a string takes all");
    }
    folder.write("wanted.csv", &wanted);
    let motion = ["--trajectory", "wanted.csv", "--out", "log.csv"];
    let more = [
        "--parameters",
        "values.json",
        "--encoder-bits",
        "18",
        "--seed",
        "6",
    ];
    folder.succeed(&[&["simulate", "arm.robot"], &motion[..], &more].concat());
    let identify = ["identify", "open.robot", "log.csv", "--json", "fit.json"];
    let run = folder.run(&[&identify[..], &["--method", "output-error"]].concat());
    assert_eq!(run.code, Some(0), "{}", run.stderr);
    assert!(
        run.stderr.contains("searching from start 6 of"),
        "{}",
        run.stderr
    );
    assert!(!run.stderr.contains("beyond"), "{}", run.stderr);
    let fit = json(&folder.read("fit.json"));
    let parameters = fit["parameters"].as_array().expect("a list");
    for (name, expected) in truth.into_iter().chain([("up.stribeck.vs", 0.08)]) {
        let found = parameters
            .iter()
            .find(|parameter| parameter["name"] == name);
        let value = found.expect(name)["value"].as_f64().expect("a number");
        assert!(
            (value - expected).abs() < 0.01 * expected,
            "{name}: {value}"
        );
    }
}

/// Sizes, rad, rates, rad/s, and shifts of the wanted motion.
const WAVES: [(f64, f64, f64); 3] = [
    (0.5989, 0.8911, 2.4767),
    (0.2810, 1.7653, 1.6578),
    (0.3423, 1.9938, 1.9240),
];

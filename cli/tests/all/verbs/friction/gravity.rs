//! Friction beside gravity: of one joint of two, over short ways, and of a lift.

use std::fmt::Write;

use super::motion::Motion;
use super::number;
use crate::verbs::common::{Folder, close, json, white};

/// An arm that hangs down, whose lower joint has dry and viscous friction.
fn two(effects: &str) -> String {
    format!(
        "robot Two {{
            gravity = [0, -9.81, 0];
            convention = standard_dh;
            joint up: revolute {{ a = 0.5; alpha = 0; d = 0; }}
            joint lo: revolute {{ a = 0.4; alpha = 0; d = 0; }}
            link up {{ mass = 2; com = [-0.25, 0, 0]; inertia = [0.001, 0, 0, 0.05, 0, 0.05]; }}
            link lo {{ mass = 1; com = [-0.2, 0, 0]; inertia = [0.001, 0, 0, 0.02, 0, 0.02]; }}
            effects {{ viscous_friction on all; coulomb_friction on all; {effects} }}
        }}"
    )
}

const TWO: &str = r#"{"up.viscous_friction.fv": 1.0, "up.coulomb_friction.fc": 1.5, "lo.viscous_friction.fv": 0.5, "lo.coulomb_friction.fc": 0.7"#;

/// Logs of the arm of two joints, whose torque has an offset that its spec does not say: the lower joint moves, the upper one stands.
fn lower(motions: &[(&str, &Motion)]) -> Folder {
    let folder = Folder::new();
    folder.write("two.robot", &two(""));
    folder.write("biased.robot", &two("torque_offset on lo;"));
    folder.write("values.json", &format!("{TWO}}}"));
    folder.write(
        "biased.json",
        &format!(r#"{TWO}, "lo.torque_offset.offset": 0.3}}"#),
    );
    for (log, motion) in motions {
        folder.write("wanted.csv", &motion.csv(&[-0.9]));
        let simulate = ["simulate", "biased.robot", "--parameters", "biased.json"];
        let out = [
            "--trajectory",
            "wanted.csv",
            "--out",
            log,
            "--log-rate",
            "500",
        ];
        let sensors = ["--encoder-bits", "20", "--torque-noise", "0.005"];
        let stiff = ["--controller", "computed-torque", "--frequency", "100"];
        folder.succeed(&[&simulate[..], &out, &sensors, &stiff].concat());
    }
    folder
}

/// Gravity is fitted, or comes from parameters.
#[test]
fn the_curve_of_one_joint_of_two() {
    let mut motion = Motion::new(-1.0);
    for speed in [0.2, 0.4, 0.7, 1.1, 1.6] {
        let seconds = (2.0_f64 / speed).min(2.5);
        motion.run(speed, seconds);
        motion.run(-speed, seconds);
    }
    let folder = lower(&[("log.csv", &motion)]);
    let friction = [
        "friction",
        "two.robot",
        "log.csv",
        "--joint",
        "lo",
        "--json",
        "f.json",
    ];
    for known in [&[][..], &["--parameters", "values.json"]] {
        let said = folder.succeed(&[&friction[..], known].concat());
        let report = json(&folder.read("f.json"));
        let points = report["points"].as_array().expect("a list");
        assert_eq!(points.len(), 10, "{said}");
        for point in points {
            let v = number(&point["speed"]);
            let truth = 0.7 * v.signum() + 0.5 * v + 0.3;
            close(number(&point["torque"]), truth, 0.02);
        }
        let law = &report["law"];
        for (name, truth) in [("coulomb", 0.7), ("viscous", 0.5), ("offset", 0.3)] {
            close(number(&law[name]["value"]), truth, 0.005);
        }
        assert_eq!(report["rank"].is_null(), !known.is_empty(), "{said}");
        let spec = report["spec"].as_str().expect("text");
        assert!(spec.contains("torque_offset on lo;"), "{spec}");
    }
}

/// A few degrees, there and back and one way; and ever elsewhere, over less than a degree each.
#[test]
fn short_ways_do_not_tell_gravity() {
    let (mut short, mut one_way) = (Motion::new(0.5), Motion::new(0.5));
    let mut apart = Motion::new(0.0);
    for speed in [0.05, 0.08, 0.12, 0.2] {
        for motion in [&mut short, &mut one_way] {
            motion.run(speed, 0.5);
        }
        short.run(-speed, 0.5);
        apart.run(0.03 * speed, 0.5);
        for acceleration in [4.0, -4.0] {
            apart.accelerate(acceleration, 0.25);
        }
        apart.accelerate(0.0, 0.2);
    }
    let motions = [
        ("short.csv", &short),
        ("one_way.csv", &one_way),
        ("apart.csv", &apart),
    ];
    let folder = lower(&motions);
    // Gravity of a few degrees is as good as an offset: friction is the difference of both ways.
    let friction = [
        "friction",
        "two.robot",
        "short.csv",
        "--joint",
        "lo",
        "--json",
        "f.json",
    ];
    let said = folder.succeed(&friction);
    let report = json(&folder.read("f.json"));
    close(number(&report["law"]["coulomb"]["value"]), 0.7, 0.005);
    assert!(!said.contains("torque_offset"), "{said}");
    let notes = report["notes"].to_string();
    assert!(
        notes.contains("a constant torque of the rigid body"),
        "{notes}"
    );
    for log in ["one_way.csv", "apart.csv"] {
        let near = ["friction", "two.robot", log, "--joint", "lo"];
        let said = folder.refuse(&near);
        assert!(
            said.contains("cannot be separated from friction: of 2 columns"),
            "{said}"
        );
        assert!(said.contains("--parameters"), "{said}");
        folder.succeed(&[&near[..], &["--parameters", "values.json"]].concat());
    }
}

/// A lift's weight is the same at all places: both ways tell it from friction, one does not.
#[test]
fn the_weight_of_a_lift_is_an_offset() {
    let folder = Folder::new();
    folder.write(
        "lift.robot",
        "robot Lift { gravity = [0, 0, -9.81]; convention = origin; joint lift: prismatic { xyz = [0, 0, 0]; axis = [0, 0, 1]; link = cage; } }",
    );
    let log = |ways: &[f64]| {
        let mut text = String::from("time,q1,tau1");
        let (mut q, mut k, mut noise) = (0.0, 0, 1);
        for speed in [0.1, 0.2, 0.3, 0.4] {
            for way in ways {
                let v = way * speed;
                for _ in 0..400 {
                    let tau = 30.0 + 5.0 * way + 8.0 * v + 0.1 * white(&mut noise);
                    write!(text, "\n{:.3},{q:.9},{tau:.6}", 0.005 * f64::from(k)).expect("text");
                    q += 0.005 * v;
                    k += 1;
                }
            }
        }
        text
    };
    folder.write("up.csv", &log(&[1.0]));
    folder.write("both.csv", &log(&[1.0, -1.0]));
    let said = folder.refuse(&["friction", "lift.robot", "up.csv", "--joint", "lift"]);
    assert!(
        said.contains("in one direction") && said.contains("--parameters"),
        "{said}"
    );
    let both = [
        "friction",
        "lift.robot",
        "both.csv",
        "--joint",
        "lift",
        "--json",
        "f.json",
    ];
    let said = folder.succeed(&both);
    let law = &json(&folder.read("f.json"))["law"];
    for (name, truth) in [("coulomb", 5.0), ("viscous", 8.0), ("offset", 30.0)] {
        close(number(&law[name]["value"]), truth, 0.05);
    }
    assert!(
        !said.contains("torque_offset") && said.contains("N s/m"),
        "{said}"
    );
}

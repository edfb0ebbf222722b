//! `trace`: a law that gravity takes in along the traced motion, and that is worth much along another one.

use std::fmt::Write;

use crate::common::{Folder, json};

/// A pendulum, with a spring or without.
fn pendulum(effects: &str) -> String {
    format!(
        "robot Pendulum {{
            gravity = [0, -9.81, 0];
            convention = modified_dh;
            joint one: revolute {{ a = 0; alpha = 0; d = 0; }}
            effects {{ viscous_friction on one; {effects} }}
        }}"
    )
}

/// 30 s about a position, so far to both sides.
fn motion(middle: f64, size: f64) -> String {
    let mut text = "time,q1\n".to_owned();
    for k in 0..15_000 {
        let t = 0.002 * f64::from(k);
        let q = 0.3 * (0.7 * t + middle).sin()
            + 0.16 * (2.3 * t + 1.1).sin()
            + 0.07 * (5.9 * t + 0.4).sin();
        writeln!(text, "{t},{}", middle + size * q).expect("a string");
    }
    text
}

fn simulated(folder: &Folder, stiffness: f64, wanted: &str, log: &str) {
    let values = format!(
        r#"{{"one.izz": 0.5, "one.mx": 1.2, "one.my": 0.1, "one.viscous_friction.fv": 0.3,
        "one.joint_spring.k": {stiffness}, "one.joint_spring.t0": 0}}"#
    );
    folder.write("values.json", &values);
    let simulate = ["simulate", "full.robot", "--parameters", "values.json"];
    let motion = ["--trajectory", wanted, "--rate", "500"];
    let sensors = ["--torque-noise", "0.15", "--encoder-bits", "18"];
    let out = ["--seed", "1", "--out", log];
    folder.succeed(&[&simulate[..], &motion, &sensors, &out].concat());
}

#[test]
fn a_spring_that_gravity_takes_in_is_told_by_what_it_does_elsewhere() {
    let folder = Folder::new();
    folder.write("arm.robot", &pendulum(""));
    folder.write("full.robot", &pendulum("joint_spring on one;"));
    folder.write("near.csv", &motion(-1.45, 1.0));
    folder.write("far.csv", &motion(-0.95, 1.6));
    for (stiffness, is_there) in [(6.0, true), (0.0, false)] {
        simulated(&folder, stiffness, "near.csv", "monday.csv");
        simulated(&folder, stiffness, "far.csv", "tuesday.csv");
        let trace = ["trace", "arm.robot", "monday.csv"];
        let rest = ["--validate", "tuesday.csv", "--json", "out.json"];
        let said = folder.succeed(&[&trace[..], &rest].concat());
        let out = json(&folder.read("out.json"));
        let kinds = |list: &str| -> Vec<String> {
            let list = out[list].as_array().expect("a list").iter();
            list.map(|one| one["kind"].as_str().expect("a kind").to_owned())
                .collect()
        };
        if !is_there {
            assert_eq!(out["outcome"], "nothing-missing", "{said}");
            continue;
        }
        assert_eq!(out["outcome"], "explained", "{said}");
        let named = [kinds("effects"), kinds("alternatives")].concat();
        assert!(named.iter().any(|kind| kind == "joint-spring"), "{said}");
        // Along the traced motion it takes a thirtieth off the raw error.
        let percent = &out["effects"][0]["evidence"]["raw_percent"][0];
        assert!(percent.as_f64().expect("a number") < 5.0, "{said}");
        let error = |when: &str| out[when][0].as_f64().expect("a number");
        assert!(error("rmse_after") < 0.6 * error("rmse_before"), "{said}");
    }
}

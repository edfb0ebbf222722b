//! Joints that dry friction holds where they turn.

use std::fmt::Write;

use crate::verbs::common::{Folder, close, json, moved};
use crate::verbs::delays::late;
use crate::verbs::loads::arm;

/// What is wrong where dry friction holds a joint is more than what 20 ms make, and yet no delay; whether the spec declares it or not.
#[test]
fn a_delay_is_told_of_a_joint_that_sticks_where_it_turns() {
    let folder = Folder::new();
    let spec = |effects: &str| {
        format!(
            "robot Pendulum {{ gravity = [0, -9.81, 0]; convention = standard_dh; joint arm: revolute {{ a = 0; alpha = 0; d = 0; }} \
             effects {{ viscous_friction on all; {effects} }} }}"
        )
    };
    folder.write("smooth.robot", &spec(""));
    folder.write("pendulum.robot", &spec("coulomb_friction on all;"));
    folder.write(
        "numbers.json",
        r#"{"arm.m": 4, "arm.mx": 0.6, "arm.my": 0.05, "arm.mz": 0, "arm.ixx": 0.02, "arm.ixy": 0, "arm.ixz": 0, "arm.iyy": 0.13,
            "arm.iyz": 0, "arm.izz": 0.14, "arm.viscous_friction.fv": 2.5, "arm.coulomb_friction.fc": 3}"#,
    );
    let mut motion = String::from("time,q1\n");
    for k in 0..=2000 {
        let t = 0.01 * f64::from(k);
        let swing = 0.5 * (1.3 * t).sin() + 0.3 * (2.9 * t + 1.0).sin() + 0.12 * (6.1 * t).sin();
        let grows = t.min(1.0).powi(2) * (3.0 - 2.0 * t.min(1.0));
        writeln!(motion, "{t:.2},{:.9}", grows * swing - 0.3).expect("a string takes all");
    }
    folder.write("motion.csv", &motion);
    let simulate = "simulate pendulum.robot --trajectory motion.csv --parameters numbers.json --out log.csv --frequency 30 \
                    --torque-noise 0.01 --encoder-bits 17 --seed 4";
    folder.succeed(&simulate.split_whitespace().collect::<Vec<_>>());
    let log = folder.read("log.csv");
    let cases = [
        ("pendulum.robot", 0, 0),
        ("pendulum.robot", 20, 1),
        ("smooth.robot", 0, 0),
    ];
    for (spec, samples, count) in cases {
        folder.write("late.csv", &late(&log, samples));
        folder.succeed(&["identify", spec, "late.csv", "--json", "out.json"]);
        let faults = json(&folder.read("out.json"))["data_faults"].clone();
        let faults = faults.as_array().expect("a list");
        assert_eq!(faults.len(), count, "{spec}, {samples}: {faults:?}");
        for fault in faults {
            assert_eq!(fault["kind"], "late-torque");
            let seconds = fault["delay"]["value"].as_f64().expect("a number");
            assert!((seconds - 0.02).abs() < 0.002, "{fault}");
        }
    }
}

/// Moves from place to place with dwells of half a second, in which dry friction holds the joint with whatever gravity leaves of its torque.
#[test]
fn dwells_between_two_moves_say_nothing_of_friction() {
    let folder = Folder::new();
    folder.write(
        "arm.robot",
        "robot Pendulum { gravity = [0, -9.81, 0]; convention = standard_dh; joint arm: revolute { a = 0; alpha = 0; d = 0; } \
         effects { viscous_friction on all; coulomb_friction on all; } }",
    );
    folder.write(
        "numbers.json",
        r#"{"arm.m": 4, "arm.mx": 0.6, "arm.my": 0.05, "arm.mz": 0, "arm.ixx": 0.02, "arm.ixy": 0, "arm.ixz": 0, "arm.iyy": 0.13,
            "arm.iyz": 0, "arm.izz": 0.14, "arm.viscous_friction.fv": 2.5, "arm.coulomb_friction.fc": 3}"#,
    );
    let places = [0.0, 0.9, -0.6, 1.3, 0.4, -1.1];
    let mut motion = String::from("time,q1\n");
    // A second of motion, and half a one of none.
    for number in 0..20_u32 {
        let place = |number: u32| places[number as usize % places.len()];
        let (from, to) = (place(number), place(number + 1));
        for k in 0..150_u32 {
            let s = (0.01 * f64::from(k)).min(1.0);
            let share = s.powi(3) * (10.0 - 15.0 * s + 6.0 * s * s);
            let t = 0.01 * f64::from(150 * number + k);
            writeln!(motion, "{t:.2},{:.9}", from + share * (to - from))
                .expect("a string takes all");
        }
    }
    folder.write("motion.csv", &motion);
    let simulate = "simulate arm.robot --trajectory motion.csv --parameters numbers.json --out log.csv --frequency 30 \
                    --torque-noise 0.005 --encoder-bits 17 --seed 4";
    folder.succeed(&simulate.split_whitespace().collect::<Vec<_>>());
    let told = folder.succeed(&["identify", "arm.robot", "log.csv", "--json", "out.json"]);
    assert!(
        told.contains("left out, at long rests held by dry friction"),
        "{told}"
    );
    let out = json(&folder.read("out.json"));
    let parameters = out["parameters"].as_array().expect("a list");
    for (name, truth) in [
        ("arm.viscous_friction.fv", 2.5),
        ("arm.coulomb_friction.fc", 3.0),
    ] {
        let found = parameters.iter().find(|one| one["name"] == name);
        let value = found
            .and_then(|one| one["value"].as_f64())
            .expect("a value");
        assert!((value / truth - 1.0).abs() < 0.01, "{name} {value}\n{told}");
    }
    assert!(
        out["relative_percent"][0]
            .as_f64()
            .is_some_and(|share| share < 2.0),
        "{told}"
    );
}

/// Bristles without a breakaway torque lie in another valley than those with one, from which a search does not come over.
#[test]
fn bristles_are_named_with_their_own_values() {
    let folder = Folder::new();
    let spec = |dry: &str| {
        let effects = format!("motor_inertia on all; coulomb_friction on up; {dry} on lo;");
        arm(Some("nominal"), &effects)
    };
    let values = r#"{"up.viscous_friction.fv": 1.0, "lo.viscous_friction.fv": 0.3, "up.coulomb_friction.fc": 1.5,
        "up.motor_inertia.ia": 0.3, "lo.motor_inertia.ia": 0.1, "lo.lugre_presliding.fc": 1.2, "lo.lugre_presliding.s1": 0.5}"#;
    let truth = spec("lugre_presliding(d = 0.0037, vs = 0.1, rise = 0)");
    moved(&folder, &truth, values, |t| {
        [
            -1.57 + 0.25 * (0.9 * t).sin() + 0.05 * (3.1 * t).sin(),
            0.2 * (1.1 * t).sin() + 0.04 * (4.3 * t).cos(),
        ]
    });
    folder.write("arm.robot", &spec("coulomb_friction"));
    folder.succeed(&["trace", "arm.robot", "log.csv", "--json", "trace.json"]);
    let verdict = json(&folder.read("trace.json"));
    let effects = verdict["effects"].as_array().expect("a list");
    assert_eq!(effects.len(), 1, "{effects:?}");
    assert_eq!(effects[0]["kind"], "lugre-presliding");
    let parameters = effects[0]["parameters"].as_array().expect("a list");
    for (name, truth) in [("fc", 1.2), ("d", 0.0037)] {
        let found = parameters.iter().find(|one| one["name"] == name);
        let found = found.expect("a parameter of bristles")["value"].as_f64();
        close(found.expect("a number"), truth, 0.05 * truth);
    }
}

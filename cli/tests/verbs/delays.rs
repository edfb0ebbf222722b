//! Torque that is not of the time of the position.

use std::fmt::Write;

use crate::common::{CART, Folder, cart_log, json};

/// A log whose torque is so many samples late, or early where that is negative.
fn late(log: &str, samples: isize) -> String {
    let rows: Vec<Vec<&str>> = log
        .lines()
        .skip(1)
        .map(|row| row.split(',').collect())
        .collect();
    let mut text = String::from("time,q1,tau1\n");
    for (k, row) in rows.iter().enumerate() {
        let before = k.checked_add_signed(-samples).and_then(|k| rows.get(k));
        if let Some(before) = before {
            writeln!(text, "{},{},{}", row[0], row[1], before[2]).expect("a string takes all");
        }
    }
    text
}

#[test]
fn torque_that_is_late_is_told_with_its_delay() {
    let folder = Folder::new();
    folder.write("cart.robot", CART);
    let log = cart_log(20, 0.0, 0.0);
    for samples in [4, -4, 20] {
        let delay = 0.005 * f64::from(i32::try_from(samples).expect("small"));
        folder.write("log.csv", &late(&log, samples));
        let run = folder.run(&["identify", "cart.robot", "log.csv", "--json", "out.json"]);
        assert_eq!(run.code, Some(0), "{}", run.stderr);
        let word = if samples > 0 {
            " late against"
        } else {
            " early against"
        };
        assert!(run.stderr.contains(word), "{}", run.stderr);
        assert!(run.stderr.contains("`time_delay;`"), "{}", run.stderr);
        let faults = json(&folder.read("out.json"))["data_faults"].clone();
        let [fault] = &faults.as_array().expect("a list")[..] else {
            panic!("{faults}");
        };
        assert_eq!(
            (&fault["kind"], &fault["channel"]),
            (&"late-torque".into(), &"tau1".into())
        );
        let number = |key: &str| fault["delay"][key].as_f64().expect("a number");
        let (value, std) = (number("value"), number("std"));
        assert!((value - delay).abs() < 4.0 * std && std < 1e-4, "{fault}");
    }
}

/// Torque that is of the time of the position, with friction that the spec knows and with friction that it does not, and torque
/// that holds from sample to sample.
#[test]
fn torque_that_is_not_late_is_no_fault() {
    let folder = Folder::new();
    folder.write("cart.robot", CART);
    let bare = CART.replace("viscous_friction on rail;", "motor_inertia on rail;");
    folder.write("bare.robot", &bare);
    let said = |spec: &str, log: &str| {
        folder.write("log.csv", log);
        let run = folder.run(&["identify", spec, "log.csv", "--partial"]);
        assert_eq!(run.code, Some(0), "{}", run.stderr);
        run.stderr
    };
    for coulomb in [0.0, 4.0] {
        for phase in [0.0, 1.0, 2.0] {
            let log = cart_log(20, coulomb, phase);
            for spec in ["cart.robot", "bare.robot"] {
                let said = said(spec, &log);
                assert!(
                    !said.contains(" against the position"),
                    "{spec} {coulomb}: {said}"
                );
            }
            let held = late(&log, -1);
            assert!(!said("cart.robot", &held).contains(" against the position"));
        }
    }
}

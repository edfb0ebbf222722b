//! Logs in another unit than the spec's, where no limit of a joint tells it.

use std::fmt::Write;

use crate::common::Folder;

const SPEC: &str = "robot P {
    gravity = [0, -9.81, 0];
    convention = standard_dh;
    joint turn: revolute { a = 0.5; alpha = 0; d = 0; }
    LOG
}";

/// A pendulum that swings by 20 degrees; `unit` is what one of the logged positions is worth, rad.
fn log(unit: f64) -> String {
    swinging(unit, 1.0)
}

/// One that swings so many times as far.
fn swinging(unit: f64, times: f64) -> String {
    let mut log = String::from("time,q1,tau1\n");
    for k in 0..4000 {
        let t = f64::from(k) / 200.0;
        let swing = |a: f64, w: f64| {
            let a = times * a;
            (a * (w * t).sin(), -a * w * w * (w * t).sin())
        };
        let ((q, ddq), (more, faster)) = (swing(0.25, 1.7), swing(0.1, 4.3));
        let tau = 0.3 * (ddq + faster) + 2.0 * (q + more).sin();
        writeln!(log, "{t},{},{tau}", (q + more) / unit).expect("a string takes all");
    }
    log
}

#[test]
fn degrees_within_all_limits_are_told_by_the_torques() {
    let folder = Folder::new();
    let declared = SPEC.replace("LOG", "log { q = \"q1\": deg; }");
    folder.write("plain.robot", &SPEC.replace("LOG", ""));
    folder.write("declared.robot", &declared);
    folder.write("degrees.csv", &log(1.0_f64.to_radians()));
    folder.write("radians.csv", &log(1.0));
    let told = |spec: &str, log: &str| {
        let said = folder.run(&["identify", spec, log]).stderr;
        said.contains("are they in degrees? Logs are in rad")
    };
    assert!(told("plain.robot", "degrees.csv"));
    assert!(!told("declared.robot", "degrees.csv"));
    assert!(!told("plain.robot", "radians.csv"));
}

#[test]
fn revolutions_are_told_by_the_torques() {
    let folder = Folder::new();
    folder.write("plain.robot", &SPEC.replace("LOG", ""));
    let declared = SPEC.replace("LOG", "log { q = \"q1\": rev; }");
    folder.write("declared.robot", &declared);
    folder.write("turns.csv", &swinging(std::f64::consts::TAU, 5.0));
    folder.write("radians.csv", &swinging(1.0, 5.0));
    let told = |spec: &str, log: &str| {
        let said = folder.run(&["identify", spec, log]).stderr;
        said.contains("are they in revolutions? Logs are in rad")
    };
    assert!(told("plain.robot", "turns.csv"));
    assert!(!told("declared.robot", "turns.csv"));
    assert!(!told("plain.robot", "radians.csv"));
}

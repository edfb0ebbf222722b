//! Whether torque goes on from sample to sample or is held.

use std::fmt::Write;

use crate::common::Folder;

const SPEC: &str = "robot Upright {
    coordinates th;
    parameters J: kg*m^2, G: kg*m^2/s^2;
    kinetic = J/2*dot(th)^2;
    potential = G*cos(th);
    effects { viscous_friction on all; }
}";

/// A torque that jumps, logged at 30 Hz, and an inertia that shows in what the arm does within a sample of such a jump alone: half a sample
/// is half of it.
#[test]
fn an_inertia_that_hangs_on_what_torque_does_between_samples_is_noted() {
    let folder = Folder::new();
    folder.write("arm.robot", SPEC);
    folder.write(
        "true.json",
        r#"{"J": 0.0467, "G": 0.5626, "th.viscous_friction.fv": 1.621}"#,
    );
    let (mut torque, mut wanted) = (String::from("time,tau1\n"), String::from("time,q1\n"));
    for k in 0..=1700 {
        let t = 0.01 * f64::from(k);
        let wave = (std::f64::consts::TAU * t / 3.3 + 0.3).sin();
        writeln!(torque, "{t:.2},{}", 1.8 * wave.signum()).expect("a string takes all");
        writeln!(wanted, "{t:.2},0").expect("a string takes all");
    }
    folder.write("torque.csv", &torque);
    folder.write("wanted.csv", &wanted);
    let simulate = [
        "simulate",
        "arm.robot",
        "--parameters",
        "true.json",
        "--out",
        "log.csv",
    ];
    let motion = [
        "--trajectory",
        "wanted.csv",
        "--torque",
        "torque.csv",
        "--duration",
        "17",
    ];
    let rates = [
        "--rate",
        "300",
        "--log-rate",
        "30",
        "--position-noise",
        "2e-3",
        "--seed",
        "3",
    ];
    folder.succeed(&[&simulate[..], &motion, &rates].concat());
    let notes = |more: &[&str]| {
        let identify = [
            "identify",
            "arm.robot",
            "log.csv",
            "--method",
            "output-error",
        ];
        let run = folder.run(&[&identify[..], more].concat());
        assert_eq!(run.code, Some(0), "{}", run.stderr);
        run.stderr
    };
    let said = notes(&[]);
    let (_, values) = said.split_once(" and there is J ").expect("a note");
    let [other, own] = [0, 2].map(|k| values.split([' ', ':']).nth(k));
    let number = |text: Option<&str>| text.and_then(|text| text.parse::<f64>().ok());
    let (other, own) = (
        number(other).expect("a number"),
        number(own).expect("a number"),
    );
    assert!(
        (own / 0.0467 - 1.0).abs() < 0.05 && other < 0.6 * own,
        "{said}"
    );
    assert!(
        said.contains("with `--hold sample` positions are off by"),
        "{said}"
    );
    // Who has said it is not asked.
    assert!(!notes(&["--hold", "mean"]).contains("--hold"));
}

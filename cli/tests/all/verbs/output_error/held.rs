//! Whether torque goes on from sample to sample or is held.

use std::fmt::Write;

use crate::verbs::common::Folder;

const SPEC: &str = "robot Upright {
    coordinates th;
    parameters J: kg*m^2, G: kg*m^2/s^2;
    kinetic = J/2*dot(th)^2;
    potential = G*cos(th);
    effects { viscous_friction on all; }
}";

/// A folder with the arm, and a wanted motion of 17 s.
fn folder(wanted: impl Fn(f64) -> f64) -> Folder {
    let folder = Folder::new();
    folder.write("arm.robot", SPEC);
    folder.write(
        "true.json",
        r#"{"J": 0.0467, "G": 0.5626, "th.viscous_friction.fv": 1.621}"#,
    );
    folder.write("wanted.csv", &table("q1", wanted));
    folder
}

/// A column over 17 s at 100 Hz.
fn table(column: &str, value: impl Fn(f64) -> f64) -> String {
    let mut text = format!("time,{column}\n");
    for k in 0..=1700 {
        let t = 0.01 * f64::from(k);
        writeln!(text, "{t:.2},{}", value(t)).expect("a string takes all");
    }
    text
}

/// Writes its log, the end of the command given.
fn simulate(folder: &Folder, more: &str) {
    let simulate = "simulate arm.robot --parameters true.json --trajectory wanted.csv --out log.csv --duration 17 --seed 3";
    let all: Vec<&str> = simulate.split(' ').chain(more.split(' ')).collect();
    folder.succeed(&all);
}

/// What is said of its log by output error.
fn notes(folder: &Folder, more: &[&str]) -> String {
    let identify = "identify arm.robot log.csv --method output-error".split(' ');
    let all: Vec<&str> = identify.chain(more.iter().copied()).collect();
    let run = folder.run(&all);
    assert_eq!(run.code, Some(0), "{}", run.stderr);
    run.stderr
}

/// An inertia that shows in what the arm does within a sample of a jump alone: half a sample is half of it.
#[test]
fn an_inertia_that_hangs_on_what_torque_does_between_samples_is_noted() {
    let folder = folder(|_| 0.0);
    let jumping = |t: f64| 1.8 * (std::f64::consts::TAU * t / 3.3 + 0.3).sin().signum();
    folder.write("torque.csv", &table("tau1", jumping));
    simulate(
        &folder,
        "--torque torque.csv --rate 300 --log-rate 30 --position-noise 2e-3",
    );
    let said = notes(&folder, &[]);
    let (_, values) = said.split_once(" larger, with J ").expect("a note");
    let [other, own] = [0, 3].map(|k| values.split([' ', ':']).nth(k));
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
        said.contains("with `--hold sample` position errors are"),
        "{said}"
    );
    // Who has said it is not asked.
    assert!(!notes(&folder, &["--hold", "mean"]).contains("--hold"));
}

/// The simulated log has means of the torque between its samples.
#[test]
fn a_hold_that_is_asked_for_and_fits_worse_is_noted() {
    let folder = folder(|t| 0.6 * (1.7 * t).sin() + 0.3 * (4.1 * t + 1.0).sin());
    simulate(
        &folder,
        "--rate 100 --log-rate 100 --frequency 15 --position-noise 1e-5",
    );
    let told = "torque is held from each sample to the next, as `--hold` says; with `--hold mean` position errors are ";
    let said = notes(&folder, &["--hold", "sample"]);
    assert!(said.contains(told), "{said}");
    let said = notes(&folder, &["--hold", "mean"]);
    assert!(!said.contains("as `--hold` says"), "{said}");
}

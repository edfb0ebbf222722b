//! What is written, and what it is good for.

use std::fmt::Write;

use serde_json::Value;

use super::{ARM, SMALL, columns, folder, most};
use crate::verbs::common::{json, numbers};

#[test]
fn a_motion_is_written_drawn_and_the_same_again() {
    let folder = folder();
    let outputs = |k: u32| {
        let name = |end: &str| format!("{k}.{end}");
        ["csv", "coefficients.json", "svg", "json"].map(name)
    };
    for k in [1, 2] {
        let [motion, coefficients, figure, report] = outputs(k);
        let files = [
            ["--out", &motion],
            ["--coefficients", &coefficients],
            ["--figure", &figure],
            ["--json", &report],
        ];
        let said = folder.succeed(&[&ARM[..], &SMALL, &files.concat()].concat());
        assert!(said.contains("limits: kept"), "{said}");
    }
    let [motion, coefficients, figure, report] = outputs(1).map(|name| folder.read(&name));
    let again = outputs(2).map(|name| folder.read(&name));
    assert_eq!(
        [&motion, &coefficients, &figure],
        [0, 1, 2].map(|k| &again[k])
    );

    let (head, table) = columns(&motion);
    assert_eq!(head, ["time", "q1", "q2", "dq1", "dq2", "ddq1", "ddq2"]);
    let rows = table[0].len();
    assert_eq!((rows, table[0][rows - 1].to_bits()), (5001, 5f64.to_bits()));
    for (k, limit) in [(1, 120f64.to_radians()), (3, 4.0), (5, 30.0)] {
        assert!(most(&table[k]) <= limit && most(&table[k + 1]) <= limit);
    }
    // It goes to the limits, since the more motion the better.
    assert!(most(&table[3]) > 3.0 || most(&table[5]) > 25.0);
    for row in [0, rows - 1] {
        assert!(table[3..].iter().all(|column| column[row].abs() < 1e-9));
    }

    // The coefficients are the motion.
    let coefficients = json(&coefficients);
    assert_eq!(coefficients["joints"][1]["name"], "lower");
    let of = |key: &str| numbers(&coefficients["joints"][1][key]);
    let (a, b) = (of("a"), of("b"));
    let q0 = coefficients["joints"][1]["q0"].as_f64().expect("a mean");
    let w = std::f64::consts::TAU / 5.0;
    for row in [0, 777, 2500] {
        let t = table[0][row];
        let waves = (0..3).map(|k| {
            let wl = w * f64::from(u8::try_from(k + 1).expect("few"));
            a[k] / wl * (wl * t).sin() - b[k] / wl * (wl * t).cos()
        });
        let q = q0 + waves.sum::<f64>();
        assert!((q - table[2][row]).abs() < 1e-9, "{q} {}", table[2][row]);
    }
    assert!(figure.starts_with("<svg") && figure.contains("upper") && figure.contains("lower"));
    assert!(!figure.contains("NaN") && !figure.contains("inf"));
    let report = json(&report);
    assert_eq!(report["max_violation"], 0.0);
    assert!(report["condition"].as_f64().expect("a number") > 1.0);
    assert!(report["log_det"].is_f64());
}

/// The loop closes: what is designed is driven, and what is driven is identified.
#[test]
fn a_designed_motion_identifies_the_arm() {
    let folder = folder();
    folder.succeed(&[&ARM[..], &SMALL, &["--out", "motion.csv"]].concat());
    let simulate = |motion: &str, log: &str| {
        let arguments = [
            ["simulate", "arm.robot"],
            ["--trajectory", motion],
            ["--parameters", "friction.json"],
            ["--controller", "computed-torque"],
            ["--torque-noise", "0.02"],
            ["--out", log],
        ];
        folder.succeed(&arguments.concat());
    };
    simulate("motion.csv", "log.csv");
    // The same time at a third of the speed, as a careful user would have moved it by hand.
    let mut slow = String::from("time,q1,q2\n");
    for k in 0..=500 {
        let t = f64::from(k) / 100.0;
        writeln!(slow, "{t},{},{}", (1.26 * t).sin(), 0.5 * (2.5 * t).sin()).expect("a string");
    }
    folder.write("slow.csv", &slow);
    simulate("slow.csv", "slow_log.csv");
    let deviations = |log: &str| -> Vec<f64> {
        folder.succeed(&["identify", "arm.robot", log, "--json", "fit.json"]);
        let fit = json(&folder.read("fit.json"));
        let parameters = fit["parameters"].as_array().expect("a list");
        let deviation = |p: &Value| p["std"].as_f64().expect("a deviation");
        parameters.iter().map(deviation).collect()
    };
    let (designed, careful) = (deviations("log.csv"), deviations("slow_log.csv"));
    assert_eq!(designed.len(), careful.len());
    let ratios = designed.iter().zip(&careful).map(|(x, y)| (x / y).ln());
    let mean = (ratios.sum::<f64>() / designed.len() as f64).exp();
    assert!(mean < 0.5, "{mean}: {designed:?} {careful:?}");
}

/// A period that is no whole number of samples but for rounding, and what drives it.
#[test]
fn every_period_can_be_driven() {
    let folder = folder();
    for period in ["4.03", "2.0005"] {
        let arguments = [
            "--starts",
            "1",
            "--period",
            period,
            "--harmonics",
            "2",
            "--budget",
            "0.01",
        ];
        folder.succeed(&[&ARM[..], &arguments, &["--out", "motion.csv"]].concat());
        let (_, table) = columns(&folder.read("motion.csv"));
        assert!(
            table[0].windows(2).all(|pair| pair[1] > pair[0]),
            "{period}"
        );
        let simulate = ["simulate", "arm.robot", "--parameters", "friction.json"];
        let files = ["--trajectory", "motion.csv", "--out", "log.csv"];
        folder.succeed(&[&simulate[..], &files].concat());
    }
}

/// Other parameters that stand for the base make the determinant another by a constant: `elbow.m` is 0.4 of the elbow's first moment.
#[test]
fn columns_of_other_parameters_are_counted() {
    let folder = folder();
    let log_det = |chosen: &[&str]| {
        let files = ["--out", "m.csv", "--json", "m.json"];
        folder.succeed(&[&ARM[..], &SMALL, chosen, &files].concat());
        let report = json(&folder.read("m.json"));
        report["log_det"].as_f64().expect("a number")
    };
    let friction = "upper.viscous_friction.fv,upper.coulomb_friction.fc,lower.viscous_friction.fv,lower.coulomb_friction.fc";
    let rigid =
        |elbow: &str| format!("upper.mx,upper.my,upper.izz,{elbow},lower.my,lower.izz,{friction}");
    let own = log_det(&[]);
    let same = log_det(&["--columns", &rigid("lower.mx")]);
    let other = log_det(&["--columns", &rigid("lower.m")]);
    assert!((same - own).abs() < 1e-6, "{same} {own}");
    assert!(
        (other - own - 2.0 * 0.4f64.ln()).abs() < 0.05,
        "{other} {own}"
    );

    let twice = rigid("upper.mx");
    let refuse = |chosen: &str| {
        folder.refuse(&[&ARM[..], &SMALL, &["--out", "n.csv", "--columns", chosen]].concat())
    };
    assert!(refuse(&twice).contains("no motion separates these parameters"));
    assert!(refuse(&rigid("lower.mass")).contains("no standard parameter `lower.mass`"));
}

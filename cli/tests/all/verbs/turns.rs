//! Rows around the turns of joints with dry friction: they are left out, or what they move estimates by is in deviations, and intervals
//! hold the truth of arms that move under a controller.

use std::fmt::Write;

use serde_json::Value;

use crate::verbs::common::{CART, Folder, cart_log, json, numbers, white};
use crate::verbs::payload::{folder, spec};

/// The truth of the arm of `payload`.
pub(crate) const TRUTH: [(&str, f64); 10] = [
    ("up.mxr", 1.0),
    ("up.my", 0.0),
    ("up.izzr", -0.575),
    ("lo.mxr", 0.2),
    ("lo.my", 0.0),
    ("lo.izzr", -0.1),
    ("up.viscous_friction.fv", 1.0),
    ("lo.viscous_friction.fv", 0.5),
    ("up.coulomb_friction.fc", 1.5),
    ("lo.coulomb_friction.fc", 0.7),
];

const RUNS: usize = 32;

/// The cart with dry friction.
pub(crate) fn dry_cart() -> String {
    CART.replace(
        "viscous_friction on rail;",
        "viscous_friction on rail; coulomb_friction on rail;",
    )
}

/// A log of the cart, which dry friction of 2 N holds with 1.5 N before it moves.
fn waiting(seconds: f64) -> String {
    let mut log = String::from("time,q1,tau1\n");
    let mut state = 7;
    for k in 0..4000 {
        let time = 0.005 * f64::from(k);
        let (angle, rate) = (1.9 * (time - seconds).max(0.0), 1.9);
        let (q, dq, ddq) = (
            0.2 * (1.0 - angle.cos()),
            0.2 * rate * angle.sin(),
            0.2 * rate * rate * angle.cos(),
        );
        let tau = if time < seconds {
            1.5
        } else {
            3.0 * ddq + 5.0 * dq + 2.0 * dq.signum()
        };
        writeln!(
            log,
            "{time:.3},{q:.8},{:.6}",
            tau + 0.05 * white(&mut state)
        )
        .expect("a string takes all");
    }
    log
}

#[test]
fn a_log_that_waits_is_judged_as_it_would_be_fitted() {
    let folder = Folder::new();
    folder.write("cart.robot", &dry_cart());
    folder.write("moves.csv", &waiting(0.0));
    folder.write("waits.csv", &waiting(8.0));
    let identify = |fitted: &str, other: &str| {
        let table = folder.succeed(&[
            "identify",
            "cart.robot",
            fitted,
            "--validate",
            other,
            "--json",
            "fit.json",
        ]);
        let fit = json(&folder.read("fit.json"));
        let of = |key: &str| numbers(&fit[key])[0];
        let names = [
            "relative_percent",
            "relative_percent_validate",
            "rmse_validate",
        ];
        (table, names.map(of))
    };
    let (_, [fitted, judged, raw]) = identify("moves.csv", "waits.csv");
    assert!(judged < 1.5 * fitted && fitted < 10.0, "{judged} {fitted}");
    assert!(raw > 0.9, "{raw}");
    let (table, [fitted, judged, _]) = identify("waits.csv", "moves.csv");
    assert!(judged < 1.5 * fitted && fitted < 10.0, "{judged} {fitted}");
    assert!(
        table.contains("without rows at rest held by dry friction"),
        "{table}"
    );
}

/// Instruments along a motion that turns at other times than the log, and at as many.
#[test]
fn instruments_leave_out_the_turns_of_both_motions() {
    let folder = Folder::new();
    folder.write("cart.robot", &dry_cart());
    folder.write("log.csv", &cart_log(20, 2.0, 0.0));
    let wanted = cart_log(20, 0.0, 0.25);
    let columns = wanted.lines().map(|line| {
        let mut fields = line.split(',');
        let [time, q] = [(); 2].map(|()| fields.next().expect("a field"));
        format!("{time},{q}\n")
    });
    folder.write("wanted.csv", &columns.collect::<String>());
    let fit = |more: &[&str]| {
        let identify = ["identify", "cart.robot", "log.csv", "--json", "fit.json"];
        let said = folder.succeed(&[&identify[..], more].concat());
        (
            numbers(&json(&folder.read("fit.json"))["samples_at_turns"])[0],
            said,
        )
    };
    let (own, _) = fit(&[]);
    let (both, said) = fit(&["--method", "iv", "--instruments", "wanted.csv"]);
    assert!(both > 1.3 * own, "{both} {own}");
    assert!(said.contains("left out"), "{said}");
}

/// A log with encoders of 14 bits and noise of its own.
fn log_of(folder: &Folder, run: usize) -> String {
    let (log, seed) = (format!("log{run}.csv"), format!("{}", 100 + run));
    let motion = ["--trajectory", "wanted.csv", "--parameters", "empty.json"];
    let noise = ["--encoder-bits", "14", "--torque-noise", "0.02"];
    let out = ["--seed", seed.as_str(), "--out", log.as_str()];
    folder.succeed(&[&["simulate", "arm.robot"][..], &motion, &noise, &out].concat());
    log
}

/// Errors over their deviations, as in [`TRUTH`], of such a log.
fn errors(folder: &Folder, run: usize, more: &[&str]) -> Vec<f64> {
    let (log, fit) = (log_of(folder, run), format!("fit{run}.json"));
    let identify = ["identify", "arm.robot", &log, "--json", &fit];
    let said = folder.succeed(&[&identify[..], more].concat());
    let fit = json(&folder.read(&fit));
    let turns = fit["samples_at_turns"].as_array().expect("a list");
    assert_eq!(turns.len(), 2);
    for (turns, joint) in turns.iter().zip(["up", "lo"]) {
        let turns = turns.as_u64().expect("a count");
        assert!(turns > 50, "{turns}");
        assert!(said.contains(&format!("{joint} {turns}")), "{said}");
    }
    let found = fit["parameters"].as_array().expect("a list");
    let of = found.iter().zip(TRUTH).map(|(parameter, (name, truth))| {
        assert_eq!(parameter["name"], name);
        let number = |key: &str| parameter[key].as_f64().expect("a number");
        (number("value") - truth) / number("std")
    });
    of.collect()
}

/// By instruments: the chance that least squares has no bias, run by run.
fn chances(folder: &Folder) -> Vec<f64> {
    let chance = |run: usize| {
        let fit = json(&folder.read(&format!("fit{run}.json")));
        fit["hausman"]["probability"].as_f64().expect("a number")
    };
    (0..RUNS).map(chance).collect()
}

/// Errors over deviations of all runs.
fn all(folder: &Folder, more: &[&str]) -> Vec<Vec<f64>> {
    let half = |first: usize| -> Vec<Vec<f64>> {
        let runs = (first..RUNS).step_by(2);
        runs.map(|run| errors(folder, run, more)).collect()
    };
    std::thread::scope(|scope| {
        let other = scope.spawn(|| half(1));
        let mut all = half(0);
        all.extend(other.join().expect("no panic"));
        all
    })
}

#[test]
fn intervals_hold_the_truth_where_joints_stick_and_encoders_have_steps() {
    let folder = folder("");
    let ways = [
        (&[][..], 1.0, 1.5),
        (&["--judge-turns"], 0.98, 1.0),
        (&["--leave-out-turns"], 0.98, 1.0),
    ];
    for (more, most, bias) in ways {
        let all = all(&folder, more);
        let held = all.iter().flatten().filter(|z| z.abs() < 1.96).count();
        let share = held as f64 / (RUNS * TRUTH.len()) as f64;
        assert!((0.90..=most).contains(&share), "{more:?}: {share}");
        for (k, (name, _)) in TRUTH.iter().enumerate() {
            let mean = all.iter().map(|z| z[k]).sum::<f64>() / RUNS as f64;
            assert!(mean.abs() < bias, "{more:?}, {name}: {mean}");
        }
    }
}

/// The wanted motion turns a little before the measured one, which is no noise of columns.
#[test]
fn dry_friction_alone_does_not_set_instruments_against_least_squares() {
    let folder = folder("");
    let all = all(&folder, &["--method", "iv", "--instruments", "wanted.csv"]);
    let held = all.iter().flatten().filter(|z| z.abs() < 1.96).count();
    let share = held as f64 / (RUNS * TRUTH.len()) as f64;
    assert!((0.90..=0.98).contains(&share), "{share}");
    let chances = chances(&folder);
    let apart = chances.iter().filter(|chance| **chance < 0.05).count();
    assert!(apart <= RUNS / 10, "{apart}: {chances:?}");
}

/// Rows at turns, where the joint stands longer than any law says, would bend a Stribeck curve to one of 4.8 N m: they are left out, by all
/// methods, and that is told.
#[test]
fn a_curve_of_friction_is_looked_for_without_the_turns() {
    let folder = folder("");
    folder.write("arm.robot", &spec("stribeck on up;"));
    folder.write(
        "empty.json",
        r#"{"up.viscous_friction.fv": 1.0, "lo.viscous_friction.fv": 0.5, "up.coulomb_friction.fc": 1.5, "lo.coulomb_friction.fc": 0.7,
            "up.stribeck.fs": 1.0, "up.stribeck.vs": 0.1}"#,
    );
    let truth = TRUTH.into_iter();
    let truth = truth.chain([("up.stribeck.fs", 1.0), ("up.stribeck.vs", 0.1)]);
    let truth: Vec<(&str, f64)> = truth.collect();
    let runs = 6;
    for method in ["wls", "physical", "tls"] {
        let mut held = 0;
        for run in 0..runs {
            let log = format!("log{run}.csv");
            if method == "wls" {
                let seed = format!("{}", 7 + run);
                let simulate = ["simulate", "arm.robot", "--parameters", "empty.json"];
                let motion = ["--trajectory", "wanted.csv", "--torque-noise", "0.02"];
                let out = ["--seed", seed.as_str(), "--out", log.as_str()];
                folder.succeed(&[&simulate[..], &motion, &out].concat());
            }
            let identify = ["identify", "arm.robot", &log, "--method", method];
            let ran = folder.run(&[&identify[..], &["--json", "fit.json"]].concat());
            assert_eq!(ran.code, Some(0), "{}", ran.stderr);
            assert!(
                ran.stderr.contains("with dry friction are left out"),
                "{}",
                ran.stderr
            );
            let fit = json(&folder.read("fit.json"));
            let found = fit["parameters"].as_array().expect("a list");
            for (parameter, (name, truth)) in found.iter().zip(&truth) {
                assert_eq!(parameter["name"], *name);
                let number = |key: &str| parameter[key].as_f64().expect("a number");
                let off = (number("value") - truth) / number("std");
                assert!(off.abs() < 5.0, "{method}: {name} is off by {off}");
                held += usize::from(off.abs() < 1.96);
            }
        }
        let share = held as f64 / (runs * truth.len()) as f64;
        assert!(share > 0.88, "{method}: {share}");
    }
}

/// A short noisy log tells the curve by its turns alone: it comes out at twice what it is, and that is told.
#[test]
fn a_curve_that_turns_alone_tell_is_doubted() {
    let folder = Folder::new();
    folder.write(
        "arm.robot",
        "robot P {
            gravity = [0, -9.81, 0];
            convention = standard_dh;
            joint j: revolute { a = 0.3; alpha = 0; d = 0; }
            effects { viscous_friction on j; coulomb_friction on j; stribeck on j; }
        }",
    );
    folder.write(
        "true.json",
        r#"{"j.m": 0, "j.mx": 0.61, "j.my": 0, "j.izz": 0.3, "j.viscous_friction.fv": 0.5, "j.coulomb_friction.fc": 1,
            "j.stribeck.fs": 0.6, "j.stribeck.vs": 0.1}"#,
    );
    let mut wanted = String::from("time,q1\n");
    for k in 0..=1600 {
        let t = 0.005 * f64::from(k);
        let q = 0.8 * (1.5 * t).sin() + 0.3 * (2.0 * t + 0.5).sin();
        writeln!(wanted, "{t},{q}").expect("a string takes all");
    }
    folder.write("wanted.csv", &wanted);
    let simulate = ["simulate", "arm.robot", "--parameters", "true.json"];
    let motion = ["--trajectory", "wanted.csv", "--torque-noise", "0.1"];
    let out = ["--encoder-bits", "14", "--out", "log.csv"];
    folder.succeed(&[&simulate[..], &motion, &out].concat());
    let run = folder.run(&["identify", "arm.robot", "log.csv", "--json", "fit.json"]);
    assert_eq!(run.code, Some(0), "{}", run.stderr);
    let told =
        "`j.stribeck.vs` is fitted on rows near velocity reversals, as no other rows determine it";
    assert!(run.stderr.contains(told), "{}", run.stderr);
    let fit = json(&folder.read("fit.json"));
    let mut found = fit["parameters"].as_array().expect("a list").iter();
    let fs = found.find(|parameter| parameter["name"] == "j.stribeck.fs");
    let fs = fs.expect("one")["value"].as_f64().expect("a number");
    assert!(fs > 1.0, "{fs}");
}

/// They stay unless something else is asked for, and where they are judged and left out that is told.
#[test]
fn rows_at_turns_are_left_out_where_that_is_asked() {
    let folder = Folder::new();
    folder.write("cart.robot", &dry_cart());
    folder.write("log.csv", &cart_log(20, 2.0, 0.0));
    let identify = ["identify", "cart.robot", "log.csv"];
    for (more, line, is_noted) in [
        (&[][..], "of these near velocity reversals: rail", false),
        (
            &["--judge-turns"],
            "left out, near velocity reversals: rail",
            true,
        ),
        (
            &["--leave-out-turns"],
            "left out, near velocity reversals: rail",
            false,
        ),
    ] {
        let run = folder.run(&[&identify[..], more].concat());
        assert_eq!(run.code, Some(0), "{}", run.stderr);
        assert!(run.stdout.contains(line), "{more:?}: {}", run.stdout);
        let note = run.stderr.contains("with dry friction are left out");
        assert_eq!(note, is_noted, "{more:?}: {}", run.stderr);
    }
    let both = ["--judge-turns", "--leave-out-turns"];
    let refused = folder.run(&[&identify[..], &both].concat());
    assert_eq!(refused.code, Some(2), "{}", refused.stderr);
}

/// What a log tells by its factor, and by the factors of two logs, is what it tells itself.
#[test]
fn factors_know_what_rows_at_turns_move_estimates_by() {
    let folder = folder("");
    let bands = ["--bands", "10,30,90"];
    let logs = [0, 1].map(|run| log_of(&folder, run));
    let factors = ["f0.json", "f1.json"];
    for (log, factor) in logs.iter().zip(factors) {
        let identify = ["identify", "arm.robot", log, "--factor", factor];
        folder.succeed(&[&identify[..], &bands].concat());
    }
    let report = |arguments: &[&str]| {
        folder.succeed(&[arguments, &["--json", "fit.json"]].concat());
        json(&folder.read("fit.json"))
    };
    for more in [&[][..], &["--leave-out-turns"], &["--judge-turns"]] {
        for count in [1, 2] {
            let logs: Vec<&str> = logs[..count].iter().map(String::as_str).collect();
            let identify = [&["identify", "arm.robot"][..], &logs, &bands, more].concat();
            let direct = report(&identify);
            let merge = [&["merge", "arm.robot"], &factors[..count], more].concat();
            let merged = report(&merge);
            assert_eq!(direct["samples_at_turns"], merged["samples_at_turns"]);
            let is_left_out = more == ["--leave-out-turns"];
            for report in [&direct, &merged] {
                let said = report["turns_left_out"].as_bool().expect("yes or no");
                let is_noted = report["notes"]
                    .to_string()
                    .contains("with dry friction are left out");
                assert!(said || !is_left_out);
                assert_eq!(said && !is_left_out, is_noted, "{more:?}: {report}");
            }
            for (k, (name, _)) in TRUTH.iter().enumerate() {
                let of = |fit: &Value, key: &str| fit["parameters"][k][key].as_f64().expect("told");
                let value = of(&direct, "value");
                let apart = (of(&merged, "value") - value).abs();
                assert!(apart < 1e-9 + 1e-7 * value.abs(), "{name}: {apart}");
                let ratio = of(&merged, "std") / of(&direct, "std");
                assert!(
                    (0.5..2.0).contains(&ratio),
                    "{more:?}, {count}, {name}: {ratio}"
                );
                // Most of these is what rows at turns move them by.
                let is_moved =
                    more.is_empty() && name.starts_with("lo.") && name.contains("friction");
                let is_close = (0.8..1.2).contains(&ratio);
                assert!(!is_moved || is_close, "{count}, {name}: {ratio}");
            }
        }
    }
}

//! `identify --factor` and `merge`.

use serde_json::Value;

use crate::verbs::common::{CART, Folder, cart_log, json, numbers};

fn folder() -> Folder {
    let folder = Folder::new();
    folder.write("cart.robot", CART);
    folder.write("one.csv", &cart_log(20, 0.0, 0.0));
    folder.write("other.csv", &cart_log(30, 0.9, 0.0));
    folder
}

fn values(fit: &Value, of: &str) -> Vec<f64> {
    let parameters = fit["parameters"].as_array().expect("a list");
    let number = |parameter: &Value| parameter[of].as_f64().expect("a number");
    parameters.iter().map(number).collect()
}

const BANDS: [&str; 2] = ["--bands", "10,30,90"];

/// The report of a command.
fn report(folder: &Folder, arguments: &[&str]) -> Value {
    folder.succeed(&[arguments, &["--json", "fit.json"]].concat());
    json(&folder.read("fit.json"))
}

#[test]
fn factors_of_logs_are_one_estimate() {
    let folder = folder();
    let together = report(
        &folder,
        &[
            &["identify", "cart.robot", "one.csv", "other.csv"],
            &BANDS[..],
        ]
        .concat(),
    );
    for (log, factor) in [("one.csv", "one.json"), ("other.csv", "other.json")] {
        let reduce = ["identify", "cart.robot", log, "--factor", factor];
        let fit = report(&folder, &[&reduce, &BANDS[..]].concat());
        let direct = report(
            &folder,
            &[&["identify", "cart.robot", log], &BANDS[..]].concat(),
        );
        for (found, direct) in values(&fit, "value").iter().zip(values(&direct, "value")) {
            assert!((found / direct - 1.0).abs() < 1e-9, "{found} {direct}");
        }
        for (found, direct) in values(&fit, "std").iter().zip(values(&direct, "std")) {
            // Dry friction that the other log has and the model lacks cancels within blocks, and moves values within their deviations for the
            // log alone.
            let is_known = log == "one.csv";
            assert!(!is_known || *found > 0.2 * direct, "{found} {direct}");
            assert!(*found < 2.5 * direct, "{found} {direct}");
        }
        assert!((numbers(&fit["rmse"])[0] - numbers(&direct["rmse"])[0]).abs() < 1e-6);
    }
    let merged = report(
        &folder,
        &[
            "merge",
            "cart.robot",
            "one.json",
            "other.json",
            "--validate",
            "one.csv",
            "--factor",
            "both.json",
        ],
    );
    for (found, direct) in values(&merged, "value")
        .iter()
        .zip(values(&together, "value"))
    {
        assert!((found / direct - 1.0).abs() < 1e-9, "{found} {direct}");
    }
    assert!(merged["rmse"].is_null());
    assert!(numbers(&merged["rmse_validate"])[0] > 0.0);
    let again = report(&folder, &["merge", "cart.robot", "both.json"]);
    assert!(again["notes"].is_array());
    for (found, direct) in values(&again, "value").iter().zip(values(&merged, "value")) {
        assert!((found / direct - 1.0).abs() < 1e-12, "{found} {direct}");
    }
}

/// A log that is longer than what is read at a time.
#[test]
fn pieces_of_a_long_log_are_the_whole() {
    let folder = Folder::new();
    folder.write("cart.robot", CART);
    folder.write("long.csv", &cart_log(240, 0.0, 0.0));
    assert!(
        folder.read("long.csv").lines().count() > 2 * 16_384,
        "more than one piece"
    );
    let direct = report(
        &folder,
        &[&["identify", "cart.robot", "long.csv"], &BANDS[..]].concat(),
    );
    let reduce = [
        "identify",
        "cart.robot",
        "long.csv",
        "--factor",
        "long.json",
    ];
    let fit = report(&folder, &[&reduce, &BANDS[..]].concat());
    for (k, direct) in values(&direct, "value").iter().enumerate() {
        let found = values(&fit, "value")[k];
        let std = values(&fit, "std")[k];
        assert!((found - direct).abs() < 0.1 * std, "{found} {direct} {std}");
    }
    let factor = json(&folder.read("long.json"));
    let blocks = factor["blocks"].as_array().expect("a list");
    assert!(blocks.len() <= 32 && blocks.len() > 16, "{}", blocks.len());
}

/// Factors and specs that do not belong together, and files that are no factor.
fn strangers() -> Folder {
    let folder = folder();
    let reduce = ["identify", "cart.robot", "one.csv", "--factor", "one.json"];
    folder.succeed(&[&reduce[..], &BANDS].concat());
    folder.succeed(
        &[
            &[
                "identify",
                "cart.robot",
                "one.csv",
                "--factor",
                "narrow.json",
            ][..],
            &["--bands", "5,30,90"],
        ]
        .concat(),
    );
    let more = CART.replace(
        "viscous_friction on rail;",
        "viscous_friction on rail; coulomb_friction on rail;",
    );
    folder.write("more.robot", &more);
    let dahl = CART.replace("viscous_friction on rail;", "dahl(d = 0.01) on rail;");
    folder.write("dahl.robot", &dahl);
    let open = CART.replace("viscous_friction on rail;", "stribeck on rail;");
    folder.write("open.robot", &open);
    let text = folder.read("one.json");
    folder.write("cut.json", &text[..text.len() / 2]);
    folder.write(
        "form.json",
        &text.replacen("\"factor\":5", "\"factor\":9", 1),
    );
    folder.write("old.json", "{\"factor\":1,\"unknowns\":[]}");
    folder.write(
        "negative.json",
        &text.replacen("\"torque_squares\":[", "\"torque_squares\":[-", 1),
    );
    let geared = CART.replace("link = cart;", "link = cart; actuator_gain = 7;");
    assert_ne!(geared, CART);
    folder.write("geared.robot", &geared);
    folder.write(
        "rows.json",
        &text.replacen("\"rows\":[[[", "\"rows\":[[[1.0,", 1),
    );
    folder.write("plain.json", "{\"cart.m\": 3}");
    folder
}

#[test]
fn what_is_no_factor_of_the_arm_is_refused() {
    let folder = strangers();
    for (arguments, reason) in [
        (
            &["merge", "more.robot", "one.json"][..],
            "different unknowns than the arm",
        ),
        (
            &["merge", "cart.robot", "one.json", "narrow.json"],
            "different filters (5,30,90 Hz, where 10,30,90 Hz are wanted)",
        ),
        (
            &["merge", "geared.robot", "one.json"],
            "one.json: the factor has different equations",
        ),
        (&["merge", "cart.robot", "cut.json"], "cut.json"),
        (
            &["merge", "cart.robot", "form.json"],
            "a factor of form 9, this program reads form 5; write it again with `identify --factor`",
        ),
        (
            &["merge", "cart.robot", "old.json"],
            "a factor of form 1, this program reads form 5",
        ),
        (
            &["merge", "cart.robot", "negative.json"],
            "negative.json: block 1 has a negative sum of squares or size",
        ),
        (
            &["merge", "cart.robot", "rows.json"],
            "block 1 does not have one list of rows per joint",
        ),
        (
            &["merge", "cart.robot", "plain.json"],
            "it is not a factor written by `identify --factor`",
        ),
        (
            &["merge", "cart.robot", "one.csv"],
            "one.csv: it is a log, not a factor",
        ),
        (
            &["identify", "dahl.robot", "one.csv", "--factor", "x.json"],
            "`dahl` has a memory",
        ),
        (
            &["identify", "open.robot", "one.csv", "--factor", "x.json"],
            "has no value",
        ),
        (
            &[
                "identify",
                "cart.robot",
                "one.csv",
                "--factor",
                "x.json",
                "--method",
                "tls",
            ],
            "others need single samples",
        ),
    ] {
        let said = folder.refuse(arguments);
        assert!(said.contains(reason), "{arguments:?}: {said}");
    }
}

/// Two joints whose names and unknowns stay as they are whatever the numbers of the spec.
fn arm(gravity: &str, length: &str, note: &str) -> String {
    format!(
        "{note}robot Arm {{ gravity = [0, {gravity}, 0]; convention = standard_dh; \
         joint a: revolute {{ a = {length}; alpha = 0; d = 0; }} joint b: revolute {{ a = 0.4; alpha = 0; d = 0; }} \
         link b {{ mass = {}; com = [-0.2, 0, 0]; inertia = [0.01, 0, 0, 0.01, 0, 0.01]; }} effects {{ viscous_friction on all; }} }}\n",
        if note.is_empty() { "2" } else { "3" }
    )
}

#[test]
fn numbers_of_the_spec_are_a_factor_s_and_nominal_values_and_comments_are_not() {
    use std::fmt::Write;

    let folder = Folder::new();
    let mut log = String::from("time,q1,q2,tau1,tau2\n");
    for k in 0..4000 {
        let t = 0.005 * f64::from(k);
        let (one, other) = ((1.3 * t).sin(), 0.7 * (2.1 * t).sin());
        let taus = [9.0 * one.cos() + (3.0 * t).sin(), 2.0 * (one + other).cos()];
        let row = format!("{t},{one},{other},{},{}", taus[0], taus[1]);
        writeln!(log, "{row}").expect("a string takes all");
    }
    folder.write("log.csv", &log);
    folder.write("arm.robot", &arm("-9.81", "0.5", ""));
    folder.write("moon.robot", &arm("-1.62", "0.5", ""));
    folder.write("long.robot", &arm("-9.81", "0.501", ""));
    folder.write("noted.robot", &arm("-9.81", "0.5", "// Of CAD.\n"));
    let reduce = ["identify", "arm.robot", "log.csv", "--factor", "log.json"];
    folder.succeed(&reduce);
    for other in ["moon.robot", "long.robot"] {
        let said = folder.refuse(&["merge", other, "log.json"]);
        assert!(
            said.contains("log.json: the factor has different equations"),
            "{said}"
        );
    }
    let merged = folder.succeed(&["merge", "arm.robot", "log.json"]);
    assert_eq!(
        folder.succeed(&["merge", "noted.robot", "log.json"]),
        merged
    );
}

#[test]
fn a_log_that_is_in_two_factors_is_noted() {
    let folder = folder();
    for (log, factor) in [("one.csv", "one.json"), ("other.csv", "other.json")] {
        let reduce = ["identify", "cart.robot", log, "--factor", factor];
        folder.succeed(&[&reduce[..], &BANDS].concat());
    }
    let both = ["merge", "cart.robot", "one.json", "other.json"];
    let apart = folder.run(&[&both[..], &["--factor", "both.json"]].concat());
    assert!(
        !apart.stderr.contains("they count twice"),
        "{}",
        apart.stderr
    );
    for again in ["one.json", "both.json"] {
        let run = folder.run(&["merge", "cart.robot", "one.json", again]);
        assert_eq!(run.code, Some(0), "{}", run.stderr);
        let told = format!("note: {again} has ");
        assert!(
            run.stderr.contains(&told) && run.stderr.contains(" of a log that one.json also has"),
            "{}",
            run.stderr
        );
    }
}

/// Joints of different torques: weights by these are others than those by residuals, and the same of a factor as of its log.
#[test]
fn factors_weigh_by_lengths_and_sizes_of_torques() {
    let folder = crate::verbs::payload::folder("");
    let identify = ["identify", "arm.robot", "empty.csv", "--weights"];
    let fit = |rest: &[&str]| values(&report(&folder, &[&identify[..], rest].concat()), "value");
    let bands = |weights| [&[weights][..], &BANDS].concat();
    let all = ["torque-norm", "max-torque", "residual"].map(|weights| fit(&bands(weights)));
    for (weights, direct) in ["torque-norm", "max-torque"].into_iter().zip(&all) {
        let factor = ["--factor", "factor.json"];
        let reduced = fit(&[&bands(weights)[..], &factor].concat());
        let merge = ["merge", "arm.robot", "factor.json", "--weights", weights];
        let merged = values(&report(&folder, &merge), "value");
        assert!(far(direct, &reduced) < 1e-7, "{direct:?} {reduced:?}");
        assert!(far(direct, &merged) < 1e-7, "{direct:?} {merged:?}");
    }
    for (one, other) in [(0, 1), (0, 2), (1, 2)] {
        assert!(far(&all[one], &all[other]) > 1e-7, "{all:?}");
    }
}

/// The largest difference over the largest value.
fn far(one: &[f64], other: &[f64]) -> f64 {
    let size = one.iter().fold(0.0, |most: f64, x| most.max(x.abs()));
    let pairs = one.iter().zip(other);
    pairs.map(|(x, y)| (x - y).abs()).fold(0.0, f64::max) / size
}

/// Methods that weigh CAD against the logs find of a factor what they find of its log: how many samples are worth one is not quite the same.
#[test]
fn factors_are_weighed_against_nominal_values() {
    let folder = crate::verbs::payload::folder("");
    let fit = |arguments: &[&str]| report(&folder, arguments);
    for method in ["ridge", "physical"] {
        let identify = ["identify", "arm.robot", "empty.csv", "--method", method];
        let direct = fit(&[&identify[..], &BANDS].concat());
        let factor = ["--factor", "factor.json"];
        let reduced = fit(&[&identify[..], &BANDS, &factor].concat());
        let merged = fit(&["merge", "arm.robot", "factor.json", "--method", method]);
        let [here, there] = [&reduced, &merged].map(|fit| values(fit, "value"));
        assert!(far(&here, &there) < 1e-12, "{here:?} {there:?}");
        let [of_log, of_factor] = [&direct, &merged].map(|fit| values(fit, "value"));
        assert!(far(&of_log, &of_factor) < 0.01, "{of_log:?} {of_factor:?}");
        let is_possible = method == "physical";
        assert_eq!(merged["possible"]["standard"].is_array(), is_possible);
        let wls = fit(&["merge", "arm.robot", "factor.json"]);
        assert!(far(&values(&wls, "value"), &of_factor) > 0.0, "{merged}");
    }
    let refused = folder.refuse(&["merge", "arm.robot", "factor.json", "--prior", "0.1"]);
    assert!(
        refused.contains("`--prior` belongs to `--method ridge`"),
        "{refused}"
    );
    let of_all = ["--method", "physical", "--weights", "torque-norm"];
    let refused = folder.refuse(&[&["merge", "arm.robot", "factor.json"][..], &of_all].concat());
    assert!(
        refused.contains("`--weights` belongs to `wls`"),
        "{refused}"
    );
}

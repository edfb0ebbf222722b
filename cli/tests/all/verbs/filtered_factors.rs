//! `identify --form filtered --factor`, and `merge` of what it writes.

use serde_json::Value;

use crate::verbs::common::{CART, Folder, cart_log, json, numbers};
use crate::verbs::turns::dry_cart;

const FORM: [&str; 6] = [
    "--form", "filtered", "--corner", "40", "--bands", "10,30,90",
];

fn values(fit: &Value, of: &str) -> Vec<f64> {
    let parameters = fit["parameters"].as_array().expect("a list");
    let number = |parameter: &Value| parameter[of].as_f64().expect("a number");
    parameters.iter().map(number).collect()
}

/// The report of a command.
fn report(folder: &Folder, arguments: &[&str]) -> Value {
    folder.succeed(&[arguments, &["--json", "fit.json"]].concat());
    json(&folder.read("fit.json"))
}

#[track_caller]
fn are_alike(found: &[f64], direct: &[f64]) {
    assert_eq!(found.len(), direct.len());
    for (found, direct) in found.iter().zip(direct) {
        assert!((found / direct - 1.0).abs() < 1e-9, "{found} {direct}");
    }
}

#[test]
fn merged_factors_are_the_filtered_form_of_all_logs() {
    let folder = Folder::new();
    folder.write("cart.robot", &dry_cart());
    folder.write("one.csv", &cart_log(20, 2.0, 0.0));
    folder.write("other.csv", &cart_log(30, 2.0, 0.25));
    folder.write("unseen.csv", &cart_log(20, 2.0, 0.4));
    let unseen = ["--validate", "unseen.csv"];
    for (log, factor) in [("one.csv", "one.json"), ("other.csv", "other.json")] {
        let reduce = ["identify", "cart.robot", log, "--factor", factor];
        let fit = report(&folder, &[&reduce[..], &FORM, &unseen].concat());
        let direct = ["identify", "cart.robot", log];
        let direct = report(&folder, &[&direct[..], &FORM, &unseen].concat());
        are_alike(&values(&fit, "value"), &values(&direct, "value"));
        for name in ["rmse", "rmse_validate", "relative_percent_validate"] {
            are_alike(&numbers(&fit[name]), &numbers(&direct[name]));
        }
        for name in ["form", "corner", "domain", "bands_hz", "samples_at_turns"] {
            assert_eq!(fit[name], direct[name], "{name}");
        }
    }
    for more in [&[][..], &["--leave-out-turns"], &["--method", "ls"]] {
        let merge = ["merge", "cart.robot", "one.json", "other.json"];
        let merged = report(&folder, &[&merge[..], more, &unseen].concat());
        let identify = ["identify", "cart.robot", "one.csv", "other.csv"];
        let direct = report(&folder, &[&identify[..], &FORM, more, &unseen].concat());
        are_alike(&values(&merged, "value"), &values(&direct, "value"));
        let errors = numbers(&merged["rmse_validate"]);
        are_alike(&errors, &numbers(&direct["rmse_validate"]));
        for name in ["form", "corner", "domain", "samples_at_turns"] {
            assert_eq!(merged[name], direct[name], "{name}");
        }
        assert_eq!(merged["domain"], "filtered");
    }
    let merge = ["merge", "cart.robot", "one.json", "--factor", "both.json"];
    let table = folder.succeed(&[&merge[..], &["other.json"], &unseen].concat());
    let of_torque = "torque through L(s) = w/(s + w) with w = 40.0 rad/s";
    assert!(table.contains(of_torque), "{table}");
    let again = report(&folder, &["merge", "cart.robot", "both.json"]);
    let both = report(&folder, &["merge", "cart.robot", "one.json", "other.json"]);
    are_alike(&values(&again, "value"), &values(&both, "value"));
}

/// A log that is longer than what is read at a time; its bands and the corner are chosen of its first piece.
#[test]
fn pieces_of_a_long_log_are_the_whole_in_the_filtered_form() {
    let folder = Folder::new();
    folder.write("cart.robot", CART);
    folder.write("long.csv", &cart_log(240, 0.0, 0.0));
    let log = ["identify", "cart.robot", "long.csv", "--form", "filtered"];
    let fit = report(&folder, &[&log[..], &["--factor", "long.json"]].concat());
    let factor = json(&folder.read("long.json"));
    let blocks = factor["blocks"].as_array().expect("a list");
    assert!(blocks.len() <= 32 && blocks.len() > 16, "{}", blocks.len());
    assert_eq!(factor["form"], "filtered");
    assert_eq!(factor["corner"], fit["corner"]);
    let bands = numbers(&fit["bands_hz"]);
    let corner = std::f64::consts::TAU * bands[0];
    assert!((fit["corner"].as_f64().expect("a number") - corner).abs() < 1e-9);
    let bands = format!("{},{},{}", bands[0], bands[1], bands[2]);
    let direct = report(&folder, &[&log[..], &["--bands", &bands]].concat());
    let pairs = values(&fit, "value").into_iter();
    for ((found, direct), std) in pairs.zip(values(&direct, "value")).zip(values(&fit, "std")) {
        assert!((found - direct).abs() < 0.1 * std, "{found} {direct} {std}");
    }
    assert_eq!(fit["domain"], "filtered");
}

#[test]
fn factors_of_other_forms_and_corners_do_not_belong_together() {
    let folder = Folder::new();
    folder.write("cart.robot", CART);
    folder.write("log.csv", &cart_log(20, 0.0, 0.0));
    let reduce = |file: &str, more: &[&str]| {
        let identify = ["identify", "cart.robot", "log.csv", "--factor", file];
        folder.succeed(&[&identify[..], more, &["--bands", "10,30,90"]].concat());
    };
    reduce("40.json", &FORM[..4]);
    reduce("50.json", &["--form", "filtered", "--corner", "50"]);
    reduce("plain.json", &[]);
    let loaded = CART.replace(
        "viscous_friction on rail;",
        "viscous_friction on rail; load_dependent_friction on rail;",
    );
    folder.write("loaded.robot", &loaded);
    let text = folder.read("40.json");
    let without = text.replacen("\"corner\":40.0", "\"corner\":null", 1);
    assert_ne!(without, text);
    folder.write("without.json", &without);
    let other = text.replacen("\"form\":\"filtered\"", "\"form\":\"power\"", 1);
    folder.write("power.json", &other);
    folder.write("dry.robot", &dry_cart());
    let identify = ["identify", "dry.robot", "log.csv", "--factor", "dry.json"];
    folder.succeed(&[&identify[..], &FORM].concat());
    let text = folder.read("dry.json");
    let more = text.replacen("\"away\":{\"counts\":[", "\"away\":{\"counts\":[9", 1);
    assert_ne!(more, text);
    folder.write("more.json", &more);
    for (arguments, reason) in [
        (
            &["merge", "cart.robot", "40.json", "50.json"][..],
            "50.json: the factor has different rows (of the form filtered with a corner of 50 rad/s, where filtered with a corner of 40 \
             rad/s is wanted)",
        ),
        (
            &["merge", "cart.robot", "40.json", "plain.json"],
            "plain.json: the factor has different rows (of the form acceleration, where filtered with a corner of 40 rad/s is wanted)",
        ),
        (
            &["merge", "cart.robot", "plain.json", "40.json"],
            "40.json: the factor has different rows (of the form filtered with a corner of 40 rad/s, where acceleration is wanted) than \
             the arm or the factors before it; make all with one spec and the same `--bands`, `--form` and `--corner`",
        ),
        (
            &["merge", "cart.robot", "without.json"],
            "without.json: it is of the filtered form, but has no `corner` above 0 rad/s",
        ),
        (
            &["merge", "cart.robot", "power.json"],
            "`form`: unknown variant `power`, expected `acceleration` or `filtered`",
        ),
        (
            &["merge", "dry.robot", "more.json"],
            "more.json: block 1 has more rows away from velocity reversals than rows",
        ),
        (
            &["merge", "loaded.robot", "40.json"],
            "`rail.load_dependent_friction.mu` has no filtered form",
        ),
        (
            &[
                "identify",
                "loaded.robot",
                "log.csv",
                "--factor",
                "x.json",
                "--form",
                "filtered",
            ],
            "`rail.load_dependent_friction.mu` has no filtered form",
        ),
        (
            &[
                "identify",
                "cart.robot",
                "log.csv",
                "--factor",
                "x.json",
                "--form",
                "filtered",
                "--corner",
                "1e9",
            ],
            "error: --corner: a corner of 1000000000 rad/s on samples at 200 Hz",
        ),
    ] {
        let said = folder.refuse(arguments);
        assert!(said.contains(reason), "{arguments:?}: {said}");
    }
}

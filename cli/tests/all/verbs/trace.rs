//! `trace`.

use std::fmt::Write as _;

use serde_json::Value;

use crate::verbs::common::{CART, Folder, cart_log, cart_with, close, json, numbers, tones};

#[test]
fn trace_closes_the_loop() {
    let folder = Folder::new();
    folder.write("cart.robot", CART);
    folder.write("log.csv", &cart_log(40, 2.0, 0.0));
    folder.write("other.csv", &cart_log(20, 2.0, 0.7));
    let outputs = [
        "--amend",
        "amended.robot",
        "--predict",
        "tau.csv",
        "--json",
        "out.json",
    ];
    let told = folder.succeed(
        &[
            &["trace", "cart.robot", "log.csv", "--validate", "other.csv"],
            outputs.as_slice(),
        ]
        .concat(),
    );
    assert!(
        told.starts_with("explained:\n  coulomb-friction on rail: fc = "),
        "{told}"
    );
    assert!(
        told.contains("+         coulomb_friction on rail;"),
        "{told}"
    );
    assert!(
        told.contains("relative, identification")
            && told.contains("RMSE, validation")
            && told.contains("relative, validation"),
        "{told}"
    );
    assert!(
        told.ends_with(
            "wrote amended.robot: the spec with the effects declared\nwrote tau.csv: predicted torque in the log's units\n\
             wrote out.json: the result\n"
        ),
        "{told}"
    );
    let out = json(&folder.read("out.json"));
    let train = |key: &str| numbers(&out[key])[0];
    assert!(
        train("relative_percent_train_after") < 0.3 * train("relative_percent_train_before"),
        "{out}"
    );
    assert_eq!(out["outcome"], "explained");
    assert_eq!(
        (&out["effects"][0]["kind"], &out["effects"][0]["joint"]),
        (&Value::from("coulomb-friction"), &Value::from(1))
    );
    close(
        out["effects"][0]["parameters"][0]["value"]
            .as_f64()
            .expect("a number"),
        2.0,
        0.05,
    );
    assert!(numbers(&out["rmse_after"])[0] < 0.3 * numbers(&out["rmse_before"])[0]);

    let amended = folder.read("amended.robot");
    assert!(
        amended.contains("// runs level") && amended.contains("coulomb_friction on rail;"),
        "{amended}"
    );
    folder.succeed(&["check", "amended.robot"]);
    let prediction = folder.read("tau.csv");
    assert!(
        prediction.starts_with("time,tau1\n0.000000000,"),
        "{}",
        &prediction[..40]
    );
    assert_eq!(prediction.lines().count(), 20 * 200 + 1);

    // The amended spec lacks nothing.
    let told = folder.succeed(&[
        "trace",
        "amended.robot",
        "log.csv",
        "--json",
        "again.json",
        "--amend",
        "again.robot",
    ]);
    assert!(told.starts_with("nothing missing"), "{told}");
    assert!(
        told.contains("wrote again.robot: the spec as it was: nothing was added\n"),
        "{told}"
    );
    assert_eq!(folder.read("again.robot"), amended);
    let again = json(&folder.read("again.json"));
    assert_eq!(
        (&again["effects"], &again["rmse_before"]),
        (&json("[]"), &Value::Null)
    );
}

/// A law of one log that the other one does not have: it is named, and that the other is against it is said.
#[test]
fn what_the_other_log_does_not_bear_out_is_said() {
    let folder = Folder::new();
    folder.write("cart.robot", CART);
    folder.write("log.csv", &cart_log(40, 2.0, 0.0));
    for (coulomb, is_borne_out) in [(2.0, true), (0.0, false)] {
        folder.write("other.csv", &cart_log(20, coulomb, 0.7));
        let trace = ["trace", "cart.robot", "log.csv", "--validate", "other.csv"];
        let told = folder.succeed(&[&trace[..], &["--json", "out.json"]].concat());
        assert!(
            told.starts_with("explained:\n  coulomb-friction on rail"),
            "{told}"
        );
        let out = json(&folder.read("out.json"));
        assert_eq!(out["borne_out"], is_borne_out, "{out}");
        let is_said = told.contains("the validation log does not confirm it");
        assert_eq!(is_said, !is_borne_out, "{told}");
        // What the one log has and the other has not is much of its error.
        assert_eq!(
            out["unlike_validation"] == json("[]"),
            is_borne_out,
            "{out}"
        );
    }
    let told = folder.succeed(&["trace", "cart.robot", "log.csv", "--json", "out.json"]);
    assert!(!told.contains("confirm it"), "{told}");
    assert_eq!(json(&folder.read("out.json"))["borne_out"], Value::Null);
}

#[test]
fn trace_writes_nothing_where_it_cannot_write_all() {
    let folder = Folder::new();
    folder.write("cart.robot", CART);
    folder.write("log.csv", &cart_log(5, 0.0, 0.0));
    let said = folder.refuse(&[
        "trace",
        "cart.robot",
        "log.csv",
        "--json",
        "out.json",
        "--amend",
        "nowhere/out.robot",
    ]);
    assert!(said.contains("cannot write `nowhere/out.robot`"), "{said}");
}

#[test]
fn a_prediction_is_in_the_units_of_the_log() {
    let folder = Folder::new();
    let gain = CART.replace("link = cart;", "link = cart; actuator_gain = -4;");
    folder.write("cart.robot", &gain);
    folder.write("log.csv", &cart_log(10, 0.0, 0.0));
    folder.succeed(&[
        "trace",
        "cart.robot",
        "log.csv",
        "--validate",
        "log.csv",
        "--predict",
        "tau.csv",
    ]);
    let (log, predicted) = (folder.read("log.csv"), folder.read("tau.csv"));
    let last = |line: &str| -> f64 {
        let field = line.rsplit(',').next().expect("a field");
        field.parse().expect("a number")
    };
    for (measured, predicted) in log.lines().zip(predicted.lines()).skip(400).take(1000) {
        close(last(predicted), last(measured), 0.1);
    }
}

#[test]
fn a_prediction_is_in_the_units_that_a_line_of_the_log_says() {
    let folder = Folder::new();
    folder.write("cart.robot", CART);
    let in_newtons = cart_log(10, 0.0, 0.0);
    let mut lines = in_newtons.lines();
    let mut log = format!("{}\ns,mm,kN\n", lines.next().expect("a header"));
    for line in lines {
        let fields: Vec<f64> = line
            .split(',')
            .map(|x| x.parse().expect("a number"))
            .collect();
        writeln!(
            log,
            "{},{},{}",
            fields[0],
            1e3 * fields[1],
            1e-3 * fields[2]
        )
        .expect("a string takes all");
    }
    folder.write("log.csv", &log);
    let trace = ["trace", "cart.robot", "log.csv", "--validate", "log.csv"];
    folder.succeed(&[&trace[..], &["--predict", "tau.csv"]].concat());
    let predicted = folder.read("tau.csv");
    let last = |line: &str| -> f64 {
        let field = line.rsplit(',').next().expect("a field");
        field.parse().expect("a number")
    };
    let measured = log.lines().skip(2).skip(400).take(1000);
    for (measured, predicted) in measured.zip(predicted.lines().skip(1).skip(400)) {
        close(last(predicted), last(measured), 1e-4);
    }
}

#[test]
fn a_report_has_the_verdict_the_errors_and_figures_on_one_page() {
    let folder = Folder::new();
    folder.write("cart.robot", CART);
    folder.write("log.csv", &cart_log(40, 2.0, 0.0));
    folder.write("other.csv", &cart_log(20, 2.0, 0.7));
    let trace = ["trace", "cart.robot", "log.csv", "--validate", "other.csv"];
    let told = folder.succeed(&[&trace[..], &["--report", "page"]].concat());
    assert!(told.contains("the report"), "{told}");
    let page = folder.read("page/index.html");
    for part in [
        "<strong>Explained: coulomb-friction on rail</strong>",
        "Errors before and after",
        "Change of the spec",
        "<svg",
        "What was tried",
    ] {
        assert!(page.contains(part), "no {part}");
    }
    for quantity in ["velocity", "position", "load", "time", "spectrum"] {
        assert!(
            page.to_lowercase().contains(quantity),
            "no figure over {quantity}"
        );
    }
    // Nothing is fetched from anywhere.
    let fetches = ["src=\"http", "href=\"http", "@import"];
    assert!(!fetches.iter().any(|what| page.contains(what)), "{page}");
    assert!(page.len() < 3_000_000, "{}", page.len());
    // A report that never comes leaves no folder behind.
    folder.refuse(&["trace", "cart.robot", "none.csv", "--report", "other"]);
    assert!(!folder.path("other").exists());
}

/// A declared parameter may take in what is missing, so that nothing of it is left to trace.
#[test]
fn what_hides_in_a_parameter_below_zero_is_told() {
    let folder = Folder::new();
    folder.write("cart.robot", CART);
    for (drive, is_told) in [(0.0, false), (-9.0, true)] {
        let log = cart_with(200, 40, &tones(0.0), |_, dq| drive * dq);
        folder.write("log.csv", &log);
        let told = folder.succeed(&["trace", "cart.robot", "log.csv", "--json", "out.json"]);
        let out = json(&folder.read("out.json"));
        assert_eq!(out["outcome"], "nothing-missing", "{told}");
        let below = "is negative, which is physically impossible: an undeclared effect looks like";
        assert_eq!(told.contains(below), is_told, "{told}");
        let found = out["impossible"].as_array().expect("a list");
        assert_eq!(found.len(), usize::from(is_told), "{out}");
        if is_told {
            assert_eq!(found[0]["name"], "rail.viscous_friction.fv");
            assert!(found[0]["interval"][1].as_f64().expect("a number") < 0.0);
        }
    }
}

/// No choice is made on the validation log: with others in its place, and with none, all but the errors on it stays, to the last digit.
#[test]
fn the_validation_log_is_sealed() {
    let folder = Folder::new();
    folder.write("cart.robot", CART);
    folder.write("log.csv", &cart_log(40, 2.0, 0.0));
    folder.write("other.csv", &cart_log(20, 2.0, 0.7));
    // A log of another cart: with less dry friction.
    folder.write("unlike.csv", &cart_log(25, 0.4, 1.9));
    let verdict = |rest: &[&str]| -> Value {
        let trace = ["trace", "cart.robot", "log.csv", "--json", "out.json"];
        folder.succeed(&[&trace[..], rest].concat());
        let mut out = json(&folder.read("out.json"));
        let all = out.as_object_mut().expect("an object");
        for of_validation in [
            "rmse_before",
            "rmse_after",
            "relative_percent_before",
            "relative_percent_after",
            "borne_out",
            "unlike_validation",
        ] {
            assert!(all.remove(of_validation).is_some(), "no {of_validation}");
        }
        out
    };
    let alone = verdict(&[]);
    assert_eq!(alone["outcome"], "explained");
    assert!(!alone["tried"].as_array().expect("a list").is_empty());
    assert_eq!(verdict(&["--validate", "other.csv"]), alone);
    assert_eq!(verdict(&["--validate", "unlike.csv"]), alone);
}

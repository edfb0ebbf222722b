//! Logs as a drive writes them: other names, other units, currents, words between numbers.

use std::fmt::Write;

use crate::verbs::common::{CART, Folder, cart_log, close, json, numbers};

/// The cart with a motor of 42 N/A, and where its drive writes what.
fn cart() -> String {
    CART.replace("link = cart;", "link = cart; actuator_gain = -42 N/A;")
        .replace(
            "effects {",
            "log { time = \"stamp [ms]\": ms; q = \"pos, rail\": -360 mm/4096; tau = \"current\": mA; }\n    effects {",
        )
}

/// The same log as its drive writes it: milliseconds, counts the other way round, milliamperes, and a mode between them.
fn as_of_the_drive(log: &str) -> String {
    let mut text = String::from("mode,\"pos, rail\",current,stamp [ms]\n");
    for row in log.lines().skip(1) {
        let fields: Vec<f64> = row
            .split(',')
            .map(|field| field.parse().expect("a number"))
            .collect();
        let (time, q, tau) = (
            1e3 * fields[0],
            -fields[1] * 4096.0 / 0.36,
            -1e3 / 42.0 * fields[2],
        );
        writeln!(text, "run,{q:.9},{tau:.9},{time:.3}").expect("a string takes all");
    }
    text
}

#[test]
fn logs_of_a_drive_are_those_in_si_units() {
    let folder = Folder::new();
    let (monday, tuesday) = (cart_log(20, 0.0, 0.0), cart_log(10, 0.0, 1.0));
    folder.write("si.robot", CART);
    folder.write("cart.robot", &cart());
    folder.write("monday_si.csv", &monday);
    folder.write("tuesday_si.csv", &tuesday);
    folder.write("monday.csv", &as_of_the_drive(&monday));
    folder.write("tuesday.csv", &as_of_the_drive(&tuesday));
    let wanted = [
        "monday_si.csv",
        "--validate",
        "tuesday_si.csv",
        "--json",
        "si.json",
    ];
    folder.succeed(&[&["identify", "si.robot"], &wanted[..]].concat());
    let own = [
        "monday.csv",
        "--validate",
        "tuesday.csv",
        "--json",
        "own.json",
    ];
    let run = folder.run(&[&["identify", "cart.robot"], &own[..]].concat());
    assert_eq!(run.code, Some(0), "{}", run.stderr);
    assert!(
        run.stderr
            .contains("monday.csv: columns without numbers are ignored: `mode`"),
        "{}",
        run.stderr
    );
    let (wanted, found) = (
        json(&folder.read("si.json")),
        json(&folder.read("own.json")),
    );
    let parameters = |report: &serde_json::Value| -> Vec<f64> {
        let list = report["parameters"].as_array().expect("a list").clone();
        list.iter()
            .flat_map(|own| numbers(&serde_json::json!([own["value"], own["std"]])))
            .collect()
    };
    for (own, si) in parameters(&found).into_iter().zip(parameters(&wanted)) {
        close(own, si, 1e-6 * si.abs());
    }
    close(
        numbers(&found["rmse_validate"])[0],
        numbers(&wanted["rmse_validate"])[0],
        1e-3 * numbers(&wanted["rmse_validate"])[0],
    );

    // Piece by piece, too, and for the verbs that read one log.
    folder.succeed(&[
        "identify",
        "cart.robot",
        "monday.csv",
        "--factor",
        "f.json",
        "--json",
        "pieces.json",
    ]);
    let pieces = json(&folder.read("pieces.json"));
    for (own, si) in numbers(&pieces["rmse"])
        .into_iter()
        .zip(numbers(&wanted["rmse"]))
    {
        close(own, si, 1e-3 * si);
    }
    folder.succeed(&[
        "dissect",
        "cart.robot",
        "monday.csv",
        "--parameters",
        "own.json",
    ]);
    let traced = folder.succeed(&[
        "trace",
        "cart.robot",
        "monday.csv",
        "--validate",
        "tuesday.csv",
    ]);
    assert!(
        traced.contains("nothing is missing") || traced.contains("nothing missing"),
        "{traced}"
    );
}

/// What `simulate` writes is read by its own names with the same spec, and what has neither is refused by those of the spec.
#[test]
fn a_simulated_log_needs_no_second_spec() {
    let folder = Folder::new();
    // Torques of standard columns are per `actuator_gain` as ever: amperes.
    let mut log = String::from("time,q1,tau1\n");
    for row in cart_log(20, 0.0, 0.0).lines().skip(1) {
        let (start, tau) = row.rsplit_once(',').expect("three fields");
        let tau: f64 = tau.parse().expect("a number");
        writeln!(log, "{start},{}", tau / -42.0).expect("a string takes all");
    }
    folder.write("cart.robot", &cart());
    folder.write("log.csv", &log);
    let run = folder.run(&["identify", "cart.robot", "log.csv", "--json", "fit.json"]);
    assert_eq!(run.code, Some(0), "{}", run.stderr);
    assert!(
        run.stderr
            .contains("lacks the columns named by the spec's `log`"),
        "{}",
        run.stderr
    );
    let fit = json(&folder.read("fit.json"));
    close(
        numbers(&serde_json::json!([fit["parameters"][0]["value"]]))[0],
        3.0,
        0.03,
    );
    folder.write("log.csv", &log.replace("tau1", "amps"));
    let refused = folder.refuse(&["identify", "cart.robot", "log.csv"]);
    assert!(
        refused.contains("missing columns `stamp [ms]`, `pos, rail`, `current`"),
        "{refused}"
    );
}

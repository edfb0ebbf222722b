//! `dissect`.

use serde_json::Value;

use crate::verbs::common::{CART, Folder, cart_log, close, json, numbers};

const TRUE: &str = r#"{"cart.m": 3, "rail.viscous_friction.fv": 5}"#;

/// A cart of 3 kg on a level rail: inertia and friction, and what the model does not have is left.
#[test]
fn dissect_gives_the_shares_of_a_cart() {
    let folder = Folder::new();
    folder.write("cart.robot", CART);
    folder.write("log.csv", &cart_log(20, 0.0, 0.0));
    folder.write("true.json", TRUE);
    folder.write("other.csv", &cart_log(20, 4.0, 0.0));
    let report = |log: &str| {
        let arguments = [
            "dissect",
            "cart.robot",
            log,
            "--parameters",
            "true.json",
            "--json",
            "out.json",
        ];
        (folder.succeed(&arguments), json(&folder.read("out.json")))
    };
    let (table, clean) = report("log.csv");
    let names = |report: &Value| -> Vec<String> {
        let shares = report["shares"].as_array().expect("a list");
        shares
            .iter()
            .map(|share| share["name"].as_str().expect("a name").to_owned())
            .collect()
    };
    let wanted = [
        "inertia",
        "coriolis",
        "gravity",
        "rail.viscous_friction",
        "rest",
    ];
    assert_eq!(names(&clean), wanted);
    assert!(wanted.iter().all(|name| table.contains(name)), "{table}");
    let rms = |report: &Value, k: usize| numbers(&report["shares"][k]["rms"])[0];
    let measured = numbers(&clean["measured"])[0];
    assert!(rms(&clean, 0) > 0.1 * measured && rms(&clean, 3) > 0.1 * measured);
    close(rms(&clean, 1) + rms(&clean, 2), 0.0, 1e-12);
    // Inertia and viscous friction are a quarter period apart.
    let model = numbers(&clean["model"])[0];
    close(rms(&clean, 0).hypot(rms(&clean, 3)), model, 0.05 * model);
    assert!(rms(&clean, 4) < 0.05 * measured, "{table}");

    let (_, rubbing) = report("other.csv");
    close(rms(&rubbing, 4), 4.0, 0.3);
}

#[test]
fn dissect_refuses_what_has_no_shares() {
    let folder = Folder::new();
    folder.write("cart.robot", CART);
    folder.write("log.csv", &cart_log(5, 0.0, 0.0));
    let said = folder.refuse(&["dissect", "cart.robot", "log.csv", "--json", "out.json"]);
    assert!(
        said.contains("no value for `cart.m`, `rail.viscous_friction.fv`"),
        "{said}"
    );
    folder.write("true.json", TRUE);
    let dissect = [
        "dissect",
        "cart.robot",
        "log.csv",
        "--parameters",
        "true.json",
    ];
    let said = folder.refuse(&[dissect.as_slice(), &["--json", "log.csv"]].concat());
    assert!(said.contains("the same file as the input"), "{said}");
    folder.write(
        "warm.robot",
        &CART.replace(
            "viscous_friction on rail;",
            "viscous_friction on rail; temperature_viscous(beta = 0.03) on rail;",
        ),
    );
    folder.write(
        "warm.json",
        &TRUE.replace('}', r#", "rail.temperature_viscous.fv": 1}"#),
    );
    let said = folder.refuse(&[
        "dissect",
        "warm.robot",
        "log.csv",
        "--parameters",
        "warm.json",
    ]);
    assert!(said.contains("column"), "{said}");
}

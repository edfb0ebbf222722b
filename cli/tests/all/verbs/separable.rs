//! `trace`: what others of the model do as well has no value of its own.

use serde_json::Value;

use crate::verbs::common::{Folder, PENDULUM, close, json, moved};

/// The inertia of a coupled motor is that of the second link, less its rotor's: their sums are told. Its friction is told alone.
#[test]
fn a_parameter_that_a_sum_of_others_replaces_has_no_value() {
    let folder = Folder::new();
    let with = |effects: &str| {
        let declared = format!(
            "\n    effects {{ viscous_friction on all; motor_inertia on all; {effects} }}\n}}\n"
        );
        PENDULUM.replace("\n}\n", &declared)
    };
    let values = r#"{"upper.viscous_friction.fv": 0.5, "lower.viscous_friction.fv": 0.2,
        "upper.motor_inertia.ia": 0.02, "lower.motor_inertia.ia": 0.02,
        "upper.gear_coupling.ia": 0.01, "upper.gear_coupling.fv": 0.05, "upper.gear_coupling.fc": 0.4}"#;
    let coupled = with("gear_coupling on (upper, lower);");
    moved(&folder, &coupled, values, |t| {
        [
            0.6 * (1.3 * t).sin() + 0.3 * (2.9 * t).sin(),
            0.7 * (1.9 * t).sin() - 0.4 * (3.3 * t).cos(),
        ]
    });
    folder.write("arm.robot", &with(""));
    let told = folder.succeed(&[
        "trace",
        "arm.robot",
        "log.csv",
        "--json",
        "out.json",
        "--report",
        "page",
    ]);
    let out = json(&folder.read("out.json"));
    let effects = out["effects"].as_array().expect("a list");
    assert_eq!(effects.len(), 1, "{told}");
    assert_eq!(effects[0]["kind"], "gear-coupling", "{told}");
    let parameter = |name: &str| {
        let mut all = effects[0]["parameters"].as_array().into_iter().flatten();
        all.find(|one| one["name"] == name).expect("a parameter")
    };
    let coupling = parameter("ia");
    assert_eq!(
        (&coupling["std"], &coupling["interval"]),
        (&Value::Null, &Value::Null)
    );
    let friction = parameter("fc");
    close(friction["value"].as_f64().expect("a number"), 0.4, 0.02);
    assert!(friction["interval"].is_array(), "{friction}");
    let words = "ia not separable from other parameters, fv = ";
    assert!(told.contains(words), "{told}");
    assert!(folder.read("page/index.html").contains(words));
}

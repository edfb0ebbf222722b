//! `trace`: friction with a memory is named by the fewest parameters that say it.

use crate::verbs::common::{Folder, PENDULUM, close, json, moved};

/// Dahl's friction is bristles whose friction does not rise, and a loop that bends in one of its ways: neither of them is needed, and what
/// bristles do more is no alternative.
#[test]
fn bristles_that_do_not_rise_are_named_with_two_parameters() {
    let folder = Folder::new();
    let with = |effects: &str| {
        let declared = format!("\n    effects {{ viscous_friction on all; {effects} }}\n}}\n");
        PENDULUM.replace("\n}\n", &declared)
    };
    let values = r#"{"upper.viscous_friction.fv": 0.5, "lower.viscous_friction.fv": 0.2, "lower.dahl.fc": 0.6}"#;
    moved(&folder, &with("dahl(d = 0.08) on lower;"), values, |t| {
        [
            0.6 * (1.3 * t).sin() + 0.3 * (2.9 * t).sin(),
            0.7 * (1.9 * t).sin() - 0.4 * (3.3 * t).cos(),
        ]
    });
    folder.write("arm.robot", &with(""));
    let trace = ["trace", "arm.robot", "log.csv", "--json", "out.json"];
    let told = folder.succeed(&[&trace[..], &["--amend", "amended.robot"]].concat());
    let out = json(&folder.read("out.json"));
    let effects = out["effects"].as_array().expect("a list");
    assert_eq!(effects.len(), 1, "{told}");
    assert_eq!(effects[0]["kind"], "lugre-presliding", "{told}");
    let parameters = effects[0]["parameters"].as_array().expect("a list");
    for (parameter, (name, truth)) in parameters.iter().zip([("fc", 0.6), ("d", 0.08)]) {
        assert_eq!(parameter["name"], name, "{told}");
        close(parameter["value"].as_f64().expect("a number"), truth, 0.02);
    }
    assert_eq!(parameters.len(), 2, "{told}");
    assert!(
        told.contains("dahl on lower (of the kind lugre-presliding): fc = "),
        "{told}"
    );
    let alternatives = out["alternatives"].as_array().expect("a list");
    let is_same = |other: &serde_json::Value| other["kind"] == "lugre-presliding";
    assert!(!alternatives.iter().any(is_same), "{told}");
    assert!(folder.read("amended.robot").contains("dahl(d = 0.0"));
}

//! `trace`: effects that change where links stand or where gravity comes from.

use crate::verbs::common::{Folder, close, folding as spec, json, moved};

/// What `trace` says of the arm, whose log is that of the arm with `effect`, as text and JSON; and the amended spec.
fn traced(effect: &str) -> (String, serde_json::Value, String) {
    let folder = Folder::new();
    folder.write("arm.robot", &spec(""));
    let values = r#"{"up.viscous_friction.fv": 1.0, "lo.viscous_friction.fv": 0.5,
        "up.coulomb_friction.fc": 0.5, "lo.coulomb_friction.fc": 0.3}"#;
    moved(&folder, &spec(effect), values, |t| {
        [
            -1.57 + 0.9 * (1.3 * t).sin() + 0.2 * (4.1 * t).sin(),
            0.9 * (2.1 * t).sin() + 0.2 * (5.3 * t).cos(),
        ]
    });
    let outputs = ["--json", "out.json", "--amend", "found.robot"];
    let told = folder.succeed(&[&["trace", "arm.robot", "log.csv"][..], &outputs].concat());
    let out = json(&folder.read("out.json"));
    (told, out, folder.read("found.robot"))
}

/// The only effect that is found, of one kind, and the values of its shapes.
fn only(told: &str, out: &serde_json::Value, kind: &str) -> Vec<f64> {
    assert_eq!(out["outcome"], "explained", "{told}");
    let effects = out["effects"].as_array().expect("a list");
    assert_eq!(
        (effects.len(), &effects[0]["kind"]),
        (1, &kind.into()),
        "{told}"
    );
    let parameters = effects[0]["parameters"].as_array().expect("a list").iter();
    parameters
        .map(|parameter| parameter["value"].as_f64().expect("a value"))
        .collect()
}

#[test]
fn a_base_that_is_tilted_is_named_with_both_angles() {
    let (told, out, found) = traced("base_tilt(first = 0.05, second = -0.03);");
    let angles = only(&told, &out, "base-tilt");
    close(angles[0], 0.05, 0.003);
    close(angles[1], -0.03, 0.003);
    assert_eq!(out["effects"][0]["joint"], serde_json::Value::Null);
    assert!(found.contains("base_tilt(first = "), "{told}");
}

#[test]
fn an_encoder_with_another_zero_is_named_with_its_joint() {
    let (told, out, found) = traced("encoder_offset(offset = 0.04) on lo;");
    let offset = only(&told, &out, "encoder-offset");
    close(offset[0], 0.04, 0.003);
    assert_eq!(out["effects"][0]["joint"], 2, "{told}");
    assert!(
        found.contains("encoder_offset(offset = ") && found.contains(" on lo;"),
        "{told}"
    );
}

#[test]
fn nothing_is_changed_where_nothing_is_missing() {
    let (told, out, found) = traced("");
    assert_eq!(out["outcome"], "nothing-missing", "{told}");
    assert_eq!(found, spec(""));
}

//! The demo is the main job: its outcome is held here.

use std::process::Command;

use serde_json::Value;

/// The numbers of one list of a report.
fn numbers(report: &Value, key: &str) -> Vec<f64> {
    let list = report[key].as_array().expect("a list per joint");
    list.iter()
        .map(|value| value.as_f64().expect("a number"))
        .collect()
}

#[test]
fn a_clean_arm_is_left_alone_and_a_worn_one_is_explained() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let output = Command::new(env!("CARGO_BIN_EXE_robot-model"))
        .current_dir(folder.path())
        .args(["demo", "--json", "demo.json"])
        .output()
        .expect("the program starts");
    assert!(
        output.status.success(),
        "{}",
        String::from_utf8_lossy(&output.stderr)
    );
    let told = String::from_utf8(output.stdout).expect("the program writes text");
    for part in [
        "nothing missing",
        "stribeck on elbow",
        "+         stribeck(vs = ",
        "relative, validation",
    ] {
        assert!(told.contains(part), "`{part}` is not in:\n{told}");
    }

    let text = std::fs::read_to_string(folder.path().join("demo.json")).expect("the report");
    let report: Value = serde_json::from_str(&text).expect("JSON");
    let (clean, worn) = (&report["clean"], &report["worn"]);
    assert_eq!(clean["outcome"], "nothing-missing");
    assert_eq!(clean["effects"].as_array().map(Vec::len), Some(0));
    assert_eq!(numbers(clean, "rmse_before"), numbers(clean, "rmse_after"));

    assert_eq!(worn["outcome"], "explained");
    let effects = worn["effects"].as_array().expect("a list");
    assert_eq!(effects.len(), 1, "{effects:#?}");
    assert_eq!(
        (&effects[0]["kind"], &effects[0]["joint"]),
        (&"stribeck".into(), &3.into())
    );
    // The plant's law is 2.2 N m with 0.15 rad/s.
    for (parameter, truth) in effects[0]["parameters"]
        .as_array()
        .expect("a list")
        .iter()
        .zip([2.2, 0.15])
    {
        let value = parameter["value"].as_f64().expect("a number");
        assert!((value / truth - 1.0).abs() < 0.05, "{parameter}");
    }
    // Bristles explain as much with five parameters, none of which the log tells.
    let tried = worn["tried"].as_array().expect("what was tried");
    let mut bristles = tried.iter().filter(|tried| {
        let refused = tried["refused"].as_array();
        tried["kind"] == "lugre-presliding" && refused.is_some_and(|all| *all == ["undetermined"])
    });
    assert!(bristles.next().is_some(), "{tried:#?}");
    let (before, after) = (
        numbers(worn, "relative_percent_before"),
        numbers(worn, "relative_percent_after"),
    );
    assert!(
        before[2] > 4.0 && after[2] < 1.5,
        "elbow: {} % before, {} % after",
        before[2],
        after[2]
    );
}

//! `audit` of values that say how sure they are.

use crate::verbs::common::{Folder, PENDULUM};

/// A fit that bodies miss by less than its deviations is none that fails.
#[test]
fn what_bodies_miss_within_deviations_is_noted() {
    let bare: Vec<&str> = PENDULUM
        .lines()
        .filter(|line| !line.contains("link "))
        .collect();
    let folder = Folder::new();
    folder.write("arm.robot", &bare.join("\n"));
    let run = |std: f64| {
        let base = [
            ("upper.mxr", 1.1),
            ("upper.my", 0.02),
            ("upper.izzr", 0.4),
            ("lower.mxr", 0.2),
            ("lower.my", 0.01),
            ("lower.izzr", -0.45),
        ];
        let list =
            base.map(|(name, value)| serde_json::json!({"name": name, "value": value, "std": std}));
        let fit = serde_json::json!({"method": "wls", "parameters": list});
        folder.write("fit.json", &fit.to_string());
        folder.run(&["audit", "arm.robot", "--parameters", "fit.json"])
    };
    let sure = run(1e-3);
    assert_eq!(sure.code, Some(1), "{}", sure.stdout);
    assert!(
        sure.stdout.contains("the nearest possible arm has `")
            && sure.stdout.contains(" standard deviations)")
            && sure.stdout.contains("`identify --method physical` finds"),
        "{}",
        sure.stdout
    );
    let unsure = run(1.0);
    let mut lines = unsure.stdout.lines();
    let verdict = lines.find(|line| line.starts_with("bodies"));
    assert!(
        verdict.is_some_and(|line| line.contains(" passed ")),
        "{}",
        unsure.stdout
    );
    assert!(
        unsure
            .stdout
            .contains("possible within standard deviations; the nearest possible arm has `"),
        "{}",
        unsure.stdout
    );
}

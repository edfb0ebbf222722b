//! Friction that is another law of speed than the spec's.

use crate::verbs::common::{Folder, json, two_joints_waving};
use crate::verbs::payload::spec;

/// The value of a parameter and its deviation.
fn found(folder: &Folder, name: &str) -> [f64; 2] {
    let fit = json(&folder.read("fit.json"));
    let mut all = fit["parameters"].as_array().expect("a list").iter();
    let parameter = all.find(|parameter| parameter["name"] == name);
    let parameter = parameter.expect("the spec has it");
    ["value", "std"].map(|key| parameter[key].as_f64().expect("told"))
}

#[test]
fn friction_of_another_law_is_told_and_in_deviations() {
    let folder = Folder::new();
    folder.write("arm.robot", &spec(""));
    folder.write("plant.robot", &spec("stribeck on lo;"));
    let values = r#"{"up.viscous_friction.fv": 1.0, "lo.viscous_friction.fv": 0.5, "up.coulomb_friction.fc": 1.5, "lo.coulomb_friction.fc": 0.7"#;
    folder.write("plain.json", &format!("{values}}}"));
    let curve = r#", "lo.stribeck.fs": 1.5, "lo.stribeck.vs": 0.3}"#;
    folder.write("curve.json", &format!("{values}{curve}"));
    folder.write(
        "wanted.csv",
        &two_joints_waving(10_000, 0.25, &[1.9, 4.4, 6.9, 10.1]),
    );
    let of = |plant: &str, values: &str| {
        let simulate = ["simulate", plant, "--parameters", values];
        let motion = ["--trajectory", "wanted.csv", "--rate", "500"];
        let sensors = [
            "--torque-noise",
            "0.02",
            "--encoder-bits",
            "17",
            "--seed",
            "1",
        ];
        let out = ["--out", "log.csv"];
        folder.succeed(&[&simulate[..], &motion, &sensors, &out].concat());
        let run = folder.run(&["identify", "arm.robot", "log.csv", "--json", "fit.json"]);
        assert_eq!(run.code, Some(0), "{}", run.stderr);
        let is_told = run
            .stderr
            .contains("friction depends on speed differently than the spec says: `lo");
        (is_told, found(&folder, "lo.coulomb_friction.fc"))
    };
    let (is_told, [value, std]) = of("arm.robot", "plain.json");
    assert!(!is_told);
    assert!(
        (value - 0.7).abs() < 3.0 * std && std < 0.02,
        "{value} {std}"
    );
    let (is_told, [value, std]) = of("plant.robot", "curve.json");
    assert!(is_told);
    assert!(
        (value - 0.7).abs() < 3.0 * std && std > 0.1,
        "{value} {std}"
    );
}

/// A joint that goes back and forth in a few encoder steps is at a turn all the time, and the other one is not.
#[test]
fn what_turns_alone_tell_is_named() {
    let folder = Folder::new();
    folder.write("arm.robot", &spec(""));
    folder.write(
        "values.json",
        r#"{"up.viscous_friction.fv": 1.0, "lo.viscous_friction.fv": 0.5, "up.coulomb_friction.fc": 1.5, "lo.coulomb_friction.fc": 0.7}"#,
    );
    let said = |size: f64| {
        let wanted = two_joints_waving(5000, 0.25, &[1.9, 4.4, 6.9, 10.1]);
        let slower = wanted.lines().enumerate().map(|(k, line)| {
            let (first, _) = line.rsplit_once(',').expect("three columns");
            let t = 0.002 * f64::from(u32::try_from(k).expect("small"));
            match k {
                0 => format!("{line}\n"),
                _ => format!("{first},{}\n", 0.3 + size * (4.4 * t).sin()),
            }
        });
        folder.write("wanted.csv", &slower.collect::<String>());
        let simulate = ["simulate", "arm.robot", "--parameters", "values.json"];
        let motion = ["--trajectory", "wanted.csv", "--rate", "500"];
        let sensors = [
            "--torque-noise",
            "0.02",
            "--encoder-bits",
            "13",
            "--seed",
            "1",
        ];
        folder.succeed(&[&simulate[..], &motion, &sensors, &["--out", "log.csv"]].concat());
        let notes = folder.run(&["identify", "arm.robot", "log.csv"]).stderr;
        let mut notes = notes.lines().map(str::to_owned);
        notes.find(|note| note.contains("only rows near velocity reversals determine"))
    };
    let told = said(0.05).expect("a note");
    assert!(told.contains("`lo.coulomb_friction.fc`"), "{told}");
    assert!(!told.contains("`up.coulomb_friction.fc`"), "{told}");
    assert_eq!(said(0.6), None);
}

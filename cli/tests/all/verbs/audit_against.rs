//! `audit --against`: whether two files of parameters are of one arm.

use serde_json::{Value, json as value};

use crate::verbs::audit::findings;
use crate::verbs::common::{Folder, json};

/// A pendulum with its motor, whose back-EMF brakes as viscous friction does.
const MOTOR: &str = "
effect back_emf(j) { linear k >= 0; torque(j) = k * dq(j); }
robot Motor {
    gravity = [0, -9.81, 0];
    convention = modified_dh;
    joint one: revolute { a = 0; alpha = 0; d = 0; }
    effects { viscous_friction on one; back_emf on one; stribeck on one; coulomb_friction on one; }
}";

/// Standard parameters, none of which is rounded.
fn standard() -> Value {
    value!({
        "one.izz": 0.5, "one.mx": 1.2, "one.my": 0.1,
        "one.viscous_friction.fv": 0.3, "one.back_emf.k": 1.5,
        "one.coulomb_friction.fc": 0.8, "one.stribeck.fs": 0.4, "one.stribeck.vs": 0.1
    })
}

/// Exit code, the check `against` and what was printed.
fn asked(one: &Value, other: &Value) -> (Option<i32>, Value, String) {
    let folder = Folder::new();
    folder.write("motor.robot", MOTOR);
    folder.write("one.json", &one.to_string());
    folder.write("other.json", &other.to_string());
    let files = ["--parameters", "one.json", "--against", "other.json"];
    let run = folder.run(
        &[
            &["audit", "motor.robot"],
            &files[..],
            &["--json", "out.json"],
        ]
        .concat(),
    );
    let out = json(&folder.read("out.json"));
    let mut checks = out["checks"].as_array().expect("a list").iter();
    let check = checks.find(|check| check["name"] == "against");
    (run.code, check.expect("it was asked").clone(), run.stdout)
}

/// What `identify` writes, as far as it is read: base parameters with deviations.
fn fit(viscous: f64, std: f64) -> Value {
    let all = [
        ("one.izz", 0.5, 0.001),
        ("one.mx", 1.2, 0.001),
        ("one.my", 0.1, 0.001),
        ("one.viscous_friction.fvr", viscous, std),
        ("one.stribeck.fs", 0.4, 0.001),
        ("one.coulomb_friction.fc", 0.8, 0.001),
        ("one.stribeck.vs", 0.1, 0.001),
    ];
    let all = all.map(|(name, value, std)| value!({"name": name, "value": value, "std": std}));
    value!({ "parameters": all })
}

#[test]
fn sums_that_torques_tell_are_compared_and_their_parts_are_not() {
    let mut other = standard();
    // The brake may be the motor's or the bearing's.
    other["one.viscous_friction.fv"] = value!(1.8);
    other["one.back_emf.k"] = value!(0.0);
    // As three digits of it.
    other["one.izz"] = value!(0.502);
    let (code, check, said) = asked(&standard(), &other);
    assert_eq!((code, findings(&check)), (Some(0), vec![]), "{said}");
    assert!(said.contains("against   passed"), "{said}");
}

#[test]
fn a_value_that_is_another_is_told_from_either_side() {
    let mut other = standard();
    other["one.viscous_friction.fv"] = value!(0.4);
    other["one.stribeck.vs"] = value!(0.12);
    let (code, check, said) = asked(&standard(), &other);
    assert_eq!(code, Some(1), "{said}");
    let told = [
        "`one.viscous_friction.fvr` is 1.8, in the other source 1.9: 5.3 % of its parts",
        "`one.stribeck.vs` is 0.1, in the other source 0.12: 16.7 % of it",
    ];
    assert_eq!(findings(&check), told);
    let numbers = check["quantities"].as_array().expect("a list");
    let apart = numbers.iter().find(|one| one["what"] == "apart");
    let apart = apart
        .and_then(|one| one["value"].as_f64())
        .expect("a number");
    assert!((apart + 0.1).abs() < 1e-12, "{apart}");
    let (code, check, _) = asked(&other, &standard());
    assert_eq!((code, findings(&check).len()), (Some(1), 2));
}

#[test]
fn deviations_of_a_fit_are_room() {
    for (viscous, std, far) in [
        (1.9, 0.05, None),
        (2.1, 0.05, Some("6.0 standard deviations apart")),
        (1.9, 0.01, Some("10.0 standard deviations apart")),
    ] {
        let (code, check, said) = asked(&fit(viscous, std), &standard());
        let found = findings(&check);
        let is_told = match far {
            None => found.is_empty() && code == Some(0),
            Some(far) => found.len() == 1 && found[0].ends_with(far) && code == Some(1),
        };
        assert!(is_told, "{viscous}: {found:?} {said}");
    }
}

/// A Stribeck speed of two days, and a sum that a log did not tell on one of them.
#[test]
fn shapes_have_deviations_and_what_no_log_told_is_left_out() {
    let with = |name: &str, value: f64, std: Value| {
        let mut file = fit(1.8, 0.01);
        let list = file["parameters"].as_array_mut().expect("a list");
        let entry = list.iter_mut().find(|entry| entry["name"] == name);
        *entry.expect("it is there") = value!({"name": name, "value": value, "std": std});
        file
    };
    let vs = "one.stribeck.vs";
    for (other, is_one) in [(0.11, true), (0.16, false)] {
        let files = [with(vs, 0.1, value!(0.01)), with(vs, other, value!(0.01))];
        let (code, check, said) = asked(&files[0], &files[1]);
        assert_eq!(
            (code == Some(0), findings(&check).is_empty()),
            (is_one, is_one),
            "{said}"
        );
    }
    let untold = with("one.my", 0.7, Value::Null);
    let (code, _, said) = asked(&untold, &fit(1.8, 0.01));
    assert_eq!(code, Some(0), "{said}");
    assert!(said.contains("without 1 not identified"), "{said}");
}

#[test]
fn a_source_without_a_value_is_refused_by_its_name() {
    let folder = Folder::new();
    folder.write("motor.robot", MOTOR);
    folder.write("one.json", &standard().to_string());
    folder.write("other.json", r#"{"one.izz": 0.5}"#);
    let files = ["--parameters", "one.json", "--against", "other.json"];
    let run = folder.run(&[&["audit", "motor.robot"], &files[..]].concat());
    assert_eq!(run.code, Some(1));
    assert!(
        run.stderr.contains("other.json: no value for"),
        "{}",
        run.stderr
    );
}

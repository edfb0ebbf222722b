//! `audit`: base parameters of another source, and what motors lift.

use serde_json::{Value, json as value};

use crate::verbs::audit::{audit, findings};
use crate::verbs::common::{Folder, json};

/// Two links in a plane: `izz1 + l^2 m2`, `mx1 + l m2`, `my1`, and `izz`, `mx`, `my` of the second link.
const TWO: &str = "robot Two {
    gravity = [0, -9.81, 0];
    convention = modified_dh;
    joint one: revolute { a = 0; alpha = 0; d = 0; }
    joint two: revolute { a = 0.5 m; alpha = 0; d = 0; }
}";

fn sums() -> Value {
    value!({
        "zz1": {"one.izz": 1, "two.m": 0.25},
        "x1": {"one.mx": 1, "two.m": 0.5},
        "y1": {"one.my": 1},
        "zz2": {"two.izz": 1},
        "x2": {"two.mx": 1},
        "y2": {"two.my": 1},
    })
}

/// Exit code and the check `base`.
fn asked(sums: &Value) -> (Option<i32>, Value) {
    let folder = Folder::new();
    folder.write("two.robot", TWO);
    folder.write("paper.json", &sums.to_string());
    let run = folder.run(&[
        "audit",
        "two.robot",
        "--base",
        "paper.json",
        "--json",
        "out.json",
    ]);
    let out = json(&folder.read("out.json"));
    let checks = out["checks"].as_array().expect("a list");
    assert_eq!(checks.len(), 1, "{}", run.stdout);
    assert_eq!(checks[0]["name"], "base");
    assert!(run.stdout.contains("base "), "{}", run.stdout);
    (run.code, checks[0].clone())
}

#[test]
fn sums_that_torques_tell_are_base_parameters_and_others_are_told_why() {
    let (code, check) = asked(&sums());
    assert_eq!((code, findings(&check)), (Some(0), vec![]));
    // Any combination of them is one, and three digits are enough.
    let mut other = sums();
    other["zz1"] = value!({"one.izz": 1, "one.mx": 2, "two.m": 1.254});
    assert_eq!(asked(&other).0, Some(0));
    for (name, parts, said) in [
        (
            "zz1",
            value!({"one.izz": 1, "two.m": 0.5}),
            "torques do not determine `zz1`: its other parts need 0.25 `two.m` (it has 0.5)",
        ),
        (
            "zz1",
            value!({"one.izz": 1}),
            "its other parts need 0.25 `two.m` (it has 0)",
        ),
        (
            "y1",
            value!({"one.my": 1, "one.mz": 1}),
            "its other parts need 0 `one.mz` (it has 1)",
        ),
        (
            "y2",
            value!({"two.mx": 3}),
            "5 of the sums are independent, but torques determine 6 base parameters: none contains `two.my`",
        ),
        (
            "more",
            value!({"two.mx": 3}),
            "only 6 of the 7 sums are independent",
        ),
    ] {
        let mut other = sums();
        other[name] = parts;
        let (code, check) = asked(&other);
        let told = findings(&check);
        assert!(code == Some(1) && told.len() == 1, "{told:?}");
        assert!(told[0].contains(said), "{told:?}");
    }
}

#[test]
fn sums_of_what_the_arm_has_not_are_refused() {
    let folder = Folder::new();
    folder.write("two.robot", TWO);
    for (text, said) in [
        (
            r#"{"a": {"one.ixz": 1, "two.mas": 1}}"#,
            "`a`: Two has no standard parameter `two.mas`",
        ),
        (
            r#"{"a": 1}"#,
            "write `{\"NAME\": {\"STANDARD PARAMETER\": FACTOR, ..}, ..}`",
        ),
    ] {
        folder.write("paper.json", text);
        let run = folder.run(&["audit", "two.robot", "--base", "paper.json"]);
        assert_eq!(run.code, Some(1));
        assert!(run.stderr.contains(said), "{}", run.stderr);
    }
    // With values of parameters all is looked at.
    folder.write("paper.json", &sums().to_string());
    let names = ["one.izz", "one.m", "two.izz", "two.m"].map(|name| (name, 1.0));
    let zero = ["one", "two"].into_iter().flat_map(|link| {
        let parts = ["mx", "my", "mz", "ixx", "ixy", "ixz", "iyy", "iyz"];
        parts.map(|part| (format!("{link}.{part}"), 0.0))
    });
    let names = names.map(|(name, x)| (name.to_owned(), x)).into_iter();
    let mut all: serde_json::Map<String, Value> = names
        .chain(zero)
        .map(|(name, x)| (name, x.into()))
        .collect();
    for name in ["one.iyy", "two.iyy", "one.ixx", "two.ixx"] {
        all.insert(name.to_owned(), 0.5.into());
    }
    folder.write("values.json", &Value::Object(all).to_string());
    let both = ["--parameters", "values.json", "--base", "paper.json"];
    let said = folder.succeed(&[&["audit", "two.robot"][..], &both].concat());
    assert!(
        said.contains("inertia   passed") && said.contains("base      passed"),
        "{said}"
    );
}

/// A block of 1 kg that hangs on its motor.
#[test]
fn a_motor_that_does_not_hold_its_arm_is_told() {
    for (motor, holds) in [(9.0, false), (10.0, true)] {
        let lift = format!(
            "robot Lift {{
    coordinates x: m;
    parameters m = 1 kg;
    constants g = 9.81 m/s^2;
    kinetic = m/2*dot(x)^2;
    potential = m*g*x;
    limits x {{ velocity = 1; torque = {motor} N; }}
    effects {{ coulomb_friction on all; }}
}}"
        );
        let values = [("x.coulomb_friction.fc".to_owned(), 0.5)].into();
        let (_, checks, text) = audit(&lift, &values);
        let told = findings(&checks["drives"]);
        assert_eq!(told.is_empty(), holds, "{text}");
        if !holds {
            assert!(
                told[0].starts_with("joint `x` needs 9.8100 N at rest at q = [")
                    && told[0].ends_with(
                        "but its torque limit is 9.0000 N: it cannot hold the arm there"
                    ),
                "{text}"
            );
        }
    }
}

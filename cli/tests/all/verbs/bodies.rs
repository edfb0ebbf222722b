//! `trace`: bodies on links whose inertials are known.

use std::fmt::Write;

use crate::verbs::common::{Folder, close, json, moved};

fn spec(effects: &str) -> String {
    format!(
        "robot A {{
            gravity = [0, -9.81, 0];
            convention = standard_dh;
            joint up: revolute {{ a = 0.5; alpha = 0; d = 0; }}
            joint lo: revolute {{ a = 0.4; alpha = 0; d = 0; }}
            link up: fixed {{ mass = 2; com = [-0.25, 0, 0]; inertia = [0.001, 0, 0, 0.05, 0, 0.05]; }}
            link lo: fixed {{ mass = 1; com = [-0.2, 0, 0]; inertia = [0.001, 0, 0, 0.02, 0, 0.02]; }}
            effects {{ viscous_friction on all; coulomb_friction on all; {effects} }}
        }}"
    )
}

/// A folder with `arm.robot` and `log.csv` of the arm with a body more: its mass and first moment along the link, kg and kg m.
fn folder(effect: &str, joint: &str, body: [f64; 2]) -> Folder {
    let folder = Folder::new();
    folder.write("arm.robot", &spec(""));
    let mut values = String::from(
        r#"{"up.viscous_friction.fv": 1.0, "lo.viscous_friction.fv": 0.5, "up.coulomb_friction.fc": 1.5, "lo.coulomb_friction.fc": 0.7"#,
    );
    for name in ["my", "mz", "ixx", "ixy", "ixz", "iyy", "iyz", "izz"] {
        write!(values, r#", "{joint}.{effect}.{name}": 0"#).expect("a string takes all");
    }
    for (name, value) in ["m", "mx"].iter().zip(body) {
        write!(values, r#", "{joint}.{effect}.{name}": {value}"#).expect("a string takes all");
    }
    let spec = spec(&format!("{effect} on {joint};"));
    moved(&folder, &spec, &format!("{values}}}"), |t| {
        [
            -1.57 + 0.6 * (1.3 * t).sin() + 0.2 * (4.1 * t).sin(),
            0.7 * (2.1 * t).sin() + 0.2 * (5.3 * t).cos(),
        ]
    });
    folder
}

#[test]
fn what_the_last_link_carries_is_a_payload() {
    let folder = folder("payload", "lo", [0.8, 0.12]);
    let told = folder.succeed(&[
        "trace",
        "arm.robot",
        "log.csv",
        "--json",
        "out.json",
        "--amend",
        "found.robot",
    ]);
    let out = json(&folder.read("out.json"));
    assert_eq!(out["outcome"], "explained", "{told}");
    let effects = out["effects"].as_array().expect("a list");
    assert_eq!(effects.len(), 1, "{told}");
    assert_eq!(effects[0]["kind"], "payload");
    let parameters = effects[0]["parameters"].as_array().expect("a list");
    let value = |name: &str| {
        let found = parameters.iter().find(|p| p["name"] == name);
        found.and_then(|p| p["value"].as_f64()).expect("a value")
    };
    close(value("mx"), 0.12, 0.005);
    assert!(
        folder.read("found.robot").contains("payload on lo;"),
        "{told}"
    );
}

#[test]
fn a_known_link_that_is_wrong_is_named() {
    let folder = folder("link_inertial_error", "up", [-0.5, 0.2]);
    folder.succeed(&["trace", "arm.robot", "log.csv", "--json", "out.json"]);
    let out = json(&folder.read("out.json"));
    let effect = &out["effects"][0];
    assert_eq!(
        (&effect["kind"], &effect["joint"]),
        (&"link-inertial-error".into(), &1.into()),
        "{out}"
    );
    assert_eq!(out["outcome"], "explained");
}

/// Where a link is identified, its own parameters have what a body adds; a free shape of a tilt leaves bodies out.
#[test]
fn bodies_are_tried_on_known_links_alone() {
    let folder = folder("payload", "lo", [0.8, 0.12]);
    for (spec, is_silent) in [
        (spec("").replace(": fixed", ""), true),
        (spec("base_tilt;"), false),
    ] {
        folder.write("other.robot", &spec);
        let told = folder.succeed(&["trace", "other.robot", "log.csv"]);
        assert_eq!(told.starts_with("nothing missing"), is_silent, "{told}");
        assert!(!told.contains("payload"), "{told}");
    }
}

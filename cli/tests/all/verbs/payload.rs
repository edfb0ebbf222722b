//! `identify --payload`: what an arm carries, from logs with and without it.

use std::fmt::Write;

use serde_json::Value;

use crate::verbs::common::{Folder, json, numbers};

/// Mass, first moments and inertia of what is carried, about the origin of the link's frame.
pub(crate) const PAYLOAD: [(&str, f64); 4] =
    [("m", 0.8), ("mx", 0.12), ("my", -0.05), ("izz", 0.03)];

pub(crate) fn spec(effects: &str) -> String {
    format!(
        "robot A {{
            gravity = [0, -9.81, 0];
            convention = standard_dh;
            joint up: revolute {{ a = 0.5; alpha = 0; d = 0; }}
            joint lo: revolute {{ a = 0.4; alpha = 0; d = 0; }}
            link up {{ mass = 2; com = [-0.25, 0, 0]; inertia = [0.001, 0, 0, 0.05, 0, 0.05]; }}
            link lo {{ mass = 1; com = [-0.2, 0, 0]; inertia = [0.001, 0, 0, 0.02, 0, 0.02]; }}
            effects {{ viscous_friction on all; coulomb_friction on all; {effects} }}
        }}"
    )
}

/// Logs of different motions without and with the payload, of an arm with more effects.
pub(crate) fn folder(more: &str) -> Folder {
    let folder = Folder::new();
    folder.write("arm.robot", &spec(more));
    folder.write("loaded.robot", &spec(&format!("{more} payload on lo;")));
    let mut values = String::from(
        r#"{"up.viscous_friction.fv": 1.0, "lo.viscous_friction.fv": 0.5, "up.coulomb_friction.fc": 1.5, "lo.coulomb_friction.fc": 0.7"#,
    );
    if !more.is_empty() {
        values +=
            r#", "up.load_dependent_friction.mu": 0.06, "lo.load_dependent_friction.mu": 0.06"#;
    }
    folder.write("empty.json", &format!("{values}}}"));
    for name in ["mz", "ixx", "ixy", "ixz", "iyy", "iyz"] {
        write!(values, r#", "lo.payload.{name}": 0"#).expect("a string takes all");
    }
    for (name, value) in PAYLOAD {
        write!(values, r#", "lo.payload.{name}": {value}"#).expect("a string takes all");
    }
    folder.write("loaded.json", &format!("{values}}}"));
    for (spec, values, log, seed, phase) in [
        ("arm.robot", "empty.json", "empty.csv", "1", 1.0),
        ("loaded.robot", "loaded.json", "loaded.csv", "2", 2.5),
        ("loaded.robot", "loaded.json", "other.csv", "3", 0.3),
    ] {
        let mut wanted = String::from("time,q1,q2\n");
        for k in 0..=2400 {
            let t = f64::from(k) / 200.0;
            let up = -1.57 + 0.6 * (1.3 * t + phase).sin() + 0.2 * (4.1 * t).sin();
            let lo = 0.7 * (2.1 * t + phase).sin() + 0.2 * (5.3 * t).cos();
            writeln!(wanted, "{t},{up},{lo}").expect("a string takes all");
        }
        folder.write("wanted.csv", &wanted);
        let motion = ["--trajectory", "wanted.csv", "--out", log];
        let noise = ["--torque-noise", "0.02", "--seed", seed];
        folder.succeed(
            &[
                &["simulate", spec, "--parameters", values],
                &motion[..],
                &noise,
            ]
            .concat(),
        );
    }
    folder
}

pub(crate) fn parameter<'a>(fit: &'a Value, name: &str) -> &'a Value {
    let parameters = fit["parameters"].as_array().expect("a list");
    let found = parameters
        .iter()
        .find(|parameter| parameter["name"] == name);
    found.unwrap_or_else(|| panic!("{name}"))
}

#[test]
fn what_an_arm_carries_is_told_from_its_logs_with_and_without() {
    for more in ["", "load_dependent_friction on all;"] {
        let folder = folder(more);
        let identify = ["identify", "arm.robot", "empty.csv", "--json", "fit.json"];
        let payload = ["--payload", "loaded.csv", "--validate", "other.csv"];
        let said = folder.succeed(&[&identify[..], &payload].concat());
        let fit = json(&folder.read("fit.json"));
        for (name, truth) in PAYLOAD {
            let found = parameter(&fit["payload"], &format!("lo.payload.{name}"));
            let (value, std) = (&found["value"], &found["std"]);
            let off = value.as_f64().expect("a number") - truth;
            let std = std.as_f64().expect("a number");
            assert!(
                off.abs() < 4.0 * std + 2e-3 && std < 0.02,
                "{more} {name}: {off} {std}"
            );
        }
        // The arm alone is that of its own logs.
        let mass = parameter(&fit, "lo.mxr")["value"]
            .as_f64()
            .expect("a number");
        assert!((mass - 0.2).abs() < 0.02, "{mass}");
        // They are those of the spec, for whatever reads parameters.
        let values = ["--parameters", "fit.json"];
        folder.succeed(&[&["dissect", "arm.robot", "empty.csv"][..], &values].concat());
        let body = &fit["payload"];
        let kg = body["mass"].as_f64().expect("told");
        assert!(body["mass_std"].as_f64().expect("told") < 0.02);
        let center = body["center"].as_array().expect("a list");
        let x = center[0].as_f64().expect("told");
        let std = body["center_std"][0].as_f64().expect("told");
        let off = (x - 0.15).abs();
        assert!(off < 0.01 && off < 4.0 * std && std < 0.01, "{body}");
        assert!(
            center[2].is_null() && body["center_std"][2].is_null(),
            "{body}"
        );
        assert!(
            said.contains(&format!("payload on lo: {kg:.4} kg +-")),
            "{said}"
        );
        for errors in [&body["relative_percent"], &fit["relative_percent_validate"]] {
            let most = numbers(errors).into_iter().fold(0.0, f64::max);
            assert!(most < 5.0, "{errors}");
        }
    }
}

#[test]
fn links_and_options_that_do_not_fit_are_refused() {
    let folder = folder("");
    let identify = ["identify", "arm.robot", "empty.csv", "--json", "fit.json"];
    let said = |more: &[&str]| folder.refuse(&[&identify[..], more].concat());
    let loaded = ["--payload", "loaded.csv"];
    assert!(said(&[&loaded[..], &["--payload-link", "tip"]].concat()).contains("are up, lo"));
    folder.write(
        "fixed.robot",
        &spec("").replace("link lo {", "link lo: fixed {"),
    );
    let fixed = ["identify", "fixed.robot", "empty.csv"];
    let said_of_fixed = folder.refuse(&[&fixed[..], &loaded].concat());
    assert!(
        said_of_fixed.contains("link lo is fixed by the spec"),
        "{said_of_fixed}"
    );
    // In each other's place.
    let swapped = [
        "identify",
        "arm.robot",
        "loaded.csv",
        "--payload",
        "empty.csv",
    ];
    let run = folder.run(&swapped);
    assert_eq!(run.code, Some(0), "{}", run.stderr);
    assert!(run.stderr.contains("swapped?"), "{}", run.stderr);
    for more in [
        &["--method", "physical"][..],
        &["--factor", "out.json"],
        &["--form", "filtered"],
        &["--essential"],
    ] {
        let said = said(&[&loaded[..], more].concat());
        assert!(
            said.contains("--payload") || said.contains("--essential"),
            "{said}"
        );
    }
}

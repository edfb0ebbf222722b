//! What a transmission carries: links, without the rotor that turns them.

use crate::verbs::common::{Folder, json, moved};

/// An arm in a plane, with links of a status or without any that the spec knows.
pub(crate) fn arm(status: Option<&str>, effects: &str) -> String {
    let links = status.map_or_else(String::new, |status| {
        format!(
            "link up: {status} {{ mass = 2; com = [-0.25, 0, 0]; inertia = [0.001, 0, 0, 0.05, 0, 0.05]; }}
            link lo: {status} {{ mass = 1; com = [-0.2, 0, 0]; inertia = [0.001, 0, 0, 0.02, 0, 0.02]; }}"
        )
    });
    format!(
        "robot A {{
            gravity = [0, -9.81, 0];
            convention = standard_dh;
            joint up: revolute {{ a = 0.5; alpha = 0; d = 0; }}
            joint lo: revolute {{ a = 0.4; alpha = 0; d = 0; }}
            {links}
            effects {{ viscous_friction on all; {effects} }}
        }}"
    )
}

/// A motion of both joints, rad.
fn wanted(t: f64) -> [f64; 2] {
    [
        -1.57 + 0.6 * (1.3 * t).sin() + 0.2 * (4.1 * t).sin(),
        0.7 * (2.1 * t).sin() + 0.2 * (5.3 * t).cos(),
    ]
}

const MU: f64 = 0.15;

#[test]
fn friction_of_the_load_is_found_beside_a_rotor_that_nominal_links_tell() {
    let folder = Folder::new();
    let values = format!(
        r#"{{"up.viscous_friction.fv": 1.0, "lo.viscous_friction.fv": 0.5, "up.coulomb_friction.fc": 1.5, "lo.coulomb_friction.fc": 0.7,
            "up.motor_inertia.ia": 1.5, "lo.motor_inertia.ia": 0.2, "up.load_dependent_friction.mu": {MU}}}"#
    );
    // Of the rotor of `up` and its link one sum is told.
    let effects = "coulomb_friction on all; motor_inertia on all; load_dependent_friction on up;";
    moved(&folder, &arm(Some("nominal"), effects), &values, wanted);
    let mu = |status: Option<&str>| {
        folder.write("arm.robot", &arm(status, effects));
        folder.succeed(&["identify", "arm.robot", "log.csv", "--json", "fit.json"]);
        let fit = json(&folder.read("fit.json"));
        let parameters = fit["parameters"].as_array().expect("a list");
        let found = parameters
            .iter()
            .find(|one| one["name"] == "up.load_dependent_friction.mu");
        found.expect("it is declared")["value"]
            .as_f64()
            .expect("a number")
    };
    let found = mu(Some("nominal"));
    assert!((found - MU).abs() < 0.05 * MU, "{found}");
    // Nobody knows what the rotor has of the sum: it is taken for a load.
    let found = mu(None);
    assert!((found - MU).abs() > 0.3 * MU, "{found}");
}

/// Turns are told once a law has the friction that they are of: then which law it is has been asked along them, too.
#[test]
fn a_law_that_tells_how_a_joint_turns_is_asked_for_again() {
    let folder = Folder::new();
    let spec = |friction: &str| {
        arm(
            Some("fixed"),
            &format!("coulomb_friction on lo; {friction}"),
        )
    };
    let library = "effect soft(j) { linear fc; torque(j) = fc * tanh(dq(j) / 0.0045); }
        effect soft_load(j) { linear mu; torque(j) = mu * abs(rigid_torque(j)) * tanh(dq(j) / 0.0045); }";
    let values = r#"{"up.viscous_friction.fv": 1.0, "lo.viscous_friction.fv": 0.5, "lo.coulomb_friction.fc": 0.5, "up.soft.fc": 0.3,
        "up.soft_load.mu": 0.1}"#;
    let truth = format!("{library} {}", spec("soft on up; soft_load on up;"));
    moved(&folder, &truth, values, wanted);
    let simulate = ["simulate", "true.robot", "--parameters", "true.json"];
    let motion = ["--trajectory", "wanted.csv", "--out", "quiet.csv"];
    let noise = ["--torque-noise", "0.003", "--seed", "1"];
    folder.succeed(&[&simulate[..], &motion, &noise].concat());
    folder.write("arm.robot", &spec("coulomb_friction on up;"));
    let run = folder.run(&["trace", "arm.robot", "quiet.csv", "--json", "trace.json"]);
    assert_eq!(run.code, Some(0), "{}", run.stderr);
    let passes = run
        .stderr
        .matches("round 1: load-dependent-friction passes")
        .count();
    assert_eq!(passes, 2, "{}", run.stderr);
    let verdict = json(&folder.read("trace.json"));
    let effects = verdict["effects"].as_array().expect("a list");
    assert_eq!(effects.len(), 1, "{effects:?}");
    assert_eq!(effects[0]["kind"], "load-dependent-friction");
    let tried = verdict["tried"].as_array().expect("a list");
    let named = tried
        .iter()
        .filter(|one| one["kind"] == "load-dependent-friction" && one["round"] == 1);
    assert_eq!(named.count(), 1, "{tried:?}");
}

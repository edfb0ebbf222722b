//! `trace` on joints that bend: how well a stiffness is known is how well its load is.

use serde_json::Value;

use crate::verbs::common::{Folder, close, folding, json, moved};

/// A pendulum on a cart, of unknown links, and friction of both.
fn pendulum(effects: &str) -> String {
    format!(
        "robot G {{
            gravity = [0, 0, -9.81];
            convention = origin;
            joint rail: prismatic {{ xyz = [0, 0, 1]; axis = [1, 0, 0]; link = cart; }}
            joint arm: revolute {{ xyz = [0, 0, -0.1]; axis = [0, 1, 0]; link = pend; }}
            link cart {{ mass = 5; com = [0, 0, 0]; inertia = [0.03, 0, 0, 0.03, 0, 0.02]; }}
            link pend {{ mass = 2; com = [0.01, 0, -0.25]; inertia = [0.05, 0, 0, 0.05, 0, 0.01]; }}
            effects {{ viscous_friction on all; coulomb_friction on all; {effects} }}
        }}"
    )
}

/// A sum of sines: amplitude, rad/s, phase.
fn waves(t: f64, all: [[f64; 3]; 3]) -> f64 {
    all.iter()
        .map(|[size, speed, phase]| size * (speed * t + phase).sin())
        .sum()
}

fn motion(t: f64) -> [f64; 2] {
    let rail = [[0.6, 2.14, 0.56], [0.32, 2.69, 4.08], [0.21, 6.09, 5.14]];
    let arm = [[0.47, 1.39, 1.89], [0.4, 3.63, 3.93], [0.3, 5.77, 2.8]];
    [0.35 * waves(t, rail), 0.3 + 1.2 * waves(t, arm)]
}

/// What a trace says of a spec and the log of another, and the only parameter of the only effect, a stiffness.
fn traced(spec: &str, of: &str, values: &str, at: impl Fn(f64) -> [f64; 2]) -> (String, Value) {
    let folder = Folder::new();
    folder.write("arm.robot", spec);
    moved(&folder, of, values, at);
    let told = folder.succeed(&["trace", "arm.robot", "log.csv", "--json", "out.json"]);
    let out = json(&folder.read("out.json"));
    let effects = out["effects"].as_array().expect("a list");
    assert_eq!(effects.len(), 1, "{told}");
    let effect = &effects[0];
    assert_eq!(
        (&effect["kind"], &effect["joint"]),
        (&"joint-elasticity".into(), &2.into()),
        "{told}"
    );
    (told, effect["parameters"][0].clone())
}

/// The spring is deflected by the link's share of a sum, which is told by the spec's numbers and not by the log.
#[test]
fn a_stiffness_has_no_interval_where_a_motor_and_its_link_are_one_number() {
    let values = r#"{"rail.viscous_friction.fv": 8, "arm.viscous_friction.fv": 0.6, "rail.coulomb_friction.fc": 5,
        "arm.coulomb_friction.fc": 0.5, "arm.motor_inertia.ia": 0.15}"#;
    let truth = pendulum("motor_inertia on arm; joint_elasticity(stiffness = 300) on arm;");
    let (told, stiffness) = traced(&pendulum("motor_inertia on arm;"), &truth, values, motion);
    assert!(stiffness["value"].as_f64().is_some(), "{stiffness}");
    assert_eq!(
        (&stiffness["std"], &stiffness["interval"]),
        (&Value::Null, &Value::Null)
    );
    assert!(
        told.contains(" N m/rad, as far as the spec splits motor and link correctly (score")
            && told.contains("`pend.iyyr` sums a motor and its link"),
        "{told}"
    );
    // A spec that knows of no motor has its torque in the load.
    let (told, stiffness) = traced(&pendulum(""), &truth, values, motion);
    assert!(stiffness["std"].as_f64().is_some(), "{stiffness}");
    assert!(
        told.contains("the spec has no motor inertia on `arm`, so the load"),
        "{told}"
    );
}

/// The rotor of the cart is in a sum with all masses, and loads no spring at the pendulum.
#[test]
fn a_sum_at_another_joint_says_nothing_of_a_stiffness() {
    let values = r#"{"rail.viscous_friction.fv": 8, "arm.viscous_friction.fv": 0.6, "rail.coulomb_friction.fc": 5,
        "arm.coulomb_friction.fc": 0.5, "rail.motor_inertia.ia": 1, "arm.motor_inertia.ia": 0.01}"#;
    let truth = pendulum("motor_inertia on all; joint_elasticity(stiffness = 60) on arm;");
    let (told, stiffness) = traced(&pendulum("motor_inertia on rail;"), &truth, values, motion);
    assert!(stiffness["std"].as_f64().is_some(), "{stiffness}");
    assert!(!told.contains("sums a motor"), "{told}");
}

/// Links that are known leave the motor's inertia to be told.
#[test]
fn a_stiffness_between_a_motor_and_a_known_link_has_an_interval() {
    let values = r#"{"up.viscous_friction.fv": 1.0, "lo.viscous_friction.fv": 0.5, "up.coulomb_friction.fc": 0.5,
        "lo.coulomb_friction.fc": 0.3, "lo.motor_inertia.ia": 0.05}"#;
    let truth = folding("motor_inertia on lo; joint_elasticity(stiffness = 100) on lo;");
    let (told, stiffness) = traced(&folding("motor_inertia on lo;"), &truth, values, |t| {
        [
            -1.57 + 0.9 * (1.3 * t).sin() + 0.2 * (4.1 * t).sin(),
            0.9 * (2.1 * t).sin() + 0.2 * (5.3 * t).cos() + 0.1 * (9.3 * t).sin(),
        ]
    });
    close(stiffness["value"].as_f64().expect("a value"), 100.0, 5.0);
    assert!(stiffness["interval"].is_array(), "{stiffness}");
    assert!(
        !told.contains("sums a motor") && !told.contains("no motor inertia"),
        "{told}"
    );
}

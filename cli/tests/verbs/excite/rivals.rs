//! Motions that tell two effects apart.

use serde_json::Value;

use super::{ARM, FRICTION, SMALL, folder};
use crate::common::{json, numbers};

/// Two kinds of friction that look alike in a motion of one speed.
#[test]
fn a_motion_tells_two_effects_apart() {
    best_beats_drawn(
        "quadratic_viscous on lower: c = 0.1",
        "cubic_viscous on lower: c = 0.05",
    );
}

/// Friction that builds up over a distance, and friction that falls with speed.
#[test]
fn a_motion_tells_an_effect_with_memory() {
    best_beats_drawn(
        "dahl(d = 0.05) on lower: fc = 0.5",
        "stribeck(vs = 0.1) on lower: fs = 0.3",
    );
}

/// Neither has a linear parameter alone: an angle, and a share of the arm's own torque.
#[test]
fn a_motion_tells_an_angle_and_a_gain() {
    best_beats_drawn(
        "encoder_offset(offset = 0.02) on upper",
        "torque_gain on upper: excess = 0.1",
    );
}

fn best_beats_drawn(first: &str, second: &str) {
    let folder = folder();
    folder.write("friction.json", &with_bodies());
    let rivals = ["--separate", first, "--from", second];
    let design = |more: &[&str], report: &str| -> Value {
        let files = ["--out", "out.csv", "--json", report];
        folder.succeed(&[&ARM[..], &SMALL, more, &files].concat());
        json(&folder.read(report))
    };
    let apart = design(&rivals, "apart.json");
    // The same with the first motion that is drawn.
    let first = design(&[&rivals[..], &["--budget", "1e-9"]].concat(), "first.json");
    assert!(design(&[], "any.json")["distances"].is_null());
    let (best, drawn) = (numbers(&apart["distances"]), numbers(&first["distances"]));
    assert!(
        best[0] * best[1] > 1.5 * drawn[0] * drawn[1],
        "{apart} {first}"
    );
    assert_eq!(apart["max_violation"], 0.0);
}

/// Friction and bodies.
fn with_bodies() -> String {
    let bodies = r#"{"upper.m": 3, "upper.mx": -0.9, "upper.my": 0, "upper.izz": 0.3, "lower.m": 1.5, "lower.mx": -0.3,
        "lower.my": 0, "lower.izz": 0.08, "#;
    FRICTION.replace('{', bodies)
}

/// The offset of a last joint turns its link: no motion tells it from a link that was built so.
#[test]
fn an_effect_that_the_arm_imitates_is_told() {
    let folder = folder();
    folder.write("friction.json", &with_bodies());
    let rivals = [
        "--separate",
        "encoder_offset(offset = 0.02) on lower",
        "--from",
        "torque_offset on lower",
    ];
    let out = ["--out", "out.csv"];
    let said = folder.refuse(&[&ARM[..], &SMALL, &rivals, &out].concat());
    assert!(
        said.contains("from what the arm's own parameters imitate"),
        "{said}"
    );
}

#[test]
fn rivals_that_are_none_are_told() {
    let folder = folder();
    let cubic = "cubic_viscous on lower";
    for (first, second, word) in [
        (
            "quadratic_viscous on all: c = 1",
            cubic,
            "name one, as in `quadratic_viscous on upper`",
        ),
        (
            "backlash(half_gap = 0.001) on lower",
            cubic,
            "moves links along a motion",
        ),
        (
            "encoder_offset on lower",
            cubic,
            "as in `encoder_offset(offset = 0.01) on ..`",
        ),
        (
            "quadratic_viscous on lower: c = 0",
            cubic,
            "one has no size",
        ),
        (
            "quadratic_viscous on lower: k = 1",
            cubic,
            "has `c`: say what each",
        ),
        (cubic, cubic, "nothing tells an effect from itself"),
        ("stribeck on lower:", cubic, "is no effect with its size"),
        ("sticktion on lower: fs = 1", cubic, "sticktion"),
        ("quadratic_viscous on wrist: c = 1", cubic, "wrist"),
        (
            "parameter_drift on lower: fv = 1",
            cubic,
            "follows from more than the motion",
        ),
    ] {
        let arguments = ["--out", "out.csv", "--separate", first, "--from", second];
        let said = folder.refuse(&[&ARM[..], &SMALL, &arguments].concat());
        assert!(said.contains(word), "{first}: {said}");
    }
}

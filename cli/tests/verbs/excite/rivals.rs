//! Motions that tell two effects apart.

use serde_json::Value;

use super::{ARM, SMALL, folder};
use crate::common::{json, numbers};

/// Two kinds of friction that look alike in a motion of one speed.
#[test]
fn a_motion_tells_two_effects_apart() {
    let folder = folder();
    let rivals = [
        "--separate",
        "quadratic_viscous on lower: c = 0.1",
        "--from",
        "cubic_viscous on lower: c = 0.05",
    ];
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
            "no parameter that the torque is linear in",
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
            "dahl on lower: fc = 1",
            cubic,
            "follows from more than the motion",
        ),
    ] {
        let arguments = ["--out", "out.csv", "--separate", first, "--from", second];
        let said = folder.refuse(&[&ARM[..], &SMALL, &arguments].concat());
        assert!(said.contains(word), "{first}: {said}");
    }
}

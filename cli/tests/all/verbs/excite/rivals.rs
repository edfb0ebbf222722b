//! Motions that tell two effects apart.

use serde_json::Value;

use super::{ARM, FRICTION, SMALL, arm, columns, folder};
use crate::verbs::common::{json, numbers};

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
        said.contains("from the other one together with the arm's parameters"),
        "{said}"
    );
}

/// A shape that the spec leaves open is the one that is said: no second effect is declared beside it.
#[test]
fn an_open_shape_is_the_one_that_is_said() {
    let folder = folder();
    folder.write("friction.json", &with_bodies());
    for (declared, said) in [
        (
            "encoder_offset on upper; dahl on upper;",
            "encoder_offset(offset = 0.02) on upper",
        ),
        (
            "encoder_offset(offset = 0.02) on upper; dahl on upper;",
            "encoder_offset on upper",
        ),
        (
            "encoder_offset(offset = 0.02) on upper; dahl on upper;",
            "encoder_offset(offset = 0.02) on upper",
        ),
    ] {
        let text = arm().replace("effects {", &format!("effects {{ {declared}"));
        folder.write("open.robot", &text);
        let rivals = ["--separate", said, "--from", "dahl(d = 0.05) on upper"];
        let run = ["excite", "open.robot", "--parameters", "friction.json"];
        let files = ["--out", "out.csv", "--budget", "1e-9"];
        let out = folder.succeed(&[&run[..], &SMALL, &rivals, &files].concat());
        // Six of the bodies, four of friction, Dahl's, the offset.
        assert!(out.starts_with("12 columns"), "{declared}: {out}");
    }
}

/// The arm with the gain stands straight: a limit that it would exceed is not kept by the other one's offset.
#[test]
fn limits_hold_for_either_of_two_effects() {
    let folder = folder();
    let tight = arm().replace("torque = 25", "torque = 14");
    folder.write("arm.robot", &tight);
    folder.write("friction.json", &with_bodies());
    let rivals = [
        "--separate",
        "encoder_offset(offset = 0.3) on upper",
        "--from",
        "torque_gain on upper: excess = 0.1",
    ];
    let files = ["--out", "out.csv", "--rate", "100"];
    folder.succeed(&[&ARM[..], &SMALL, &rivals, &files].concat());
    let (head, columns) = columns(&folder.read("out.csv"));
    let of = |name: &str| {
        let place = head.iter().position(|column| column == name);
        &columns[place.expect("a column")]
    };
    let states: Vec<Value> = (0..of("time").len())
        .map(|k| {
            let joints = |what: &str| [1, 2].map(|joint| of(&format!("{what}{joint}"))[k]);
            serde_json::json!({"q": joints("q"), "dq": joints("dq"), "ddq": joints("ddq")})
        })
        .collect();
    folder.write(
        "states.json",
        &serde_json::json!({"states": states}).to_string(),
    );
    for (effect, value) in [
        (
            "torque_gain on upper",
            r#""upper.torque_gain.excess": 0.1, "#,
        ),
        ("encoder_offset(offset = 0.3) on upper", ""),
    ] {
        let text = tight.replace("effects {", &format!("effects {{ {effect};"));
        folder.write("one.robot", &text);
        folder.write(
            "one.json",
            &with_bodies().replace('{', &format!("{{{value}")),
        );
        let run = ["eval", "one.robot", "--parameters", "one.json"];
        let out = json(&folder.succeed(&[&run[..], &["--states", "states.json"]].concat()));
        for state in out["states"].as_array().expect("a list") {
            let torque = numbers(&state["torque"]);
            assert!(
                torque.iter().all(|tau| tau.abs() < 14.0 + 1e-9),
                "{effect}: {state}"
            );
        }
    }
}

/// States that follow from time, channels, or measured torque and so from other states: they are not designed for, and told.
#[test]
fn states_of_more_than_the_motion_are_left_out() {
    let folder = folder();
    for (name, rate) in [
        ("aging", "dq(j) * exp(-time / 10) - z"),
        ("heating", "dq(j) - z * temperature"),
        ("lagging", "(measured_torque(j) - z) / 0.1"),
    ] {
        let input = if name == "heating" {
            "input temperature;"
        } else {
            ""
        };
        let effect = format!(
            "effect {name}(j) {{ linear k; {input} state z; dot(z) = {rate}; torque(j) = k * z; }}\n"
        );
        let declared = format!("effects {{ dahl(d = 0.05) on upper; {name} on lower;");
        folder.write(
            "more.robot",
            &format!("{effect}{}", arm().replace("effects {", &declared)),
        );
        let values = format!(r#"{{"upper.dahl.fc": 0.5, "lower.{name}.k": 1, "#);
        folder.write("more.json", &with_bodies().replace('{', &values));
        let run = ["excite", "more.robot", "--parameters", "more.json"];
        let files = ["--out", "out.csv", "--budget", "1e-9"];
        let ran = folder.run(&[&run[..], &SMALL, &files].concat());
        assert_eq!(ran.code, Some(0), "{name}: {}", ran.stderr);
        let note = format!("the design ignores `lower.{name}.k`");
        assert!(ran.stderr.contains(&note), "{name}: {}", ran.stderr);
    }
    // Measured torque of a plain design, below the limit at which the motor saturates.
    let declared = "effects { torque_saturation(limit = 40, v0 = 100) on upper;";
    folder.write("arm.robot", &arm().replace("effects {", declared));
    let ran = folder.run(&[&ARM[..], &SMALL, &["--out", "out.csv", "--budget", "1e-9"]].concat());
    assert_eq!(ran.code, Some(0), "{}", ran.stderr);
    assert!(
        ran.stderr
            .contains("the design ignores `upper.torque_saturation.share`"),
        "{}",
        ran.stderr
    );
}

/// Windings are counted for ever, and a swing without damping rings on.
#[test]
fn states_that_do_not_settle_are_refused() {
    let folder = folder();
    for (state, rate) in [
        ("z", "dot(z) = abs(dq(j));"),
        ("z, w", "dot(z) = w; dot(w) = dq(j) - 100 * z;"),
    ] {
        let effect =
            format!("effect winder(j) {{ linear k; state {state}; {rate} torque(j) = k * z; }}\n");
        folder.write("arm.robot", &format!("{effect}{}", arm()));
        let rivals = [
            "--separate",
            "winder on lower",
            "--from",
            "cubic_viscous on lower",
        ];
        let said = folder.refuse(&[&ARM[..], &SMALL, &rivals, &["--out", "out.csv"]].concat());
        assert!(
            said.contains("`lower.winder.z` does not become periodic"),
            "{said}"
        );
    }
}

/// At rest the one law says something else than the other; everywhere else they are the same.
#[test]
fn two_names_of_one_effect_are_not_told_apart_at_rest() {
    let folder = folder();
    folder.write("friction.json", &with_bodies());
    let rivals = [
        "--separate",
        "transmission_efficiency on lower: driving = 0.1, driven = 0.1",
        "--from",
        "load_dependent_friction on lower: mu = 0.1",
    ];
    let said = folder.refuse(&[&ARM[..], &SMALL, &rivals, &["--out", "out.csv"]].concat());
    assert!(
        said.contains("no motion found within these limits separates"),
        "{said}"
    );
}

/// A motor that saturates only where the motion is large: small motions do not see it.
#[test]
fn what_sets_in_late_is_looked_for() {
    let folder = folder();
    folder.write("friction.json", &with_bodies());
    let rivals = [
        "--separate",
        "torque_saturation(limit = 18, v0 = 30) on upper: share = 1",
        "--from",
        "torque_gain on upper: excess = 0.05",
    ];
    let files = ["--out", "out.csv", "--json", "out.json"];
    folder.succeed(&[&ARM[..], &SMALL, &rivals, &files].concat());
    let distances = numbers(&json(&folder.read("out.json"))["distances"]);
    assert!(distances[0] > 1e-3, "{distances:?}");
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
            "displaces links",
        ),
        (
            "encoder_offset on lower",
            cubic,
            "as in `encoder_offset(offset = 0.01) on ..`",
        ),
        (
            "quadratic_viscous on lower: c = 0",
            cubic,
            "one size is missing",
        ),
        (
            "quadratic_viscous on lower: k = 1",
            cubic,
            "has `c`: give the expected value of each",
        ),
        (cubic, cubic, "give two different effects"),
        (
            "encoder_offset on lower: offset = 0.01",
            cubic,
            "give its shapes",
        ),
        (
            "stribeck on lower:",
            cubic,
            "is not an effect with its size",
        ),
        ("sticktion on lower: fs = 1", cubic, "sticktion"),
        ("quadratic_viscous on wrist: c = 1", cubic, "wrist"),
        (
            "parameter_drift on lower: fv = 1",
            cubic,
            "depends on more than the motion",
        ),
    ] {
        let arguments = ["--out", "out.csv", "--separate", first, "--from", second];
        let said = folder.refuse(&[&ARM[..], &SMALL, &arguments].concat());
        assert!(said.contains(word), "{first}: {said}");
    }
}

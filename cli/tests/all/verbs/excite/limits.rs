//! What the motion keeps: torque limits and rooms.

use super::{ARM, FRICTION, SMALL, arm, columns, folder};
use crate::verbs::common::json;

/// Torque limits are verified with friction that jumps, whose peak the search does not see.
#[test]
fn torque_limits_hold_with_friction_that_peaks() {
    let folder = folder();
    let peak = arm().replace(
        "coulomb_friction on all;",
        "coulomb_friction on all; stribeck(vs = 0.05) on all;",
    );
    folder.write("peak.robot", &peak);
    let values = FRICTION.replace('}', r#", "upper.stribeck.fs": 9, "lower.stribeck.fs": 4}"#);
    folder.write("peak.json", &values);
    let arguments = [
        "excite",
        "peak.robot",
        "--parameters",
        "peak.json",
        "--rate",
        "2400",
    ];
    folder.succeed(
        &[
            &arguments[..],
            &SMALL,
            &["--out", "motion.csv", "--json", "out.json"],
        ]
        .concat(),
    );
    assert!(
        json(&folder.read("out.json"))["max_violation"]
            .as_f64()
            .expect("a number")
            <= 0.0
    );
    let (_, table) = columns(&folder.read("motion.csv"));
    let friction = |dq: f64| {
        let peak = 9.0 * (-(dq / 0.05).powi(2)).exp();
        0.6 * dq + (0.8 + peak) * dq.signum()
    };
    // The pendulum's torque at the upper joint, by hand.
    for row in 1..table[0].len() - 1 {
        let at = |k: usize| table[k][row];
        let [q1, q2, v1, v2, a1, a2] = [1, 2, 3, 4, 5, 6].map(at);
        let lever = 0.5 * 0.2 * q2.cos();
        let far = 0.2 * 0.2 + 0.02;
        let near = 2.0 * 0.25 * 0.25 + 0.05 + 0.5 * 0.5 + far;
        let turning = -0.5 * 0.2 * q2.sin() * v2 * (2.0 * v1 + v2);
        let weight = 9.81 * ((2.0 * 0.25 + 0.5) * q1.cos() + 0.2 * (q1 + q2).cos());
        let torque =
            (near + 2.0 * lever) * a1 + (far + lever) * a2 + turning + weight + friction(v1);
        // Between the instants of the verified grid the peak may be a little higher.
        assert!(torque.abs() < 25.0 * 1.03, "{row}: {torque}");
    }
}

#[test]
fn links_stay_in_their_room() {
    let folder = folder();
    // The tip stays above the floor that the lower link could reach.
    folder.write(
        "room.json",
        r#"{"balls": [{"link": "lower", "radius": 0.05}, {"link": "upper", "radius": 0.05}],
            "planes": [{"normal": [0, 1, 0], "offset": -0.7}]}"#,
    );
    let lowest = |room: &[&str]| {
        folder.succeed(&[&ARM[..], &SMALL, &["--out", "m.csv"], room].concat());
        let (_, table) = columns(&folder.read("m.csv"));
        let heights = table[1].iter().zip(&table[2]);
        heights
            .map(|(q1, q2)| 0.5 * q1.sin() + 0.4 * (q1 + q2).sin())
            .fold(f64::INFINITY, f64::min)
    };
    let (free, kept) = (lowest(&[]), lowest(&["--room", "room.json"]));
    assert!(free < -0.68, "the floor is in the way: {free}");
    assert!(kept >= -0.65, "{kept}");
    for (room, word) in [
        (
            r#"{"balls": [{"link": "hand", "radius": 0.1}]}"#,
            "no link `hand`",
        ),
        (
            r#"{"balls": [{"link": "lower", "radius": -1}]}"#,
            "the radius -1",
        ),
        (
            r#"{"balls": [], "planes": [{"normal": [0, 0, 0], "offset": 0}]}"#,
            "the normal",
        ),
        (
            r#"{"balls": [], "box": {"low": [0, 0, 0], "high": [1, 0, 1]}}"#,
            "the box is empty",
        ),
        (
            r#"{"balls": [{"link": "lower", "radius": 0.1}]}"#,
            "it limits nothing",
        ),
        (
            r#"{"balls": [{"link": "lower", "radius": 0.1}], "apart": -1}"#,
            "`apart` must be a distance",
        ),
        (r#"{"bals": []}"#, "bals"),
        ("{", "bad.json:1:1: it is not JSON"),
        (
            r#"{"balls": [{"link": "lower"}]}"#,
            "`balls[0]`: missing field `radius`; write",
        ),
    ] {
        folder.write("bad.json", room);
        let said =
            folder.refuse(&[&ARM[..], &SMALL, &["--out", "n.csv", "--room", "bad.json"]].concat());
        assert!(said.contains(word), "{room}: {said}");
    }
    // A room that is nowhere.
    folder.write(
        "none.json",
        r#"{"balls": [{"link": "lower", "radius": 0.05}], "planes": [{"normal": [0, 1, 0], "offset": 2}]}"#,
    );
    let said =
        folder.refuse(&[&ARM[..], &SMALL, &["--out", "n.csv", "--room", "none.json"]].concat());
    assert!(
        said.contains("no motion keeps the limits") && said.contains("lower"),
        "{said}"
    );
}

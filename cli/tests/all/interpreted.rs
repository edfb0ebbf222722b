//! The interpreter behind the runtime's traits: which candidates there are, and which band a column reads.

use robot_model::columns::{Arm, Candidate, Columns};
use robot_model::motion::{Kinematics, Motion};
use robot_model_cli::interpreted::{InterpretedArm, InterpretedCandidate};
use robot_model_codegen::compile_model;

const WRIST: &str = "\
robot Wrist {
    gravity = [0, 0, -9.81];
    convention = standard_dh;
    joint bend: revolute { a = 0; alpha = 90 deg; d = 0; }
    joint turn: revolute { a = 0; alpha = 0; d = 0.1; }
    effects { motor_inertia on all; coulomb_friction on bend; stribeck(vs = 0.1) on bend; gear_coupling on (turn, bend); }
}

/// One joint drags the other, which does not feel it.
effect one_way(j, k) {
    /// Drag.
    linear c;
    torque(j) = c * dq(k);
}

/// Smooth and rough terms in one effect.
effect mixed(j) {
    /// Spring.
    linear k;
    /// Friction.
    linear f;
    torque(j) = k * q(j) - f * sign(dq(j)) * q(j);
}
";

fn wrist() -> InterpretedArm {
    let model = robot_model_spec::load("wrist.robot", WRIST).expect("a sound spec");
    InterpretedArm::new(compile_model(&model))
}

fn on(candidates: &[InterpretedCandidate], kind: &str) -> Vec<Vec<usize>> {
    let wanted = candidates
        .iter()
        .filter(|candidate| candidate.kind() == kind);
    wanted
        .map(|candidate| candidate.joints().to_vec())
        .collect()
}

/// Two samples: the smooth band is 1 everywhere, the wide one 2, the load 3.
fn motion() -> Motion {
    let band = |value: f64| {
        let signal = vec![vec![value; 2]; 2];
        Kinematics {
            q: signal.clone(),
            dq: signal.clone(),
            ddq: signal,
        }
    };
    Motion {
        time: vec![0.0, 0.1],
        smooth: band(1.0),
        wide: band(2.0),
        rigid_torque: vec![vec![3.0; 2]; 2],
        ..Motion::default()
    }
}

/// What another law finds at the ends of its ranges is not tried by itself.
#[test]
fn cases_of_other_laws_are_no_candidates() {
    let candidates = wrist().candidates();
    for kind in ["dahl", "rokae"] {
        assert_eq!(on(&candidates, kind), Vec::<Vec<usize>>::new(), "{kind}");
    }
    for kind in ["cable-hysteresis", "lugre-presliding", "stribeck"] {
        assert_eq!(on(&candidates, kind), [[0], [1]], "{kind}");
    }
}

/// Waves of one position are terms of a series; loads and forces on links are not of one alone.
#[test]
fn laws_of_positions_are_known_by_what_they_read() {
    let candidates = wrist().candidates();
    let of_position = |name: &str| {
        let mut all = candidates.iter();
        let candidate = all.find(|candidate| candidate.effect() == name);
        candidate.expect("it is tried").is_of_position()
    };
    for name in ["torque_ripple", "joint_spring"] {
        assert!(of_position(name), "{name}");
    }
    for name in [
        "lugre_presliding",
        "quadratic_viscous",
        "transmission_efficiency",
        "parameter_drift",
    ] {
        assert!(!of_position(name), "{name}");
    }
}

/// The noise of the logged torque explains itself, so the tracer has to know which laws are made of it.
#[test]
fn laws_of_the_measured_torque_are_known_by_it() {
    let candidates = wrist().candidates();
    assert_eq!(on(&candidates, "torque-saturation"), [[0], [1]]);
    for candidate in &candidates {
        let is_saturation = candidate.kind() == "torque-saturation";
        assert_eq!(
            candidate.follows_torque(),
            is_saturation,
            "{}",
            candidate.kind()
        );
    }
}

#[test]
fn candidates_are_what_is_not_declared() {
    let candidates = wrist().candidates();
    assert_eq!(on(&candidates, "motor-inertia"), Vec::<Vec<usize>>::new());
    assert_eq!(on(&candidates, "coulomb-friction"), [[1]]);
    assert_eq!(on(&candidates, "viscous-friction"), [[0], [1]]);
    assert_eq!(
        on(&candidates, "stribeck"),
        [[0], [1]],
        "another speed may be missing"
    );
    assert_eq!(
        on(&candidates, "gear-coupling"),
        Vec::<Vec<usize>>::new(),
        "declared the other way round"
    );
    assert_eq!(
        on(&candidates, "one-way"),
        [[0, 1], [1, 0]],
        "not symmetric"
    );
    let names: Vec<&str> = candidates
        .iter()
        .filter(|candidate| candidate.kind() == "stribeck")
        .map(|candidate| candidate.unknowns()[0].name.as_str())
        .collect();
    assert_eq!(names, ["bend.stribeck2.fs", "turn.stribeck.fs"]);
}

#[test]
fn grids_span_their_range() {
    for candidate in wrist().candidates() {
        for shape in candidate.shapes() {
            assert!(
                shape.grid.is_sorted_by(|low, high| low < high),
                "{}",
                shape.name
            );
            match candidate.kind() {
                "stribeck" => assert_eq!(
                    (shape.grid.len(), shape.grid[0], shape.grid[11]),
                    (12, 0.005, 0.5)
                ),
                "torque-ripple" => assert_eq!(
                    (shape.grid[0], shape.grid[1], shape.grid[232]),
                    (2.0, 2.25, 60.0)
                ),
                _ => {}
            }
        }
    }
}

#[test]
fn only_rough_columns_read_the_wide_band() {
    let arm = wrist();
    let candidates = arm.candidates();
    let of = |kind: &str| {
        candidates
            .iter()
            .find(|candidate| candidate.kind() == kind)
            .expect("a candidate")
    };
    let values = |kind: &str| -> Vec<(usize, f64)> {
        of(kind)
            .entries(&motion(), &[])
            .iter()
            .map(|entry| (entry.column, entry.values[1]))
            .collect()
    };
    assert_eq!(values("viscous-friction"), [(0, 1.0)]);
    assert_eq!(values("asymmetric-viscous"), [(0, 2.0)]);
    assert_eq!(values("mixed"), [(0, 1.0), (1, -2.0)]);
    assert!(of("load-dependent-friction").uses_rigid_torque());
    assert_eq!(values("load-dependent-friction"), [(0, 3.0)]);
    let names: Vec<&str> = arm
        .unknowns()
        .iter()
        .map(|unknown| unknown.name.as_str())
        .collect();
    for entry in arm.entries(&motion(), &[]) {
        if names[entry.column] == "bend.motor_inertia.ia"
            || names[entry.column] == "turn.gear_coupling.ia"
        {
            assert!(
                (entry.values[0] - 1.0).abs() < 1e-12,
                "{}",
                names[entry.column]
            );
        }
    }
}

#[test]
fn columns_times_values_are_the_torque_of_the_rigid_body() {
    let arm = wrist();
    let estimate: Vec<f64> = (0..arm.unknowns().len())
        .map(|k| 0.3 + 0.1 * k as f64)
        .collect();
    let effect = |name: &str| name.matches('.').count() == 2;
    let mut sum = vec![vec![0.0; 2]; arm.dof()];
    for entry in arm.entries(&motion(), &[]) {
        if !effect(&arm.unknowns()[entry.column].name) {
            for (sum, value) in sum[entry.joint].iter_mut().zip(&entry.values) {
                *sum += estimate[entry.column] * value;
            }
        }
    }
    let torque = arm.rigid_torque(&motion(), &[], &estimate);
    for (found, expected) in sum.iter().flatten().zip(torque.iter().flatten()) {
        assert!(
            (found - expected).abs() < 1e-12,
            "{found} against {expected}"
        );
    }
    assert!(
        arm.known_torque(&motion(), &[])
            .iter()
            .flatten()
            .all(|value| value.abs() < 1e-15)
    );
}

/// Where an encoder does not tell a direction, a jump is its mean over the directions that there may be.
#[test]
fn a_jump_is_soft_where_a_direction_is_not_known() {
    let candidates = wrist().candidates();
    let dry = candidates.iter().find(|c| c.kind() == "coulomb-friction");
    let dry = dry.expect("dry friction on the second joint");
    let joint = dry.joints()[0];
    for (velocity, width) in [(0.01, 0.02), (-0.03, 0.02), (0.5, 0.02), (0.01, 0.0)] {
        let mut motion = motion();
        motion.wide.dq[joint] = vec![velocity; 2];
        motion.turn_speeds = vec![width; 2];
        let entries = dry.entries(&motion, &[]);
        let wanted = if width > 0.0 {
            f64::tanh(velocity / width)
        } else {
            velocity.signum()
        };
        // Sixteen velocities make steps of an eighth.
        let found = entries[0].values[0];
        assert!(
            (found - wanted).abs() < 0.0626,
            "{velocity} {width}: {found} for {wanted}"
        );
    }
}

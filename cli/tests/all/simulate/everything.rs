//! Arms with everything at once: slopes by differences, gains.

use nalgebra::{DMatrix, DVector};
use robot_model::simulate::Plant;
use robot_model_cli::interpreted::InterpretedPlant;

use crate::simulate::common::{pendulum_with, plant};
use crate::simulate::differences::{State, at, differences};

/// Everything at once: a spring with play on the second of two joints, friction that remembers and friction that loads bend, and a world
/// that the second link rubs against, harder by `bite` times its load and acceleration.
fn mixed(bite: f64) -> InterpretedPlant {
    let rub = "effect rub(j) {
        linear c, f, g;
        state y;
        dot(y) = dq(j) - abs(dq(j)) * y / 0.1;
        force(j) = [g * (rigid_torque(j) + ddq(j)) + f * sign(dq(j)) - c * dq(j) * q(j), c * y, 0];
    }";
    let arm = pendulum_with(
        rub,
        "rub on lower;
        motor_inertia on lower;
        joint_elasticity(stiffness = 300) on lower;
        backlash(half_gap = 0.01) on lower;
        encoder_offset(offset = 0.05) on lower;
        dahl on lower;
        load_dependent_friction on all;",
    );
    let more = [
        ("motor_inertia.ia", 0.1),
        ("dahl.fc", 0.7),
        ("dahl.d", 0.05),
        ("load_dependent_friction.mu", 0.1),
        ("rub.c", 0.8),
        ("rub.f", 1.3),
        ("rub.g", bite),
    ];
    plant(arm.ungrouped(), &more)
}

#[test]
fn gains_are_for_motors_with_their_links_while_others_are_free() {
    // Of two joints: what one moves while the other is free, `M_11 - M_12^2 / M_22`.
    let mut arm = mixed(0.0);
    let q = [0.3, -0.4];
    let state: State = [
        vec![q[0], q[1], q[1]],
        vec![0.0; 3],
        vec![0.0; 3],
        vec![0.0; 2],
    ];
    let (mut torque, mut m) = (DVector::zeros(3), DMatrix::zeros(3, 3));
    let switches = vec![0.0; arm.switches()];
    arm.torque(&at(&state, &switches), &mut torque, &mut m);
    let (one, both, other) = (m[(0, 0)], m[(0, 2)], m[(1, 1)] + m[(2, 2)]);
    assert!(m[(1, 1)] > 0.09 && m[(2, 2)] > 0.04 && both > 0.05);
    let free = arm.free_inertia(&q, &[]);
    assert!(
        (free[0] - (one - both * both / other)).abs() < 1e-12,
        "{free:?}"
    );
}

#[test]
fn slopes_of_both_sides_are_those_of_differences() {
    let mut arm = mixed(0.2);
    assert_eq!((arm.dof(), arm.joints(), arm.states()), (3, 2, 2));
    assert_eq!([0, 1, 2].map(|k| arm.joint(k)), [0, 1, 1]);
    let state: State = [
        vec![0.3, -0.4, -0.53],
        vec![0.7, -0.9, 0.4],
        vec![1.1, 2.3, -0.6],
        vec![0.03, 0.004],
    ];
    let differences = differences(&mut arm, &state);
    // The spring is stretched and everything has a part in it.
    assert!(differences[0][(1, 2)] < -200.0 && differences[0][(2, 0)] != 0.0);
    assert!(differences[2][(1, 1)] > 0.0 && differences[3][(1, 1)] != 0.0);
    assert!(differences[3][(2, 0)] != 0.0 && differences[3][(1, 0)] == 0.0);
}

#[test]
fn slopes_of_links_that_joints_time_and_memory_place_are_those_of_differences() {
    let effects = "effect wobble(j) {
        shape a in 0.01 .. 1;
        position(j) = a * sin(3 * q(j) + 0.2 * time) + 0.1 * a * q(j)^2;
    }
    effect give(j) {
        shape k in 10 .. 1000;
        shape c in 0.001 .. 1;
        state y;
        dot(y) = rigid_torque(j) / k + dq(j) - y;
        position(j) = -rigid_torque(j) / k - c * tanh(0.1 * rigid_torque(j)) + 0.02 * c * dq(j) * q(j) + 0.3 * c * y;
    }
    effect rub(j) {
        linear c, f, g;
        force(j) = [g * (rigid_torque(j) + ddq(j)) + f * sign(dq(j)) - c * dq(j) * q(j), c * q(j), 0];
    }";
    let arm = pendulum_with(
        effects,
        "rub on all;
        motor_inertia on lower;
        wobble on upper;
        give on lower;
        dahl on lower;
        load_dependent_friction on all;",
    );
    let more = [
        ("motor_inertia.ia", 0.1),
        ("wobble.a", 0.2),
        ("give.k", 90.0),
        ("give.c", 0.3),
        ("dahl.fc", 0.7),
        ("dahl.d", 0.05),
        ("load_dependent_friction.mu", 0.1),
        ("rub.c", 0.8),
        ("rub.f", 1.3),
        ("rub.g", 0.2),
    ];
    let mut arm = plant(arm.ungrouped(), &more);
    assert_eq!((arm.dof(), arm.joints(), arm.states()), (3, 2, 2));
    let state: State = [
        vec![0.3, -0.4, -0.53],
        vec![0.7, -0.9, 0.4],
        vec![1.1, 2.3, -0.6],
        vec![0.03, 0.004],
    ];
    let differences = differences(&mut arm, &state);
    // What the spring carries depends on all that it reads, and reaches what reads the load.
    let [q, dq, _, z] = differences;
    assert!(q[(1, 1)].abs() > 1.0 && dq[(1, 1)] != 0.0 && z[(2, 0)] != 0.0);
    assert!(z[(3, 0)] > -1.0 + 1e-3, "{z}");
}

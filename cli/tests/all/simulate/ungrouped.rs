//! Arms in standard parameters.

use nalgebra::{DMatrix, DVector};
use robot_model::simulate::{Instant, Plant};
use robot_model_codegen::Compiled;

use crate::simulate::common::{compiled, plant, spec};

/// The torque at a state, and its slope by the accelerations.
fn torque(arm: Compiled, more: &[(&str, f64)]) -> (DVector<f64>, DMatrix<f64>) {
    let dof = arm.dof();
    let mut arm = plant(arm, more);
    let (mut torque, mut inertia) = (DVector::zeros(dof), DMatrix::zeros(dof, dof));
    let signal = |size: f64| -> Vec<f64> { (1..=dof).map(|k| size * (k as f64).cos()).collect() };
    let switches = vec![0.5; arm.switches()];
    let at = Instant {
        time: 0.0,
        q: &signal(0.4),
        dq: &signal(-0.9),
        ddq: &signal(1.7),
        memory: &[],
        switches: &switches,
        torque: &signal(0.0),
        inputs: &[],
    };
    arm.torque(&at, &mut torque, &mut inertia);
    (torque, inertia)
}

/// The same arm, whatever parameters its equations are written in.
#[test]
fn standard_parameters_one_by_one_are_the_same_arm() {
    let chain = "robot Arm {
        gravity = [0, -9.81, 0];
        convention = standard_dh;
        joint upper: revolute { a = 0.5; alpha = 0.3; d = 0; }
        joint lower: revolute { a = 0.4; alpha = 0; d = 0.1; }
        link upper { mass = 2; com = [-0.25, 0, 0.1]; inertia = [0.1, 0, 0, 0.15, 0, 0.12]; }
        link lower { mass = 1; com = [-0.2, 0.05, 0]; inertia = [0.04, 0, 0, 0.03, 0, 0.05]; }
        effects { motor_inertia on all; viscous_friction on lower; }
    }";
    let friction = [("motor_inertia.ia", 0.3), ("viscous_friction.fv", 0.7)];
    let cart = [
        ("m", 1.2),
        ("l^-1", 2.0),
        ("m*l", 0.6),
        ("m*l^2", 0.3),
        ("J*N^-2", 0.1),
        ("viscous_friction.fv", 0.7),
        ("coulomb_friction.fc", 0.4),
    ];
    for (arm, more) in [
        (compiled(chain), &friction[..]),
        (spec("cart_pole", true), &cart),
    ] {
        let alone = arm.ungrouped();
        assert!(alone.base.kept.len() > arm.base.kept.len());
        assert!(alone.mixed().is_empty());
        let (expected, found) = (torque(arm, more), torque(alone, more));
        assert!((&found.0 - &expected.0).amax() < 1e-12 * expected.0.amax());
        assert!((&found.1 - &expected.1).amax() < 1e-12 * expected.1.amax());
    }
}

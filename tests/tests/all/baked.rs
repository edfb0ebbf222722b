//! Arms with their parameters in their equations against the same arms with parameters as arguments.

use nalgebra::SMatrix;
use robot_model::{FromParameters, Mechanics, RobotModel, State, Vector};
use robot_model_tests::emitted;
use robot_model_tests::states::{generator, state, typed};

#[deny(warnings)]
#[allow(clippy::pedantic, reason = "derived, not written")]
mod arms {
    pub mod puma560 {
        robot_model::include_robot!("baked_puma560");
    }
    pub mod memory {
        robot_model::include_robot!("baked_memory");
    }
    pub mod phantom {
        robot_model::include_robot!("baked_phantom");
    }
}

#[test]
fn baked_arms_are_those_of_their_parameters() {
    assert_same::<_, emitted::puma560::Puma560, _, _, _, _, _, _>(&arms::puma560::Puma560);
    assert_same::<_, emitted::memory::Memory, _, _, _, _, _, _>(&arms::memory::Memory);
    assert_same::<_, emitted::phantom::Phantom, _, _, _, _, _, _>(&arms::phantom::Phantom);
}

/// Zeros of parameters leave nothing behind, and what is known needs no argument.
#[test]
fn a_baked_arm_is_no_larger_than_nothing() {
    assert_eq!(size_of::<arms::puma560::Puma560>(), 0);
    assert_eq!(arms::memory::Memory::SHAPE_PARAMETERS, [""; 0]);
    let _: [f64; 6] = arms::puma560::gravity(&[0.1; 6]);
}

#[track_caller]
fn close<const R: usize, const C: usize>(
    what: &str,
    found: SMatrix<f64, R, C>,
    wanted: SMatrix<f64, R, C>,
) {
    // The same equations; products of numbers are multiplied in another order.
    let size = 1e-11 * wanted.norm().max(1.0);
    assert!((found - wanted).norm() < size, "{what}: {found} {wanted}");
}

fn assert_same<
    A,
    B,
    const DOF: usize,
    const STANDARD: usize,
    const BASE: usize,
    const SHAPES: usize,
    const STATES: usize,
    const INPUTS: usize,
>(
    arm: &A,
) where
    A: Mechanics<DOF, STANDARD, BASE, 0, STATES, INPUTS>,
    B: FromParameters<DOF, STANDARD, BASE, SHAPES, STATES, INPUTS>
        + Mechanics<DOF, STANDARD, BASE, SHAPES, STATES, INPUTS>,
{
    let page = B::from_base(&arm.beta());
    assert_eq!(
        B::base_parameters(&arm.standard()),
        B::base_parameters(&page.standard())
    );
    let mut random = generator(23);
    for _ in 0..10 {
        let state: State<DOF, STATES, INPUTS> = typed(&state(&mut random, DOF));
        let (q, dq) = (&state.q, &state.dq);
        close("M", arm.mass_matrix(q), page.mass_matrix(q));
        close("C", arm.coriolis_matrix(q, dq), page.coriolis_matrix(q, dq));
        close("G", arm.gravity(q), page.gravity(q));
        close("bias", arm.bias(q, dq), page.bias(q, dq));
        close(
            "tau",
            arm.inverse_dynamics_at(&state),
            page.inverse_dynamics_at(&state),
        );
        close(
            "Y_b",
            arm.base_regressor_of_at(&state),
            page.base_regressor_of_at(&state),
        );
        close(
            "Y",
            arm.regressor_of_at(&state),
            page.regressor_of_at(&state),
        );
        close(
            "by position",
            arm.inverse_dynamics_by_position_at(&state),
            page.inverse_dynamics_by_position_at(&state),
        );
        close(
            "by velocity",
            arm.inverse_dynamics_by_velocity_at(&state),
            page.inverse_dynamics_by_velocity_at(&state),
        );
        let energies = [arm.kinetic_energy(q, dq), arm.potential_energy(q)];
        close(
            "energies",
            Vector::from(energies),
            Vector::from([page.kinetic_energy(q, dq), page.potential_energy(q)]),
        );
        let tau = arm.inverse_dynamics_at(&state);
        let accelerations = (
            arm.forward_dynamics_at(&state, &tau),
            page.forward_dynamics_at(&state, &tau),
        );
        // Numbers without meaning need not be an inertia.
        match accelerations {
            (Some(found), Some(wanted)) => close("accelerations", found / 1e3, wanted / 1e3),
            (found, wanted) => assert_eq!(found, wanted),
        }
    }
}

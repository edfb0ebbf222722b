//! Of what a torque is made: the regressor of a reference velocity, and the shares of a dissection.

use robot_model::control::{Dissection, Reference, ReferenceRegressor};
use robot_model::{FromParameters, Mechanics, RobotModel, State, Vector};
use robot_model_tests::emitted::memory::Memory;
use robot_model_tests::emitted::mounted_arm::MountedArm;
use robot_model_tests::emitted::panda::Panda;
use robot_model_tests::emitted::phantom::Phantom;
use robot_model_tests::emitted::puma560::Puma560;

use super::{ROUNDING, arm_and_state, close};

/// `Y_r beta = M ddq_r + C(q, dq) dq_r + G + effects`, of any arm.
fn reference_regressor_has_the_torque_of_the_reference<
    R,
    const D: usize,
    const S: usize,
    const B: usize,
    const H: usize,
    const M: usize,
    const I: usize,
>(
    spec: &str,
) where
    R: FromParameters<D, S, B, H, M, I> + Mechanics<D, S, B, H, M, I>,
{
    for seed in 0..5 {
        let (arm, state) = arm_and_state::<R, D, S, B, H, M, I>(spec, seed);
        let wave =
            |start: f64| Vector::<D>::from_fn(|k, _| (start + seed as f64 + 1.7 * k as f64).sin());
        let reference = Reference {
            dq: wave(0.3),
            ddq: wave(1.1) * 4.0,
        };
        let moving = State {
            ddq: reference.ddq,
            ..state
        };
        let (q, dq) = (&state.q, &state.dq);
        let effects =
            arm.inverse_dynamics_at(&moving) - arm.mass_matrix(q) * reference.ddq - arm.bias(q, dq);
        let rigid = arm.mass_matrix(q) * reference.ddq
            + arm.coriolis_matrix(q, dq) * reference.dq
            + arm.gravity(q);
        let wanted = rigid + effects;
        let known =
            arm.inverse_dynamics_at(&moving) - arm.base_regressor_of_at(&moving) * arm.beta();
        assert!(
            known.amax() < 1e-9 * wanted.amax().max(1.0),
            "{spec}: nothing is fixed in it"
        );
        let regressor = ReferenceRegressor::new(&arm);
        close(
            &(regressor.at(&arm, &state, &reference) * arm.beta()),
            &wanted,
            ROUNDING,
        );
        close(
            &ReferenceRegressor::<B>::torque(&arm, &state, &reference),
            &wanted,
            ROUNDING,
        );
    }
}

#[test]
fn reference_regressors_have_the_torque_of_the_reference() {
    reference_regressor_has_the_torque_of_the_reference::<Puma560, _, _, _, _, _, _>("puma560");
    reference_regressor_has_the_torque_of_the_reference::<Panda, _, _, _, _, _, _>("panda");
    reference_regressor_has_the_torque_of_the_reference::<Phantom, _, _, _, _, _, _>("phantom");
    reference_regressor_has_the_torque_of_the_reference::<Memory, _, _, _, _, _, _>("memory");
}

/// Shares sum to the torque, to 1e-12 of the largest.
fn shares_sum_to_the_torque<
    R,
    const D: usize,
    const S: usize,
    const B: usize,
    const H: usize,
    const M: usize,
    const I: usize,
>(
    spec: &str,
) -> Vec<&'static str>
where
    R: FromParameters<D, S, B, H, M, I>,
{
    let mut names = Vec::new();
    for seed in 0..10 {
        let (arm, state) = arm_and_state::<R, D, S, B, H, M, I>(spec, seed);
        let shares = Dissection::new(&arm, &state);
        let effects: Vec<_> = shares.effects().collect();
        let parts = [shares.inertia, shares.coriolis, shares.gravity].into_iter();
        let parts = parts.chain(effects.iter().map(|share| share.torque));
        let largest = parts.map(|part| part.amax()).fold(0.0, f64::max);
        let error = (shares.sum() - arm.inverse_dynamics_at(&state)).amax();
        assert!(error < 1e-12 * largest, "{spec}: {error:.1e} of {largest}");
        names = effects.iter().map(|share| share.name).collect();
    }
    names
}

#[test]
fn dissections_sum_to_the_torque() {
    let puma = shares_sum_to_the_torque::<Puma560, _, _, _, _, _, _>("puma560");
    assert_eq!(puma.len(), 6 + 6 + 6 + 1);
    assert!(puma.contains(&"wrist_pitch.gear_coupling") && puma.contains(&"elbow.motor_inertia"));
    let phantom = shares_sum_to_the_torque::<Phantom, _, _, _, _, _, _>("phantom");
    assert_eq!(phantom.len(), 6);
    let mounted = shares_sum_to_the_torque::<MountedArm, _, _, _, _, _, _>("mounted_arm");
    assert!(mounted.contains(&"reach.payload"), "{mounted:?}");
    shares_sum_to_the_torque::<Panda, _, _, _, _, _, _>("panda");
    shares_sum_to_the_torque::<Memory, _, _, _, _, _, _>("memory");
}

/// Rigid shares of an arm without effects on its bodies are those of the matrices.
#[test]
fn rigid_shares_are_those_of_the_matrices() {
    let (arm, state) = arm_and_state::<Panda, 7, _, _, _, _, _>("panda", 3);
    let shares = Dissection::new(&arm, &state);
    close(
        &shares.inertia,
        &(arm.mass_matrix(&state.q) * state.ddq),
        1e-10,
    );
    close(&shares.gravity, &arm.gravity(&state.q), 1e-10);
    close(
        &shares.coriolis,
        &(arm.coriolis_matrix(&state.q, &state.dq) * state.dq),
        1e-10,
    );
}

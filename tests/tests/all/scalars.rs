//! Emitted code in every scalar: lanes are states side by side, single precision is close, dual numbers are slopes.

use robot_model::scalar::{Dual, Lanes4, Lanes8};
use robot_model::{FromParameters, Mechanics, Memory, RobotModel, Scalar, State, Vector};
use robot_model_tests::emitted::{
    every_effect, memory, odd_angles, panda, phantom, rokae_like, stanford,
};
use robot_model_tests::states::{generator, state, typed};

/// The same law for an arm of links, one with a slide, one with every effect, one with a memory, and energies.
macro_rules! for_arms {
    ($law:ident) => {
        $law::<panda::Panda, _, _, _, _, _, _>();
        $law::<stanford::Stanford, _, _, _, _, _, _>();
        $law::<rokae_like::RokaeLike, _, _, _, _, _, _>();
        $law::<every_effect::EveryEffect, _, _, _, _, _, _>();
        $law::<odd_angles::Scalar, _, _, _, _, _, _>();
        $law::<memory::Memory, _, _, _, _, _, _>();
        $law::<phantom::Phantom, _, _, _, _, _, _>();
    };
}

macro_rules! law {
    ($(#[$doc:meta])* fn $name:ident($states:ident, $arm:ident) $body:block) => {
        $(#[$doc])*
        #[test]
        fn $name() {
            fn law<
                R,
                const DOF: usize,
                const STANDARD: usize,
                const BASE: usize,
                const SHAPES: usize,
                const STATES: usize,
                const INPUTS: usize,
            >()
            where
                R: FromParameters<DOF, STANDARD, BASE, SHAPES, STATES, INPUTS>
                    + Mechanics<DOF, STANDARD, BASE, SHAPES, STATES, INPUTS>,
            {
                let $arm = R::from_standard(&Vector::from_fn(|k, _| 0.3 + 0.01 * (k as f64 * 1.7).sin()));
                let mut random = generator(17);
                let $states: [State<DOF, STATES, INPUTS>; 8] =
                    std::array::from_fn(|_| typed(&state(&mut random, DOF)));
                $body
            }
            for_arms!(law);
        }
    };
}

law! {
    fn lanes_are_states_side_by_side(states, arm) {
        let eight: State<DOF, STATES, INPUTS, Lanes8> = State::from(states);
        let four: State<DOF, STATES, INPUTS, Lanes4> = State::from([states[0], states[1], states[2], states[3]]);
        let (torques, regressors) = (arm.inverse_dynamics_at(&eight), R::base_regressor_at(&eight, &arm.shapes()));
        let torques_of_four = arm.inverse_dynamics_at(&four);
        let inertias = arm.mass_matrix(&eight.q);
        for (lane, state) in states.iter().enumerate() {
            let tau = arm.inverse_dynamics_at(state);
            assert_eq!(torques.map(|x| x.to_array()[lane]), tau);
            assert_eq!(regressors.map(|x| x.to_array()[lane]), R::base_regressor_at(state, &arm.shapes()));
            assert_eq!(inertias.map(|x| x.to_array()[lane]), arm.mass_matrix(&state.q));
            if lane < Lanes4::COUNT {
                assert_eq!(torques_of_four.map(|x| x.to_array()[lane]), tau);
            }
        }
    }
}

law! {
    fn single_precision_is_close(states, arm) {
        for state in &states {
            let single = state.map(f32::of);
            // The same motion to its last bit.
            let rounded = state.map(|x| f64::from(f32::of(x)));
            let found = arm.inverse_dynamics_at(&single).map(f64::from);
            let wanted = arm.inverse_dynamics_at(&rounded);
            // Some hundred roundings of 6e-8.
            assert!((found - wanted).amax() < 1e-4 * wanted.amax(), "{found} {wanted}");
        }
    }
}

law! {
    /// Along a direction in which positions and velocities change.
    fn slopes_are_the_partial_derivatives(states, arm) {
        for [state, direction] in states.as_chunks::<2>().0 {
            let mut moving = state.map(Dual::constant);
            for k in 0..DOF {
                moving.q[k].slope = direction.q[k];
                moving.dq[k].slope = direction.dq[k];
            }
            let found = arm.inverse_dynamics_at(&moving);
            let tau = arm.inverse_dynamics_at(state);
            assert_eq!(found.map(|x| x.value), tau);
            let wanted = arm.inverse_dynamics_by_position_at(state) * direction.q
                + arm.inverse_dynamics_by_velocity_at(state) * direction.dq;
            let slope = found.map(|x| x.slope);
            let size = wanted.amax().max(tau.amax());
            assert!((slope - wanted).amax() < 1e-10 * size, "{slope} {wanted}");
        }
    }
}

law! {
    fn accelerations_of_lanes_give_their_torque(states, arm) {
        let eight: State<DOF, STATES, INPUTS, Lanes8> = State::from(states);
        let tau = arm.inverse_dynamics_at(&eight);
        // Where friction depends on the load the torque may hold an arm, in one lane or in another.
        let Some(ddq) = arm.forward_dynamics_at(&eight, &tau) else {
            let held = states.iter().any(|state| {
                arm.forward_dynamics_at(state, &arm.inverse_dynamics_at(state)).is_none()
            });
            assert!(held);
            return;
        };
        for (found, wanted) in ddq.iter().zip(&eight.ddq) {
            let error = (*found - *wanted).abs().most();
            assert!(error < 1e-6 * wanted.abs().most().max(1.0), "{found:?} {wanted:?}");
        }
    }
}

/// Internal states of effects after a step, in lanes, in single precision and with slopes.
#[test]
fn memory_in_every_scalar() {
    let arm = memory::Memory::from_standard(&Vector::from_element(0.3));
    let mut random = generator(5);
    let states: [State<2, 4, 3>; 8] = std::array::from_fn(|_| typed(&state(&mut random, 2)));
    let seconds = 1e-3;
    let lanes: State<2, 4, 3, Lanes8> = State::from(states);
    let together = arm.memory_after(&lanes, seconds);
    for (lane, state) in states.iter().enumerate() {
        let alone = arm.memory_after(state, seconds);
        let found = together.map(|z| z.to_array()[lane]);
        // Halvings are those of the stiffest lane.
        assert!(
            (found - alone).amax() < 1e-13 * alone.amax().max(1.0),
            "{found} {alone}"
        );

        let single = arm.memory_after(&state.map(f32::of), seconds);
        let error = (single.map(f64::from) - alone).amax();
        assert!(error < 1e-4 * alone.amax(), "{single} {alone}");

        // Along the velocity of the first joint.
        let mut moving = state.map(Dual::constant);
        moving.dq[0] = Dual::variable(state.dq[0]);
        let slope = arm.memory_after(&moving, seconds);
        let h = 1e-6 * state.dq[0].abs();
        let at = |dq: f64| {
            let mut state = *state;
            state.dq[0] = dq;
            arm.memory_after(&state, seconds)
        };
        let difference = (at(state.dq[0] + h) - at(state.dq[0] - h)) / (2.0 * h);
        assert!((slope.map(|z| z.value) - alone).amax() < 1e-14 * alone.amax());
        let size = difference.amax().max(1e-6);
        assert!(
            (slope.map(|z| z.slope) - difference).amax() < 1e-5 * size,
            "{slope:?} {difference}"
        );
    }
}

/// Friction that depends on the load: accelerations by Newton's method, to the precision of the scalar.
#[test]
fn accelerations_in_single_precision() {
    let arm = odd_angles::Scalar::from_standard(&Vector::from_fn(|k, _| match k % 10 {
        // A body of 2 kg: mass, first moments, inertia.
        0 => 2.0,
        4 | 7 | 9 => 0.3,
        _ => 0.05,
    }));
    let mut random = generator(29);
    let mut found = 0;
    for _ in 0..50 {
        let state: State<3> = typed(&state(&mut random, 3));
        let tau = arm.inverse_dynamics_at(&state);
        let single = state.map(f32::of);
        let Some(wanted) = arm.forward_dynamics_at(&state, &tau) else {
            continue;
        };
        let ddq = arm.forward_dynamics_at(&single, &tau.map(f32::of));
        let ddq = ddq.expect("solved in double precision").map(f64::from);
        let scale = wanted.amax().max(tau.amax());
        assert!((ddq - wanted).amax() < 1e-3 * scale, "{ddq} {wanted}");
        found += 1;
    }
    assert!(found > 40, "{found}");
}

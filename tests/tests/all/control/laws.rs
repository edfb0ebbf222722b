//! Laws against their equations: the loop that computed torque leaves, and hand guiding.

use robot_model::control::{ComputedTorque, ControlError, Friction, Gains, HandGuiding};
use robot_model::{Mechanics, RobotModel, State, Vector};
use robot_model_tests::emitted::puma560::Puma560;

use super::{ROUNDING, arm_and_state, close};

/// With the arm's own parameters and friction at the measured velocity, the error is that of a linear loop.
#[test]
fn computed_torque_makes_double_integrators() -> Result<(), ControlError> {
    let (arm, measured) = arm_and_state::<Puma560, 6, _, _, _, _, _>("puma560", 1);
    let gains = Gains::new(20.0, 0.8);
    let desired = State::new(
        measured.q.map(|q| q + 0.01),
        measured.dq * 0.9,
        measured.ddq,
    );
    let mut control = ComputedTorque::new(arm, gains)?;
    let wanted = desired.ddq
        + gains.kd().component_mul(&(desired.dq - measured.dq))
        + gains.kp().component_mul(&(desired.q - measured.q));
    let accelerations = |tau: &Vector<6>| {
        arm.forward_dynamics(&measured.q, &measured.dq, tau)
            .expect("an arm")
    };
    let mut full = control.with_friction(Friction::full().at_measured_velocity())?;
    close(
        &accelerations(&full.torque(&measured, &desired).torque),
        &wanted,
        1e-8,
    );

    // Shares lie between none and all, also at the desired velocity: rotors are always compensated.
    let torque = |friction| {
        Ok::<_, ControlError>(
            control
                .with_friction(friction)?
                .torque(&measured, &desired)
                .torque,
        )
    };
    let (none, half, all) = (
        torque(Friction::none())?,
        torque(Friction::part(0.5))?,
        torque(Friction::full())?,
    );
    close(&half, &((none + all) * 0.5), ROUNDING);
    let friction = |dq: &Vector<6>| {
        arm.inverse_dynamics(&measured.q, dq, &Vector::zeros()) - arm.bias(&measured.q, dq)
    };
    close(&(all - none), &friction(&desired.dq), 1e-9);
    let rigid = arm.inverse_dynamics(&measured.q, &measured.dq, &wanted) - friction(&measured.dq);
    close(&none, &rigid, 1e-9);
    let _ = control.torque(&measured, &desired);
    Ok(())
}

#[test]
fn hand_guiding_is_equation_31() -> Result<(), ControlError> {
    let (arm, state) = arm_and_state::<Puma560, 6, _, _, _, _, _>("puma560", 2);
    let (q, dq) = (&state.q, &state.dq);
    let friction = arm.inverse_dynamics(q, dq, &Vector::zeros()) - arm.bias(q, dq);
    let wanted = arm.coriolis_matrix(q, dq) * dq + arm.gravity(q) + friction - dq * 0.4;
    let mut control = HandGuiding::new(arm, [0.4; 6])?;
    close(&control.torque(&state).torque, &wanted, ROUNDING);
    let mut control = control.with_friction(0.25)?;
    close(
        &control.torque(&state).torque,
        &(wanted - friction * 0.75),
        ROUNDING,
    );
    Ok(())
}

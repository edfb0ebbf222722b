//! Cycles without sound readings: the arm is held, the reason is said, and the law comes back.

use robot_model::control::{
    ComputedTorque, ControlError, Gains, GravityCompensation, HandGuiding, Reason, Safety, Signal,
    Status,
};
use robot_model::{RobotModel, State, Vector};
use robot_model_tests::emitted::memory::Memory;
use robot_model_tests::emitted::puma560::Puma560;

use super::{ROUNDING, arm_and_state, close, puma};

/// Whatever is read, a torque within the limits comes out, with the reason; with the readings the law comes back.
#[test]
fn a_controller_holds_the_arm_and_recovers() -> Result<(), ControlError> {
    let arm = puma();
    let limits = [60.0, 60.0, 30.0, 5.0, 5.0, 5.0];
    let safety = Safety::new()
        .torque(limits)
        .velocity([3.0; 6])
        .position([-2.5; 6], [2.5; 6])
        .brake(4.0);
    let mut control =
        ComputedTorque::new(arm, Gains::critically_damped(10.0))?.with_safety(safety)?;
    let desired = State::at_rest(Vector::from([0.1, -0.6, 0.8, 0.3, 0.4, -0.2]));
    let good = State::new(desired.q, Vector::repeat(0.1), Vector::zeros());
    let check =
        |control: &mut ComputedTorque<Puma560, 6>, measured: &State<6>, desired: &State<6>| {
            let command = control.torque(measured, desired);
            for (tau, limit) in command.torque.iter().zip(limits) {
                assert!(tau.abs() <= limit, "{command:?}");
            }
            command
        };
    // Nothing was read yet.
    let mut lost = good;
    lost.q[4] = f64::NAN;
    assert_eq!(
        check(&mut control, &lost, &desired).torque,
        Vector::<6>::zeros()
    );
    let normal = check(&mut control, &good, &desired);
    assert!(
        matches!(normal.status, Status::Normal | Status::Saturated),
        "{normal:?}"
    );

    let inertia = arm.mass_matrix(&good.q).diagonal();
    let cut = |tau: Vector<6>| Vector::<6>::from_fn(|k, _| tau[k].clamp(-limits[k], limits[k]));
    let safe = |dq: Vector<6>| cut(arm.gravity(&good.q) - inertia.component_mul(&dq) * 4.0);
    let held = check(&mut control, &lost, &desired);
    assert_eq!(
        held.status,
        Status::Held(Reason::NoNumber {
            signal: Signal::Position,
            index: 4
        })
    );
    close(&held.torque, &safe(good.dq), ROUNDING);

    // A velocity that is no number does not brake, one beyond its limit brakes as at the limit.
    let mut lost = good;
    lost.dq[1] = f64::NEG_INFINITY;
    lost.dq[2] = 500.0;
    let held = check(&mut control, &lost, &desired);
    assert_eq!(
        held.status,
        Status::Held(Reason::NoNumber {
            signal: Signal::Velocity,
            index: 1
        })
    );
    close(
        &held.torque,
        &safe(Vector::from([0.1, 0.0, 3.0, 0.1, 0.1, 0.1])),
        ROUNDING,
    );
    lost.dq[1] = 0.1;
    let held = check(&mut control, &lost, &desired);
    assert_eq!(
        held.status,
        Status::Held(Reason::OutsideLimits {
            signal: Signal::Velocity,
            index: 2
        })
    );

    let mut away = good;
    away.q[0] = 2.6;
    let held = check(&mut control, &away, &desired);
    assert_eq!(
        held.status,
        Status::Held(Reason::OutsideLimits {
            signal: Signal::Position,
            index: 0
        })
    );
    let mut nowhere = desired;
    nowhere.ddq[5] = f64::NAN;
    let held = check(&mut control, &good, &nowhere);
    assert_eq!(
        held.status,
        Status::Held(Reason::NoNumber {
            signal: Signal::DesiredAcceleration,
            index: 5
        })
    );
    nowhere.ddq[5] = f64::MAX;
    let held = check(&mut control, &good, &nowhere);
    assert!(
        matches!(
            held.status,
            Status::Held(Reason::NoTorque { .. }) | Status::Saturated
        ),
        "{held:?}"
    );
    // And back.
    assert_eq!(check(&mut control, &good, &desired), normal);
    Ok(())
}

/// Memories and channels are read, so they are looked at; at rest they hold nothing.
#[test]
fn arms_with_a_memory_are_held_without_it() -> Result<(), ControlError> {
    let (arm, state) = arm_and_state::<Memory, 2, _, _, _, _, _>("memory", 9);
    let mut control = HandGuiding::new(arm, [0.5; 2])?;
    assert_eq!(control.torque(&state).status, Status::Normal);
    let mut lost = state;
    lost.memory[1] = f64::NAN;
    let held = control.torque(&lost);
    assert_eq!(
        held.status,
        Status::Held(Reason::NoNumber {
            signal: Signal::Memory,
            index: 1
        })
    );
    assert!(held.torque.iter().all(|tau| tau.is_finite()));
    lost = state;
    lost.inputs[0] = f64::NAN;
    let held = GravityCompensation::new(arm).torque(&lost);
    assert_eq!(
        held.status,
        Status::Held(Reason::NoNumber {
            signal: Signal::Input,
            index: 0
        })
    );
    assert!(held.torque.iter().all(|tau| tau.is_finite()));
    Ok(())
}

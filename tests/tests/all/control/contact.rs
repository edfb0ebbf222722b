//! What acts on an arm from outside: the momentum observer's pole, and forces that are felt.

use robot_model::control::{ContactForce, ControlError, MomentumObserver, Reason, Signal, Status};
use robot_model::{Kinematics, Points, RobotModel, State, Vector};
use robot_model_tests::emitted::panda::Panda;
use robot_model_tests::emitted::phantom::Phantom;
use robot_model_tests::emitted::puma560::Puma560;
use robot_model_tests::emitted::two_link::TwoLink;

use super::{arm_and_state, close, moved, puma};

/// A constant push on a moving arm is seen as a first-order lag of it.
#[test]
fn the_observer_follows_a_push_with_its_pole() -> Result<(), ControlError> {
    let (arm, h, pole) = (puma(), 1e-3, 40.0);
    let push = Vector::from([3.0, -5.0, 2.0, 0.5, 0.2, -0.1]);
    let mut observer = MomentumObserver::new(arm, pole, h)?;
    let mut state = State::at_rest(Vector::from([0.1, -0.6, 0.8, 0.3, 0.4, -0.2]));
    let start = state.q;
    let mut tau = Vector::zeros();
    for k in 0..1000_i32 {
        let found = observer.update(&state, &tau);
        assert_eq!(found.status, Status::Normal);
        let lag = 1.0 - (-pole * h * f64::from(k)).exp();
        // The trapezoidal rule on a motion of some rad/s.
        assert!(
            (found.torque - push * lag).amax() < 2e-3,
            "{k}: {}",
            found.torque - push * lag
        );
        tau = arm.gravity(&state.q) - (state.q - start) * 50.0 - state.dq * 3.0;
        state = moved(&arm, &state, &(tau + push), h);
    }
    assert!(state.dq.amax() > 1e-4, "it moves");
    // Without readings it keeps what it knows, and goes on from there.
    let before = observer.update(&state, &tau).torque;
    let mut lost = state;
    lost.dq[2] = f64::INFINITY;
    let held = observer.update(&lost, &tau);
    assert_eq!(
        held.status,
        Status::Held(Reason::NoNumber {
            signal: Signal::Velocity,
            index: 2
        })
    );
    assert_eq!(held.torque, before);
    assert_eq!(observer.update(&state, &tau).torque, before);
    Ok(())
}

#[test]
fn contact_forces_are_found_where_they_are_felt() -> Result<(), ControlError> {
    let (arm, state) = arm_and_state::<Puma560, 6, _, _, _, _, _>("puma560", 4);
    let contact = ContactForce::new(arm, 1e-3)?;
    let wrench = Vector::from([10.0, -4.0, 7.0, 0.6, 0.3, -0.9]);
    let tau = arm.inverse_dynamics_at(&state) + arm.jacobian(&state.q).tr_mul(&wrench);
    let found = contact.of_arm(&state, &tau);
    assert_eq!((found.status, found.unseen().count()), (Status::Normal, 0));
    close(&found.force, &wrench, 1e-9);
    assert!(found.unexplained.amax() < 1e-10 && found.damping == 0.0);
    let root = (arm.jacobian(&state.q) * arm.jacobian(&state.q).transpose())
        .determinant()
        .sqrt();
    // Moments count at 0.2 m.
    assert!((found.manipulability / (root * 0.2_f64.powi(3)) - 1.0).abs() < 1e-9);

    // Wrist stretched: two axes are one, so one direction is not felt, and the force stays finite.
    let mut q = state.q;
    q[4] = 0.0;
    let load = arm.jacobian(&q).tr_mul(&wrench);
    let found = contact.at_tip(&q, &load);
    assert_eq!(found.unseen().count(), 1);
    assert!(found.manipulability < 1e-12 && (found.damping - 1e-3).abs() < 1e-9);
    let unseen = found.unseen().next().expect("one of six");
    assert!(arm.jacobian(&q).tr_mul(&unseen).amax() < 1e-12);
    // What is felt of it is right.
    assert!((arm.jacobian(&q).tr_mul(&found.force) - load).amax() < 1e-9);

    // Near the singular pose what comes out is bounded by the torque over the threshold, however small the angle.
    for angle in [1e-12, 1e-9, 1e-6, 1e-3, 1e-2] {
        q[4] = angle;
        let noise = contact.at_tip(&q, &Vector::repeat(0.01));
        let scaled = Vector::<6>::from_fn(|k, _| noise.force[k] / if k < 3 { 1.0 } else { 0.2 });
        assert!(scaled.norm() <= 0.01 * 6f64.sqrt() / 1e-3 + 1e-9, "{angle}");
    }
    let lost = contact.at_tip(&q, &Vector::repeat(f64::NAN));
    assert_eq!(lost.force, Vector::<6>::zeros());
    assert_eq!(
        lost.status,
        Status::Held(Reason::NoNumber {
            signal: Signal::Torque,
            index: 0
        })
    );
    Ok(())
}

/// A joint to spare explains a torque that no wrench makes; two joints feel two directions.
#[test]
fn contact_with_seven_joints_and_with_two() -> Result<(), ControlError> {
    let (arm, _) = arm_and_state::<Panda, 7, _, _, _, _, _>("panda", 5);
    // Far from singular: a random pose may be within the threshold.
    let state = State::at_rest(Vector::from([0.1, -0.8, 0.2, -2.3, 0.1, 1.6, 0.8]));
    let contact = ContactForce::new(arm, 1e-3)?;
    let wrench = Vector::from([10.0, -4.0, 7.0, 0.6, 0.3, -0.9]);
    let load = arm.jacobian(&state.q).tr_mul(&wrench);
    close(&contact.at_tip(&state.q, &load).force, &wrench, 1e-9);
    let some = Vector::from([1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0]);
    let found = contact.at_tip(&state.q, &some);
    assert!((arm.jacobian(&state.q) * found.unexplained).amax() < 1e-9);
    assert!(found.unexplained.amax() > 1e-3);

    let (arm, state) = arm_and_state::<TwoLink, 2, _, _, _, _, _>("two_link", 5);
    let found = ContactForce::new(arm, 1e-3)?.at_tip(&state.q, &Vector::from([1.0, 2.0]));
    assert_eq!(found.unseen().count(), 4);
    assert!(found.unexplained.amax() < 1e-12);
    Ok(())
}

/// Equations 20 and 21 of seed 004.
#[test]
fn contact_forces_of_the_phantom() -> Result<(), ControlError> {
    let (arm, state) = arm_and_state::<Phantom, 3, _, _, _, _, _>("phantom", 6);
    let contact = ContactForce::new(arm, 1e-4)?;
    let force = Vector::from([0.3, -1.2, 0.8]);
    let [jacobian] = arm.point_jacobians(&state.q);
    let tau = arm.inverse_dynamics_at(&state) + jacobian.tr_mul(&force);
    let found = contact.of_robot(&state, &tau, 0).expect("the tip");
    close(&found.force, &force, 1e-9);
    assert!(contact.of_robot(&state, &tau, 1).is_none());
    // det J = (l1 c2 + l2 s3) l1 c23 l2 with c23 = cos(th2 - th3).
    let (l1, l2) = (0.215, 0.170);
    let [_, th2, th3] = state.q.data.0[0];
    let wanted = (l1 * th2.cos() + l2 * th3.sin()) * l1 * (th2 - th3).cos() * l2;
    assert!((found.manipulability - wanted.abs()).abs() < 1e-12);
    Ok(())
}

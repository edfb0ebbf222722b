//! Laws of the controllers, on arms of the specs.

use robot_model::control::counterbalance::{Weight, mass, moment};
use robot_model::control::{
    Adaptation, Adaptive, ComputedTorque, ContactForce, ControlError, Dissection, Friction, Gains,
    GravityCompensation, HandGuiding, MomentumObserver, Reason, Reference, ReferenceRegressor,
    Safety, Signal, Status,
};
use robot_model::{FromParameters, Kinematics, Mechanics, Points, RobotModel, State, Vector};
use robot_model_tests::emitted::memory::Memory;
use robot_model_tests::emitted::mounted_arm::MountedArm;
use robot_model_tests::emitted::panda::Panda;
use robot_model_tests::emitted::phantom::Phantom;
use robot_model_tests::emitted::puma560::Puma560;
use robot_model_tests::emitted::two_link::TwoLink;
use robot_model_tests::specs;
use robot_model_tests::states::{self, generator, typed};

/// Sums of some thousand roundings.
const ROUNDING: f64 = 1e-11;

/// An arm of a spec that could be built, and a state of it.
fn arm_and_state<
    R,
    const D: usize,
    const S: usize,
    const B: usize,
    const H: usize,
    const M: usize,
    const I: usize,
>(
    spec: &str,
    seed: u64,
) -> (R, State<D, M, I>)
where
    R: FromParameters<D, S, B, H, M, I>,
{
    let model = specs::named(&format!("pass/{spec}")).model();
    let mut random = generator(seed);
    let mut standard = states::physical(&mut random, &model);
    for (value, parameter) in standard.iter_mut().zip(model.standard_parameters()) {
        // A coupling of rotors is weaker than they are, or nothing could move them.
        if parameter.name.ends_with("gear_coupling.ia") {
            *value *= 0.1;
        }
    }
    let state = states::state(&mut random, D);
    (
        R::from_standard(&Vector::from_column_slice(&standard)),
        typed(&state),
    )
}

#[track_caller]
fn close<const N: usize>(found: &Vector<N>, wanted: &Vector<N>, tolerance: f64) {
    let size = wanted.amax().max(1e-300);
    let difference = (found - wanted).amax() / size;
    assert!(
        difference < tolerance,
        "{difference:.1e}\nfound {found}wanted {wanted}"
    );
}

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

/// A plant by the classical method of Runge and Kutta; torque and external torque are constant over the step.
fn moved<R, const D: usize, const S: usize, const B: usize>(
    arm: &R,
    state: &State<D>,
    tau: &Vector<D>,
    h: f64,
) -> State<D>
where
    R: Mechanics<D, S, B>,
{
    let slope = |q: Vector<D>, dq: Vector<D>| {
        (
            dq,
            arm.forward_dynamics(&q, &dq, tau)
                .expect("an arm that could be built"),
        )
    };
    let (q, dq) = (state.q, state.dq);
    let (v1, a1) = slope(q, dq);
    let (v2, a2) = slope(q + v1 * (h / 2.0), dq + a1 * (h / 2.0));
    let (v3, a3) = slope(q + v2 * (h / 2.0), dq + a2 * (h / 2.0));
    let (v4, a4) = slope(q + v3 * h, dq + a3 * h);
    State::new(
        q + (v1 + (v2 + v3) * 2.0 + v4) * (h / 6.0),
        dq + (a1 + (a2 + a3) * 2.0 + a4) * (h / 6.0),
        Vector::zeros(),
    )
}

/// PUMA 560 with its CAD values and a friction that does not jump, so that a step is a step.
fn puma() -> Puma560 {
    let mut standard = Vector::from(Puma560::NOMINAL);
    for (name, value) in Puma560::STANDARD_PARAMETERS.iter().zip(&mut standard) {
        if name.ends_with("viscous_friction.fv") {
            *value = 2.0;
        } else if name.ends_with("motor_inertia.ia") {
            *value = 0.3;
        }
    }
    Puma560::from_standard(&standard)
}

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

/// On an ideal plant `V = 1/2 s^T M s + 1/2 e^T Gamma^-1 e` falls by `s^T K_d s`.
#[test]
fn adaptation_is_passive() -> Result<(), ControlError> {
    let truth = {
        let (arm, _) = arm_and_state::<TwoLink, 2, _, _, _, _, _>("two_link", 7);
        // Coulomb's torque jumps, and a step over a jump is none.
        let mut standard = arm.standard();
        for (name, value) in TwoLink::STANDARD_PARAMETERS.iter().zip(&mut standard) {
            if name.contains("coulomb") {
                *value = 0.0;
            }
        }
        TwoLink::from_standard(&standard)
    };
    let guess = TwoLink::from_base(&(truth.beta() * 0.6));
    let (h, rate, bandwidth, damping) = (1e-4, 0.5, 8.0, 6.0);
    let mut control = Adaptive::new(guess, Adaptation::new(bandwidth, damping, rate), h)?;
    let desired = |t: f64| {
        let (w, size) = (Vector::from([2.0, 3.1]), Vector::from([0.6, 0.8]));
        let phase = w * t;
        State::new(
            size.component_mul(&phase.map(f64::sin)),
            size.component_mul(&w).component_mul(&phase.map(f64::cos)),
            -size
                .component_mul(&w)
                .component_mul(&w)
                .component_mul(&phase.map(f64::sin)),
        )
    };
    let mut state = State::at_rest(Vector::from([0.3, -0.4]));
    let (mut last, mut lost, mut first, mut errors) = (f64::NAN, 0.0, f64::NAN, Vec::new());
    for k in 0..40_000_i32 {
        let wanted = desired(h * f64::from(k));
        let s = state.dq - wanted.dq - (wanted.q - state.q) * bandwidth;
        let error = control.estimate() - truth.beta();
        let energy =
            0.5 * (truth.mass_matrix(&state.q) * s).dot(&s) + 0.5 * error.norm_squared() / rate;
        if k == 0 {
            first = energy;
        } else {
            // A cycle's hold is of first order in its length.
            assert!(energy <= last + 1e-2 * h * first, "{k}: {last} to {energy}");
        }
        lost += h * damping * s.norm_squared();
        last = energy;
        errors.push((wanted.q - state.q).norm());
        let tau = control.torque(&state, &wanted).torque;
        state = moved(&truth, &state, &tau, h);
    }
    assert!(
        (first - last - lost).abs() < 0.01 * first,
        "{first} {last} {lost}"
    );
    let mean = |part: &[f64]| part.iter().sum::<f64>() / part.len() as f64;
    // How fast is not in the law: after two periods a twelfth was measured.
    assert!(mean(&errors[36_000..]) < 0.2 * mean(&errors[..4_000]));
    Ok(())
}

/// Ranges hold, and a cut torque teaches nothing.
#[test]
fn adaptation_stays_in_its_ranges() -> Result<(), ControlError> {
    let (arm, state) = arm_and_state::<TwoLink, 2, _, _, _, _, _>("two_link", 8);
    let beta = arm.beta();
    let far = State::at_rest(state.q + Vector::repeat(1.0));
    let around = Vector::repeat(0.01);
    let gains = Adaptation::new(10.0, 5.0, 100.0);
    let mut control =
        Adaptive::new(arm, gains, 1e-2)?.with_bounds(&(beta - around), &(beta + around))?;
    for _ in 0..20 {
        let _ = control.torque(&state, &far);
    }
    let moved = control.estimate() - beta;
    assert!(moved.amax() > 0.005 && moved.amax() < 0.01 + 1e-12);
    let mut weak = Adaptive::new(arm, gains, 1e-2)?.with_safety(Safety::new().torque([1e-3; 2]))?;
    assert_eq!(weak.torque(&state, &far).status, Status::Saturated);
    assert_eq!(*weak.estimate(), beta);
    Ok(())
}

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

/// Seed 004, equations 16 to 19 with its numbers; the lever of 0.075 m that it prints is rounded from 0.0704 m.
#[test]
fn counterweights_of_the_phantom() -> Result<(), ControlError> {
    let g = 9.81;
    let tool = |lever: f64| Weight { mass: 0.09, lever };
    let (upper, fore) = (-0.01923, -0.10996);
    let results = |lever: f64| -> Result<[f64; 4], ControlError> {
        let maker = Weight {
            mass: 0.216,
            lever: -lever,
        };
        Ok([
            moment(upper, g, &[tool(0.216), maker]),
            moment(fore, g, &[tool(0.195)]),
            mass(moment(upper, g, &[tool(0.216)]), g, lever)?,
            mass(moment(fore, g, &[tool(0.195)]), g, lever)?,
        ])
    };
    for (lever, wanted) in [
        (0.075, [0.01255, 0.0622, 0.233, 0.0845]),
        (0.0704, [0.0223, 0.0622, 0.248, 0.090]),
    ] {
        for (found, wanted) in results(lever)?.into_iter().zip(wanted) {
            assert!(
                (found - wanted).abs() < 6e-3 * wanted,
                "{lever}: {found} {wanted}"
            );
        }
    }
    // Without a tool the arm is too light already.
    assert!(matches!(
        mass(upper, g, 0.0704),
        Err(ControlError::NegativeWeight { .. })
    ));
    assert!(mass(f64::NAN, g, 0.0704).is_err() && mass(0.1, 0.0, 0.0704).is_err());
    assert_eq!(mass(0.0, g, 0.0704)?.to_bits(), 0.0_f64.to_bits());
    Ok(())
}

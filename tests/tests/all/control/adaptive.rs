//! Adaptive control: what its energy does, and when its parameters stay.

use robot_model::control::{Adaptation, Adaptive, ControlError, Safety, Status};
use robot_model::{FromParameters, RobotModel, State, Vector};
use robot_model_tests::emitted::two_link::TwoLink;

use super::{arm_and_state, moved};

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

//! The `build.rs` route: `arm.robot` became Rust while `embedded` was built, with the numbers of `arm.json` in it.
//!
//! Evaluates the equations at one state, then lets the controller of `embedded` follow a motion at 1 kHz.
#![expect(clippy::print_stdout, reason = "an example shows its result")]

use std::time::Instant;

use robot_model::{Mechanics, RobotModel, State, Vector};
use robot_model_embedded::{TwoLinkArm, computed_torque};

const STEP_S: f64 = 1e-3;
const STEPS: u32 = 2000;

/// Prints the equations at one state and how the controlled arm follows its reference.
pub fn main() {
    let arm = TwoLinkArm;
    assert_eq!(size_of_val(&arm), 0);
    let state = State::new(
        Vector::from([0.3, -0.8]),
        Vector::from([1.0, 0.5]),
        Vector::from([2.0, -3.0]),
    );
    let mass_matrix = arm.mass_matrix(&state.q);
    let bias = arm.bias(&state.q, &state.dq);
    let tau = arm.inverse_dynamics(&state.q, &state.dq, &state.ddq);
    let friction = tau - mass_matrix * state.ddq - bias;
    println!(
        "{} with beta = {:?}",
        TwoLinkArm::NAME,
        TwoLinkArm::BASE_PARAMETERS
    );
    println!("M = {mass_matrix:.4}tau = {tau:.4}of which friction {friction:.4}");
    // Viscous friction at 1 rad/s and 0.5 rad/s.
    assert!((friction - Vector::from([1.5, 0.3])).norm() < 1e-12);

    // The arm starts 0.2 rad beside its reference. Numbers on the stack only: no allocation in the loop.
    let mut now = State::at_rest(reference(0.0).q + Vector::from([0.2, -0.2]));
    let start = Instant::now();
    for k in 0..STEPS {
        let tau = computed_torque(&arm, &now, &reference(f64::from(k) * STEP_S), 100.0);
        now = moved(arm, &now, &tau);
    }
    let tick = start.elapsed() / STEPS;
    let error = (now.q - reference(f64::from(STEPS) * STEP_S).q).norm();
    println!(
        "{STEPS} ticks of 1 ms: error 0.28 rad -> {error:.1e} rad; {tick:?} a tick, plant included"
    );
    assert!(error < 1e-3, "{error}");
}

/// Slow sines, 0.5 Hz.
fn reference(time: f64) -> State<2> {
    let w = std::f64::consts::PI;
    let size = Vector::from([0.6, -0.9]);
    let (sin, cos) = (w * time).sin_cos();
    State::new(size * sin, size * w * cos, size * (-w * w * sin))
}

/// The plant, one semi-implicit Euler step. Rotors would count: the mass matrix has no effects, forward dynamics has all.
fn moved(arm: TwoLinkArm, now: &State<2>, tau: &Vector<2>) -> State<2> {
    let ddq = arm.forward_dynamics(&now.q, &now.dq, tau);
    let ddq = ddq.expect("an arm with masses moves in one way");
    let dq = now.dq + STEP_S * ddq;
    State::new(now.q + STEP_S * dq, dq, ddq)
}

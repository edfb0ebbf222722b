//! A cart on a rail with dry friction that its spec does not declare.

use robot_model::log::Log;

/// Its spec.
pub(crate) const CART: &str = "robot Cart { gravity = [0, 0, -9.81]; convention = origin; \
    joint rail: prismatic { xyz = [0, 0, 0]; axis = [1, 0, 0]; } effects { viscous_friction on rail; } }";

/// The cart with dry friction that the spec does not declare.
pub(crate) fn log() -> Log {
    log_with(&[(0.20, 1.3), (0.05, 4.1), (0.02, 7.9)], |_, dq| {
        2.0 * dq.signum()
    })
}

/// The same along tones of these amplitudes, m, and angular frequencies, rad/s, with this force of position and velocity, N.
pub(crate) fn log_with(tones: &[(f64, f64)], extra: fn(f64, f64) -> f64) -> Log {
    let time: Vec<f64> = (0..8000).map(|k| 0.005 * f64::from(k)).collect();
    let sum = |f: &dyn Fn(f64, f64) -> f64| tones.iter().map(|&(a, w)| f(a, w)).sum::<f64>();
    let q = |t: f64| sum(&|a, w| a * (w * t).sin());
    let tau = |t: f64| {
        let dq = sum(&|a, w| a * w * (w * t).cos());
        sum(&|a, w| -3.0 * a * w * w * (w * t).sin()) + 5.0 * dq + extra(q(t), dq)
    };
    let channel = |f: &dyn Fn(f64) -> f64| vec![time.iter().map(|&t| f(t)).collect()];
    Log::from_samples("plant", time.clone(), channel(&q), channel(&tau)).expect("a sound log")
}

//! The motor: torque over current of the blocked arm, and noise of velocities.

use std::f64::consts::TAU;

use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;
use robot_model::calibrate::StaticGain;

use super::plant::{POSITION_NOISE, POSITION_STEPS, differences};
use super::truth::{RATE, SAMPLES};
use crate::paper::{Error, normal, rounded};

/// Torque of the joint over the current, N m/A. The paper prints none; this is of the size of a PUMA's second joint.
pub const GAIN: f64 = 24.0;

/// Distance of the force gauge from the joint, m.
const DISTANCE: f64 = 0.5;

/// Noise of the gauge, N, which makes the correlation that is printed.
const GAUGE_NOISE: f64 = 2.5;

/// The static experiment, simulated and calibrated.
#[derive(Debug, Clone)]
pub struct Static {
    /// A
    pub current: Vec<f64>,
    /// Force times distance, N m.
    pub torque: Vec<f64>,
    /// The line.
    pub line: StaticGain,
}

/// Forces of the blocked, level arm at a dozen currents.
///
/// # Errors
/// None are expected; those of the calibration are passed on.
pub fn calibrated(seed: u64) -> Result<Static, Error> {
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    let current: Vec<f64> = (1..=12).map(|k| 0.3 * f64::from(k)).collect();
    let force = |i: &f64| GAIN * i / DISTANCE + GAUGE_NOISE * normal(&mut random);
    let torque: Vec<f64> = current.iter().map(force).map(|f| DISTANCE * f).collect();
    let line = StaticGain::fit(&current, &torque)?;
    Ok(Static {
        current,
        torque,
        line,
    })
}

/// By how much backward differences multiply noise of positions, 1/s: by `sqrt(2) / t_s` where it is white. Noise and converter of the
/// experiment, of an arm that stands.
#[must_use]
pub fn noise_gain(seed: u64) -> f64 {
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    let step = TAU / POSITION_STEPS;
    let y: Vec<f64> = (0..SAMPLES)
        .map(|_| rounded(POSITION_NOISE * normal(&mut random), step))
        .collect();
    let size = |values: &[f64]| {
        let mean = values.iter().sum::<f64>() / values.len() as f64;
        let squares = values.iter().map(|x| (x - mean).powi(2));
        (squares.sum::<f64>() / values.len() as f64).sqrt()
    };
    size(&differences(&y)[1..]) / size(&y)
}

/// What it is for white noise, 1/s.
#[must_use]
pub fn white_gain() -> f64 {
    2.0_f64.sqrt() * RATE
}

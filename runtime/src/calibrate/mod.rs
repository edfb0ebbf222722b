//! What stands between a motor's current and a joint's torque: the gain from one to the other, and the back electromotive force.
//!
//! [`StaticGain`] is of an arm that is blocked: torques, or forces at a known arm, at a sequence of currents. [`MotorVoltage`] is of
//! a motor that turns while its voltage is logged, [`Commanded`] of one whose voltage nobody logged, but which was switched between
//! constants.
//!
//! # Examples
//! A square wave of 3 V, of which a log has `u = v - 1.5 w` and the velocity `w`:
//! ```
//! use robot_model::calibrate::Commanded;
//! let time: Vec<f64> = (0..200).map(|k| 0.02 * f64::from(k)).collect();
//! let velocity: Vec<f64> = time.iter().map(|t| (5.0 * t).sin()).collect();
//! let wave = |t: f64| if (t - 0.5).rem_euclid(2.0) < 1.0 { 3.0 } else { -3.0 };
//! let drop: Vec<f64> = time.iter().zip(&velocity).map(|(&t, w)| wave(t) - 1.5 * w).collect();
//! let found = Commanded::find(&time, &drop, &velocity)?;
//! assert!((found.back_emf.value - 1.5).abs() < 1e-9);
//! assert_eq!(found.pieces.len(), 5);
//! # Ok::<(), robot_model::calibrate::CalibrateError>(())
//! ```

mod branches;
mod commanded;
mod error;
mod inductance;
mod pieces;
mod regression;
mod static_gain;
mod statistics;
mod voltage;
mod windows;

pub use commanded::{Commanded, Piece};
pub use error::CalibrateError;
pub use inductance::with_inductance;
pub(crate) use regression::{NORMAL, quantile};
pub use static_gain::{Hysteresis, StaticGain, Term};
pub use voltage::MotorVoltage;
pub use windows::{REACH, Windows};

/// The probability with which intervals hold their values.
const CONFIDENCE: f64 = 0.95;

/// A value with its standard deviation and the interval that holds it with 95 % (Student's t).
///
/// # Examples
/// ```
/// use robot_model::calibrate::Commanded;
/// # let time: Vec<f64> = (0..200).map(|k| 0.02 * f64::from(k)).collect();
/// # let velocity: Vec<f64> = time.iter().map(|t| (5.0 * t).sin()).collect();
/// # let wave = |t: f64| if (t - 0.5).rem_euclid(2.0) < 1.0 { 3.0 } else { -3.0 };
/// # let noise = |k: usize| 0.05 * (12.9898 * k as f64).sin();
/// let drop: Vec<f64> = (0..200).map(|k| wave(time[k]) - 1.5 * velocity[k] + noise(k)).collect();
/// let found = Commanded::find(&time, &drop, &velocity)?.back_emf;
/// let [low, high] = found.interval;
/// assert!(low < 1.5 && 1.5 < high && high - low < 0.1);
/// # Ok::<(), robot_model::calibrate::CalibrateError>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Measured {
    /// The value, in the unit of its kind.
    pub value: f64,
    /// One standard deviation, same unit.
    pub std: f64,
    /// Both ends, same unit.
    pub interval: [f64; 2],
}

impl Measured {
    fn new(value: f64, std: f64, freedom: f64) -> Self {
        let reach = quantile(freedom) * std;
        Self {
            value,
            std,
            interval: [value - reach, value + reach],
        }
    }
}

/// Refuses channels that are not alike in length, or hold what is no number.
fn check(channels: &[&[f64]], least: usize) -> Result<(), CalibrateError> {
    let samples = channels.first().map_or(0, |channel| channel.len());
    if channels.iter().any(|channel| channel.len() != samples) {
        return Err(CalibrateError::Lengths);
    }
    let bad = |channel: &&[f64]| channel.iter().position(|x| !x.is_finite());
    if let Some(sample) = channels.iter().find_map(bad) {
        return Err(CalibrateError::NotFinite { sample });
    }
    if samples < least {
        return Err(CalibrateError::TooFew { samples, least });
    }
    Ok(())
}

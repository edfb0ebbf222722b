//! The voltage of a winding's inductance.
//!
//! `L di/dt` is `R tau di/dt` with the electric time constant `tau = L / R`, so an equation with `R i` holds with `R (i + tau di/dt)` in its
//! place. A motor alone on its axis answers to each voltage by one exponential, of which current, velocity and `di/dt` all are: no log
//! tells `tau` there, and what it is worth has to be known.

use super::{CalibrateError, check, windows};

/// A current, A, or the voltage across a known resistance, with the part of it that an inductance stands for: `i + time_constant di/dt`,
/// `time_constant` in s.
///
/// # Errors
/// [`CalibrateError`] for channels of different lengths, values of these that are not finite, fewer than three samples, time that does not rise or has a
/// gap.
///
/// # Examples
/// ```
/// use robot_model::calibrate::with_inductance;
/// let time: Vec<f64> = (0..500).map(|k| 1e-3 * f64::from(k)).collect();
/// let current: Vec<f64> = time.iter().map(|t| (20.0 * t).sin()).collect();
/// // 2 mH and 4 ohm: half a millisecond.
/// let whole = with_inductance(&time, &current, 5e-4)?;
/// let voltage = |t: f64| (20.0 * t).sin() + 0.01 * (20.0 * t).cos();
/// assert!((whole[200] - voltage(0.2)).abs() < 1e-5);
/// # Ok::<(), robot_model::calibrate::CalibrateError>(())
/// ```
pub fn with_inductance(
    time: &[f64],
    current: &[f64],
    time_constant: f64,
) -> Result<Vec<f64>, CalibrateError> {
    check(&[time, current], 3)?;
    windows::check_time(time)?;
    let pairs = current.iter().zip(slopes(time, current));
    Ok(pairs.map(|(i, slope)| i + time_constant * slope).collect())
}

/// A difference that is so many times the other one beside its sample, and the middle one, is a switch.
const SWITCH: f64 = 10.0;

/// Differences of the samples beside each one, over their time; at the ends, and beside a switch, where the slope is another on either side, that of
/// the quiet side alone.
pub(super) fn slopes(time: &[f64], values: &[f64]) -> Vec<f64> {
    let ahead: Vec<f64> = (1..time.len())
        .map(|k| (values[k] - values[k - 1]) / (time[k] - time[k - 1]))
        .collect();
    let mut sizes: Vec<f64> = ahead.iter().map(|slope| slope.abs()).collect();
    sizes.sort_unstable_by(f64::total_cmp);
    let middle = sizes.get(sizes.len() / 2).copied().unwrap_or_default();
    let slope = |k: usize| match (k.checked_sub(1).map(|k| ahead[k]), ahead.get(k)) {
        (Some(before), Some(&behind)) => {
            let [small, large] = if before.abs() < behind.abs() {
                [before, behind]
            } else {
                [behind, before]
            };
            if large.abs() > SWITCH * middle.max(small.abs()) {
                small
            } else {
                (values[k + 1] - values[k - 1]) / (time[k + 1] - time[k - 1])
            }
        }
        (one, other) => one.or(other.copied()).unwrap_or_default(),
    };
    (0..time.len()).map(slope).collect()
}

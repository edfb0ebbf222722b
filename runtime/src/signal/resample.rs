//! From one time grid to another.

/// `count` time stamps from `start` in steps of `step`.
///
/// # Examples
/// ```
/// assert_eq!(robot_model::signal::resample::grid(1.0, 0.5, 3), [1.0, 1.5, 2.0]);
/// ```
#[must_use]
pub fn grid(start: f64, step: f64, count: usize) -> Vec<f64> {
    (0..count).map(|k| start + step * k as f64).collect()
}

/// Values at rising times `at` of the curve through `values` at rising times `time`.
///
/// Cubic Hermite interpolation; the slope at a sample is that of the parabola through it and its neighbors, so parabolas come
/// out exactly. Outside the samples the end pieces are continued.
///
/// # Panics
/// Where there are fewer than three samples, or not as many values.
///
/// # Examples
/// ```
/// use robot_model::signal::resample::cubic;
/// let at = cubic(&[0.0, 1.0, 2.5, 3.0], &[0.0, 1.0, 6.25, 9.0], &[0.5, 2.0]);
/// assert!((at[0] - 0.25).abs() < 1e-12 && (at[1] - 4.0).abs() < 1e-12);
/// ```
#[must_use]
pub fn cubic(time: &[f64], values: &[f64], at: &[f64]) -> Vec<f64> {
    assert!(
        time.len() >= 3 && values.len() == time.len(),
        "a curve needs three or more samples, each with a value"
    );
    let last = time.len() - 1;
    let secant = |k: usize| (values[k + 1] - values[k]) / (time[k + 1] - time[k]);
    let slope = |k: usize| {
        // The parabola is that of the nearest inner sample.
        let inner = k.clamp(1, last - 1);
        let (before, after) = (secant(inner - 1), secant(inner));
        let curvature = (after - before) / (time[inner + 1] - time[inner - 1]);
        before + curvature * (2.0 * time[k] - time[inner - 1] - time[inner])
    };
    let mut piece = 0;
    let interpolate = |&instant: &f64| {
        while piece + 1 < last && time[piece + 1] <= instant {
            piece += 1;
        }
        let length = time[piece + 1] - time[piece];
        let s = (instant - time[piece]) / length;
        let (left, right) = (slope(piece) * length, slope(piece + 1) * length);
        let rise = values[piece + 1] - values[piece];
        values[piece]
            + s * (left + s * (3.0 * rise - 2.0 * left - right + s * (left + right - 2.0 * rise)))
    };
    at.iter().map(interpolate).collect()
}

/// Every `stride`-th sample, from the first. The signal must have been filtered to below half the new rate.
///
/// # Examples
/// ```
/// assert_eq!(robot_model::signal::resample::every(&[0.0, 1.0, 2.0, 3.0, 4.0], 2), [0.0, 2.0, 4.0]);
/// ```
#[must_use]
pub fn every(signal: &[f64], stride: usize) -> Vec<f64> {
    signal.iter().copied().step_by(stride).collect()
}

/// The whole part of a count of samples; zero for what is negative or no number.
#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "the cast saturates, which is what is wanted"
)]
pub(crate) fn whole_steps(steps: f64) -> usize {
    steps as usize
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_sine_survives_jitter() {
        let time: Vec<f64> = (0..500)
            .map(|k| 0.01 * f64::from(k) + 0.002 * f64::from(k * k % 7) / 7.0)
            .collect();
        let values: Vec<f64> = time.iter().map(|t| (6.0 * t).sin()).collect();
        let at = grid(0.0, 0.01, 499);
        let worst = cubic(&time, &values, &at)
            .iter()
            .zip(&at)
            .map(|(v, t)| (v - (6.0 * t).sin()).abs())
            .fold(0.0, f64::max);
        assert!(worst < 5e-5, "{worst}");
    }

    #[test]
    fn samples_are_met() {
        let time = [0.0, 0.4, 1.0, 1.1, 3.0];
        let values = [2.0, -1.0, 0.5, 7.0, 3.0];
        for (found, expected) in cubic(&time, &values, &time).iter().zip(values) {
            assert!((found - expected).abs() < 1e-12);
        }
    }
}

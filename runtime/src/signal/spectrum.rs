//! Power of a signal by frequency.

use std::f64::consts::TAU;

/// Length of a segment of [`band_density`], s: resolves 0.25 Hz.
pub const SEGMENT_S: f64 = 4.0;

/// Mean power spectral density of a signal in frequency bands, units^2/Hz.
///
/// Welch's method: segments of 4 s (the whole signal where it is shorter) that overlap by half, each without its mean and
/// under a Hann window. `edges` are ascending frequencies in Hz below half the rate; band `k` is `edges[k] .. edges[k + 1]`.
///
/// # Examples
/// ```
/// use robot_model::signal::band_density;
/// let rate = 500.0;
/// let tone: Vec<f64> = (0..5000).map(|k| (std::f64::consts::TAU * 7.0 * f64::from(k) / rate).sin()).collect();
/// let density = band_density(&tone, rate, &[2.0, 5.0, 9.0, 20.0]);
/// assert!((density[1] * 4.0 - 0.5).abs() < 1e-3); // a sine of amplitude 1 has power 1/2, here within 4 Hz
/// assert!(density[0] < 1e-6 && density[2] < 1e-6);
/// ```
#[must_use]
pub fn band_density(signal: &[f64], rate_hz: f64, edges: &[f64]) -> Vec<f64> {
    let length = crate::signal::resample::whole_steps(SEGMENT_S * rate_hz).min(signal.len());
    let bands = edges.len().saturating_sub(1);
    let mut density = vec![0.0; bands];
    if length < 8 {
        return density;
    }
    let window: Vec<f64> = (0..length)
        .map(|k| 0.5 - 0.5 * (TAU * k as f64 / length as f64).cos())
        .collect();
    let norm = 2.0 / (rate_hz * window.iter().map(|w| w * w).sum::<f64>());
    let starts: Vec<usize> = (0..=signal.len() - length)
        .step_by((length / 2).max(1))
        .collect();
    let resolution = rate_hz / length as f64;
    for (band, density) in density.iter_mut().enumerate() {
        let first = crate::signal::resample::whole_steps((edges[band] / resolution).ceil());
        let last = crate::signal::resample::whole_steps((edges[band + 1] / resolution).ceil())
            .max(first + 1);
        let mut sum = 0.0;
        for &start in &starts {
            let segment = &signal[start..start + length];
            let mean = segment.iter().sum::<f64>() / length as f64;
            sum += (first..last)
                .map(|bin| power(segment, mean, &window, TAU * bin as f64 / length as f64))
                .sum::<f64>();
        }
        *density = norm * sum / (starts.len() * (last - first)) as f64;
    }
    density
}

/// Squared magnitude of the windowed segment's Fourier sum at `angle` rad per sample.
fn power(segment: &[f64], mean: f64, window: &[f64], angle: f64) -> f64 {
    let (step_sin, step_cos) = angle.sin_cos();
    let (mut sin, mut cos) = (0.0_f64, 1.0_f64);
    let (mut re, mut im) = (0.0, 0.0);
    for (x, w) in segment.iter().zip(window) {
        let value = w * (x - mean);
        re += value * cos;
        im -= value * sin;
        (sin, cos) = (
            sin * step_cos + cos * step_sin,
            cos * step_cos - sin * step_sin,
        );
    }
    re * re + im * im
}

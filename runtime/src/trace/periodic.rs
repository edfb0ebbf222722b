//! What comes back in every period of a motion, beside what noise leaves in a mean over periods.

use statrs::distribution::{ContinuousCDF, FisherSnedecor};

use crate::identify::{Autoregression, correlation_time};
use crate::signal::resample::whole_steps;

/// The mean over periods is structured where its power is this many times what noise leaves in a mean, and more than chance makes of
/// as many independent samples.
const LEAST_PERIODIC_RATIO: f64 = 2.0;
const CHANCE: f64 = 1e-3;

/// The least share of a period that has to come again for two to be compared in it.
const AGAIN: f64 = 0.3;

/// How many periods of a length there are, and how many samples of each; of less than two those that come again. `None` where these are
/// too few.
pub(super) fn laps(samples: usize, length: f64) -> Option<(usize, usize)> {
    let periods = whole_steps(samples as f64 / length.max(1.0));
    let (periods, bins) = match periods {
        0 | 1 => (2, samples.saturating_sub(whole_steps(length.ceil()))),
        _ => (periods, whole_steps(length)),
    };
    (bins as f64 >= f64::max(2.0, AGAIN * length)).then_some((periods, bins))
}

/// Power of what comes back in every period, less what noise leaves in a mean; 0 where that is not clearly more.
///
/// `values` are filtered by the shared low-pass: above it, model and motion differ by the filters of the motion alone, and
/// that difference repeats as well.
pub(super) fn repeated_power(values: &[f64], length: f64) -> f64 {
    let Some((periods, bins)) = laps(values.len(), length) else {
        return 0.0;
    };
    let at = |p: usize, k: usize| {
        values[whole_steps((p as f64 * length).round() + k as f64).min(values.len() - 1)]
    };
    // A slow wander of the zero is no structure: every period is compared about its own mean.
    let means: Vec<f64> = (0..periods)
        .map(|p| (0..bins).map(|k| at(p, k)).sum::<f64>() / bins as f64)
        .collect();
    let mean = |k: usize| (0..periods).map(|p| at(p, k) - means[p]).sum::<f64>() / periods as f64;
    let repeating: Vec<f64> = (0..bins).map(mean).collect();
    let of_period = |p: usize| {
        repeating
            .iter()
            .enumerate()
            .map(move |(k, mean)| (p, k, mean))
    };
    let rest: Vec<f64> = (0..periods)
        .flat_map(of_period)
        .map(|(p, k, mean)| at(p, k) - means[p] - mean)
        .collect();
    let squares = |values: &[f64]| values.iter().map(|v| v * v).sum::<f64>();
    let repeated = squares(&repeating);
    let noise = squares(&rest) / ((periods - 1) * periods) as f64;
    if repeated > LEAST_PERIODIC_RATIO * noise && comes_back(&repeating, &rest, periods) {
        (repeated - noise) / bins as f64
    } else {
        0.0
    }
}

/// Whether the mean of so many periods is more than chance makes of what changes from one to the next. Slow noise has few independent
/// samples in a period, and structure that is small beside it shows once both are made as white as that noise can be.
fn comes_back(repeating: &[f64], rest: &[f64], periods: usize) -> bool {
    let is_more = |repeating: &[f64], rest: &[f64], independent: f64| {
        let power =
            |values: &[f64]| values.iter().map(|v| v * v).sum::<f64>() / values.len() as f64;
        let noise = power(rest) / (periods - 1) as f64;
        let ratio = power(repeating) / noise.max(f64::MIN_POSITIVE);
        let distribution = FisherSnedecor::new(independent, independent * (periods - 1) as f64);
        distribution.is_ok_and(|distribution| distribution.sf(ratio) < CHANCE)
    };
    let independent = repeating.len() as f64 / correlation_time(rest);
    let noise = Autoregression::through(rest);
    let (white, noise) = (noise.whitened(repeating), noise.whitened(rest));
    is_more(repeating, rest, independent) || is_more(&white, &noise, white.len() as f64)
}

#[cfg(test)]
mod tests {
    use std::f64::consts::TAU;

    use super::repeated_power;

    /// Slow noise: every value is that before it, but for a little.
    fn slow(samples: usize, seed: f64) -> Vec<f64> {
        let mut value = 0.0;
        let next = |k: usize| {
            let random = (12.9898 * (k as f64 + seed)).sin() * 43_758.545_3;
            value = 0.98 * value + random.rem_euclid(1.0) - 0.5;
            value
        };
        (0..samples).map(next).collect()
    }

    /// Whether the mean of two periods has twice the power that their difference leaves in it.
    fn is_twice(values: &[f64], bins: usize) -> bool {
        let mean = |part: &[f64]| part.iter().sum::<f64>() / bins as f64;
        let (one, other) = values.split_at(bins);
        let (a, b) = (mean(one), mean(other));
        let pairs = || one.iter().zip(other).map(|(x, y)| (x - a, y - b));
        let sum = pairs().map(|(x, y)| (x + y).powi(2)).sum::<f64>();
        sum > 2.0 * pairs().map(|(x, y)| (x - y).powi(2)).sum::<f64>()
    }

    #[test]
    fn slow_noise_that_looks_alike_in_two_periods_is_no_structure() {
        let found =
            (0..200).filter(|seed| repeated_power(&slow(800, 1e4 * f64::from(*seed)), 400.0) > 0.0);
        let found = found.count();
        // Of twice the noise's power, without a look at how much is independent, there is more than one in ten.
        let by_power = (0..200).filter(|seed| is_twice(&slow(800, 1e4 * f64::from(*seed)), 400));
        assert!(by_power.count() > 20);
        assert!(found <= 8, "{found} of 200");
    }

    #[test]
    fn what_comes_back_in_two_periods_is_structure() {
        let mut values = slow(800, 1.0);
        for (k, value) in values.iter_mut().enumerate() {
            *value += 6.0 * (TAU * k as f64 / 80.0).sin();
        }
        let power = repeated_power(&values, 400.0);
        assert!((power - 18.0).abs() < 4.0, "{power}");
        // Of a log whose ends the filter takes less than two are left, of which the half may come again, or too little.
        let power = repeated_power(&values[..600], 400.0);
        assert!((power - 18.0).abs() < 6.0, "{power}");
        assert!(repeated_power(&values[..500], 400.0) < 1e-9);
    }
}

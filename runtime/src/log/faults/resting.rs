//! Positions that are noise of a joint that stands.
//!
//! Noise that is white has, in means over some samples, a variance that is so many times less. Motion has not. What the noise is, third differences
//! say, to which motion adds next to nothing.

use super::has_few_levels;
use crate::signal::resample::whole_steps;

/// Means are over so long, s: filters of identification see what is slower than that.
const MEANS_S: f64 = 0.05;

/// So many of them say what their variance is.
const FEWEST: usize = 20;

/// Times the variance of means of noise from where on something moves.
const BEYOND: f64 = 2.0;

/// A position of no more values than these is two steps of its encoder at most, and says no more of how it moved.
const LEVELS: usize = 3;

/// What a position is where the joint stands.
pub(super) struct Noise {
    pub mean: f64,
    /// Root mean square of the rest.
    pub rms: f64,
}

/// The noise that a position is, unless it moves or stands exactly.
pub(super) fn noise(q: &[f64], rate_hz: f64) -> Option<Noise> {
    let length = whole_steps((MEANS_S * rate_hz).round()).max(1);
    if q.len() < FEWEST * length.max(4) {
        return None;
    }
    let whole = Noise::of(q);
    let means: Vec<f64> = q
        .chunks_exact(length)
        .map(|part| Noise::of(part).mean)
        .collect();
    let thirds = q
        .windows(4)
        .map(|q| (q[3] - 3.0 * q[2] + 3.0 * q[1] - q[0]).powi(2) / 20.0);
    let white = thirds.sum::<f64>() / (q.len() - 3) as f64 / length as f64;
    let is_noise = Noise::of(&means).rms.powi(2) < BEYOND * white;
    let stands = q.iter().all(|value| (value - q[0]).abs() == 0.0);
    (!stands && (is_noise || has_few_levels(q, LEVELS))).then_some(whole)
}

impl Noise {
    fn of(values: &[f64]) -> Self {
        let count = values.len() as f64;
        let mean = values.iter().sum::<f64>() / count;
        let squares = values.iter().map(|value| (value - mean).powi(2));
        Self {
            mean,
            rms: (squares.sum::<f64>() / count).sqrt(),
        }
    }
}

#[cfg(test)]
mod tests {
    use rand::SeedableRng;
    use rand_chacha::ChaCha8Rng;
    use rand_distr::{Distribution, StandardNormal};

    use super::*;

    fn with_noise(swing: f64, deviation: f64, seed: u64) -> Vec<f64> {
        let mut random = ChaCha8Rng::seed_from_u64(seed);
        let mut white = || -> f64 { StandardNormal.sample(&mut random) };
        (0..5000)
            .map(|k| 0.3 + swing * (0.004 * f64::from(k)).sin() + deviation * white())
            .collect()
    }

    #[test]
    fn noise_about_a_mean_is_told_whatever_its_size() {
        for (seed, deviation) in (0..).zip([1e-6, 1e-4, 1e-2]) {
            let found = noise(&with_noise(0.0, deviation, seed), 500.0).expect("at rest");
            assert!((found.mean - 0.3).abs() < 0.1 * deviation);
            assert!((found.rms / deviation - 1.0).abs() < 0.05);
        }
    }

    /// Means over 25 samples have a fifth of the noise: a swing that is half of a sample's noise stands out of them.
    #[test]
    fn a_motion_within_the_noise_of_one_sample_is_one() {
        for seed in 0..20 {
            assert!(noise(&with_noise(5e-5, 1e-4, seed), 500.0).is_none());
            assert!(noise(&with_noise(1e-5, 1e-4, seed), 500.0).is_some());
        }
    }

    #[test]
    fn two_steps_of_an_encoder_are_no_motion_and_three_are() {
        let stepped = |swing: f64| -> Vec<f64> {
            (0..5000)
                .map(|k| (swing * (0.004 * f64::from(k)).sin()).round() * 1e-3)
                .collect()
        };
        assert!(noise(&stepped(1.4), 500.0).is_some());
        assert!(noise(&stepped(1.6), 500.0).is_none());
    }

    #[test]
    fn what_stands_exactly_or_is_short_is_none() {
        assert!(noise(&vec![0.3; 5000], 500.0).is_none());
        assert!(noise(&with_noise(0.0, 1e-4, 1)[..300], 500.0).is_none());
    }
}

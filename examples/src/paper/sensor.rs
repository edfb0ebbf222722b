//! What simulated sensors add: noise, and the steps of a converter.

use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, StandardNormal};

/// A normal number with a standard deviation of one.
pub fn normal(random: &mut ChaCha8Rng) -> f64 {
    StandardNormal.sample(random)
}

/// The nearest multiple of a step.
#[must_use]
pub fn rounded(value: f64, step: f64) -> f64 {
    (value / step).round() * step
}

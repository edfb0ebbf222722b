//! Positions that jump and stay: an encoder that slipped, was set anew, or begins its turn again.

use super::Steps;

/// Samples before and behind whose steps say how fast the joint is, and by how many times the largest of them a slip is larger.
const NEAR: usize = 6;
const BEYOND: f64 = 5.0;

/// How many times a slip is what nine of ten steps are below, and what the sensor resolves.
const FAR: f64 = 3.0;
const RESOLVED: f64 = 8.0;

/// Samples from which such a jump leads to the next. No arm moves for one sample alone by what is beyond its usual steps.
pub(super) fn find(values: &[f64]) -> Vec<usize> {
    let steps = Steps::of(values);
    let sizes = &steps.sizes;
    if steps.quantum == 0.0 {
        return Vec::new();
    }
    let far = (FAR * steps.usual).max(RESOLVED * steps.quantum);
    let inner = NEAR..sizes.len().saturating_sub(NEAR);
    let is_slip = |&k: &usize| {
        let around = sizes[k - NEAR..k].iter().chain(&sizes[k + 1..=k + NEAR]);
        let largest = around.copied().fold(0.0, f64::max);
        sizes[k] > far.max(BEYOND * largest)
    };
    inner.filter(is_slip).collect()
}

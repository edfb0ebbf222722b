//! Sums over channels.

/// Whether a channel is one number, to its rounding.
pub(super) fn stands(values: &[f64]) -> bool {
    let (low, high) = range(values);
    high - low <= 1e-12 * low.abs().max(high.abs())
}

/// Smallest and largest value.
pub(super) fn range(values: &[f64]) -> (f64, f64) {
    let start = (f64::INFINITY, f64::NEG_INFINITY);
    let wider = |(low, high): (f64, f64), x: &f64| (low.min(*x), high.max(*x));
    values.iter().fold(start, wider)
}

pub(super) fn mean(values: &[f64]) -> f64 {
    values.iter().sum::<f64>() / values.len() as f64
}

/// `sum (x - mean)^2`.
pub(super) fn scatter(values: &[f64]) -> f64 {
    let mean = mean(values);
    values.iter().map(|x| (x - mean).powi(2)).sum()
}

/// Pearson's correlation, 0 where one of both stands.
pub(super) fn correlation(one: &[f64], other: &[f64]) -> f64 {
    if stands(one) || stands(other) {
        return 0.0;
    }
    let (mean_one, mean_other) = (mean(one), mean(other));
    let pairs = one.iter().zip(other);
    let product: f64 = pairs.map(|(x, y)| (x - mean_one) * (y - mean_other)).sum();
    product / (scatter(one) * scatter(other)).sqrt()
}

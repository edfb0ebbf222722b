//! Standard deviations that know how residuals and columns are alike from sample to sample.
//!
//! With `A = sum_j W_j' W_j / sigma_j^2` an estimate's error is `A^-1 sum_k v_k`, where `v_k = sum_j x_jk r_jk / sigma_j^2` over the
//! joints' rows `x_jk` and residuals `r_jk` at sample `k`. Its variance is the long-run variance of each entry's series:
//! noise that is slow beside a column hurts it less than white noise, and noise like it more. Its autocovariances are summed under a window that is
//! flat on top, as far as they stand out.
//!
//! Source: Newey, West 1987, A simple positive semi-definite heteroskedasticity and autocorrelation consistent covariance matrix;
//! Politis 2003, Adaptive bandwidth choice.

use faer::Mat;
use faer::linalg::solvers::Solve;

use super::least_squares::Solution;
use super::stack::Stack;

/// Autocorrelations below this many times `sqrt(log10(n) / n)` are noise, and so many one after the other end the search.
const NOISE: f64 = 2.0;
const QUIET: usize = 5;

/// Lags reach over this part of a series, at most.
const MOST_LAGS: usize = 4;

/// Least variance of a sum, as a share of that of a white series with the same power.
const LEAST: f64 = 0.05;

/// Standard deviations of a solution, 0 where it has no value. `weights` are those of the rows' residuals, 1 each where all count
/// in full.
pub(super) fn deviations(stack: &Stack, solution: &Solution, weights: &[Vec<f64>]) -> Vec<f64> {
    let unknowns = stack.unknowns.len();
    let mut place = vec![None; unknowns];
    let excited = (0..unknowns).filter(|c| solution.unexcited.binary_search(c).is_err());
    let excited: Vec<usize> = excited.collect();
    for (k, &c) in excited.iter().enumerate() {
        place[c] = Some(k);
    }
    let (samples, count) = (stack.samples(), excited.len());
    let residuals = stack.residuals(&solution.estimate);
    let rows: Vec<Mat<f64>> = stack
        .joints
        .iter()
        .zip(&solution.sigma)
        .map(|(joint, sigma)| {
            let mut rows = Mat::zeros(samples, count);
            for (c, values) in &joint.columns {
                if let Some(k) = place[*c] {
                    for (row, value) in values.iter().enumerate() {
                        rows[(row, k)] = value / sigma;
                    }
                }
            }
            rows
        })
        .collect();
    let length: Vec<f64> = (0..count)
        .map(|k| {
            let squares = rows.iter().flat_map(|rows| rows.col(k).iter());
            squares.map(|x| x * x).sum::<f64>().sqrt()
        })
        .collect();
    let mut information = Mat::<f64>::zeros(count, count);
    for (rows, weights) in rows.iter().zip(weights) {
        // Where a residual is cut off, it does not answer to the estimate.
        let full = weights.iter().filter(|weight| **weight >= 1.0).count();
        let share = full as f64 / samples.max(1) as f64;
        information += faer::Scale(share) * (rows.transpose() * rows);
    }
    let scaled = Mat::from_fn(count, count, |i, k| {
        information[(i, k)] / (length[i] * length[k])
    });
    let inverse = scaled
        .partial_piv_lu()
        .solve(Mat::<f64>::identity(count, count));
    let mut series = Mat::<f64>::zeros(samples, count);
    for (j, rows) in rows.iter().enumerate() {
        let mut scores = rows.clone();
        for k in 0..samples {
            let residual = weights[j][k] * residuals[j][k] / solution.sigma[j];
            for c in 0..count {
                scores[(k, c)] *= residual / length[c];
            }
        }
        series += scores * &inverse;
    }
    // The unknowns have taken their share of the residuals.
    let freedom = (samples * stack.dof()) as f64;
    let correction = freedom / (freedom - count as f64).max(1.0);
    let mut std = vec![0.0; unknowns];
    for (k, &c) in excited.iter().enumerate() {
        let values: Vec<f64> = series.col(k).iter().copied().collect();
        std[c] = (correction * long_run_sum(&values)).max(0.0).sqrt() / length[k];
    }
    std
}

/// Variance of the sum of a series: its autocovariances, in full up to the lag from which on they are noise, then less and less.
fn long_run_sum(series: &[f64]) -> f64 {
    let n = series.len();
    let covariance = |lag: usize| -> f64 {
        let pairs = series.iter().zip(&series[lag..]);
        pairs.map(|(x, y)| x * y).sum()
    };
    let power = covariance(0);
    let most = n / MOST_LAGS;
    if power == 0.0 || most < 1 {
        return power;
    }
    let noise = NOISE * ((n as f64).log10() / n as f64).sqrt() * power;
    let mut covariances = vec![power];
    let mut quiet = 0;
    while quiet < QUIET && covariances.len() <= most {
        let next = covariance(covariances.len());
        quiet = if next.abs() < noise { quiet + 1 } else { 0 };
        covariances.push(next);
    }
    let last = (covariances.len() - 1 - quiet).max(1);
    let lags = (2 * last).min(most);
    let at = |lag: usize| {
        covariances
            .get(lag)
            .copied()
            .unwrap_or_else(|| covariance(lag))
    };
    let sum = |weight: &dyn Fn(f64) -> f64| -> f64 {
        let terms = (1..=lags).map(|lag| weight(lag as f64 / (lags + 1) as f64) * at(lag));
        power + 2.0 * terms.sum::<f64>()
    };
    let flat = sum(&|share| (2.0 - 2.0 * share).min(1.0));
    // What is flat on top may come out negative; Bartlett's weights do not.
    if flat > LEAST * power {
        flat
    } else {
        sum(&|share| 1.0 - share)
    }
}

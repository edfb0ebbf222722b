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

/// Columns that have a value in a solution: rows over their joint's scale, columns over their length.
pub(super) struct Rows {
    /// How many unknowns there are, and which have a value.
    unknowns: usize,
    pub excited: Vec<usize>,
    /// Lengths of the columns.
    pub length: Vec<f64>,
    /// `[joint]`, samples by excited columns.
    pub joints: Vec<Mat<f64>>,
}

impl Rows {
    /// Those of a stack; `unexcited` unknowns are left out.
    pub fn new(stack: &Stack, unexcited: &[usize], scale: &[f64]) -> Self {
        let unknowns = stack.unknowns.len();
        let mut place = vec![None; unknowns];
        let excited = (0..unknowns).filter(|c| unexcited.binary_search(c).is_err());
        let excited: Vec<usize> = excited.collect();
        for (k, &c) in excited.iter().enumerate() {
            place[c] = Some(k);
        }
        let (samples, count) = (stack.samples(), excited.len());
        let mut joints = vec![Mat::<f64>::zeros(samples, count); stack.dof()];
        let mut squares = vec![0.0; count];
        for ((rows, joint), scale) in joints.iter_mut().zip(&stack.joints).zip(scale) {
            for (c, values) in &joint.columns {
                if let Some(k) = place[*c] {
                    for (row, value) in values.iter().enumerate() {
                        rows[(row, k)] = value / scale;
                        squares[k] += rows[(row, k)].powi(2);
                    }
                }
            }
        }
        let length: Vec<f64> = squares.into_iter().map(f64::sqrt).collect();
        for rows in &mut joints {
            for (k, length) in length.iter().enumerate() {
                rows.col_mut(k).iter_mut().for_each(|x| *x /= length);
            }
        }
        Self {
            unknowns,
            excited,
            length,
            joints,
        }
    }

    /// `sum_j W_j' V_j` with other columns of the same samples.
    pub fn product(&self, other: &Self) -> Mat<f64> {
        let pairs = self.joints.iter().zip(&other.joints);
        let zero = Mat::zeros(self.excited.len(), other.excited.len());
        pairs.fold(zero, |sum, (one, other)| sum + one.transpose() * other)
    }

    /// What each sample moves the estimate by, in units of one over a column's length: `A^-1 sum_j w_jk r_jk` where the rows' own
    /// equations are `sum_jk w_jk r_jk = 0` and `A` is how these change with the estimate.
    pub fn influence(&self, residuals: &[Vec<f64>], bread: &Mat<f64>) -> Mat<f64> {
        let (samples, count) = self
            .joints
            .first()
            .map_or((0, 0), |rows| (rows.nrows(), rows.ncols()));
        let inverse = bread
            .transpose()
            .partial_piv_lu()
            .solve(Mat::<f64>::identity(count, count));
        let mut series = Mat::<f64>::zeros(samples, count);
        for (rows, residuals) in self.joints.iter().zip(residuals) {
            let mut scores = rows.clone();
            for c in 0..count {
                let scores = scores.col_mut(c).iter_mut();
                scores.zip(residuals).for_each(|(x, r)| *x *= r);
            }
            series += scores * &inverse;
        }
        series
    }

    /// Standard deviations of what such series add up to, one an unknown, 0 where it has no value.
    pub fn deviations(&self, series: &Mat<f64>) -> Vec<f64> {
        // The unknowns have taken their share of the residuals.
        let freedom = (series.nrows() * self.joints.len()) as f64;
        let correction = freedom / (freedom - series.ncols() as f64).max(1.0);
        let mut std = vec![0.0; self.unknowns];
        for (k, &c) in self.excited.iter().enumerate() {
            let values: Vec<f64> = series.col(k).iter().copied().collect();
            std[c] = (correction * long_run_sum(&values)).max(0.0).sqrt() / self.length[k];
        }
        std
    }
}

/// Residuals over their joint's scale, times the rows' weights.
pub(super) fn weighed(
    mut residuals: Vec<Vec<f64>>,
    scale: &[f64],
    weights: &[Vec<f64>],
) -> Vec<Vec<f64>> {
    for ((residuals, weights), scale) in residuals.iter_mut().zip(weights).zip(scale) {
        for (residual, weight) in residuals.iter_mut().zip(weights) {
            *residual *= weight / scale;
        }
    }
    residuals
}

/// Standard deviations of a least-squares solution, 0 where it has no value. `weights` are those of the rows' residuals, 1 each
/// where all count in full.
pub(super) fn deviations(stack: &Stack, solution: &Solution, weights: &[Vec<f64>]) -> Vec<f64> {
    let rows = Rows::new(stack, &solution.unexcited, &solution.scale);
    let samples = stack.samples().max(1);
    let count = rows.excited.len();
    let mut information = Mat::<f64>::zeros(count, count);
    for (rows, weights) in rows.joints.iter().zip(weights) {
        // Where a residual is cut off, it does not answer to the estimate.
        let full = weights.iter().filter(|weight| **weight >= 1.0).count();
        let share = full as f64 / samples as f64;
        information += faer::Scale(share) * (rows.transpose() * rows);
    }
    let residuals = stack.residuals(&solution.estimate);
    let residuals = weighed(residuals, &solution.scale, weights);
    rows.deviations(&rows.influence(&residuals, &information))
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

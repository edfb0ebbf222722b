//! Standard deviations that know how residuals and columns are alike from sample to sample.
//!
//! With `A = sum_j W_j' W_j / sigma_j^2` an estimate's error is `A^-1 sum_k v_k`, where `v_k = sum_j x_jk r_jk / sigma_j^2` over the
//! joints' rows `x_jk` and residuals `r_jk` at sample `k`. Its variance is the long-run variance of each entry's series:
//! noise that is slow beside a column hurts it less than white noise, and noise like it more. It is that of an autoregression through
//! the series, which follows slow noise over hundreds of samples and the noise of differences, that cancels from sample to sample, alike.
//!
//! A product of column and residual says little of how residuals are correlated: such a deviation is itself off by a quarter, and a
//! tenth too small. Where noise is the same all along, the residual of each joint says it better: with the autoregression
//! `phi(B) r = e` through it `sum_k w_k r_k` has the variance `sigma_e^2 sum_k u_k^2`, where `phi(B^-1) u = w`. Noise that comes and goes with
//! the motion shows in products alone, so the larger deviation of both counts.
//!
//! Sources: Newey, West 1987, A simple positive semi-definite heteroskedasticity and autocorrelation consistent covariance matrix; den
//! Haan, Levin 1997, A practitioner's guide to robust covariance matrix estimation, on autoregressions.

use faer::linalg::solvers::Solve;
use faer::{ColRef, Mat};

use super::autoregression::long_run_sum;
use super::least_squares::Solution;
use super::short::{Noise, shortfalls, variances};
use super::stack::Stack;

/// Columns that have a value in a solution: rows over their joint's scale, columns over their length.
#[derive(Clone)]
pub(super) struct Rows {
    /// How many unknowns there are, and which have a value.
    unknowns: usize,
    pub excited: Vec<usize>,
    /// Lengths of the columns.
    pub length: Vec<f64>,
    /// Rows of all joints that say something.
    count: usize,
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
            count: stack.counts().iter().sum(),
            joints,
        }
    }

    /// Takes a share of its length for the length of a column.
    pub fn shorten(&mut self, column: usize, share: f64) {
        self.length[column] *= share;
        for rows in &mut self.joints {
            rows.col_mut(column).iter_mut().for_each(|x| *x /= share);
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
        let inverse = inverse_of_transpose(bread);
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

    /// What residuals that are the same noise all along say of an estimate that has taken its share of the noise in `columns`.
    pub fn steady(&self, columns: &Self, residuals: &[Vec<f64>], bread: &Mat<f64>) -> Steady {
        let inverse = inverse_of_transpose(bread);
        // Rows that are left out have no residual, and no noise.
        let there = |residuals: &Vec<f64>| -> Vec<usize> {
            let rows = 0..residuals.len();
            rows.filter(|&k| residuals[k] != 0.0).collect()
        };
        let there: Vec<Vec<usize>> = residuals.iter().map(there).collect();
        let some = |series: ColRef<f64>, there: &[usize]| -> Vec<f64> {
            there.iter().map(|&k| series[k]).collect()
        };
        let joints = self.joints.iter().zip(residuals).zip(&there);
        let noise = joints.map(|((rows, residuals), there)| {
            let weights = rows * &inverse;
            let weights = weights.col_iter().map(|column| some(column, there));
            let residuals: Vec<f64> = there.iter().map(|&k| residuals[k]).collect();
            Noise::new(weights.collect(), &residuals)
        });
        let noise: Vec<Noise> = noise.collect();
        let count = self.excited.len();
        let rest = |drawn: &[Vec<f64>]| -> Vec<Vec<f64>> {
            let mut step = Mat::zeros(count, 1);
            for (noise, drawn) in noise.iter().zip(drawn) {
                noise.add_step(drawn, step.col_as_slice_mut(0));
            }
            let joints = columns.joints.iter().zip(&there).zip(drawn);
            let rest = joints.map(|((columns, there), drawn)| {
                let taken = columns * &step;
                let taken = some(taken.col(0), there);
                drawn
                    .iter()
                    .zip(taken)
                    .map(|(x, taken)| x - taken)
                    .collect()
            });
            rest.collect()
        };
        let variances = variances(&noise, count);
        Steady {
            shortfalls: shortfalls(&noise, &variances, columns.freedom(), rest),
            variances,
        }
    }

    /// Standard deviations of what series of [`Self::influence`] add up to, one an unknown, 0 where it has no value; those of steady noise
    /// where they are larger, and what both lack of short logs.
    pub fn deviations(&self, series: &Mat<f64>, steady: Option<&Steady>) -> Vec<f64> {
        let variance = |k| -> f64 {
            let values: Vec<f64> = series.col(k).iter().copied().collect();
            let products = long_run_sum(&values);
            steady.map_or(products, |steady| {
                steady.shortfalls[k] * products.max(steady.variances[k])
            })
        };
        let variances: Vec<f64> = (0..self.excited.len()).map(variance).collect();
        self.roots(&variances)
    }

    /// Rows over what is left of them beside the unknowns.
    fn freedom(&self) -> f64 {
        let rows = self.count as f64;
        rows / (rows - self.excited.len() as f64).max(1.0)
    }

    /// Square roots of variances of excited unknowns, one an unknown. The unknowns have taken their share of the residuals.
    fn roots(&self, variances: &[f64]) -> Vec<f64> {
        let correction = self.freedom();
        let mut std = vec![0.0; self.unknowns];
        for ((variance, length), &c) in variances.iter().zip(&self.length).zip(&self.excited) {
            std[c] = (correction * variance).max(0.0).sqrt() / length;
        }
        std
    }
}

/// What noise that is the same all along makes of an estimate, parameter by parameter, in the units of [`Rows::influence`].
pub(super) struct Steady {
    variances: Vec<f64>,
    /// By how much more all variances are than what is told of them.
    shortfalls: Vec<f64>,
}

fn inverse_of_transpose(bread: &Mat<f64>) -> Mat<f64> {
    let count = bread.nrows();
    bread
        .transpose()
        .partial_piv_lu()
        .solve(Mat::<f64>::identity(count, count))
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
    let (rows, information, residuals) = equations(stack, solution, weights);
    let steady = rows.steady(&rows, &residuals, &information);
    rows.deviations(&rows.influence(&residuals, &information), Some(&steady))
}

/// [`deviations`] of the products of columns and residuals alone.
pub(super) fn deviations_of_products(
    stack: &Stack,
    solution: &Solution,
    weights: &[Vec<f64>],
) -> Vec<f64> {
    let (rows, information, residuals) = equations(stack, solution, weights);
    rows.deviations(&rows.influence(&residuals, &information), None)
}

/// Rows, how their equations change with the estimate, and weighed residuals.
fn equations(
    stack: &Stack,
    solution: &Solution,
    weights: &[Vec<f64>],
) -> (Rows, Mat<f64>, Vec<Vec<f64>>) {
    let rows = Rows::new(stack, &solution.unexcited, &solution.scale);
    let count = rows.excited.len();
    let mut information = Mat::<f64>::zeros(count, count);
    for ((rows, weights), joint) in rows.joints.iter().zip(weights).zip(&stack.joints) {
        // Where a residual is cut off, it does not answer to the estimate.
        let full = |(row, weight): &(usize, &f64)| **weight >= 1.0 && joint.is_there(*row);
        let full = weights.iter().enumerate().filter(full).count();
        let share = full as f64 / joint.count().max(1) as f64;
        information += faer::Scale(share) * (rows.transpose() * rows);
    }
    let residuals = stack.residuals(&solution.estimate);
    let residuals = weighed(residuals, &solution.scale, weights);
    (rows, information, residuals)
}

/// Samples that count as one independent sample: `1 + 2 * (sum of autocorrelations up to the first that is not positive)`.
///
/// # Examples
/// ```
/// use robot_model::identify::correlation_time;
/// // Five samples of one sign, five of the other: autocorrelations are 0.6, 0.2, -0.2, ..
/// let residual: Vec<f64> = (0..1000).map(|k| if k / 5 % 2 == 0 { 1.0 } else { -1.0 }).collect();
/// assert!((correlation_time(&residual) - (1.0 + 2.0 * (0.6 + 0.2))).abs() < 0.01);
/// ```
#[must_use]
pub fn correlation_time(residual: &[f64]) -> f64 {
    let n = residual.len();
    let mean = residual.iter().sum::<f64>() / n.max(1) as f64;
    let power: f64 = residual.iter().map(|r| (r - mean).powi(2)).sum();
    if power == 0.0 {
        return 1.0;
    }
    let mut time = 1.0;
    for lag in 1..n / 4 {
        let product: f64 = residual
            .iter()
            .zip(&residual[lag..])
            .map(|(a, b)| (a - mean) * (b - mean))
            .sum();
        if product <= 0.0 {
            break;
        }
        time += 2.0 * product / power;
    }
    time
}

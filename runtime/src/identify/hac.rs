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

use faer::Mat;
use faer::linalg::solvers::Solve;

use super::least_squares::Solution;
use super::stack::Stack;
use crate::signal::resample::whole_steps;

/// Orders of an autoregression are up to this many times `log10(n)`, and up to one for so many samples.
const ORDERS: f64 = 10.0;
const SAMPLES_AN_ORDER: f64 = 8.0;

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

    /// Variances of what residuals that are the same noise all along make of an estimate, in the units of [`Self::influence`].
    pub fn steady_variances(&self, residuals: &[Vec<f64>], bread: &Mat<f64>) -> Vec<f64> {
        let inverse = inverse_of_transpose(bread);
        let mut variances = vec![0.0; self.excited.len()];
        for (rows, residuals) in self.joints.iter().zip(residuals) {
            // Rows that are left out have no residual.
            let there: Vec<f64> = residuals.iter().copied().filter(|r| *r != 0.0).collect();
            let noise = Autoregression::through(&there);
            let weights = rows * &inverse;
            for (k, variance) in variances.iter_mut().enumerate() {
                let weights: Vec<f64> = weights.col(k).iter().copied().collect();
                *variance += noise.variance_of_sum(&weights);
            }
        }
        variances
    }

    /// Standard deviations of what such series add up to, one an unknown, 0 where it has no value.
    pub fn deviations(&self, series: &Mat<f64>) -> Vec<f64> {
        let variance = |k| -> f64 {
            let values: Vec<f64> = series.col(k).iter().copied().collect();
            long_run_sum(&values)
        };
        let variances: Vec<f64> = (0..self.excited.len()).map(variance).collect();
        self.roots(&variances)
    }

    /// Square roots of variances of excited unknowns, one an unknown. The unknowns have taken their share of the residuals.
    pub fn roots(&self, variances: &[f64]) -> Vec<f64> {
        let freedom = self.count as f64;
        let correction = freedom / (freedom - variances.len() as f64).max(1.0);
        let mut std = vec![0.0; self.unknowns];
        for ((variance, length), &c) in variances.iter().zip(&self.length).zip(&self.excited) {
            std[c] = (correction * variance).max(0.0).sqrt() / length;
        }
        std
    }
}

fn inverse_of_transpose(bread: &Mat<f64>) -> Mat<f64> {
    let count = bread.nrows();
    bread
        .transpose()
        .partial_piv_lu()
        .solve(Mat::<f64>::identity(count, count))
}

/// The larger deviation of two, one by one.
pub(super) fn larger(mut one: Vec<f64>, other: &[f64]) -> Vec<f64> {
    let pairs = one.iter_mut().zip(other);
    pairs.for_each(|(one, other)| *one = one.max(*other));
    one
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
    larger(
        rows.deviations(&rows.influence(&residuals, &information)),
        &rows.roots(&rows.steady_variances(&residuals, &information)),
    )
}

/// [`deviations`] of the products of columns and residuals alone.
pub(super) fn deviations_of_products(
    stack: &Stack,
    solution: &Solution,
    weights: &[Vec<f64>],
) -> Vec<f64> {
    let (rows, information, residuals) = equations(stack, solution, weights);
    rows.deviations(&rows.influence(&residuals, &information))
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

/// Variance of the sum of a series, `n` times its spectral density at frequency zero: that of the autoregression which fits it best,
/// `sigma_e^2 / (1 - sum phi)^2`.
pub(crate) fn long_run_sum(series: &[f64]) -> f64 {
    let fitted = Autoregression::through(series);
    let gain = fitted.filter.iter().sum::<f64>();
    series.len() as f64 * fitted.error / (gain * gain)
}

/// `x_k - phi_1 x_(k-1) - .. = e_k`.
struct Autoregression {
    /// `1, -phi_1, ..`
    filter: Vec<f64>,
    /// Mean square of `e`.
    error: f64,
}

impl Autoregression {
    /// The one that fits a series best, by Burg's recursion with the order of least AIC.
    fn through(series: &[f64]) -> Self {
        let n = series.len() as f64;
        let mut error = series.iter().map(|x| x * x).sum::<f64>() / n.max(1.0);
        let mut filter = vec![1.0];
        let mut best = Self {
            filter: filter.clone(),
            error,
        };
        if error == 0.0 {
            return best;
        }
        let orders = (ORDERS * n.log10()).min(n / SAMPLES_AN_ORDER);
        // Prediction errors forward and backward.
        let (mut forward, mut backward) = (series.to_vec(), series.to_vec());
        let mut least = n * error.ln();
        for order in 1..=whole_steps(orders) {
            let pairs = forward[order..].iter().zip(&backward[order - 1..]);
            let (product, power) = pairs.fold((0.0, 0.0), |(product, power), (f, b)| {
                (product + f * b, power + f * f + b * b)
            });
            if power == 0.0 {
                break;
            }
            let reflection = -2.0 * product / power;
            for k in (order..series.len()).rev() {
                let (f, b) = (forward[k], backward[k - 1]);
                forward[k] = f + reflection * b;
                backward[k] = b + reflection * f;
            }
            filter.push(0.0);
            let reversed: Vec<f64> = filter.iter().rev().copied().collect();
            for (x, y) in filter.iter_mut().zip(reversed) {
                *x += reflection * y;
            }
            error *= 1.0 - reflection * reflection;
            if error <= 0.0 {
                break;
            }
            let criterion = n * error.ln() + 2.0 * order as f64;
            if criterion < least {
                least = criterion;
                best = Self {
                    filter: filter.clone(),
                    error,
                };
            }
        }
        best
    }

    /// Variance of `sum_k w_k x_k`.
    fn variance_of_sum(&self, weights: &[f64]) -> f64 {
        let mut carried = weights.to_vec();
        for k in (0..carried.len()).rev() {
            let later = carried[k + 1..].iter();
            let fed: f64 = later.zip(&self.filter[1..]).map(|(u, a)| u * a).sum();
            carried[k] -= fed;
        }
        self.error * carried.iter().map(|u| u * u).sum::<f64>()
    }
}

#[cfg(test)]
mod tests {
    use rand::SeedableRng;
    use rand_chacha::ChaCha8Rng;
    use rand_distr::{Distribution, StandardNormal};

    use super::*;

    /// Mean of what is told over what is so, deviations of sums of a filtered white series.
    fn told(filter: &dyn Fn(&[f64]) -> Vec<f64>) -> f64 {
        const DRAWS: u32 = 200;
        let (mut told, mut so) = (0.0, 0.0);
        for seed in 0..DRAWS {
            let mut random = ChaCha8Rng::seed_from_u64(u64::from(seed));
            let white: Vec<f64> = (0..3000)
                .map(|_| StandardNormal.sample(&mut random))
                .collect();
            let series = filter(&white);
            told += long_run_sum(&series);
            so += series.iter().sum::<f64>().powi(2);
        }
        (told / so).sqrt()
    }

    #[test]
    fn white_and_slow_series_add_up_to_what_is_told() {
        let white = told(&<[f64]>::to_vec);
        assert!((white - 1.0).abs() < 0.12, "{white}");
        for share in [0.5, 0.9, 0.97] {
            let slow = told(&|white| {
                let mut state = 0.0;
                let next = |x: &f64| {
                    state = share * state + x;
                    state
                };
                white.iter().map(next).collect()
            });
            assert!((slow - 1.0).abs() < 0.15, "{share}: {slow}");
        }
        let wave = told(&|white| {
            let slow = white.windows(5).map(|near| near.iter().sum::<f64>());
            slow.enumerate()
                .map(|(k, x)| x * (0.3 * k as f64).sin())
                .collect()
        });
        assert!((wave - 1.0).abs() < 0.15, "{wave}");
    }

    /// Weights that swing against slow noise: their sum varies as the autoregression through the noise says.
    #[test]
    fn weighed_sums_of_noise_vary_as_it_says() {
        const DRAWS: u32 = 200;
        const SHARE: f64 = 0.9;
        let weights: Vec<f64> = (0..800).map(|k| (0.4 * f64::from(k)).sin()).collect();
        let (mut told, mut so, mut products) = (Vec::new(), 0.0, Vec::new());
        for seed in 0..DRAWS {
            let mut random = ChaCha8Rng::seed_from_u64(u64::from(seed));
            let mut state = 0.0;
            let noise: Vec<f64> = (0..1000)
                .map(|_| {
                    let white: f64 = StandardNormal.sample(&mut random);
                    state = SHARE * state + white;
                    state
                })
                .skip(200)
                .collect();
            let series: Vec<f64> = noise.iter().zip(&weights).map(|(x, w)| x * w).collect();
            so += series.iter().sum::<f64>().powi(2) / f64::from(DRAWS);
            told.push(Autoregression::through(&noise).variance_of_sum(&weights));
            products.push(long_run_sum(&series));
        }
        let mean = |values: &[f64]| values.iter().sum::<f64>() / values.len() as f64;
        let scatter = |values: &[f64]| {
            let center = mean(values);
            let squares: Vec<f64> = values.iter().map(|x| (x / center - 1.0).powi(2)).collect();
            mean(&squares).sqrt()
        };
        let ratio = (mean(&told) / so).sqrt();
        assert!((ratio - 1.0).abs() < 0.1, "{ratio}");
        // That is what it is for.
        let (steady, of_products) = (scatter(&told), scatter(&products));
        assert!(steady < 0.5 * of_products, "{steady} {of_products}");
    }

    /// Noise of a position in a velocity and an acceleration: sums of it cancel but for the ends.
    #[test]
    fn differences_cancel() {
        let white = |seed: u64| -> Vec<f64> {
            let mut random = ChaCha8Rng::seed_from_u64(seed);
            (0..3000)
                .map(|_| StandardNormal.sample(&mut random))
                .collect()
        };
        for seed in 0..20 {
            let first: Vec<f64> = white(seed).windows(2).map(|x| x[1] - x[0]).collect();
            let second: Vec<f64> = first.windows(2).map(|x| x[1] - x[0]).collect();
            for series in [first, second] {
                let power: f64 = series.iter().map(|x| x * x).sum();
                let told = (long_run_sum(&series) / power).sqrt();
                assert!(told < 0.12, "{told}");
            }
        }
    }
}

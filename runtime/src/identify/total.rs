//! Total least squares: columns with errors.
//!
//! With `A` the columns and `b` the torque, rows over their joint's deviation and each column, `b` too, over its length, the estimate
//! is `x = -v_a / v_b` of the right singular vector `v` of `[A b]` with the least singular value `s`:
//! `(A'A - s^2 1) x = A'b`. It is consistent where all entries have errors of one variance, which is here a share of each column's
//! length. Least squares is biased towards zero there. Source: Golub, Van Loan 1980, An analysis of the total least squares problem.

use faer::Mat;

use super::hac::{Rows, weighed};
use super::least_squares::{Factors, Solution};
use super::stack::Stack;
use super::{IdentifyError, Weights, robust};

/// `s^2` as a share of the least squared singular value of the columns alone: beyond this the errors that are taken for granted hide how
/// columns differ.
const MOST_SHARE: f64 = 0.25;

/// A total least squares estimate in units of the columns' lengths.
struct Total {
    /// `x`, one an excited unknown.
    scaled: Vec<f64>,
    /// `s^2`
    least: f64,
    /// Length of `b`.
    target: f64,
}

/// Puts the total estimate in the place of a least-squares solution, with its deviations.
pub(super) fn make(
    solution: &mut Solution,
    stack: &Stack,
    weights: Weights,
) -> Result<(), IdentifyError> {
    let factors = Factors::new(stack);
    let rounds = weights.rounds();
    for round in 1..=rounds {
        let rows = Rows::new(stack, &solution.unexcited, &solution.scale);
        let total = Total::new(&factors, &rows, &solution.scale)?;
        for (k, &c) in rows.excited.iter().enumerate() {
            solution.estimate[c] = total.scaled[k] * total.target / rows.length[k];
        }
        solution.sigma = factors.sigma(&solution.estimate, total.scaled.len());
        if round == rounds {
            solution.std = total.deviations(rows, stack, solution);
        }
        if weights == Weights::Residual {
            solution.scale.clone_from(&solution.sigma);
        }
    }
    Ok(())
}

impl Total {
    fn new(factors: &Factors, rows: &Rows, scale: &[f64]) -> Result<Self, IdentifyError> {
        let r = factors.stacked(scale);
        let last = r.ncols() - 1;
        let target = r.col(last).norm_l2();
        if target == 0.0 {
            return Err(IdentifyError::NoTotal);
        }
        let count = rows.excited.len();
        let all = Mat::from_fn(r.nrows(), count + 1, |row, k| {
            if k < count {
                r[(row, rows.excited[k])] / rows.length[k]
            } else {
                r[(row, last)] / target
            }
        });
        let found = all.thin_svd().map_err(|_| IdentifyError::NoTotal)?;
        let least = found.S().column_vector()[count].powi(2);
        let alone = all
            .get(.., ..count)
            .singular_values()
            .map_err(|_| IdentifyError::NoTotal)?;
        let alone = alone.last().map_or(0.0, |least| least.powi(2));
        let v = found.V().col(count);
        if least > MOST_SHARE * alone {
            return Err(IdentifyError::TotalApart);
        }
        if v[count] == 0.0 {
            return Err(IdentifyError::NoTotal);
        }
        Ok(Self {
            scaled: (0..count).map(|k| -v[k] / v[count]).collect(),
            least,
            target,
        })
    }

    /// The estimate is where `A'r + s^2 x = 0`, with `s^2 = sum r^2 / (1 + x'x)`, in units of lengths that are themselves of the samples:
    /// with each sample's share `d = b^2 + sum_c (x_c a_c)^2` of `1 + x'x` it adds `a r + s^2 x a^2 + x (r^2 - s^2 d) / (1 + x'x)`.
    fn deviations(&self, mut rows: Rows, stack: &Stack, solution: &Solution) -> Vec<f64> {
        let mut bread = rows.product(&rows);
        for k in 0..self.scaled.len() {
            bread[(k, k)] -= self.least;
        }
        let ones = robust::of_all(stack);
        let unit: Vec<f64> = solution
            .scale
            .iter()
            .map(|scale| scale * self.target)
            .collect();
        let rest = stack.residuals(&solution.estimate);
        let residuals = weighed(rest.clone(), &unit, &ones);
        let size = 1.0 + self.scaled.iter().map(|x| x * x).sum::<f64>();
        let steady = self.corrected(&rows, &residuals, size);
        let steady = steady.steady(&rows, &weighed(rest, &solution.scale, &ones), &bread);
        let targets = stack.joints.iter().map(|rows| rows.target.clone());
        let targets = weighed(targets.collect(), &unit, &ones);
        for (joint, rows) in rows.joints.iter_mut().enumerate() {
            for (sample, &r) in residuals[joint].iter().enumerate() {
                let parts = self.scaled.iter().enumerate();
                let parts = parts.map(|(k, x)| (x * rows[(sample, k)]).powi(2));
                let part = targets[joint][sample].powi(2) + parts.sum::<f64>();
                let more = (r * r - self.least * part) / size;
                for (k, x) in self.scaled.iter().enumerate() {
                    let a = rows[(sample, k)];
                    rows[(sample, k)] = self.target * (a * r + x * (self.least * a * a + more));
                }
            }
        }
        rows.deviations(&rows.influence(&ones, &bread), Some(&steady))
    }

    /// The columns without the part of their errors that is in the residual, too: `a + x r / (1 + x'x)`, Golub and Van Loan's correction.
    /// What is left goes its way beside the residual, as columns without errors do.
    fn corrected(&self, rows: &Rows, residuals: &[Vec<f64>], size: f64) -> Rows {
        let mut corrected = rows.clone();
        for (rows, residuals) in corrected.joints.iter_mut().zip(residuals) {
            for (k, x) in self.scaled.iter().enumerate() {
                let rows = rows.col_mut(k).iter_mut();
                rows.zip(residuals).for_each(|(a, r)| *a += x * r / size);
            }
        }
        corrected
    }
}

#[cfg(test)]
mod tests {
    use rand::SeedableRng;
    use rand_chacha::ChaCha8Rng;
    use rand_distr::{Distribution, StandardNormal};

    use super::*;
    use crate::columns::Unknown;
    use crate::identify::{Identify, JointRows, Method, Segment};

    const TRUTH: [f64; 2] = [2.0, -0.7];

    /// Two columns with noise of a third of their size, and torque with as much.
    fn stack(seed: u64) -> Stack {
        const SHARE: f64 = 0.3;
        let mut random = ChaCha8Rng::seed_from_u64(seed);
        let mut normal = move || -> f64 { StandardNormal.sample(&mut random) };
        let clean: [Vec<f64>; 2] =
            [1.0, 4.0].map(|size| (0..600).map(|_| size * normal()).collect());
        let torque: Vec<f64> = (0..600)
            .map(|k| TRUTH[0] * clean[0][k] + TRUTH[1] * clean[1][k])
            .collect();
        let mut worn = |values: &[f64]| -> Vec<f64> {
            let square: f64 = values.iter().map(|x| x * x).sum();
            let size = SHARE * (square / values.len() as f64).sqrt();
            values.iter().map(|x| x + size * normal()).collect()
        };
        let target = worn(&torque);
        let columns = [0, 1].map(|c| (c, worn(&clean[c])));
        let unknown = |name: &str| Unknown {
            name: name.to_owned(),
            nonnegative: false,
        };
        Stack {
            unknowns: vec![unknown("x"), unknown("y")],
            joints: vec![JointRows {
                tau: target.clone(),
                target,
                columns: columns.to_vec(),
            }],
            segments: vec![Segment {
                start: 0,
                time: Vec::new(),
            }],
            ..Stack::default()
        }
    }

    fn fit(stack: &Stack, method: Method) -> Solution {
        let identify = Identify {
            method,
            ..Identify::default()
        };
        let mut solution = identify.solve_stack(stack).expect("samples enough");
        if method == Method::Total {
            make(&mut solution, stack, Weights::Residual).expect("a direction");
        }
        solution
    }

    #[test]
    fn columns_with_errors_bias_least_squares_and_not_the_total_one() {
        // The spread of so many is known within 2 %.
        const DRAWS: u32 = 1000;
        let mut mean = [[0.0; 2]; 2];
        let (mut errors, mut told) = ([0.0; 2], [0.0; 2]);
        for seed in 0..DRAWS {
            let stack = stack(u64::from(seed));
            for (mean, method) in mean.iter_mut().zip([Method::Wls, Method::Total]) {
                let solution = fit(&stack, method);
                for c in 0..2 {
                    mean[c] += solution.estimate[c] / f64::from(DRAWS);
                    if method == Method::Total {
                        errors[c] += (solution.estimate[c] - TRUTH[c]).powi(2) / f64::from(DRAWS);
                        told[c] += solution.std[c].powi(2) / f64::from(DRAWS);
                    }
                }
            }
        }
        for c in 0..2 {
            // A column with noise of variance 0.09 of its own: 1 / 1.09.
            assert!(
                (mean[0][c] / TRUTH[c] - 1.0 / 1.09).abs() < 0.01,
                "{mean:?}"
            );
            assert!((mean[1][c] / TRUTH[c] - 1.0).abs() < 0.01, "{mean:?}");
            let ratio = (told[c] / errors[c]).sqrt();
            assert!((ratio - 1.0).abs() < 0.12, "{ratio}");
        }
    }

    #[test]
    fn without_errors_it_is_least_squares() {
        let mut exact = stack(5);
        let columns = exact.joints[0].columns.clone();
        exact.joints[0].target = (0..600)
            .map(|k| 3.0 * columns[0].1[k] + columns[1].1[k])
            .collect();
        let found = fit(&exact, Method::Total).estimate;
        assert!(
            (found[0] - 3.0).abs() < 1e-9 && (found[1] - 1.0).abs() < 1e-9,
            "{found:?}"
        );
    }

    #[test]
    fn torque_that_is_nothing_has_no_total_estimate() {
        let mut silent = stack(5);
        let mut solution = fit(&silent, Method::Wls);
        silent.joints[0].target.fill(0.0);
        let found = make(&mut solution, &silent, Weights::Residual);
        assert_eq!(found, Err(IdentifyError::NoTotal));
    }

    #[test]
    fn columns_that_errors_hide_have_no_total_estimate() {
        let mut alike = stack(5);
        let first = alike.joints[0].columns[0].1.clone();
        let other = &mut alike.joints[0].columns[1].1;
        for (other, first) in other.iter_mut().zip(&first) {
            *other = first + 0.01 * *other;
        }
        // Noise of another stack beside what both columns are.
        let noise = stack(6).joints[0].target.clone();
        let pairs = first.iter().zip(&noise);
        alike.joints[0].target = pairs.map(|(first, noise)| first + 0.3 * noise).collect();
        let mut solution = fit(&alike, Method::Wls);
        let found = make(&mut solution, &alike, Weights::Residual);
        assert_eq!(found, Err(IdentifyError::TotalApart));
    }
}

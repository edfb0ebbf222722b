//! Total least squares: columns with errors.
//!
//! With `A` the columns and `b` the torque, rows over their joint's deviation and each column, `b` too, over its length, the estimate
//! is `x = -v_a / v_b` of the right singular vector `v` of `[A b]` with the least singular value `s`:
//! `(A'A - s^2 1) x = A'b`. It is consistent where all entries have errors of one variance, which is here a share of each column's
//! length. Least squares is biased towards zero there. Source: Golub, Van Loan 1980, An analysis of the total least squares problem.
//!
//! Columns that are constant, as those of offsets, have no errors: they are taken out of `[A b]` by QR first, and follow from the others. So
//! lengths of the others are of what is left of them.
//! Source: Golub, Hoffman, Stewart 1987, A generalization of the Eckart-Young-Mirsky matrix approximation theorem.

use super::hac::{Rows, weighed};
use super::least_squares::{Factors, Solution};
use super::stack::Stack;
use super::{IdentifyError, Weights, robust};

mod exact;

use exact::Parted;

/// `s^2` as a share of the least squared singular value of the columns alone: beyond this the errors that are taken for granted hide how
/// columns differ.
const MOST_SHARE: f64 = 0.25;

/// A total least squares estimate in units of the columns' lengths.
struct Total {
    /// `x`, one an excited unknown.
    scaled: Vec<f64>,
    /// `s^2`
    least: f64,
    /// Which columns have errors.
    parted: Parted,
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
        let mut rows = Rows::new(stack, &solution.unexcited, &solution.scale);
        let parted = Parted::new(stack, &factors, &mut rows, &solution.scale)?;
        let total = Total::new(parted)?;
        for (k, &c) in rows.excited.iter().enumerate() {
            solution.estimate[c] = total.scaled[k] * total.parted.target / rows.length[k];
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
    fn new(parted: Parted) -> Result<Self, IdentifyError> {
        let count = parted.worn.len();
        let found = parted.left.thin_svd().map_err(|_| IdentifyError::NoTotal)?;
        let least = found.S().column_vector()[count].powi(2);
        let alone = parted.left.get(.., ..count).singular_values();
        let alone = alone.map_err(|_| IdentifyError::NoTotal)?;
        let is_hidden = |alone: &f64| least > MOST_SHARE * alone.powi(2);
        if alone.last().is_some_and(is_hidden) {
            return Err(IdentifyError::TotalApart);
        }
        let v = found.V().col(count);
        if v[count] == 0.0 {
            return Err(IdentifyError::NoTotal);
        }
        let worn: Vec<f64> = (0..count).map(|k| -v[k] / v[count]).collect();
        Ok(Self {
            scaled: parted.with_exact(&worn),
            least,
            parted,
        })
    }

    /// Unknowns whose columns have errors: place and `x`.
    fn worn(&self) -> impl Iterator<Item = (usize, f64)> {
        self.parted.worn.iter().map(|&k| (k, self.scaled[k]))
    }

    /// The estimate is where `A'r + s^2 x = 0`, with `s^2 = sum r^2 / (1 + x'x)`, in units of lengths that are themselves of the samples:
    /// with each sample's share `d = b^2 + sum_c (x_c a_c)^2` of `1 + x'x` it adds `a r + s^2 x a^2 + x (r^2 - s^2 d) / (1 + x'x)`. The `x` in
    /// these are of columns with errors, `a` and `b` in squares what is left of them beside the others, whose own equation is `A'r = 0`.
    fn deviations(&self, mut rows: Rows, stack: &Stack, solution: &Solution) -> Vec<f64> {
        let mut bread = rows.product(&rows);
        for (k, _) in self.worn() {
            bread[(k, k)] -= self.least;
        }
        let ones = robust::of_all(stack);
        let target = self.parted.target;
        let unit: Vec<f64> = solution.scale.iter().map(|scale| scale * target).collect();
        let rest = stack.residuals(&solution.estimate);
        let residuals = weighed(rest.clone(), &unit, &ones);
        let size = 1.0 + self.worn().map(|(_, x)| x * x).sum::<f64>();
        let steady = self.corrected(&rows, &residuals, size);
        let steady = steady.steady(&rows, &weighed(rest, &solution.scale, &ones), &bread);
        let targets = stack.joints.iter().map(|rows| rows.target.clone());
        let targets = weighed(targets.collect(), &unit, &ones);
        for (joint, rows) in rows.joints.iter_mut().enumerate() {
            for (sample, &r) in residuals[joint].iter().enumerate() {
                let row = rows.row(sample).iter().copied().collect::<Vec<f64>>();
                let [left @ .., b] = &self.parted.left_of(&row, targets[joint][sample])[..] else {
                    continue;
                };
                let parts = self.worn().zip(left);
                let parts = parts.map(|((_, x), a)| (x * a).powi(2));
                let part = b * b + parts.sum::<f64>();
                let more = (r * r - self.least * part) / size;
                rows.row_mut(sample)
                    .iter_mut()
                    .for_each(|a| *a *= target * r);
                for ((k, x), a) in self.worn().zip(left) {
                    rows[(sample, k)] += target * x * (self.least * a * a + more);
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
            for (k, x) in self.worn() {
                let rows = rows.col_mut(k).iter_mut();
                rows.zip(residuals).for_each(|(a, r)| *a += x * r / size);
            }
        }
        corrected
    }
}

#[cfg(test)]
mod tests;

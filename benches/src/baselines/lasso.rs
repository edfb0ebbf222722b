//! LASSO (Tibshirani 1996) by coordinate descent (Friedman, Hastie & Tibshirani 2010): the penalty by ten-fold cross-validation with the
//! rule of one standard error.

use super::Choice;
use super::products::Products;
use super::rows::Rows;

/// Penalties, from the one that leaves nothing to this share of it.
const STEPS: u32 = 60;
const LEAST: f64 = 1e-3;

/// A sweep that changes no column's share of the target's power by more than this is the last.
const SETTLED: f64 = 1e-7;

/// Sweeps over the columns that are in, and how often all others are looked at.
const SWEEPS: usize = 300;
const ROUNDS: usize = 20;

/// Effects with a coefficient that is not zero, by the power of their part.
#[must_use]
pub fn lasso(rows: &Rows) -> Vec<Choice> {
    let products = rows.products();
    let largest = largest(&products);
    let steps: Vec<f64> = (0..STEPS)
        .map(|k| largest * LEAST.powf(f64::from(k) / f64::from(STEPS - 1)))
        .collect();
    rows.choices(&rows.cross_validated(path, &steps))
}

/// The least penalty that leaves no column in.
fn largest(products: &Products) -> f64 {
    let sizes = products.with_target.iter().map(|value| value.abs());
    sizes.fold(0.0, f64::max)
}

/// Minimizers of `|| target - Z b ||^2 / (2 rows) + penalty |b|_1`, each from the one before.
fn path(products: &Products, penalties: &[f64]) -> Vec<Vec<f64>> {
    let columns = products.columns();
    let mut descent = Descent {
        products,
        coefficients: vec![0.0; columns],
        slope: products.with_target.clone(),
    };
    let every: Vec<usize> = (0..columns).collect();
    let settled = SETTLED * products.power;
    let mut path = Vec::new();
    for penalty in penalties {
        for _ in 0..ROUNDS {
            if descent.sweep(&every, *penalty) <= settled {
                break;
            }
            let is_in = |column: &usize| descent.coefficients[*column].abs() > 0.0;
            let active: Vec<usize> = every.iter().copied().filter(is_in).collect();
            for _ in 0..SWEEPS {
                if descent.sweep(&active, *penalty) <= settled {
                    break;
                }
            }
        }
        path.push(descent.coefficients.clone());
    }
    path
}

struct Descent<'a> {
    products: &'a Products,
    coefficients: Vec<f64>,
    /// Products of every column with what is left of the target.
    slope: Vec<f64>,
}

impl Descent<'_> {
    /// Minimizes along each column in turn; the largest change of the power.
    fn sweep(&mut self, columns: &[usize], penalty: f64) -> f64 {
        let mut most: f64 = 0.0;
        for &column in columns {
            let gram = &self.products.gram;
            let own = gram[(column, column)];
            if own <= 0.0 {
                continue;
            }
            let before = self.coefficients[column];
            let after = soft(self.slope[column] + own * before, penalty) / own;
            let step = after - before;
            if step.abs() > 0.0 {
                self.coefficients[column] = after;
                let with = gram.col_as_slice(column);
                for (slope, product) in self.slope.iter_mut().zip(with) {
                    *slope -= step * product;
                }
                most = most.max(own * step * step);
            }
        }
        most
    }
}

/// What is left of a value beyond a threshold.
fn soft(value: f64, threshold: f64) -> f64 {
    value.signum() * (value.abs() - threshold).max(0.0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use faer::Mat;

    fn orthogonal() -> Products {
        Products {
            gram: Mat::from_fn(3, 3, |a, b| f64::from(u8::from(a == b))),
            with_target: vec![3.0, -2.0, 0.5],
            power: 14.0,
        }
    }

    #[test]
    fn orthogonal_columns_have_soft_thresholds() {
        let path = path(&orthogonal(), &[2.5, 1.0]);
        assert_eq!(path[0], [0.5, 0.0, 0.0]);
        assert_eq!(path[1], [2.0, -1.0, 0.0]);
    }

    #[test]
    fn the_largest_penalty_leaves_nothing() {
        let products = orthogonal();
        let most = largest(&products);
        let path = path(&products, &[most, 0.99 * most]);
        assert_eq!(path[0], [0.0; 3]);
        assert!(path[1][0] > 0.0);
    }

    #[test]
    fn the_minimum_has_slopes_of_the_penalty() {
        let mut products = orthogonal();
        products.gram = Mat::from_fn(3, 3, |a, b| if a == b { 1.0 } else { 0.4 });
        let found = path(&products, &[0.2]).remove(0);
        for column in 0..3 {
            let said = (0..3).map(|other| products.gram[(column, other)] * found[other]);
            let slope = products.with_target[column] - said.sum::<f64>();
            let wanted = if found[column].abs() > 0.0 {
                0.2 * found[column].signum()
            } else {
                slope.clamp(-0.2, 0.2)
            };
            assert!((slope - wanted).abs() < 1e-3, "{column}: {slope} {found:?}");
        }
    }
}

//! Sums of products of columns, all that a fit needs.

use faer::Mat;
use faer::linalg::solvers::Solve;

/// Added to the diagonal of the model's columns: they are orthonormal over all rows, and a fold may hardly see one.
const RIDGE: f64 = 1e-9;

/// Products of columns with each other and with the target, per row, without what the model's columns say of any.
#[derive(Debug, Clone)]
pub(super) struct Products {
    /// Of columns with each other.
    pub(super) gram: Mat<f64>,
    /// Of columns with the target.
    pub(super) with_target: Vec<f64>,
    /// Mean square of the target.
    pub(super) power: f64,
}

/// [`Products`] and, for every column and last for the target, the combination of the model's columns that was taken out.
pub(super) struct Reduced {
    pub(super) products: Products,
    pub(super) taken: Mat<f64>,
}

impl Reduced {
    /// Takes the first `model` columns out of the products of all columns and, last, the target.
    pub(super) fn new(all: &Mat<f64>, model: usize) -> Self {
        let rest = all.nrows() - model;
        let own = Mat::from_fn(model, model, |a, b| {
            all[(a, b)] + if a == b { RIDGE } else { 0.0 }
        });
        let others = Mat::from_fn(model, rest, |a, b| all[(a, model + b)]);
        let taken = if model == 0 {
            Mat::zeros(0, rest)
        } else {
            own.partial_piv_lu().solve(&others)
        };
        let said = others.transpose() * &taken;
        let left = |a: usize, b: usize| all[(model + a, model + b)] - said[(a, b)];
        let columns = rest - 1;
        Self {
            products: Products {
                gram: Mat::from_fn(columns, columns, left),
                with_target: (0..columns).map(|c| left(c, columns)).collect(),
                power: left(columns, columns).max(0.0),
            },
            taken,
        }
    }
}

impl Products {
    /// Number of columns.
    pub(super) fn columns(&self) -> usize {
        self.with_target.len()
    }

    /// The same without one column and what it says of the others; as it was where it says nothing.
    pub(super) fn without(&mut self, column: usize) {
        let own = self.gram[(column, column)];
        if own <= super::rows::LEAST_NEW.powi(2) {
            return;
        }
        let of: Vec<f64> = (0..self.columns())
            .map(|c| self.gram[(c, column)])
            .collect();
        let target = self.with_target[column];
        for b in 0..of.len() {
            let factor = of[b] / own;
            for a in 0..of.len() {
                self.gram[(a, b)] -= factor * of[a];
            }
            self.with_target[b] -= factor * target;
        }
        self.power = (self.power - target * target / own).max(0.0);
    }

    /// Root mean square of a combination of columns.
    pub(super) fn power_of(&self, columns: &[usize], coefficients: &[f64]) -> f64 {
        let terms = columns.iter().flat_map(|a| {
            let of = |b: &usize| coefficients[*a] * self.gram[(*a, *b)] * coefficients[*b];
            columns.iter().map(of)
        });
        terms.sum::<f64>().max(0.0).sqrt()
    }
}

#[cfg(test)]
mod tests {
    use super::{Products, Reduced};
    use faer::Mat;

    #[test]
    fn the_model_is_taken_out() {
        // One column that is half the model, of power 1 beside it; a target that is the model and twice the column.
        let all = Mat::from_fn(3, 3, |a, b| {
            [[1.0, 0.5, 2.0], [0.5, 1.25, 3.0], [2.0, 3.0, 8.0]][a][b]
        });
        let Products {
            gram,
            with_target,
            power,
        } = Reduced::new(&all, 1).products;
        assert!((gram[(0, 0)] - 1.0).abs() < 1e-6);
        assert!((with_target[0] - 2.0).abs() < 1e-6);
        assert!((power - 4.0).abs() < 1e-6);
    }

    #[test]
    fn a_column_that_is_taken_out_leaves_what_others_have_of_their_own() {
        let mut products = Products {
            gram: Mat::from_fn(2, 2, |a, b| if a == b { 1.0 } else { 0.5 }),
            with_target: vec![2.0, 1.5],
            power: 6.0,
        };
        products.without(0);
        assert!(products.gram[(0, 1)].abs() < 1e-12);
        assert!((products.gram[(1, 1)] - 0.75).abs() < 1e-12);
        assert!((products.with_target[1] - 0.5).abs() < 1e-12);
        assert!((products.power - 2.0).abs() < 1e-12);
    }
}

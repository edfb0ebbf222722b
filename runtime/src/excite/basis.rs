//! Other columns than the regressor's own.

use faer::Mat;

/// Parameters in place of the regressor's own: `Y K` are their columns, where the own ones are `K` times these.
///
/// Condition number and smallest singular value depend on the choice, `ln det` but for a constant does not.
#[derive(Debug, Clone, PartialEq)]
pub struct Basis {
    pub(super) names: Vec<String>,
    matrix: Mat<f64>,
}

impl Basis {
    /// Parameters by name, and the entries of `K`, `(column of the regressor, parameter)`, which is square and regular.
    #[must_use]
    pub fn new(names: Vec<String>, entry: impl Fn(usize, usize) -> f64) -> Self {
        Self {
            matrix: Mat::from_fn(names.len(), names.len(), entry),
            names,
        }
    }

    /// `K^T A K`: the information matrix of these parameters.
    pub(super) fn information(&self, a: &Mat<f64>) -> Mat<f64> {
        self.matrix.transpose() * a * &self.matrix
    }

    /// Slopes by `A` of slopes by `K^T A K`.
    pub(super) fn pullback(&self, slopes: &Mat<f64>) -> Mat<f64> {
        &self.matrix * slopes * self.matrix.transpose()
    }
}

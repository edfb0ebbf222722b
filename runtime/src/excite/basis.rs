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
    ///
    /// # Examples
    /// The sum and the difference of two parameters, `ia = s + d` and `k = s - d`, told as well as the parameters themselves:
    /// ```
    /// # mod rotor { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/doc/rotor.rs")); }
    /// use robot_model::excite::{Basis, Fourier};
    /// let mut request = rotor::request();
    /// let motion = Fourier { period: 4.0, coefficients: vec![vec![0.0, 0.6, 0.0, 0.6, 0.0, 0.0, 0.0]] };
    /// let own = request.quality(&motion)?.log_det;
    /// let names = vec!["s".to_owned(), "d".to_owned()];
    /// request.basis = Some(Basis::new(names, |row, column| if row == 1 && column == 1 { -1.0 } else { 1.0 }));
    /// // det K^T A K = det A (det K)^2, and det K = -2.
    /// assert!((request.quality(&motion)?.log_det - own - 4.0_f64.ln()).abs() < 1e-9);
    /// # Ok::<(), robot_model::excite::ExciteError>(())
    /// ```
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

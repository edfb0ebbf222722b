//! Weighted normal equations of a set of rows, solved.

use faer::Mat;
use faer::linalg::solvers::Solve;

use super::gram::Products;

/// Added to the diagonal, relative to what a column has over all rows: far below what an excited column contributes, and
/// what keeps the estimate of a column small in a fold that hardly sees it.
const RIDGE: f64 = 1e-10;

/// Normal equations with columns of unit norm.
pub(super) struct Normal {
    norms: Vec<f64>,
    factor: faer::linalg::solvers::PartialPivLu<f64>,
    right: Vec<f64>,
}

impl Normal {
    /// `squares` are the weighted sums of squares of the columns over all rows.
    pub(super) fn new(products: &[Products], sigma: &[f64], squares: &[f64]) -> Self {
        let unknowns = squares.len();
        let mut sum = Mat::<f64>::zeros(unknowns + 1, unknowns + 1);
        for (g, s) in products.iter().zip(sigma) {
            sum += faer::Scale(1.0 / (s * s)) * g;
        }
        for (c, square) in squares.iter().enumerate() {
            sum[(c, c)] += RIDGE * square;
        }
        let norms: Vec<f64> = (0..unknowns).map(|c| sum[(c, c)].sqrt()).collect();
        let scaled = Mat::from_fn(unknowns, unknowns, |a, b| {
            if a == b {
                1.0
            } else if norms[a] > 0.0 && norms[b] > 0.0 {
                sum[(a, b)] / (norms[a] * norms[b])
            } else {
                0.0
            }
        });
        let right = (0..unknowns).map(|c| sum[(c, unknowns)]).collect();
        Self {
            norms,
            factor: scaled.partial_piv_lu(),
            right,
        }
    }

    /// The estimate.
    pub(super) fn solve(&self) -> Vec<f64> {
        self.apply(&self.right)
    }

    /// `(W' W)^-1 * right`
    pub(super) fn apply(&self, right: &[f64]) -> Vec<f64> {
        let n = self.norms.len();
        let scaled = Mat::from_fn(n, 1, |c, _| {
            if self.norms[c] > 0.0 {
                right[c] / self.norms[c]
            } else {
                0.0
            }
        });
        let solved = self.factor.solve(&scaled);
        (0..n)
            .map(|c| {
                if self.norms[c] > 0.0 {
                    solved[(c, 0)] / self.norms[c]
                } else {
                    0.0
                }
            })
            .collect()
    }
}

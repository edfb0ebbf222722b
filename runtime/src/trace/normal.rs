//! Weighted normal equations of a set of rows, solved.

use faer::Mat;
use faer::linalg::solvers::Solve;

use super::gram::Products;

/// Added to the diagonal, relative to what a column has over all rows: far below what an excited column contributes, and
/// what keeps the estimate of a column small in a fold that hardly sees it.
const RIDGE: f64 = 1e-10;

/// The same of a curve's columns beside their mean: a knot that a fold does not see is told by its neighbors alone.
const RIDGE_OF_CURVE: f64 = 1e-3;

/// A curve whose columns are the unknowns from `first` on.
pub(super) struct Smooth<'a> {
    pub(super) first: usize,
    /// Columns of three knots in a row.
    pub(super) bends: &'a [[usize; 3]],
    /// How much a squared bend counts, in mean squares of the columns.
    pub(super) stiffness: f64,
}

impl Smooth<'_> {
    /// Adds `stiffness sum (x_a - 2 x_b + x_c)^2` to normal equations.
    fn add_to(&self, sum: &mut Mat<f64>, unknowns: usize) {
        let own = self.first..unknowns;
        let count = own.len().max(1) as f64;
        let mean = own.clone().map(|c| sum[(c, c)]).sum::<f64>() / count;
        for c in own {
            sum[(c, c)] += RIDGE_OF_CURVE * mean;
        }
        for bend in self.bends {
            for (a, x) in bend.iter().zip(BEND) {
                for (b, y) in bend.iter().zip(BEND) {
                    sum[(self.first + a, self.first + b)] += self.stiffness * mean * x * y;
                }
            }
        }
    }
}

/// A second difference.
const BEND: [f64; 3] = [1.0, -2.0, 1.0];

/// Normal equations with columns of unit norm.
pub(super) struct Normal {
    norms: Vec<f64>,
    factor: faer::linalg::solvers::PartialPivLu<f64>,
    right: Vec<f64>,
}

impl Normal {
    /// `squares` are the weighted sums of squares of the columns over all rows.
    pub(super) fn new(products: &[Products], sigma: &[f64], squares: &[f64]) -> Self {
        Self::of(products, sigma, squares, None)
    }

    /// The same with a curve that bends little.
    pub(super) fn smooth(
        products: &[Products],
        sigma: &[f64],
        squares: &[f64],
        smooth: &Smooth<'_>,
    ) -> Self {
        Self::of(products, sigma, squares, Some(smooth))
    }

    fn of(
        products: &[Products],
        sigma: &[f64],
        squares: &[f64],
        smooth: Option<&Smooth<'_>>,
    ) -> Self {
        let unknowns = squares.len();
        let mut sum = Mat::<f64>::zeros(unknowns + 1, unknowns + 1);
        for (g, s) in products.iter().zip(sigma) {
            sum += faer::Scale(1.0 / (s * s)) * g;
        }
        for (c, square) in squares.iter().enumerate() {
            sum[(c, c)] += RIDGE * square;
        }
        if let Some(smooth) = smooth {
            smooth.add_to(&mut sum, unknowns);
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

//! Columns without errors, and what is left of the others beside them.

use faer::Mat;

use crate::identify::IdentifyError;
use crate::identify::hac::Rows;
use crate::identify::least_squares::Factors;
use crate::identify::stack::Stack;

/// `[A_exact A_worn b]` in units of lengths, by QR: `R = [R_11 R_12; 0 R_22]`.
pub(super) struct Parted {
    /// Places among the excited unknowns of columns without errors.
    exact: Vec<usize>,
    /// And of the others.
    pub worn: Vec<usize>,
    /// `R_11^-1 R_12`: how much of each exact column is in each of the others and in `b`.
    of_exact: Mat<f64>,
    /// `R_22`, columns and `b` of length one.
    pub left: Mat<f64>,
    /// Length of what is left of `b`.
    pub target: f64,
}

impl Parted {
    /// Of rows, whose columns with errors get the lengths of what is left of them.
    pub fn new(
        stack: &Stack,
        factors: &Factors,
        rows: &mut Rows,
        scale: &[f64],
    ) -> Result<Self, IdentifyError> {
        let is_exact = |k: &usize| is_constant(stack, rows.excited[*k]);
        let (exact, worn): (Vec<usize>, Vec<usize>) = (0..rows.excited.len()).partition(is_exact);
        let r = factors.stacked(scale);
        let last = r.ncols() - 1;
        let order: Vec<usize> = exact.iter().chain(&worn).copied().collect();
        let all = Mat::from_fn(r.nrows(), order.len() + 1, |row, place| {
            order.get(place).map_or_else(
                || r[(row, last)],
                |&k| r[(row, rows.excited[k])] / rows.length[k],
            )
        });
        let mut triangle = all.qr().thin_R().to_owned();
        let first = exact.len();
        let mut target = 0.0;
        for place in first..triangle.ncols() {
            let length = triangle.col(place).get(first..).norm_l2();
            if length == 0.0 {
                return Err(IdentifyError::NoTotal);
            }
            triangle
                .col_mut(place)
                .iter_mut()
                .for_each(|x| *x /= length);
            match order.get(place) {
                Some(&k) => rows.shorten(k, length),
                None => target = length,
            }
        }
        let mut of_exact = triangle.get(..first, first..).to_owned();
        for column in 0..of_exact.ncols() {
            for place in (0..first).rev() {
                let behind = place + 1..first;
                let of_others: f64 = behind
                    .map(|at| triangle[(place, at)] * of_exact[(at, column)])
                    .sum();
                let own = of_exact[(place, column)] - of_others;
                of_exact[(place, column)] = own / triangle[(place, place)];
            }
        }
        let left = triangle.get(first.., first..).to_owned();
        Ok(Self {
            exact,
            worn,
            of_exact,
            left,
            target,
        })
    }

    /// All unknowns, of those whose columns have errors: `x_exact = R_11^-1 (r_1b - R_12 x_worn)`.
    pub fn with_exact(&self, worn: &[f64]) -> Vec<f64> {
        let mut all = vec![0.0; self.exact.len() + worn.len()];
        for (&k, x) in self.worn.iter().zip(worn) {
            all[k] = *x;
        }
        for (place, &k) in self.exact.iter().enumerate() {
            let pairs = worn.iter().enumerate();
            let of_worn: f64 = pairs.map(|(at, x)| self.of_exact[(place, at)] * x).sum();
            all[k] = self.of_exact[(place, worn.len())] - of_worn;
        }
        all
    }

    /// What is left of a row's columns with errors and of its `b` beside exact columns.
    pub fn left_of(&self, row: &[f64], b: f64) -> Vec<f64> {
        let all = self.worn.iter().map(|&k| row[k]).chain([b]);
        let left = all.enumerate().map(|(at, value)| {
            let exact = self.exact.iter().enumerate();
            let of_exact = exact.map(|(place, &k)| self.of_exact[(place, at)] * row[k]);
            value - of_exact.sum::<f64>()
        });
        left.collect()
    }
}

/// Whether the column of an unknown is one number in all rows that have it, joint by joint.
fn is_constant(stack: &Stack, unknown: usize) -> bool {
    /// Rounding of filters, as a share of the number.
    const ROUNDING: f64 = 1e-9;
    let columns = stack.joints.iter().flat_map(|rows| &rows.columns);
    let mut columns = columns.filter(|(column, _)| *column == unknown);
    columns.all(|(_, values)| {
        let mut there = values.iter().filter(|value| **value != 0.0);
        let first = there.next().copied().unwrap_or_default();
        there.all(|value| (value - first).abs() <= ROUNDING * first.abs())
    })
}

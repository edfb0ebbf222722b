//! Rows of some samples, reduced joint by joint.

use faer::Mat;

use crate::identify::least_squares::Factors;
use crate::identify::stack::Stack;

/// Rows, reduced joint by joint.
#[derive(Debug, Clone, PartialEq, Default)]
#[non_exhaustive]
pub struct FactorRows {
    /// Rows of each joint that say something: a joint that stands says nothing.
    pub counts: Vec<usize>,
    /// `[joint][row][column]`: columns are the unknowns, then the torque less that of known parameters.
    pub rows: Vec<Vec<Vec<f64>>>,
    /// Sum of the squared torque, one a joint.
    pub torque_squares: Vec<f64>,
    /// The largest torque either way, one a joint.
    pub most_torque: Vec<f64>,
}

impl FactorRows {
    /// The rows of a stack, `(joint, row)`, for which that is so.
    pub(super) fn of(stack: &Stack, is_so: &dyn Fn(usize, usize) -> bool) -> Self {
        let factors = Factors::of_rows(stack, &|joint, row| f64::from(is_so(joint, row)));
        let joints = stack.joints.iter().enumerate();
        let torques = joints.map(|(joint, rows)| {
            let rows = rows.tau.iter().enumerate();
            let rows = rows.filter(move |(row, _)| is_so(joint, *row));
            rows.map(|(_, tau)| *tau)
        });
        let squares = torques.clone().map(|taus| taus.map(|tau| tau * tau).sum());
        let most = torques.map(|taus| taus.fold(0.0, |most: f64, tau| most.max(tau.abs())));
        // Where no row counts there is nothing to keep.
        let rows = factors.joints().iter().zip(factors.counts());
        let rows = rows.map(|(rows, count)| match count {
            0 => Vec::new(),
            _ => rows_of(rows),
        });
        Self {
            counts: factors.counts().to_vec(),
            rows: rows.collect(),
            torque_squares: squares.collect(),
            most_torque: most.collect(),
        }
    }

    /// What is below these rows becomes a part of them.
    pub(super) fn add(&mut self, other: Self) {
        for (count, more) in self.counts.iter_mut().zip(other.counts) {
            *count += more;
        }
        for (sum, more) in self.torque_squares.iter_mut().zip(other.torque_squares) {
            *sum += more;
        }
        for (most, more) in self.most_torque.iter_mut().zip(other.most_torque) {
            *most = most.max(more);
        }
        for (rows, more) in self.rows.iter_mut().zip(other.rows) {
            rows.extend(more);
            *rows = rows_of(&reduced(rows));
        }
    }
}

fn rows_of(matrix: &Mat<f64>) -> Vec<Vec<f64>> {
    let rows = 0..matrix.nrows();
    rows.map(|row| matrix.row(row).iter().copied().collect())
        .collect()
}

/// The triangular factor of rows.
pub(super) fn reduced(rows: &[Vec<f64>]) -> Mat<f64> {
    let width = rows.first().map_or(0, Vec::len);
    let all = Mat::from_fn(rows.len(), width, |row, column| rows[row][column]);
    if all.nrows() <= width {
        return all;
    }
    all.qr().thin_R().to_owned()
}

//! The equations of a curve: one constant for each cell of alike speeds, and columns beside them.

use faer::Mat;
use faer::linalg::solvers::{Solve, SolveLstsq};

use super::rows::Rows;
use crate::identify::correlation_time;

/// A cell's own noise counts beside that of all cells as if the latter were so many blocks.
const PRIOR: f64 = 10.0;

/// The rigid body's columns that count.
pub(super) struct Chosen {
    /// Their places among [`Measured::columns`].
    pub places: Vec<usize>,
    /// Their lengths.
    pub lengths: Vec<f64>,
    pub has_constant: bool,
}

/// What a curve's equations say.
pub(super) struct Solution {
    /// Of the cells.
    pub torques: Vec<f64>,
    /// Of the chosen columns, and their standard deviations.
    pub beta: Vec<f64>,
    pub beta_std: Vec<f64>,
    /// How far each block's error moves each cell's torque, one deviation of it, `[block, cell]`.
    pub influence: Mat<f64>,
}

impl Solution {
    pub fn new(rows: &Rows, cell: &[usize], count: usize, chosen: &Chosen) -> Self {
        let (n, r) = (rows.torque.len(), chosen.places.len());
        let columns: Vec<Vec<f64>> = chosen
            .places
            .iter()
            .zip(&chosen.lengths)
            .map(|(&place, length)| rows.columns[place].iter().map(|x| x / length).collect())
            .collect();
        let inside: Vec<Vec<f64>> = columns.iter().map(|x| within(x, cell, count)).collect();
        let mut rest = within(&rows.torque, cell, count);
        let mut torques = means(&rows.torque, cell, count);
        let column_means: Vec<Vec<f64>> = columns.iter().map(|x| means(x, cell, count)).collect();
        let mut beta = vec![0.0; r];
        // What a block's error does to the values of the columns.
        let mut moves = Mat::<f64>::zeros(n, r);
        if r > 0 {
            let matrix = Mat::from_fn(n, r, |row, c| inside[c][row]);
            let right = Mat::from_fn(n, 1, |row, _| rest[row]);
            let solved = matrix.qr().solve_lstsq(&right);
            beta = (0..r).map(|c| solved[(c, 0)]).collect();
            let inverse = (matrix.transpose() * &matrix)
                .partial_piv_lu()
                .solve(Mat::<f64>::identity(r, r));
            moves = &matrix * inverse;
        }
        for (c, value) in beta.iter().enumerate() {
            let pairs = rest.iter_mut().zip(&inside[c]);
            pairs.for_each(|(rest, x)| *rest -= value * x);
            let pairs = torques.iter_mut().zip(&column_means[c]);
            pairs.for_each(|(torque, mean)| *torque -= value * mean);
        }
        let (blocks, sigma) = noise(&rest, cell, count, r);
        let influence = Mat::from_fn(n, count, |row, k| {
            let own = if cell[row] == k { 1.0 / blocks[k] } else { 0.0 };
            let by_columns: f64 = (0..r).map(|c| moves[(row, c)] * column_means[c][k]).sum();
            sigma[cell[row]] * (own - by_columns)
        });
        let std = |c: usize| {
            let moved = (0..n).map(|row| sigma[cell[row]] * moves[(row, c)]);
            norm(&moved.collect::<Vec<f64>>())
        };
        let over_length = |values: Vec<f64>| {
            values
                .iter()
                .zip(&chosen.lengths)
                .map(|(x, length)| x / length)
                .collect()
        };
        Self {
            torques,
            beta_std: over_length((0..r).map(std).collect()),
            beta: over_length(beta),
            influence,
        }
    }
}

/// How many blocks each cell has, and the deviation of a block's error there, larger where neighbors are alike so that the sums of
/// errors come out: cells have their own noise, and those of few blocks nearly that of all.
fn noise(rest: &[f64], cell: &[usize], count: usize, unknowns: usize) -> (Vec<f64>, Vec<f64>) {
    let mut sums = vec![(0.0, 0.0); count];
    for (rest, &cell) in rest.iter().zip(cell) {
        sums[cell].0 += 1.0;
        sums[cell].1 += rest * rest;
    }
    let freedom = rest.len() as f64 - count as f64;
    let squares: f64 = sums.iter().map(|(_, squares)| squares).sum();
    let taken = freedom.max(1.0) / (freedom - unknowns as f64).max(1.0);
    let all = squares / freedom.max(1.0);
    let factor = taken * correlation_time(rest);
    let sigma = |&(blocks, squares): &(f64, f64)| {
        (factor * (squares + PRIOR * all) / (blocks - 1.0 + PRIOR)).sqrt()
    };
    let sigma = sums.iter().map(sigma).collect();
    (sums.iter().map(|(blocks, _)| *blocks).collect(), sigma)
}

/// Values less their mean in each cell.
pub(super) fn within(values: &[f64], cell: &[usize], count: usize) -> Vec<f64> {
    let means = means(values, cell, count);
    let pairs = values.iter().zip(cell);
    pairs.map(|(x, &cell)| x - means[cell]).collect()
}

fn means(values: &[f64], cell: &[usize], count: usize) -> Vec<f64> {
    let mut sums = vec![(0.0, 0.0); count];
    for (x, &cell) in values.iter().zip(cell) {
        sums[cell].0 += x;
        sums[cell].1 += 1.0;
    }
    sums.into_iter().map(|(sum, n)| sum / n).collect()
}

/// Standard deviation of a weighted sum of the points.
pub(super) fn deviation(influence: &Mat<f64>, weight: impl Fn(usize) -> f64) -> f64 {
    let weights: Vec<f64> = (0..influence.ncols()).map(weight).collect();
    let moved = (0..influence.nrows()).map(|row| -> f64 {
        let pairs = weights.iter().enumerate();
        pairs.map(|(k, weight)| weight * influence[(row, k)]).sum()
    });
    norm(&moved.collect::<Vec<f64>>())
}

pub(super) fn norm(values: &[f64]) -> f64 {
    values.iter().map(|x| x * x).sum::<f64>().sqrt()
}

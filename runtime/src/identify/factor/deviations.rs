//! How sure an estimate from blocks is.

use faer::linalg::solvers::Solve;
use faer::{Mat, Side};

use super::Factor;
use super::estimate::residual;
use crate::calibrate::{NORMAL, quantile};
use crate::identify::least_squares::Solution;

/// A direction of which the other blocks tell less than this share is told by one block alone.
const LEAST_BESIDE: f64 = 0.1;

/// Shares of a parameter's variance that are in such directions: of one whose deviation is from all blocks, at most, and of one whose deviation
/// rests on a single one, at least.
const LITTLE: f64 = 0.01;
const MUCH: f64 = 0.1;

impl Factor {
    /// Standard deviations from how the estimate moves without each block, `(A - A_b)^-1 s_b` with the block's share `A_b` of the normal
    /// equations and what its own rows lack, `s_b`; with one block those for noise that is white. A deviation from `G` blocks is itself
    /// unsure: it is larger by Student's t of `G - 1` degrees of freedom over the normal distribution's, so that 1.96 of it hold the truth
    /// with 95 %, and from few blocks no smaller than that for white noise.
    ///
    /// What one block tells alone (eigenvectors of `A^-1 A_b` near 1) does not move with any other, `s_b` says nothing of it since `sum s_b` is
    /// zero. It has the deviation of white noise, times what that is too small by for parameters that many blocks tell. Those of whose
    /// variance a tenth and more is of that kind are the answer, all where nothing can be said of moves.
    ///
    /// Source: MacKinnon, Nielsen, Webb 2023, Fast and reliable jackknife and bootstrap methods for cluster-robust inference (CV3).
    pub(super) fn deviations(&self, solution: &mut Solution) -> Vec<usize> {
        let count = self.blocks.len();
        if count < 2 {
            return Vec::new();
        }
        let is_in = |c: &usize| solution.unexcited.binary_search(c).is_err();
        let excited: Vec<usize> = (0..self.unknowns.len()).filter(is_in).collect();
        let Some(Moved { squares, alone }) = self.moved(solution, &excited) else {
            return excited;
        };
        let freedom = count as f64 - 1.0;
        let correction = freedom / count as f64;
        let unsure = (quantile(freedom) / NORMAL).powi(2);
        let white: Vec<f64> = excited.iter().map(|&c| solution.std[c].powi(2)).collect();
        let of_others = squares.iter().zip(&white).zip(&alone);
        let larger = of_others
            .filter(|((_, white), alone)| **alone < LITTLE && **white > 0.0)
            .map(|((square, white), _)| correction * square / white)
            .fold(1.0, f64::max);
        for (k, &c) in excited.iter().enumerate() {
            let variance = unsure * (correction * squares[k] + alone[k] * larger * white[k]);
            let least = if count < Self::ENOUGH_BLOCKS {
                white[k]
            } else {
                0.0
            };
            solution.std[c] = variance.max(least).sqrt();
        }
        let lone = excited.iter().zip(&alone);
        lone.filter(|(_, alone)| **alone > MUCH)
            .map(|(&c, _)| c)
            .collect()
    }

    /// How far the excited unknowns move; none where their equations are too near to singular for that.
    fn moved(&self, solution: &Solution, excited: &[usize]) -> Option<Moved> {
        let size = excited.len();
        // Rows in units of the residuals' deviation, the last column what they lack.
        let rows = |block: &super::FactorBlock| -> Mat<f64> {
            let joints = solution.scale.iter().enumerate();
            let rows: Vec<(&Vec<f64>, f64)> = joints
                .flat_map(|(joint, scale)| {
                    block.whole.rows[joint].iter().map(move |row| (row, *scale))
                })
                .collect();
            Mat::from_fn(rows.len(), size + 1, |at, k| {
                let (row, scale) = rows[at];
                let value = excited.get(k).map(|&c| row[c]);
                value.unwrap_or_else(|| residual(row, &solution.estimate)) / scale
            })
        };
        let blocks: Vec<Mat<f64>> = self.blocks.iter().map(rows).collect();
        let r = triangle(&blocks, size)?;
        let inverse = r.partial_piv_lu().solve(Mat::<f64>::identity(size, size));
        let variance = |directions: &Mat<f64>, k: usize| directions.row(k).squared_norm_l2();
        let all: Vec<f64> = (0..size).map(|k| variance(&inverse, k)).collect();
        let (mut squares, mut alone) = (vec![0.0; size], vec![0.0; size]);
        for rows in &blocks {
            let columns = rows.subcols(0, size) * &inverse;
            let share = columns.transpose() * &columns;
            let eigen = share.self_adjoint_eigen(Side::Lower).ok()?;
            let directions = &inverse * eigen.U();
            let lacks = eigen.U().transpose() * (columns.transpose() * rows.col(size));
            let mut step = vec![0.0; size];
            for (i, own) in eigen.S().column_vector().iter().enumerate() {
                let beside = 1.0 - own;
                for k in 0..size {
                    if beside < LEAST_BESIDE {
                        alone[k] += directions[(k, i)].powi(2) / all[k];
                    } else {
                        step[k] += directions[(k, i)] * lacks[i] / beside;
                    }
                }
            }
            for (square, step) in squares.iter_mut().zip(&step) {
                *square += step * step;
            }
        }
        for alone in &mut alone {
            *alone = alone.min(1.0);
        }
        Some(Moved { squares, alone })
    }
}

/// One entry an excited unknown.
struct Moved {
    /// Sum of the squares of its moves.
    squares: Vec<f64>,
    /// Share of its variance for white noise in directions that one block alone tells.
    alone: Vec<f64>,
}

/// The triangular factor of all blocks' columns; none where a column is nothing.
fn triangle(blocks: &[Mat<f64>], size: usize) -> Option<Mat<f64>> {
    let count = blocks.iter().map(Mat::nrows).sum();
    let mut all = Mat::zeros(count, size);
    let mut first = 0;
    for rows in blocks {
        let mut place = all.submatrix_mut(first, 0, rows.nrows(), size);
        place.copy_from(rows.subcols(0, size));
        first += rows.nrows();
    }
    if count < size {
        return None;
    }
    let r = all.qr().thin_R().to_owned();
    (0..size).all(|k| r[(k, k)] != 0.0).then_some(r)
}

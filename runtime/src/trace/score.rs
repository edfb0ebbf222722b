//! How much of the residual a candidate's columns explain once every column of the model is projected out of them.

use crate::columns::{Candidate, Entry};
use crate::identify::{Stack, correlation_time};
use crate::signal::resample::whole_steps;

use statrs::distribution::{ContinuousCDF, FisherSnedecor};

use super::gram::Gram;
use super::normal::Normal;

/// A candidate's columns are called new only if this share of their norm is outside the model's columns.
const LEAST_NEW: f64 = 1e-3;

/// Length of a block that counts as one independent sample: so many correlation times of what the candidate leaves, and at
/// least this many seconds. Fewest blocks of a log, and for each parameter: a body has ten, and as many blocks would say nothing of them.
const BLOCK_CORRELATIONS: f64 = 4.0;
const BLOCK_S: f64 = 0.25;
const LEAST_BLOCKS: usize = 10;
const BLOCKS_OF_A_PARAMETER: usize = 4;

/// A candidate's score.
pub(super) struct Score {
    /// `F` statistic: `gain' S V^-1 S gain`, per parameter, scaled for the number of blocks.
    pub(super) f: f64,
    /// Probability of it or more where the candidate is not there.
    pub(super) p_value: f64,
    /// What the candidate leaves of the residual, `[joint][sample]`.
    pub(super) rest: Vec<Vec<f64>>,
}

/// The present model's fit, against which candidates are scored.
pub(super) struct Present<'a> {
    pub(super) stack: &'a Stack,
    pub(super) sigma: &'a [f64],
    pub(super) residuals: &'a [Vec<f64>],
    normal: Normal,
}

/// A candidate's columns without what the model can already say.
pub(super) struct Projected {
    /// Coefficients of least squares on the residual.
    pub(super) gain: Vec<f64>,
    /// Fall of the weighted sum of squares.
    pub(super) drop: f64,
    /// For each column of the candidate, the model's estimate changes by `-correction * gain`.
    corrections: Vec<Vec<f64>>,
    /// Products of the candidate's columns without what the model can already say.
    information: Vec<Vec<f64>>,
}

impl Projected {
    /// `|| Z (one - other) || / || Z other ||` of the projected columns.
    pub(super) fn distance(&self, one: &[f64], other: &[f64]) -> f64 {
        let change: Vec<f64> = one.iter().zip(other).map(|(a, b)| a - b).collect();
        (self.power(&change) / self.power(other).max(f64::MIN_POSITIVE)).sqrt()
    }

    /// Share of one column's own power in that of the whole effect.
    pub(super) fn power_share(&self, gain: &[f64], column: usize) -> f64 {
        self.information[column][column] * gain[column].powi(2)
            / self.power(gain).max(f64::MIN_POSITIVE)
    }

    /// How the model's estimate changes with the candidate beside it.
    pub(super) fn change(&self) -> Vec<f64> {
        let unknowns = self.corrections.first().map_or(0, Vec::len);
        let mut change = vec![0.0; unknowns];
        for (correction, gain) in self.corrections.iter().zip(&self.gain) {
            add(&mut change, -gain, correction);
        }
        change
    }

    /// Fall of the weighted sum of squares that a candidate makes with parameters of the signs that they may have: that of the best of its
    /// parts. Of candidates with many parameters, which have no signs, the fall itself.
    pub(super) fn admissible_drop(&self, candidate: &dyn Candidate) -> f64 {
        /// A law has no more.
        const MOST: usize = 4;
        let unknowns = candidate.unknowns();
        let is_free = unknowns.iter().all(|unknown| !unknown.nonnegative);
        if is_free || self.gain.len() > MOST {
            return self.drop;
        }
        let with_residual: Vec<f64> = self
            .information
            .iter()
            .map(|row| dot(row, &self.gain))
            .collect();
        let parts = 1..1_usize << self.gain.len();
        let drops = parts.filter_map(|part| {
            let columns: Vec<usize> = (0..self.gain.len())
                .filter(|c| (part >> c) & 1 == 1)
                .collect();
            let information: Vec<Vec<f64>> = columns
                .iter()
                .map(|&a| columns.iter().map(|&b| self.information[a][b]).collect())
                .collect();
            let right: Vec<f64> = columns.iter().map(|&c| with_residual[c]).collect();
            let gain = solve_symmetric(&information, &right);
            let mut signed = columns.iter().zip(&gain);
            let is_admissible = signed.all(|(&c, gain)| *gain >= 0.0 || !unknowns[c].nonnegative);
            is_admissible.then(|| dot(&gain, &right))
        });
        drops.fold(0.0, f64::max)
    }

    fn power(&self, gain: &[f64]) -> f64 {
        self.information
            .iter()
            .zip(gain)
            .map(|(row, g)| g * dot(row, gain))
            .sum::<f64>()
            .max(0.0)
    }
}

impl<'a> Present<'a> {
    pub(super) fn new(
        stack: &'a Stack,
        gram: &Gram,
        sigma: &'a [f64],
        residuals: &'a [Vec<f64>],
    ) -> Self {
        Self {
            stack,
            sigma,
            residuals,
            normal: gram.normal(sigma),
        }
    }

    /// Projects `count` columns; `None` where the model's columns already span them.
    pub(super) fn project(&self, entries: &[Entry], count: usize) -> Option<Projected> {
        let unknowns = self.stack.unknowns.len();
        let mut with_model = vec![vec![0.0; unknowns]; count];
        let mut with_residual = vec![0.0; count];
        let mut own = vec![vec![0.0; count]; count];
        for entry in entries {
            let weight = self.sigma[entry.joint].powi(-2);
            for (column, values) in &self.stack.joints[entry.joint].columns {
                with_model[entry.column][*column] += weight * dot(&entry.values, values);
            }
            with_residual[entry.column] +=
                weight * dot(&entry.values, &self.residuals[entry.joint]);
            for other in entries.iter().filter(|other| other.joint == entry.joint) {
                own[entry.column][other.column] += weight * dot(&entry.values, &other.values);
            }
        }
        let corrections: Vec<Vec<f64>> = with_model
            .iter()
            .map(|right| self.normal.apply(right))
            .collect();
        let mut left = own.clone();
        for a in 0..count {
            for b in 0..count {
                left[a][b] -= dot(&with_model[a], &corrections[b]);
            }
        }
        if !(0..count).any(|c| left[c][c] > LEAST_NEW.powi(2) * own[c][c]) {
            return None;
        }
        let gain = solve_symmetric(&left, &with_residual);
        let drop = dot(&gain, &with_residual);
        Some(Projected {
            gain,
            drop,
            corrections,
            information: left,
        })
    }

    /// Wald test of the candidate: `gain' S V^-1 S gain`, where `V` sums products of the scores of whole blocks of time, so
    /// that samples of one block do not count as independent. With `B` blocks and `p` parameters,
    /// `(B - p) / (p B)` times it is compared with `F(p, B - p)`.
    pub(super) fn score(&self, entries: &[Entry], projected: &Projected) -> Score {
        let count = projected.gain.len();
        let columns = self.projected_columns(entries, projected);
        let rest = self.without(&columns, projected);
        let touched = entries
            .iter()
            .map(|entry| correlation_time(&rest[entry.joint]));
        let least = LEAST_BLOCKS.max(BLOCKS_OF_A_PARAMETER * count);
        let blocks = self.blocks(touched.fold(1.0, f64::max), least);
        let mut information = vec![vec![0.0; count]; count];
        let mut variance = vec![vec![0.0; count]; count];
        for block in &blocks {
            let mut score = vec![0.0; count];
            for (joint, columns) in columns.iter().enumerate() {
                let weight = self.sigma[joint].powi(-2);
                for a in 0..count {
                    let column = &columns[a][block.clone()];
                    score[a] += weight * dot(column, &rest[joint][block.clone()]);
                    for b in 0..count {
                        information[a][b] += weight * dot(column, &columns[b][block.clone()]);
                    }
                }
            }
            for a in 0..count {
                for b in 0..count {
                    variance[a][b] += score[a] * score[b];
                }
            }
        }
        let moved: Vec<f64> = information
            .iter()
            .map(|row| dot(row, &projected.gain))
            .collect();
        let wald = dot(&moved, &solve_symmetric(&variance, &moved));
        let (parameters, blocks) = (count as f64, blocks.len() as f64);
        let f = (wald * (blocks - parameters) / (parameters * blocks)).max(0.0);
        let p_value = FisherSnedecor::new(parameters, blocks - parameters)
            .map_or(1.0, |distribution| distribution.sf(f));
        Score { f, p_value, rest }
    }

    /// What a candidate leaves of the residual, `[joint][sample]`.
    pub(super) fn rest(&self, entries: &[Entry], projected: &Projected) -> Vec<Vec<f64>> {
        self.without(&self.projected_columns(entries, projected), projected)
    }

    fn without(&self, columns: &[Vec<Vec<f64>>], projected: &Projected) -> Vec<Vec<f64>> {
        let residuals = columns.iter().zip(self.residuals);
        let without = |(columns, residual): (&Vec<Vec<f64>>, &Vec<f64>)| {
            let mut rest = residual.clone();
            for (column, gain) in columns.iter().zip(&projected.gain) {
                add(&mut rest, -gain, column);
            }
            rest
        };
        residuals.map(without).collect()
    }

    /// The candidate's columns less the model's, `[joint][column][sample]`.
    fn projected_columns(&self, entries: &[Entry], projected: &Projected) -> Vec<Vec<Vec<f64>>> {
        let count = projected.gain.len();
        let samples = self.stack.samples();
        (0..self.stack.dof())
            .map(|joint| {
                let mut columns = vec![vec![0.0; samples]; count];
                for entry in entries.iter().filter(|entry| entry.joint == joint) {
                    add(&mut columns[entry.column], 1.0, &entry.values);
                }
                for (c, values) in &self.stack.joints[joint].columns {
                    for (target, correction) in columns.iter_mut().zip(&projected.corrections) {
                        add(target, -correction[*c], values);
                    }
                }
                columns
            })
            .collect()
    }

    /// Blocks of neighboring rows, `least` of a log or more, that never cross from one log into another. `correlation` is a number of
    /// samples.
    fn blocks(&self, correlation: f64, least: usize) -> Vec<std::ops::Range<usize>> {
        let mut blocks = Vec::new();
        for segment in &self.stack.segments {
            let rows = segment.time.len();
            if rows < 2 {
                continue;
            }
            let seconds = segment.time[rows - 1] - segment.time[0];
            let length = BLOCK_S.max(BLOCK_CORRELATIONS * correlation * seconds / rows as f64);
            let count = whole_steps(seconds / length).max(least).min(rows);
            blocks.extend(
                (0..count).map(|b| {
                    segment.start + b * rows / count..segment.start + (b + 1) * rows / count
                }),
            );
        }
        blocks
    }
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(x, y)| x * y).sum()
}

fn add(target: &mut [f64], factor: f64, values: &[f64]) {
    if factor != 0.0 {
        for (t, v) in target.iter_mut().zip(values) {
            *t += factor * v;
        }
    }
}

/// Solves a small symmetric positive system; directions without information get 0.
fn solve_symmetric(matrix: &[Vec<f64>], right: &[f64]) -> Vec<f64> {
    let n = right.len();
    let scale: Vec<f64> = (0..n).map(|c| matrix[c][c].max(0.0).sqrt()).collect();
    let scaled = nalgebra::DMatrix::from_fn(n, n, |a, b| {
        if scale[a] > 0.0 && scale[b] > 0.0 {
            matrix[a][b] / (scale[a] * scale[b])
        } else {
            0.0
        }
    });
    let eigen = scaled.symmetric_eigen();
    let b = nalgebra::DVector::from_fn(n, |c, _| {
        if scale[c] > 0.0 {
            right[c] / scale[c]
        } else {
            0.0
        }
    });
    let mut along = eigen.eigenvectors.transpose() * b;
    for (value, eigenvalue) in along.iter_mut().zip(eigen.eigenvalues.iter()) {
        *value = if *eigenvalue > 1e-9 {
            *value / eigenvalue
        } else {
            0.0
        };
    }
    let solved = eigen.eigenvectors * along;
    (0..n)
        .map(|c| {
            if scale[c] > 0.0 {
                solved[c] / scale[c]
            } else {
                0.0
            }
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::columns::{Columns, Shape, Unknown};
    use crate::motion::Motion;

    struct Law([Unknown; 2]);

    impl Columns for Law {
        fn unknowns(&self) -> &[Unknown] {
            &self.0
        }

        fn shapes(&self) -> &[Shape] {
            &[]
        }

        fn uses_rigid_torque(&self) -> bool {
            false
        }

        fn entries(&self, _: &Motion, _: &[f64]) -> Vec<Entry> {
            Vec::new()
        }
    }

    impl Candidate for Law {
        fn kind(&self) -> &'static str {
            "law"
        }

        fn joints(&self) -> &[usize] {
            &[0]
        }
    }

    /// Columns `z` with products `[[2, 1], [1, 2]]`, of which least squares makes `[3, -1]`: with neither negative it is `[2.5, 0]`.
    #[test]
    fn a_law_explains_what_it_does_with_the_signs_that_it_may_have() {
        let law = |nonnegative: [bool; 2]| {
            Law(nonnegative.map(|nonnegative| Unknown {
                name: String::new(),
                nonnegative,
            }))
        };
        let projected = Projected {
            gain: vec![3.0, -1.0],
            drop: 14.0,
            corrections: Vec::new(),
            information: vec![vec![2.0, 1.0], vec![1.0, 2.0]],
        };
        let drop = |nonnegative| projected.admissible_drop(&law(nonnegative));
        for (signs, wanted) in [
            ([false, false], 14.0),
            ([true, false], 14.0),
            ([false, true], 12.5),
            ([true, true], 12.5),
        ] {
            assert!(
                (drop(signs) - wanted).abs() < 1e-9,
                "{signs:?}: {}",
                drop(signs)
            );
        }
    }

    #[test]
    fn a_direction_without_information_is_left_alone() {
        let x = solve_symmetric(&[vec![4.0, 4.0], vec![4.0, 4.0]], &[2.0, 2.0]);
        assert!((4.0 * (x[0] + x[1]) - 2.0).abs() < 1e-9, "{x:?}");
    }
}

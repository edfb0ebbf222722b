//! How much of the residual a candidate's columns explain once every column of the model is projected out of them.

use std::ops::Range;

use crate::columns::{Candidate, Entry};
use crate::identify::{Stack, correlation_time};
use crate::signal::resample::whole_steps;

use super::gram::Gram;
use super::jackknife::{self, Part};
use super::normal::Normal;
use super::projected::Projected;
use super::small::{add, directions, dot, solve_symmetric};
use super::wander;

/// A candidate's columns are called new only if this share of their norm is outside the model's columns.
const LEAST_NEW: f64 = 1e-3;

/// Length of a block that counts as one independent sample: so many correlation times of the products of column and what is left, and at
/// least this many seconds. Fewest blocks of a log, and for each parameter: a body has ten, and as many blocks would say nothing of them.
const BLOCK_CORRELATIONS: f64 = 4.0;
const BLOCK_S: f64 = 0.25;
const LEAST_BLOCKS: usize = 10;
const BLOCKS_OF_A_PARAMETER: usize = 4;

/// A candidate's score.
pub(super) struct Score {
    /// `F` statistic: `gain' S V^-1 S gain`, per direction, scaled for the number of blocks.
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

    /// The weighted sum of squares of a joint's residual.
    pub(super) fn power(&self, joint: usize) -> f64 {
        let residual = &self.residuals[joint];
        self.sigma[joint].powi(-2) * dot(residual, residual)
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
        // What is left of a column that the model spans is rounding, which has no gain and is no direction.
        let is_new = |c: usize| left[c][c] > LEAST_NEW.powi(2) * own[c][c];
        let new: Vec<bool> = (0..count).map(is_new).collect();
        if !new.contains(&true) {
            return None;
        }
        for (a, row) in left.iter_mut().enumerate() {
            for (b, value) in row.iter_mut().enumerate() {
                if !(new[a] && new[b]) {
                    *value = 0.0;
                }
            }
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

    /// Wald test of the candidate: `gain' S V^-1 S gain`, where `V` is the jackknife's over whole blocks of time ([`jackknife`]), so that
    /// samples of one block do not count as independent, and a gain that hangs on one block is worth nothing.
    ///
    /// Blocks are as long as the products of columns and what is left are correlated: a slow wander of the zero is next to nothing of a
    /// column that changes its sign with the motion. Where the scores of neighboring blocks are alike all the same, as they are of a
    /// column with a mean, blocks are longer. For a law of time they are as long as what is left is.
    pub(super) fn score(
        &self,
        candidate: &dyn Candidate,
        entries: &[Entry],
        projected: &Projected,
    ) -> Score {
        let count = projected.gain.len();
        let columns = self.projected_columns(entries, projected);
        let rest = self.without(&columns, projected);
        let products = (0..count).map(|c| self.products(&columns, &rest, c));
        let products: Vec<Vec<f64>> = products.collect();
        let correlations = products.iter().map(|products| correlation_time(products));
        let mut correlation = correlations.fold(1.0, f64::max);
        if candidate.is_of_time() {
            let touched = (0..rest.len()).filter(|j| entries.iter().any(|e| e.joint == *j));
            let of_rest = touched.map(|joint| correlation_time(&rest[joint]));
            correlation = of_rest.fold(correlation, f64::max);
        }
        let least = LEAST_BLOCKS.max(BLOCKS_OF_A_PARAMETER * count);
        let (blocks, scores) = self.block_scores(&products, correlation, least);

        // In directions of the columns that are new, of which there are `p`.
        let directions = directions(&projected.information, LEAST_NEW.powi(2));
        let along = |values: &[f64]| -> Vec<f64> {
            directions
                .iter()
                .map(|direction| dot(direction, values))
                .collect()
        };
        let moved = projected.information.iter();
        let moved: Vec<f64> = moved.map(|row| dot(row, &projected.gain)).collect();
        let moved = along(&moved);
        let both = |matrix: &[Vec<f64>]| jackknife::along(&directions, matrix);
        let parts = blocks.iter().zip(&scores).map(|(block, score)| Part {
            information: both(&self.information(&columns, block)),
            score: along(score),
        });
        // What a zero that walks makes of them.
        let walked = both(&self.walked(&columns, &rest));
        let parts: Vec<Part> = parts.collect();
        let test = jackknife::test(&both(&projected.information), &parts, &moved, &walked);
        let (f, p_value) = test.unwrap_or((0.0, 1.0));
        Score { f, p_value, rest }
    }

    /// Products of the columns' scores that walks of the torques' zeros make, weighed as scores are.
    fn walked(&self, columns: &[Vec<Vec<f64>>], rest: &[Vec<f64>]) -> Vec<Vec<f64>> {
        let count = columns.first().map_or(0, Vec::len);
        let mut sum = vec![vec![0.0; count]; count];
        for ((columns, rest), sigma) in columns.iter().zip(rest).zip(self.sigma) {
            let columns: Vec<&[f64]> = columns.iter().map(Vec::as_slice).collect();
            for segment in &self.stack.segments {
                let products = wander::products(segment, wander::walk(segment, rest), &columns);
                for (sum, products) in sum.iter_mut().zip(&products) {
                    add(sum, sigma.powi(-4), products);
                }
            }
        }
        sum
    }

    /// Products of the columns with each other in a block, weighed and summed over joints.
    fn information(&self, columns: &[Vec<Vec<f64>>], block: &Range<usize>) -> Vec<Vec<f64>> {
        let count = columns.first().map_or(0, Vec::len);
        let mut sum = vec![vec![0.0; count]; count];
        for (columns, sigma) in columns.iter().zip(self.sigma) {
            let weight = sigma.powi(-2);
            for (row, a) in sum.iter_mut().zip(columns) {
                for (entry, b) in row.iter_mut().zip(columns) {
                    *entry += weight * dot(&a[block.clone()], &b[block.clone()]);
                }
            }
        }
        sum
    }

    /// Blocks that are independent, and sums of products over them, `[block][column]`.
    fn block_scores(
        &self,
        products: &[Vec<f64>],
        mut correlation: f64,
        least: usize,
    ) -> (Vec<Range<usize>>, Vec<Vec<f64>>) {
        let mut count = usize::MAX;
        loop {
            let blocks = self.blocks(correlation, least);
            let sum = |block: &Range<usize>| -> Vec<f64> {
                let products = products.iter();
                products
                    .map(|products| products[block.clone()].iter().sum())
                    .collect()
            };
            let scores: Vec<Vec<f64>> = blocks.iter().map(sum).collect();
            let is_alike = (0..products.len()).any(|column| are_alike(&scores, column));
            if !is_alike || blocks.len() >= count {
                return (blocks, scores);
            }
            count = blocks.len();
            correlation *= 2.0;
        }
    }

    /// A column times what is left, weighed and summed over joints, sample by sample.
    fn products(&self, columns: &[Vec<Vec<f64>>], rest: &[Vec<f64>], column: usize) -> Vec<f64> {
        let mut products = vec![0.0; self.stack.samples()];
        for ((columns, rest), sigma) in columns.iter().zip(rest).zip(self.sigma) {
            let weight = sigma.powi(-2);
            let terms = columns[column].iter().zip(rest);
            let sums = products.iter_mut().zip(terms);
            sums.for_each(|(sum, (z, r))| *sum += weight * z * r);
        }
        products
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
    pub(super) fn projected_columns(
        &self,
        entries: &[Entry],
        projected: &Projected,
    ) -> Vec<Vec<Vec<f64>>> {
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

    /// Blocks of all logs, of equal lengths of about so many seconds, but no fewer and no more of them than in a range.
    pub(super) fn equal_blocks(&self, length: f64, counts: Range<usize>) -> Vec<Range<usize>> {
        let samples = self.stack.samples().max(1);
        let logs = self.stack.segments.iter();
        let seconds = logs.filter_map(|log| Some(log.time.last()? - log.time.first()?));
        let count = whole_steps(seconds.sum::<f64>() / length).clamp(counts.start, counts.end);
        let of_log = self.stack.segments.iter().flat_map(|segment| {
            let rows = segment.time.len();
            let count = (count * rows).div_ceil(samples).clamp(1, rows.max(1));
            let place = move |b: usize| segment.start + b * rows / count;
            (0..count).map(move |b| place(b)..place(b + 1))
        });
        of_log.collect()
    }

    /// The model's columns times the residual, weighed and summed over joints, `[block][column]`.
    pub(super) fn block_products(&self, blocks: &[Range<usize>]) -> Vec<Vec<f64>> {
        let of_block = |block: &Range<usize>| {
            let mut products = vec![0.0; self.stack.unknowns.len()];
            for (joint, rows) in self.stack.joints.iter().enumerate() {
                let weight = self.sigma[joint].powi(-2);
                let residual = &self.residuals[joint][block.clone()];
                for (column, values) in &rows.columns {
                    products[*column] += weight * dot(&values[block.clone()], residual);
                }
            }
            products
        };
        blocks.iter().map(of_block).collect()
    }

    /// Blocks of neighboring rows, `least` of a log or more, that never cross from one log into another. `correlation` is a number of
    /// samples.
    fn blocks(&self, correlation: f64, least: usize) -> Vec<Range<usize>> {
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

/// Whether a column's scores of neighboring blocks are alike, by more than independent ones are once in forty.
fn are_alike(scores: &[Vec<f64>], column: usize) -> bool {
    let of = |block: &Vec<f64>| block[column];
    let squares: f64 = scores.iter().map(|block| of(block).powi(2)).sum();
    let pairs = scores.windows(2);
    let products: f64 = pairs.map(|pair| of(&pair[0]) * of(&pair[1])).sum();
    products > 2.0 / (scores.len() as f64).sqrt() * squares
}

#[cfg(test)]
mod tests {
    use super::super::series::{segment, white};
    use super::*;
    use crate::columns::Unknown;
    use crate::identify::JointRows;

    /// Two columns, one of them the model's: rounding is no direction, and has no gain.
    #[test]
    fn a_column_of_the_model_has_no_gain() {
        const ROWS: u32 = 400;
        let (of_model, new, noise) = (white(ROWS, 1), white(ROWS, 2), white(ROWS, 3));
        let terms = of_model.iter().zip(&new).zip(&noise);
        let target: Vec<f64> = terms
            .map(|((m, z), e)| 2.0 * m + 0.5 * z + 0.1 * e)
            .collect();
        let stack = Stack {
            unknowns: vec![Unknown {
                name: "own".to_owned(),
                nonnegative: false,
            }],
            joints: vec![JointRows {
                tau: target.clone(),
                target,
                columns: vec![(0, of_model.clone())],
            }],
            segments: vec![segment(ROWS)],
            ..Stack::default()
        };
        let gain = dot(&stack.joints[0].target, &of_model) / dot(&of_model, &of_model);
        let (residuals, sigma) = (stack.residuals(&[gain]), [0.5]);
        let present = Present::new(&stack, &Gram::new(&stack, &[]), &sigma, &residuals);
        let spanned: Vec<f64> = of_model.iter().map(|value| 3.0 * value).collect();
        let entry = |column: usize, values: &[f64]| Entry {
            joint: 0,
            column,
            values: values.to_vec(),
        };
        let both = [entry(0, &spanned), entry(1, &new)];
        let projected = present.project(&both, 2).expect("one is new");
        assert!(projected.gain[0].abs() < 1e-12);
        assert!(
            (projected.gain[1] - 0.5).abs() < 0.03,
            "{:?}",
            projected.gain
        );
        let alone = present.project(&both[1..], 2).expect("it is new");
        assert!((projected.drop - alone.drop).abs() < 1e-9 * alone.drop);
        assert!(present.project(&both[..1], 1).is_none());
    }

    /// A column that wanders, and one that changes its sign from block to block.
    #[test]
    fn scores_that_wander_are_alike() {
        let slow = |k: u32| (0.2 * f64::from(k)).sin();
        let scores: Vec<Vec<f64>> = (0..60)
            .map(|k| vec![slow(k), if k % 2 == 0 { 1.0 } else { -1.0 }])
            .collect();
        assert!(are_alike(&scores, 0));
        assert!(!are_alike(&scores, 1));
    }
}

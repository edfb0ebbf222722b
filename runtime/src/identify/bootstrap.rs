//! Intervals without a formula: the logs are cut into blocks, which are drawn again and again.
//!
//! Each draw has as many blocks as the logs, some of them twice and some not at all, and an estimate of its own; how these spread is
//! how the estimate does. Blocks are as long as errors stay alike, so they are what is independent.
//!
//! Source: Carlstein 1986, The use of subseries values for estimating the variance of a general statistic from a stationary sequence;
//! Kuensch 1989, The jackknife and the bootstrap for general stationary observations.

use faer::linalg::solvers::Solve;
use faer::{Mat, Side};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

use super::IdentifyError;
use super::hac::{Rows, weighed};
use super::least_squares::Solution;
use super::stack::Stack;
use crate::calibrate::{NORMAL, quantile as quantile_of};
use crate::signal::resample::whole_steps;

/// Blocks are so many times as long as errors are alike; where there are few of them, half of that at least.
const LONG: f64 = 5.0;
const LEAST_LONG: f64 = 2.5;

/// Fewer blocks than this say nothing of a spread.
const LEAST_BLOCKS: usize = 6;

/// Most blocks: more say nothing more, and take longer.
const MOST_BLOCKS: usize = 200;

/// A draw whose least pivot is below this share of that of all blocks does not tell all, and the least share of draws that do.
const LEAST_PIVOT: f64 = 0.02;
const LEAST_SHARE: f64 = 0.9;

/// Of the middle of the draws.
const INSIDE: f64 = 0.95;

/// Intervals of a bootstrap.
///
/// # Examples
/// ```
/// # mod pendulum { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/doc/pendulum.rs")); }
/// # use pendulum::{measure, pendulum};
/// # use robot_model::identify::Identify;
/// let identify = Identify { bootstrap: 400, ..Identify::default() };
/// let estimate = identify.fit(&pendulum(), &[measure(0.0)])?;
/// let found = estimate.bootstrap.as_ref().expect("it was asked for");
/// for (interval, value) in found.intervals.iter().zip(estimate.values()) {
///     let [low, high] = interval.expect("the log tells all three");
///     assert!(low < value && value < high && high - low < 0.02 * value);
/// }
/// # Ok::<(), robot_model::identify::IdentifyError>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct Bootstrap {
    /// How often blocks were drawn.
    pub draws: usize,
    /// Blocks.
    pub blocks: usize,
    /// Per parameter the interval with 95 % of the draws; none where the logs do not tell the parameter.
    pub intervals: Vec<Option<[f64; 2]>>,
}

impl Bootstrap {
    /// Fewest draws: of fewer there are not a few outside of 95 %.
    pub const LEAST_DRAWS: u32 = 100;

    /// Widens the intervals of estimates as their deviations are.
    pub(super) fn widen(&mut self, estimate: &[f64], std: &[f64], widened: &[f64]) {
        for (k, ends) in self.intervals.iter_mut().enumerate() {
            let wider = if std[k] > 0.0 {
                widened[k] / std[k]
            } else {
                1.0
            };
            let center = estimate[k];
            *ends = ends.map(|ends| ends.map(|end| center + wider * (end - center)));
        }
    }
}

/// The sums of one block.
struct Block {
    information: Mat<f64>,
    score: Mat<f64>,
}

/// Intervals of a least-squares solution; `weights` are those of the rows' residuals.
pub(super) fn intervals(
    stack: &Stack,
    solution: &Solution,
    weights: &[Vec<f64>],
    draws: usize,
) -> Result<Bootstrap, IdentifyError> {
    let least = Bootstrap::LEAST_DRAWS as usize;
    if draws < least {
        return Err(IdentifyError::Draws { draws, least });
    }
    let residuals = stack.residuals(&solution.estimate);
    let alike = stack.correlation_times(&residuals);
    let alike = alike.into_iter().fold(1.0, f64::max);
    let samples = stack.samples();
    let count = samples as f64 / (LONG * alike);
    if samples as f64 / (LEAST_LONG * alike) < LEAST_BLOCKS as f64 {
        return Err(IdentifyError::FewBlocks {
            blocks: LEAST_BLOCKS,
            samples: LEAST_LONG * alike,
            rows: samples,
        });
    }
    let count = whole_steps(count).clamp(LEAST_BLOCKS, MOST_BLOCKS);
    let rows = Rows::new(stack, &solution.unexcited, &solution.scale);
    let residuals = weighed(residuals, &solution.scale, weights);
    let blocks = blocks(&rows, &residuals, weights, count);
    let size = rows.excited.len();
    let mut random = ChaCha8Rng::seed_from_u64(0);
    let mut moves: Vec<Vec<f64>> = vec![Vec::with_capacity(draws); size];
    let whole = whole_pivots(&blocks, size);
    let correction = small_sample(count, samples as f64 / alike, size);
    for _ in 0..draws {
        let mut information = Mat::<f64>::zeros(size, size);
        let mut score = Mat::<f64>::zeros(size, 1);
        for _ in 0..count {
            let block = &blocks[random.random_range(0..count)];
            information += &block.information;
            score += &block.score;
        }
        let Some(step) = step(&information, &score, &whole) else {
            // Blocks without which not all is told.
            continue;
        };
        for (k, moves) in moves.iter_mut().enumerate() {
            moves.push(correction * step[k] / rows.length[k]);
        }
    }
    let made = moves.first().map_or(0, Vec::len);
    if (made as f64) < LEAST_SHARE * draws as f64 {
        return Err(IdentifyError::FewDraws { draws, made });
    }
    let mut intervals = vec![None; stack.unknowns.len()];
    for (k, &c) in rows.excited.iter().enumerate() {
        moves[k].sort_unstable_by(f64::total_cmp);
        let cut = 0.5 * (1.0 - INSIDE);
        intervals[c] =
            Some([cut, 1.0 - cut].map(|share| solution.estimate[c] + quantile(&moves[k], share)));
    }
    Ok(Bootstrap {
        draws: made,
        blocks: count,
        intervals,
    })
}

/// How much too narrow the middle of the draws is: about the mean of as many draws with replacement by one block, of few blocks as a normal
/// distribution beside Student's, and by what the unknowns have taken of the residuals.
fn small_sample(blocks: usize, independent: f64, unknowns: usize) -> f64 {
    let freedom = (blocks - 1) as f64;
    let student = quantile_of(freedom) / NORMAL;
    let left = (independent - unknowns as f64).max(1.0);
    (blocks as f64 / freedom * independent / left).sqrt() * student
}

/// Pivots of the information of all blocks.
fn whole_pivots(blocks: &[Block], size: usize) -> Vec<f64> {
    let zero = Mat::<f64>::zeros(size, size);
    let whole = blocks
        .iter()
        .fold(zero, |sum, block| sum + &block.information);
    let factor = whole.llt(Side::Lower);
    let pivot = |k: usize| {
        factor
            .as_ref()
            .map_or(0.0, |factor| factor.L()[(k, k)].powi(2))
    };
    (0..size).map(pivot).collect()
}

/// `A^-1 b`, or none where a pivot is next to nothing beside that of all blocks.
fn step(information: &Mat<f64>, score: &Mat<f64>, whole: &[f64]) -> Option<Vec<f64>> {
    let factor = information.llt(Side::Lower).ok()?;
    let pivots = whole.iter().enumerate();
    let mut pivots = pivots.map(|(k, whole)| (factor.L()[(k, k)].powi(2), LEAST_PIVOT * whole));
    let is_told = pivots.all(|(pivot, least)| pivot > least);
    let step = factor.solve(score);
    let step: Vec<f64> = (0..whole.len()).map(|k| step[(k, 0)]).collect();
    (is_told && step.iter().all(|x| x.is_finite())).then_some(step)
}

/// Sums over blocks of alike length.
fn blocks(rows: &Rows, residuals: &[Vec<f64>], weights: &[Vec<f64>], count: usize) -> Vec<Block> {
    let samples = rows.joints.first().map_or(0, Mat::nrows);
    let size = rows.excited.len();
    let of = |b: usize| {
        let (start, end) = (b * samples / count, (b + 1) * samples / count);
        let mut information = Mat::<f64>::zeros(size, size);
        let mut score = Mat::<f64>::zeros(size, 1);
        for ((rows, residuals), weights) in rows.joints.iter().zip(residuals).zip(weights) {
            let part = rows.subrows(start, end - start);
            // Where a residual is cut off, it does not answer to the estimate.
            let full = |k: usize| f64::from(u8::from(weights[start + k] >= 1.0));
            let weighed = Mat::from_fn(end - start, size, |k, c| full(k) * part[(k, c)]);
            let rest = Mat::from_fn(end - start, 1, |k, _| residuals[start + k]);
            information += weighed.transpose() * part;
            score += part.transpose() * rest;
        }
        Block { information, score }
    };
    (0..count).map(of).collect()
}

/// Of ascending values, linearly between them.
fn quantile(values: &[f64], share: f64) -> f64 {
    let at = share * (values.len() - 1) as f64;
    let low = whole_steps(at).min(values.len() - 1);
    let high = (low + 1).min(values.len() - 1);
    values[low] + (at - low as f64) * (values[high] - values[low])
}

#[cfg(test)]
mod tests;

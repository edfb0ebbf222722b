//! Laws that come and go: do they come and go when they say?
//!
//! A torque's zero that wanders passes for a force that is there for a while, but it goes everywhere, and a contact sets in and ends at once.
//! So a law of time has to explain what its edges do: columns and residual, less their means over a second before and after. How much the
//! same edges explain at all other times of what is left tells what chance makes of it, whatever the noise is correlated over.

use statrs::distribution::{ContinuousCDF, FisherSnedecor};

use crate::identify::Segment;
use crate::signal::resample::whole_steps;

use super::projected::Projected;
use super::score::Present;
use super::search::is_of_phase;
use super::small::{add, dot, solve_symmetric};
use super::trial::{Presence, Trial};

/// Means are of so long a time before and after a row, s: a contact sets in within less, a zero wanders over more.
const MEAN_S: f64 = 1.0;

/// Edges are moved by so much, s.
const STEP_S: f64 = 0.1;

impl Present<'_> {
    /// Probability that what is left makes as much of a law's edges somewhere else, where it comes and goes in time; else next to none. What
    /// comes back in every period is judged by that.
    pub(super) fn chance_of_edges(&self, trial: &Trial, projected: &Projected) -> f64 {
        if trial.presence != Presence::ComesAndGoes || is_of_phase(trial.candidate) {
            return 0.0;
        }
        let columns = self.projected_columns(&trial.entries, projected);
        chance(&self.stack.segments, self.sigma, &columns, self.residuals)
    }
}

/// Probability that what is left makes as much of a law's edges somewhere else. `columns` are the law's, `[joint][column][sample]`, and
/// `residuals` the model's without it.
pub(super) fn chance(
    segments: &[Segment],
    sigma: &[f64],
    columns: &[Vec<Vec<f64>>],
    residuals: &[Vec<f64>],
) -> f64 {
    let weights: Vec<f64> = sigma.iter().map(|sigma| sigma.powi(-2)).collect();
    let quick = |values: &Vec<f64>| quick(segments, values);
    let columns = columns.iter().map(|of| of.iter().map(quick).collect());
    let columns: Vec<Vec<Vec<f64>>> = columns.collect();
    let mut rest: Vec<Vec<f64>> = residuals.iter().map(quick).collect();
    let count = columns.first().map_or(0, Vec::len);

    let mut information = vec![vec![0.0; count]; count];
    let mut score = vec![0.0; count];
    for ((columns, rest), weight) in columns.iter().zip(&rest).zip(&weights) {
        for ((line, score), a) in information.iter_mut().zip(&mut score).zip(columns) {
            let products: Vec<f64> = columns.iter().map(|b| dot(a, b)).collect();
            add(line, *weight, &products);
            *score += weight * dot(a, rest);
        }
    }
    let gain = solve_symmetric(&information, &score);
    for (columns, rest) in columns.iter().zip(&mut rest) {
        for (column, gain) in columns.iter().zip(&gain) {
            add(rest, -gain, column);
        }
    }

    let mut variance = vec![vec![0.0; count]; count];
    let mut seconds = 0.0;
    for segment in segments.iter().filter(|segment| segment.time.len() > 1) {
        let rows = segment.time.len();
        let shifts: Vec<usize> = (0..rows).step_by(rows_in(segment, STEP_S)).collect();
        seconds += length(segment);
        for shift in &shifts {
            let elsewhere = score_elsewhere(segment, *shift, &weights, &columns, &rest);
            for (line, a) in variance.iter_mut().zip(&elsewhere) {
                add(line, a / shifts.len() as f64, &elsewhere);
            }
        }
    }
    let wald = dot(&score, &solve_symmetric(&variance, &score));
    let (parameters, blocks) = (count as f64, (seconds / MEAN_S).floor());
    let f = (wald * (blocks - parameters) / (parameters * blocks)).max(0.0);
    FisherSnedecor::new(parameters, blocks - parameters).map_or(1.0, |law| law.sf(f))
}

/// Scores of a log's columns that are moved by so many rows, what goes beyond the end to its beginning.
fn score_elsewhere(
    segment: &Segment,
    shift: usize,
    weights: &[f64],
    columns: &[Vec<Vec<f64>>],
    rest: &[Vec<f64>],
) -> Vec<f64> {
    let rows = segment.start..segment.start + segment.time.len();
    let turned = segment.start + shift;
    let mut score = vec![0.0; columns.first().map_or(0, Vec::len)];
    for ((columns, rest), weight) in columns.iter().zip(rest).zip(weights) {
        for (score, column) in score.iter_mut().zip(columns) {
            let (first, last) = column[rows.clone()].split_at(rows.end - turned);
            *score += weight * dot(first, &rest[turned..rows.end]);
            *score += weight * dot(last, &rest[rows.start..turned]);
        }
    }
    score
}

/// Values less their means over a second before and after.
fn quick(segments: &[Segment], values: &[f64]) -> Vec<f64> {
    let mut quick = vec![0.0; values.len()];
    for segment in segments {
        let rows = segment.time.len();
        let own = &values[segment.start..segment.start + rows];
        let mut sums = vec![0.0];
        sums.extend(own.iter().scan(0.0, |sum, value| {
            *sum += value;
            Some(*sum)
        }));
        let reach = rows_in(segment, MEAN_S);
        for (row, value) in own.iter().enumerate() {
            let (from, to) = (row.saturating_sub(reach), (row + reach + 1).min(rows));
            quick[segment.start + row] = value - (sums[to] - sums[from]) / (to - from) as f64;
        }
    }
    quick
}

fn length(segment: &Segment) -> f64 {
    let ends = segment.time.first().zip(segment.time.last());
    ends.map_or(0.0, |(first, last)| last - first)
}

/// Rows of a log in so much time, one at least.
fn rows_in(segment: &Segment, seconds: f64) -> usize {
    let rows = segment.time.len() as f64;
    whole_steps(seconds * rows / length(segment).max(f64::MIN_POSITIVE))
        .clamp(1, segment.time.len().max(1))
}

#[cfg(test)]
mod tests {
    use super::super::series::{HZ, segment, white};
    use super::*;

    const ROWS: u32 = 1200;

    /// A zero that wanders within 5 s, with white noise on it.
    fn wandering(seed: u32) -> Vec<f64> {
        let mut zero = 0.0;
        let steps = white(ROWS, seed).into_iter().zip(white(ROWS, seed + 100));
        let wander = steps.map(|(step, noise)| {
            zero += step / HZ.sqrt() - zero / (5.0 * HZ);
            zero + 0.1 * noise
        });
        wander.collect()
    }

    /// A force from 8 to 14 s.
    fn window() -> Vec<f64> {
        let is_there = |k: u32| (8.0..14.0).contains(&(f64::from(k) / HZ));
        (0..ROWS)
            .map(|k| f64::from(u8::from(is_there(k))))
            .collect()
    }

    fn chance_of(residual: Vec<f64>) -> f64 {
        chance(&[segment(ROWS)], &[1.0], &[vec![window()]], &[residual])
    }

    #[test]
    fn a_zero_that_wanders_has_no_edges() {
        let likely = (0..40)
            .filter(|&seed| chance_of(wandering(seed)) < 0.01)
            .count();
        assert!(likely <= 2, "{likely} of 40");
    }

    #[test]
    fn what_sets_in_and_ends_at_once_has_edges() {
        for seed in 0..10 {
            let force = window().into_iter().map(|there| 6.0 * there);
            let residual: Vec<f64> = wandering(seed)
                .into_iter()
                .zip(force)
                .map(|(w, f)| w + f)
                .collect();
            let chance = chance_of(residual);
            assert!(chance < 1e-5, "{seed}: {chance}");
        }
    }

    #[test]
    fn means_are_of_a_second_before_and_after() {
        let straight: Vec<f64> = (0..ROWS).map(|k| 3.0 + 0.01 * f64::from(k)).collect();
        let quick = quick(&[segment(ROWS)], &straight);
        assert!(quick[40..1160].iter().all(|x| x.abs() < 1e-9));
    }
}

//! Values that stand still while the arm moves on.

use std::ops::Range;

use super::Steps;
use crate::signal::resample::whole_steps;

/// Fewest samples of a hold: shorter ones are within what filters smooth.
const FEWEST: usize = 4;

/// Samples before and behind whose steps say whether the channel moves.
pub(super) const NEAR: usize = 6;

/// By how many of those steps the channel has moved on behind a hold, and by how many times what the sensor resolves.
pub(super) const JUMP: f64 = 3.0;
pub(super) const RESOLVED: f64 = 4.0;

/// Share of the typical step from which on a channel moves.
pub(super) const MOVES: f64 = 0.2;

/// How many holds that chance makes of a torque in coarse steps are told in a log, at most.
const BY_CHANCE: f64 = 0.01;

/// Ranges of samples of a position that repeat the one before them. What stands at the largest or smallest value of all is at a limit.
pub(super) fn of_position(values: &[f64]) -> Vec<Range<usize>> {
    find(values, &Steps::of(values), FEWEST)
}

/// Ranges of samples of a torque that repeat the one before them while the joint's position moves on.
pub(super) fn of_torque(values: &[f64], position: &[f64]) -> Vec<Range<usize>> {
    let steps = Steps::of(values);
    let mut found = find(values, &steps, FEWEST.max(by_chance(&steps.sizes)));
    let travels = Steps::of(position);
    found.retain(|range| {
        let way = (position[range.end] - position[range.start - 1]).abs();
        let usual = MOVES * travels.typical * range.len() as f64;
        way > usual.max(RESOLVED * travels.quantum)
    });
    found
}

/// How many repeats are more than chance: of a channel that repeats itself in a share `p`, `n p^L` runs of `L` are chance.
pub(super) fn by_chance(steps: &[f64]) -> usize {
    let still = steps.iter().filter(|step| **step == 0.0).count();
    let count = steps.len().max(1) as f64;
    let share = still as f64 / count;
    if share > 0.0 {
        whole_steps(((BY_CHANCE / count).ln() / share.ln()).ceil())
    } else {
        0
    }
}

pub(super) fn mean(steps: &[f64]) -> f64 {
    steps.iter().sum::<f64>() / steps.len().max(1) as f64
}

fn find(values: &[f64], steps: &Steps, fewest: usize) -> Vec<Range<usize>> {
    let sizes = &steps.sizes;
    let mut found = Vec::new();
    let mut k = 0;
    while k < sizes.len() {
        if sizes[k] > 0.0 {
            k += 1;
            continue;
        }
        let start = k;
        while k < sizes.len() && sizes[k] == 0.0 {
            k += 1;
        }
        // Samples `start + 1 ..= k` repeat sample `start`; step `k` leads away from them.
        let held = start + 1..k + 1;
        let is_inside = start >= NEAR && k + NEAR < sizes.len();
        if held.len() < fewest || !is_inside || steps.is_limit(values[start]) {
            continue;
        }
        let around = mean(&sizes[start - NEAR..start]).max(mean(&sizes[k + 1..k + 1 + NEAR]));
        let jump = sizes[k];
        let moves = around > MOVES * steps.typical;
        if moves && jump > JUMP * around && jump > RESOLVED * steps.quantum {
            found.push(held);
        }
    }
    found
}

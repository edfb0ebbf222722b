//! Values that stand still while the arm moves on.

use std::ops::Range;

use super::{moved, quantile, quantum, steps};
use crate::signal::resample::whole_steps;

/// Fewest samples of a hold: shorter ones are within what filters smooth.
const FEWEST: usize = 4;

/// Samples before and behind whose steps say whether the channel moves.
const NEAR: usize = 6;

/// By how many of those steps the channel has moved on behind a hold, and by how many times what the sensor resolves.
const JUMP: f64 = 3.0;
const RESOLVED: f64 = 4.0;

/// Share of the typical step from which on a channel moves.
const MOVES: f64 = 0.2;

/// How many holds that chance makes of a torque in coarse steps are told in a log, at most.
const BY_CHANCE: f64 = 0.01;

/// Ranges of samples of a position that repeat the one before them. What stands at the largest or smallest value of all is at a limit.
pub(super) fn of_position(values: &[f64]) -> Vec<Range<usize>> {
    find(values, FEWEST)
}

/// Ranges of samples of a torque that repeat the one before them while the joint's position moves on.
pub(super) fn of_torque(values: &[f64], position: &[f64]) -> Vec<Range<usize>> {
    let all = steps(values);
    let still = all.iter().filter(|step| **step == 0.0).count();
    // Of a channel that repeats itself in a share `p`, `n p^L` runs of `L` are chance.
    let share = still as f64 / all.len().max(1) as f64;
    let count = all.len().max(1) as f64;
    let fewest = if share > 0.0 {
        (BY_CHANCE / count).ln() / share.ln()
    } else {
        0.0
    };
    let mut found = find(values, FEWEST.max(whole_steps(fewest.ceil())));
    let travels = steps(position);
    let quantum = quantum(&travels);
    let typical = quantile(moved(&travels), 0.5);
    found.retain(|range| {
        let way = (position[range.end] - position[range.start - 1]).abs();
        way > (MOVES * typical * range.len() as f64).max(RESOLVED * quantum)
    });
    found
}

fn find(values: &[f64], fewest: usize) -> Vec<Range<usize>> {
    let steps = steps(values);
    let quantum = quantum(&steps);
    let typical = quantile(moved(&steps), 0.5);
    let mean = |range: Range<usize>| {
        let count = range.len().max(1) as f64;
        steps[range].iter().sum::<f64>() / count
    };
    let high = values.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    let low = values.iter().copied().fold(f64::INFINITY, f64::min);
    let is_limit = |value: f64| value >= high || value <= low;
    let mut found = Vec::new();
    let mut k = 0;
    while k < steps.len() {
        if steps[k] > 0.0 {
            k += 1;
            continue;
        }
        let start = k;
        while k < steps.len() && steps[k] == 0.0 {
            k += 1;
        }
        // Samples `start + 1 ..= k` repeat sample `start`; step `k` leads away from them.
        let held = start + 1..k + 1;
        let is_inside = start >= NEAR && k + NEAR < steps.len();
        if held.len() < fewest || !is_inside || is_limit(values[start]) {
            continue;
        }
        let around = mean(start - NEAR..start).max(mean(k + 1..k + 1 + NEAR));
        let jump = steps[k];
        let moves = around > MOVES * typical && around > 0.0;
        if moves && jump > JUMP * around && jump > RESOLVED * quantum {
            found.push(held);
        }
    }
    found
}

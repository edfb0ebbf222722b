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

/// Of a log: where a torque stands for more of it in all, it stands by what drives it.
const RARE: f64 = 0.1;

/// How many holds that chance makes of a torque in coarse steps are told in a log, at most.
const BY_CHANCE: f64 = 0.01;

/// Ranges of samples of a position that repeat the one before them. What stands at the largest or smallest value of all is at a limit.
pub(super) fn of_position(values: &[f64]) -> Vec<Range<usize>> {
    find(values, &Steps::of(values), FEWEST)
}

/// Ranges of samples of a torque that repeat the one before them while the joint's position moves on.
pub(super) fn of_torque(values: &[f64], position: &[f64]) -> Vec<Range<usize>> {
    let steps = Steps::of(values);
    let fewest = FEWEST.max(by_chance(&steps.sizes));
    let mut found = find(values, &steps, fewest);
    found.extend(frozen(values, &steps, fewest));
    found.sort_by_key(|range| range.start);
    found.dedup();
    let travels = Steps::of(position);
    found.retain(|range| moves_on(position, &travels, range));
    found
}

/// Whether a joint moves within samples, wherever it is behind them.
pub(super) fn moves_on(position: &[f64], travels: &Steps, range: &Range<usize>) -> bool {
    let within = &position[range.start - 1..=range.end];
    let high = within.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    let low = within.iter().copied().fold(f64::INFINITY, f64::min);
    let usual = MOVES * travels.typical * range.len() as f64;
    high - low > usual.max(RESOLVED * travels.quantum)
}

/// Ranges that repeat the sample before them more often than chance does, amid samples that change by much more than the sensor resolves, and on
/// either side by more than that: noise does not stand still, wherever the channel is behind them. None where it stands so for much of the
/// log, as a torque in stairs does.
fn frozen(values: &[f64], steps: &Steps, fewest: usize) -> Vec<Range<usize>> {
    let sizes = &steps.sizes;
    let least = (MOVES * steps.typical).max(RESOLVED * steps.quantum);
    let mut found = Vec::new();
    let mut start = 0;
    for run in sizes.chunk_by(|a, b| (*a == 0.0) == (*b == 0.0)) {
        let still = start..start + run.len();
        start = still.end;
        if run[0] > 0.0
            || run.len() < fewest
            || still.start < NEAR
            || still.end + NEAR > sizes.len()
        {
            continue;
        }
        let before = mean(&sizes[still.start - NEAR..still.start]);
        let behind = mean(&sizes[still.end..still.end + NEAR]);
        let value = values[still.start];
        let is_amid = before.midpoint(behind) > least && before.min(behind) > steps.quantum;
        if is_amid && (value == 0.0 || !steps.is_limit(value)) {
            found.push(still.start + 1..still.end + 1);
        }
    }
    let all: usize = found.iter().map(ExactSizeIterator::len).sum();
    if all as f64 > RARE * values.len() as f64 {
        found.clear();
    }
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

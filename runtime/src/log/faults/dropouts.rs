//! Constants to which a channel jumps, and from which it jumps back.

use std::ops::Range;

use super::Steps;
use super::held::{JUMP, MOVES, NEAR, RESOLVED, by_chance, mean, moves_on};

/// Fewest samples of a dropout: shorter ones are spikes.
const FEWEST: usize = 4;

/// A jump is so many times the largest step before and behind.
const BEYOND: f64 = 2.0;

/// No brake closes, and opens again, within this time, s: for so long a torque may drop out at rest, and for longer only while its joint moves.
const BRAKE_S: f64 = 0.1;

/// Ranges of samples of a position. Where a joint rests, its position jumps no less than that of a spike.
pub(super) fn of_position(values: &[f64]) -> Vec<Range<usize>> {
    let steps = Steps::of(values);
    let is_fault = |one: &Excursion| {
        let is_far = one.jump > steps.steep();
        is_far || one.moves && !steps.is_limit(one.value)
    };
    find(values, &steps, FEWEST, is_fault)
}

/// Ranges of samples of a torque: more than chance repeats of it, among samples that change. A square wave has no such, and at its largest
/// value a torque is at a limit, unless that is zero. A drive that is switched off between moves has no torque while a brake holds the joint.
pub(super) fn of_torque(values: &[f64], position: &[f64], rate_hz: f64) -> Vec<Range<usize>> {
    let steps = Steps::of(values);
    let is_fault = |one: &Excursion| one.moves && (one.value == 0.0 || !steps.is_limit(one.value));
    let fewest = FEWEST.max(by_chance(&steps.sizes));
    let mut found = find(values, &steps, fewest, is_fault);
    let travels = Steps::of(position);
    // A torque that holds a joint at rest may be as constant as it likes.
    found.retain(|range| {
        let is_off = values[range.start] == 0.0 && range.len() as f64 <= BRAKE_S * rate_hz;
        is_off || moves_on(position, &travels, range)
    });
    found
}

/// Samples that stand still between two jumps.
struct Excursion {
    value: f64,
    /// The smaller of the jumps.
    jump: f64,
    /// Whether the channel moves before or behind.
    moves: bool,
}

fn find(
    values: &[f64],
    steps: &Steps,
    fewest: usize,
    is_fault: impl Fn(&Excursion) -> bool,
) -> Vec<Range<usize>> {
    let mut found = Vec::new();
    let mut end = 0;
    for run in values.chunk_by(|x, y| (x - y).abs() == 0.0) {
        let range = end..end + run.len();
        end = range.end;
        let is_inside = range.start > NEAR && range.end + NEAR < values.len();
        if run.len() < fewest || !is_inside {
            continue;
        }
        let value = run[0];
        let into = value - values[range.start - 1];
        let out = values[range.end] - value;
        // Step `k` leads from sample `k` to the next: both jumps are left out.
        let before = &steps.sizes[range.start - 1 - NEAR..range.start - 1];
        let behind = &steps.sizes[range.end..range.end + NEAR];
        let around = mean(before).max(mean(behind));
        let largest = before.iter().chain(behind).copied().fold(0.0, f64::max);
        let one = Excursion {
            value,
            jump: into.abs().min(out.abs()),
            moves: around > MOVES * steps.typical,
        };
        // What stands between two spikes of a joint at rest is no dropout.
        let is_jump =
            one.jump > (JUMP * around).max(BEYOND * largest) && one.jump > RESOLVED * steps.quantum;
        if into * out < 0.0 && is_jump && is_fault(&one) {
            found.push(range);
        }
    }
    found
}

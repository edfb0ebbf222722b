//! Values that stand still while the arm moves on.

use std::ops::Range;

use super::{quantile, quantum, steps};

/// Fewest samples of a hold: shorter ones are within what filters smooth.
const FEWEST: usize = 4;

/// Samples before and behind whose steps say whether the channel moves.
const NEAR: usize = 6;

/// By how many of those steps the channel has moved on behind a hold, and by how many times what the sensor resolves.
const JUMP: f64 = 3.0;
const RESOLVED: f64 = 4.0;

/// Share of the typical step from which on a channel moves.
const MOVES: f64 = 0.2;

/// Ranges of samples that repeat the one before them; none where more than `often` of all samples do, as those of a drive that
/// resolves little. What stands at the largest or smallest value of all is at a limit.
pub(super) fn find(values: &[f64], often: f64) -> Vec<Range<usize>> {
    let steps = steps(values);
    let quantum = quantum(&steps);
    let moved: Vec<f64> = steps.iter().copied().filter(|step| *step > 0.0).collect();
    if ((steps.len() - moved.len()) as f64) > often * steps.len() as f64 {
        return Vec::new();
    }
    let typical = quantile(moved, 0.5);
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
        if held.len() < FEWEST || !is_inside || is_limit(values[start]) {
            continue;
        }
        let around = mean(start - NEAR..start).min(mean(k + 1..k + 1 + NEAR));
        let jump = steps[k];
        let moves = around > MOVES * typical && around > 0.0;
        if moves && jump > JUMP * around && jump > RESOLVED * quantum {
            found.push(held);
        }
    }
    found
}

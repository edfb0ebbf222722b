//! Stretches that jump away from what is around them, and soon jump back.
//!
//! Dry friction that turns round jumps once, and stays. A drive may push for so short a time, but then the joint is faster behind it.

use std::collections::BTreeMap;
use std::ops::Range;

use super::{Steps, quantile};

/// Fewest and most samples, and most seconds, of a burst: shorter ones are spikes.
const FEWEST: usize = 4;
const MOST: usize = 20;
const LONGEST_S: f64 = 0.05;

/// Its jumps are so many times a steep step, and no other such jump is within as many samples before and behind, and twice its length.
const BEYOND: f64 = 2.0;
const APART: usize = 20;

/// Fewest samples that a speed is taken of, and how many times the usual change of speed one is that a push makes.
const REACH: usize = 10;
const PUSHED: f64 = 8.0;

/// Ranges of samples of a position.
pub(super) fn of_position(values: &[f64], rate_hz: f64) -> Vec<Range<usize>> {
    let steps = Steps::of(values);
    if steps.quantum == 0.0 {
        return Vec::new();
    }
    let steep = BEYOND * steps.steep();
    let sizes = steps.sizes.iter().enumerate();
    let jumps: Vec<usize> = sizes
        .filter(|(_, size)| **size > steep)
        .map(|(k, _)| k)
        .collect();
    let pairs = jumps.windows(2).enumerate();
    let found = pairs.filter_map(|(place, pair)| {
        // A jump at `k` leads from sample `k` to the next.
        let (away, back) = (pair[0], pair[1]);
        let range = away + 1..back + 1;
        let apart = APART + 2 * range.len();
        let is_alone = place.checked_sub(1).is_none_or(|k| jumps[k] + apart < away)
            && jumps.get(place + 2).is_none_or(|next| back + apart < *next);
        let is_short =
            (FEWEST..=MOST).contains(&range.len()) && range.len() as f64 <= LONGEST_S * rate_hz;
        (is_alone && is_short && is_away(values, &range)).then_some(range)
    });
    found.collect()
}

/// Ranges of samples of a torque of which the joint's position knows nothing.
pub(super) fn of_torque(values: &[f64], position: &[f64], rate_hz: f64) -> Vec<Range<usize>> {
    let found = of_position(values, rate_hz);
    if found.is_empty() {
        return found;
    }
    let mut pushes = Pushes::of(position);
    let pushes = found.iter().map(|range| pushes.across(range)).collect();
    // As one all of them are the drive's, or none is: now and then a joint turns round beside a burst.
    if quantile(pushes, 0.5) > PUSHED {
        return Vec::new();
    }
    found
}

/// Whether all samples are on the same side of both neighbors, further from them than these are from each other, and than half of a jump.
fn is_away(values: &[f64], range: &Range<usize>) -> bool {
    let (before, behind) = (values[range.start - 1], values[range.end]);
    let inside = &values[range.clone()];
    let (first, last) = (inside[0], inside[inside.len() - 1]);
    let jump = (first - before).abs().min((last - behind).abs());
    let far = (2.0 * (before - behind).abs()).max(0.5 * jump);
    let beyond = |sign: f64| {
        let top = sign * before.max(sign * behind);
        inside.iter().all(|value| sign * value - top > far)
    };
    beyond(1.0) || beyond(-1.0)
}

/// Changes of a joint's speed across samples. What is taken over the whole log is taken once for each length, as there may be bursts all over it.
struct Pushes<'a> {
    position: &'a [f64],
    quantum: f64,
    /// The usual change across so many samples.
    usual: BTreeMap<usize, f64>,
}

impl<'a> Pushes<'a> {
    fn of(position: &'a [f64]) -> Self {
        Self {
            position,
            quantum: Steps::of(position).quantum,
            usual: BTreeMap::new(),
        }
    }

    /// By how many times the usual change the speed changes across samples, beside what it changes by before and behind; so many that it is a
    /// push where that is not known.
    fn across(&mut self, range: &Range<usize>) -> f64 {
        let (position, count) = (self.position, range.len());
        let reach = count.max(REACH);
        let lasts = count + reach;
        let speed = |k: usize| position[k + reach] - position[k];
        let change = |k: usize| speed(k + count) - speed(k - reach);
        let bend = |k: usize| (change(k) - 0.5 * (change(k - lasts) + change(k + lasts))).abs();
        let known = lasts + reach..position.len().saturating_sub(2 * lasts);
        if !known.contains(&range.start) {
            return f64::INFINITY;
        }
        let usual = self.usual.entry(count);
        let usual = usual.or_insert_with(|| quantile(known.map(bend).collect(), 0.5));
        bend(range.start) / usual.max(self.quantum)
    }
}

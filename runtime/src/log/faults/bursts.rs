//! Stretches that jump away from what is around them, and soon jump back.
//!
//! Dry friction that turns round jumps once, and stays.

use std::ops::Range;

use super::Steps;

/// Fewest and most samples, and most seconds, of a burst: shorter ones are spikes.
const FEWEST: usize = 4;
const MOST: usize = 20;
const LONGEST_S: f64 = 0.05;

/// Its jumps are so many times a steep step, and no other such jump is within as many samples before and behind, and twice its length.
const BEYOND: f64 = 2.0;
const APART: usize = 20;

/// Ranges of samples.
pub(super) fn find(values: &[f64], rate_hz: f64) -> Vec<Range<usize>> {
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

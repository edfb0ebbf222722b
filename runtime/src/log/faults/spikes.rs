//! Samples that are far from both their neighbors.

use std::ops::Range;

use super::{FEW, STEEP, Steps, moved, quantile};

/// Samples that the median is taken of, to either side.
const REACH: usize = 5;

/// Most samples of one spike.
const WIDEST: usize = 3;

/// How far a spike is from the median, in units of what nine of ten samples are below; no less than a steep step.
const FAR: f64 = 12.0;

/// Where one sample of twenty is a spike, one step of ten is none of the arm's own. No more than so many times what three of four are below,
/// which is three times what noise makes it, is usual.
const OF_THREE_QUARTERS: f64 = 4.0;

/// What nine of ten are below, unless spikes are among these.
fn usual(sizes: &[f64]) -> f64 {
    let most = OF_THREE_QUARTERS * quantile(sizes.to_vec(), 0.75);
    quantile(sizes.to_vec(), FEW).min(most)
}

/// Ranges of samples.
pub(super) fn find(values: &[f64]) -> Vec<Range<usize>> {
    let distance: Vec<f64> = (0..values.len())
        .map(|k| values[k] - median(values, k))
        .collect();
    let sizes: Vec<f64> = distance.iter().map(|x| x.abs()).collect();
    let steps = Steps::of(values);
    if steps.quantum == 0.0 {
        return Vec::new();
    }
    let steep = STEEP * usual(&moved(&steps.sizes)).max(steps.quantum);
    // Where a smooth position is its own median nearly everywhere, most distances that are not zero are of spikes: beyond what steps
    // allow they do not say how far is usual.
    let mut near = moved(&sizes);
    near.retain(|size| *size <= steep);
    let far = steep.max(FAR * usual(&near));
    let mut found: Vec<Range<usize>> = Vec::new();
    for (k, size) in sizes.iter().enumerate() {
        if *size <= far {
            continue;
        }
        match found.last_mut() {
            Some(last) if last.end == k => last.end += 1,
            _ => found.push(k..k + 1),
        }
    }
    // A step that stays is the arm's or the drive's own; a spike comes back to where it was. At the ends nothing says which it is.
    let is_back = |range: &Range<usize>| {
        let before = range.start.checked_sub(1).map(|k| values[k]);
        before
            .zip(values.get(range.end))
            .is_some_and(|(before, behind)| {
                let sizes = range.clone().map(|k| sizes[k]);
                (before - behind).abs() < 0.5 * sizes.fold(f64::INFINITY, f64::min)
            })
    };
    found.retain(|range| range.len() <= WIDEST && is_back(range));
    found
}

/// Median of a sample and those around it.
fn median(values: &[f64], k: usize) -> f64 {
    let around = k.saturating_sub(REACH)..(k + REACH + 1).min(values.len());
    let mut around = values[around].to_vec();
    around.sort_unstable_by(f64::total_cmp);
    around[around.len() / 2]
}

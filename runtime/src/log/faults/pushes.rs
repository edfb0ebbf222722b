//! Whether a torque that is far from what is around it for a moment was the drive's: then its joint, or one whose acceleration it carries, is
//! faster or slower behind it.

use std::ops::Range;

use super::{quantile, resolution};

/// Fewest samples that a speed is taken of.
const REACH: usize = 10;

/// How many times the changes of speed around one is that a push makes, where that is so of most; and where it is so of a single one.
const PUSHED: f64 = 6.0;
const PUSHED_ALONE: f64 = 20.0;

/// Changes of speed that are looked at on either side.
const AROUND: usize = 8;

/// Ranges of a torque without those of which a position of the arm knows; none where they know of most.
pub(super) fn without(mut found: Vec<Range<usize>>, positions: &[Vec<f64>]) -> Vec<Range<usize>> {
    if found.is_empty() {
        return found;
    }
    let quanta: Vec<f64> = positions.iter().map(|own| resolution(own)).collect();
    let strongest = |range: &Range<usize>| -> Option<f64> {
        let joints = positions.iter().zip(&quanta);
        let pushes = joints.filter_map(|(position, quantum)| push(position, *quantum, range));
        pushes.reduce(f64::max)
    };
    let pushes: Vec<Option<f64>> = found.iter().map(strongest).collect();
    let known: Vec<f64> = pushes.iter().copied().flatten().collect();
    if quantile(known, 0.5) > PUSHED {
        return Vec::new();
    }
    let mut pushes = pushes.into_iter();
    found.retain(|_| {
        let push = pushes.next().flatten();
        push.is_none_or(|push| push <= PUSHED_ALONE)
    });
    found
}

/// By how many times as much the speed changes across samples as it does before and behind; none near the ends.
fn push(position: &[f64], quantum: f64, range: &Range<usize>) -> Option<f64> {
    let count = range.len();
    let reach = count.max(REACH);
    let lasts = count + reach;
    let is_known = |k: usize| k >= lasts + reach && k + 2 * lasts < position.len();
    let speed = |k: usize| position[k + reach] - position[k];
    let change = |k: usize| speed(k + count) - speed(k - reach);
    // What the change is beside those before and behind: a joint that is being accelerated all the time is not pushed.
    let bend = |k: usize| (change(k) - 0.5 * (change(k - lasts) + change(k + lasts))).abs();
    if !is_known(range.start) {
        return None;
    }
    let away = (4..4 + AROUND).map(|n| n * lasts / 2);
    let places = away.flat_map(|away| [range.start.checked_sub(away), Some(range.start + away)]);
    let around = places.flatten().filter(|k| is_known(*k)).map(bend);
    // A joint that stands has no quantum.
    let usual = quantile(around.collect(), 0.5).max(quantum);
    Some(bend(range.start) / usual.max(f64::MIN_POSITIVE))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Two joints at a constant speed; the second one is faster behind sample 500, as a push of eight samples makes it.
    fn positions() -> Vec<Vec<f64>> {
        let steady = |k: usize| 1e-3 * k as f64;
        let faster = |k: usize| steady(k) + 4e-3 * k.saturating_sub(504) as f64;
        let rounded = |f: &dyn Fn(usize) -> f64| -> Vec<f64> {
            (0..1000).map(|k| (f(k) / 1e-5).round() * 1e-5).collect()
        };
        vec![rounded(&steady), rounded(&faster)]
    }

    /// A joint that always moves by many steps of its encoder, and is pushed for one sample by an eighth of such a change.
    #[test]
    fn a_push_is_small_beside_the_steps_of_a_joint_that_moves() {
        let position = |k: usize| {
            let faster = 1.5e-4 * k.saturating_sub(500) as f64;
            1e-3 * k as f64 + 0.02 * (2e-2 * k as f64).sin() + faster
        };
        let rounded = |k: usize| (position(k) / 5e-6).round() * 5e-6;
        let positions = vec![(0..1000).map(rounded).collect()];
        let (push, fault) = (500..501, 300..301);
        assert_eq!(without(vec![push], &positions), Vec::new());
        assert_eq!(without(vec![fault.clone()], &positions), [fault]);
    }

    #[test]
    fn what_any_joint_is_faster_behind_is_a_push() {
        let (push, fault) = (500..508, 250..258);
        assert_eq!(
            without(vec![fault.clone()], &positions()),
            vec![fault.clone()]
        );
        assert_eq!(without(vec![push.clone()], &positions()), Vec::new());
        // The first joint alone knows nothing of it.
        assert_eq!(
            without(vec![push.clone()], &positions()[..1]),
            vec![push.clone()]
        );
        // One push among faults is left out alone.
        let faults = vec![fault, 700..708, 800..808];
        let all = [&faults[..], &[push]].concat();
        assert_eq!(without(all, &positions()), faults);
    }
}

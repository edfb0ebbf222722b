//! Where a joint stands along a log: at turns, in rests between two moves, or nearly all the time.

use std::ops::Range;

use crate::motion;
use crate::signal::MEDIAN_OF_NORMAL;
use crate::signal::resample::whole_steps;

/// A joint stands below so many deviations of its velocity's noise, which is what the wide band has beyond the smooth one.
const NOISE: f64 = 5.0;

/// Least and largest velocity at which a joint may be taken for standing, as shares of its largest: filters ring a little around a
/// stop, and noise that is larger says nothing of turns.
const SHARES: [f64; 2] = [0.005, 0.1];

/// Of a log: a joint that may stand for more of it is held by its friction.
const HELD: f64 = 0.85;

/// So is one that may stand for more than the first and is near a turn for more than the second: a controller that parks a joint against its
/// friction has it stick, creep and slip by thousandths of a radian all along.
const PARKED: [f64; 2] = [0.5, 0.9];

/// A rest is longer than this, s, and so many times as long as the usual stop of the joint: it has no part in a motion, as the waiting before
/// and behind one, or a joint that waits for the others.
const REST: f64 = 1.0;
const MUCH_LONGER: f64 = 5.0;

/// A joint dwells between two moves where, for longer than this, s, it goes no further in a quarter of it than this share of all its way. One
/// that turns slowly goes further while it may stand.
const DWELL: f64 = 0.2;
const UNMOVED: f64 = 2e-4;

/// The largest velocity is no more than so many times what this share is below.
const SLIPS: f64 = 3.0;
const FAST: f64 = 0.99;

/// Velocities of a joint along a log.
pub(super) struct Motion<'a> {
    wide: &'a [f64],
    /// Below this it may stand.
    slow: f64,
}

impl<'a> Motion<'a> {
    pub fn new(motion: &'a motion::Motion, joint: usize) -> Self {
        let (wide, smooth) = (&motion.wide.dq[joint], &motion.smooth.dq[joint]);
        Self {
            wide,
            slow: standing(wide, smooth),
        }
    }

    /// Whether its friction holds it nearly all the time, with the samples that its turns reach.
    pub fn is_held(&self, near: &[bool]) -> bool {
        let standing = self.standing_in(0..self.wide.len());
        let reached = near.iter().filter(|near| **near).count();
        let reached = reached as f64 / near.len().max(1) as f64;
        standing > HELD || (standing > PARKED[0] && reached > PARKED[1])
    }

    fn standing_in(&self, samples: Range<usize>) -> f64 {
        let wide = &self.wide[samples];
        let slow = wide.iter().filter(|dq| dq.abs() < self.slow).count();
        slow as f64 / wide.len().max(1) as f64
    }

    /// Long rests among the samples that its turns reach, with what they reach.
    pub fn rests(&self, near: &[bool], reach: usize, rate_hz: f64) -> Vec<Range<usize>> {
        let mut stops: Vec<Range<usize>> = Vec::new();
        for (k, _) in near.iter().enumerate().filter(|(_, is_near)| **is_near) {
            match stops.last_mut() {
                Some(stop) if stop.end == k => stop.end += 1,
                _ => stops.push(k..k + 1),
            }
        }
        // Without what is reached, which ends where the log does.
        let core = |stop: &Range<usize>| {
            let reached = |is_end: bool| if is_end { 0 } else { reach };
            let start = stop.start + reached(stop.start == 0);
            let end = stop.end.saturating_sub(reached(stop.end == near.len()));
            start..end.max(start)
        };
        let mut lengths: Vec<usize> = stops.iter().map(|stop| core(stop).len()).collect();
        lengths.sort_unstable();
        let Some(usual) = lengths.get(lengths.len().saturating_sub(1) / 2) else {
            return Vec::new();
        };
        let least = (REST * rate_hz).max(MUCH_LONGER * *usual as f64);
        stops.retain(|stop| {
            let core = core(stop);
            core.len() as f64 > least && self.standing_in(core) > HELD
        });
        stops
    }

    /// Samples of dwells between two moves, with `reach` samples around each.
    pub fn dwells(&self, reach: usize, rate_hz: f64) -> Vec<Range<usize>> {
        let count = self.wide.len();
        let unmoved = UNMOVED * self.way(0..count);
        let quarter = whole_steps((0.25 * DWELL * rate_hz).ceil()).max(1);
        let quarters = (0..count / quarter).map(|k| k * quarter..(k + 1) * quarter);
        let mut dwells: Vec<Range<usize>> = Vec::new();
        for still in quarters.filter(|quarter| self.way(quarter.clone()) <= unmoved) {
            match dwells.last_mut() {
                Some(dwell) if dwell.end == still.start => dwell.end = still.end,
                _ => dwells.push(still),
            }
        }
        dwells.retain(|dwell| dwell.len() >= 4 * quarter);
        let around =
            |dwell: Range<usize>| dwell.start.saturating_sub(reach)..(dwell.end + reach).min(count);
        dwells.into_iter().map(around).collect()
    }

    /// How far its positions are apart over some samples, in steps of the time between two.
    fn way(&self, samples: Range<usize>) -> f64 {
        let (mut at, mut low, mut high) = (0.0_f64, 0.0_f64, 0.0_f64);
        for dq in self.wide.get(samples).unwrap_or_default() {
            at += dq;
            (low, high) = (low.min(at), high.max(at));
        }
        high - low
    }

    /// Which samples its turns reach.
    pub fn near_turns(&self, reach: usize) -> Vec<bool> {
        let Self { wide, slow } = *self;
        let mut is_near = vec![false; wide.len()];
        let mut told = 0;
        for k in 0..wide.len() {
            let turns = k > 0 && wide[k] * wide[k - 1] <= 0.0;
            if turns || wide[k].abs() < slow {
                let end = (k + reach + 1).min(wide.len());
                let from = told.max(k.saturating_sub(reach));
                is_near[from..end].fill(true);
                told = end;
            }
        }
        is_near
    }
}

/// The velocity below which a joint may stand.
fn standing(wide: &[f64], smooth: &[f64]) -> f64 {
    let pairs = wide.iter().zip(smooth);
    let mut rest: Vec<f64> = pairs.map(|(wide, smooth)| (wide - smooth).abs()).collect();
    rest.sort_unstable_by(f64::total_cmp);
    let noise = rest
        .get(rest.len() / 2)
        .map_or(0.0, |x| x / MEDIAN_OF_NORMAL);
    let mut sizes: Vec<f64> = smooth.iter().map(|x| x.abs()).collect();
    sizes.sort_unstable_by(f64::total_cmp);
    let share = |share: f64| {
        let place = whole_steps(share * sizes.len().saturating_sub(1) as f64);
        sizes.get(place).copied().unwrap_or_default()
    };
    // An encoder that slips is not the speed of its joint.
    let most = share(1.0).min(SLIPS * share(FAST));
    let [least, largest] = SHARES.map(|share| share * most);
    (NOISE * noise).clamp(least, largest)
}

#[cfg(test)]
mod tests {
    use super::*;

    const RATE: f64 = 100.0;
    const REACH: usize = 5;

    /// Long rests of a joint that moves so, s.
    fn rests(velocity: impl Fn(f64) -> f64) -> Vec<(f64, f64)> {
        let dq: Vec<f64> = (0..2000_u32)
            .map(|k| velocity(f64::from(k) / RATE))
            .collect();
        let motion = Motion {
            slow: standing(&dq, &dq),
            wide: &dq,
        };
        let rests = motion.rests(&motion.near_turns(REACH), REACH, RATE);
        let seconds = |k: usize| k as f64 / RATE;
        rests
            .iter()
            .map(|rest| (seconds(rest.start), seconds(rest.end)))
            .collect()
    }

    /// Whether a joint is held that moves so.
    fn is_held(velocity: impl Fn(u32) -> f64) -> bool {
        let dq: Vec<f64> = (0..2000_u32).map(velocity).collect();
        let motion = Motion {
            slow: standing(&dq, &dq),
            wide: &dq,
        };
        motion.is_held(&motion.near_turns(REACH))
    }

    #[test]
    fn a_joint_that_its_controller_parks_is_held() {
        let seconds = |k: u32| f64::from(k) / RATE;
        let swing = |k| (2.0 * seconds(k)).sin();
        assert!(!is_held(swing));
        // It slips for three samples of ten, each time by another velocity.
        let slips = |k: u32| {
            let is_slip = k % 10 < 3;
            if is_slip {
                1e-3 * (1.7 * seconds(k)).sin()
            } else {
                0.0
            }
        };
        assert!(is_held(slips));
        // Half of the time at rest, and the rest of it in fast motion, is none that is held.
        let stops = |k: u32| if k % 200 < 100 { swing(k) } else { 0.0 };
        assert!(!is_held(stops));
    }

    #[test]
    fn long_rests_are_no_turns() {
        let swing = |t: f64| (2.0 * t).sin();
        assert!(rests(swing).is_empty());
        let framed = rests(|t| {
            if (4.0..16.0).contains(&t) {
                swing(t)
            } else {
                0.0
            }
        });
        let [(0.0, first), (last, 20.0)] = framed[..] else {
            panic!("{framed:?}");
        };
        assert!((first - 4.0).abs() < 0.1 && (last - 16.0).abs() < 0.3);
        // A motion that stops for long each time it turns has no other rests.
        let dwelling = |t: f64| {
            let phase = t.rem_euclid(4.0);
            let way = if t.rem_euclid(8.0) < 4.0 { 1.0 } else { -1.0 };
            if phase < 2.0 { way } else { 0.0 }
        };
        assert!(rests(dwelling).is_empty());
    }

    #[test]
    fn a_joint_dwells_between_two_moves() {
        let dwells = |velocity: &dyn Fn(f64) -> f64| -> Vec<(f64, f64)> {
            let dq: Vec<f64> = (0..2000_u32)
                .map(|k| velocity(f64::from(k) / RATE))
                .collect();
            let motion = Motion {
                wide: &dq,
                slow: 0.1,
            };
            let seconds = |k: usize| k as f64 / RATE;
            let found = motion.dwells(REACH, RATE);
            found
                .iter()
                .map(|dwell| (seconds(dwell.start), seconds(dwell.end)))
                .collect()
        };
        let found = dwells(&|t| {
            let way = if t.rem_euclid(2.0) < 1.0 { 1.0 } else { -1.0 };
            if t.rem_euclid(1.0) < 0.5 { way } else { 0.0 }
        });
        assert_eq!(found.len(), 20);
        for (k, (start, end)) in (0_u32..).zip(found) {
            assert!((start - f64::from(k) - 0.45).abs() < 0.06, "{start}");
            assert!((end - f64::from(k) - 1.05).abs() < 0.06, "{end}");
        }
        // One that turns slowly does not, though it may stand for a third of a second.
        assert!(dwells(&|t| (0.6 * t).sin()).is_empty());
    }
}

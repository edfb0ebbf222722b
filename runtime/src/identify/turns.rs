//! Rows around the turns of joints with dry friction.
//!
//! A joint that turns may stand for a while, held by as much friction as it takes and not by what the law says of either direction;
//! and encoders do not tell within some samples when it turned. Of simulated arms under a controller both make dry friction come out
//! too large and viscous friction too small by several deviations. By how much an estimate moves when a joint's rows there are left out,
//! as far as the shared filter spreads them, is in its deviations; or they are left out. Source of that practice: Swevers, Verdonck,
//! De Schutter 2007, Dynamic model identification for industrial robots, who leave out samples of low velocity.
//!
//! The filter of the filtered form remembers a turn for much longer than the shared one spreads it, and starts anew behind each (see
//! [`start_anew`]).

use std::ops::Range;

use super::clipped::{clear_rows, rows_at};
use super::least_squares::{Factors, Solution};
use super::stack::Stack;
use super::{Estimate, Identify, IdentifyError, is_shape_told};
use crate::columns::Arm;
use crate::motion;
use crate::signal::resample::whole_steps;
use crate::signal::{MEDIAN_OF_NORMAL, Prepared};

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

/// The largest velocity is no more than so many times what this share is below.
const SLIPS: f64 = 3.0;
const FAST: f64 = 0.99;

/// What the shared filter spreads a turn over, on either side, in periods of its cutoff.
const SPREAD: f64 = 0.75;

/// Notes which rows of a stack of the logs the turns of dry joints reach. Those of a joint that stands nearly all the time are left out,
/// and those of long rests: dry friction holds it with a torque that nobody knows, and steps of its encoder are no motion.
pub(super) fn find(stack: &mut Stack, arm: &dyn Arm, logs: &[Prepared]) {
    stack.turns = vec![Vec::new(); stack.dof()];
    stack.held = stack.turns.clone();
    for (number, log) in logs.iter().enumerate() {
        let start = stack.segments[number].start;
        for &joint in arm.dry_joints() {
            let Standing { turns, held } = Standing::of(log, joint);
            stack.held[joint].extend(rows_at(start, log, &held));
            stack.turns[joint].extend(rows_at(start, log, &turns));
        }
    }
    clear_rows(&mut stack.joints, &stack.held);
}

/// Rows of a joint whose dry friction the arm does not know: where it turns, and where it is held.
pub(super) fn of_joint(stack: &Stack, logs: &[Prepared], joint: usize) -> Vec<usize> {
    let of_log = |(number, log): (usize, &Prepared)| {
        let start = stack.segments[number].start;
        let Standing { turns, held } = Standing::of(log, joint);
        let reached = [turns, held].map(|reached| rows_at(start, log, &reached));
        reached.concat()
    };
    logs.iter().enumerate().flat_map(of_log).collect()
}

/// Which samples of a log are left out, since the dry friction of a joint holds it.
pub(super) fn held(arm: &dyn Arm, log: &Prepared, joint: usize) -> Vec<bool> {
    if arm.dry_joints().contains(&joint) {
        Standing::of(log, joint).held
    } else {
        Vec::new()
    }
}

/// Which samples of a log say what a model of a joint is worth: those away from its turns, at which its dry friction does not hold it.
pub(crate) fn away(arm: &dyn Arm, log: &Prepared, joint: usize) -> Vec<bool> {
    if !arm.dry_joints().contains(&joint) {
        return vec![true; log.motion.time.len()];
    }
    let Standing { turns, held } = Standing::of(log, joint);
    let pairs = turns.iter().zip(&held);
    pairs.map(|(turns, held)| !turns && !held).collect()
}

/// Which samples of a log the turns of a joint reach, and at which it is held.
struct Standing {
    turns: Vec<bool>,
    held: Vec<bool>,
}

impl Standing {
    fn of(log: &Prepared, joint: usize) -> Self {
        let motion = Motion::new(&log.motion, joint);
        let reach = whole_steps((SPREAD * log.shared.border() as f64).ceil());
        let mut turns = motion.near_turns(reach);
        let mut held = vec![false; turns.len()];
        if motion.is_held(&turns) {
            std::mem::swap(&mut turns, &mut held);
        } else {
            for rest in motion.rests(&turns, reach, log.rate_hz) {
                turns[rest.clone()].fill(false);
                held[rest].fill(true);
            }
        }
        Self { turns, held }
    }
}

impl Identify {
    /// Fits an arm with [`Arm::dry_shapes`] without rows at turns: there a joint stands longer than its law says, and a search would bend
    /// the law after that. With these rows where no others tell all that is looked for.
    pub(super) fn away_from_turns(
        &self,
        arm: &dyn Arm,
        fit: &dyn Fn(&Self) -> Result<Estimate, IdentifyError>,
    ) -> Result<Estimate, IdentifyError> {
        if self.leave_out_turns || self.shapes.is_some() || arm.dry_shapes().is_empty() {
            return fit(self);
        }
        let away = Self {
            leave_out_turns: true,
            ..self.clone()
        };
        let is_told = |found: &Estimate, shape: usize| {
            let std = found.shape_std[shape];
            std.is_some_and(|std| is_shape_told(found.shapes[shape].1, std))
        };
        match fit(&away) {
            Ok(found)
                if found.unexcited.is_empty()
                    && arm.dry_shapes().iter().all(|&k| is_told(&found, k)) =>
            {
                Ok(found)
            }
            _ => fit(self),
        }
    }
}

/// Makes the rows zero that turns reach.
pub(crate) fn leave_out(stack: &mut Stack) {
    clear_rows(&mut stack.joints, &stack.turns);
}

/// Which samples of a motion are within `reach` of one at which a joint turns or may stand.
pub(super) fn near(motion: &motion::Motion, joint: usize, reach: usize) -> Vec<bool> {
    Motion::new(motion, joint).near_turns(reach)
}

/// Starts a filter of the first order anew behind every turn, from zero, and leaves nothing of what is near one. Of a sample `kept` is left
/// in the next. What a series that passed it has of the time before decays by that factor whatever comes in, so both sides of an equation
/// stay equal.
pub(super) fn start_anew(series: &mut [f64], near: &[bool], kept: f64) {
    let mut had = 0.0;
    for (value, is_near) in series.iter_mut().zip(near) {
        had = if *is_near { *value } else { kept * had };
        *value -= had;
    }
}

/// Whether rows of a stack are at turns, `[joint][row]`.
pub(super) fn are_at(stack: &Stack) -> Vec<Vec<bool>> {
    let mut are_at = vec![vec![false; stack.samples()]; stack.dof()];
    for (are_at, turns) in are_at.iter_mut().zip(&stack.turns) {
        for &row in turns {
            are_at[row] = true;
        }
    }
    are_at
}

/// Factors of the rows of a stack, which have weights, and of those of them that are not at turns.
pub(super) fn with_and_without(stack: &Stack, weights: &[Vec<f64>]) -> [Factors; 2] {
    let are_at = are_at(stack);
    let root = |joint: usize, row: usize| weights[joint][row].sqrt();
    let away = |joint: usize, row: usize| {
        if are_at[joint][row] {
            0.0
        } else {
            root(joint, row)
        }
    };
    [
        Factors::of_rows(stack, &root),
        Factors::of_rows(stack, &away),
    ]
}

/// Deviations with what rows at turns move a solution of least squares by, unknown by unknown: factors of all rows and of those away
/// from turns are solved with the same `scale` of each joint. Of the difference `d`, whose variance is that of the solution without
/// them less that with them, `d^2` less that variance counts. Unknowns that other rows do not tell keep their deviations.
pub(super) fn widen(all: &Factors, away: &Factors, scale: &[f64], std: &mut [f64]) {
    let ones = vec![1.0; scale.len()];
    let [with, without] = [all, away].map(|factors| factors.solve(scale, &ones));
    widen_between(&with, &without, std);
}

/// The same of two solutions by one method, with all rows and without those at turns.
pub(super) fn widen_between(with: &Solution, without: &Solution, std: &mut [f64]) {
    for (k, std) in std.iter_mut().enumerate() {
        if with.is_told(k) && without.is_told(k) && with.std[k] > 0.0 {
            let difference = with.estimate[k] - without.estimate[k];
            let less_told = (without.std[k] / with.std[k]).powi(2) - 1.0;
            let beyond = difference.powi(2) - std.powi(2) * less_told.max(0.0);
            *std = std.hypot(beyond.max(0.0).sqrt());
        }
    }
}

/// Velocities of a joint along a log.
struct Motion<'a> {
    wide: &'a [f64],
    /// Below this it may stand.
    slow: f64,
}

impl<'a> Motion<'a> {
    fn new(motion: &'a motion::Motion, joint: usize) -> Self {
        let (wide, smooth) = (&motion.wide.dq[joint], &motion.smooth.dq[joint]);
        Self {
            wide,
            slow: standing(wide, smooth),
        }
    }

    /// Whether its friction holds it nearly all the time, with the samples that its turns reach.
    fn is_held(&self, near: &[bool]) -> bool {
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
    fn rests(&self, near: &[bool], reach: usize, rate_hz: f64) -> Vec<Range<usize>> {
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

    /// Which samples its turns reach.
    fn near_turns(&self, reach: usize) -> Vec<bool> {
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
}

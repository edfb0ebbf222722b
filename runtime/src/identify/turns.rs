//! Rows around the turns of joints with dry friction.
//!
//! A joint that turns may stand for a while, held by as much friction as it takes and not by what the law says of either direction;
//! and encoders do not tell within some samples when it turned. Of simulated arms under a controller both make dry friction come out
//! too large and viscous friction too small by several deviations. By how much an estimate moves when a joint's rows there are left out,
//! as far as the shared filter spreads them, is in its deviations; or they are left out. Source of that practice: Swevers, Verdonck,
//! De Schutter 2007, Dynamic model identification for industrial robots, who leave out samples of low velocity.

use super::least_squares::{Factors, Solution};
use super::robust::MEDIAN_OF_NORMAL;
use super::stack::{Stack, clear_rows, rows_at};
use crate::columns::Arm;
use crate::signal::Prepared;
use crate::signal::resample::whole_steps;

/// A joint stands below so many deviations of its velocity's noise, which is what the wide band has beyond the smooth one.
const NOISE: f64 = 5.0;

/// Least and largest velocity at which a joint may be taken for standing, as shares of its largest: filters ring a little around a
/// stop, and noise that is larger says nothing of turns.
const SHARES: [f64; 2] = [0.005, 0.1];

/// Of a log: a joint that may stand for more of it is held by its friction.
const HELD: f64 = 0.85;

/// The largest velocity is no more than so many times what this share is below.
const SLIPS: f64 = 3.0;
const FAST: f64 = 0.99;

/// What the shared filter spreads a turn over, on either side, in periods of its cutoff.
const SPREAD: f64 = 0.75;

/// Notes which rows of a stack of the logs the turns of dry joints reach. Those of a joint that stands nearly all the time are left out:
/// dry friction holds it with a torque that nobody knows, and steps of its encoder are no motion.
pub(super) fn find(stack: &mut Stack, arm: &dyn Arm, logs: &[Prepared]) {
    stack.turns = vec![Vec::new(); stack.dof()];
    stack.held = stack.turns.clone();
    for (number, log) in logs.iter().enumerate() {
        let start = stack.segments[number].start;
        for &joint in arm.dry_joints() {
            let motion = Motion::new(log, joint);
            let rows = rows_at(start, log, &motion.near_turns(log.shared.border() as f64));
            let place = if motion.standing() > HELD {
                &mut stack.held
            } else {
                &mut stack.turns
            };
            place[joint].extend(rows);
        }
    }
    clear_rows(&mut stack.joints, &stack.held);
}

/// Makes the rows zero that turns reach.
pub(crate) fn leave_out(stack: &mut Stack) {
    clear_rows(&mut stack.joints, &stack.turns);
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
    fn new(log: &'a Prepared, joint: usize) -> Self {
        let (wide, smooth) = (&log.motion.wide.dq[joint], &log.motion.smooth.dq[joint]);
        Self {
            wide,
            slow: standing(wide, smooth),
        }
    }

    /// The share of its samples at which it may stand.
    fn standing(&self) -> f64 {
        let slow = self.wide.iter().filter(|dq| dq.abs() < self.slow).count();
        slow as f64 / self.wide.len().max(1) as f64
    }

    /// Which samples its turns reach, with the border of the shared filter.
    fn near_turns(&self, border: f64) -> Vec<bool> {
        let Self { wide, slow } = *self;
        let reach = whole_steps((SPREAD * border).ceil());
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

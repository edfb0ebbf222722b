//! Rows around the turns of joints with dry friction.
//!
//! A joint that turns may stand for a while, held by as much friction as it takes and not by what the law says of either direction;
//! and encoders do not tell within some samples when it turned. Of simulated arms under a controller both make dry friction come out
//! too large and viscous friction too small by several deviations. By how much an estimate moves when a joint's rows there are left out,
//! as far as the shared filter spreads them, is in its deviations; or they are left out. Source of that practice: Swevers, Verdonck,
//! De Schutter 2007, Dynamic model identification for industrial robots, who leave out samples of low velocity.

use super::combination::Shared;
use super::least_squares::{Factors, Solution};
use super::stack::Stack;
use crate::columns::Arm;
use crate::signal::Prepared;
use crate::signal::resample::whole_steps;

/// A joint stands below so many deviations of its velocity's noise, which is what the wide band has beyond the smooth one.
const NOISE: f64 = 5.0;

/// Median of the absolute value of normal noise, in deviations.
const MEDIAN_OF_NORMAL: f64 = 0.6745;

/// Least and largest velocity at which a joint may be taken for standing, as shares of its largest: filters ring a little around a
/// stop, and noise that is larger says nothing of turns.
const SHARES: [f64; 2] = [0.005, 0.1];

/// What the shared filter spreads a turn over, on either side, in periods of its cutoff.
const SPREAD: f64 = 0.75;

/// Notes which rows of a stack of the logs the turns of dry joints reach.
pub(super) fn find(stack: &mut Stack, arm: &dyn Arm, logs: &[Prepared]) {
    stack.turns = vec![Vec::new(); stack.dof()];
    for (number, log) in logs.iter().enumerate() {
        let start = stack.segments[number].start;
        for &joint in arm.dry_joints() {
            let is_near = near_turns(log, joint);
            let kept = log.shared.kept(is_near.len()).enumerate();
            let rows = kept
                .filter(|&(_, k)| is_near[k])
                .map(|(row, _)| start + row);
            stack.turns[joint].extend(rows);
        }
    }
}

/// Makes the rows zero that turns reach.
pub(super) fn leave_out(stack: &mut Stack) {
    for (rows, turns) in stack.joints.iter_mut().zip(&stack.turns) {
        for &row in turns {
            rows.clear(row..row + 1);
        }
    }
}

/// By how much a solution of least squares moves, unknown by unknown, where rows at turns are left out and others have the same
/// weights; 0 for unknowns that the other rows do not tell.
pub(super) fn moves(stack: &Stack, solution: &Solution, weights: &[Vec<f64>]) -> Vec<f64> {
    let mut roots: Vec<Vec<f64>> = weights.to_vec();
    for (joint, turns) in roots.iter_mut().zip(&stack.turns) {
        joint.iter_mut().for_each(|weight| *weight = weight.sqrt());
        turns.iter().for_each(|&row| joint[row] = 0.0);
    }
    let factors = Factors::of_rows(stack, &|joint, row| roots[joint][row]);
    let without = factors.solve(&solution.scale, &vec![1.0; stack.dof()]);
    let is_told = |solution: &Solution, k: usize| {
        let is_in =
            |shared: &Shared| shared.lead == k || shared.others.iter().any(|(o, _)| *o == k);
        !solution.unexcited.contains(&k) && !solution.shared.iter().any(is_in)
    };
    let both = solution.estimate.iter().zip(&without.estimate).enumerate();
    both.map(|(k, (with, without_turns))| {
        if is_told(solution, k) && is_told(&without, k) {
            with - without_turns
        } else {
            0.0
        }
    })
    .collect()
}

/// Which samples of a motion the turns of a joint reach.
fn near_turns(log: &Prepared, joint: usize) -> Vec<bool> {
    let (wide, smooth) = (&log.motion.wide.dq[joint], &log.motion.smooth.dq[joint]);
    let slow = standing(wide, smooth);
    let reach = whole_steps((SPREAD * log.shared.border() as f64).ceil());
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

/// The velocity below which a joint may stand.
fn standing(wide: &[f64], smooth: &[f64]) -> f64 {
    let pairs = wide.iter().zip(smooth);
    let mut rest: Vec<f64> = pairs.map(|(wide, smooth)| (wide - smooth).abs()).collect();
    rest.sort_unstable_by(f64::total_cmp);
    let noise = rest
        .get(rest.len() / 2)
        .map_or(0.0, |x| x / MEDIAN_OF_NORMAL);
    let most = smooth.iter().fold(0.0, |most: f64, x| most.max(x.abs()));
    let [least, largest] = SHARES.map(|share| share * most);
    (NOISE * noise).clamp(least, largest)
}

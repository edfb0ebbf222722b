//! Effects that change the arm itself: an encoder's offset, a tilted base, a spring behind a motor.
//!
//! No column stands for one of them: columns of the whole arm move with it. So a change is tried twice. To first order it is what a
//! small amount of it adds to the torque at the present estimate, and is scored beside the columns of other candidates. Where that is
//! promising it is tried as what it is: the arm with the change, its shapes found by Gauss-Newton beside all other unknowns. It is judged
//! with slopes by its shapes for columns, so that every fold finds its own.

use std::ops::Range;

use crate::columns::{Arm, Change, Entry};
use crate::identify::{IdentifyError, Stack, load_motion, slope, with_slopes};
use crate::signal::Prepared;

use super::calm::calmest;
use super::raw::above;
use super::residual::raw_residuals;
use super::search::{Search, State};
use super::structure::Structure;
use super::wander;

/// Steps of Gauss-Newton, and the step, in a shape's deviations or of the shape itself, that is none.
const STEPS: usize = 8;
const SETTLED: f64 = 0.1;
const STILL: f64 = 1e-3;

/// A shape of several decades goes no further than this factor in a step.
const FACTOR: f64 = 3.0;

/// A change as what it is.
#[derive(Clone)]
pub(super) struct Changed {
    /// Values of its own shapes.
    pub(super) shapes: Vec<f64>,
    /// Their standard deviations, each beside all other unknowns.
    pub(super) std: Vec<Option<f64>>,
    /// What noise makes of those: rows at turns, which have a gate of their own, are like others there.
    pub(super) std_of_noise: Vec<Option<f64>>,
    /// Rows of the arm with it and with the effects that were accepted before; the last columns are slopes by its shapes.
    pub(super) stack: Stack,
    /// Mean square of the raw residual beyond that of the filtered one, per joint.
    pub(super) noise_power: Vec<f64>,
    /// What it leaves of structure, per joint.
    pub(super) structure: Vec<Structure>,
    /// Whether the logged torque is in it, whose noise then explains itself.
    pub(super) follows_torque: bool,
}

impl Search<'_> {
    /// What a change adds along the motions of logs to first order, filtered: one column a shape, for the shape at its probe.
    pub(super) fn first_order(
        &self,
        state: &State,
        change: &dyn Change,
        mut logs: Vec<Prepared>,
    ) -> Result<Vec<Entry>, IdentifyError> {
        let arm = change.arm();
        let own = self.arm.unknowns().len();
        let names = |arm: &dyn Arm| {
            arm.unknowns()
                .iter()
                .map(|u| u.name.clone())
                .collect::<Vec<_>>()
        };
        let neutral = self.with_own(change.neutral());
        let (estimate, before) = if names(arm) == names(self.arm) {
            let mut estimate = state.solution.estimate.clone();
            estimate[own..].fill(0.0);
            let before = state.stack.residuals(&estimate);
            estimate.truncate(own);
            load(arm, &mut logs, &neutral, &estimate);
            (estimate, before)
        } else {
            let (solution, _, stack) = self.identify.solve(arm, &mut logs, Some(neutral))?;
            let before = stack.residuals(&solution.estimate);
            (solution.estimate, before)
        };
        let mut entries = Vec::new();
        for (column, probe) in change.probe().iter().enumerate() {
            let mut moved = change.neutral().to_vec();
            moved[column] = *probe;
            let moved = self.identify.rows(arm, &logs, &self.with_own(&moved));
            let moved = moved.residuals(&estimate);
            let pairs = before.iter().zip(&moved).enumerate();
            entries.extend(pairs.map(|(joint, (before, moved))| Entry {
                joint,
                column,
                values: before.iter().zip(moved).map(|(b, m)| b - m).collect(),
            }));
        }
        Ok(entries)
    }

    /// Finds a change's shapes, from what `gain` times its first order suggests. `None` where they do not settle inside their ranges.
    pub(super) fn solve_change(
        &self,
        state: &State,
        change: &dyn Change,
        gain: &[f64],
    ) -> Result<Option<Changed>, IdentifyError> {
        let arm = change.arm();
        let Some(mut own) = first_guess(change, gain) else {
            return Ok(None);
        };
        let (mut logs, mut calm) = (self.prepared.clone(), self.calm.clone());
        let shapes = self.with_own(&own);
        let numbers = shapes.len() - own.len()..shapes.len();
        let (solution, ..) = self.identify.solve(arm, &mut logs, Some(shapes))?;
        let mut estimate = solution.estimate;
        for _ in 0..STEPS {
            let shapes = self.with_own(&own);
            load(arm, &mut logs, &shapes, &estimate);
            load(arm, &mut calm, &shapes, &estimate);
            let rows = |shapes: &[f64]| {
                let mut stack = self.identify.rows(arm, &logs, shapes);
                for effect in &state.accepted {
                    stack.append(effect.trial.candidate.unknowns(), &effect.trial.entries);
                }
                stack
            };
            let mut stack = rows(&shapes);
            let unknowns = stack.unknowns.len();
            let plain = self.identify.solve_stack(&stack)?;
            stack.silence(&plain.unexcited);
            let filtered = stack.residuals(&plain.estimate);
            let stack = with_slopes(
                arm,
                &rows,
                &shapes,
                numbers.clone(),
                stack,
                &plain.estimate,
                slope::smooth,
            );
            let solution = self.identify.solve_stack(&stack)?;
            estimate = plain.estimate[..arm.unknowns().len()].to_vec();
            let mut is_settled = true;
            for (number, value) in own.iter_mut().enumerate() {
                let (step, std) = (
                    solution.estimate[unknowns + number],
                    solution.std[unknowns + number],
                );
                is_settled &= step.abs() < (SETTLED * std).max(STILL * value.abs());
                *value = stepped(change, number, *value, step);
            }
            if is_settled {
                let is_inside = own.iter().enumerate().all(|(k, value)| {
                    let (low, high) = range(change, k);
                    low < *value && *value < high
                });
                let mut motions = logs.iter().map(|log| &log.motion);
                let follows_torque = motions.any(|motion| !motion.transmitted_torque.is_empty());
                let of_log = |log: &Prepared| {
                    raw_residuals(arm, &shapes, &plain.estimate, &state.accepted, log)
                };
                let motions = [&logs, &calm].into_iter().filter(|logs| !logs.is_empty());
                let raw = calmest(motions.map(|logs| logs.iter().map(of_log).collect()));
                let raw = raw.residuals;
                let noise_power = above(&raw, &self.beyond_all(&raw), &filtered);
                let segments = &state.stack.segments;
                let structure = self.structure_in(segments, &raw, &filtered, &|_, _| 0.0);
                let mut std = self.identify.apart_beside_slopes(&stack, &plain);
                let own_unknowns = unknowns..stack.unknowns.len();
                wander::widen(&mut std, own_unknowns, &stack, &plain.sigma, &filtered);
                let std_of_noise = self.identify.of_noise_beside_slopes(&stack, &plain);
                return Ok(is_inside.then(|| Changed {
                    shapes: own,
                    std: std[unknowns..].to_vec(),
                    std_of_noise: std_of_noise[unknowns..].to_vec(),
                    stack,
                    noise_power,
                    structure,
                    follows_torque,
                }));
            }
        }
        Ok(None)
    }

    /// All shapes of an arm with a change, whose own are the last.
    fn with_own(&self, own: &[f64]) -> Vec<f64> {
        [self.shapes.as_slice(), own].concat()
    }
}

fn load(arm: &dyn Arm, logs: &mut [Prepared], shapes: &[f64], estimate: &[f64]) {
    if arm.uses_rigid_torque() {
        for log in logs {
            load_motion(arm, &mut log.motion, shapes, estimate);
        }
    }
}

/// Places of a change's own shapes among those of its arm.
fn own(change: &dyn Change) -> Range<usize> {
    let count = change.arm().shapes().len();
    count - change.neutral().len()..count
}

fn range(change: &dyn Change, number: usize) -> (f64, f64) {
    let grid = &change.arm().shapes()[own(change)][number].grid;
    (grid[0], grid[grid.len() - 1])
}

/// Where `gain` times the probe's torque would be: torque goes with a shape that may be zero, and with a power of one that may not,
/// which is 1 or -1 by the end of its range at which nothing changes.
fn first_guess(change: &dyn Change, gain: &[f64]) -> Option<Vec<f64>> {
    let shapes = gain.iter().enumerate().map(|(number, gain)| {
        let (low, high) = range(change, number);
        let (neutral, probe) = (change.neutral()[number], change.probe()[number]);
        if low * high < 0.0 {
            return Some((neutral + gain * (probe - neutral)).clamp(low, high));
        }
        let power = if neutral > probe { -1.0 } else { 1.0 };
        (*gain > 0.0).then(|| (probe * gain.powf(power)).clamp(low, high))
    });
    shapes.collect()
}

fn stepped(change: &dyn Change, number: usize, value: f64, step: f64) -> f64 {
    let (low, high) = range(change, number);
    let next = value + step;
    if low * high < 0.0 {
        next.clamp(low, high)
    } else {
        next.clamp(value / FACTOR, value * FACTOR).clamp(low, high)
    }
}

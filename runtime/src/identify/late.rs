//! Torque that comes later than positions, or earlier: a filter in the drive, a bus, another clock.
//!
//! A log whose torque is late by `d` has at `t` the torque of `t - d`, so `tau(t + d) = W beta`. About a delay that is known so far,
//! `tau + s dtau/dt = W beta`: the rest `s` of each joint is the parameter of a column beside the others, and the torque is shifted by it and
//! fitted again. As noise has nothing in common with its own slope, it leaves `s` where it is.
//!
//! Friction that a model lacks looks like a delay where a joint swings at one speed, and a joint that sticks where it turns round lets go
//! later than the sign of its velocity says. So each joint has three more columns, viscous friction, dry friction and the slope of that, and
//! free shapes have theirs: what is told is told apart from all of them, and of other torques than dry friction.

use super::shapes::with_slopes;
use super::stack::{Stack, norm, says_nothing};
use super::{Identify, clipped, prepare_all, turns};
use crate::columns::{Arm, Entry, Unknown};
use crate::log::Log;
use crate::signal::{Bands, Prepared, derivative};

/// What is told: so many deviations, and so large a part of a log's sample. Torque that is set at a sample and holds until the next is early by
/// half of that, and one more sample may go where the next one is computed, which is how a drive works and no fault.
const DEVIATIONS: f64 = 4.0;
const LATE: f64 = 0.25;
const HELD: f64 = 1.25;

/// By which share a joint's residual has to be less without the delay. A law of dry friction that the model does not have looks like one by up
/// to a twelfth, a coupling of a short log by up to a fifth.
const SHARE: f64 = 0.25;

/// A joint whose delay is that of one that is sure, within so many deviations of both, is told without that.
const ALIKE: f64 = 3.0;

/// How often the torque is shifted until a step is below a deviation, and most of a shift at once, s: a slope says little of what is further
/// away. What does not settle is no delay.
const ROUNDS: usize = 8;
const MOST: f64 = 0.03;

/// Delays that are tried first, s.
const STARTS: [f64; 8] = [-0.04, -0.02, 0.02, 0.04, 0.07, 0.11, 0.17, 0.25];

/// A joint whose torque is not of the time of its position.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct TorqueDelay {
    /// The joint, from 0.
    pub joint: usize,
    /// By how much its torque is late, s; negative where it is early.
    pub seconds: f64,
    /// Standard deviation, s, from the errors' own series as those of parameters.
    pub std: f64,
    /// By which share the root mean square of its residual is less without the delay.
    pub gain: f64,
}

/// Whether torque that is late by so many seconds, or early, is more than how a drive samples it; `period` is that of the log, s.
#[must_use]
pub fn is_delay(seconds: f64, period: f64) -> bool {
    !(-HELD..=LATE).contains(&(seconds / period))
}

/// Time from one sample to the next of the slowest log, s.
pub(crate) fn longest_period(logs: &[Prepared]) -> f64 {
    let periods = logs
        .iter()
        .map(|log| 1.0 / (log.rate_hz * log.stride as f64));
    periods.fold(0.0, f64::max)
}

/// The equations without delays.
struct Rows<'a> {
    arm: &'a dyn Arm,
    logs: &'a [Prepared],
    /// Per log the joints that say nothing.
    silent: Vec<Vec<usize>>,
    stack: Stack,
    leave_out_turns: bool,
}

/// Delays with their deviations, and the lengths of the residuals.
struct Found {
    step: Vec<f64>,
    std: Vec<f64>,
    residuals: Vec<f64>,
}

impl Identify {
    /// Joints whose torque is late or early, for an estimate on its own stack; none where the logs do not say so.
    pub(super) fn torque_delays(
        &self,
        arm: &dyn Arm,
        logs: &[Prepared],
        stack: Stack,
        (shapes, estimate): (&[f64], &[f64]),
    ) -> Vec<TorqueDelay> {
        let rows = Rows::new(
            arm,
            logs,
            with_slopes(
                arm,
                &|shapes| self.rows(arm, logs, shapes),
                shapes,
                0..shapes.len(),
                stack,
                estimate,
            ),
            self.leave_out_turns,
        );
        self.delays_of(&rows).unwrap_or_default()
    }

    /// The same of logs by the equations with accelerations, for an estimate that has done without; none where these cannot be solved.
    pub(super) fn torque_delays_of_logs(
        &self,
        arm: &dyn Arm,
        logs: &[Log],
        bands: &Bands,
        shapes: &[f64],
    ) -> Vec<TorqueDelay> {
        let Ok(mut prepared) = prepare_all(logs, bands) else {
            return Vec::new();
        };
        let Ok((solution, shapes, stack)) = self.solve(arm, &mut prepared, Some(shapes.to_vec()))
        else {
            return Vec::new();
        };
        self.torque_delays(arm, &prepared, stack, (&shapes, &solution.estimate))
    }

    /// `None` where the rows are too few for more unknowns.
    fn delays_of(&self, rows: &Rows<'_>) -> Option<Vec<TorqueDelay>> {
        let dof = rows.arm.dof();
        let period = longest_period(rows.logs);
        let mut delays = vec![self.nearest(rows)?; dof];
        for _ in 0..ROUNDS {
            let found = self.further(&rows.shifted(&delays))?;
            for (delay, step) in delays.iter_mut().zip(&found.step) {
                *delay += step.clamp(-MOST, MOST);
            }
            let is_far = |joint: &usize| {
                let (delay, std) = (delays[*joint], found.std[*joint]);
                delay.abs() > DEVIATIONS * std && is_delay(delay, period)
            };
            let far: Vec<usize> = (0..dof).filter(is_far).collect();
            if far.is_empty() {
                return Some(Vec::new());
            }
            let has_settled = |joint: &usize| found.step[*joint].abs() < found.std[*joint];
            if far.iter().all(has_settled) {
                return self.told(rows, &delays, &found, far);
            }
        }
        None
    }

    /// Of some delays of all torques the one that leaves least; a slope alone does not lead to what is far away.
    fn nearest(&self, rows: &Rows<'_>) -> Option<f64> {
        let left = |delay: f64| -> Option<f64> {
            let mut stack = rows.shifted(&vec![delay; rows.arm.dof()]);
            stack.truncate(rows.stack.unknowns.len());
            let solution = self.solve_stack(&stack).ok()?;
            let residuals = stack.residuals(&solution.estimate);
            let sizes = residuals.iter().map(|r| norm(r)).filter(|size| *size > 0.0);
            Some(sizes.map(f64::ln).sum())
        };
        let mut best = (left(0.0)?, 0.0);
        for delay in STARTS {
            if let Some(left) = left(delay)
                && left < best.0
            {
                best = (left, delay);
            }
        }
        Some(best.1)
    }

    /// Of delays that are far from nothing those that matter.
    fn told(
        &self,
        rows: &Rows<'_>,
        delays: &[f64],
        found: &Found,
        far: Vec<usize>,
    ) -> Option<Vec<TorqueDelay>> {
        let solution = self.solve_stack(&rows.stack).ok()?;
        let before = rows.stack.residuals(&solution.estimate);
        let told = far.into_iter().map(|joint| TorqueDelay {
            joint,
            seconds: delays[joint],
            std: found.std[joint],
            gain: 1.0 - found.residuals[joint] / norm(&before[joint]),
        });
        let told: Vec<TorqueDelay> = told.collect();
        let sure: Vec<TorqueDelay> = told
            .iter()
            .filter(|told| told.gain > SHARE)
            .copied()
            .collect();
        // One bus or clock makes all torques late by the same, whatever else a joint's error has.
        let is_alike = |told: &TorqueDelay| {
            let mut sure = sure.iter();
            sure.any(|sure| (told.seconds - sure.seconds).abs() < ALIKE * told.std.hypot(sure.std))
        };
        Some(
            told.into_iter()
                .filter(|told| told.gain > SHARE || is_alike(told))
                .collect(),
        )
    }

    /// What is left of the delays of a stack whose last unknowns they are.
    fn further(&self, stack: &Stack) -> Option<Found> {
        let mut solution = self.solve_stack(stack).ok()?;
        // A delay that is left is in the residual, which is no noise then.
        solution.std = self.deviations_of_products(stack, &solution);
        let first = stack.unknowns.len() - stack.dof();
        let residuals = stack.residuals(&solution.estimate);
        let of = |joint: usize| {
            let own = first + joint;
            if solution.is_told(own) {
                (solution.estimate[own], solution.std[own])
            } else {
                (0.0, f64::INFINITY)
            }
        };
        let (step, std) = (0..stack.dof()).map(of).unzip();
        Some(Found {
            step,
            std,
            residuals: residuals.iter().map(|r| norm(r)).collect(),
        })
    }
}

impl<'a> Rows<'a> {
    /// Of a stack, with friction that the arm may not have.
    fn new(arm: &'a dyn Arm, logs: &'a [Prepared], stack: Stack, leave_out_turns: bool) -> Self {
        let mut rows = Self {
            arm,
            logs,
            silent: logs.iter().map(says_nothing).collect(),
            stack,
            leave_out_turns,
        };
        let sign = |log: &Prepared, joint: usize| -> Vec<f64> {
            let speeds = log.motion.wide.dq[joint].iter();
            let sign = |v: &f64| if *v == 0.0 { 0.0 } else { v.signum() };
            speeds.map(sign).collect()
        };
        let columns = |series: &dyn Fn(&Prepared, usize) -> Vec<f64>| -> Vec<Vec<f64>> {
            let joints = 0..arm.dof();
            let of = |joint| rows.filtered(joint, |log| series(log, joint));
            joints.map(of).collect()
        };
        let viscous = columns(&|log, joint| log.motion.smooth.dq[joint].clone());
        let dry = columns(&sign);
        let turns = columns(&|log, joint| {
            let mut slope = Vec::new();
            derivative(&sign(log, joint), 1.0 / log.rate_hz, &mut slope);
            slope
        });
        for columns in [viscous, dry, turns] {
            append(&mut rows.stack, columns);
        }
        clipped::clear_again(&mut rows.stack);
        if leave_out_turns {
            turns::leave_out(&mut rows.stack);
        }
        rows
    }

    /// A joint's series of all logs, as the rows have it: zero where the joint says nothing.
    fn filtered(&self, joint: usize, series: impl Fn(&Prepared) -> Vec<f64>) -> Vec<f64> {
        let mut all = Vec::new();
        let mut filtered = Vec::new();
        for (log, silent) in self.logs.iter().zip(&self.silent) {
            log.shared.apply(&series(log), &mut filtered);
            if silent.contains(&joint) {
                filtered.fill(0.0);
            }
            all.extend_from_slice(&filtered);
        }
        all
    }

    /// The same equations for the torque of so much later, and behind their columns the slopes of that torque.
    fn shifted(&self, delays: &[f64]) -> Stack {
        let mut stack = self.stack.clone();
        let mut slopes = Vec::new();
        for (joint, delay) in delays.iter().enumerate() {
            let gain = self.arm.actuator_gain()[joint];
            let later = |log: &Prepared| log.motion.late(&log.tau[joint], -delay);
            let moved = self.filtered(joint, |log| {
                let pairs = later(log).into_iter().zip(&log.tau[joint]);
                pairs.map(|(later, now)| gain * (later - now)).collect()
            });
            let rows = &mut stack.joints[joint];
            for values in [&mut rows.tau, &mut rows.target] {
                values.iter_mut().zip(&moved).for_each(|(x, by)| *x += by);
            }
            slopes.push(self.filtered(joint, |log| {
                let mut slope = Vec::new();
                derivative(&later(log), 1.0 / log.rate_hz, &mut slope);
                slope.iter().map(|x| -gain * x).collect()
            }));
        }
        append(&mut stack, slopes);
        clipped::clear_again(&mut stack);
        if self.leave_out_turns {
            turns::leave_out(&mut stack);
        }
        stack
    }
}

/// A column for each joint.
fn append(stack: &mut Stack, columns: Vec<Vec<f64>>) {
    let unknown = Unknown {
        name: String::new(),
        nonnegative: false,
    };
    let entries = columns.into_iter().enumerate();
    let entries = entries.map(|(joint, values)| Entry {
        joint,
        column: joint,
        values,
    });
    let entries: Vec<Entry> = entries.collect();
    stack.append(&vec![unknown; entries.len()], &entries);
}

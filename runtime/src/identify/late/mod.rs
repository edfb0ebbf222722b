//! Torque that comes later than positions, or earlier: a filter in the drive, a bus, another clock. Or the position of a joint does.
//!
//! A log whose torque is late by `d` has at `t` the torque of `t - d`, so `tau(t + d) = W beta`. About a delay that is known so far,
//! `tau + s dtau/dt = W beta`: the rest `s` of each joint is the parameter of a column beside the others, and the torque is shifted by it and
//! fitted again. As noise has nothing in common with its own slope, it leaves `s` where it is.
//!
//! Friction that a model lacks looks like a delay where a joint swings at one speed, and a joint that sticks where it turns round lets go
//! later than the sign of its velocity says. So each joint has three more columns, viscous friction, dry friction and the slope of that, and
//! free shapes have theirs: what is told is told apart from all of them, and of other torques than dry friction.

mod nearest;
mod position;

use nearest::nearest;

use super::shapes::with_slopes;
use super::stack::{Stack, norm, says_nothing};
use super::{Beyond, Identify, clipped, prepare_all, turns};
use crate::columns::{Arm, Entry, Unknown};
use crate::log::{LateChannel, Log};
use crate::signal::{Bands, Prepared, derivative};

/// What is told: so many deviations, and so large a part of a log's sample. Torque that is set at a sample and holds until the next is early by
/// half of that, and one more sample may go where the next one is computed, which is how a drive works and no fault.
const DEVIATIONS: f64 = 4.0;
const LATE: f64 = 0.25;
const HELD: f64 = 1.25;

/// By which share a joint's residual has to be less without the delay. A law of dry friction that the model does not have looks like one by up
/// to a twelfth, a coupling of a short log by up to a fifth.
const SHARE: f64 = 0.25;

/// Rows for an unknown below which any delay would be found.
const FEWEST: usize = 5;

/// What has to be left of a joint's torque, %, for a position to be asked whether it is late where no torque is.
const POOR: f64 = 3.0;

/// A joint whose delay is that of one that is sure, within so many deviations of both, is told without that.
const ALIKE: f64 = 3.0;

/// How often the torque is shifted until a step is below a deviation, and most of a shift at once, s: a slope says little of what is further
/// away. What does not settle is no delay.
const ROUNDS: usize = 8;
const MOST: f64 = 0.03;

/// A channel that is not of the time of the others.
///
/// # Examples
/// A torque that comes ten samples late, and a fit that does not ask:
/// ```
/// # mod pendulum { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/doc/pendulum.rs")); }
/// # use pendulum::{measure, pendulum};
/// # use robot_model::identify::{Beyond, Identify};
/// let mut log = measure(0.0);
/// log.tau[0].rotate_right(10);
/// let late = 10.0 / log.rate_hz();
/// let found = Identify::default().fit(&pendulum(), &[log.clone()])?.delays;
/// assert!(found.len() == 1 && (found[0].seconds - late).abs() < 0.1 * late);
/// let plain = Identify { beyond: Beyond::Deviations, ..Identify::default() };
/// assert!(plain.fit(&pendulum(), &[log])?.delays.is_empty());
/// # Ok::<(), robot_model::identify::IdentifyError>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct Delay {
    /// Which one of the joint.
    pub channel: LateChannel,
    /// The joint, from 0.
    pub joint: usize,
    /// By how much it is late, s; negative where it is early.
    pub seconds: f64,
    /// Standard deviation, s, from the errors' own series as those of parameters.
    pub std: f64,
    /// By which share the root mean square of the joint's residual is less without the delay.
    pub gain: f64,
}

/// Whether torque that is late by so many seconds, or early, is more than how a drive samples it; `period` is that of the log, s.
///
/// A torque that is set at a sample holds until the next one, so it may seem early by up to a whole period: late is more than a quarter of one,
/// early more than one and a quarter.
///
/// # Examples
/// ```
/// use robot_model::identify::is_delay;
/// assert!(is_delay(0.004, 0.001)); // four samples
/// assert!(!is_delay(-0.0005, 0.001)); // means over the interval behind the position
/// ```
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

/// Late torques that are told, and the sum of the logarithms of what is left without all delays of torques.
struct Torques {
    told: Vec<Delay>,
    left: f64,
}

impl Identify {
    /// Torques that are late or early, or the one position that is instead, for an estimate on its own stack; none where the logs do not
    /// say so or nobody asks.
    pub(super) fn delays(
        &self,
        arm: &dyn Arm,
        logs: &[Prepared],
        stack: Stack,
        (shapes, estimate): (&[f64], &[f64]),
    ) -> Vec<Delay> {
        if self.beyond < Beyond::Delays {
            return Vec::new();
        }
        let is_poor = stack
            .relative_percent(estimate)
            .iter()
            .any(|percent| *percent > POOR);
        let rows = self.late_rows(arm, logs, stack, (shapes, estimate));
        let counted: usize = rows.stack.counts().iter().sum();
        if counted < FEWEST * rows.stack.unknowns.len() {
            return Vec::new();
        }
        let Some(torques) = self.late_torques(&rows) else {
            return Vec::new();
        };
        // Positions take long, as all columns move with them.
        let position = (is_poor || !torques.told.is_empty())
            .then(|| self.late_position(&rows, (shapes, estimate), torques.left));
        position
            .flatten()
            .map_or(torques.told, |position| vec![position])
    }

    fn late_rows<'a>(
        &self,
        arm: &'a dyn Arm,
        logs: &'a [Prepared],
        stack: Stack,
        (shapes, estimate): (&[f64], &[f64]),
    ) -> Rows<'a> {
        let rows = |shapes: &[f64]| self.rows(arm, logs, shapes);
        let stack = with_slopes(arm, &rows, shapes, 0..shapes.len(), stack, estimate);
        Rows::new(arm, logs, stack, self.leave_out_turns)
    }

    /// The same of logs by the equations with accelerations, for an estimate that has done without; none where these cannot be solved.
    pub(super) fn delays_of_logs(
        &self,
        arm: &dyn Arm,
        logs: &[Log],
        bands: &Bands,
        shapes: &[f64],
    ) -> Vec<Delay> {
        if self.beyond < Beyond::Delays {
            return Vec::new();
        }
        let Ok(mut prepared) = prepare_all(logs, bands) else {
            return Vec::new();
        };
        let Ok((solution, shapes, stack)) = self.solve(arm, &mut prepared, Some(shapes.to_vec()))
        else {
            return Vec::new();
        };
        self.delays(arm, &prepared, stack, (&shapes, &solution.estimate))
    }

    /// Torques that are late or early; `None` where the rows are too few for more unknowns.
    fn late_torques(&self, rows: &Rows<'_>) -> Option<Torques> {
        let dof = rows.arm.dof();
        let period = longest_period(rows.logs);
        let mut delays = nearest(rows);
        let mut left = f64::INFINITY;
        for _ in 0..ROUNDS {
            let found = self.further(&rows.shifted(&delays))?;
            for (delay, step) in delays.iter_mut().zip(&found.step) {
                *delay += step.clamp(-MOST, MOST);
            }
            left = left.min(logarithm(&found.residuals));
            let is_far = |joint: &usize| {
                let (delay, std) = (delays[*joint], found.std[*joint]);
                delay.abs() > DEVIATIONS * std && is_delay(delay, period)
            };
            let far: Vec<usize> = (0..dof).filter(is_far).collect();
            let has_settled = |joint: &usize| found.step[*joint].abs() < found.std[*joint];
            if far.iter().all(has_settled) {
                let told = self.told(rows, &delays, &found, far)?;
                let left = logarithm(&found.residuals);
                return Some(Torques { told, left });
            }
        }
        // No delay of torques is the answer.
        Some(Torques {
            told: Vec::new(),
            left,
        })
    }

    /// Of delays that are far from nothing those that matter.
    fn told(
        &self,
        rows: &Rows<'_>,
        delays: &[f64],
        found: &Found,
        far: Vec<usize>,
    ) -> Option<Vec<Delay>> {
        let solution = self.solve_stack(&rows.stack).ok()?;
        let before = rows.stack.residuals(&solution.estimate);
        let told = far.into_iter().map(|joint| Delay {
            channel: LateChannel::Torque,
            joint,
            seconds: delays[joint],
            std: found.std[joint],
            gain: 1.0 - found.residuals[joint] / norm(&before[joint]),
        });
        let told: Vec<Delay> = told.collect();
        let sure: Vec<Delay> = told
            .iter()
            .filter(|told| told.gain > SHARE)
            .copied()
            .collect();
        // One bus or clock makes all torques late by the same, whatever else a joint's error has.
        let is_alike = |told: &Delay| {
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

    /// What a joint's torque of so much later has more than that of now, as rows have it.
    fn moved(&self, joint: usize, delay: f64) -> Vec<f64> {
        let gain = self.arm.actuator_gain()[joint];
        self.filtered(joint, |log| {
            let later = log.motion.late(&log.tau[joint], -delay);
            let pairs = later.into_iter().zip(&log.tau[joint]);
            pairs.map(|(later, now)| gain * (later - now)).collect()
        })
    }

    /// Rows that were left out say nothing of columns that came later, either.
    fn leave_out(&self, stack: &mut Stack) {
        clipped::clear_again(stack);
        if self.leave_out_turns {
            turns::leave_out(stack);
        }
    }

    /// The same equations for the torque of so much later, and behind their columns the slopes of that torque.
    fn shifted(&self, delays: &[f64]) -> Stack {
        let mut stack = self.stack.clone();
        let mut slopes = Vec::new();
        for (joint, delay) in delays.iter().enumerate() {
            let later = |log: &Prepared| log.motion.late(&log.tau[joint], -delay);
            let moved = self.moved(joint, *delay);
            let rows = &mut stack.joints[joint];
            for values in [&mut rows.tau, &mut rows.target] {
                values.iter_mut().zip(&moved).for_each(|(x, by)| *x += by);
            }
            let gain = self.arm.actuator_gain()[joint];
            slopes.push(self.filtered(joint, |log| {
                let mut slope = Vec::new();
                derivative(&later(log), 1.0 / log.rate_hz, &mut slope);
                slope.iter().map(|x| -gain * x).collect()
            }));
        }
        append(&mut stack, slopes);
        self.leave_out(&mut stack);
        stack
    }
}

/// Sum of the logarithms of lengths of residuals, of which joints that say nothing have none.
fn logarithm(residuals: &[f64]) -> f64 {
    let sizes = residuals.iter().filter(|size| **size > 0.0);
    sizes.map(|size| size.ln()).sum()
}

/// A column for each joint.
fn append(stack: &mut Stack, columns: Vec<Vec<f64>>) {
    let entries = columns.into_iter().enumerate();
    let entries = entries.map(|(joint, values)| Entry {
        joint,
        column: joint,
        values,
    });
    let entries: Vec<Entry> = entries.collect();
    stack.append(&vec![nameless(); entries.len()], &entries);
}

fn nameless() -> Unknown {
    Unknown {
        name: String::new(),
        nonnegative: false,
    }
}

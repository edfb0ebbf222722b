//! Torque that comes later than positions, or earlier: a filter in the drive, a bus, another clock. Or the position of a joint does.
//!
//! A log whose torque is late by `d` has at `t` the torque of `t - d`, so `tau(t + d) = W beta`. About a delay that is known so far,
//! `tau + s dtau/dt = W beta`: the rest `s` of each joint is the parameter of a column beside the others, and the torque is shifted by it and
//! fitted again. As noise has nothing in common with its own slope, it leaves `s` where it is.
//!
//! Friction that a model lacks looks like a delay where a joint swings at one speed, and a joint that sticks where it turns round lets go
//! later than the sign of its velocity says. So each joint has three more columns, viscous friction, dry friction and the slope of that, and
//! free shapes have theirs: what is told is told apart from all of them, and of other torques than dry friction.

mod excerpt;
mod lasting;
mod nearest;
mod position;
mod rows;

use excerpt::{LONGEST, excerpts};
use lasting::lasting_gain;
use nearest::nearest;
use rows::Rows;

use super::shapes::with_slopes;
use super::stack::{Stack, norm};
use super::{Beyond, Identify, prepare_all, slope};
use crate::columns::Arm;
use crate::log::{LateChannel, Log};
use crate::signal::{Bands, Prepared};

/// What is told: so many deviations, and so large a part of a log's sample. Torque that is set at a sample and holds until the next is early by
/// half of that, and one more sample may go where the next one is computed, which is how a drive works and no fault.
const DEVIATIONS: f64 = 4.0;
const LATE: f64 = 0.25;
const HELD: f64 = 1.25;

/// By which share a joint's residual has to be less without the delay. A law of dry friction that the model does not have looks like one by up
/// to a twelfth, a coupling of a short log by up to a fifth.
const SHARE: f64 = 0.25;

/// The same of one that is early, which no drive or bus makes: friction that grows with the load looks like one by up to a third.
const EARLY_SHARE: f64 = 0.4;

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
    /// By which share the root mean square of the joint's residual is less without the delay, all along the logs: without the tenth of the
    /// rows that says most of it.
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

/// Whether a torque is as early as one that is set at a sample and holds until the next.
fn is_held(seconds: f64, period: f64) -> bool {
    (-HELD..-LATE).contains(&(seconds / period))
}

/// Channels that are not of the time of the others.
#[derive(Default)]
pub(super) struct Late {
    /// Torques that are late or early, or the one position that is instead.
    pub told: Vec<Delay>,
    /// Torques that are as early as held ones are, where there are no others.
    pub held: Vec<Delay>,
}

/// Time from one sample to the next of the slowest log, s.
pub(crate) fn longest_period(logs: &[Prepared]) -> f64 {
    let periods = logs
        .iter()
        .map(|log| 1.0 / (log.rate_hz * log.stride as f64));
    periods.fold(0.0, f64::max)
}

/// Delays with their deviations, and the residuals.
struct Found {
    step: Vec<f64>,
    std: Vec<f64>,
    residuals: Vec<Vec<f64>>,
}

/// Late torques that are told, and the sum of the logarithms of what is left without all delays of torques.
struct Torques {
    told: Vec<Delay>,
    held: Vec<Delay>,
    left: f64,
}

impl Identify {
    /// The same as [`Self::delays`] for an estimate on the stack of logs, of which the middle is asked where they are long.
    pub(super) fn delays_in(
        &self,
        arm: &dyn Arm,
        (logs, prepared, bands): (&[Log], &[Prepared], &Bands),
        stack: &Stack,
        at: (&[f64], &[f64]),
    ) -> Late {
        if logs.iter().any(|log| log.seconds() > LONGEST) {
            return self.delays_of_logs(arm, logs, bands, at.0);
        }
        self.delays(arm, prepared, stack.clone(), at)
    }

    /// Torques that are late or early, or the one position that is instead, for an estimate on its own stack; none where the logs do not
    /// say so or nobody asks.
    fn delays(
        &self,
        arm: &dyn Arm,
        logs: &[Prepared],
        stack: Stack,
        (shapes, estimate): (&[f64], &[f64]),
    ) -> Late {
        if self.beyond < Beyond::Delays {
            return Late::default();
        }
        let is_poor = stack
            .relative_percent(estimate)
            .iter()
            .any(|percent| *percent > POOR);
        let rows = self.late_rows(arm, logs, stack, (shapes, estimate));
        let mut late = self.late_in(&rows, (shapes, estimate), is_poor);
        if late.told.is_empty() {
            return late;
        }
        // What friction that the arm does not have makes at turns of its joints is no delay: one is told without these rows, too.
        let sticky = self.sticky(&rows);
        if !sticky.is_empty() {
            let stuck = rows.stuck_at(&sticky);
            let away = self.late_in(&rows.without(&stuck), (shapes, estimate), is_poor);
            let is_in = |told: &Delay| {
                let mut both = late.told.iter();
                both.any(|one| (one.channel, one.joint) == (told.channel, told.joint))
            };
            late.told = away.told.into_iter().filter(is_in).collect();
        }
        late
    }

    /// The same by given rows.
    fn late_in(&self, rows: &Rows<'_>, at: (&[f64], &[f64]), is_poor: bool) -> Late {
        let counted: usize = rows.stack.counts().iter().sum();
        if counted < FEWEST * rows.stack.unknowns.len() {
            return Late::default();
        }
        let Some(torques) = self.late_torques(rows) else {
            return Late::default();
        };
        // Positions take long, as all columns move with them.
        let position = (is_poor || !torques.told.is_empty())
            .then(|| self.late_position(rows, at, torques.left));
        let position = position.flatten();
        let told = position.map_or(torques.told, |position| vec![position]);
        let held = if told.is_empty() {
            torques.held
        } else {
            Vec::new()
        };
        Late { told, held }
    }

    /// Joints with dry friction that the arm does not have: what holds them where they turn is no delay, either.
    fn sticky(&self, rows: &Rows<'_>) -> Vec<usize> {
        let Ok(mut solution) = self.solve_stack(&rows.stack) else {
            return Vec::new();
        };
        solution.std = self.deviations_of_products(&rows.stack, &solution);
        let is_sure = |column: usize| {
            solution.is_told(column)
                && solution.estimate[column] > DEVIATIONS * solution.std[column]
        };
        let dry = rows.dry().filter(|(_, column)| is_sure(*column));
        dry.map(|(joint, _)| joint).collect()
    }

    fn late_rows<'a>(
        &self,
        arm: &'a dyn Arm,
        logs: &'a [Prepared],
        stack: Stack,
        (shapes, estimate): (&[f64], &[f64]),
    ) -> Rows<'a> {
        let rows = |shapes: &[f64]| self.rows(arm, logs, shapes);
        let stack = with_slopes(
            arm,
            &rows,
            shapes,
            0..shapes.len(),
            stack,
            estimate,
            slope::across_jumps,
        );
        Rows::new(arm, logs, stack)
    }

    /// The same of logs by the equations with accelerations, for an estimate that has done without; none where these cannot be solved.
    pub(super) fn delays_of_logs(
        &self,
        arm: &dyn Arm,
        logs: &[Log],
        bands: &Bands,
        shapes: &[f64],
    ) -> Late {
        if self.beyond < Beyond::Delays {
            return Late::default();
        }
        let excerpts = excerpts(logs);
        let logs = excerpts.as_deref().unwrap_or(logs);
        let Ok(mut prepared) = prepare_all(logs, bands) else {
            return Late::default();
        };
        let Ok((solution, shapes, stack)) = self.solve(arm, &mut prepared, Some(shapes.to_vec()))
        else {
            return Late::default();
        };
        self.delays(arm, &prepared, stack, (&shapes, &solution.estimate))
    }

    /// Torques that are late or early; `None` where the rows are too few for more unknowns.
    fn late_torques(&self, rows: &Rows<'_>) -> Option<Torques> {
        let dof = rows.arm.dof();
        let period = longest_period(rows.logs);
        let mut delays = nearest(rows);
        let mut left = f64::INFINITY;
        for round in 1..=ROUNDS {
            let found = self.further(&rows.shifted(&delays))?;
            for (delay, step) in delays.iter_mut().zip(&found.step) {
                *delay += step.clamp(-MOST, MOST);
            }
            left = left.min(logarithm(lengths(&found.residuals)));
            let is_seen = |joint: &usize| {
                rows.moves(*joint) && delays[*joint].abs() > DEVIATIONS * found.std[*joint]
            };
            let of = |is: fn(f64, f64) -> bool| -> Vec<usize> {
                let seen = (0..dof).filter(is_seen);
                seen.filter(|joint| is(delays[*joint], period)).collect()
            };
            let far = of(is_delay);
            let has_settled = |joint: &usize| found.step[*joint].abs() < found.std[*joint];
            let mut held = of(is_held);
            // Whether a torque is held is worth no more than the rounds that there are.
            if far.iter().all(has_settled) && (round == ROUNDS || held.iter().all(has_settled)) {
                held.retain(has_settled);
                let told = self.told(rows, &delays, &found, (far, EARLY_SHARE))?;
                let mut held = self.told(rows, &delays, &found, (held, SHARE))?;
                held.retain(|held| held.gain > SHARE);
                let left = logarithm(lengths(&found.residuals));
                return Some(Torques { told, held, left });
            }
        }
        // No delay of torques is the answer.
        Some(Torques {
            told: Vec::new(),
            held: Vec::new(),
            left,
        })
    }

    /// Of delays that are far from nothing those that matter.
    fn told(
        &self,
        rows: &Rows<'_>,
        delays: &[f64],
        found: &Found,
        (far, early_share): (Vec<usize>, f64),
    ) -> Option<Vec<Delay>> {
        let is_sure = |told: &Delay| {
            let is_early = told.seconds < 0.0;
            told.gain > if is_early { early_share } else { SHARE }
        };
        let solution = self.solve_stack(&rows.stack).ok()?;
        let before = rows.stack.residuals(&solution.estimate);
        let told = far.into_iter().map(|joint| Delay {
            channel: LateChannel::Torque,
            joint,
            seconds: delays[joint],
            std: found.std[joint],
            gain: lasting_gain(&before[joint], &found.residuals[joint]),
        });
        let told: Vec<Delay> = told.collect();
        let sure: Vec<Delay> = told.iter().filter(|told| is_sure(told)).copied().collect();
        // One bus or clock makes all torques late by the same, whatever else a joint's error has.
        let is_alike = |told: &Delay| {
            let mut sure = sure.iter();
            sure.any(|sure| (told.seconds - sure.seconds).abs() < ALIKE * told.std.hypot(sure.std))
        };
        Some(
            told.into_iter()
                .filter(|told| is_sure(told) || is_alike(told))
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
            residuals,
        })
    }
}

/// Sum of the logarithms of lengths of residuals, of which joints that say nothing have none.
fn logarithm(sizes: impl Iterator<Item = f64>) -> f64 {
    sizes.filter(|size| *size > 0.0).map(f64::ln).sum()
}

fn lengths(residuals: &[Vec<f64>]) -> impl Iterator<Item = f64> {
    residuals.iter().map(|residuals| norm(residuals))
}

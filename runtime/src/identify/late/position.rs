//! One joint whose position is not of the time of all else, as of an encoder with a filter or a bus of its own.
//!
//! Torques of all joints that read the position look late or early then, each by another time, and none of these delays mends the log. With
//! the position of joint `j` late by `d`, `tau(t) = W(q_j(t + d)) beta`. About a delay that is known so far the rest is the parameter of the
//! column `d(W beta)/dd`, and the motion is moved by it and fitted again.

use super::nearest::TRIED;
use super::{DEVIATIONS, Delay, MOST, ROUNDS, Rows, SHARE};
use super::{is_delay, lasting_gain, lengths, logarithm, longest_period};
use crate::columns::Entry;
use crate::identify::Identify;
use crate::identify::stack::{Stack, nameless};
use crate::log::LateChannel;
use crate::signal::Prepared;
use crate::threads;

/// By how much the sum of the logarithms of residuals has to be less without it than without late torques, of which there are more.
const FITS_BETTER: f64 = 0.05;

/// A delay of a position, and what is left without it.
struct Found {
    seconds: f64,
    std: f64,
    residuals: Vec<Vec<f64>>,
}

impl Identify {
    /// The position that is late or early where that leaves clearly less than late torques do, which leave `left`.
    pub(super) fn late_position(
        &self,
        rows: &Rows<'_>,
        at: (&[f64], &[f64]),
        left: f64,
    ) -> Option<Delay> {
        // Of one joint alone either may be late.
        if rows.arm.dof() < 2 {
            return None;
        }
        let period = longest_period(rows.logs);
        let before = self.solve_stack(&rows.stack).ok()?;
        let before = rows.stack.residuals(&before.estimate);
        let moving = (0..rows.arm.dof()).filter(|joint| rows.moves(*joint));
        let delays = threads::map(&moving.collect::<Vec<_>>(), |&joint| {
            let found = self.moved_back(rows, joint, at, left)?;
            let left = logarithm(lengths(&found.residuals));
            let delay = Delay {
                channel: LateChannel::Position,
                joint,
                seconds: found.seconds,
                std: found.std,
                gain: lasting_gain(&before[joint], &found.residuals[joint]),
            };
            Some((left, delay))
        });
        let delays = delays.into_iter().flatten();
        let (least, delay) = delays.min_by(|x, y| x.0.total_cmp(&y.0))?;
        // What a drive's sampling makes early in a torque, it makes late in a position.
        let is_told = least < left - FITS_BETTER
            && delay.gain > SHARE
            && delay.seconds.abs() > DEVIATIONS * delay.std
            && is_delay(-delay.seconds, period);
        is_told.then_some(delay)
    }

    /// The delay of a joint's position that leaves least; `None` where it does not settle, or a step does not promise less than late torques
    /// leave.
    fn moved_back(
        &self,
        rows: &Rows<'_>,
        joint: usize,
        at: (&[f64], &[f64]),
        of_torques: f64,
    ) -> Option<Found> {
        let h = longest_period(rows.logs);
        let mut seconds = self.nearest_position(rows, joint, at)?;
        for round in 0..ROUNDS {
            let mut here = self.rows_without(rows, (joint, seconds), at);
            let solution = self.solve_stack(&here).ok()?;
            let next = self.rows_without(rows, (joint, seconds + h), at);
            let next = next.residuals(&solution.estimate);
            let residuals = here.residuals(&solution.estimate);
            let slopes = residuals.iter().zip(&next).enumerate();
            let slopes = slopes.map(|(joint, (here, next))| Entry {
                joint,
                column: 0,
                values: here.iter().zip(next).map(|(x, y)| (x - y) / h).collect(),
            });
            here.append(&[nameless()], &slopes.collect::<Vec<_>>());
            let mut solution = self.solve_stack(&here).ok()?;
            let residuals = here.residuals(&solution.estimate);
            // The first step begins far from where it ends.
            if round > 0 && logarithm(lengths(&residuals)) > of_torques {
                return None;
            }
            solution.std = self.deviations_of_products(&here, &solution);
            let own = here.unknowns.len() - 1;
            if !solution.is_told(own) {
                return None;
            }
            let (step, std) = (solution.estimate[own], solution.std[own]);
            if step.abs() < std {
                return Some(Found {
                    seconds: seconds + step,
                    std,
                    residuals,
                });
            }
            seconds += step.clamp(-MOST, MOST);
        }
        None
    }

    /// Of the delays that are tried first the one that leaves least.
    fn nearest_position(&self, rows: &Rows<'_>, joint: usize, at: (&[f64], &[f64])) -> Option<f64> {
        let tried = TRIED.iter().filter_map(|&seconds| {
            let stack = self.rows_without(rows, (joint, seconds), at);
            let solution = self.solve_stack(&stack).ok()?;
            let left = logarithm(lengths(&stack.residuals(&solution.estimate)));
            Some((left, seconds))
        });
        let (_, seconds) = tried.min_by(|x, y| x.0.total_cmp(&y.0))?;
        Some(seconds)
    }

    /// The equations with a joint's position of so much later.
    fn rows_without(
        &self,
        rows: &Rows<'_>,
        (joint, seconds): (usize, f64),
        (shapes, estimate): (&[f64], &[f64]),
    ) -> Stack {
        let logs = rows.logs.iter().map(|log| earlier(log, joint, seconds));
        let logs: Vec<Prepared> = logs.collect();
        let stack = self.rows(rows.arm, &logs, shapes);
        self.late_rows(rows.arm, &logs, stack, (shapes, estimate))
            .without(&rows.stuck)
            .stack
    }
}

/// A log with the position of a joint, and what is computed from it, of so much later.
fn earlier(log: &Prepared, joint: usize, seconds: f64) -> Prepared {
    let mut log = log.clone();
    let motion = log.motion.clone();
    for kinematics in [&mut log.motion.smooth, &mut log.motion.wide] {
        let channels = [&mut kinematics.q, &mut kinematics.dq, &mut kinematics.ddq];
        for channel in channels {
            // A motion that was prepared without accelerations has no channels of them.
            if let Some(values) = channel.get_mut(joint) {
                *values = motion.late(values, -seconds);
            }
        }
    }
    log
}

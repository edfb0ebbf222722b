//! What the present model leaves of the raw torque, at the full rate of the motion.

use crate::columns::Arm;
use crate::identify::{Segment, left_out, torque_of, whole_torque};
use crate::signal::Prepared;
use crate::signal::resample::whole_steps;

use super::calm::{Calmest, calmest};
use super::floor::STEPS_OVER_NOISE;
use super::periodic;
use super::search::{Accepted, Search, State};
use super::structure::{self, RawResidual, Structure};

impl Search<'_> {
    /// Raw residuals of the present model along the logs' motion that leaves each joint least.
    pub(super) fn raw_residuals(&self, state: &State) -> Calmest {
        calmest(
            self.motions()
                .map(|logs| self.raw_residuals_along(state, logs)),
        )
    }

    /// Those along one motion of the logs, `[log][joint][sample]`, both ends cut.
    pub(super) fn raw_residuals_along(
        &self,
        state: &State,
        logs: &[Prepared],
    ) -> Vec<Vec<Vec<f64>>> {
        let of_log = |log: &Prepared| {
            let estimate = &state.solution.estimate;
            raw_residuals(self.arm, &self.shapes, estimate, &state.accepted, log)
        };
        logs.iter().map(of_log).collect()
    }

    /// Torque of the present model along a log, `[joint][sample]`.
    pub(super) fn torque(&self, state: &State, log: &Prepared) -> Vec<Vec<f64>> {
        torque(
            self.arm,
            &self.shapes,
            &state.solution.estimate,
            &state.accepted,
            log,
        )
    }

    /// Mean square of a joint's torque that decimation took off.
    fn beyond(&self, log: &Prepared, joint: usize) -> f64 {
        self.arm.actuator_gain()[joint].powi(2) * log.tau_beyond[joint]
    }

    /// Mean square of each joint's torque that decimation took off, over all logs; the logs are those of [`Self::raw_residuals`].
    pub(super) fn beyond_all(&self, logs: &[Vec<Vec<f64>>]) -> Vec<f64> {
        let of_joint = |j: usize| {
            let count: usize = logs.iter().map(|log| log[j].len()).sum();
            let sums = logs.iter().zip(&self.prepared);
            let sums = sums.map(|(log, prepared)| log[j].len() as f64 * self.beyond(prepared, j));
            sums.sum::<f64>() / count.max(1) as f64
        };
        (0..self.arm.dof()).map(of_joint).collect()
    }

    /// Mean square, over all rows, of what comes back in every period of the motion in a joint's residual.
    pub(super) fn repeated_power(&self, state: &State, residual: &[f64]) -> f64 {
        let logs = state
            .stack
            .segments
            .iter()
            .zip(&self.prepared)
            .zip(&self.periods);
        let power = logs.map(|((segment, log), period)| {
            let rate_hz = log.filtered_hz();
            let rows = evenly(segment, residual, rate_hz);
            let power = |period: &f64| periodic::repeated_power(&rows, period * rate_hz);
            rows.len() as f64 * period.as_ref().map_or(0.0, power)
        });
        power.sum::<f64>() / residual.len().max(1) as f64
    }

    /// Structure per joint, of turns and what is away from them alike.
    pub(super) fn structure_of_all_rows(&self, state: &State) -> Vec<Structure> {
        let steps = self.steps(state);
        self.structure_with(state, &|joint, log| {
            steps[joint][log].map_or(0.0, |step| step.taken)
        })
    }

    /// The same but for torques that step once: what no law that follows the motion or the load takes off.
    pub(super) fn structure_without_steps<'a>(&self, state: &'a State) -> &'a [Structure] {
        let found = || self.structure_with(state, &|_, _| 0.0);
        state.looks.without_steps.get_or_init(found)
    }

    /// Structure per joint of the present model, of whose residual steps take so much off.
    fn structure_with(
        &self,
        state: &State,
        stepped: &dyn Fn(usize, usize) -> f64,
    ) -> Vec<Structure> {
        let raw = self.raw_residuals(state).residuals;
        self.structure_in(&state.stack.segments, &raw, &state.residuals, stepped)
    }

    /// Structure per joint of raw residuals, `[log][joint][sample]`, and filtered ones, `[joint][row]`, of which steps take so much off.
    pub(super) fn structure_in(
        &self,
        segments: &[Segment],
        raw: &[Vec<Vec<f64>>],
        filtered: &[Vec<f64>],
        stepped: &dyn Fn(usize, usize) -> f64,
    ) -> Vec<Structure> {
        let of = |joint: usize, log: usize| {
            let prepared = &self.prepared[log];
            RawResidual {
                values: &raw[log][joint],
                beyond: self.beyond(prepared, joint),
                filtered: evenly(&segments[log], &filtered[joint], prepared.filtered_hz()),
                filtered_hz: prepared.filtered_hz(),
                rate_hz: prepared.rate_hz,
                shared_hz: self.shared_hz,
                period: self.periods[log],
                stepped: stepped(joint, log),
                encoder: STEPS_OVER_NOISE * self.position_noise[joint].filtered,
            }
        };
        let of_joint = |joint: usize| {
            let logs: Vec<RawResidual> = (0..raw.len()).map(|log| of(joint, log)).collect();
            structure::of(&logs)
        };
        (0..self.arm.dof()).map(of_joint).collect()
    }
}

/// A log's rows of a series, one for each step of its decimated time: zero where a hole has none.
pub(super) fn evenly(segment: &Segment, series: &[f64], rate_hz: f64) -> Vec<f64> {
    let (Some(first), Some(last)) = (segment.time.first(), segment.time.last()) else {
        return Vec::new();
    };
    let place = |time: f64| whole_steps(((time - first) * rate_hz).round());
    let mut even = vec![0.0; place(*last) + 1];
    for (time, value) in segment.time.iter().zip(&series[segment.start..]) {
        even[place(*time)] = *value;
    }
    even
}

/// Which samples of a log's raw residuals say nothing, `[joint][sample]`.
pub(super) fn left_out(arm: &dyn Arm, log: &Prepared) -> Vec<Vec<bool>> {
    let joints = (0..arm.dof()).map(|joint| {
        let mut all = left_out::samples(arm, log, joint);
        let border = log.shared.border().min(all.len());
        all.split_off(border)
    });
    joints.collect()
}

/// Makes such samples zero, as rows of the fit are there.
pub(super) fn clear(residuals: &mut [Vec<f64>], left_out: &[Vec<bool>]) {
    for (residuals, left_out) in residuals.iter_mut().zip(left_out) {
        for (residual, _) in residuals.iter_mut().zip(left_out).filter(|(_, out)| **out) {
            *residual = 0.0;
        }
    }
}

/// Torque of an arm at an estimate, whose last numbers are those of accepted effects: `[joint][sample]` of one log.
fn torque(
    arm: &dyn Arm,
    shapes: &[f64],
    estimate: &[f64],
    accepted: &[Accepted],
    log: &Prepared,
) -> Vec<Vec<f64>> {
    let dof = arm.dof();
    let mut torque = whole_torque(arm, &log.motion, shapes, estimate);
    let mut first = arm.unknowns().len();
    for effect in accepted {
        let trial = &effect.trial;
        let own = &estimate[first..first + trial.count()];
        let part = torque_of(trial.candidate, &log.motion, &trial.shapes, own, dof);
        for (sum, part) in torque.iter_mut().zip(part) {
            sum.iter_mut().zip(part).for_each(|(s, p)| *s += p);
        }
        first += trial.count();
    }
    torque
}

/// Raw torque less that of an arm at an estimate, whose last numbers are those of accepted effects: `[joint][sample]` of one log, both
/// ends cut; zero where samples say nothing.
pub(super) fn raw_residuals(
    arm: &dyn Arm,
    shapes: &[f64],
    estimate: &[f64],
    accepted: &[Accepted],
    log: &Prepared,
) -> Vec<Vec<f64>> {
    let torque = torque(arm, shapes, estimate, accepted, log);
    let inner = log.shared.border()..log.motion.time.len().saturating_sub(log.shared.border());
    let mut residuals: Vec<Vec<f64>> = (0..arm.dof())
        .map(|j| {
            let gain = arm.actuator_gain()[j];
            inner
                .clone()
                .map(|k| gain * log.tau[j][k] - torque[j][k])
                .collect()
        })
        .collect();
    clear(&mut residuals, &left_out(arm, log));
    residuals
}

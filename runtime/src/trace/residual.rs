//! What the present model leaves of the raw torque, at the full rate of the motion.

use crate::identify::torque_of;
use crate::signal::Prepared;

use super::search::{Search, State};
use super::structure::{self, RawResidual, Structure};

impl Search<'_> {
    /// Raw residuals of one log, `[joint][sample]`, both ends cut.
    fn raw_residuals(&self, state: &State, log: &Prepared) -> Vec<Vec<f64>> {
        let own = self.arm.unknowns().len();
        let mut torque = torque_of(
            self.arm,
            &log.motion,
            &self.shapes,
            &state.solution.estimate,
            self.arm.dof(),
        );
        let mut first = own;
        for effect in &state.accepted {
            let estimate = &state.solution.estimate[first..first + effect.trial.count()];
            let part = torque_of(
                effect.trial.candidate,
                &log.motion,
                &effect.trial.shapes,
                estimate,
                self.arm.dof(),
            );
            for (sum, part) in torque.iter_mut().zip(part) {
                sum.iter_mut().zip(part).for_each(|(s, p)| *s += p);
            }
            first += effect.trial.count();
        }
        let known = self.arm.known_torque(&log.motion, &self.shapes);
        let inner = log.shared.border()..log.motion.time.len().saturating_sub(log.shared.border());
        (0..self.arm.dof())
            .map(|j| {
                let gain = self.arm.actuator_gain()[j];
                inner
                    .clone()
                    .map(|k| gain * log.tau[j][k] - known[j][k] - torque[j][k])
                    .collect()
            })
            .collect()
    }

    /// Mean square of the raw residual per joint over all logs, what decimation took off the torque with it; the logs are those of
    /// [`Self::raw_residuals`].
    fn raw_power(&self, logs: &[Vec<Vec<f64>>]) -> Vec<f64> {
        let of_joint = |j: usize| {
            let count: usize = logs.iter().map(|log| log[j].len()).sum();
            let square = logs.iter().zip(&self.prepared).map(|(log, prepared)| {
                let beyond = log[j].len() as f64 * self.beyond(prepared, j);
                log[j].iter().map(|r| r * r).sum::<f64>() + beyond
            });
            square.sum::<f64>() / count.max(1) as f64
        };
        (0..self.arm.dof()).map(of_joint).collect()
    }

    /// Mean square of a joint's torque that decimation took off.
    fn beyond(&self, log: &Prepared, joint: usize) -> f64 {
        self.arm.actuator_gain()[joint].powi(2) * log.tau_beyond[joint]
    }

    /// Mean square of the raw residual beyond that of the filtered one, per joint.
    pub(super) fn noise_power(&self, state: &State) -> Vec<f64> {
        let raw: Vec<_> = self
            .prepared
            .iter()
            .map(|log| self.raw_residuals(state, log))
            .collect();
        let filtered = state
            .residuals
            .iter()
            .map(|r| r.iter().map(|r| r * r).sum::<f64>() / r.len().max(1) as f64);
        let raw = self.raw_power(&raw);
        raw.iter()
            .zip(filtered)
            .map(|(raw, filtered)| (raw - filtered).max(0.0))
            .collect()
    }

    /// Structure per joint, and the power of what is not structure.
    pub(super) fn structure(&self, state: &State) -> (Vec<Structure>, Vec<f64>) {
        let raw: Vec<_> = self
            .prepared
            .iter()
            .map(|log| self.raw_residuals(state, log))
            .collect();
        let of_joint = |j: usize| {
            let logs: Vec<RawResidual> = raw
                .iter()
                .zip(&self.prepared)
                .zip(&self.periods)
                .zip(&state.stack.segments)
                .map(|(((residuals, log), period), segment)| RawResidual {
                    values: &residuals[j],
                    beyond: self.beyond(log, j),
                    filtered: &state.residuals[j]
                        [segment.start..segment.start + segment.time.len()],
                    filtered_hz: log.rate_hz / log.shared.stride() as f64,
                    rate_hz: log.rate_hz,
                    shared_hz: self.shared_hz,
                    period: *period,
                })
                .collect();
            structure::of(&logs)
        };
        let found: Vec<Structure> = (0..self.arm.dof()).map(of_joint).collect();
        let power = self.raw_power(&raw);
        let noise = power
            .iter()
            .zip(&found)
            .map(|(p, s)| (p - s.power).max(0.0))
            .collect();
        (found, noise)
    }
}

//! An estimate on a log: the torque that it predicts, and how far that is from the measured one.

use std::ops::Range;

use super::clipped::rows_at;
use super::errors::Errors;
use super::logs::prepare_at_own_rate;
use super::stack::{norm, percent, whole_torque};
use super::{Estimate, IdentifyError, load_motion, turns};
use crate::columns::Arm;
use crate::log::Log;
use crate::signal::Prepared;
use crate::signal::resample::whole_steps;

/// Cut from either end of a log before errors are computed on raw samples, s.
const ERROR_BORDER_S: f64 = 1.0;

/// Samples of a log at a rate, Hz, whose errors count: all but those of a second at either end, or of a quarter of a shorter log.
///
/// # Examples
/// ```
/// use robot_model::identify::judged_samples;
/// assert_eq!(judged_samples(5000, 1000.0), 1000..4000);
/// assert_eq!(judged_samples(2000, 1000.0), 500..1500);
/// ```
#[must_use]
pub fn judged_samples(count: usize, rate_hz: f64) -> Range<usize> {
    within(count, whole_steps(ERROR_BORDER_S * rate_hz))
}

fn within(count: usize, border: usize) -> Range<usize> {
    let border = border.min(count / 4);
    border..count - border
}

impl Estimate {
    /// Torque that the model predicts at every time stamp of a log, `[joint][sample]`, N m or N.
    ///
    /// The motion is filtered by [`Self::motion_bands`], or less where the log comes too slowly for them
    /// ([`Bands::at_rate`](crate::signal::Bands::at_rate)); nothing is fitted on the log.
    ///
    /// # Errors
    /// [`IdentifyError`] where the log is of another arm or cannot be filtered.
    ///
    /// # Examples
    /// ```
    /// # mod pendulum { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/doc/pendulum.rs")); }
    /// # use pendulum::{measure, pendulum};
    /// # use robot_model::identify::Identify;
    /// let (arm, log) = (pendulum(), measure(0.0));
    /// let estimate = Identify::default().fit(&arm, std::slice::from_ref(&log))?;
    /// let torque = estimate.predict(&arm, &log)?;
    /// assert_eq!(torque[0].len(), log.time.len());
    /// assert!((torque[0][5000] - log.tau[0][5000]).abs() < 0.1);
    /// # Ok::<(), robot_model::identify::IdentifyError>(())
    /// ```
    pub fn predict(&self, arm: &dyn Arm, log: &Log) -> Result<Vec<Vec<f64>>, IdentifyError> {
        let prepared = prepare_at_own_rate(arm, log, self.motion_bands)?;
        let torque = self.torque(arm, &prepared);
        let stride = prepared.stride;
        Ok(torque
            .iter()
            .map(|values| spread(values, stride, log.time.len()))
            .collect())
    }

    /// Errors on a log, which was or was not fitted.
    ///
    /// # Errors
    /// Those of [`Self::predict`].
    ///
    /// # Examples
    /// What the model lacks, dry friction of 0.7 N m, shows in the error.
    /// ```
    /// # mod pendulum { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/doc/pendulum.rs")); }
    /// # use pendulum::{measure, pendulum};
    /// # use robot_model::identify::Identify;
    /// let arm = pendulum();
    /// let estimate = Identify::default().fit(&arm, &[measure(0.0)])?;
    /// let (same, worn) = (estimate.errors(&arm, &measure(0.0))?, estimate.errors(&arm, &measure(0.7))?);
    /// assert!(same.rmse[0] < 0.05);
    /// assert!((worn.rmse[0] - 0.7).abs() < 0.05);
    /// # Ok::<(), robot_model::identify::IdentifyError>(())
    /// ```
    pub fn errors(&self, arm: &dyn Arm, log: &Log) -> Result<Errors, IdentifyError> {
        let raw = self.raw_errors(arm, log)?;
        if self.motion_bands == self.bands {
            return Ok(raw);
        }
        let prepared = prepare_at_own_rate(arm, log, self.bands)?;
        Ok(Errors {
            relative_percent: self
                .errors_of(arm, &prepared, &log.tau, prepared.stride)
                .relative_percent,
            ..raw
        })
    }

    /// Errors of raw samples; relative ones are of the bands of the motion.
    pub(super) fn raw_errors(&self, arm: &dyn Arm, log: &Log) -> Result<Errors, IdentifyError> {
        let prepared = prepare_at_own_rate(arm, log, self.motion_bands)?;
        Ok(self.errors_of(arm, &prepared, &log.tau, prepared.stride))
    }

    /// `measured` has `stride` samples for one of the prepared motion.
    pub(super) fn errors_of(
        &self,
        arm: &dyn Arm,
        prepared: &Prepared,
        measured: &[Vec<f64>],
        stride: usize,
    ) -> Errors {
        let torque = self.torque(arm, prepared);
        let count = measured.first().map_or(0, Vec::len);
        let border = whole_steps(ERROR_BORDER_S * prepared.rate_hz) * stride;
        let inner = within(count, border);
        let sound: Vec<usize> = inner
            .filter(|k| !prepared.is_in_hole(*k as f64 / stride as f64))
            .collect();
        let mut errors = Errors {
            rmse: Vec::new(),
            relative_percent: Vec::new(),
            mae: Vec::new(),
            level: Vec::new(),
            spread: Vec::new(),
            samples: Vec::new(),
        };
        let (mut filtered, mut tau) = (Vec::new(), Vec::new());
        for (joint, values) in torque.iter().enumerate() {
            let gain = arm.actuator_gain()[joint];
            let predicted = spread(values, stride, count);
            // A torque at its limit is not that of the model, unless the model says so.
            let reach = |reach: usize| {
                if arm.saturated_joints().contains(&joint) {
                    vec![false; values.len()]
                } else {
                    prepared.is_clipped(joint, reach)
                }
            };
            let (near, far) = (reach(0), reach(prepared.shared.border()));
            let inner: Vec<usize> = sound
                .iter()
                .copied()
                .filter(|k| !near[k / stride])
                .collect();
            let mean = |value: &dyn Fn(usize) -> f64| {
                inner.iter().copied().map(value).sum::<f64>() / inner.len().max(1) as f64
            };
            let rest = |k: usize| gain * measured[joint][k] - predicted[k];
            let level = mean(&|k| gain * measured[joint][k]);
            errors.rmse.push(mean(&|k| rest(k).powi(2)).sqrt());
            errors.mae.push(mean(&|k| rest(k).abs()));
            errors.level.push(level);
            errors.samples.push(inner.len());
            let spread = mean(&|k| (gain * measured[joint][k] - level).powi(2));
            errors.spread.push(spread.sqrt());
            let rest: Vec<f64> = prepared.tau[joint]
                .iter()
                .zip(values)
                .map(|(tau, t)| gain * tau - t)
                .collect();
            let scaled: Vec<f64> = prepared.tau[joint].iter().map(|tau| gain * tau).collect();
            prepared.shared.apply(&rest, &mut filtered);
            prepared.shared.apply(&scaled, &mut tau);
            let held = turns::held(arm, prepared, joint);
            for left_out in [far, held] {
                for row in rows_at(0, prepared, &left_out) {
                    (filtered[row], tau[row]) = (0.0, 0.0);
                }
            }
            errors
                .relative_percent
                .push(percent(norm(&filtered), norm(&tau)));
        }
        errors
    }

    /// Predicted torque on a prepared motion's grid.
    fn torque(&self, arm: &dyn Arm, prepared: &Prepared) -> Vec<Vec<f64>> {
        let values = self.values();
        let shapes: Vec<f64> = self.shapes.iter().map(|(_, value)| *value).collect();
        let mut motion = prepared.motion.clone();
        if arm.uses_rigid_torque() {
            load_motion(arm, &mut motion, &shapes, &values);
        }
        whole_torque(arm, &motion, &shapes, &values)
    }
}

/// Values on every `stride`-th sample, linearly between them, on `count` samples.
fn spread(values: &[f64], stride: usize, count: usize) -> Vec<f64> {
    (0..count)
        .map(|k| {
            let (at, part) = (k / stride, (k % stride) as f64 / stride as f64);
            let next = values[(at + 1).min(values.len() - 1)];
            values[at] + part * (next - values[at])
        })
        .collect()
}

//! Errors on raw samples: what a candidate does to the residual beyond the shared band, too.
//!
//! Fits are of filtered rows, but an effect matters by the raw error. That of dry friction's neighbors is in short pulses at reversals,
//! most of whose power is above the band that is fitted.

use crate::columns::Entry;
use crate::signal::Prepared;

use super::calm::calmest;
use super::projected::Projected;
use super::residual::{clear, left_out};
use super::search::{Search, State};
use super::trial::Trial;

/// The present model's columns along one motion of every log.
struct Along<'a> {
    logs: &'a [Prepared],
    columns: Vec<Vec<Entry>>,
    /// `[log][joint][sample]`, both ends cut.
    residuals: Vec<Vec<Vec<f64>>>,
}

/// The present model's columns and residuals on raw samples of every log.
pub(super) struct Raw<'a> {
    motions: Vec<Along<'a>>,
    /// Which samples say nothing, `[log][joint][sample]`.
    left_out: Vec<Vec<Vec<bool>>>,
    /// Mean square per joint of what decimation took off the torque.
    beyond: Vec<f64>,
    /// Mean square of the raw residual beyond that of the filtered one, per joint.
    pub(super) noise_power: Vec<f64>,
}

impl Search<'_> {
    pub(super) fn raw<'a>(&'a self, state: &State) -> Raw<'a> {
        let of_log = |log: &Prepared| {
            let mut columns = self.arm.entries(&log.motion, &self.shapes);
            let mut first = self.arm.unknowns().len();
            for effect in &state.accepted {
                let trial = &effect.trial;
                let entries = trial.candidate.entries(&log.motion, &trial.shapes);
                columns.extend(entries.into_iter().map(|entry| Entry {
                    column: first + entry.column,
                    ..entry
                }));
                first += trial.count();
            }
            columns
        };
        let along = |logs: &'a [Prepared]| Along {
            logs,
            columns: logs.iter().map(of_log).collect(),
            residuals: self.raw_residuals_along(state, logs),
        };
        let mut raw = Raw {
            motions: self.motions().map(along).collect(),
            left_out: self
                .prepared
                .iter()
                .map(|log| left_out(self.arm, log))
                .collect(),
            beyond: Vec::new(),
            noise_power: Vec::new(),
        };
        let present = calmest(raw.motions.iter().map(|along| along.residuals.clone()));
        raw.beyond = self.beyond_all(&present.residuals);
        raw.noise_power = above(&present.residuals, &raw.beyond, &state.residuals);
        raw
    }
}

impl Raw<'_> {
    /// [`Self::noise_power`] with a trial, where `filtered` is what it leaves of the filtered residual.
    pub(super) fn noise_power_with(
        &self,
        trial: &Trial,
        projected: &Projected,
        filtered: &[Vec<f64>],
    ) -> Vec<f64> {
        if trial.candidate.change().is_some() {
            return self.noise_power.clone();
        }
        let left = self.motions.iter();
        let left = calmest(left.map(|along| self.left_along(along, trial, projected)));
        above(&left.residuals, &self.beyond, filtered)
    }

    /// What a trial leaves of raw residuals along one motion.
    fn left_along(
        &self,
        along: &Along,
        trial: &Trial,
        projected: &Projected,
    ) -> Vec<Vec<Vec<f64>>> {
        let change = projected.change();
        let mut left = along.residuals.clone();
        let logs = along.logs.iter().zip(&along.columns).zip(&self.left_out);
        for (((log, columns), left_out), left) in logs.zip(&mut left) {
            let border = log.shared.border();
            let mut add = |entry: &Entry, factor: f64| {
                if factor != 0.0 {
                    let residual = &mut left[entry.joint];
                    let values = entry.values.iter().skip(border);
                    residual
                        .iter_mut()
                        .zip(values)
                        .for_each(|(r, v)| *r -= factor * v);
                }
            };
            for entry in trial.candidate.entries(&log.motion, &trial.shapes) {
                add(&entry, projected.gain[entry.column]);
            }
            for entry in columns {
                add(entry, change[entry.column]);
            }
            clear(left, left_out);
        }
        left
    }
}

/// Mean square of raw residuals, with what decimation took off, beyond that of filtered ones, per joint.
pub(super) fn above(raw: &[Vec<Vec<f64>>], beyond: &[f64], filtered: &[Vec<f64>]) -> Vec<f64> {
    let joints = beyond.iter().zip(filtered).enumerate();
    let of_joint = |(joint, (beyond, filtered)): (usize, (&f64, &Vec<f64>))| {
        let samples = raw.iter().flat_map(|log| &log[joint]);
        (mean_square(samples) + beyond - mean_square(filtered)).max(0.0)
    };
    joints.map(of_joint).collect()
}

pub(super) fn mean_square<'a>(values: impl IntoIterator<Item = &'a f64>) -> f64 {
    let sums = values.into_iter().fold((0.0, 0.0), |(sum, count), value| {
        (sum + value * value, count + 1.0)
    });
    sums.0 / f64::max(sums.1, 1.0)
}

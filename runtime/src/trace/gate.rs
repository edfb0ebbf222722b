//! Does a candidate hold on data that it was not fitted on?

use crate::identify::Stack;

use super::gram::{Gram, HeldOut};
use super::score::{Present, Projected};
use super::trial::Trial;
use super::verdict::Evidence;

/// An effect matters if it lowers the raw error of one of its joints by this much, percent.
pub(super) const MATERIAL_PERCENT: f64 = 5.0;

/// Family-wise error rate of the score.
const SIGNIFICANCE: f64 = 0.05;

/// How far a fold's torque of the effect may be from that of all folds, relative.
const STEADINESS: f64 = 0.5;

/// A parameter that must not be negative may be so by this share of the effect's power: noise around zero.
const NEGATIVE_SHARE: f64 = 0.05;

/// The model without the candidate.
pub(super) struct Baseline<'a> {
    pub(super) present: Present<'a>,
    pub(super) gram: &'a Gram,
    pub(super) held_out: HeldOut,
    /// Power of the raw residual per joint that no filtered fit can remove: noise above the shared band.
    pub(super) noise_power: &'a [f64],
    /// Candidates and shapes tried.
    pub(super) tried: usize,
}

/// A candidate's trial, judged.
pub(super) struct Judged<'a> {
    pub(super) trial: Trial<'a>,
    pub(super) evidence: Evidence,
    /// Sum over joints of the fall of the logarithm of the held-out error: larger is better.
    pub(super) merit: f64,
    /// Held-out power on raw samples per joint.
    pub(super) raw_power: Vec<f64>,
    /// Whether it may be named.
    pub(super) passes: bool,
}

impl<'a> Baseline<'a> {
    pub(super) fn new(
        stack: &'a Stack,
        gram: &'a Gram,
        sigma: &'a [f64],
        residuals: &'a [Vec<f64>],
        noise_power: &'a [f64],
        tried: usize,
    ) -> Self {
        Self {
            present: Present::new(stack, gram, sigma, residuals),
            held_out: gram.held_out(sigma),
            gram,
            noise_power,
            tried,
        }
    }

    pub(super) fn judge<'t>(&self, trial: Trial<'t>, projected: &Projected) -> Judged<'t> {
        let stack = self.present.stack;
        let count = trial.count();
        let gram = self.gram.extended(stack, &trial.entries, count);
        let held_out = gram.held_out(self.present.sigma);
        let dof = stack.dof();

        let raw = |held_out: &HeldOut| -> Vec<f64> {
            (0..dof)
                .map(|j| self.noise_power[j] + held_out.mean(j).max(f64::MIN_POSITIVE))
                .collect()
        };
        let (raw_before, raw_power) = (raw(&self.held_out), raw(&held_out));
        let percent = |after: f64, before: f64| {
            100.0 * (1.0 - (after / before.max(f64::MIN_POSITIVE)).sqrt())
        };
        let touched = trial.candidate.joints().to_vec();
        let folds = held_out.errors.len();
        let better = |fold: usize| {
            let weighted = |errors: &[f64]| {
                touched
                    .iter()
                    .map(|j| errors[*j] / self.held_out.mean(*j))
                    .sum::<f64>()
            };
            weighted(&held_out.errors[fold]) < weighted(&self.held_out.errors[fold])
        };
        let improved = (0..folds).filter(|fold| better(*fold)).count();

        let gain = gram.normal(self.present.sigma).solve()[self.gram.unknowns()..].to_vec();
        let score = self.present.score(&trial.entries, projected);
        let p_value = (self.tried as f64 * score.p_value).min(1.0);
        let evidence = Evidence {
            score: score.f,
            p_value,
            held_out_percent: (0..dof)
                .map(|j| percent(held_out.mean(j), self.held_out.mean(j)))
                .collect(),
            raw_percent: (0..dof)
                .map(|j| percent(raw_power[j], raw_before[j]))
                .collect(),
            folds: (improved, folds),
        };
        let merit = (0..dof)
            .map(|j| 0.5 * (self.held_out.mean(j) / held_out.mean(j).max(f64::MIN_POSITIVE)).ln())
            .sum::<f64>();
        let steady = held_out
            .estimates
            .iter()
            .all(|fold| projected.distance(&fold[self.gram.unknowns()..], &gain) < STEADINESS);
        let physical = trial
            .candidate
            .unknowns()
            .iter()
            .enumerate()
            .all(|(c, unknown)| {
                !unknown.nonnegative
                    || gain[c] >= 0.0
                    || projected.power_share(&gain, c) < NEGATIVE_SHARE
            });
        let passes = trial.is_inside()
            && merit > 0.0
            && p_value < SIGNIFICANCE
            && improved + 1 >= folds
            && steady
            && physical
            && touched
                .iter()
                .any(|j| evidence.raw_percent[*j] >= MATERIAL_PERCENT);
        Judged {
            trial,
            evidence,
            merit,
            raw_power,
            passes,
        }
    }
}

/// Held-out raw error of `one` relative to `other` on the joint where it is worst, percent.
pub(super) fn worse_percent(one: &[f64], other: &[f64]) -> f64 {
    one.iter()
        .zip(other)
        .map(|(a, b)| 100.0 * ((a / b).sqrt() - 1.0))
        .fold(f64::NEG_INFINITY, f64::max)
}

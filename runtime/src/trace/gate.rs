//! Does a candidate hold on data that it was not fitted on?

use std::sync::Arc;

use crate::columns::Change;

use super::chance::is_chance;
use super::change::Changed;
use super::folds::Fold;
use super::gram::{Gram, HeldOut};
use super::projected::Projected;
use super::raw::Raw;
use super::score::Present;
use super::search::{Search, State};
use super::trial::Trial;
use super::verdict::{Evidence, Refusal, Tried};

/// An effect matters if it lowers the raw error of one of its joints by this much, percent.
pub(super) const MATERIAL_PERCENT: f64 = 5.0;

/// How far a fold's torque of the effect may be from that of all folds, relative.
const STEADINESS: f64 = 0.5;

/// A parameter that must not be negative may be so by this share of the effect's power: noise around zero.
const NEGATIVE_SHARE: f64 = 0.05;

/// The model without the candidate.
pub(super) struct Baseline<'a> {
    pub(super) present: Present<'a>,
    gram: Gram,
    held_out: HeldOut,
    /// The residual on raw samples.
    raw: Arc<Raw<'a>>,
    /// Independent tests that all candidates and shapes are worth.
    tests: f64,
}

/// A candidate's trial, judged.
#[derive(Clone)]
pub(super) struct Judged<'a> {
    pub(super) trial: Trial<'a>,
    pub(super) evidence: Evidence,
    /// Sum over joints of the fall of the logarithm of the held-out error: larger is better.
    pub(super) merit: f64,
    /// Held-out power on raw samples per joint.
    pub(super) raw_power: Vec<f64>,
    /// Held-out power of each fold, of all joints, each over that of the model without the candidate; none on folds of its own.
    pub(super) fold_power: Vec<f64>,
    /// Why it may not be named.
    pub(super) refusals: Vec<Refusal>,
    /// Whether no parameter that must not be negative is so by any amount.
    pub(super) keeps_signs: bool,
    /// Of an effect that changes the arm: whether it was tried as what it is, and with which rows.
    pub(super) changed: Option<Changed>,
}

impl Search<'_> {
    /// The present model as that which candidates and shapes worth so many tests are judged against, on these folds.
    pub(super) fn baseline<'a>(
        &'a self,
        state: &'a State,
        tests: f64,
        folds: &[Fold],
    ) -> Baseline<'a> {
        let (stack, sigma) = (&state.stack, &state.solution.sigma);
        let gram = Gram::new(stack, folds);
        Baseline {
            present: Present::new(stack, &gram, sigma, &state.residuals),
            held_out: gram.held_out(sigma),
            gram,
            raw: Arc::new(self.raw(state)),
            tests,
        }
    }
}

impl<'a> Baseline<'a> {
    /// The same on other folds.
    pub(super) fn on(&self, folds: &[Fold]) -> Self {
        let present: &Present<'a> = &self.present;
        let gram = Gram::new(present.stack, folds);
        Self {
            present: Present::new(present.stack, &gram, present.sigma, present.residuals),
            held_out: gram.held_out(present.sigma),
            gram,
            raw: Arc::clone(&self.raw),
            tests: self.tests,
        }
    }

    pub(super) fn judge<'t>(&self, trial: Trial<'t>, projected: &Projected) -> Judged<'t> {
        let stack = self.present.stack;
        let count = trial.count();
        let gram = self.gram.extended(stack, &trial.entries, count);
        let held_out = gram.held_out(self.present.sigma);
        let touched = self.touched(&trial);
        let score = (self.present).score(trial.candidate, &trial.entries, projected);
        let noise_power = self.raw.noise_power_with(&trial, projected, &score.rest);
        let compared = self.compared(&held_out, &noise_power, &touched);
        let gain = gram.normal(self.present.sigma).solve()[self.gram.unknowns()..].to_vec();
        let edges = self.present.chance_of_edges(&trial, projected);
        let p_value = (self.tests * score.p_value.max(edges)).min(1.0);
        let evidence = Evidence {
            score: score.f,
            p_value,
            ..compared.evidence
        };
        let chance = is_chance(&evidence, &touched, trial.candidate.is_of_time());
        let steady = held_out
            .estimates
            .iter()
            .all(|fold| projected.distance(&fold[self.gram.unknowns()..], &gain) < STEADINESS);
        let unknowns = trial.candidate.unknowns().iter().enumerate();
        let negative = unknowns.filter(|(c, unknown)| unknown.nonnegative && gain[*c] < 0.0);
        let negative: Vec<usize> = negative.map(|(c, _)| c).collect();
        let physical = negative
            .iter()
            .all(|&c| projected.power_share(&gain, c) < NEGATIVE_SHARE);
        let refusals = [
            (!chance, Refusal::Chance),
            (trial.is_inside(), Refusal::EndOfRange),
            (steady, Refusal::Unsteady),
            (physical, Refusal::Sign),
        ];
        Judged {
            trial,
            evidence,
            merit: compared.merit,
            raw_power: compared.raw_power,
            fold_power: compared.fold_power,
            refusals: refused(refusals, compared.refusals),
            keeps_signs: negative.is_empty(),
            changed: None,
        }
    }

    /// A change as what it is; `first` is what was judged of its first order.
    pub(super) fn judge_changed<'t>(
        &self,
        first: Judged<'t>,
        changed: Changed,
        folds: &[Fold],
    ) -> Judged<'t> {
        let held_out = Gram::new(&changed.stack, folds).held_out(self.present.sigma);
        let joints: Vec<usize> = (0..self.present.stack.dof()).collect();
        let compared = self.compared(&held_out, &changed.noise_power, &joints);
        let neutral = first
            .trial
            .candidate
            .change()
            .map_or(&[][..], Change::neutral);
        let steady = held_out.estimates.iter().all(|fold| {
            // A shape that may be zero is as large as it is away from that; of others the value itself counts.
            let sizes = changed.shapes.iter().zip(neutral);
            let sizes = sizes.map(|(value, neutral)| {
                if *neutral == 0.0 {
                    value - neutral
                } else {
                    *value
                }
            });
            norm(&fold[fold.len() - changed.shapes.len()..])
                < STEADINESS * norm(&sizes.collect::<Vec<_>>())
        });
        let evidence = Evidence {
            score: first.evidence.score,
            p_value: first.evidence.p_value,
            ..compared.evidence
        };
        let chance = is_chance(&evidence, &joints, first.trial.candidate.is_of_time());
        Judged {
            evidence,
            merit: compared.merit,
            raw_power: compared.raw_power,
            fold_power: compared.fold_power,
            refusals: refused(
                [(!chance, Refusal::Chance), (steady, Refusal::Unsteady)],
                compared.refusals,
            ),
            keeps_signs: true,
            changed: Some(changed),
            trial: first.trial,
        }
    }

    /// Joints on which an effect has to hold: all where it changes the arm, as that of one link is felt by others.
    fn touched(&self, trial: &Trial) -> Vec<usize> {
        if trial.candidate.change().is_some() {
            return (0..self.present.stack.dof()).collect();
        }
        trial.touched()
    }

    /// Errors that were not fitted against those of the model without the candidate; score and its chance are left open.
    fn compared(&self, held_out: &HeldOut, noise_power: &[f64], touched: &[usize]) -> Compared {
        let dof = self.present.stack.dof();
        let raw = |held_out: &HeldOut, noise_power: &[f64]| -> Vec<f64> {
            (0..dof)
                .map(|j| noise_power[j] + held_out.mean(j).max(f64::MIN_POSITIVE))
                .collect()
        };
        let raw_before = raw(&self.held_out, &self.raw.noise_power);
        let raw_power = raw(held_out, noise_power);
        let percent = |after: f64, before: f64| {
            100.0 * (1.0 - (after / before.max(f64::MIN_POSITIVE)).sqrt())
        };
        let folds = held_out.errors.len();
        // A joint that stands all along, as one with its brake on does, has no error and says nothing.
        let judges = |joint: &usize| self.held_out.mean(*joint) > 0.0;
        let weighted = |errors: &[f64], joints: &[usize]| {
            let joints = joints.iter().copied().filter(judges);
            joints
                .map(|j| errors[j] / self.held_out.mean(j))
                .sum::<f64>()
        };
        let better = |fold: usize| {
            let [with, without] = [held_out, &self.held_out].map(|of| &of.errors[fold]);
            weighted(with, touched) < weighted(without, touched)
        };
        let all: Vec<usize> = (0..dof).collect();
        let fold_power = held_out.errors.iter().map(|errors| weighted(errors, &all));
        let improved = (0..folds).filter(|fold| better(*fold)).count();
        let raw_percent: Vec<f64> = (0..dof)
            .map(|j| percent(raw_power[j], raw_before[j]))
            .collect();
        let merit = (0..dof)
            .filter(judges)
            .map(|j| 0.5 * (self.held_out.mean(j) / held_out.mean(j).max(f64::MIN_POSITIVE)).ln())
            .sum::<f64>();
        let is_material = touched.iter().any(|j| raw_percent[*j] >= MATERIAL_PERCENT);
        let refusals = [
            (merit > 0.0 && improved + 1 >= folds, Refusal::HeldOut),
            (is_material, Refusal::Small),
        ];
        Compared {
            refusals: refused(refusals, Vec::new()),
            evidence: Evidence {
                score: 0.0,
                p_value: 1.0,
                held_out_percent: (0..dof)
                    .map(|j| percent(held_out.mean(j), self.held_out.mean(j)))
                    .collect(),
                raw_percent,
                folds: (improved, folds),
            },
            merit,
            raw_power,
            fold_power: fold_power.collect(),
        }
    }
}

fn norm(values: &[f64]) -> f64 {
    values.iter().map(|value| value * value).sum::<f64>().sqrt()
}

/// What cross-validation says of a candidate.
struct Compared {
    evidence: Evidence,
    merit: f64,
    raw_power: Vec<f64>,
    fold_power: Vec<f64>,
    /// Not better in nearly all folds, or not by an amount that matters.
    refusals: Vec<Refusal>,
}

/// What does not hold, and `more`.
fn refused<const N: usize>(holds: [(bool, Refusal); N], more: Vec<Refusal>) -> Vec<Refusal> {
    let failed = holds.into_iter().filter(|(holds, _)| !holds);
    failed.map(|(_, refusal)| refusal).chain(more).collect()
}

impl Judged<'_> {
    /// Whether it may be named.
    pub(super) fn passes(&self) -> bool {
        self.refusals.is_empty()
    }

    /// What is told of it.
    pub(super) fn told(&self, round: usize) -> Tried {
        let candidate = self.trial.candidate;
        let (shapes, follows_torque) = match &self.changed {
            Some(changed) => (&changed.shapes, changed.follows_torque),
            None => (&self.trial.shapes, candidate.follows_torque()),
        };
        Tried {
            round,
            kind: candidate.kind().to_owned(),
            effect: candidate.effect(),
            joints: candidate.joints().to_vec(),
            shapes: shapes.clone(),
            evidence: self.evidence.clone(),
            refusals: self.refusals.clone(),
            follows_torque,
        }
    }
}

/// Whether the first order of a change, which all joints may feel, says that it may be worth a trial as what it is.
pub(super) fn is_promising(judged: &Judged) -> bool {
    !judged.refusals.contains(&Refusal::Chance)
}

/// Held-out raw error of `one` relative to `other` on the joint where it is worst, percent.
pub(super) fn worse_percent(one: &[f64], other: &[f64]) -> f64 {
    one.iter()
        .zip(other)
        .map(|(a, b)| 100.0 * ((a / b).sqrt() - 1.0))
        .fold(f64::NEG_INFINITY, f64::max)
}

//! What a trace found, as JSON.

use robot_model::identify::Z_95;
use robot_model::trace::{
    Alternative, Evidence, Finding, Floor, Share, TermShare, Tried, Whereabouts,
};
use serde::Serialize;

use super::doubt::{borne_out, unlike};
use crate::close_the_loop::{Loop, Sure};
use crate::data_gate::DataFault;
use crate::identify::data_faults::{FaultReport, fault_reports};

/// What `--json` writes; a contract. Joints count from 1.
#[derive(Serialize)]
pub(crate) struct Report<'a> {
    outcome: &'static str,
    effects: Vec<EffectReport<'a>>,
    rmse_before: Option<&'a [f64]>,
    rmse_after: Option<&'a [f64]>,
    /// Errors are of raw samples, first and last second cut.
    domain: &'static str,
    /// `100 || error || / || tau ||` per joint on the validation log, in the identification's band.
    relative_percent_before: Option<&'a [f64]>,
    relative_percent_after: Option<&'a [f64]>,
    /// The same on the identification logs.
    relative_percent_train_before: &'a [f64],
    relative_percent_train_after: &'a [f64],
    alternatives: Vec<AlternativeReport<'a>>,
    /// The least error that a model can have on the identification logs, of raw samples, per joint.
    noise_floor: Vec<f64>,
    noise_floor_std: Vec<f64>,
    /// Per joint: periods or curves.
    noise_floor_from: Vec<&'static str>,
    /// Where the motion repeats, what the last model leaves of samples away from turns over that, per joint.
    times_noise_floor: Vec<Option<f64>>,
    /// Where it does not, the share of the residual's power in the largest twentieth of rows away from turns, per joint.
    pulse_share: Vec<Option<f64>>,
    /// Speeds below which dry friction does not act in full, per joint, rad/s or m/s.
    turn_speeds: &'a [f64],
    /// Share of the raw error's power that stands out of noise as structure, per joint, on the identification logs.
    structure_before: Vec<f64>,
    structure_after: Vec<f64>,
    /// Of what the structure after is a function, for every joint where it matters.
    structure_where: Vec<WhereReport<'a>>,
    /// What the gate noted of the logs, as `identify` writes it.
    data_faults: Vec<FaultReport<'a>>,
    /// Another way to read the logs, with which the declared model explains them far better: then nothing else was asked of them.
    reading: Option<&'a str>,
    /// Joints on which leads are together a curve of the joint's position.
    series: Vec<usize>,
    /// Parameters of the last model that no arm has below zero, and that are by more than three deviations.
    impossible: Vec<ParameterReport<'a>>,
    /// Whether some joint's raw error on the validation log is smaller by a hundredth with the amended spec; null where there is none.
    borne_out: Option<bool>,
    /// Joints of which much more is left on the validation log than on the logs that were traced.
    unlike_validation: Vec<usize>,
    /// Effects that passed the gates although structure remains.
    leads: Vec<EffectReport<'a>>,
    /// What was judged in every round, best first, and why it was refused.
    tried: Vec<TriedReport<'a>>,
}

#[derive(Serialize)]
struct WhereReport<'a> {
    joint: usize,
    /// Of a constant.
    level_share: f64,
    /// The largest first.
    shares: Vec<ShareReport>,
    /// Terms of the arm's equations that say most of it, the largest share first.
    terms: Vec<TermReport<'a>>,
    peak_hz: f64,
    peak_share: f64,
    /// Where the level of the residual changes, once.
    #[serde(skip_serializing_if = "Option::is_none")]
    step: Option<StepReport>,
}

#[derive(Serialize)]
struct StepReport {
    /// Which of the logs, from 1.
    log: usize,
    /// s since the start of that log.
    time: f64,
    /// When it comes back, s since the start of that log; null where it stays.
    until: Option<f64>,
    /// N m or N.
    size: f64,
    /// Of the power of the joint's residual in that log.
    share: f64,
}

#[derive(Serialize)]
struct TermReport<'a> {
    term: &'a str,
    coefficient: f64,
    share: f64,
}

#[derive(Serialize)]
struct ShareReport {
    /// position, velocity, acceleration, load, time, position-and-velocity, velocity-and-time, or of two joints positions, velocities or
    /// velocity-and-position
    of: &'static str,
    /// The joint, the first of two; none of time.
    joint: Option<usize>,
    /// Both of two.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    joints: Vec<usize>,
    /// Of the residual's power in the band of the fit, out of fold.
    share: f64,
}

#[derive(Serialize)]
struct TriedReport<'a> {
    /// From 1.
    round: usize,
    kind: &'a str,
    #[serde(flatten)]
    joints: Joints,
    shapes: &'a [f64],
    evidence: EvidenceReport<'a>,
    /// None of what was accepted, or is an alternative.
    refused: Vec<&'static str>,
}

#[derive(Serialize)]
pub(super) struct EffectReport<'a> {
    kind: &'a str,
    /// What the amended spec declares; none for a fault of the logs that it does not.
    effect: Option<&'a str>,
    #[serde(flatten)]
    joints: Joints,
    pub(super) parameters: Vec<ParameterReport<'a>>,
    /// None for a fault of the logs.
    evidence: Option<EvidenceReport<'a>>,
}

#[derive(Serialize)]
struct AlternativeReport<'a> {
    kind: &'a str,
    #[serde(flatten)]
    joints: Joints,
    /// Place in `effects`, from 1.
    instead_of: usize,
    worse_percent: f64,
    /// Folds in which its held-out error is larger than that of what it could stand for, and how many there are.
    worse_folds: Option<(usize, usize)>,
}

#[derive(Serialize)]
#[serde(untagged)]
enum Joints {
    One { joint: Option<usize> },
    Several { joints: Vec<usize> },
}

#[derive(Serialize)]
pub(super) struct ParameterReport<'a> {
    pub(super) name: &'a str,
    /// Where others do the same, that with these at zero.
    pub(super) value: f64,
    /// Beside all other unknowns, shapes among them; none where another unknown or a sum of others does the same, and of a stiffness that is
    /// known as well as the split of a motor and its link.
    pub(super) std: Option<f64>,
    /// Ends of the interval that holds the value with 95 %.
    pub(super) interval: Option<[f64; 2]>,
    /// Why there is none.
    #[serde(skip_serializing_if = "Option::is_none")]
    without_interval: Option<&'static str>,
    #[serde(skip)]
    pub(super) sure: Sure,
}

impl<'a> ParameterReport<'a> {
    fn new(name: &'a str, value: f64, sure: Sure) -> Self {
        let std = sure.std();
        Self {
            name,
            value,
            std,
            sure,
            without_interval: sure.without_interval(),
            interval: std.map(|std| [value - Z_95 * std, value + Z_95 * std]),
        }
    }
}

#[derive(Serialize)]
pub(super) struct EvidenceReport<'a> {
    score: f64,
    p_value: f64,
    held_out_percent: &'a [f64],
    raw_percent: &'a [f64],
    folds_improved: usize,
    folds: usize,
}

impl<'a> Report<'a> {
    pub(crate) fn new(closed: &'a Loop) -> Self {
        let verdict = &closed.verdict;
        let rmse = |errors: &'a Option<robot_model::identify::Errors>| {
            errors.as_ref().map(|errors| errors.rmse.as_slice())
        };
        let relative = |errors: &'a Option<robot_model::identify::Errors>| {
            errors
                .as_ref()
                .map(|errors| errors.relative_percent.as_slice())
        };
        let effects = verdict.findings.iter().enumerate();
        let leads = verdict.leads.iter().enumerate();
        Self {
            outcome: closed.outcome().name(),
            effects: closed
                .faults
                .iter()
                .map(fault)
                .chain(effects.map(|(k, finding)| effect(finding, closed, k)))
                .collect(),
            rmse_before: rmse(&closed.before.validation),
            rmse_after: rmse(&closed.after().validation),
            domain: "raw",
            relative_percent_before: relative(&closed.before.validation),
            relative_percent_after: relative(&closed.after().validation),
            relative_percent_train_before: &closed.before.estimate.relative_percent,
            relative_percent_train_after: &closed.after().estimate.relative_percent,
            alternatives: verdict
                .alternatives
                .iter()
                .map(|one| alternative(one, closed.faults.len()))
                .collect(),
            noise_floor: verdict.noise_floor.iter().map(|floor| floor.rms).collect(),
            noise_floor_std: verdict.noise_floor.iter().map(|floor| floor.std).collect(),
            noise_floor_from: verdict
                .noise_floor
                .iter()
                .map(|floor| floor.from.name())
                .collect(),
            times_noise_floor: verdict.noise_floor.iter().map(Floor::times).collect(),
            pulse_share: verdict
                .noise_floor
                .iter()
                .map(|floor| floor.pulses)
                .collect(),
            turn_speeds: &closed.after().turn_speeds,
            structure_before: verdict.before.iter().map(|s| s.share).collect(),
            structure_after: verdict.after.iter().map(|s| s.share).collect(),
            structure_where: verdict.left.iter().map(whereabouts).collect(),
            data_faults: fault_reports(&closed.noted),
            reading: closed.reading.as_deref(),
            series: verdict.series.iter().map(|joint| joint + 1).collect(),
            borne_out: borne_out(closed),
            unlike_validation: unlike(closed).iter().map(|joint| joint + 1).collect(),
            impossible: closed
                .impossible()
                .map(|found| ParameterReport::new(&found.name, found.value, Sure::Std(found.std)))
                .collect(),
            leads: leads
                .map(|(k, lead)| effect(lead, closed, verdict.findings.len() + k))
                .collect(),
            tried: verdict.tried.iter().map(tried).collect(),
        }
    }
}

impl Joints {
    fn new(joints: &[usize]) -> Self {
        match joints {
            [] => Self::One { joint: None },
            [joint] => Self::One {
                joint: Some(joint + 1),
            },
            several => Self::Several {
                joints: several.iter().map(|joint| joint + 1).collect(),
            },
        }
    }
}

/// A finding or lead with the values that the amended model was identified with; `place` is its place among both.
pub(super) fn effect<'a>(finding: &'a Finding, closed: &'a Loop, place: usize) -> EffectReport<'a> {
    let parameters = closed.parameters(finding, place).into_iter();
    let parameters = parameters.map(|(name, value, sure)| ParameterReport::new(name, value, sure));
    EffectReport {
        kind: &finding.kind,
        effect: Some(&finding.effect),
        joints: Joints::new(&finding.joints),
        parameters: parameters.collect(),
        evidence: Some(evidence(&finding.evidence)),
    }
}

fn evidence(evidence: &Evidence) -> EvidenceReport<'_> {
    let (folds_improved, folds) = evidence.folds;
    EvidenceReport {
        score: evidence.score,
        p_value: evidence.p_value,
        held_out_percent: &evidence.held_out_percent,
        raw_percent: &evidence.raw_percent,
        folds_improved,
        folds,
    }
}

fn whereabouts(one: &Whereabouts) -> WhereReport<'_> {
    let share = |share: &Share| {
        let joints: Vec<usize> = share.of.joints().iter().map(|joint| joint + 1).collect();
        ShareReport {
            of: share.of.name(),
            joint: joints.first().copied(),
            joints: if joints.len() > 1 { joints } else { Vec::new() },
            share: share.share,
        }
    };
    WhereReport {
        joint: one.joint + 1,
        level_share: one.level,
        shares: one.shares.iter().map(share).collect(),
        terms: one.terms.iter().map(term).collect(),
        peak_hz: one.peak_hz,
        peak_share: one.peak_share,
        step: one.step.map(|step| StepReport {
            log: step.log + 1,
            time: step.time,
            until: step.until,
            size: step.size,
            share: step.share,
        }),
    }
}

fn term(one: &TermShare) -> TermReport<'_> {
    TermReport {
        term: &one.term,
        coefficient: one.coefficient,
        share: one.share,
    }
}

fn tried(tried: &Tried) -> TriedReport<'_> {
    TriedReport {
        round: tried.round + 1,
        kind: &tried.kind,
        joints: Joints::new(&tried.joints),
        shapes: &tried.shapes,
        evidence: evidence(&tried.evidence),
        refused: tried.refusals.iter().map(|one| one.name()).collect(),
    }
}

/// A fault of the logs among the effects.
fn fault(fault: &DataFault) -> EffectReport<'_> {
    let delay = fault.delay.iter();
    let delay = delay.map(|&(value, std)| ParameterReport::new("delay", value, Sure::Std(std)));
    EffectReport {
        kind: fault.kind,
        effect: None,
        joints: Joints::new(&fault.joints),
        parameters: delay.collect(),
        evidence: None,
    }
}

/// Faults of the logs come before the findings.
fn alternative(alternative: &Alternative, faults: usize) -> AlternativeReport<'_> {
    AlternativeReport {
        kind: &alternative.kind,
        joints: Joints::new(&alternative.joints),
        instead_of: faults + alternative.instead_of + 1,
        worse_percent: alternative.worse_percent,
        worse_folds: alternative.worse_folds,
    }
}

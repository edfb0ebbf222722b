//! `robot-model trace`: what the model lacks, written into the spec.

use std::fmt::Write;
use std::path::{Path, PathBuf};

use clap::Args;
use robot_model::columns::Arm;
use robot_model::log::Log;
use robot_model::trace::{Alternative, Evidence, Finding, Outcome};
use serde::Serialize;

use crate::Error;
use crate::close_the_loop::{self, Loop};
use crate::diff::diff;
use crate::output::{self, OutFile};
use crate::progress::Progress;
use crate::spec::{load, read_log, read_text};

/// Trace the residual of an arm's model to an effect that the spec does not declare.
#[derive(Debug, Args)]
pub(crate) struct TraceArguments {
    /// The `.robot` file.
    spec: PathBuf,
    /// Logs to fit: CSV or gzip CSV, `time,q1..qn[,dq1..dqn],tau1..taun[,extra..]`, SI units.
    #[arg(required = true, value_name = "LOG")]
    logs: Vec<PathBuf>,
    /// A log that is not fitted: errors before and after are judged on it, and nothing else is.
    #[arg(long, value_name = "LOG")]
    validate: Option<PathBuf>,
    /// Write the spec with the traced effects declared.
    #[arg(long, value_name = "OUT.robot")]
    amend: Option<PathBuf>,
    /// Write the amended model's torque on the validation log, `time,tau1..taun`.
    #[arg(long, value_name = "OUT.csv", requires = "validate")]
    predict: Option<PathBuf>,
    /// Write the result as JSON.
    #[arg(long, value_name = "FILE")]
    json: Option<PathBuf>,
}

impl TraceArguments {
    pub(crate) fn run(&self) -> Result<(), Error> {
        let text = read_text(&self.spec)?;
        let dof = load(&self.spec)?.joints.len();
        let claim = |path: &Option<PathBuf>| path.as_deref().map(OutFile::create).transpose();
        let (amend, predict, json) = (
            claim(&self.amend)?,
            claim(&self.predict)?,
            claim(&self.json)?,
        );

        let progress = Progress::new();
        let read = |path: &Path| read_log(path, dof, &progress);
        let logs = self
            .logs
            .iter()
            .map(|path| read(path))
            .collect::<Result<Vec<_>, _>>()?;
        let validate = self.validate.as_deref().map(read).transpose()?;
        let name = self.spec.display().to_string();
        let closed = close_the_loop::close(&name, &text, &logs, validate.as_ref(), &progress)?;
        drop(progress);

        // All contents are ready before the first file appears.
        let prediction = validate
            .as_ref()
            .map(|log| prediction(&closed, log))
            .transpose()?;
        let contents = [
            (amend, Some(closed.amended.clone())),
            (predict, prediction),
            (json, Some(output::json(&Report::new(&closed)))),
        ];
        for (file, content) in contents {
            if let (Some(file), Some(content)) = (file, content) {
                file.commit(content.as_bytes())?;
            }
        }
        output::print(&summary(&closed, &text))
    }
}

/// `time,tau1..taun` of the last model on a log.
fn prediction(closed: &Loop, log: &Log) -> Result<String, Error> {
    let after = closed.after();
    let torque = after.estimate.predict(&after.arm, log)?;
    let mut text = String::from("time");
    for joint in 1..=torque.len() {
        write!(text, ",tau{joint}").expect("a string takes all");
    }
    for (sample, time) in log.time.iter().enumerate() {
        // Nanoseconds and micronewton meters: more is noise.
        write!(text, "\n{time:.9}").expect("a string takes all");
        for values in &torque {
            write!(text, ",{:.6}", values[sample]).expect("a string takes all");
        }
    }
    text.push('\n');
    Ok(text)
}

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
    alternatives: Vec<AlternativeReport<'a>>,
    noise_floor: &'a [f64],
    /// Share of the raw error's power that follows the motion, per joint, on the identification logs.
    structure_before: Vec<f64>,
    structure_after: Vec<f64>,
    /// Effects that passed the gates although structure remains.
    leads: Vec<EffectReport<'a>>,
}

#[derive(Serialize)]
struct EffectReport<'a> {
    kind: &'a str,
    #[serde(flatten)]
    joints: Joints,
    parameters: Vec<ParameterReport<'a>>,
    evidence: EvidenceReport<'a>,
}

#[derive(Serialize)]
struct AlternativeReport<'a> {
    kind: &'a str,
    #[serde(flatten)]
    joints: Joints,
    /// Place in `effects`, from 1.
    instead_of: usize,
    worse_percent: f64,
}

#[derive(Serialize)]
#[serde(untagged)]
enum Joints {
    One { joint: usize },
    Several { joints: Vec<usize> },
}

#[derive(Serialize)]
struct ParameterReport<'a> {
    name: &'a str,
    value: f64,
    /// None for shape parameters, which the amended spec fixes.
    std: Option<f64>,
}

#[derive(Serialize)]
struct EvidenceReport<'a> {
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
            outcome: verdict.outcome.name(),
            effects: effects
                .map(|(k, finding)| effect(finding, closed, k))
                .collect(),
            rmse_before: rmse(&closed.before.validation),
            rmse_after: rmse(&closed.after().validation),
            domain: "raw",
            relative_percent_before: relative(&closed.before.validation),
            relative_percent_after: relative(&closed.after().validation),
            alternatives: verdict.alternatives.iter().map(alternative).collect(),
            noise_floor: &verdict.noise_floor,
            structure_before: verdict.before.iter().map(|s| s.share).collect(),
            structure_after: verdict.after.iter().map(|s| s.share).collect(),
            leads: leads
                .map(|(k, lead)| effect(lead, closed, verdict.findings.len() + k))
                .collect(),
        }
    }
}

impl Joints {
    fn new(joints: &[usize]) -> Self {
        match joints {
            [joint] => Self::One { joint: joint + 1 },
            several => Self::Several {
                joints: several.iter().map(|joint| joint + 1).collect(),
            },
        }
    }
}

/// A finding or lead with the values that the amended model was identified with; `place` is its place among both.
fn effect<'a>(finding: &'a Finding, closed: &'a Loop, place: usize) -> EffectReport<'a> {
    let parameters = finding.parameters.iter().map(|parameter| {
        let identified = identified(closed, place, &parameter.name);
        ParameterReport {
            name: &parameter.name,
            value: identified.map_or(parameter.value, |(value, _)| value),
            std: identified.map(|(_, std)| std),
        }
    });
    let Evidence {
        score,
        p_value,
        held_out_percent,
        raw_percent,
        folds: (folds_improved, folds),
    } = &finding.evidence;
    EffectReport {
        kind: &finding.kind,
        joints: Joints::new(&finding.joints),
        parameters: parameters.collect(),
        evidence: EvidenceReport {
            score: *score,
            p_value: *p_value,
            held_out_percent,
            raw_percent,
            folds_improved: *folds_improved,
            folds: *folds,
        },
    }
}

/// Value and standard deviation of a finding's parameter in the amended model, whose last effects are the findings; none for
/// a lead, which is not declared.
fn identified(closed: &Loop, place: usize, name: &str) -> Option<(f64, f64)> {
    let after = closed.after();
    let model = &after.arm.compiled().model;
    let first = model
        .effects
        .len()
        .checked_sub(closed.verdict.findings.len())?;
    if place >= closed.verdict.findings.len() {
        return None;
    }
    let full = format!("{}.{name}", model.effect_name(first + place));
    let parameter = after
        .estimate
        .parameters
        .iter()
        .find(|parameter| parameter.name == full)?;
    Some((parameter.value, parameter.std))
}

fn alternative(alternative: &Alternative) -> AlternativeReport<'_> {
    AlternativeReport {
        kind: &alternative.kind,
        joints: Joints::new(&alternative.joints),
        instead_of: alternative.instead_of + 1,
        worse_percent: alternative.worse_percent,
    }
}

/// The result for people: outcome, effects, the spec's change, errors before and after.
pub(crate) fn summary(closed: &Loop, text: &str) -> String {
    let verdict = &closed.verdict;
    let mut out = match verdict.outcome {
        Outcome::NothingMissing => {
            "nothing missing: the declared model leaves no structure that matters\n".to_owned()
        }
        Outcome::Explained => "explained:\n".to_owned(),
        Outcome::Unexplained => {
            "unexplained: the residual follows the motion, and no known effect accounts for it\n"
                .to_owned()
        }
    };
    let mut show = |finding: &Finding, place: usize| {
        let effect = effect(finding, closed, place);
        let parameters: Vec<String> = effect
            .parameters
            .iter()
            .map(|parameter| format!("{} = {:.4}", parameter.name, parameter.value))
            .collect();
        let joints: Vec<&str> = finding
            .joints
            .iter()
            .map(|&joint| closed.before.arm.joints()[joint].as_str())
            .collect();
        writeln!(
            out,
            "  {} on {}: {} (score {:.0}, better in {} of {} folds)",
            finding.kind,
            joints.join(", "),
            parameters.join(", "),
            effect.evidence.score,
            effect.evidence.folds_improved,
            effect.evidence.folds,
        )
        .expect("a string takes all");
    };
    let found = verdict.findings.iter().chain(&verdict.leads);
    found
        .enumerate()
        .for_each(|(place, finding)| show(finding, place));

    for (joint, left) in verdict.after.iter().enumerate() {
        if left.is_material() {
            let name = &closed.before.arm.joints()[joint];
            let share = 100.0 * left.share;
            writeln!(
                out,
                "  {share:.0} % of the error's power on {name} still follows the motion"
            )
            .expect("a string takes all");
        }
    }
    let change = diff(text, &closed.amended);
    if !change.is_empty() {
        write!(out, "\n{change}").expect("a string takes all");
    }
    out.push('\n');
    out.push_str(&table(closed));
    out
}

/// Errors per joint before and after; on the validation log where there is one, else on the identification logs.
fn table(closed: &Loop) -> String {
    let (before, after) = (&closed.before, closed.after());
    let joints = before.arm.joints();
    let width = joints
        .iter()
        .map(String::len)
        .max()
        .unwrap_or(0)
        .max("joint".len());
    let mut out = String::new();
    if let (Some(old), Some(new)) = (&before.validation, &after.validation) {
        out.push_str("RMSE and relative error on the validation log, which was not fitted\n");
        writeln!(
            out,
            "{:width$}  {:>10}  {:>10}  {:>10}  {:>10}",
            "joint", "before", "after", "before", "after"
        )
        .expect("a string takes all");
        for (joint, name) in joints.iter().enumerate() {
            writeln!(
                out,
                "{name:width$}  {:>10.4}  {:>10.4}  {:>8.2} %  {:>8.2} %",
                old.rmse[joint],
                new.rmse[joint],
                old.relative_percent[joint],
                new.relative_percent[joint]
            )
            .expect("a string takes all");
        }
    } else {
        out.push_str("relative error on the logs that were fitted (give --validate for a log that was not)\n");
        writeln!(out, "{:width$}  {:>10}  {:>10}", "joint", "before", "after")
            .expect("a string takes all");
        for (joint, name) in joints.iter().enumerate() {
            let (old, new) = (
                before.estimate.relative_percent[joint],
                after.estimate.relative_percent[joint],
            );
            writeln!(out, "{name:width$}  {old:>8.2} %  {new:>8.2} %").expect("a string takes all");
        }
    }
    out
}

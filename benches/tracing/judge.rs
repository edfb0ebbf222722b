//! What `trace` made of an experiment, against what was put in.

use robot_model::identify::Identify;
use robot_model::trace::{Outcome, Tried};
use robot_model_cli::close_the_loop::{Loop, Progress, Stage, close};
use robot_model_cli::interpreted::InterpretedArm;
use robot_model_codegen::compile_model;
use robot_model_spec::load;
use robot_model_tests::cases::WITHOUT_JOINT;
use serde::{Deserialize, Serialize};

use crate::baselines;
use crate::catalogue::{Injection, Place};
use crate::experiment::{Case, Experiment};

/// An effect has to be named where leaving it out costs more than this share of a joint's error on data that were not fitted.
const LEAST_COST: f64 = 0.05;

/// What an answer is worth.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Mark {
    /// The effect, on its joint, and nothing else; or nothing where nothing is.
    Exact,
    /// A neighboring law on that joint, and nothing else.
    Near,
    /// Silence where what is there is too little to matter.
    Small,
    /// Said to be missing, without a name.
    Abstained,
    /// Not seen.
    Missed,
    /// A wrong name.
    Wrong,
}

/// One experiment, judged.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub struct Row {
    pub arm: String,
    pub kind: String,
    pub share: f64,
    pub seed: u64,
    /// Its place in the catalogue: laws of no library share a name.
    pub number: usize,
    /// Bits a turn of the encoders, where they are coarse.
    pub encoder_bits: Option<u8>,
    /// What its torques have that those of a usual drive have not.
    #[serde(default)]
    pub noise: String,
    /// Whether its motions repeat.
    pub repeats: bool,
    /// Joints from 1.
    pub joints: Vec<usize>,
    /// Whether leaving it out costs something.
    pub is_material: bool,
    pub mark: Mark,
    /// What was said.
    pub outcome: String,
    pub said: Vec<String>,
    /// Whether the effect is said to do as well as one that is named.
    pub is_alternative: bool,
    /// Largest share of the raw error's power that still follows the motion on a joint of what was said.
    #[serde(default)]
    pub left_share: f64,
    /// Error with what was said over that of the true model, on data that were not fitted, of the worst joint.
    pub after_over_truth: Option<f64>,
    /// Where the name is exact, by how many of its told deviations each parameter that has one is from what was put in.
    #[serde(default)]
    pub deviations: Vec<f64>,
    pub seconds: f64,
    /// What was judged, with the reasons against it.
    pub tried: Vec<String>,
    /// What baselines made of the same logs; none of faults of the logs, which are found before any of them runs.
    #[serde(default)]
    pub baselines: Vec<Answer>,
}

/// What a baseline made of an experiment.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub struct Answer {
    pub method: String,
    /// Of what it said first.
    pub mark: Mark,
    /// What was said, the largest first.
    pub said: Vec<String>,
    /// How many effects it chose, with those that do not matter.
    pub chosen: usize,
    pub seconds: f64,
}

/// Effects and the joints, from 0, that they are said to be on.
type Said = [(String, Vec<usize>)];

impl Row {
    /// What it shares with the same effect in other sizes: joint, motion and noise. Arms that lack nothing or have an unknown law share them with
    /// none.
    pub fn draw(&self) -> (&str, usize, u64, u64) {
        let size = if ["nothing", "unknown"].contains(&self.kind.as_str()) {
            self.share.to_bits()
        } else {
            0
        };
        (&self.arm, self.number, self.seed, size)
    }

    /// Whether it is of this size.
    pub fn is_of(&self, share: f64) -> bool {
        (self.share - share).abs() < 1e-9
    }
}

/// Closes the loop on an experiment; asks the baselines, too, where that is wanted.
///
/// # Errors
/// What went wrong, in words.
pub fn judge(case: &Case, experiment: &Experiment, with_baselines: bool) -> Result<Row, String> {
    let [identify, validate] = &experiment.logs;
    let start = std::time::Instant::now();
    let name = format!("{}.robot", case.arm.name);
    let closed = close(
        &name,
        &experiment.declared,
        std::slice::from_ref(identify),
        Some(validate),
        &Progress::silent(),
    )
    .map_err(|error| error.to_string())?;
    let seconds = start.elapsed().as_secs_f64();
    let best = experiment
        .truth
        .as_deref()
        .map(|truth| true_errors(&name, truth, experiment, &closed))
        .transpose()?;
    let (before, after) = (errors(&closed.before), errors(closed.after()));
    let costs = best.as_ref().map(|best| {
        before
            .iter()
            .zip(best)
            .any(|(before, best)| *best < (1.0 - LEAST_COST) * before)
    });
    // Bad samples are in no model, and are as large as they were made.
    let is_material = case.injection.is_named() && costs.unwrap_or(true);
    let mut said: Vec<(String, Vec<usize>)> = closed
        .faults
        .iter()
        .map(|fault| (fault.kind.to_owned(), Vec::new()))
        .collect();
    said.extend(
        closed
            .verdict
            .findings
            .iter()
            .map(|finding| (finding.kind.clone(), finding.joints.clone())),
    );
    let judged = |outcome: Outcome, said: &Said| {
        let dof = case.arm.joints.len();
        mark(
            case.injection,
            &experiment.joints,
            dof,
            outcome,
            said,
            is_material,
        )
    };
    let answers = if with_baselines && case.injection.place != Place::Log {
        baselines::answers(&closed)?
    } else {
        Vec::new()
    };
    let faults = &said[..closed.faults.len()];
    let mut rivals = closed.verdict.alternatives.iter();
    let is_it = |kind: &str, joints: &[usize]| {
        let rival = [(kind.to_owned(), joints.to_vec())];
        judged(Outcome::Explained, &rival) == Mark::Exact
    };
    let mark = judged(closed.outcome(), &said);
    let deviations = if mark == Mark::Exact {
        deviations(case.injection, experiment, &closed)
    } else {
        Vec::new()
    };
    Ok(Row {
        arm: case.arm.name.to_owned(),
        kind: case.injection.kind.to_owned(),
        share: case.share,
        seed: case.seed,
        number: case.number(),
        encoder_bits: case.injection.encoder_bits,
        noise: case.injection.noise.name.to_owned(),
        repeats: experiment.repeats,
        joints: experiment.joints.iter().map(|joint| joint + 1).collect(),
        is_material,
        mark,
        outcome: closed.outcome().name().to_owned(),
        said: said.iter().map(label).collect(),
        is_alternative: rivals.any(|rival| is_it(&rival.kind, &rival.joints)),
        left_share: left_share(&closed),
        after_over_truth: best.map(|best| {
            let ratios = after
                .iter()
                .zip(best)
                .map(|(after, best)| after / best.max(f64::MIN_POSITIVE));
            ratios.fold(0.0, f64::max)
        }),
        deviations,
        seconds,
        tried: closed.verdict.tried.iter().map(told).collect(),
        baselines: answers
            .iter()
            .map(|answer| first(answer, faults, &judged))
            .collect(),
    })
}

/// Parameters of the only finding against those of the same effect that was put in.
fn deviations(injection: &Injection, experiment: &Experiment, closed: &Loop) -> Vec<f64> {
    let findings = closed.verdict.findings.iter().enumerate();
    let same = findings.filter(|(_, finding)| finding.effect == injection.effect());
    let told = same.flat_map(|(place, finding)| closed.parameters(finding, place));
    let deviations = told.filter_map(|(name, value, sure)| {
        let mut all = experiment.parameters.iter();
        let (_, truth) = all.find(|(own, _)| *own == name)?;
        sure.std()
            .filter(|std| *std > 0.0)
            .map(|std| (value - truth) / std)
    });
    deviations.collect()
}

/// Errors on the log that was not fitted, of each joint.
fn errors(stage: &Stage) -> Vec<f64> {
    let validation = stage.validation.as_ref();
    validation.map_or_else(Vec::new, |errors| errors.rmse.clone())
}

/// Structure that is left on joints of findings; of those that act on the arm as a whole on any.
fn left_share(closed: &Loop) -> f64 {
    let after = &closed.verdict.after;
    let joints = closed.verdict.findings.iter().flat_map(|finding| {
        let all = 0..after.len();
        all.filter(|joint| finding.joints.is_empty() || finding.joints.contains(joint))
    });
    let shares = joints.map(|joint| after[joint].share);
    shares.fold(0.0, f64::max)
}

/// A baseline's answer by what it says first, where a fault of the logs comes before all else. It has no word for what no effect explains.
fn first(
    answer: &baselines::Answer,
    faults: &Said,
    judged: &dyn Fn(Outcome, &Said) -> Mark,
) -> Answer {
    let said = [faults, &answer.named].concat();
    let first = &said[..said.len().min(1)];
    let outcome = if first.is_empty() {
        Outcome::NothingMissing
    } else {
        Outcome::Explained
    };
    Answer {
        method: answer.method.to_owned(),
        mark: judged(outcome, first),
        said: said.iter().map(label).collect(),
        chosen: answer.chosen,
        seconds: answer.seconds,
    }
}

/// An effect and its joints, from 1.
fn label((kind, joints): &(String, Vec<usize>)) -> String {
    let joints: Vec<String> = joints.iter().map(|joint| (joint + 1).to_string()).collect();
    format!("{kind}@{}", joints.join("+"))
}

/// A candidate, what it takes off the error of each joint, and the reasons against it.
fn told(tried: &Tried) -> String {
    let joints: Vec<String> = tried
        .joints
        .iter()
        .map(|joint| (joint + 1).to_string())
        .collect();
    let refusals: Vec<&str> = tried.refusals.iter().map(|one| one.name()).collect();
    format!(
        "round {}: {}@{} {:.3?}, p {:.1e}, folds {:?}, raw {:.1?} %, {}",
        tried.round + 1,
        tried.kind,
        joints.join("+"),
        tried.shapes,
        tried.evidence.p_value,
        tried.evidence.folds,
        tried.evidence.raw_percent,
        refusals.join(" ")
    )
}

/// Errors of the true model, identified on the same log.
fn true_errors(
    name: &str,
    truth: &str,
    experiment: &Experiment,
    closed: &Loop,
) -> Result<Vec<f64>, String> {
    let said = |error: &dyn std::fmt::Display| error.to_string();
    let model = load(name, truth).map_err(|error| said(&error))?;
    let arm = InterpretedArm::new(compile_model(&model));
    let [identify, validate] = experiment.logs.clone();
    let period = identify.period();
    let [identify, validate] = [identify, validate].map(|log| log.with_motion_phase(period));
    let same_band = Identify {
        bands: Some(closed.before.estimate.bands),
        ..Identify::default()
    };
    let estimate = same_band
        .fit(&arm, std::slice::from_ref(&identify))
        .map_err(|error| said(&error))?;
    Ok(estimate
        .errors(&arm, &validate)
        .map_err(|error| said(&error))?
        .rmse)
}

/// Whether these are the same joints in any order.
fn is_same(on: &[usize], joints: &[usize]) -> bool {
    on.len() == joints.len() && on.iter().all(|joint| joints.contains(joint))
}

fn mark(
    injection: &Injection,
    joints: &[usize],
    dof: usize,
    outcome: Outcome,
    said: &Said,
    is_material: bool,
) -> Mark {
    let names = |(kind, on): &(String, Vec<usize>), near: bool| {
        let is_kind = kind == injection.kind
            || injection.same.contains(&kind.as_str())
            || (near && injection.near.contains(&kind.as_str()));
        // A body more on the last link is that link's error.
        let is_last =
            kind != "link-inertial-error" || injection.kind != "payload" || on == &[dof - 1];
        let anywhere = WITHOUT_JOINT.contains(&injection.kind);
        is_kind && is_last && (anywhere || on.is_empty() || is_same(on, joints))
    };
    match (outcome, said) {
        (Outcome::NothingMissing, _) if !injection.is_named() && injection.law.is_none() => {
            Mark::Exact
        }
        (Outcome::NothingMissing, _) if !is_material && injection.law.is_none() => Mark::Small,
        (Outcome::NothingMissing, _) => Mark::Missed,
        (Outcome::Unexplained, _) if injection.law.is_some() => Mark::Exact,
        (Outcome::Unexplained, _) if injection.is_named() => Mark::Abstained,
        (Outcome::Explained, [one]) if injection.is_named() && names(one, false) => Mark::Exact,
        (Outcome::Explained, [one]) if injection.is_named() && names(one, true) => Mark::Near,
        _ => Mark::Wrong,
    }
}

//! The loop itself: mend the logs, identify, trace, amend the text, compile that text, identify again, compare.

mod found;
mod settled;

use robot_model::columns::{Arm, Columns};
use robot_model::identify::{Errors, Estimate, Identified, Identify};
use robot_model::log::{Fault, Log};
use robot_model::trace::{Finding, MOST_EFFECTS, Outcome, Trace, Verdict};
use robot_model_codegen::compile_for_rows;
use robot_model_spec::amend::{Amendment, amend};
use robot_model_spec::load;

use crate::Error;
pub use crate::data_checks::Check;
use crate::data_checks::checks;
use crate::data_gate;
pub use crate::data_gate::DataFault;
use crate::identify::fit::ByAcceleration;
use crate::identify::noted::too_slow;
use crate::identify::{doubts, readings};
use crate::interpreted::InterpretedArm;
pub use crate::progress::Progress;
use crate::rounds::Rounds;
use crate::spec::clear;
pub use found::Sure;
use settled::{Amended, Settled, is_of, settled};

/// A model, what was identified with it, and how it does on data that it was not fitted on.
#[derive(Debug)]
pub struct Stage {
    /// The model.
    pub arm: InterpretedArm,
    /// What was identified with it.
    pub estimate: Estimate,
    /// On the validation log, where there is one.
    pub validation: Option<Errors>,
    /// Speeds below which dry friction did not act in full, one a joint, rad/s or m/s, as logs tell; zero where they do not.
    pub turn_speeds: Vec<f64>,
}

/// The loop, closed.
#[derive(Debug)]
pub struct Loop {
    /// The declared model.
    pub before: Stage,
    /// What is wrong with the logs; the verdict is of logs without it.
    pub faults: Vec<DataFault>,
    /// What the gate noted of each log, by the log's name, whether or not it matters.
    pub noted: Vec<(String, Fault)>,
    /// What the logs were looked through for, and what that found.
    pub checks: Vec<Check>,
    /// Another way to read the logs, with which the declared model explains them far better.
    pub reading: Option<String>,
    /// The logs without it, which were traced.
    pub traced: Vec<Log>,
    /// The log that was not fitted, with all that effects may read of it.
    pub unseen: Option<Log>,
    /// What the tracer says of the logs without their faults.
    pub verdict: Verdict,
    /// The spec with the findings declared, in their order; the text as it was where there are none. Leads stay out: what
    /// does not explain the residual is no part of the arm.
    pub amended: String,
    /// None where the spec did not change.
    pub changed: Option<Stage>,
    /// The lead that the tracer named, and of which nothing was left once the arm was identified with it; by its place.
    pub vanished: Option<usize>,
}

impl Loop {
    /// The last model and its numbers.
    #[must_use]
    pub fn after(&self) -> &Stage {
        self.changed.as_ref().unwrap_or(&self.before)
    }

    /// Parameters of the last model that no arm has below zero, and that are: what is missing hides in them.
    pub fn impossible(&self) -> impl Iterator<Item = &Identified> {
        let Stage { arm, estimate, .. } = self.after();
        doubts::impossible(estimate, arm.unknowns())
    }

    /// How it ended: a fault of the logs that accounts for all that was missing explains it.
    #[must_use]
    pub fn outcome(&self) -> Outcome {
        match self.verdict.outcome {
            _ if self.reading.is_some() => Outcome::Unexplained,
            _ if self.faults.iter().any(|fault| fault.is_last) => Outcome::Explained,
            Outcome::NothingMissing if !self.faults.is_empty() => Outcome::Explained,
            other => other,
        }
    }
}

/// Parts of the first step, which takes a minute for seven joints.
const PARTS: usize = 5;

/// Runs the loop on the text of a spec; `source_name` is what errors call it. `logs` are mended, fitted and traced; `validate` is used for
/// numbers only, once per model.
///
/// # Errors
/// Mistakes of the text, and those of [`Identify::fit`] and [`Estimate::errors`].
pub fn close(
    source_name: &str,
    text: &str,
    logs: &[Log],
    validate: Option<&Log>,
    progress: &Progress,
) -> Result<Loop, Error> {
    progress.step("identifying the declared model");
    let inside = |part: usize, what: &str| {
        progress.inside(&format!(
            "identifying the declared model, {part} of {PARTS}: {what}"
        ));
    };
    inside(1, "samples that were not measured");
    let mut mended = data_gate::mend(logs, progress);
    for one in &mut mended {
        one.log = one.log.clone().with_motion_phase(None);
    }
    let period = mended.iter().find_map(|one| one.log.period());
    let unseen = validate.map(|log| log.clone().with_motion_phase(period));
    let validate = unseen.as_ref();
    let sound: Vec<Log> = mended.iter().map(|one| one.log.clone()).collect();
    let declared = compiled(source_name, text)?;
    inside(2, "speeds at velocity reversals");
    let speeds = Identify::default().turn_speeds(&declared, &sound)?;
    let sound = Log::all_with_turn_speeds(&sound, &speeds);
    let mut on_time = sound.clone();
    let turned = validate.map(|log| log.clone().with_turn_speeds(speeds));
    inside(3, "the fit");
    let estimate = Identify::default().fit(&declared, &sound)?;
    inside(4, "the band with the smallest raw errors");
    let before = Stage::judged(declared, estimate, &sound, turned.as_ref())?;
    inside(5, "faults of the logs");
    let (arm, estimate) = (&before.arm, &before.estimate);
    if let Some(slow) = turned.as_ref().and_then(|log| too_slow(estimate, log)) {
        progress.note(&format!("note: {slow}"));
    }
    let reading = readings::others(&ByAcceleration(arm), &Identify::default(), &sound, estimate);
    let mut faults: Vec<DataFault> = Vec::new();
    faults.extend(data_gate::corrupt(arm, estimate, logs, &mended)?);
    if reading.is_some() {
        // Columns of other joints, or of another sign, look late, and like any law.
    } else if let Some(smoothed) = data_gate::smoothed(arm, estimate, &sound)? {
        faults.push(smoothed);
    } else if let Some(late) = data_gate::late_position(estimate, progress) {
        faults.push(late);
    } else if let Some((late, logs)) = data_gate::delay(arm, estimate, &sound) {
        faults.push(late);
        // What turns look like is asked of them anew.
        on_time = Log::all_with_turn_speeds(&logs, &[]);
    }
    let checks = checks(arm, &mended, estimate, &faults);
    let noted = mended.iter().flat_map(|one| {
        let faults = one.faults.iter().cloned();
        faults.map(|fault| (one.log.source.clone(), fault))
    });
    let noted = noted.collect();
    let declared: Vec<Amendment> = faults.iter().filter_map(of_fault).collect();
    let is_last = reading.is_some() || faults.iter().any(|fault| fault.is_last);
    let ask = |barred: &[Finding]| {
        let asks = (!is_last).then_some(barred);
        trace(source_name, text, &on_time, asks, progress)
    };
    let with = |findings: &[Finding]| -> Result<Amended, Error> {
        let found = findings.iter().map(|finding| amendment(finding, arm));
        let amendments: Vec<Amendment> = declared.iter().cloned().chain(found).collect();
        let amended = amend(source_name, text, &amendments)?;
        if amendments.is_empty() {
            return Ok((amended, None));
        }
        progress.step("identifying the amended model");
        let arm = compiled(source_name, &amended)?;
        // The same band as before, so that the errors are those of the same samples, but for links that follow the load, which have
        // their own.
        let identify = Identify {
            bands: (!arm.follows_load()).then_some(estimate.bands),
            ..Identify::default()
        };
        // How joints turn round without what was missing is another thing.
        let sound = Log::all_with_turn_speeds(&sound, &[]);
        let speeds = Identify::default().turn_speeds(&arm, &sound)?;
        let sound = Log::all_with_turn_speeds(&sound, &speeds);
        let unseen = unseen.clone().map(|log| log.with_turn_speeds(speeds));
        let estimate = identify.fit(&arm, &sound)?;
        let stage = Stage::judged(arm, estimate, &sound, unseen.as_ref())?;
        Ok((amended, Some(stage)))
    };
    let Settled {
        verdict,
        amended,
        changed,
        vanished,
    } = settled(&ask, &with, arm)?;
    let speeds = &changed.as_ref().unwrap_or(&before).turn_speeds;
    let unseen = unseen.map(|log| log.with_turn_speeds(speeds.clone()));
    Ok(Loop {
        before,
        faults,
        noted,
        checks,
        reading,
        traced: on_time,
        unseen,
        verdict,
        amended,
        changed,
        vanished,
    })
}

/// Traces until nothing changes the arm any more: what changes it is declared, and what else is missing is asked of the arm with it.
/// `barred` are not asked for; none is asked for without it.
fn trace(
    source_name: &str,
    text: &str,
    logs: &[Log],
    barred: Option<&[Finding]>,
    progress: &Progress,
) -> Result<Verdict, Error> {
    let (mut text, mut logs) = (text.to_owned(), logs.to_vec());
    let mut found: Option<Verdict> = None;
    let mut rounds = Rounds::new(MOST_EFFECTS);
    loop {
        let arm = compiled(source_name, &text)?;
        let undeclared = arm.undeclared();
        let candidates = barred.map_or_else(Vec::new, |barred| {
            let mut candidates = undeclared.candidates();
            candidates.retain(|one| !barred.iter().any(|finding| is_of(finding, *one)));
            candidates
        });
        let mut trace = Trace::new(candidates);
        if let Some(found) = &found {
            trace = trace.since(found);
        }
        let verdict = trace.run(&arm, &logs, &mut |stage| {
            let told = rounds.told(stage.words, stage.done);
            progress.stage(&told, stage.done);
        })?;
        let (goes_on, fresh) = (verdict.goes_on, verdict.findings.len());
        let verdict = match found {
            Some(before) => before.followed_by(verdict),
            None => verdict,
        };
        if !goes_on || verdict.findings.len() >= MOST_EFFECTS {
            return Ok(verdict);
        }
        let fresh = &verdict.findings[verdict.findings.len() - fresh..];
        let fresh: Vec<Amendment> = fresh.iter().map(|one| amendment(one, &arm)).collect();
        text = amend(source_name, &text, &fresh)?;
        logs = Log::all_with_turn_speeds(&logs, &verdict.turn_speeds);
        found = Some(verdict);
    }
}

pub(crate) fn compiled(source_name: &str, text: &str) -> Result<InterpretedArm, Error> {
    let model = load(source_name, text)?;
    Ok(InterpretedArm::new(clear(compile_for_rows(&model))?))
}

impl Stage {
    fn judged(
        arm: InterpretedArm,
        estimate: Estimate,
        logs: &[Log],
        validate: Option<&Log>,
    ) -> Result<Self, Error> {
        let estimate = estimate.with_best_motion(&arm, logs)?;
        let validation = validate.map(|log| estimate.errors(&arm, log)).transpose()?;
        Ok(Self {
            arm,
            estimate,
            validation,
            turn_speeds: logs
                .first()
                .map_or_else(Vec::new, |log| log.turn_speeds.clone()),
        })
    }
}

/// What a finding says, as a line of a spec.
fn amendment(finding: &Finding, arm: &InterpretedArm) -> Amendment {
    let shapes = finding
        .parameters
        .iter()
        .filter(|parameter| parameter.shape);
    Amendment {
        effect: finding.effect.clone(),
        joints: finding
            .joints
            .iter()
            .map(|&joint| arm.joints()[joint].clone())
            .collect(),
        shapes: shapes
            .map(|parameter| (parameter.name.clone(), readable(parameter.value)))
            .collect(),
    }
}

/// What a spec says of a fault of the logs: all torques may be late; bad samples and late encoders are none of its business.
fn of_fault(fault: &DataFault) -> Option<Amendment> {
    let (seconds, _) = fault.delay.filter(|_| fault.joints.is_empty())?;
    Some(Amendment {
        effect: "time_delay".to_owned(),
        joints: Vec::new(),
        shapes: vec![("delay".to_owned(), readable(seconds))],
    })
}

/// Four digits: more of a shape parameter is not known, and a person will read it.
fn readable(value: f64) -> f64 {
    format!("{value:.3e}").parse().unwrap_or(value)
}

#[cfg(test)]
mod tests {
    use super::settled::is_change;
    use super::{close, compiled, trace};
    use crate::progress::Progress;
    use crate::trace::cart::{CART, log, log_with};

    /// A law is no change of the arm, a spring behind a motor is one, and what is barred is not found.
    #[test]
    fn what_is_barred_is_not_asked_for() {
        let arm = compiled("cart.robot", CART).unwrap_or_else(|error| panic!("{error}"));
        let logs = [log()];
        let found = |barred: &[_]| {
            trace("cart.robot", CART, &logs, Some(barred), &Progress::new())
                .unwrap_or_else(|error| panic!("{error}"))
                .findings
        };
        let all = found(&[]);
        let friction = all.iter().find(|one| one.effect == "coulomb_friction");
        let mut friction = friction.expect("dry friction").clone();
        assert!(!is_change(&friction, &arm));
        let others = found(std::slice::from_ref(&friction));
        assert!(others.iter().all(|one| one.effect != "coulomb_friction"));
        friction.effect = "joint_elasticity".to_owned();
        assert!(is_change(&friction, &arm));
    }

    /// A cart that creeps where it turns, below 1.5 mm/s, and that a spring holds of which its spec knows nothing: with the force of the spring
    /// in what it leaves its turns are not told.
    #[test]
    fn how_joints_turn_is_asked_again_of_the_amended_spec() {
        let spec = CART.replace(
            "viscous_friction on",
            "viscous_friction on rail; coulomb_friction on",
        );
        let slow = [(0.2, 0.3), (0.05, 0.7), (0.02, 1.3)];
        let log = log_with(&slow, |q, dq| 30.0 * q + 2.0 * (dq / 1.5e-3).tanh());
        let logs = std::slice::from_ref(&log);
        let closed = close("cart.robot", &spec, logs, Some(&log), &Progress::new())
            .unwrap_or_else(|error| panic!("{error}"));
        let changed = closed.changed.as_ref();
        let changed = changed.unwrap_or_else(|| panic!("{:?}", closed.verdict));
        let (before, after) = (closed.before.turn_speeds[0], changed.turn_speeds[0]);
        assert!((after - 1.5e-3).abs() < 2e-4, "{after} m/s");
        assert!((before - 1.5e-3).abs() > 5e-4, "{before} m/s");
        let unseen = closed.unseen.as_ref().expect("the log to judge on");
        assert_eq!(unseen.turn_speeds, [after]);
    }
}

//! The loop itself: mend the logs, identify, trace, amend the text, compile that text, identify again, compare.

use robot_model::columns::{Arm, Candidate};
use robot_model::identify::{Errors, Estimate, Identify};
use robot_model::log::Log;
use robot_model::trace::{Finding, Outcome, Trace, Verdict};
use robot_model_codegen::compile_model;
use robot_model_spec::amend::{Amendment, amend};
use robot_model_spec::load;

use crate::Error;
use crate::data_gate::{self, DataFault};
use crate::interpreted::InterpretedArm;
use crate::progress::Progress;
use crate::spec::clear;

/// A model, what was identified with it, and how it does on data that it was not fitted on.
#[derive(Debug)]
pub(crate) struct Stage {
    pub arm: InterpretedArm,
    pub estimate: Estimate,
    /// On the validation log, where there is one.
    pub validation: Option<Errors>,
}

/// The loop, closed.
#[derive(Debug)]
pub(crate) struct Loop {
    pub before: Stage,
    /// What is wrong with the logs; the verdict is of logs without it.
    pub faults: Vec<DataFault>,
    pub verdict: Verdict,
    /// The spec with the findings declared, in their order; the text as it was where there are none. Leads stay out: what
    /// does not explain the residual is no part of the arm.
    pub amended: String,
    /// None where the spec did not change.
    pub changed: Option<Stage>,
}

impl Loop {
    /// The last model and its numbers.
    pub(crate) fn after(&self) -> &Stage {
        self.changed.as_ref().unwrap_or(&self.before)
    }

    /// How it ended: a fault of the logs that accounts for all that was missing explains it.
    pub(crate) fn outcome(&self) -> Outcome {
        match self.verdict.outcome {
            Outcome::NothingMissing if !self.faults.is_empty() => Outcome::Explained,
            other => other,
        }
    }
}

/// Runs the loop. `logs` are mended, fitted and traced; `validate` is used for numbers only, once per model.
pub(crate) fn close(
    source_name: &str,
    text: &str,
    logs: &[Log],
    validate: Option<&Log>,
    progress: &Progress,
) -> Result<Loop, Error> {
    progress.step("identifying the declared model");
    let mended = data_gate::mend(logs, progress);
    let mut on_time: Vec<Log> = mended.iter().map(|one| one.log.clone()).collect();
    let sound = on_time.clone();
    let before = Stage::identify(source_name, text, &sound, validate, &Identify::default())?;
    let (arm, estimate) = (&before.arm, &before.estimate);
    let mut faults: Vec<DataFault> = Vec::new();
    faults.extend(data_gate::corrupt(arm, estimate, logs, &mended)?);
    if let Some((late, logs)) = data_gate::delay(arm, estimate, &sound) {
        faults.push(late);
        on_time = logs;
    }
    let (torques, bodies) = (arm.candidates(), arm.bodies());
    let torques = torques.iter().map(|torque| torque as &dyn Candidate);
    let bodies = bodies.iter().map(|body| body as &dyn Candidate);
    let verdict = Trace::new(torques.chain(bodies).collect())
        .run(arm, &on_time, &mut |stage| progress.step(stage))?;

    let found = verdict.findings.iter();
    let amendments: Vec<Amendment> = faults
        .iter()
        .filter_map(DataFault::amendment)
        .chain(found.map(|finding| amendment(finding, arm)))
        .collect();
    let amended = amend(source_name, text, &amendments)?;
    let changed = if amendments.is_empty() {
        None
    } else {
        progress.step("identifying the amended model");
        // The same band as before, so that the errors are those of the same samples.
        let same_band = Identify {
            bands: Some(estimate.bands),
            ..Identify::default()
        };
        Some(Stage::identify(
            source_name,
            &amended,
            &sound,
            validate,
            &same_band,
        )?)
    };
    Ok(Loop {
        before,
        faults,
        verdict,
        amended,
        changed,
    })
}

impl Stage {
    fn identify(
        source_name: &str,
        text: &str,
        logs: &[Log],
        validate: Option<&Log>,
        identify: &Identify,
    ) -> Result<Self, Error> {
        let arm = InterpretedArm::new(clear(compile_model(&load(source_name, text)?))?);
        let estimate = identify.fit(&arm, logs)?;
        let validation = validate.map(|log| estimate.errors(&arm, log)).transpose()?;
        Ok(Self {
            arm,
            estimate,
            validation,
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
        effect: finding.kind.replace('-', "_"),
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

/// Four digits: more of a shape parameter is not known, and a person will read it.
pub(crate) fn readable(value: f64) -> f64 {
    format!("{value:.3e}").parse().unwrap_or(value)
}

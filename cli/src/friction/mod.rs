//! `robot-model friction`: a joint's friction curve, its static law, and its bristles.

mod columns;
mod figure;
mod report;
mod said;

use std::path::PathBuf;

use clap::Args;
use robot_model::columns::Arm;
use robot_model::friction_curve::{Bristles, Curve, Law, Measured};
use robot_model::log::Log;
use robot_model_codegen::Compiled;

use crate::Error;
use crate::dissect::check_channels;
use crate::identify::far;
use crate::interpreted::InterpretedArm;
use crate::log_settings::LogSettings;
use crate::output::{self, Content, Files, Record, counted, names};
use crate::parameters;
use crate::progress::Progress;
use crate::spec::{compile_instantaneous, read_mended};
use report::Found;

/// Measure a joint's friction curve from runs at constant speeds: the curve, its static law, and the lines for the spec.
///
/// It uses stretches of the logs in which the joint moves at constant speed for at least 0.3 s while all others rest. The rigid body's
/// torque is fitted with the curve, so no parameter must be known.
#[derive(Debug, Args)]
#[command(after_help = "Examples:
  robot-model friction arm.robot speeds.csv --joint elbow --figure elbow.svg
  robot-model friction arm.robot there.csv back.csv --joint elbow --pre-sliding ramp.csv --json elbow.json")]
pub(crate) struct Friction {
    /// The `.robot` file; the joint's friction need not be declared in it.
    spec: PathBuf,
    /// Logs: CSV (plain or gzip) or Parquet, `time,q1..qn[,dq1..dqn],tau1..taun[,extra..]`, SI units, or as the spec's `log` or a `robot-model.toml` has them;
    /// or MCAP, a bag of ROS 2 with joint states.
    #[arg(required = true, value_name = "LOG")]
    logs: Vec<PathBuf>,
    /// The joint, by its name or by its number from 1.
    #[arg(long, value_name = "NAME")]
    joint: String,
    /// A log in which the torque rises slowly from rest until the joint breaks away: identifies the stiffness of its bristles.
    #[arg(long, value_name = "LOG")]
    pre_sliding: Option<PathBuf>,
    #[command(flatten)]
    log_settings: LogSettings,
    /// The arm's parameters, by name or what `identify --json` writes: the rigid body's torque is then computed, not fitted.
    #[arg(long, value_name = "FILE.json")]
    parameters: Option<PathBuf>,
    /// Write the result as JSON; its `parameters` are start values for `identify --method output-error`.
    #[arg(long, value_name = "FILE")]
    json: Option<PathBuf>,
    /// Draw the curve.
    #[arg(long, value_name = "FILE.svg")]
    figure: Option<PathBuf>,
}

impl Friction {
    pub(crate) fn run(&self) -> Result<(), Error> {
        let inputs = std::iter::once(&self.spec)
            .chain(&self.logs)
            .chain(&self.pre_sliding)
            .chain(&self.parameters);
        let settings = &self.log_settings;
        let mut files = Files::reading(inputs.map(PathBuf::as_path))
            .and(settings.files(self.logs.iter().chain(&self.pre_sliding)));
        let json = files.claim_if(self.json.as_deref(), Content::Json(Record::Friction))?;
        let figure = files.claim_figure(self.figure.as_deref())?;
        let compiled = compile_instantaneous(&self.spec)?;
        let joint = self.joint(&compiled)?;
        let progress = Progress::new();
        let read = |path: &PathBuf| -> Result<Log, Error> {
            Ok(read_mended(path, &compiled.model, settings, &progress)?.log)
        };
        let logs: Vec<Log> = self.logs.iter().map(read).collect::<Result<_, _>>()?;
        let pre_sliding = self.pre_sliding.as_ref().map(read).transpose()?;
        let arm = InterpretedArm::new(compiled.clone());
        for log in logs.iter().chain(&pre_sliding) {
            check_channels(&arm, log)?;
            let positions = far::positions(&compiled.model, log).into_iter();
            for doubt in positions.chain(far::torques(&compiled.model, log)) {
                progress.note(&format!("note: {}: {doubt}", log.source));
            }
        }
        let measured = self.measured(&compiled, &arm, joint, &progress)?;
        progress.step("looking for constant speeds");
        let curve = measured.curve(&logs).map_err(refused)?;
        let law = Law::fit(&curve).map_err(refused)?;
        let bristles = match &pre_sliding {
            None => None,
            Some(log) => Some(bristles(&measured, &curve, &law, log)?),
        };
        let found = Found {
            joint: &compiled.model.joints[joint],
            curve: &curve,
            law: &law,
            bristles: bristles.as_ref(),
            is_fitted: self.parameters.is_none(),
        };
        progress.notes(found.doubts());
        drop(progress);
        if let Some(file) = figure {
            file.commit(figure::svg(&found).as_bytes())?;
        }
        if let Some(file) = json {
            file.commit(output::json(&found.report()).as_bytes())?;
        }
        output::print(&found.text())
    }

    fn joint(&self, compiled: &Compiled) -> Result<usize, Error> {
        let joints = &compiled.model.joints;
        let named = joints.iter().position(|joint| joint.name == self.joint);
        let number = self.joint.parse::<usize>().ok();
        let numbered = number.filter(|number| (1..=joints.len()).contains(number));
        let found = named.or_else(|| numbered.map(|number| number - 1));
        found.ok_or_else(|| {
            let known: Vec<&str> = joints.iter().map(|joint| joint.name.as_str()).collect();
            Error::Argument(format!(
                "--joint {}: {} has no such joint; its joints are {}",
                self.joint,
                compiled.model.name,
                names(&known)
            ))
        })
    }

    /// The joint with what its torque is made of beside friction.
    fn measured<'a>(
        &self,
        compiled: &Compiled,
        arm: &'a InterpretedArm,
        joint: usize,
        progress: &Progress,
    ) -> Result<Measured<'a>, Error> {
        let (columns, left_out) = columns::beside(compiled);
        let mut shapes = columns::middle(arm);
        if !left_out.is_empty() {
            let left_out: Vec<&str> = left_out.iter().map(String::as_str).collect();
            progress.note(&format!(
                "note: {} ignored, as a shape has no value; give it in the spec",
                match left_out.len() {
                    1 => format!("the effect {} is", names(&left_out)),
                    _ => format!("the effects {} are", names(&left_out)),
                }
            ));
        }
        let known = match &self.parameters {
            None => None,
            Some(path) => {
                let known = parameters::known(compiled, Some(path), &[])?;
                let missing = columns::rigid(compiled, &known.missing);
                if !missing.is_empty() {
                    return Err(Error::Argument(format!(
                        "{}: no value for {}; without `--parameters` the rigid body is fitted together with the curve",
                        path.display(),
                        names(&missing)
                    )));
                }
                let free = compiled.free_shapes();
                shapes = free.iter().map(|&k| known.shapes[k]).collect();
                Some(known.beta)
            }
        };
        Ok(Measured {
            arm: arm as &dyn Arm,
            joint,
            shapes,
            columns,
            known,
        })
    }
}

/// Bristles slide at what the static law says.
fn bristles(
    measured: &Measured<'_>,
    curve: &Curve,
    law: &Law,
    log: &Log,
) -> Result<Bristles, Error> {
    if law.coulomb.value <= 0.0 {
        return Err(Error::Argument(format!(
            "the static law has a Coulomb torque of {:.4}, with which no bristles slide; measure the curve at lower speeds, where {} not enough",
            law.coulomb.value,
            counted(curve.points.len(), "point")
        )));
    }
    measured.bristles(curve, law, log).map_err(refused)
}

fn refused(error: impl std::fmt::Display) -> Error {
    Error::Argument(error.to_string())
}

//! `robot-model identify`: parameters from measured logs.

use std::fmt::Write;
use std::path::PathBuf;

use clap::{Args, ValueEnum};
use robot_model::columns::Arm;
use robot_model::identify::{Errors, Estimate, Form, Identify, IdentifyError, Method};
use robot_model::log::Log;
use robot_model::signal::{Bands, SignalError};
use serde::Serialize;

use crate::Error;
use crate::interpreted::{InterpretedArm, InterpretedMomentum};
use crate::output::{self, Files};
use crate::progress::Progress;
use crate::spec::{compile, read_log};

/// Identify an arm's parameters from measured logs.
#[derive(Debug, Args)]
pub(crate) struct IdentifyArguments {
    /// The `.robot` file.
    spec: PathBuf,
    /// Logs to fit: CSV or gzip CSV, `time,q1..qn[,dq1..dqn],tau1..taun[,extra..]`, SI units.
    #[arg(required = true, value_name = "LOG")]
    logs: Vec<PathBuf>,
    /// A log that is not fitted, to judge the model on.
    #[arg(long, value_name = "LOG")]
    validate: Option<PathBuf>,
    /// How joints are weighed against each other.
    #[arg(long, value_enum, default_value_t)]
    method: MethodArgument,
    /// Which equations: `tau = Y_b(q, dq, ddq) beta`, or `L{tau} = Y_L(q, dq) beta` without accelerations.
    #[arg(long, value_enum, default_value_t)]
    form: FormArgument,
    /// Corner of the filter `L(s) = w / (s + w)` of the filtered form, rad/s; without it the end of the shared band.
    #[arg(long, value_name = "W", value_parser = parse_corner)]
    corner: Option<f64>,
    /// Cutoffs of the zero-phase filters, Hz: shared by torque and columns, of rigid-body kinematics, of effects'
    /// kinematics; without it they are chosen from the logs.
    #[arg(long, value_name = "SHARED,SMOOTH,WIDE", value_parser = parse_bands)]
    bands: Option<Bands>,
    /// Write the result as JSON.
    #[arg(long, value_name = "FILE")]
    json: Option<PathBuf>,
}

#[derive(Debug, Clone, Copy, Default, ValueEnum)]
enum MethodArgument {
    /// Ordinary least squares.
    Ls,
    /// Least squares weighted by each joint's residual.
    #[default]
    Wls,
    /// The same, in which samples far from the rest count less.
    Robust,
    /// Least squares weighted by each joint's residual, and of all estimates the nearest that an arm can have: masses spread over space, friction that takes energy.
    Physical,
}

impl From<MethodArgument> for Method {
    fn from(method: MethodArgument) -> Self {
        match method {
            MethodArgument::Ls => Self::Ls,
            MethodArgument::Wls => Self::Wls,
            MethodArgument::Robust => Self::Robust,
            MethodArgument::Physical => Self::Physical,
        }
    }
}

#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, ValueEnum)]
enum FormArgument {
    /// With accelerations; errors are of the raw torque.
    #[default]
    Acceleration,
    /// Without accelerations; errors are of the filtered torque.
    Filtered,
}

fn parse_corner(text: &str) -> Result<f64, String> {
    match text.trim().parse::<f64>() {
        Ok(corner) if corner > 0.0 && corner.is_finite() => Ok(corner),
        _ => Err("write a positive number in rad/s, such as `60`".to_owned()),
    }
}

fn parse_bands(text: &str) -> Result<Bands, String> {
    let numbers: Result<Vec<f64>, _> = text
        .split(',')
        .map(|part| part.trim().parse::<f64>())
        .collect();
    match numbers.as_deref() {
        Ok(&[shared_hz, smooth_hz, wide_hz]) => Ok(Bands {
            smooth_hz,
            wide_hz,
            shared_hz,
        }),
        _ => Err("write three numbers, such as `10,30,90`".to_owned()),
    }
}

/// What `--json` writes; a contract.
#[derive(Serialize)]
struct Report<'a> {
    method: &'static str,
    form: &'static str,
    /// Of the filtered form only, rad/s.
    corner: Option<f64>,
    parameters: Vec<Parameter<'a>>,
    /// Errors `rmse*`, first and last second cut: `raw` samples, or `filtered` torque `L{tau}`.
    domain: &'static str,
    rmse: &'a [f64],
    rmse_validate: Option<&'a [f64]>,
    relative_percent: &'a [f64],
    relative_percent_validate: Option<&'a [f64]>,
    condition: f64,
    rank: usize,
    unexcited: &'a [String],
    bands_hz: [f64; 3],
    /// Of `robust` only: samples per joint that are far from the others.
    outliers: Option<&'a [usize]>,
    /// Of `physical` only.
    possible: Option<PossibleReport<'a>>,
}

/// The possible arm, with its standard parameters.
#[derive(Serialize)]
struct PossibleReport<'a> {
    standard: Vec<Parameter<'a>>,
    /// `relative_percent` without the constraint.
    relative_percent_unconstrained: &'a [f64],
    /// Links and parameters on the border of what is possible.
    border: &'a [String],
    steps: usize,
    gap: f64,
}

#[derive(Serialize)]
struct Parameter<'a> {
    name: &'a str,
    /// None where the logs do not separate the parameter from others.
    value: Option<f64>,
    /// None for shape parameters too.
    std: Option<f64>,
}

impl IdentifyArguments {
    pub(crate) fn run(&self) -> Result<(), Error> {
        if self.corner.is_some() && self.form == FormArgument::Acceleration {
            let reason = "`--corner` is of the filtered form; add `--form filtered`";
            return Err(Error::Argument(reason.to_owned()));
        }
        let compiled = compile(&self.spec)?;
        for remark in compiled.base.remarks(&compiled.standard) {
            output::say(&format!("warning: {}: {remark}", compiled.model.source));
        }
        match self.form {
            FormArgument::Acceleration => self.fit(&ByAcceleration(InterpretedArm::new(compiled))),
            FormArgument::Filtered => {
                let arm = InterpretedMomentum::new(compiled)
                    .map_err(|refusal| Error::Argument(refusal.to_string()))?;
                let corner = self.corner;
                self.fit(&Filtered { arm, corner })
            }
        }
    }

    fn fit(&self, form: &dyn Fit) -> Result<(), Error> {
        let dof = form.dof();
        let inputs = std::iter::once(&self.spec)
            .chain(&self.logs)
            .chain(&self.validate);
        let json = Files::reading(inputs.map(PathBuf::as_path)).claim_if(self.json.as_deref())?;
        let progress = Progress::new();
        let logs = self
            .logs
            .iter()
            .map(|path| read_log(path, dof, &progress))
            .collect::<Result<Vec<_>, _>>()?;
        let validate = self
            .validate
            .as_deref()
            .map(|path| read_log(path, dof, &progress))
            .transpose()?;

        progress.step("identifying");
        let identify = Identify {
            method: self.method.into(),
            bands: self.bands,
        };
        let estimate = form
            .fit(&identify, &logs)
            .map_err(|error| self.refused(error))?;
        let train = errors_of_all(&estimate, form, &logs)?;
        let validation = validate
            .as_ref()
            .map(|log| form.errors(&estimate, log))
            .transpose()?;
        drop(progress);

        if let Some(file) = json {
            file.commit(output::json(&report(&estimate, &train, validation.as_ref())).as_bytes())?;
        }
        output::print(&format!(
            "{estimate}\n{}",
            table(&estimate, &train, validation.as_ref())
        ))
    }
}

impl IdentifyArguments {
    /// A corner that was asked for is named as it was.
    fn refused(&self, error: IdentifyError) -> Error {
        match (error, self.corner) {
            (IdentifyError::Signal(fault @ SignalError::Corner { .. }), Some(_)) => {
                Error::Argument(format!("--corner: {fault}"))
            }
            (error, _) => error.into(),
        }
    }
}

/// A way to identify and to judge what was identified.
trait Fit {
    fn dof(&self) -> usize;
    fn fit(&self, identify: &Identify, logs: &[Log]) -> Result<Estimate, IdentifyError>;
    fn errors(&self, estimate: &Estimate, log: &Log) -> Result<Errors, IdentifyError>;
}

struct ByAcceleration(InterpretedArm);

impl Fit for ByAcceleration {
    fn dof(&self) -> usize {
        self.0.dof()
    }

    fn fit(&self, identify: &Identify, logs: &[Log]) -> Result<Estimate, IdentifyError> {
        identify.fit(&self.0, logs)
    }

    fn errors(&self, estimate: &Estimate, log: &Log) -> Result<Errors, IdentifyError> {
        estimate.errors(&self.0, log)
    }
}

struct Filtered {
    arm: InterpretedMomentum,
    corner: Option<f64>,
}

impl Fit for Filtered {
    fn dof(&self) -> usize {
        self.arm.dof()
    }

    fn fit(&self, identify: &Identify, logs: &[Log]) -> Result<Estimate, IdentifyError> {
        identify.fit_filtered(&self.arm, logs, self.corner)
    }

    fn errors(&self, estimate: &Estimate, log: &Log) -> Result<Errors, IdentifyError> {
        estimate.filtered_errors(&self.arm, log)
    }
}

/// Errors over several logs: root mean squares over all their samples.
fn errors_of_all(estimate: &Estimate, form: &dyn Fit, logs: &[Log]) -> Result<Errors, Error> {
    let mut sum = vec![0.0; form.dof()];
    let mut samples = 0.0;
    for log in logs {
        let count = log.time.len() as f64;
        for (sum, rmse) in sum.iter_mut().zip(form.errors(estimate, log)?.rmse) {
            *sum += count * rmse * rmse;
        }
        samples += count;
    }
    let rmse = sum.into_iter().map(|sum| (sum / samples).sqrt()).collect();
    Ok(Errors {
        rmse,
        relative_percent: estimate.relative_percent.clone(),
    })
}

fn report<'a>(
    estimate: &'a Estimate,
    train: &'a Errors,
    validation: Option<&'a Errors>,
) -> Report<'a> {
    let linear = estimate.parameters.iter().map(|parameter| {
        let measured = !estimate.unexcited.contains(&parameter.name);
        Parameter {
            name: &parameter.name,
            value: measured.then_some(parameter.value),
            std: measured.then_some(parameter.std),
        }
    });
    let shapes = estimate.shapes.iter().map(known);
    let (domain, corner) = match estimate.form {
        Form::Acceleration => ("raw", None),
        Form::Filtered { corner } => ("filtered", Some(corner)),
    };
    Report {
        method: estimate.method.name(),
        form: estimate.form.name(),
        corner,
        parameters: linear.chain(shapes).collect(),
        domain,
        rmse: &train.rmse,
        rmse_validate: validation.map(|errors| errors.rmse.as_slice()),
        relative_percent: &train.relative_percent,
        relative_percent_validate: validation.map(|errors| errors.relative_percent.as_slice()),
        condition: estimate.condition,
        rank: estimate.rank,
        unexcited: &estimate.unexcited,
        bands_hz: [
            estimate.bands.shared_hz,
            estimate.bands.smooth_hz,
            estimate.bands.wide_hz,
        ],
        outliers: estimate.outliers.as_deref(),
        possible: estimate.possible.as_ref().map(|possible| PossibleReport {
            standard: possible.standard.iter().map(known).collect(),
            relative_percent_unconstrained: &possible.unconstrained_percent,
            border: &possible.border,
            steps: possible.steps,
            gap: possible.gap,
        }),
    }
}

/// A value without a deviation.
fn known((name, value): &(String, f64)) -> Parameter<'_> {
    Parameter {
        name,
        value: Some(*value),
        std: None,
    }
}

/// Errors per joint, side by side.
///
/// ```text
/// joint   identification          validation
///             RMSE    relative        RMSE    relative
/// ```
fn table(estimate: &Estimate, train: &Errors, validation: Option<&Errors>) -> String {
    let width = estimate
        .joints
        .iter()
        .map(String::len)
        .max()
        .unwrap_or(0)
        .max("joint".len());
    let logs: &[&str] = if validation.is_some() {
        &["identification", "validation"]
    } else {
        &["identification"]
    };
    let domain = match estimate.form {
        Form::Acceleration => output::ERRORS.to_owned(),
        Form::Filtered { corner } => output::filtered_errors(corner),
    };
    let mut text = format!("{domain}\n{:width$}", "joint");
    for name in logs {
        write!(text, "  {name:>22}").expect("a string takes all");
    }
    write!(text, "\n{:width$}", "").expect("a string takes all");
    for _ in logs {
        write!(text, "  {:>10}  {:>10}", "RMSE", "relative").expect("a string takes all");
    }
    text.push('\n');
    for (joint, name) in estimate.joints.iter().enumerate() {
        write!(text, "{name:width$}").expect("a string takes all");
        for errors in std::iter::once(train).chain(validation) {
            write!(
                text,
                "  {:>10.4}  {:>8.2} %",
                errors.rmse[joint], errors.relative_percent[joint]
            )
            .expect("a string takes all");
        }
        text.push('\n');
    }
    text
}

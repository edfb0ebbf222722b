//! What is written and printed of an estimate.

use std::fmt::Write;

use robot_model::identify::{Errors, Estimate, Form, Identified};
use robot_model::log::Fault;
use serde::Serialize;

use crate::output;

/// What `--json` writes; a contract.
#[derive(Serialize)]
pub(crate) struct Report<'a> {
    method: &'static str,
    form: &'static str,
    /// Of the filtered form only, rad/s.
    corner: Option<f64>,
    parameters: Vec<Parameter<'a>>,
    /// Errors `rmse*`, first and last second cut: `raw` samples, or `filtered` torque `L{tau}`.
    domain: &'static str,
    rmse: Option<&'a [f64]>,
    rmse_validate: Option<&'a [f64]>,
    /// RMS%, of filtered torque in any case.
    relative_percent: &'a [f64],
    relative_percent_validate: Option<&'a [f64]>,
    /// Mean absolute error and NRMSE fit, of the samples of `rmse*`.
    mae: Option<&'a [f64]>,
    mae_validate: Option<&'a [f64]>,
    nrmse_fit_percent: Option<Vec<Option<f64>>>,
    nrmse_fit_percent_validate: Option<Vec<Option<f64>>>,
    condition: f64,
    rank: usize,
    unexcited: &'a [String],
    bands_hz: [f64; 3],
    /// Of `robust` only: samples per joint that are far from the others.
    outliers: Option<&'a [usize]>,
    /// Of `physical` only.
    possible: Option<PossibleReport<'a>>,
    /// Of `iv` only.
    hausman: Option<HausmanReport<'a>>,
    /// Faults of the logs, which were mended where that can be.
    data_faults: Vec<FaultReport<'a>>,
}

/// What a sensor or a recorder did.
#[derive(Serialize)]
pub(super) struct FaultReport<'a> {
    log: &'a str,
    kind: &'static str,
    channel: &'a str,
    says: String,
}

/// Instrumental variables against least squares.
#[derive(Serialize)]
struct HausmanReport<'a> {
    /// Of a difference like the largest one, if least squares has no bias.
    probability: f64,
    least_squares: Vec<Parameter<'a>>,
    /// Differences over their deviations, in the order of `parameters`.
    differences: &'a [f64],
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
pub(super) struct Parameter<'a> {
    pub name: &'a str,
    /// None where the logs do not separate the parameter from others.
    pub value: Option<f64>,
    /// None for shape parameters of methods that do not tell, too.
    pub std: Option<f64>,
}

pub(crate) fn report<'a>(
    estimate: &'a Estimate,
    train: Option<&'a Errors>,
    validation: Option<&'a Errors>,
    faults: &'a [(String, Fault)],
) -> Report<'a> {
    let measured = |parameter: &Identified| !estimate.unexcited.contains(&parameter.name);
    let linear = estimate.parameters.iter().map(|parameter| Parameter {
        name: &parameter.name,
        value: measured(parameter).then_some(parameter.value),
        std: measured(parameter).then_some(parameter.std),
    });
    let shapes = estimate.shapes.iter().zip(&estimate.shape_std);
    let shapes = shapes.map(|(shape, std)| Parameter {
        std: *std,
        ..known(shape)
    });
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
        rmse: train.map(|errors| errors.rmse.as_slice()),
        rmse_validate: validation.map(|errors| errors.rmse.as_slice()),
        relative_percent: &estimate.relative_percent,
        relative_percent_validate: validation.map(|errors| errors.relative_percent.as_slice()),
        mae: train.map(|errors| errors.mae.as_slice()),
        mae_validate: validation.map(|errors| errors.mae.as_slice()),
        nrmse_fit_percent: train.map(Errors::nrmse_fit),
        nrmse_fit_percent_validate: validation.map(Errors::nrmse_fit),
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
        hausman: estimate.hausman.as_ref().map(|hausman| HausmanReport {
            probability: hausman.probability,
            least_squares: estimate
                .parameters
                .iter()
                .zip(&hausman.least_squares)
                .map(|(parameter, value)| Parameter {
                    name: &parameter.name,
                    value: measured(parameter).then_some(*value),
                    std: None,
                })
                .collect(),
            differences: &hausman.differences,
        }),
        data_faults: fault_reports(faults),
    }
}

/// Faults with the logs that they are of.
pub(super) fn fault_reports(faults: &[(String, Fault)]) -> Vec<FaultReport<'_>> {
    let told = faults.iter().map(|(log, fault)| FaultReport {
        log,
        kind: fault.kind(),
        channel: fault.channel(),
        says: fault.to_string(),
    });
    told.collect()
}

/// A value without a deviation.
fn known((name, value): &(String, f64)) -> Parameter<'_> {
    Parameter {
        name,
        value: Some(*value),
        std: None,
    }
}

/// Errors per joint, of several logs side by side.
///
/// ```text
/// joint   identification          validation
///             RMSE    relative        RMSE    relative
/// ```
pub(crate) fn table(estimate: &Estimate, columns: &[(&str, &Errors)]) -> String {
    let width = estimate
        .joints
        .iter()
        .map(String::len)
        .max()
        .unwrap_or(0)
        .max("joint".len());
    let domain = match estimate.form {
        Form::Acceleration => output::ERRORS.to_owned(),
        Form::Filtered { corner } => output::filtered_errors(corner),
    };
    let mut text = format!("{domain}\n{:width$}", "joint");
    for (name, _) in columns {
        write!(text, "  {name:>22}").expect("a string takes all");
    }
    write!(text, "\n{:width$}", "").expect("a string takes all");
    for _ in columns {
        write!(text, "  {:>10}  {:>10}", "RMSE", "relative").expect("a string takes all");
    }
    text.push('\n');
    for (joint, name) in estimate.joints.iter().enumerate() {
        write!(text, "{name:width$}").expect("a string takes all");
        for (_, errors) in columns {
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

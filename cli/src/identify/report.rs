//! What is written of an estimate.

use robot_model::identify::{
    Combination, Errors, Essential, Estimate, Form, Identified, Origin, Possible,
};
use robot_model::log::Fault;
use serde::Serialize;

use super::data_faults::{FaultReport, fault_reports};
use super::table::share;

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
    /// Null of a joint of which no sample counts, as all other errors are.
    rmse: Option<Vec<Option<f64>>>,
    rmse_validate: Option<Vec<Option<f64>>>,
    /// RMS%, of filtered torque in any case.
    relative_percent: Vec<Option<f64>>,
    relative_percent_validate: Option<Vec<Option<f64>>>,
    /// Mean absolute error and NRMSE fit, of the samples of `rmse*`.
    mae: Option<Vec<Option<f64>>>,
    mae_validate: Option<Vec<Option<f64>>>,
    nrmse_fit_percent: Option<Vec<Option<f64>>>,
    nrmse_fit_percent_validate: Option<Vec<Option<f64>>>,
    condition: f64,
    rank: usize,
    unexcited: &'a [String],
    /// What the logs tell of parameters that have no value of their own.
    combinations: Vec<CombinationReport<'a>>,
    /// Samples per joint where one with dry friction turns; empty where none were looked for.
    samples_at_turns: &'a [usize],
    /// Whether these are left out.
    turns_left_out: bool,
    /// Samples per joint that are left out because its torque stands at its limit; empty where none were looked for.
    samples_clipped: &'a [usize],
    samples_held: &'a [usize],
    /// Independent samples per joint; null where samples were not at hand.
    effective_samples: Option<&'a [f64]>,
    /// Blocks of the logs from which deviations are; of factors only.
    deviation_blocks: Option<usize>,
    bands_hz: [f64; 3],
    /// Of `robust` only: samples per joint that are far from the others.
    outliers: Option<&'a [usize]>,
    /// Of `physical` only.
    possible: Option<PossibleReport<'a>>,
    /// Of `iv` only.
    hausman: Option<HausmanReport<'a>>,
    /// Where they were asked for.
    bootstrap: Option<BootstrapReport>,
    essential: Option<EssentialReport<'a>>,
    /// Faults of the logs, which were mended where that can be.
    data_faults: Vec<FaultReport<'a>>,
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
    standard: Vec<StandardReport<'a>>,
    /// `relative_percent` without the constraint.
    relative_percent_unconstrained: Vec<Option<f64>>,
    /// Links and parameters on the border of what is possible.
    border: &'a [String],
    steps: usize,
    gap: f64,
    /// Parameters that CAD moves far away from where the logs have them.
    pulled: &'a [String],
}

#[derive(Serialize)]
struct StandardReport<'a> {
    name: &'a str,
    value: f64,
    /// Where the logs tell it.
    std: Option<f64>,
    /// `logs`, `spec` where it is fixed, `nominal` where the logs tell it in a sum at most, `assumed` where the spec has no nominal value then.
    from: &'static str,
}

/// A parameter as `--json` and the page of a report have it.
#[derive(Serialize)]
pub(crate) struct Parameter<'a> {
    pub name: &'a str,
    /// None where the logs do not separate the parameter from others.
    pub value: Option<f64>,
    /// None for shape parameters of methods that do not tell, and for what `physical` holds on the border, too.
    pub std: Option<f64>,
    /// With 95 % of the draws of a bootstrap, where there was one.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub interval: Option<[f64; 2]>,
}

/// What the logs tell of parameters that they do not tell apart.
#[derive(Serialize)]
pub(super) struct CombinationReport<'a> {
    terms: Vec<Term<'a>>,
    value: f64,
    std: f64,
}

#[derive(Serialize)]
struct Term<'a> {
    name: &'a str,
    factor: f64,
}

/// The parameters that are essential.
#[derive(Serialize)]
struct EssentialReport<'a> {
    parameters: Vec<Parameter<'a>>,
    combinations: Vec<CombinationReport<'a>>,
    relative_percent: Vec<Option<f64>>,
}

/// How often blocks were drawn, and of how many.
#[derive(Serialize)]
struct BootstrapReport {
    draws: usize,
    blocks: usize,
}

/// Errors of joints of which samples count.
pub(super) fn counted(errors: &Errors, values: &[f64]) -> Vec<Option<f64>> {
    let joints = values.iter().zip(&errors.samples);
    joints
        .map(|(value, samples)| (*samples > 0).then_some(*value))
        .collect()
}

/// Relative errors of joints that have rows.
pub(super) fn shares(percents: &[f64]) -> Vec<Option<f64>> {
    percents.iter().map(|percent| share(*percent)).collect()
}

pub(super) fn combination(found: &Combination) -> CombinationReport<'_> {
    let terms = found.terms.iter();
    CombinationReport {
        terms: terms
            .map(|(name, factor)| Term {
                name,
                factor: *factor,
            })
            .collect(),
        value: found.value,
        std: found.std,
    }
}

fn essential(found: &Essential) -> EssentialReport<'_> {
    let parameters = found.parameters.iter();
    EssentialReport {
        parameters: parameters
            .map(|parameter| Parameter {
                name: &parameter.name,
                value: Some(parameter.value),
                std: Some(parameter.std),
                interval: None,
            })
            .collect(),
        combinations: found.combinations.iter().map(combination).collect(),
        relative_percent: shares(&found.relative_percent),
    }
}

/// Parameters and open shapes of an estimate, as far as the logs tell them.
pub(crate) fn identified(estimate: &Estimate) -> Vec<Parameter<'_>> {
    let measured = |parameter: &Identified| estimate.is_separated(&parameter.name);
    let linear = estimate.parameters.iter().map(|parameter| Parameter {
        name: &parameter.name,
        value: measured(parameter).then_some(parameter.value),
        std: (measured(parameter) && !estimate.is_held(&parameter.name)).then_some(parameter.std),
        interval: None,
    });
    let interval = |k: usize| {
        let found = estimate.bootstrap.as_ref()?;
        found.intervals[k].filter(|_| measured(&estimate.parameters[k]))
    };
    let linear = linear.enumerate().map(|(k, parameter)| Parameter {
        interval: interval(k),
        ..parameter
    });
    let shapes = estimate.shapes.iter().zip(&estimate.shape_std);
    let shapes = shapes.map(|(shape, std)| Parameter {
        std: *std,
        ..known(shape)
    });
    linear.chain(shapes).collect()
}

pub(crate) fn report<'a>(
    estimate: &'a Estimate,
    train: Option<&'a Errors>,
    validation: Option<&'a Errors>,
    faults: &'a [(String, Fault)],
) -> Report<'a> {
    let measured = |parameter: &Identified| estimate.is_separated(&parameter.name);
    let (domain, corner) = match estimate.form {
        Form::Acceleration => ("raw", None),
        Form::Filtered { corner } => ("filtered", Some(corner)),
    };
    Report {
        method: estimate.method.name(),
        form: estimate.form.name(),
        corner,
        parameters: identified(estimate),
        domain,
        rmse: train.map(|errors| counted(errors, &errors.rmse)),
        rmse_validate: validation.map(|errors| counted(errors, &errors.rmse)),
        relative_percent: shares(&estimate.relative_percent),
        relative_percent_validate: validation.map(|errors| shares(&errors.relative_percent)),
        mae: train.map(|errors| counted(errors, &errors.mae)),
        mae_validate: validation.map(|errors| counted(errors, &errors.mae)),
        nrmse_fit_percent: train.map(Errors::nrmse_fit),
        nrmse_fit_percent_validate: validation.map(Errors::nrmse_fit),
        condition: estimate.condition,
        rank: estimate.rank,
        unexcited: &estimate.unexcited,
        combinations: estimate.combinations.iter().map(combination).collect(),
        samples_at_turns: &estimate.turns,
        turns_left_out: estimate.is_without_turns,
        samples_clipped: &estimate.clipped,
        samples_held: &estimate.held,
        effective_samples: estimate.effective_samples.as_deref(),
        deviation_blocks: estimate.blocks,
        bands_hz: [
            estimate.bands.shared_hz,
            estimate.bands.smooth_hz,
            estimate.bands.wide_hz,
        ],
        outliers: estimate.outliers.as_deref(),
        possible: estimate.possible.as_ref().map(|possible| PossibleReport {
            standard: standard(estimate, possible),
            relative_percent_unconstrained: shares(&possible.unconstrained_percent),
            border: &possible.border,
            steps: possible.steps,
            gap: possible.gap,
            pulled: &possible.pulled,
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
                    interval: None,
                })
                .collect(),
            differences: &hausman.differences,
        }),
        bootstrap: estimate.bootstrap.as_ref().map(|found| BootstrapReport {
            draws: found.draws,
            blocks: found.blocks,
        }),
        essential: estimate.essential.as_ref().map(essential),
        data_faults: fault_reports(faults),
    }
}

fn standard<'a>(estimate: &Estimate, possible: &'a Possible) -> Vec<StandardReport<'a>> {
    let std = |name: &String| {
        let found = estimate.parameters.iter().find(|p| p.name == *name)?;
        (!estimate.is_held(name)).then_some(found.std)
    };
    let values = possible.standard.iter().zip(&possible.origins);
    let told = values.map(|((name, value), origin)| StandardReport {
        name,
        value: *value,
        std: (*origin == Origin::Logs).then(|| std(name)).flatten(),
        from: origin.name(),
    });
    told.collect()
}

/// A value without a deviation.
fn known((name, value): &(String, f64)) -> Parameter<'_> {
    Parameter {
        name,
        value: Some(*value),
        std: None,
        interval: None,
    }
}

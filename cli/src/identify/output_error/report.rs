//! What is written and printed of an output-error estimate.

use std::fmt::Write;

use robot_model::identify::output_error::{Comparison, Distance, Ending, Hold, OutputEstimate};
use robot_model::identify::{relative_deviation, table_value};
use robot_model::log::Fault;
use robot_model_codegen::Compiled;
use serde::Serialize;

use super::super::data_faults::{FaultReport, fault_reports};
use super::super::report::{CombinationReport, Parameter, combination, counted, shares};
use super::constants::{ConstantsReport, Told};
use super::directions::{DirectionReport, RatioReport, direction, hanging, ratio};
use super::{Judged, listed};

/// Longest part of a line for values of parameters.
const VALUES_WIDTH: usize = 160;

/// All that there is to say.
pub(super) struct OutputReport<'a> {
    pub compiled: &'a Compiled,
    pub names: &'a [String],
    pub found: &'a OutputEstimate,
    pub train: &'a Judged,
    pub validation: Option<&'a Judged>,
    /// Of windows, s.
    pub window: Option<f64>,
    pub faults: &'a [(String, Fault)],
    /// Of a robot that says its energies, where its constants are more than what logs tell.
    pub constants: Option<Told>,
}

/// What `--json` writes; the first keys are those of other methods.
#[derive(Serialize)]
pub(super) struct JsonReport<'a> {
    method: &'static str,
    form: &'static str,
    parameters: Vec<Parameter<'a>>,
    /// Of torques from equations with these parameters, as other methods have it; null where least squares has no filters for them.
    rmse: Option<Vec<Option<f64>>>,
    rmse_validate: Option<Vec<Option<f64>>>,
    relative_percent: Option<Vec<Option<f64>>>,
    relative_percent_validate: Option<Vec<Option<f64>>>,
    condition: Option<f64>,
    rank: usize,
    unexcited: Vec<&'a str>,
    /// Of simulated positions.
    position: Distances,
    position_validate: Option<Distances>,
    /// Of simulated torques, where a controller made them.
    torque: Option<Distances>,
    torque_validate: Option<Distances>,
    /// Seconds of windows; null where logs were simulated whole.
    window: Option<f64>,
    /// How logged torque goes between samples; null where a controller makes it.
    hold: Option<&'static str>,
    is_converged: bool,
    /// Parameters that a bound holds.
    at_bounds: Vec<&'a str>,
    singular_values: &'a [f64],
    /// Directions of the parameters that the logs say little or nothing of.
    directions: Vec<DirectionReport<'a>>,
    /// What the logs tell of parameters but for a common factor.
    ratios: Vec<RatioReport<'a>>,
    /// Sums of others that they do not tell apart.
    combinations: Vec<CombinationReport<'a>>,
    /// Of constants of energies that are more than the sums of their products; null where they are not.
    constants: Option<ConstantsReport<'a>>,
    /// What hangs on all that the model lacks: shares of values; null where nothing does by much.
    frail: Option<DirectionReport<'a>>,
    iterates: Vec<IterateReport<'a>>,
    data_faults: Vec<FaultReport<'a>>,
}

/// Per joint.
#[derive(Serialize)]
struct Distances {
    rmse: Vec<f64>,
    mae: Vec<f64>,
    relative_percent: Vec<Option<f64>>,
    nrmse_fit_percent: Vec<Option<f64>>,
}

#[derive(Serialize)]
struct IterateReport<'a> {
    stage: usize,
    cost: f64,
    simulations: usize,
    values: &'a [f64],
}

impl Distances {
    fn new(of: &[Distance]) -> Self {
        Self {
            rmse: of.iter().map(|x| x.rmse).collect(),
            mae: of.iter().map(|x| x.mae).collect(),
            relative_percent: of.iter().map(|x| x.relative_percent).collect(),
            nrmse_fit_percent: of.iter().map(|x| x.nrmse_fit_percent).collect(),
        }
    }
}

impl OutputReport<'_> {
    /// Over the weakest; none where a direction is silent.
    fn condition(&self) -> Option<f64> {
        let weakest = self.found.identifiability.singular.last()?;
        let free = self.names.len() - self.found.bound.len();
        (self.found.identifiability.rank == free).then(|| 1.0 / weakest)
    }

    /// Whether a parameter has a value of its own: the logs tell it, or a bound does.
    fn has_value(&self, parameter: usize) -> bool {
        let bound = &self.found.bound;
        match bound.binary_search(&parameter) {
            Ok(_) => true,
            Err(before) => self.found.identifiability.is_identified(parameter - before),
        }
    }

    fn unidentified(&self) -> impl Iterator<Item = &String> {
        let names = self.names.iter().enumerate();
        names.filter_map(|(k, name)| (!self.has_value(k)).then_some(name))
    }

    fn on_bounds(&self) -> impl Iterator<Item = &String> {
        self.found.bound.iter().map(|&k| &self.names[k])
    }

    pub fn parameters(&self) -> Vec<Parameter<'_>> {
        let found = self.found;
        let values = self.names.iter().zip(found.values.iter().zip(&found.std));
        let told = values
            .enumerate()
            .map(|(k, (name, (value, std)))| Parameter {
                name,
                value: self.has_value(k).then_some(*value),
                std: *std,
                interval: None,
            });
        told.collect()
    }

    pub fn json(&self) -> JsonReport<'_> {
        let found = self.found;
        let told = |judged: Option<&Judged>| {
            judged.and_then(|judged| judged.comparison.torque.as_deref().map(Distances::new))
        };
        let torque = self.train.torque.as_ref();
        let torque_validate = self.validation.and_then(|judged| judged.torque.as_ref());
        JsonReport {
            method: "output-error",
            form: "simulation",
            parameters: self.parameters(),
            rmse: torque.map(|errors| counted(errors, &errors.rmse)),
            rmse_validate: torque_validate.map(|errors| counted(errors, &errors.rmse)),
            relative_percent: torque.map(|errors| shares(&errors.relative_percent)),
            relative_percent_validate: torque_validate
                .map(|errors| shares(&errors.relative_percent)),
            condition: self.condition(),
            rank: found.identifiability.rank,
            unexcited: self.unidentified().map(String::as_str).collect(),
            position: Distances::new(&found.fit.position),
            position_validate: self
                .validation
                .map(|judged| Distances::new(&judged.comparison.position)),
            torque: told(Some(self.train)),
            torque_validate: told(self.validation),
            window: self.window,
            hold: found.hold.map(|hold| match hold {
                Hold::Sample => "sample",
                Hold::Mean => "mean",
            }),
            is_converged: found.ending == Ending::Converged,
            at_bounds: self.on_bounds().map(String::as_str).collect(),
            singular_values: &found.identifiability.singular,
            directions: found
                .identifiability
                .directions
                .iter()
                .map(direction)
                .collect(),
            ratios: found.ratios.iter().map(ratio).collect(),
            combinations: found.combinations.iter().map(combination).collect(),
            iterates: found
                .iterates
                .iter()
                .map(|iterate| IterateReport {
                    stage: iterate.stage,
                    cost: iterate.cost,
                    simulations: iterate.simulations,
                    values: &iterate.values,
                })
                .collect(),
            constants: self.constants.as_ref().and_then(Told::report),
            frail: found.frail.as_ref().map(direction),
            data_faults: fault_reports(self.faults),
        }
    }

    /// The tables that a paper would print.
    pub fn text(&self) -> String {
        let mut text = String::new();
        self.tell(&mut text).expect("a string takes all");
        text
    }

    fn tell(&self, text: &mut String) -> std::fmt::Result {
        let found = self.found;
        let width = self.names.iter().map(String::len).max().unwrap_or(0).max(9);
        let base = self.compiled.base.kept.len();
        writeln!(
            text,
            "{:width$}  {:>12}  {:>10}  {:>7}",
            "parameter", "value", "std", "std %"
        )?;
        let values = self.names.iter().zip(found.values.iter().zip(&found.std));
        for (k, (name, (value, std))) in values.enumerate() {
            let shape = if k < base { "" } else { "  (shape)" };
            let said = table_value(*value);
            match std {
                None if self.has_value(k) => writeln!(text, "{name:width$}  {said:>12}{shape}")?,
                Some(std) => {
                    let relative = relative_deviation(*value, *std);
                    writeln!(
                        text,
                        "{name:width$}  {said:>12}  {std:>10.2e}  {relative:>7}{shape}"
                    )?;
                }
                None => writeln!(text, "{name:width$}  {:>12}{shape}", "not separable")?,
            }
        }
        let condition = self.condition();
        let condition = condition.map_or("infinite".to_owned(), |x| format!("{x:.1}"));
        writeln!(
            text,
            "rank {} of {}, condition {condition}, {} samples a joint, output-error",
            found.identifiability.rank,
            self.names.len() - found.bound.len(),
            found.samples
        )?;
        if let Some(constants) = &self.constants {
            write!(text, "{constants}")?;
        }
        if found.ending == Ending::OutOfIterations {
            writeln!(
                text,
                "the search ran out of iterations before it converged; start nearer, with `--start`{}",
                self.window.map_or("", |_| ", or with longer windows")
            )?;
            let unsure = found.unsure.iter().map(|(name, share)| match share {
                share if *share < 10.0 => format!("{name} (+- {:.0} %)", 100.0 * share),
                _ => name.clone(),
            });
            let unsure: Vec<String> = unsure.collect();
            if !unsure.is_empty() {
                writeln!(
                    text,
                    "hardly identified, value where the search stopped: {}",
                    unsure.join(", ")
                )?;
            }
        }
        let bound: Vec<String> = self.on_bounds().cloned().collect();
        if !bound.is_empty() {
            writeln!(text, "held by a bound, not by the logs: {}", listed(&bound))?;
        }
        for direction in &found.identifiability.directions {
            writeln!(text, "{direction}")?;
        }
        for ratio in &found.ratios {
            let (name, over, value) = (&ratio.name, &ratio.reference, table_value(ratio.value));
            let std = ratio
                .std
                .map_or(String::new(), |std| format!(" +- {std:.2e}"));
            writeln!(text, "  {name} / {over} = {value}{std}")?;
        }
        for sum in &found.combinations {
            let (value, std) = (table_value(sum.value), sum.std);
            writeln!(text, "  {sum} = {value} +- {std:.2e}")?;
        }
        if let Some(frail) = &found.frail {
            writeln!(text, "{}", hanging(frail))?;
        }
        let silent: Vec<String> = self.unidentified().cloned().collect();
        if !silent.is_empty() {
            writeln!(
                text,
                "not separable: {}: only the combinations in the lines above are known",
                listed(&silent)
            )?;
        }
        self.tell_iterates(text)?;
        self.distances(text)
    }

    /// The way of the search: costs, and values where a line holds them.
    fn tell_iterates(&self, text: &mut String) -> std::fmt::Result {
        let iterates = &self.found.iterates;
        let widths = self.names.iter().map(|name| name.len().max(12));
        let widths: Vec<usize> = widths.collect();
        let has_values = widths.iter().map(|width| width + 2).sum::<usize>() <= VALUES_WIDTH;
        write!(text, "\niteration  part  simulations          cost")?;
        let columns = self.names.iter().zip(&widths).filter(|_| has_values);
        for (name, width) in columns {
            write!(text, "  {name:>width$}")?;
        }
        for (k, iterate) in iterates.iter().enumerate() {
            write!(
                text,
                "\n{k:>9}  {:>4}  {:>11}  {:>12.6e}",
                iterate.stage + 1,
                iterate.simulations,
                iterate.cost
            )?;
            let values = iterate.values.iter().zip(&widths).filter(|_| has_values);
            for (value, width) in values {
                write!(text, "  {:>width$}", table_value(*value))?;
            }
        }
        writeln!(text)
    }

    fn distances(&self, text: &mut String) -> std::fmt::Result {
        let joints = &self.compiled.model.joints;
        let width = joints.iter().map(|joint| joint.name.len()).max();
        let width = width.unwrap_or(0).max("joint".len());
        let windows = match self.window {
            Some(seconds) => format!("windows of {seconds} s, the start of each fitted"),
            None => "whole logs, their starts fitted".to_owned(),
        };
        let hold = match self.found.hold {
            Some(Hold::Sample) => ", torque held from each sample to the next",
            _ => "",
        };
        writeln!(
            text,
            "\nSimulated against logged, {windows}{hold}; rad or m, N m or N"
        )?;
        let columns = std::iter::once(("identification", self.train));
        let columns = columns.chain(self.validation.map(|judged| ("validation", judged)));
        for (name, judged) in columns {
            let Comparison {
                position, torque, ..
            } = &judged.comparison;
            let torque = torque.as_deref().map(|torque| ("torque", torque));
            let channels = std::iter::once(("position", position.as_slice())).chain(torque);
            for (channel, distances) in channels {
                writeln!(
                    text,
                    "{:width$}  {:>10}  {:>10}  {:>10}  {:>10}   {channel}, {name}",
                    "joint", "RMSE", "MAE", "relative", "NRMSE fit"
                )?;
                for (joint, distance) in joints.iter().zip(distances) {
                    let fit = distance.nrmse_fit_percent;
                    let fit = fit.map_or("-".to_owned(), |fit| format!("{fit:.2} %"));
                    let share = distance.relative_percent;
                    let share = share.map_or("-".to_owned(), |share| format!("{share:.4} %"));
                    writeln!(
                        text,
                        "{:width$}  {:>10.3e}  {:>10.3e}  {share:>10}  {fit:>10}",
                        joint.name, distance.rmse, distance.mae
                    )?;
                }
            }
        }
        Ok(())
    }
}

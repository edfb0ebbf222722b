//! `robot-model identify --method output-error`: the arm that moves as the measured one did.

mod beginning;
mod bounds;
mod constants;
mod directions;
mod hold;
mod law;
mod lumped;
mod options;
mod recordings;
mod report;
mod starts;

use std::path::PathBuf;

use robot_model::identify::output_error::{
    Comparison, Hold, OutputError, OutputErrorError, OutputEstimate, Search,
};
use robot_model::identify::{Errors, Estimate, Identify};
use robot_model::log::{Fault, Log};
use robot_model_codegen::Compiled;
use robot_model_codegen::expr::Symbol;

use super::fit::{ByAcceleration, Fit, errors_of_all};
use super::page::{Evidence, OnLog};
use super::results::Results;
use super::{IdentifyArguments, doubts, readings, twice};
use crate::Error;
use crate::interpreted::InterpretedArm;
use crate::output::{Files, WARNING, names};
use crate::progress::Progress;
use beginning::{Beginning, Parted};
use bounds::{Said, bounds};
use constants::Told;
pub(super) use options::Options;
use options::{HoldArgument, SearchArgument};
use recordings::recordings;
use report::OutputReport;

/// What is said of one log after the other.
struct Judged {
    comparison: Comparison,
    /// Errors of the torque from equations.
    torque: Option<Errors>,
}

impl IdentifyArguments {
    /// Output error on all logs.
    pub(super) fn by_simulation(&self, compiled: Compiled) -> Result<(), Error> {
        let options = &self.output_error;
        let results = Results::claim(&mut self.files_of_simulation(), self)?;
        let whole = compiled;
        let compiled = parted(&whole);
        let progress = Progress::new();
        let form = ByAcceleration(InterpretedArm::new(compiled.clone()));
        let mut faults: Vec<(String, Fault)> = Vec::new();
        let mut read = |path: &PathBuf| self.log(path, &form, &mut faults, &progress);
        let logs: Vec<Log> = self.logs.iter().map(&mut read).collect::<Result<_, _>>()?;
        let validate = self.validate.as_ref().map(&mut read).transpose()?;
        let start = options.start.as_deref();
        let arm = Parted {
            whole: &whole,
            parted: &compiled,
        };
        let beginning = Beginning::of(arm, &form, &logs, self.bands, start)?;
        self.ask_equations(&form, &logs, &beginning, &mut faults, &progress);
        let mut settings = self.settings(&compiled, &beginning)?;
        let ranges = self.ranges(&beginning);
        progress.notes(bounds::doubt(&compiled, &beginning.names, ranges)?);
        let recordings = |logs: &[Log]| recordings(&compiled, &beginning.shapes, logs);
        let fitted = recordings(&logs)?;
        let starts = match start {
            Some(_) => beginning.starts.clone(),
            None => starts::within(&beginning.starts, &settings.bounds),
        };
        progress.step("simulating");
        let is_there = |found: &OutputEstimate| {
            doubts::beyond_noise(&compiled.model, &logs, &rmse(found)).is_none()
        };
        let other = self.output_error.search.is_none();
        let other = other.then_some(Search::TrustRegion);
        let found = starts::search(
            &settings, &beginning, &starts, &fitted, other, &is_there, &progress,
        );
        let found = found.map_err(|error| beginning.refused(&compiled, &error))?;
        settings.hold = found.hold;
        let asked = std::mem::replace(&mut settings.window, found.window);
        let held = if self.output_error.hold.is_some() && !is_there(&found) {
            hold::asked(&settings, &beginning, &fitted, &found, &progress)
        } else {
            None
        };
        let said = beginning.doubts(&form, &logs, &found).into_iter();
        let said = said
            .chain(held)
            .chain(shorter_windows(asked, found.window))
            .chain(hold::doubt(&beginning.names, &found))
            .chain(mended_torques(&settings, &faults))
            .chain(twice::doubts(&self.logs, self.validate.as_deref()));
        progress.doubts(said);
        let linear = beginning.linear.as_ref();
        let linear = linear.map(|linear| of_simulation(&compiled, linear, &found));
        let errors = |logs: &[Log]| -> Result<Option<Errors>, Error> {
            let errors = linear
                .as_ref()
                .map(|linear| errors_of_all(linear, &form, logs));
            Ok(errors.transpose()?)
        };
        let train = Judged {
            comparison: found.fit.clone(),
            torque: errors(&logs)?,
        };
        let judge = |log: &Log| -> Result<Judged, Error> {
            let log = std::slice::from_ref(log);
            let comparison = settings.compare(&beginning.plant, &found.values, &recordings(log)?);
            Ok(Judged {
                comparison: comparison.map_err(|error| refused(&error))?,
                torque: errors(log)?,
            })
        };
        // What was found is not lost with a log on which the arm runs away.
        let judged = validate.as_ref().map(judge);
        if let Some(Err(error)) = &judged {
            progress.note(&format!("note: not validated: {error}"));
        }
        let validation = judged.and_then(Result::ok);
        let report = OutputReport {
            compiled: &compiled,
            names: &beginning.names,
            found: &found,
            train: &train,
            validation: validation.as_ref(),
            window: settings.window,
            faults: &faults,
            constants: Told::new(&compiled, &found),
        };
        let printed = report.text();
        let drawn = |linear| OnLog::of(form.arm(), linear, &logs, validate.as_ref());
        let evidence = Evidence {
            spec: &self.spec,
            compiled: &compiled,
            parameters: report.parameters(),
            combinations: &found.combinations,
            errors: torques(&train, validation.as_ref()),
            drawn: linear.as_ref().and_then(drawn),
            notes: progress.noted(),
            faults: &faults,
            printed: &printed,
        };
        results.give(&report.json(), &evidence, progress)
    }

    fn files_of_simulation(&self) -> Files {
        let inputs = std::iter::once(&self.spec)
            .chain(&self.logs)
            .chain(&self.validate)
            .chain(self.output_error.files());
        Files::reading(inputs.map(PathBuf::as_path)).and(self.settings_files())
    }

    /// What least squares says of the columns of logs, before they are simulated.
    fn ask_equations(
        &self,
        form: &ByAcceleration,
        logs: &[Log],
        beginning: &Beginning,
        faults: &mut Vec<(String, Fault)>,
        progress: &Progress,
    ) {
        let Some(linear) = &beginning.linear else {
            return;
        };
        let identify = Identify {
            bands: self.bands,
            ..Identify::default()
        };
        match readings::others(form, &identify, logs, linear) {
            Some(doubt) => progress.note(&format!("{WARNING}{doubt}")),
            None => faults.extend(self.late_channels(linear, progress)),
        }
    }

    /// What is said of the ranges of parameters.
    fn ranges<'a>(&'a self, beginning: &'a Beginning) -> Said<'a> {
        let options = &self.output_error;
        Said {
            start: &beginning.starts[0],
            is_given: options.start.is_some(),
            within: options.within,
            file: options.bounds.as_deref(),
        }
    }

    fn settings(&self, compiled: &Compiled, beginning: &Beginning) -> Result<OutputError, Error> {
        let options = &self.output_error;
        let delay = compiled.delay();
        let reads = delay
            .iter()
            .flat_map(robot_model_codegen::interpreter::Program::symbols);
        let free = compiled.free_shapes();
        let open = reads.filter_map(|symbol| match symbol {
            Symbol::Shape(k) if free.contains(k) => Some(compiled.shape_names()[*k].clone()),
            _ => None,
        });
        if let Some(name) = open.into_iter().next() {
            return Err(Error::Argument(format!(
                "{}: `{name}` delays the torque that drives the arm, which output-error does not identify; set it to the value that \
                 `--method wls` finds",
                compiled.model.source
            )));
        }
        let law = options.controller.as_deref();
        let law = law.map(|path| law::read(path, &compiled.model.joints));
        let is_open = law.is_none() && compiled.dynamics.state_rates.is_empty();
        Ok(OutputError {
            search: match options.search {
                None | Some(SearchArgument::LevenbergMarquardt) => Search::LevenbergMarquardt,
                Some(SearchArgument::TrustRegion) => Search::TrustRegion,
            },
            hold: options.hold.map(|hold| match hold {
                HoldArgument::Mean => Hold::Mean,
                HoldArgument::Sample => Hold::Sample,
            }),
            window: options.window.or(is_open.then_some(1.0)),
            held_starts: None,
            iterations: None,
            below: None,
            law: law.transpose()?,
            bounds: bounds(compiled, &beginning.names, self.ranges(beginning))?,
        })
    }
}

/// With parameters of motors and of links that move apart each on its own.
fn parted(compiled: &Compiled) -> Compiled {
    if compiled.displacements().is_some() && !compiled.mixed().is_empty() {
        compiled.ungrouped()
    } else {
        compiled.clone()
    }
}

/// Says so where windows became shorter.
fn shorter_windows(asked: Option<f64>, taken: Option<f64>) -> Option<String> {
    let (asked, taken) = asked.zip(taken)?;
    (taken < asked).then(|| {
        format!(
            "the simulated arm diverges from its logs in windows of {asked} s, so windows of {taken} s are used, which show little of slow motion"
        )
    })
}

/// Errors of torques from equations, as far as there are some.
fn torques<'a>(
    train: &'a Judged,
    validation: Option<&'a Judged>,
) -> Vec<(&'static str, &'a Errors)> {
    let judged = std::iter::once(("fitted", train));
    let judged = judged.chain(validation.map(|judged| ("validation", judged)));
    let torques = judged.filter_map(|(of, judged)| Some((of, judged.torque.as_ref()?)));
    torques.collect()
}

/// Says so where torques that drive the simulation were replaced.
fn mended_torques(settings: &OutputError, faults: &[(String, Fault)]) -> Option<String> {
    let is_mended = |fault: &Fault| match fault {
        Fault::Spikes { channel, .. }
        | Fault::Held { channel, .. }
        | Fault::Dropouts { channel, .. }
        | Fault::Bursts { channel, .. } => channel.starts_with("tau"),
        _ => false,
    };
    let is_told = settings.law.is_none() && faults.iter().any(|(_, fault)| is_mended(fault));
    is_told.then(|| {
        "torques drive the simulation, and some were replaced as faults of the log; if the drive did produce them, keep them with `--as-logged`"
            .to_owned()
    })
}

/// Root mean square of the errors of each joint's position.
fn rmse(found: &OutputEstimate) -> Vec<f64> {
    let joints = found.fit.position.iter();
    joints.map(|distance| distance.rmse).collect()
}

fn refused(error: &OutputErrorError) -> Error {
    Error::Argument(error.to_string())
}

/// What least squares knows of filters, with the parameters of the simulation.
fn of_simulation(compiled: &Compiled, linear: &Estimate, found: &OutputEstimate) -> Estimate {
    let mut estimate = linear.clone();
    let base = compiled.base.kept.len();
    for (parameter, value) in estimate.parameters.iter_mut().zip(&found.values) {
        parameter.value = *value;
    }
    for ((_, shape), value) in estimate.shapes.iter_mut().zip(&found.values[base..]) {
        *shape = *value;
    }
    estimate.unexcited.clear();
    estimate
}

/// Names of parameters, in a row.
fn listed(values: &[String]) -> String {
    names(&values.iter().map(String::as_str).collect::<Vec<_>>())
}

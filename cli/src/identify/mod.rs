//! `robot-model identify`: parameters from measured logs.

pub(crate) mod at_turns;
mod brief;
mod coarse;
pub(crate) mod data_faults;
pub(crate) mod doubts;
mod drive_gains;
pub(crate) mod factor_file;
pub(crate) mod far;
pub(crate) mod fit;
mod fixed;
pub(crate) mod hidden_delay;
mod large;
mod leftover;
mod likeness;
mod next;
mod nominal;
pub(crate) mod noted;
mod one_sine;
pub(crate) mod options;
mod other_friction;
mod output_error;
mod page;
mod payload;
pub(crate) mod readings;
mod reduced;
pub(crate) mod report;
mod results;
mod steps;
pub(crate) mod table;
pub(crate) mod twice;
mod unequal;
mod untold;

use std::path::{Path, PathBuf};

use clap::Args;
use robot_model::identify::{Bootstrap, Errors, Estimate, Identify, IdentifyError, Method};
use robot_model::log::{Fault, Log};
use robot_model::signal::{Bands, SignalError};

use crate::Error;
use crate::in_order::workers;
use crate::interpreted::InterpretedArm;
use crate::log_settings::LogSettings;
use crate::output::{self, Content, Files, Record};
use crate::progress::Progress;
use crate::simulate::table::trajectory;
use crate::spec::{compile, read_log, read_mended};
use fit::{ByAcceleration, Filtered, Fit, errors_of_each};
use noted::{factor_doubts, mixed, told_apart, too_slow};
use options::{FormArgument, MethodArgument, RowOptions, WeightsArgument};
use options::{parse_bands, parse_center, parse_corner, parse_mass};
use page::{Evidence, OnLog};
use reduced::Streams;
use report::report;
use results::Results;
use table::table;

/// Identify an arm's parameters from measured logs.
#[derive(Debug, Args)]
#[command(after_help = "Examples:
  robot-model identify arm.robot monday.csv --validate tuesday.csv --json fit.json --report page
  robot-model identify arm.robot monday.csv --method physical
  robot-model identify arm.robot logs/monday.csv --log-settings drive.toml
  robot-model identify arm.robot empty.csv --payload loaded.csv --payload-mass 2.5
  robot-model identify arm.robot week.parquet --factor week.json")]
pub(crate) struct IdentifyArguments {
    /// The `.robot` file.
    spec: PathBuf,
    /// Logs to fit: CSV (plain or gzip) or Parquet, `time,q1..qn[,dq1..dqn],tau1..taun[,extra..]`, SI units, or as the spec's `log` or a `robot-model.toml` has them;
    /// or MCAP, a bag of ROS 2 with joint states.
    #[arg(required = true, value_name = "LOG")]
    logs: Vec<PathBuf>,
    /// Validation log: not fitted, errors are computed on it.
    #[arg(long, value_name = "LOG")]
    validate: Option<PathBuf>,
    /// Estimation method.
    #[arg(long, value_enum, default_value_t)]
    method: MethodArgument,
    /// Divisor of each joint's rows; for `wls`, `robust`, `tls`, `iv`.
    #[arg(long, value_enum, default_value_t)]
    weights: WeightsArgument,
    /// For `ridge`: standard deviation of the spec's nominal values, as a share of each body's size; default 0.3.
    #[arg(long, value_name = "SHARE", allow_hyphen_values = true)]
    prior: Option<f64>,
    /// For `iv`: a noise-free motion for each log, in their order, `time,q1..qn`: the commanded one, or that of `simulate`.
    #[arg(long, value_name = "MOTION", num_args = 1..)]
    instruments: Vec<PathBuf>,
    /// Equations: `tau = Y_b(q, dq, ddq) beta`, or `L{tau} = Y_L(q, dq) beta` without accelerations.
    #[arg(long, value_enum, default_value_t)]
    form: FormArgument,
    /// Corner of the filter `L(s) = w / (s + w)` of the filtered form, rad/s; default: the end of the shared band.
    #[arg(long, value_name = "W", allow_hyphen_values = true, value_parser = parse_corner)]
    corner: Option<f64>,
    /// Cutoffs of the zero-phase filters, Hz: of torque and columns, of rigid-body kinematics, of effects' kinematics; default: chosen from the logs.
    #[arg(long, value_name = "SHARED,SMOOTH,WIDE", allow_hyphen_values = true, value_parser = parse_bands)]
    bands: Option<Bands>,
    /// Logs of the arm with a payload; the payload is identified from all logs together.
    #[arg(long, value_name = "LOG", num_args = 1..)]
    payload: Vec<PathBuf>,
    /// The link that carries the payload; default: the last one.
    #[arg(long, value_name = "LINK", requires = "payload")]
    payload_link: Option<String>,
    /// The payload's weighed mass, kg: identifies the gains of the drives.
    #[arg(long, value_name = "KG", requires = "payload", allow_hyphen_values = true, value_parser = parse_mass)]
    payload_mass: Option<f64>,
    /// Its center of mass in the link's frame, m, if known.
    #[arg(long, value_name = "X,Y,Z", requires = "payload_mass", allow_hyphen_values = true, value_parser = parse_center)]
    payload_center: Option<[f64; 3]>,
    /// If the logs do not separate all parameters, identify the sums that they do determine.
    #[arg(long)]
    partial: bool,
    /// Bootstrap confidence intervals from this many draws of blocks, 100 or more; for `ls`, `wls`, `robust`.
    #[arg(long, value_name = "DRAWS", allow_negative_numbers = true, value_parser = clap::value_parser!(u32).range(i64::from(Bootstrap::LEAST_DRAWS)..=100_000))]
    bootstrap: Option<u32>,
    /// Find the parameters that differ significantly from zero, and also identify these alone; for `ls`, `wls`, `robust`.
    #[arg(long)]
    essential: bool,
    #[command(flatten)]
    rows: RowOptions,
    #[command(flatten)]
    log_settings: LogSettings,
    /// Write the information of the logs for `merge`, and read them piece by piece, so memory does not grow.
    #[arg(long, value_name = "FILE")]
    factor: Option<PathBuf>,
    /// Write the result as JSON.
    #[arg(long, value_name = "FILE")]
    json: Option<PathBuf>,
    /// Write the result as a page with figures, `index.html` in this folder.
    #[arg(long, value_name = "DIR")]
    report: Option<PathBuf>,
    #[command(flatten)]
    output_error: output_error::Options,
}

/// What a method with equations found.
struct OfEquations<'a> {
    estimate: &'a Estimate,
    train: &'a Errors,
    validation: Option<&'a Errors>,
    faults: &'a [(String, Fault)],
    drawn: Option<OnLog<'a>>,
}

impl IdentifyArguments {
    pub(crate) fn run(&self) -> Result<(), Error> {
        if self.corner.is_some() && self.form == FormArgument::Acceleration {
            let reason = "`--corner` belongs to the filtered form; add `--form filtered`";
            return Err(Error::Argument(reason.to_owned()));
        }
        self.check_options()?;
        let compiled = compile(&self.spec)?;
        for remark in compiled.base.remarks(&compiled.standard) {
            output::say(&format!("warning: {}: {remark}", compiled.model.source));
        }
        let Some(method) = self.method.of_equations() else {
            return self.by_simulation(compiled);
        };
        if let Some(said) = mixed(&compiled) {
            output::say(&format!("note: {}: {said}", compiled.model.source));
        }
        let form: Box<dyn Fit> = match self.form {
            FormArgument::Acceleration => {
                let form = ByAcceleration(InterpretedArm::new(compiled));
                if !self.payload.is_empty() {
                    return self.with_payload(&form, method);
                }
                Box::new(form)
            }
            FormArgument::Filtered => Box::new(Filtered::new(compiled, self.corner)?),
        };
        let done = match &self.factor {
            Some(factor) => self.reduce(&*form, method, factor),
            None => self.fit(&*form, method),
        };
        done.map_err(|error| self.refused(error))
    }

    fn fit(&self, form: &dyn Fit, method: Method) -> Result<(), Error> {
        let dof = form.dof();
        let inputs = std::iter::once(&self.spec)
            .chain(&self.logs)
            .chain(&self.validate)
            .chain(&self.instruments);
        let mut files = Files::reading(inputs.map(PathBuf::as_path)).and(self.settings_files());
        let results = Results::claim(&mut files, self)?;
        let progress = Progress::new();
        let mut faults = Vec::new();
        let mut read = |path: &PathBuf| self.log(path, form, &mut faults, &progress);
        let logs = self.logs.iter().map(&mut read);
        let logs: Vec<Log> = logs.collect::<Result<_, _>>()?;
        let validate = self.validate.as_ref().map(read).transpose()?;
        if let Some(hint) = large::hint(&logs, dof) {
            progress.note(&format!("note: {hint}"));
        }
        let instruments = self.instruments.iter();
        let instruments = instruments.map(|path| trajectory(path, dof));
        let identify = Identify {
            instruments: instruments.collect::<Result<_, _>>()?,
            bootstrap: self.bootstrap.map_or(0, |draws| draws as usize),
            essential: self.essential,
            ..self.asked(method)
        };
        progress.step("identifying");
        let estimate = form.fit(&identify, &logs)?;
        if !self.partial {
            told_apart(&estimate)?;
        }
        let each = errors_of_each(&estimate, form, &logs)?;
        let mut train = Errors::of_all(&each);
        train
            .relative_percent
            .clone_from(&estimate.relative_percent);
        let validation = validate
            .as_ref()
            .map(|log| form.errors(&estimate, log))
            .transpose()?;
        progress.step("checking that columns agree with the spec");
        let identify = Identify {
            at_turns: estimate.at_turns(),
            ..identify
        };
        let reading = readings::others(form, &identify, &logs, &estimate);
        let is_as_meant = reading.is_none();
        let mut doubts: Vec<String> = Vec::new();
        doubts.extend(validate.iter().filter_map(|log| too_slow(&estimate, log)));
        let motions = self.instruments.iter().zip(&identify.instruments);
        doubts.extend(likeness::doubts(form.model(), &logs, motions));
        doubts.extend(unequal::doubt(&estimate.joints, &logs, &each));
        let is_of_instruments = estimate.hausman.is_some();
        if estimate.is_without_turns && !self.rows.turns.leave_out_turns && !is_of_instruments {
            doubts.push(at_turns::left_out(form.arm()));
        }
        doubts.extend(self.doubts(form, &estimate, &logs, validation.as_ref(), is_as_meant));
        progress.doubts(doubts);
        let of_columns = noted::warnings(form, &estimate, &logs, validation.as_ref(), reading);
        progress.warnings(of_columns);
        // Columns of other joints look late.
        if is_as_meant {
            faults.extend(self.late_channels(&estimate, &progress));
        }

        let found = OfEquations {
            estimate: &estimate,
            train: &train,
            validation: validation.as_ref(),
            faults: &faults,
            drawn: OnLog::of(form.arm(), &estimate, &logs, validate.as_ref()),
        };
        self.hand_over(form, found, results, progress)
    }

    /// What is asked of logs and of what is reduced of them.
    fn asked(&self, method: Method) -> Identify {
        let default = Identify::default();
        Identify {
            method,
            weights: self.weights.into(),
            bands: self.bands,
            prior: self.prior.unwrap_or(default.prior),
            at_turns: self.rows.turns.asked(),
            ..default
        }
    }

    /// As [`Self::fit`], in memory that does not grow with the logs.
    fn reduce(&self, form: &dyn Fit, method: Method, factor: &Path) -> Result<(), Error> {
        let inputs = std::iter::once(&self.spec)
            .chain(&self.logs)
            .chain(&self.validate);
        let mut files = Files::reading(inputs.map(PathBuf::as_path)).and(self.settings_files());
        let out = files.claim_for(factor, Content::Json(Record::Factor))?;
        let results = Results::claim(&mut files, self)?;
        let progress = Progress::new();
        let streams = Streams {
            form,
            logs: &self.logs,
            settings: &self.log_settings,
            as_logged: self.rows.as_logged,
            workers: workers(),
        };
        let identify = self.asked(method);
        let mut faults = Vec::new();
        let reduced = streams.reduce(&identify, &mut faults, &progress)?;
        let estimate = reduced.estimate(form.arm(), &identify)?;
        let mut train = streams.errors(&estimate, &progress)?;
        train
            .relative_percent
            .clone_from(&estimate.relative_percent);
        let mut read = |path: &PathBuf| self.log(path, form, &mut faults, &progress);
        let validate = self.validate.as_ref().map(&mut read).transpose()?;
        let validation = validate
            .as_ref()
            .map(|log| form.errors(&estimate, log))
            .transpose()?;
        // The reader has told what is in its report.
        let unsaid = faults.iter().filter(|(_, fault)| !fault.is_in_report());
        for (source, fault) in unsaid {
            progress.note(&format!("note: {source}: {fault}"));
        }
        if let (Err(error), false) = (told_apart(&estimate), self.partial) {
            progress.note(&format!("note: {error}"));
        }
        let doubts = twice::doubts(&self.logs, self.validate.as_deref());
        let slow = validate.iter().filter_map(|log| too_slow(&estimate, log));
        let doubts = doubts.into_iter().chain(slow);
        let doubts = doubts.chain(factor_doubts(&estimate, form));
        progress.doubts(doubts);
        let found = OfEquations {
            estimate: &estimate,
            train: &train,
            validation: validation.as_ref(),
            faults: &faults,
            drawn: OnLog::of(form.arm(), &estimate, &[], validate.as_ref()),
        };
        let results = results.with(out, factor_file::text(&reduced));
        self.hand_over(form, found, results, progress)
    }

    fn hand_over(
        &self,
        form: &dyn Fit,
        found: OfEquations,
        results: Results,
        progress: Progress,
    ) -> Result<(), Error> {
        let OfEquations {
            estimate,
            train,
            validation,
            faults,
            drawn,
        } = found;
        let printed = printed(estimate, train, validation);
        let evidence = Evidence {
            drawn,
            notes: progress.noted(),
            faults,
            printed: &printed,
            ..Evidence::of(&self.spec, form.compiled(), estimate, train, validation)
        };
        let report = report(estimate, Some(train), validation, faults);
        results.give(&report, &evidence, progress)
    }
}

/// Parameters, and errors side by side.
fn printed(estimate: &Estimate, train: &Errors, validation: Option<&Errors>) -> String {
    let columns = std::iter::once(("identification", train));
    let columns = columns.chain(validation.map(|errors| ("validation", errors)));
    let columns: Vec<_> = columns.collect();
    format!("{estimate}\n{}", table(estimate, &columns))
}

impl IdentifyArguments {
    /// Files that say where the logs have their columns.
    fn settings_files(&self) -> Vec<PathBuf> {
        let logs = self.logs.iter().chain(&self.validate).chain(&self.payload);
        self.log_settings.files(logs)
    }

    /// A log, mended; its faults are added to the others.
    fn log(
        &self,
        path: &Path,
        form: &dyn Fit,
        faults: &mut Vec<(String, Fault)>,
        progress: &Progress,
    ) -> Result<Log, Error> {
        if self.rows.as_logged {
            return read_log(path, form.model(), &self.log_settings, progress);
        }
        let mended = read_mended(path, form.model(), &self.log_settings, progress)?;
        let positions = far::positions(form.model(), &mended.log).into_iter();
        for doubt in positions.chain(far::torques(form.model(), &mended.log)) {
            progress.note(&format!("note: {}: {doubt}", path.display()));
        }
        let source = path.display().to_string();
        let found = mended.faults.into_iter();
        faults.extend(found.map(|fault| (source.clone(), fault)));
        Ok(mended.log)
    }

    /// A corner that was asked for is named as it was.
    fn refused(&self, error: Error) -> Error {
        match (error, self.corner) {
            (
                Error::Identify(IdentifyError::Signal(fault @ SignalError::Corner { .. })),
                Some(_),
            ) => Error::Argument(format!("--corner: {fault}")),
            (error, _) => error,
        }
    }
}

//! `robot-model merge`: one estimate from what many machines' logs tell.

use std::path::{Path, PathBuf};

use clap::{Args, ValueEnum};
use robot_model::identify::{Factor, Identify, IdentifyError, Method};

use crate::Error;
use crate::identify::at_turns;
use crate::identify::factor_file;
use crate::identify::fit::of_form;
use crate::identify::noted::{factor_doubts, told_apart, too_slow};
use crate::identify::options::{TurnOptions, WeightsArgument, check_prior};
use crate::identify::report::report;
use crate::identify::table::{share, table};
use crate::log_settings::LogSettings;
use crate::output::{self, Content, Files, Record, counted};
use crate::progress::Progress;
use crate::spec::{compile, read_mended};

/// Identify from factors written by `identify --factor`, without the logs.
#[derive(Debug, Args)]
#[command(after_help = "Examples:
  robot-model merge arm.robot here.json there.json --validate tuesday.csv --json fit.json
  robot-model merge arm.robot here.json there.json --factor both.json")]
pub(crate) struct Merge {
    /// The `.robot` file.
    spec: PathBuf,
    /// Factors of the same spec, `--bands`, `--form` and `--corner`; the form is theirs.
    #[arg(required = true, value_name = "FACTOR")]
    factors: Vec<PathBuf>,
    /// Estimation method.
    #[arg(long, value_enum, default_value_t)]
    method: MethodArgument,
    /// Divisor of each joint's rows with `--method wls`.
    #[arg(long, value_enum, default_value_t)]
    weights: WeightsArgument,
    /// For `ridge`: standard deviation of the spec's nominal values, as a share of each body's size; default 0.3.
    #[arg(long, value_name = "SHARE", allow_hyphen_values = true)]
    prior: Option<f64>,
    /// Validation log: not fitted, errors are computed on it.
    #[arg(long, value_name = "LOG")]
    validate: Option<PathBuf>,
    #[command(flatten)]
    log_settings: LogSettings,
    /// Write the merged factor.
    #[arg(long, value_name = "FILE")]
    factor: Option<PathBuf>,
    #[command(flatten)]
    turns: TurnOptions,
    /// If the factors do not separate all parameters, identify the sums that they do determine.
    #[arg(long)]
    partial: bool,
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
    /// The same, with the spec's nominal values as measurements.
    Ridge,
    /// The physically possible arm nearest to `wls`.
    Physical,
}

impl Merge {
    /// What is asked of the factors; options that the method does not read are mistakes.
    fn identify(&self) -> Result<Identify, Error> {
        let method = match self.method {
            MethodArgument::Ls => Method::Ls,
            MethodArgument::Wls => Method::Wls,
            MethodArgument::Ridge => Method::Ridge,
            MethodArgument::Physical => Method::Physical,
        };
        if method != Method::Wls && self.weights != WeightsArgument::Residual {
            let reason = format!(
                "`--weights` belongs to `wls`; `{}` has its own",
                method.name()
            );
            return Err(Error::Argument(reason));
        }
        check_prior(self.prior)?;
        if self.prior.is_some() && method != Method::Ridge {
            return Err(Error::Argument(
                "`--prior` belongs to `--method ridge`".to_owned(),
            ));
        }
        let default = Identify::default();
        Ok(Identify {
            method,
            weights: self.weights.into(),
            prior: self.prior.unwrap_or(default.prior),
            at_turns: self.turns.asked(),
            ..default
        })
    }

    pub(crate) fn run(&self) -> Result<(), Error> {
        let identify = self.identify()?;
        if self.validate.is_none() && self.log_settings.is_given() {
            return Err(Error::Argument(
                "`--log-settings` applies to the validation log; give `--validate` too".to_owned(),
            ));
        }
        let inputs = std::iter::once(&self.spec)
            .chain(&self.factors)
            .chain(&self.validate);
        let settings = &self.log_settings;
        let mut files =
            Files::reading(inputs.map(PathBuf::as_path)).and(settings.files(&self.validate));
        let out = files.claim_if(self.factor.as_deref(), Content::Json(Record::Factor))?;
        let json = files.claim_if(self.json.as_deref(), Content::Json(Record::Identify))?;
        let compiled = compile(&self.spec)?;
        let progress = Progress::new();
        let mut opened = self.factors.iter().enumerate().map(|(k, path)| {
            let done = k as f64 / self.factors.len() as f64;
            progress.part(&format!("reading {}", path.display()), done);
            factor_file::open(path)
        });
        // The first says of which form all are.
        let first = opened.next().ok_or(IdentifyError::NoLog)??;
        let form = of_form(compiled, first.form)?;
        let mut all: Option<Factor> = None;
        let mut read: Vec<(&Path, Factor)> = Vec::new();
        for opened in std::iter::once(Ok(first)).chain(opened) {
            let opened = opened?;
            let path = opened.path;
            let factor = opened.factor(&*form)?;
            progress.notes(twice(path, &factor, &read));
            // Without its rows a factor is known again all the same.
            let mut known = factor.clone();
            for block in &mut known.blocks {
                block.whole.rows.clear();
                block.away = None;
            }
            read.push((path, known));
            match &mut all {
                None => all = Some(factor),
                Some(all) => all
                    .merge(factor)
                    .map_err(|error| Error::json(path, &error.to_string()))?,
            }
        }
        let factor = all.ok_or(IdentifyError::NoLog)?;
        let estimate = factor.estimate(form.arm(), &identify)?;
        if !self.partial {
            told_apart(&estimate)?;
        }
        progress.doubts(factor_doubts(&estimate, &*form));
        if estimate.is_without_turns && !self.turns.leave_out_turns {
            progress.doubts([at_turns::left_out(form.arm())]);
        }
        let mut faults = Vec::new();
        let validation = match &self.validate {
            None => None,
            Some(path) => {
                let mended = read_mended(path, form.model(), settings, &progress)?;
                let source = path.display().to_string();
                let found = mended.faults.into_iter();
                faults.extend(found.map(|fault| (source.clone(), fault)));
                if let Some(slow) = too_slow(&estimate, &mended.log) {
                    progress.note(&format!("note: {slow}"));
                }
                Some(form.errors(&estimate, &mended.log)?)
            }
        };
        let notes = progress.noted();
        let _behind = progress.ended();
        if let Some(file) = out {
            file.commit(factor_file::text(&factor).as_bytes())?;
        }
        if let Some(file) = json {
            let report = report(&estimate, None, validation.as_ref(), &faults);
            file.commit(output::json_with_notes(&report, &notes).as_bytes())?;
        }
        let joints = estimate.joints.iter().zip(&estimate.relative_percent);
        let fitted: Vec<String> = joints
            .map(|(name, percent)| match share(*percent) {
                Some(percent) => format!("{name} {percent:.2} %"),
                None => format!("{name} -"),
            })
            .collect();
        let errors = validation.as_ref().map(|errors| ("validation", errors));
        let errors: Vec<_> = errors.into_iter().collect();
        let table = if errors.is_empty() {
            String::new()
        } else {
            table(&estimate, &errors)
        };
        output::print(&format!(
            "{estimate}relative error of the fitted logs, in the filtered band: {}\n{table}",
            fitted.join(", ")
        ))
    }
}

/// Factors that have blocks of a log which one before them has, too.
fn twice(path: &Path, factor: &Factor, before: &[(&Path, Factor)]) -> Vec<String> {
    let told = before.iter().filter_map(|(first, other)| {
        let common = factor.common_parts(other);
        (common > 0).then(|| {
            format!(
                "{} has {} of a log that {} also has: they count twice, and standard deviations are too small; give them once",
                path.display(),
                counted(common, "part"),
                first.display()
            )
        })
    });
    told.collect()
}

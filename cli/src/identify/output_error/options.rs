//! Options of output error.

use std::path::PathBuf;

use clap::{Args, ValueEnum};

use crate::Error;

/// Options of `--method output-error`.
#[derive(Debug, Args)]
#[command(next_help_heading = "Output error")]
pub(crate) struct Options {
    /// Start parameters: by name, or what `identify --json` wrote; default: those of `--method wls` on the same logs.
    #[arg(long, value_name = "FILE.json")]
    pub start: Option<PathBuf>,
    /// Search algorithm; default `levenberg-marquardt`.
    #[arg(long, value_enum)]
    pub(super) search: Option<SearchArgument>,
    /// Bounds of parameters, `{"NAME": [LOW, HIGH], ..}`, also of the standard parameters and constants in base parameters; default: only
    /// the ranges of shapes.
    #[arg(long, value_name = "FILE.json")]
    pub bounds: Option<PathBuf>,
    /// Keep parameters within this percentage of the start; `--bounds` takes precedence, and a note lists the differences.
    #[arg(long, value_name = "PERCENT", allow_negative_numbers = true)]
    pub(super) within: Option<f64>,
    /// Cut logs into windows of this many seconds, each with its own start and with effect memories at zero; default: 1 s, but whole logs
    /// with `--controller` or if effects have a memory.
    #[arg(long, value_name = "S", allow_negative_numbers = true)]
    pub(super) window: Option<f64>,
    /// The controller of the experiment, to be simulated too; without it the logged torque drives the arm.
    #[arg(long, value_name = "FILE.json")]
    pub controller: Option<PathBuf>,
    /// Torque between samples of the log; default: the one with smaller errors, if torque changes from sample to sample.
    #[arg(long, value_enum)]
    pub(super) hold: Option<HoldArgument>,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(crate) enum SearchArgument {
    /// Levenberg and Marquardt: damped Gauss-Newton steps.
    LevenbergMarquardt,
    /// Gauss-Newton steps within a trust region.
    TrustRegion,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(crate) enum HoldArgument {
    /// The mean of both samples: for measured torques, or means over an interval.
    Mean,
    /// The value of the previous sample: for held commands.
    Sample,
}

impl Options {
    /// The first option that is given.
    pub fn given(&self) -> Option<&'static str> {
        [
            ("--start", self.start.is_some()),
            ("--search", self.search.is_some()),
            ("--bounds", self.bounds.is_some()),
            ("--within", self.within.is_some()),
            ("--window", self.window.is_some()),
            ("--controller", self.controller.is_some()),
            ("--hold", self.hold.is_some()),
        ]
        .into_iter()
        .find_map(|(name, is_given)| is_given.then_some(name))
    }

    /// Refuses what no log makes sense of, before logs are read.
    pub fn check(&self) -> Result<(), Error> {
        let is_positive = |number: f64| number > 0.0;
        if let Some(window) = self.window.filter(|window| !is_positive(*window)) {
            return Err(Error::Argument(format!(
                "`--window` must be positive, not {window}"
            )));
        }
        let is_share = |percent: f64| is_positive(percent) && percent.is_finite();
        if let Some(percent) = self.within.filter(|percent| !is_share(*percent)) {
            return Err(Error::Argument(format!(
                "`--within` must be a positive number of percent, not {percent}"
            )));
        }
        let of_log = [
            ("--window", self.window.is_some()),
            ("--hold", self.hold.is_some()),
        ];
        let mut given = of_log.into_iter().filter(|(_, is_given)| *is_given);
        match (&self.controller, given.next()) {
            (Some(_), Some((option, _))) => Err(Error::Argument(format!(
                "`{option}` needs an arm driven by the logged torque; with `--controller` whole logs are simulated, and its torque is held"
            ))),
            _ => Ok(()),
        }
    }

    pub fn files(&self) -> impl Iterator<Item = &PathBuf> {
        [&self.start, &self.bounds, &self.controller]
            .into_iter()
            .flatten()
    }
}

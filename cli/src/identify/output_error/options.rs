//! Options of output error, and the bounds that a file gives.

use std::path::{Path, PathBuf};

use clap::{Args, ValueEnum};
use robot_model_codegen::Compiled;
use serde_json::Value;

use crate::{Error, json, output};

/// Options of `--method output-error`.
#[derive(Debug, Args)]
#[command(next_help_heading = "Output error")]
pub(crate) struct Options {
    /// Parameters to start from: by name, or what `identify --json` wrote; without it those of `--method wls` on the same logs.
    #[arg(long, value_name = "FILE.json")]
    pub start: Option<PathBuf>,
    /// Who looks for the least error; `levenberg-marquardt` without it.
    #[arg(long, value_enum)]
    pub(super) search: Option<SearchArgument>,
    /// Least and largest values of parameters, `{"NAME": [LOW, HIGH], ..}`; without it ranges of shapes.
    #[arg(long, value_name = "FILE.json")]
    pub bounds: Option<PathBuf>,
    /// Cut logs into windows of so many seconds, each with a start of its own, its effects' memories at zero; without it 1 s, and whole
    /// logs with `--controller` or where effects remember.
    #[arg(long, value_name = "S")]
    pub(super) window: Option<f64>,
    /// The controller of the experiment, which is simulated too; without it the logged torque drives the arm.
    #[arg(long, value_name = "FILE.json")]
    pub controller: Option<PathBuf>,
    /// Torque between samples of the log; `mean` without it.
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
    /// The mean of both samples: torques that are measured, or means over an interval.
    Mean,
    /// That of the sample before: commands that are held.
    Sample,
}

impl Options {
    /// The first option that is given.
    pub fn given(&self) -> Option<&'static str> {
        [
            ("--start", self.start.is_some()),
            ("--search", self.search.is_some()),
            ("--bounds", self.bounds.is_some()),
            ("--window", self.window.is_some()),
            ("--controller", self.controller.is_some()),
            ("--hold", self.hold.is_some()),
        ]
        .into_iter()
        .find_map(|(name, is_given)| is_given.then_some(name))
    }

    pub fn files(&self) -> impl Iterator<Item = &PathBuf> {
        [&self.start, &self.bounds, &self.controller]
            .into_iter()
            .flatten()
    }
}

/// Ranges of shapes, and what a file says.
pub(super) fn bounds(
    compiled: &Compiled,
    names: &[String],
    file: Option<&Path>,
) -> Result<Vec<[f64; 2]>, Error> {
    let ranges = compiled.model.effects.iter().flat_map(|effect| {
        let shapes = effect.definition.shapes.iter();
        shapes.map(|shape| [shape.low, shape.high])
    });
    let ranges: Vec<[f64; 2]> = ranges.collect();
    let open = [f64::NEG_INFINITY, f64::INFINITY];
    let mut bounds = vec![open; compiled.base.kept.len()];
    bounds.extend(compiled.free_shapes().into_iter().map(|k| ranges[k]));
    let Some(path) = file else {
        return Ok(bounds);
    };
    let refuse = |reason: &str| Err(Error::json(path, &reason));
    let Value::Object(entries) = json::read(path)? else {
        return refuse("write `{\"NAME\": [LOW, HIGH], ..}`");
    };
    for (name, range) in entries {
        let Some(place) = names.iter().position(|other| *other == name) else {
            let known: Vec<&str> = names.iter().map(String::as_str).collect();
            return refuse(&format!(
                "no parameter is called `{name}`; there are {}",
                output::names(&known)
            ));
        };
        let pair = range.as_array().and_then(|pair| match pair.as_slice() {
            [low, high] => Some([low.as_f64()?, high.as_f64()?]),
            _ => None,
        });
        match pair {
            Some([low, high]) if low <= high => bounds[place] = [low, high],
            _ => {
                return refuse(&format!(
                    "`{name}`: write `[LOW, HIGH]`, two numbers that rise"
                ));
            }
        }
    }
    Ok(bounds)
}

//! Where logs have their columns beside the spec: `robot-model.toml` in a log's folder, or the file that was asked for.

use std::collections::BTreeMap;
use std::fs::File;
use std::io::Read as _;
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex, PoisonError};

use clap::Args;
use robot_model::log::{Column, Columns, DriveSignal, is_bag};
use robot_model_spec::model::{GainUnit, LogColumn, LogColumns};
use robot_model_spec::{ColumnKind, Model};

use crate::progress::Progress;
use crate::spec::read_text;
use crate::{Error, output};

/// What a file of settings is called where nobody says it.
pub(crate) const NAME: &str = "robot-model.toml";

/// The option of all verbs that read logs.
#[derive(Debug, Clone, Default, Args)]
pub(crate) struct LogSettings {
    /// Columns and units of logs, TOML; each channel overrides that of the spec's `log`. Default: the `robot-model.toml` in the log's folder, if any.
    #[arg(long = "log-settings", value_name = "FILE.toml")]
    file: Option<PathBuf>,
    /// Files as they were read first, and told.
    #[arg(skip)]
    read: Arc<Mutex<BTreeMap<PathBuf, LogColumns>>>,
}

impl LogSettings {
    /// Whether a file was asked for.
    pub(crate) fn is_given(&self) -> bool {
        self.file.is_some()
    }

    /// The file that was asked for.
    pub(crate) fn given(&self) -> Option<&Path> {
        self.file.as_deref()
    }

    /// The file that holds for a log.
    pub(crate) fn of(&self, log: &Path) -> Option<PathBuf> {
        self.file.clone().or_else(|| {
            let beside = log.with_file_name(NAME);
            beside.exists().then_some(beside)
        })
    }

    /// Files that hold for logs, to keep outputs away from them.
    pub(crate) fn files<'a>(&self, logs: impl IntoIterator<Item = &'a PathBuf>) -> Vec<PathBuf> {
        let mut files: Vec<PathBuf> = logs.into_iter().filter_map(|log| self.of(log)).collect();
        files.sort();
        files.dedup();
        files
    }

    /// Where a log of a robot has its channels. A file beside the spec is never read in silence.
    pub(crate) fn columns(
        &self,
        log: &Path,
        model: &Model,
        progress: &Progress,
    ) -> Result<Columns, Error> {
        let Some(path) = self.of(log) else {
            return Ok(columns(model, &model.log));
        };
        if !self.is_given() && is_of_bag(log) && !names_joints(&read_text(&path)?) {
            progress.note(&format!(
                "note: {} names columns of tables and is not used for the bag {}",
                path.display(),
                log.display()
            ));
            return Ok(columns(model, &model.log));
        }
        let mut read = self.read.lock().unwrap_or_else(PoisonError::into_inner);
        if !read.contains_key(&path) {
            read.insert(path.clone(), settings(&path, model, progress)?);
        }
        let own = &read[&path];
        Ok(columns(model, own))
    }
}

impl LogSettings {
    /// What a one in a column of a table without a robot is worth, in SI units; 1 where no file names it. It is told where it is not 1.
    pub(crate) fn unit(&self, table: &Path, column: &str, kind: ColumnKind) -> Result<f64, Error> {
        let Some(path) = self.of(table) else {
            return Ok(1.0);
        };
        let name = path.display().to_string();
        let unit = robot_model_spec::log_column_unit(&name, &read_text(&path)?, column, kind)?;
        if let Some(unit) = unit.filter(|unit| (*unit - 1.0).abs() > 0.0) {
            output::say(&format!(
                "note: {name} gives the unit of column `{column}`: 1 there is {} in SI units",
                output::rounded(unit)
            ));
        }
        Ok(unit.unwrap_or(1.0))
    }
}

/// Whether a log is a bag, by its first bytes. A pipe is not read for that.
fn is_of_bag(log: &Path) -> bool {
    let is_file = log.metadata().is_ok_and(|found| found.is_file());
    let mut first = [0; 8];
    let mut read = || File::open(log)?.read_exact(&mut first);
    is_file && read().is_ok() && is_bag(&first)
}

/// Whether settings are of bags, which have a topic and fields of joints: others beside a bag are of the tables there.
fn names_joints(settings: &str) -> bool {
    let of_bags = ["topic", ".position", ".velocity", ".effort"];
    of_bags.iter().any(|words| settings.contains(words))
}

/// Reads a file, and says so.
fn settings(path: &Path, model: &Model, progress: &Progress) -> Result<LogColumns, Error> {
    let name = path.display().to_string();
    let found = robot_model_spec::log_settings(model, &name, &read_text(path)?)?;
    let of_spec: Vec<&str> = model.log.all().map(|(channel, _)| channel).collect();
    let said = found.said.iter().map(|channel| format!("`{channel}`"));
    let said: Vec<String> = said.collect();
    let over = match model.log.line {
        Some(line) if found.said.iter().any(|own| of_spec.contains(&own.as_str())) => {
            format!(", instead of the spec's `log` ({}:{line})", model.source)
        }
        _ => String::new(),
    };
    if said.is_empty() {
        progress.note(&format!(
            "note: {name} has no settings for logs; write channels under its `[log]`, such as `q = {{ columns = [\"axis1\", ..], unit = \"deg\" }}`"
        ));
        return Ok(found.columns);
    }
    progress.note(&format!(
        "note: {name} sets the columns of {}{over}",
        said.join(", ")
    ));
    Ok(found.columns)
}

/// Columns as the reader of logs takes them; standard ones where nothing is said.
fn columns(model: &Model, log: &LogColumns) -> Columns {
    let column = |own: &LogColumn| Column {
        name: own.name.clone(),
        unit: own.is_unit_written.then_some(own.unit),
    };
    let mut columns = Columns::standard(model.joints.len());
    if let Some(time) = &log.time {
        columns.time = column(time);
    }
    let families = [
        (&mut columns.q, &log.q),
        (&mut columns.dq, &log.dq),
        (&mut columns.tau, &log.tau),
    ];
    for (standard, own) in families {
        if !own.is_empty() {
            *standard = own.iter().map(column).collect();
        }
    }
    let signals = model
        .joints
        .iter()
        .map(|joint| match joint.actuator_gain_unit {
            None => DriveSignal::Torque,
            Some(GainUnit::TorquePerAmpere) => DriveSignal::Current,
            Some(GainUnit::Plain | GainUnit::Torque) => DriveSignal::Number,
        });
    columns.signals = signals.collect();
    let inputs = log.inputs.iter();
    columns.extra = inputs
        .map(|(name, own)| (name.clone(), column(own)))
        .collect();
    let joints = model.joints.iter();
    columns.joints = joints.map(|joint| joint.name.clone()).collect();
    columns.topic.clone_from(&log.topic);
    columns
}

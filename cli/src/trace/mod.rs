//! `robot-model trace`: what the model lacks, written into the spec.

mod apart;
#[cfg(test)]
pub(crate) mod cart;
mod doubt;
mod next;
mod page;
mod parameters;
mod report;
mod said;
mod summary;
mod tried;
mod whereabouts;

use std::fmt::Write;
use std::fs;
use std::path::{Path, PathBuf};

use clap::Args;
use robot_model::columns::Arm;
use robot_model::log::Log;

use crate::Error;
use crate::close_the_loop::{self, Loop};
use crate::identify::twice;
use crate::log_settings::LogSettings;
use crate::misplaced::robot_of;
use crate::output::table::PREDICTION;
use crate::output::{self, Content, Files, Record};
use crate::progress::Progress;
use crate::report::ReportFolder;
use crate::spec::{load, read_log, read_mended, read_text};

pub(crate) use report::Report;
pub(crate) use summary::summary;

/// Trace the residual of an arm's model to an effect that the spec does not declare.
#[derive(Debug, Args)]
#[command(after_help = "Examples:
  robot-model trace arm.robot monday.csv --validate tuesday.csv
  robot-model trace arm.robot monday.csv --validate tuesday.csv --amend arm2.robot --report page --json trace.json")]
pub(crate) struct TraceArguments {
    /// The `.robot` file.
    spec: PathBuf,
    /// Logs to fit: CSV (plain or gzip) or Parquet, `time,q1..qn[,dq1..dqn],tau1..taun[,extra..]`, SI units, or as the spec's `log` or a `robot-model.toml` has them;
    /// or MCAP, a bag of ROS 2 with joint states.
    #[arg(required = true, value_name = "LOG")]
    logs: Vec<PathBuf>,
    /// Validation log: not fitted, only used for errors before and after.
    #[arg(long, value_name = "LOG")]
    validate: Option<PathBuf>,
    #[command(flatten)]
    log_settings: LogSettings,
    /// Write the spec with the traced effects declared, to a file other than the spec.
    #[arg(long, value_name = "OUT.robot")]
    amend: Option<PathBuf>,
    /// Write the amended model's torque on the validation log, `time,tau1..taun`, in the units of that log's torque
    /// channels: divided by each joint's `actuator_gain` and by the unit of its column.
    #[arg(long, value_name = "OUT.csv", requires = "validate")]
    predict: Option<PathBuf>,
    /// Write the result as JSON.
    #[arg(long, value_name = "FILE")]
    json: Option<PathBuf>,
    /// Write the result as a page with figures, `index.html` in this folder.
    #[arg(long, value_name = "DIR")]
    report: Option<PathBuf>,
}

impl TraceArguments {
    /// Refuses to put an amended spec in the place of that of another robot, which somebody wrote.
    fn check_amended(&self, robot: &str) -> Result<(), Error> {
        let Some(path) = &self.amend else {
            return Ok(());
        };
        let text = fs::read_to_string(path).unwrap_or_default();
        match robot_of(&text) {
            Some(other) if other != robot => Err(Error::Argument(format!(
                "cannot write `{}`: the existing file is the spec of robot `{other}`, and would be lost; give another name, or remove that file first",
                path.display()
            ))),
            _ => Ok(()),
        }
    }

    pub(crate) fn run(&self) -> Result<(), Error> {
        let text = read_text(&self.spec)?;
        let model = load(&self.spec)?;
        let inputs = std::iter::once(&self.spec)
            .chain(&self.logs)
            .chain(&self.validate);
        let settings = &self.log_settings;
        let mut files = Files::reading(inputs.map(PathBuf::as_path))
            .and(settings.files(self.logs.iter().chain(&self.validate)));
        self.check_amended(&model.name)?;
        let amend = files.claim_if(self.amend.as_deref(), Content::Spec)?;
        let predict = files.claim_if(self.predict.as_deref(), Content::Prediction)?;
        let json = files.claim_if(self.json.as_deref(), Content::Json(Record::Trace))?;
        let report = ReportFolder::claim_if(&mut files, self.report.as_deref())?;

        let progress = Progress::new();
        let logs = self
            .logs
            .iter()
            .map(|path| read_log(path, &model, settings, &progress))
            .collect::<Result<Vec<_>, _>>()?;
        let read = |path: &Path| read_mended(path, &model, settings, &progress);
        let validate = self.validate.as_deref().map(read).transpose()?;
        let validate = validate.map(|mended| mended.log);
        progress.notes(twice::doubts(&self.logs, self.validate.as_deref()));
        let read = progress.noted();
        let name = self.spec.display().to_string();
        let closed = close_the_loop::close(&name, &text, &logs, validate.as_ref(), &progress)?;
        let page = report.as_ref().map(|_| {
            page::page(
                (&name, &text),
                &closed,
                (&files.inputs(), &read),
                self.next(&closed),
            )
        });
        let page = page.transpose()?;
        // All contents are ready before the first file appears.
        let unseen = closed.unseen.as_ref();
        let prediction = unseen.map(|log| prediction(&closed, log)).transpose()?;
        drop(progress);
        let spec = if closed.changed.is_some() {
            "the spec with the effects declared"
        } else {
            "the spec as it was: nothing was added"
        };
        let contents = [
            (amend, Some(closed.amended.clone()), spec),
            (predict, prediction, "predicted torque in the log's units"),
            (
                json,
                Some(output::json(&Report::new(&closed))),
                "the result",
            ),
        ];
        let mut told = summary(&self.spec.display().to_string(), &closed, &text);
        for (file, content, what) in contents {
            if let (Some(file), Some(content)) = (file, content) {
                let path = file.path().display().to_string();
                file.commit(content.as_bytes())?;
                writeln!(told, "wrote {path}: {what}").expect("a string takes all");
            }
        }
        if let (Some(report), Some(page)) = (report, page) {
            let path = report.commit(&page)?;
            writeln!(told, "wrote {path}: the report").expect("a string takes all");
        }
        output::print(&told)
    }
}

/// `time,tau1..taun` of the last model on a log, in the units of the log's torque channels.
fn prediction(closed: &Loop, log: &Log) -> Result<String, Error> {
    let after = closed.after();
    let mut torque = after.estimate.predict(&after.arm, log)?;
    let gains = after.arm.actuator_gain().iter().zip(&log.tau_units);
    for (values, (gain, unit)) in torque.iter_mut().zip(gains) {
        for value in values {
            *value /= gain * unit;
        }
    }
    let mut text = PREDICTION.header(torque.len());
    text.push('\n');
    for (sample, time) in log.time.iter().enumerate() {
        let values = torque.iter().map(|values| values[sample]);
        PREDICTION.push(&mut text, *time, values);
    }
    Ok(text)
}

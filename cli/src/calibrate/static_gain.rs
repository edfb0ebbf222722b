//! `calibrate static`: torques of a blocked arm at a sequence of currents.

use std::path::PathBuf;

use clap::Args;
use robot_model::calibrate::{StaticGain, Term};
use robot_model_spec::ColumnKind;
use serde::Serialize;

use crate::Error;
use crate::log_settings::LogSettings;
use crate::output::{self, Content, Files, Record, counted};

use super::figure;
use super::table::Table;
use super::words::{measured, rounded};
use crate::output::significant;

/// Identify the gain from current to torque, from a blocked arm at a sequence of currents.
///
/// The arm is held level, and the torque, or the force at a known distance from the joint, is measured at each current. Rows are in the
/// order of measurement: if currents rise and fall, the difference of both directions is twice the gear friction.
#[derive(Debug, Args)]
#[command(after_help = "Examples:
  robot-model calibrate static blocked.csv --current i --torque tau
  robot-model calibrate static blocked.csv --current i --force f --arm 0.45 --json gain.json --figure gain.svg")]
pub(crate) struct Static {
    /// A CSV table with a header and a row for each current.
    table: PathBuf,
    /// The column of currents, A.
    #[arg(long, value_name = "COLUMN")]
    current: String,
    /// The column of torques, N m.
    #[arg(long, value_name = "COLUMN", required_unless_present = "force")]
    torque: Option<String>,
    /// The column of forces perpendicular to the arm, N, instead of torques.
    #[arg(
        long,
        value_name = "COLUMN",
        requires = "arm",
        conflicts_with = "torque"
    )]
    force: Option<String>,
    /// Distance of the force sensor from the joint's axis, m.
    #[arg(
        long,
        value_name = "M",
        requires = "force",
        conflicts_with = "torque",
        allow_negative_numbers = true
    )]
    arm: Option<f64>,
    #[command(flatten)]
    log_settings: LogSettings,
    /// Write the result as JSON.
    #[arg(long, value_name = "FILE")]
    json: Option<PathBuf>,
    /// Draw the points, the line and its 95 % confidence band.
    #[arg(long, value_name = "FILE.svg")]
    figure: Option<PathBuf>,
}

#[derive(Serialize)]
struct Report {
    gain: f64,
    gain_std: f64,
    gain_interval: [f64; 2],
    offset: f64,
    offset_std: f64,
    offset_interval: [f64; 2],
    r: f64,
    residual_std: f64,
    samples: usize,
    curvature: Option<f64>,
    curvature_std: Option<f64>,
    curvature_p: Option<f64>,
    hysteresis: Option<f64>,
    hysteresis_std: Option<f64>,
    hysteresis_p: Option<f64>,
    friction: Option<f64>,
    gain_beside_hysteresis: Option<f64>,
    gain_beside_hysteresis_std: Option<f64>,
    spec: Option<String>,
}

impl Static {
    pub(crate) fn run(&self) -> Result<(), Error> {
        let measured = match (&self.torque, &self.force) {
            (Some(torque), _) => ("--torque", torque.as_str(), ColumnKind::Torque),
            (None, Some(force)) => ("--force", force.as_str(), ColumnKind::Force),
            (None, None) => unreachable!("one of both is required"),
        };
        let arm = self.arm.unwrap_or(1.0);
        if !arm.is_finite() || arm <= 0.0 {
            return Err(Error::Argument(format!(
                "--arm {arm}: write a positive distance in m"
            )));
        }
        let settings = &self.log_settings;
        let mut files = Files::reading([self.table.as_path()]).and(settings.files([&self.table]));
        let json = files.claim_if(self.json.as_deref(), Content::Json(Record::StaticGain))?;
        let figure = files.claim_figure(self.figure.as_deref())?;
        let current = ("--current", self.current.as_str(), ColumnKind::Current);
        let table = Table::read(&self.table, &[current, measured], settings)?;
        let current = &table.columns[0];
        let torque: Vec<f64> = table.columns[1].iter().map(|x| arm * x).collect();
        let line = StaticGain::fit(current, &torque).map_err(|error| table.refused(&error))?;
        if let Some(file) = json {
            file.commit(output::json(&report(&line)).as_bytes())?;
        }
        if let Some(file) = figure {
            file.commit(figure::line(&line, current, &torque).as_bytes())?;
        }
        let [low, high] = line.gain.interval;
        if low <= 0.0 && high >= 0.0 {
            output::say(
                "note: the gain cannot be distinguished from zero: are these the columns of one experiment?",
            );
        }
        output::print(&summary(&line))
    }
}

/// None where the points are on no line, which has no gain then.
fn spec(line: &StaticGain) -> Option<String> {
    let is_bent = line.curvature.as_ref().is_some_and(Term::is_told);
    (!is_bent).then(|| format!("actuator_gain = {} Nm/A;", rounded(&line.best())))
}

fn report(line: &StaticGain) -> Report {
    let hysteresis = line.hysteresis.map(|found| found.difference);
    let value = |term: Option<Term>| term.map(|term| term.value.value);
    let std = |term: Option<Term>| term.map(|term| term.value.std);
    let p = |term: Option<Term>| term.map(|term| term.p);
    Report {
        gain: line.gain.value,
        gain_std: line.gain.std,
        gain_interval: line.gain.interval,
        offset: line.offset.value,
        offset_std: line.offset.std,
        offset_interval: line.offset.interval,
        r: line.r,
        residual_std: line.residual_std,
        samples: line.samples,
        curvature: value(line.curvature),
        curvature_std: std(line.curvature),
        curvature_p: p(line.curvature),
        hysteresis: value(hysteresis),
        hysteresis_std: std(hysteresis),
        hysteresis_p: p(hysteresis),
        friction: line.hysteresis.map(|found| found.friction),
        gain_beside_hysteresis: line.hysteresis.map(|found| found.gain.value),
        gain_beside_hysteresis_std: line.hysteresis.map(|found| found.gain.std),
        spec: spec(line),
    }
}

fn summary(line: &StaticGain) -> String {
    format!(
        "gain        {}\n\
         offset      {}\n\
         r           {:.5}, residual {} N m, {}\n\
         bend        {}\n\
         hysteresis  {}\n\
         \n\
         {}\n",
        measured(&line.gain, "N m/A"),
        measured(&line.offset, "N m"),
        line.r,
        significant(line.residual_std, 3),
        counted(line.samples, "point"),
        bend(line),
        hysteresis(line),
        spec(line).map_or_else(
            || {
                "no gain for the spec, as the points are not on a line: leave out rows with currents at which the drive saturates, and \
                 calibrate again"
                    .to_owned()
            },
            |gain| format!("for the spec, in the joint:\n    {gain}")
        ),
    )
}

fn bend(line: &StaticGain) -> String {
    match &line.curvature {
        None => "unknown: needs three currents and more points than terms".to_owned(),
        Some(term) if term.is_told() => format!(
            "NOT LINEAR: a term {}, p = {:.2e} by chance; does the drive saturate?",
            measured(&term.value, "N m/A^2"),
            term.p
        ),
        Some(term) => format!("not significant, p = {:.2}", term.p),
    }
}

fn hysteresis(line: &StaticGain) -> String {
    let Some(found) = &line.hysteresis else {
        return "unknown: needs currents that rise and fall, in the order of the rows".to_owned();
    };
    let term = &found.difference;
    let of = format!("{} rising and {} falling", found.rising, found.falling);
    if !term.is_told() {
        return format!("not significant for {of}, p = {:.2}", term.p);
    }
    let what = if found.friction > 0.0 {
        let friction = significant(found.friction, 3);
        format!("half of it, {friction} N m, is friction")
    } else {
        "friction would have the opposite sign: are the rows in the order of measurement?"
            .to_owned()
    };
    format!(
        "falling minus rising {}, of {of}, p = {:.2e}: {what}\n\
         gain        {}, with a constant for each direction",
        measured(&term.value, "N m"),
        term.p,
        measured(&found.gain, "N m/A"),
    )
}

//! `robot-model excite`: the motion from which an arm is identified best.

mod columns;
mod criterion;
mod figure;
mod limits;
mod output;
mod request;
mod room;
mod separate;

use std::cell::Cell;
use std::path::PathBuf;
use std::time::{Duration, Instant};

use clap::{Args, ValueEnum};
use robot_model::excite::{ExciteError, Progress as Search, Request};

use crate::interrupt::Wish;
use crate::output::{Content, Files, Record, counted};
use crate::progress::Progress;
use crate::{Error, spec};

use criterion::CriterionArgument;
pub(crate) use separate::have_own_columns;

/// Design the motion that identifies an arm best, within its limits.
///
/// The motion is a sum of harmonics that repeats every period, begins and ends at rest, and keeps the limits of the spec at all
/// times: position, velocity and acceleration by a bound that holds between samples, torque and distances on a grid ten times as fine
/// as the design's. The same seed gives the same motion, unless `--budget` or Ctrl-C stops the search: then the best motion so far
/// is written.
#[derive(Debug, Args)]
#[command(
    allow_negative_numbers = true,
    after_help = "Examples:
  robot-model excite arm.robot --out motion.csv
  robot-model excite arm.robot --criterion condition --period 10 --out motion.csv
  robot-model excite arm.robot --separate 'quadratic_viscous on elbow: c = 0.2' --from 'cubic_viscous on elbow: c = 0.1' --out motion.csv"
)]
pub(crate) struct Excite {
    /// The `.robot` file.
    spec: PathBuf,
    /// The motion: `time,q1..qn,dq1..dqn,ddq1..ddqn`, one period.
    #[arg(long, value_name = "TRAJ.csv")]
    out: PathBuf,
    /// The criterion to optimize.
    #[arg(long, value_enum, default_value_t, conflicts_with = "separate")]
    criterion: CriterionArgument,
    /// Scale columns to unit length: for `--criterion condition` and `e-optimal`.
    #[arg(long, conflicts_with = "separate")]
    unit_columns: bool,
    /// Use the columns of these standard parameters, as many as there are base parameters: condition number and smallest singular value
    /// depend on the choice.
    #[arg(
        long,
        value_name = "NAME,..",
        value_delimiter = ',',
        conflicts_with = "separate"
    )]
    columns: Option<Vec<String>>,
    /// Time after which the motion repeats, s.
    #[arg(
        long,
        value_name = "S",
        allow_negative_numbers = true,
        default_value_t = 10.0
    )]
    period: f64,
    /// Harmonics per joint.
    #[arg(
        long,
        value_name = "N",
        allow_negative_numbers = true,
        default_value_t = 5
    )]
    harmonics: usize,
    /// How the motion begins and ends.
    #[arg(long, value_enum, default_value_t)]
    ends: EndsArgument,
    /// Pose at begin and end, rad or m: `0,0.3,-1.2`.
    #[arg(
        long,
        value_name = "Q1,..",
        allow_hyphen_values = true,
        value_delimiter = ',',
        conflicts_with = "ends"
    )]
    pose: Option<Vec<f64>>,
    /// Values by name, for torque limits and effects that depend on the arm's torque (load-dependent friction, gains, encoder offsets);
    /// without it the spec's values.
    #[arg(long, value_name = "FILE.json")]
    parameters: Option<PathBuf>,
    /// Standard deviation of each joint's torque noise, N m or N; default: proportional to the torque limits if all joints have one, else 1.
    #[arg(
        long,
        value_name = "S1,..",
        allow_hyphen_values = true,
        value_delimiter = ','
    )]
    noise: Option<Vec<f64>>,
    /// Acceleration limits for joints without one in the spec, rad/s^2 or m/s^2: one for all, or one per joint.
    #[arg(
        long,
        value_name = "A1,..",
        allow_hyphen_values = true,
        value_delimiter = ','
    )]
    acceleration: Option<Vec<f64>>,
    /// Balls on links, with planes, a box and a least distance between balls that the motion must keep.
    #[arg(long, value_name = "ROOM.json")]
    room: Option<PathBuf>,
    /// An effect to distinguish from another, with its expected values: `stribeck(vs = 0.1) on elbow: fs = 2`.
    #[arg(long, value_name = "EFFECT", requires = "from")]
    separate: Option<String>,
    /// The other effect.
    #[arg(long, value_name = "EFFECT", requires = "separate")]
    from: Option<String>,
    /// Number of random start motions.
    #[arg(long, value_name = "N", allow_negative_numbers = true, default_value_t = 8, value_parser = clap::value_parser!(u32).range(1..))]
    starts: u32,
    /// Seed of the random motions.
    #[arg(
        long,
        value_name = "N",
        allow_negative_numbers = true,
        default_value_t = 1
    )]
    seed: u64,
    /// Stop after this many seconds with the best motion so far.
    #[arg(long, value_name = "S", allow_negative_numbers = true)]
    budget: Option<f64>,
    /// Rate of the CSV file, Hz.
    #[arg(
        long,
        value_name = "HZ",
        allow_negative_numbers = true,
        default_value_t = 1000.0
    )]
    rate: f64,
    /// Write the coefficients of the harmonics.
    #[arg(long, value_name = "FILE.json")]
    coefficients: Option<PathBuf>,
    /// Draw the motion with its limits.
    #[arg(long, value_name = "FILE.svg")]
    figure: Option<PathBuf>,
    /// Write the criterion values of the motion as JSON.
    #[arg(long, value_name = "FILE.json")]
    json: Option<PathBuf>,
}

/// When a search is said to go on where no terminal shows its time: first after this, then each time that it took twice as long.
const LONG: Duration = Duration::from_secs(20);

#[derive(Debug, Clone, Copy, Default, ValueEnum)]
enum EndsArgument {
    /// At rest, at an optimized pose.
    #[default]
    Rest,
    /// In motion.
    Free,
}

impl Excite {
    pub(crate) fn run(&self) -> Result<(), Error> {
        let started = Instant::now();
        let inputs = [
            Some(&self.spec),
            self.parameters.as_ref(),
            self.room.as_ref(),
        ];
        let mut files = Files::reading(inputs.into_iter().flatten().map(PathBuf::as_path));
        let out = files.claim_for(&self.out, Content::Motion)?;
        let coefficients = files.claim_if(
            self.coefficients.as_deref(),
            Content::Json(Record::Coefficients),
        )?;
        let figure = files.claim_figure(self.figure.as_deref())?;
        let json = files.claim_if(self.json.as_deref(), Content::Json(Record::Excite))?;
        // A period that is none is told by whoever designs with it.
        let is_long = self.period.is_finite() && self.rate * self.period > 1e7;
        if self.rate.is_nan() || self.rate <= 0.0 || is_long {
            return Err(Error::Argument(format!(
                "--rate {}: write a rate in Hz, for at most ten million samples",
                self.rate
            )));
        }
        if let Some(seconds) = self.budget.filter(|s| !(*s > 0.0 && s.is_finite())) {
            return Err(Error::Argument(format!(
                "--budget {seconds}: write a positive number of seconds"
            )));
        }
        let progress = Progress::new();
        let (compiled, rivals) = match (&self.separate, &self.from) {
            (Some(effect), Some(rival)) => {
                let (compiled, rivals) = separate::rivals(&self.spec, effect, rival)?;
                (compiled, Some(rivals))
            }
            _ => (spec::compile(&self.spec)?, None),
        };
        progress.step("compiling the regressor and its slopes");
        let request = self.request(&compiled, rivals.as_ref(), &progress)?;
        let found = search(&request, self.budget, started, &progress);
        let design = found.map_err(|error| match &self.room {
            Some(room) => {
                Error::Argument(format!("{error}; the room is given by {}", room.display()))
            }
            None => error,
        })?;
        // Results say nothing of the clock: the same search writes the same bytes.
        let seconds = started.elapsed().as_secs_f64();
        progress.note(&format!("note: the search took {seconds:.1} s"));
        drop(progress);

        out.commit(output::csv(&design.motion, self.rate).as_bytes())?;
        if let Some(file) = coefficients {
            file.commit(output::coefficients(&request, &design).as_bytes())?;
        }
        if let Some(file) = figure {
            file.commit(figure::svg(&request, &design).as_bytes())?;
        }
        if let Some(file) = json {
            file.commit(output::report(&request, &design).as_bytes())?;
        }
        crate::output::print(&output::summary(&request, &design))
    }
}

/// Searches until it is done, the time is over, or somebody presses Ctrl-C.
fn search(
    request: &Request,
    budget: Option<f64>,
    started: Instant,
    progress: &Progress,
) -> Result<robot_model::excite::Design, Error> {
    let budget = budget.map(|s| Duration::try_from_secs_f64(s).unwrap_or(Duration::MAX));
    let interrupted = Wish::watch();
    let told = Cell::new(0);
    let next = Cell::new(LONG);
    let watch = |search: Search| {
        let took = started.elapsed();
        let is_new = told.replace(search.start) != search.start;
        // A start that ends before its last step leaves less than that.
        let starts = search.start.saturating_sub(1) as f64 + search.part;
        let behind = starts / request.starts as f64;
        let start = format!("start {} of {}", search.start, request.starts);
        if is_new || progress.is_live() {
            let best = search.best.filter(|best| best.is_finite());
            let best = best.map_or_else(String::new, |best| {
                format!(", best value of the criterion so far {best:.3}")
            });
            progress.part(&format!("{start}{best}"), behind);
        } else if took >= next.get() {
            next.set(took * 2);
            let what = format!(
                "{start} goes on, {} s so far; Ctrl-C or `--budget S` ends the search with the best motion so far",
                took.as_secs()
            );
            progress.part(&what, behind);
        }
        !interrupted.is_pressed() && budget.is_none_or(|budget| took < budget)
    };
    let design = request.run(&watch).map_err(|error| refused(&error))?;
    if design.stopped {
        progress.note(&format!(
            "note: stopped after {}",
            counted(design.starts, "start")
        ));
    }
    Ok(design)
}

fn refused(error: &ExciteError) -> Error {
    Error::Argument(error.to_string())
}

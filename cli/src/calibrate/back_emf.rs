//! `calibrate back-emf`: the voltage of a motor that turns.

mod said;

use std::path::PathBuf;

use clap::Args;
use robot_model::calibrate::{CalibrateError, Commanded, MotorVoltage, Windows, with_inductance};
use robot_model_spec::ColumnKind;
use serde::Serialize;

use crate::Error;
use crate::log_settings::LogSettings;
use crate::output::{self, Content, Files, Record};

use super::figure;
use super::table::Table;
use said::{commanded_summary, note_commanded, note_voltage, voltage_summary};

/// Identify a motor's back-EMF constant, and its resistance if its voltage is logged.
///
/// With `--voltage`: `v = R i + k w + v0` by least squares, or by instrumental variables if current or velocity are noisy. Without it: the
/// commanded voltage switches between constants, and `k` is the factor that makes `u + k w` piecewise constant, where `u` is
/// `--current`: amperes, or the voltage across a known resistance. The winding's inductance is ignored without `--time-constant`. With
/// `--position` all channels are means over five samples.
#[derive(Debug, Args)]
#[command(after_help = "Examples:
  robot-model calibrate back-emf log.csv --current i --velocity w --voltage v
  robot-model calibrate back-emf log.csv --current u --position q1 --figure wave.svg")]
pub(crate) struct BackEmf {
    /// A CSV log with a header.
    log: PathBuf,
    /// The column of the current, A, or of the voltage across a known resistance.
    #[arg(long, value_name = "COLUMN")]
    current: String,
    /// The column of the velocity, rad/s.
    #[arg(long, value_name = "COLUMN", required_unless_present = "position")]
    velocity: Option<String>,
    /// The column of the position, rad, instead of a velocity.
    #[arg(long, value_name = "COLUMN", conflicts_with = "velocity")]
    position: Option<String>,
    /// The column of the voltage at the motor's terminals, V.
    #[arg(long, value_name = "COLUMN")]
    voltage: Option<String>,
    /// The column of time, s.
    #[arg(long, value_name = "COLUMN", default_value = "time")]
    time: String,
    /// Electric time constant of the winding, L/R, s; without it the inductance is ignored.
    #[arg(
        long,
        value_name = "S",
        default_value_t = 0.0,
        allow_negative_numbers = true
    )]
    time_constant: f64,
    #[command(flatten)]
    log_settings: LogSettings,
    /// Write the result as JSON.
    #[arg(long, value_name = "FILE")]
    json: Option<PathBuf>,
    /// Current, velocity and voltage over time.
    #[arg(long, value_name = "FILE.svg")]
    figure: Option<PathBuf>,
}

#[derive(Serialize)]
struct VoltageReport {
    resistance: f64,
    resistance_std: f64,
    resistance_interval: [f64; 2],
    back_emf: f64,
    back_emf_std: f64,
    back_emf_interval: [f64; 2],
    offset: f64,
    offset_std: f64,
    offset_interval: [f64; 2],
    #[serde(skip_serializing_if = "Option::is_none")]
    least_squares: Option<[f64; 3]>,
    /// Shares by which resistance and back-EMF are too large for each second of an electric time constant that is left out.
    by_time_constant: Option<[f64; 2]>,
    residual_std: f64,
    current_velocity_r: f64,
    samples: usize,
}

#[derive(Serialize)]
struct CommandedReport {
    back_emf: f64,
    back_emf_std: f64,
    back_emf_interval: [f64; 2],
    attenuation_percent: f64,
    /// Share by which the back-EMF is too large for each second of an electric time constant that is left out.
    by_time_constant: f64,
    residual_std: f64,
    samples: usize,
    held_percent: f64,
    explained_percent: f64,
    by_jumps_percent: f64,
    levels: Vec<Constant>,
    switches: Vec<f64>,
}

#[derive(Serialize)]
struct Constant {
    start: f64,
    end: f64,
    level: f64,
}

/// Where a velocity comes from.
enum Motion {
    Logged(Vec<f64>),
    Windows(Windows),
}

impl BackEmf {
    pub(crate) fn run(&self) -> Result<(), Error> {
        let motion = match (&self.velocity, &self.position) {
            (Some(velocity), _) => ("--velocity", velocity.as_str(), ColumnKind::AngularSpeed),
            (None, Some(position)) => ("--position", position.as_str(), ColumnKind::Angle),
            (None, None) => unreachable!("one of both is required"),
        };
        let mut wanted = vec![
            ("--time", self.time.as_str(), ColumnKind::Time),
            ("--current", self.current.as_str(), ColumnKind::Current),
            motion,
        ];
        wanted.extend(
            self.voltage
                .as_deref()
                .map(|column| ("--voltage", column, ColumnKind::Voltage)),
        );
        let settings = &self.log_settings;
        let mut files = Files::reading([self.log.as_path()]).and(settings.files([&self.log]));
        let json = files.claim_if(self.json.as_deref(), Content::Json(Record::BackEmf))?;
        let figure = files.claim_figure(self.figure.as_deref())?;
        let table = Table::read(&self.log, &wanted, settings)?;
        let refused = |error: CalibrateError| table.refused(&error);
        let [time, current, moved, voltage @ ..] = &table.columns[..] else {
            unreachable!("as many columns as were asked for");
        };
        if !self.time_constant.is_finite() || self.time_constant < 0.0 {
            return Err(Error::Argument(format!(
                "`--time-constant` is L/R of the winding in seconds, not {}",
                self.time_constant
            )));
        }
        let current = with_inductance(time, current, self.time_constant).map_err(refused)?;
        let current = &current;
        let motion = match &self.velocity {
            Some(_) => Motion::Logged(moved.clone()),
            None => Motion::Windows(Windows::new(time, moved).map_err(refused)?),
        };
        let results = if let Some(voltage) = voltage.first() {
            of_voltage(&motion.curves(time, current, Some(voltage)))
        } else {
            of_commands(&motion, time, current)
        };
        let results = results.map_err(refused)?;
        if let Some(file) = json {
            file.commit(results.json.as_bytes())?;
        }
        if let Some(file) = figure {
            file.commit(results.picture.as_bytes())?;
        }
        output::print(&results.summary)
    }
}

/// What is written and printed.
struct Results {
    json: String,
    picture: String,
    summary: String,
}

fn of_voltage(curves: &Curves) -> Result<Results, CalibrateError> {
    let [current, velocity, voltage] = &curves.of[..] else {
        unreachable!("a voltage beside current and velocity");
    };
    let found = MotorVoltage::fit(&curves.time, current, velocity, voltage)?;
    note_voltage(&found);
    Ok(Results {
        json: output::json(&voltage_report(&found)),
        picture: figure::curves(&curves.time, &with_voltage(curves, &found)),
        summary: voltage_summary(&found),
    })
}

fn of_commands(motion: &Motion, time: &[f64], u: &[f64]) -> Result<Results, CalibrateError> {
    let found = match motion {
        Motion::Logged(velocity) => Commanded::find(time, u, velocity)?,
        Motion::Windows(windows) => Commanded::find_in(windows, u)?,
    };
    note_commanded(&found);
    let curves = motion.curves(time, u, None);
    Ok(Results {
        json: output::json(&commanded_report(&found)),
        picture: figure::curves(&curves.time, &with_commanded(&curves, &found)),
        summary: commanded_summary(&found),
    })
}

/// Channels of one grid: current, velocity, and the voltage where it is logged.
struct Curves {
    time: Vec<f64>,
    of: Vec<Vec<f64>>,
}

impl Motion {
    fn curves(&self, time: &[f64], current: &[f64], voltage: Option<&[f64]>) -> Curves {
        // All on the windows of the velocity: what is averaged beside what is not fakes an inductance.
        let (time, velocity) = match self {
            Self::Logged(velocity) => (time.to_vec(), velocity.clone()),
            Self::Windows(windows) => (windows.time.clone(), windows.velocity.clone()),
        };
        let on_grid = |channel: &[f64]| match self {
            Self::Logged(_) => channel.to_vec(),
            Self::Windows(windows) => windows.means(channel),
        };
        let mut of = vec![on_grid(current), velocity];
        of.extend(voltage.map(on_grid));
        Curves { time, of }
    }
}

fn with_voltage(curves: &Curves, found: &MotorVoltage) -> Vec<figure::Curve> {
    let curve = |name, values: &[f64], over: Option<&[f64]>| figure::Curve {
        name,
        values: values.to_vec(),
        over: over.map(<[f64]>::to_vec),
    };
    vec![
        curve("current, A", &curves.of[0], None),
        curve("velocity, rad/s", &curves.of[1], None),
        curve(
            "voltage, V, and that of the equation",
            &curves.of[2],
            Some(&found.fitted),
        ),
    ]
}

fn with_commanded(curves: &Curves, found: &Commanded) -> Vec<figure::Curve> {
    let curve = |name, values: &[f64], over| figure::Curve {
        name,
        values: values.to_vec(),
        over,
    };
    let switches = found.switches();
    let level = |t: &f64| {
        let passed = switches.iter().filter(|switch| *switch <= t).count();
        found.pieces[passed].level
    };
    let levels = curves.time.iter().map(level).collect();
    vec![
        curve("u, as given", &curves.of[0], None),
        curve("velocity w, rad/s", &curves.of[1], None),
        curve(
            "v = u + k w, and its constants",
            &found.voltage,
            Some(levels),
        ),
    ]
}

fn voltage_report(found: &MotorVoltage) -> VoltageReport {
    VoltageReport {
        resistance: found.resistance.value,
        resistance_std: found.resistance.std,
        resistance_interval: found.resistance.interval,
        back_emf: found.back_emf.value,
        back_emf_std: found.back_emf.std,
        back_emf_interval: found.back_emf.interval,
        offset: found.offset.value,
        offset_std: found.offset.std,
        offset_interval: found.offset.interval,
        least_squares: found.least_squares,
        by_time_constant: found.by_time_constant,
        residual_std: found.residual_std,
        current_velocity_r: found.alike,
        samples: found.samples,
    }
}

fn commanded_report(found: &Commanded) -> CommandedReport {
    let level = |piece: &robot_model::calibrate::Piece| Constant {
        start: piece.start,
        end: piece.end,
        level: piece.level,
    };
    CommandedReport {
        back_emf: found.back_emf.value,
        back_emf_std: found.back_emf.std,
        back_emf_interval: found.back_emf.interval,
        attenuation_percent: found.attenuation,
        by_time_constant: found.by_time_constant,
        residual_std: found.residual_std,
        samples: found.samples,
        held_percent: found.held,
        explained_percent: found.explained,
        by_jumps_percent: found.by_jumps,
        levels: found.pieces.iter().map(level).collect(),
        switches: found.switches(),
    }
}

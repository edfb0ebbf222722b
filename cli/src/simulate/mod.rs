//! `robot-model simulate`: the log of an arm that moves under a controller.

mod record;
pub(crate) mod table;

use std::f64::consts::TAU;
use std::path::{Path, PathBuf};

use clap::{Args, ValueEnum};
use robot_model::simulate::{
    ComputedTorque, Controller, Desired, Gains, Loop, Measured, Pd, Sensors, Torques, Trajectory,
};
use robot_model_codegen::expr::Symbol;
use robot_model_codegen::{Compiled, Given};
use serde::Serialize;

use crate::Error;
use crate::interpreted::InterpretedPlant;
use crate::output::{self, Content, Files, Record};
use crate::parameters::{self, Values};
use crate::progress::Progress;
use crate::spec::compile;

/// Simulate an arm with all declared effects, with or without a controller, and write its log.
#[derive(Debug, Args)]
#[command(
    allow_negative_numbers = true,
    after_help = "Examples:
  robot-model simulate arm.robot --trajectory motion.csv --parameters fit.json --out log.csv
  robot-model simulate arm.robot --trajectory motion.csv --controller computed-torque --encoder-bits 17 --torque-noise 0.02 --out log.csv
  robot-model simulate arm.robot --trajectory start.csv --controller none --duration 5 --out fall.csv"
)]
pub(crate) struct Simulate {
    /// The `.robot` file.
    spec: PathBuf,
    /// Desired motion, CSV: `time,q1..qn[,dq1..][,ddq1..][,extra]`, SI units; missing derivatives come from a spline, extra columns are
    /// channels that effects read. The arm starts at its first row.
    #[arg(long, value_name = "TRAJ.csv")]
    trajectory: PathBuf,
    /// Parameter values by name, or what `identify --json` writes; without it the spec's own values.
    #[arg(long, value_name = "FILE.json")]
    parameters: Option<PathBuf>,
    /// The log to write: CSV, `time,q1..qn,dq1..dqn,tau1..taun[,extra]`; if its name ends in `.mcap`, a bag of ROS 2 with joint states.
    #[arg(long, value_name = "LOG.csv|LOG.mcap")]
    out: PathBuf,
    /// The controller.
    #[arg(long, value_enum, default_value_t)]
    controller: ControllerArgument,
    /// Torques to apply instead of a controller, CSV: `time,tau1..taun`, joint torques in N m or N.
    #[arg(long, value_name = "FILE.csv", conflicts_with = "controller")]
    torque: Option<PathBuf>,
    /// Natural frequency of the controller's error, rad/s; default 60.
    #[arg(long, value_name = "W", allow_negative_numbers = true)]
    frequency: Option<f64>,
    /// Damping ratio of the controller's error; default 1 (critical).
    #[arg(long, value_name = "D", allow_negative_numbers = true)]
    damping: Option<f64>,
    /// The controller's own parameter values; without it those of the arm.
    #[arg(long, value_name = "FILE.json")]
    control_parameters: Option<PathBuf>,
    /// Sample rate of the controller, Hz; its torque is held between samples.
    #[arg(
        long,
        value_name = "HZ",
        allow_negative_numbers = true,
        default_value_t = 1000.0
    )]
    rate: f64,
    /// Sample rate of the log, Hz; default: that of the controller.
    #[arg(long, value_name = "HZ", allow_negative_numbers = true)]
    log_rate: Option<f64>,
    /// Delay of the torque, in samples of the controller; its first torque acts until then.
    #[arg(
        long,
        value_name = "SAMPLES",
        allow_negative_numbers = true,
        default_value_t = 0
    )]
    delay: u16,
    /// Duration, s; default: that of the trajectory, whose end is held beyond.
    #[arg(long, value_name = "S", allow_negative_numbers = true)]
    duration: Option<f64>,
    /// Encoders with 2^BITS steps per turn (prismatic joints: per meter); without it positions are exact.
    #[arg(long, value_name = "BITS", allow_negative_numbers = true, value_parser = clap::value_parser!(u8).range(4..=40))]
    encoder_bits: Option<u8>,
    /// Standard deviation of the noise of positions, rad or m.
    #[arg(
        long,
        value_name = "SIGMA",
        allow_negative_numbers = true,
        default_value_t = 0.0
    )]
    position_noise: f64,
    /// Standard deviation of the noise of logged torques, as a share of each joint's root mean square; half white, half correlated
    /// over 4 ms.
    #[arg(
        long,
        value_name = "SHARE",
        allow_negative_numbers = true,
        default_value_t = 0.0
    )]
    torque_noise: f64,
    /// Seed of all noise: the same seed gives the same log.
    #[arg(long, default_value_t = 1)]
    seed: u64,
    /// Write the effort of the simulation and the tracking error as JSON.
    #[arg(long, value_name = "FILE")]
    json: Option<PathBuf>,
}

#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, ValueEnum)]
enum ControllerArgument {
    /// Each joint alone, with gains for its smallest inertia along the motion with all other joints free.
    #[default]
    Pd,
    /// The model's torque for the desired motion, and PD on the error.
    ComputedTorque,
    /// No torque: the arm falls freely.
    None,
}

/// No torque at all.
struct Idle;

impl Controller for Idle {
    fn torque(&mut self, _: &Measured<'_>, _: &Desired, torque: &mut [f64]) {
        torque.fill(0.0);
    }
}

#[derive(Serialize)]
struct Report {
    samples: usize,
    seconds: f64,
    /// Largest distance of each joint from the trajectory, rad or m.
    tracking_error: Vec<f64>,
    /// Change of energy relative to the largest kinetic energy; of arms without torques and effects alone.
    #[serde(skip_serializing_if = "Option::is_none")]
    energy_drift: Option<f64>,
    /// Stops, reversals, breakaways and other jumps.
    events: u64,
    explicit_steps: u64,
    implicit_steps: u64,
    impulse_steps: u64,
    rejected_steps: u64,
    evaluations: u64,
}

impl Simulate {
    pub(crate) fn run(&self) -> Result<(), Error> {
        let inputs = [Some(&self.spec), Some(&self.trajectory)];
        let more = [&self.parameters, &self.control_parameters, &self.torque];
        let inputs = inputs.into_iter().chain(more.map(Option::as_ref)).flatten();
        let mut files = Files::reading(inputs.map(PathBuf::as_path));
        let out = files.claim_for(&self.out, Content::Simulation)?;
        let json = files.claim_if(self.json.as_deref(), Content::Json(Record::Simulate))?;
        if self.control_parameters.is_some()
            && self.controller != ControllerArgument::ComputedTorque
        {
            return Err(Error::Argument(
                "`--control-parameters` belongs to `--controller computed-torque`; other controllers have no model"
                    .to_owned(),
            ));
        }
        let has_gains = self.torque.is_none() && self.controller != ControllerArgument::None;
        let gains = [("--frequency", self.frequency), ("--damping", self.damping)];
        if let (false, Some((option, _))) =
            (has_gains, gains.iter().find(|(_, gain)| gain.is_some()))
        {
            return Err(Error::Argument(format!(
                "`{option}` belongs to `--controller pd` and `computed-torque`; nothing else has gains"
            )));
        }

        record::check(&self.out)?;
        let progress = Progress::new();
        progress.step(&format!("compiling {}", self.spec.display()));
        let compiled = compile(&self.spec)?;
        if let (true, Some(channel)) = (record::is_bag(&self.out), compiled.model.inputs().first())
        {
            return Err(Error::Argument(format!(
                "{}: a declared effect reads `{channel}`, which joint states cannot hold; write the log as CSV",
                self.out.display()
            )));
        }
        let trajectory = table::trajectory(&self.trajectory, compiled.dof())?;
        let mut setting = self.set_up(&compiled, &trajectory)?;
        let (mut plant, shapes) = arm(&compiled, self.parameters.as_deref())?;
        if let Some(delay) = compiled.delay() {
            setting.torque_delay = delay.eval(&|symbol| match symbol {
                Symbol::Shape(k) => shapes[k],
                _ => unreachable!("checked in model-spec: a delay is constant"),
            })[0];
        }
        let mut controller = self.controller(&compiled, &plant, &trajectory, &setting)?;
        let is_free = self.controller == ControllerArgument::None
            && self.torque.is_none()
            && compiled.model.effects.is_empty();
        let start = trajectory.at(0.0);
        let before = is_free.then(|| plant.energies(&start.q, &start.dq));

        let mut told = 0.0;
        let whole = output::rounded(setting.duration);
        let pause = setting.duration * if progress.is_live() { 0.01 } else { 0.1 };
        let mut tell = |time: f64| {
            if time == 0.0 || time >= told + pause {
                told = time;
                let what = format!("simulating: {time:.1} s of {whole} s");
                progress.part(&what, time / setting.duration);
            }
        };
        let run = setting.run(plant, controller.as_mut(), &trajectory, &mut tell);
        let (record, mut end) =
            run.map_err(|error| Error::Argument(format!("{}: {error}", compiled.model.source)))?;
        let drift = before.map(|before| {
            let (q, dq) = (end.q().to_vec(), end.dq().to_vec());
            let after = end.plant_mut().energies(&q, &dq);
            let changed = (after[0] + after[1] - before[0] - before[1]).abs();
            let scale = before[0].max(after[0]).max((after[1] - before[1]).abs());
            if scale > 0.0 { changed / scale } else { 0.0 }
        });
        let report = Report {
            samples: record.time.len(),
            seconds: setting.duration,
            tracking_error: record.tracking.clone(),
            energy_drift: drift,
            events: record.work.events,
            explicit_steps: record.work.explicit,
            implicit_steps: record.work.implicit,
            impulse_steps: record.work.impulses,
            rejected_steps: record.work.rejected,
            evaluations: record.work.evaluations,
        };
        for note in record::beyond_limits(&compiled.model, &trajectory, &record) {
            progress.note(&note);
        }
        let log = record::log(&self.out, &record, &compiled.model)?;
        let said = record::summary(&self.out, &report, &compiled.model.joints);
        drop(progress);
        out.commit(&log)?;
        if let Some(json) = json {
            json.commit(output::json(&report).as_bytes())?;
        }
        output::print(&said)
    }

    fn set_up(&self, compiled: &Compiled, trajectory: &Trajectory) -> Result<Loop, Error> {
        let channels = compiled.model.inputs();
        let inputs = channels.iter().map(|name| {
            let place = trajectory
                .extra()
                .iter()
                .position(|channel| channel.name == *name);
            place.ok_or_else(|| {
                Error::Argument(format!(
                    "{}: it has no column `{name}`, which a declared effect reads",
                    self.trajectory.display()
                ))
            })
        });
        let joints = &compiled.model.joints;
        Ok(Loop {
            rate: self.rate,
            log_rate: self.log_rate.unwrap_or(self.rate),
            delay: usize::from(self.delay),
            duration: self.duration.unwrap_or_else(|| trajectory.duration()),
            sensors: Sensors {
                encoder_step: self
                    .encoder_bits
                    .map_or(0.0, |bits| TAU / 2_f64.powi(i32::from(bits))),
                position_noise: self.position_noise,
                torque_noise: self.torque_noise,
                // High enough to leave the gains their damping, low enough to smooth steps of encoders.
                velocity_hz: self.rate / 20.0,
                seed: self.seed,
            },
            actuator_gain: joints.iter().map(|joint| joint.actuator_gain).collect(),
            inputs: inputs.collect::<Result<_, Error>>()?,
            ..Loop::default()
        })
    }

    fn controller(
        &self,
        compiled: &Compiled,
        plant: &InterpretedPlant,
        trajectory: &Trajectory,
        setting: &Loop,
    ) -> Result<Box<dyn Controller>, Error> {
        let argument =
            |error: robot_model::simulate::SimulateError| Error::Argument(error.to_string());
        let gains = || {
            let (frequency, damping) =
                (self.frequency.unwrap_or(60.0), self.damping.unwrap_or(1.0));
            Gains::new(frequency, damping).map_err(argument)
        };
        if let Some(path) = &self.torque {
            let torques: Torques = table::torques(path, compiled.dof())?;
            return Ok(Box::new(torques));
        }
        Ok(match self.controller {
            ControllerArgument::None => Box::new(Idle),
            ControllerArgument::Pd => {
                let inertia = least_inertia(plant, trajectory, setting);
                Box::new(Pd::new(gains()?, inertia))
            }
            ControllerArgument::ComputedTorque => {
                let model = match &self.control_parameters {
                    Some(file) => arm(compiled, Some(file))?.0,
                    None => plant.clone(),
                };
                Box::new(ComputedTorque::new(gains()?, model))
            }
        })
    }
}

/// The least inertia of each joint along a motion, all others free: what its sampled controller has to be soft enough for.
fn least_inertia(plant: &InterpretedPlant, trajectory: &Trajectory, setting: &Loop) -> Vec<f64> {
    /// Poses along the motion.
    const POSES: u32 = 100;
    let mut plant = plant.clone();
    let mut least = vec![f64::INFINITY; trajectory.dof()];
    for pose in 0..=POSES {
        let time = trajectory.duration() * f64::from(pose) / f64::from(POSES);
        let inputs = setting.inputs.iter();
        let inputs: Vec<f64> = inputs.map(|&k| trajectory.channel(k, time)).collect();
        let here = plant.free_inertia(&trajectory.at(time).q, &inputs);
        for (least, here) in least.iter_mut().zip(here) {
            *least = least.min(here);
        }
    }
    // A joint without any inertia has no motion, which the simulation says.
    least
        .into_iter()
        .map(|x| if x.is_finite() { x } else { 0.0 })
        .collect()
}

/// The arm with the values of a file, or of its spec; its shape parameters.
fn arm(compiled: &Compiled, file: Option<&Path>) -> Result<(InterpretedPlant, Vec<f64>), Error> {
    let plant = |compiled: Compiled, values: Values| {
        let plant = InterpretedPlant::new(compiled, &values.beta, &values.shapes)?;
        Ok((plant, values.shapes))
    };
    let moves_apart = compiled.displacements().is_some() && !compiled.mixed().is_empty();
    if !moves_apart && !compiled.parts_motors() {
        return plant(compiled.clone(), parameters::resolve(compiled, file)?);
    }
    // Motors and links move apart, or friction knows the load of the links: numbers for both together do not do, and are told, or the
    // spec's nominal values part them.
    let ungrouped = compiled.ungrouped();
    match parameters::resolve(&ungrouped, file) {
        Ok(values) => plant(ungrouped, values),
        Err(error) => match parameters::resolve(compiled, file) {
            Ok(values) if values.given == Given::Base => plant(compiled.clone(), values),
            _ => Err(error),
        },
    }
}

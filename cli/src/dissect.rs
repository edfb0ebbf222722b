//! `robot-model dissect`: of what the torques along a log are made.

use std::fmt::Write;
use std::path::PathBuf;

use clap::Args;
use robot_model::columns::{Arm, Columns, Entry};
use robot_model::identify::IdentifyError;
use robot_model::log::Log;
use robot_model::motion::Motion;
use robot_model::signal::{Bands, prepare};
use robot_model_codegen::Compiled;
use robot_model_spec::parameter::Owner;
use serde::Serialize;

use crate::Error;
use crate::interpreted::InterpretedArm;
use crate::log_settings::LogSettings;
use crate::output::{self, Content, Files, Record};
use crate::parameters;
use crate::progress::Progress;
use crate::spec::{compile_instantaneous, read_log};

/// What is cut at both ends of a log, s: filters see one side only there.
const BORDER_S: f64 = 1.0;

/// Split the torques along a log into inertia, Coriolis and centrifugal torque, gravity, each effect and the residual: root mean squares per joint.
#[derive(Debug, Args)]
#[command(after_help = "Examples:
  robot-model dissect arm.robot monday.csv --parameters fit.json")]
pub(crate) struct Dissect {
    /// The `.robot` file.
    spec: PathBuf,
    /// The log: CSV (plain or gzip) or Parquet, `time,q1..qn[,dq1..dqn],tau1..taun[,extra..]`, SI units, or as the spec's `log` or a `robot-model.toml` has them;
    /// or MCAP, a bag of ROS 2 with joint states.
    log: PathBuf,
    #[command(flatten)]
    log_settings: LogSettings,
    /// Parameter values by name, or what `identify --json` writes; without it the spec's own values.
    #[arg(long, value_name = "FILE.json")]
    parameters: Option<PathBuf>,
    /// Write the result as JSON.
    #[arg(long, value_name = "FILE")]
    json: Option<PathBuf>,
}

/// A share's torques, `[joint][sample]`.
struct Share {
    name: String,
    torque: Vec<Vec<f64>>,
}

/// What `--json` writes; a contract.
#[derive(Serialize)]
struct Report<'a> {
    robot: &'a str,
    joints: &'a [String],
    /// Seconds of the log that count.
    seconds: f64,
    /// Root mean squares of the measured torques, N m or N.
    measured: Vec<f64>,
    /// Root mean squares of the sum of the shares but the last, N m or N.
    model: Vec<f64>,
    /// `inertia`, `coriolis`, `gravity`, `JOINT.EFFECT` ..., and `rest`: all of them sum to the measured torque.
    shares: Vec<ShareReport<'a>>,
}

#[derive(Serialize)]
struct ShareReport<'a> {
    name: &'a str,
    /// Root mean squares, N m or N.
    rms: Vec<f64>,
    /// Of the measured torque's; none where that is zero.
    percent: Vec<Option<f64>>,
}

impl Dissect {
    pub(crate) fn run(&self) -> Result<(), Error> {
        let compiled = compile_instantaneous(&self.spec)?;
        let inputs = [&self.spec, &self.log].into_iter().chain(&self.parameters);
        let settings = &self.log_settings;
        let mut files =
            Files::reading(inputs.map(PathBuf::as_path)).and(settings.files([&self.log]));
        let json = files.claim_if(self.json.as_deref(), Content::Json(Record::Dissect))?;
        let values = parameters::resolve(&compiled, self.parameters.as_deref())?;
        let progress = Progress::new();
        let log = read_log(&self.log, &compiled.model, settings, &progress)?;
        drop(progress);

        let free = compiled.free_shapes();
        let shapes: Vec<f64> = free.iter().map(|&k| values.shapes[k]).collect();
        let arm = InterpretedArm::new(compiled);
        check_channels(&arm, &log)?;
        let prepared = prepare(&log, &Bands::for_log(&log)).map_err(IdentifyError::from)?;
        let mut motion = prepared.motion;
        let mut shares = shares(&arm, &mut motion, &shapes, &values.beta);
        let model = sum(&shares, arm.dof(), motion.time.len());
        let measured = measured(&arm, &motion);
        shares.push(Share {
            name: "rest".to_owned(),
            torque: difference(&measured, &model),
        });

        let count = motion.time.len();
        let border = motion.time.iter().take_while(|&&t| t < BORDER_S).count();
        let border = border.min(count / 4);
        let rms = |torque: &[Vec<f64>]| -> Vec<f64> {
            let of = |values: &Vec<f64>| root_mean_square(&values[border..count - border]);
            torque.iter().map(of).collect()
        };
        let whole = rms(&measured);
        let shares: Vec<ShareReport> = shares
            .iter()
            .map(|share| {
                let rms = rms(&share.torque);
                let percent = rms.iter().zip(&whole);
                ShareReport {
                    name: &share.name,
                    percent: percent
                        .map(|(rms, whole)| (*whole > 0.0).then(|| 100.0 * rms / whole))
                        .collect(),
                    rms,
                }
            })
            .collect();
        let report = Report {
            robot: &arm.compiled().model.name,
            joints: arm.joints(),
            seconds: (count - 2 * border) as f64 / prepared.rate_hz,
            model: rms(&model),
            measured: whole,
            shares,
        };
        if let Some(share) = report
            .shares
            .iter()
            .find(|share| share.rms.iter().any(|x| !x.is_finite()))
        {
            return Err(Error::Argument(format!(
                "{}: the torque of `{}` is not finite along the log; change the parameters, or give a log of a motion that the arm can make",
                log.source, share.name
            )));
        }
        if let Some(file) = json {
            file.commit(output::json(&report).as_bytes())?;
        }
        output::print(&table(&report))
    }
}

/// Effects may read channels, which the log must have.
pub(crate) fn check_channels(arm: &InterpretedArm, log: &Log) -> Result<(), Error> {
    let is_there = |name: &&String| !log.extra.iter().any(|channel| channel.name == **name);
    match arm.inputs().iter().find(is_there) {
        None => Ok(()),
        Some(channel) => Err(Error::Identify(IdentifyError::NoChannel {
            source_name: log.source.clone(),
            channel: channel.clone(),
        })),
    }
}

/// Shares of the model's torque; the motion is given its load.
fn shares(arm: &InterpretedArm, motion: &mut Motion, shapes: &[f64], beta: &[f64]) -> Vec<Share> {
    motion.rigid_torque = arm.rigid_torque(motion, shapes, beta);
    motion.transmitted_torque = arm.transmitted_torque(motion, shapes, beta);
    let compiled = arm.compiled();
    let (dof, samples) = (arm.dof(), motion.time.len());
    let effect = |entry: &Entry| effect_of(compiled, entry.column);
    let add = |torque: &mut Vec<Vec<f64>>, entry: &Entry| {
        let sum = torque[entry.joint].iter_mut().zip(&entry.values);
        sum.for_each(|(sum, value)| *sum += beta[entry.column] * value);
    };
    let rigid = |motion: &Motion, entries: &[Entry]| {
        let mut torque = vec![vec![0.0; samples]; dof];
        for (sum, known) in torque.iter_mut().zip(arm.known_torque(motion, shapes)) {
            sum.iter_mut()
                .zip(known)
                .for_each(|(sum, known)| *sum += known);
        }
        for entry in entries.iter().filter(|entry| effect(entry).is_none()) {
            add(&mut torque, entry);
        }
        torque
    };

    let entries = arm.entries(motion, shapes);
    let moving = rigid(motion, &entries);
    let mut slower = motion.clone();
    still(&mut slower.smooth.ddq);
    still(&mut slower.wide.ddq);
    let coasting = rigid(&slower, &arm.entries(&slower, shapes));
    still(&mut slower.smooth.dq);
    still(&mut slower.wide.dq);
    let gravity = rigid(&slower, &arm.entries(&slower, shapes));
    let share = |name: &str, torque| Share {
        name: name.to_owned(),
        torque,
    };
    let mut shares = vec![
        share("inertia", difference(&moving, &coasting)),
        share("coriolis", difference(&coasting, &gravity)),
        share("gravity", gravity),
    ];
    for k in 0..compiled.model.effects.len() {
        let mut torque = vec![vec![0.0; samples]; dof];
        let own: Vec<&Entry> = entries
            .iter()
            .filter(|entry| effect(entry) == Some(k))
            .collect();
        // What regroups into links has no columns of its own.
        if !own.is_empty() {
            for entry in own {
                add(&mut torque, entry);
            }
            shares.push(share(&compiled.model.effect_name(k), torque));
        }
    }
    shares
}

/// The declared effect whose parameter a base parameter is.
fn effect_of(compiled: &Compiled, column: usize) -> Option<usize> {
    match compiled.standard[compiled.base.kept[column]].owner {
        Owner::Effect { effect, .. } => Some(effect),
        Owner::Link { .. } | Owner::Monomial(_) => None,
    }
}

fn still(channels: &mut [Vec<f64>]) {
    for values in channels {
        values.fill(0.0);
    }
}

/// Logged torques in N m or N.
fn measured(arm: &InterpretedArm, motion: &Motion) -> Vec<Vec<f64>> {
    let channels = motion.tau.iter().zip(arm.actuator_gain());
    channels
        .map(|(tau, gain)| tau.iter().map(|tau| gain * tau).collect())
        .collect()
}

fn sum(shares: &[Share], dof: usize, samples: usize) -> Vec<Vec<f64>> {
    let mut sum = vec![vec![0.0; samples]; dof];
    for share in shares {
        for (sum, values) in sum.iter_mut().zip(&share.torque) {
            sum.iter_mut()
                .zip(values)
                .for_each(|(sum, value)| *sum += value);
        }
    }
    sum
}

fn difference(left: &[Vec<f64>], right: &[Vec<f64>]) -> Vec<Vec<f64>> {
    let channels = left.iter().zip(right);
    channels
        .map(|(left, right)| {
            left.iter()
                .zip(right)
                .map(|(left, right)| left - right)
                .collect()
        })
        .collect()
}

fn root_mean_square(values: &[f64]) -> f64 {
    (values.iter().map(|value| value * value).sum::<f64>() / values.len() as f64).sqrt()
}

/// Shares that a joint has, joint by joint.
fn table(report: &Report) -> String {
    let names = report.shares.iter().map(|share| share.name.len());
    let width = names.chain(["measured".len()]).max().unwrap_or(0);
    let joint_width = report
        .joints
        .iter()
        .map(String::len)
        .max()
        .unwrap_or(0)
        .max("joint".len());
    let mut text = format!(
        "RMS over {:.1} s, N m (prismatic joints: N), first and last second cut; share of the measured torque\n",
        report.seconds
    );
    let mut line = |joint: &str, name: &str, rms: f64, percent: Option<f64>| {
        let percent = percent.map_or_else(
            || format!("{:>8}  ", "-"),
            |share| format!("{share:>8.2} %"),
        );
        writeln!(
            text,
            "{joint:joint_width$}  {name:width$}  {rms:>10.4}  {percent}"
        )
        .expect("a string takes all");
    };
    for (k, joint) in report.joints.iter().enumerate() {
        line(
            joint,
            "measured",
            report.measured[k],
            (report.measured[k] > 0.0).then_some(100.0),
        );
        for share in &report.shares {
            let is_of_all = !share.name.contains('.');
            if is_of_all || share.rms[k] > 0.0 {
                line("", share.name, share.rms[k], share.percent[k]);
            }
        }
    }
    text
}

#[cfg(test)]
mod tests {
    use robot_model::identify::torque_of;

    use super::*;

    /// The shares of an arm with load-dependent friction and a fixed body sum to the torque of the model.
    #[test]
    fn shares_sum_to_the_torque_of_the_model() {
        let text = "robot Loaded {
    gravity = [0, -9.81, 0];
    convention = standard_dh;
    joint first: revolute { a = 0.4; alpha = 0; d = 0; }
    joint second: revolute { a = 0.3; alpha = 0; d = 0; }
    link second: fixed { mass = 2; com = [-0.1, 0, 0]; inertia = [0.05, 0, 0, 0.1, 0, 0.1]; }
    effects { load_dependent_friction on all; coulomb_friction on all; motor_inertia on second; }
}
";
        let model = robot_model_spec::load("loaded.robot", text).expect("a sound spec");
        let arm = InterpretedArm::new(robot_model_codegen::compile_model(&model));
        let time: Vec<f64> = (0..2000).map(|k| 0.002 * f64::from(k)).collect();
        let wave = |w: f64| time.iter().map(|t| (w * t).sin()).collect::<Vec<f64>>();
        let log = Log::from_samples(
            "test",
            time.clone(),
            vec![wave(3.0), wave(4.1)],
            vec![wave(1.0), wave(2.0)],
        );
        let log = log.expect("samples are in order");
        let mut motion = prepare(&log, &Bands::for_log(&log))
            .expect("long enough")
            .motion;
        let beta: Vec<f64> = (0..arm.unknowns().len())
            .map(|k| 0.3 + 0.1 * k as f64)
            .collect();
        let shares = shares(&arm, &mut motion, &[], &beta);
        let names: Vec<&str> = shares.iter().map(|share| share.name.as_str()).collect();
        assert!(
            names.contains(&"second.load_dependent_friction"),
            "{names:?}"
        );
        let found = sum(&shares, 2, motion.time.len());
        let mut wanted = torque_of(&arm, &motion, &[], &beta, 2);
        for (torque, known) in wanted.iter_mut().zip(arm.known_torque(&motion, &[])) {
            torque
                .iter_mut()
                .zip(known)
                .for_each(|(torque, known)| *torque += known);
        }
        let all = shares
            .iter()
            .flat_map(|share| share.torque.iter().flatten());
        let largest = all.fold(0.0_f64, |most, x| most.max(x.abs()));
        for (found, wanted) in found.iter().flatten().zip(wanted.iter().flatten()) {
            assert!((found - wanted).abs() < 1e-12 * largest, "{found} {wanted}");
        }
    }
}

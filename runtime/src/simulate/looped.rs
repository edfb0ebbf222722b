//! The sampled loop around a plant, and its log.

use std::collections::VecDeque;

use super::controller::{Controller, Measured};
use super::error::SimulateError;
use super::integrate::{Integrator, Tolerances, Work};
use super::motion::Drive;
use super::noise::{Noise, Sensors};
use super::plant::{Instant, Plant};
use super::trajectory::Trajectory;
use crate::log::{Channel, MOST_NUMBERS};
use crate::signal::resample::whole_steps;

/// What most settings may be.
const UP_TO_A_MILLION: &str = "positive and at most 1e6";

/// A sampled control loop: what it runs at, and what its log is.
///
/// The log has positions of its instants, and of torques the mean over its interval around each, as drives report it.
#[derive(Debug, Clone, PartialEq)]
pub struct Loop {
    /// Samples of the controller, Hz.
    pub rate: f64,
    /// Samples of the log, Hz.
    pub log_rate: f64,
    /// Samples of the controller that pass before its torque acts; until then its first one does.
    pub delay: usize,
    /// How long it runs, s.
    pub duration: f64,
    /// What is measured.
    pub sensors: Sensors,
    /// Seconds by which logged torques are late.
    pub torque_delay: f64,
    /// Joint torque per unit of the logged channel; none is 1 for all.
    pub actuator_gain: Vec<f64>,
    /// Channels of the trajectory that the plant reads, in its order, by their places.
    pub inputs: Vec<usize>,
    /// How exact the motion is.
    pub tolerances: Tolerances,
}

/// What a loop leaves.
#[derive(Debug, Clone, PartialEq, Default)]
#[non_exhaustive]
pub struct Record {
    /// Time stamps, s.
    pub time: Vec<f64>,
    /// Positions as measured, `[joint][sample]`, rad or m.
    pub q: Vec<Vec<f64>>,
    /// Velocities as the controller has them.
    pub dq: Vec<Vec<f64>>,
    /// Logged torques.
    pub tau: Vec<Vec<f64>>,
    /// Channels of the trajectory.
    pub extra: Vec<Channel>,
    /// Largest distance of each joint's true position from the wanted one.
    pub tracking: Vec<f64>,
    /// Whether each switch was held at the end.
    pub held: Vec<bool>,
    /// What the motion took.
    pub work: Work,
}

impl Default for Loop {
    fn default() -> Self {
        Self {
            rate: 1000.0,
            log_rate: 1000.0,
            delay: 0,
            duration: 1.0,
            sensors: Sensors::default(),
            torque_delay: 0.0,
            actuator_gain: Vec::new(),
            inputs: Vec::new(),
            tolerances: Tolerances::default(),
        }
    }
}

/// Whether a torque can be logged by it.
fn is_gain(gain: f64) -> bool {
    gain.is_finite() && gain != 0.0
}

impl Loop {
    fn check(&self, dof: usize, trajectory: &Trajectory) -> Result<(), SimulateError> {
        let settings = [
            (
                "the rate of the controller",
                self.rate,
                1e6,
                UP_TO_A_MILLION,
            ),
            (
                "the rate of the log",
                self.log_rate,
                1e5,
                "positive and at most 1e5",
            ),
            ("the duration", self.duration, 1e6, UP_TO_A_MILLION),
        ];
        for (what, value, most, range) in settings {
            if !(value > 0.0 && value <= most) {
                return Err(SimulateError::Setting { what, range, value });
            }
        }
        let numbers = self.duration * self.log_rate * dof as f64;
        if numbers > MOST_NUMBERS as f64 {
            return Err(SimulateError::Setting {
                what: "the number of samples of all joints in the log",
                range: "2.6e8 or less",
                value: numbers,
            });
        }
        if !self.torque_delay.is_finite() {
            return Err(SimulateError::Setting {
                what: "the delay of the logged torque",
                range: "a finite number",
                value: self.torque_delay,
            });
        }
        if let Some(gain) = self.actuator_gain.iter().find(|gain| !is_gain(**gain)) {
            return Err(SimulateError::Setting {
                what: "the gain of each actuator",
                range: "a finite number other than zero",
                value: *gain,
            });
        }
        let sensors = &self.sensors;
        let none_negative = [
            ("the step of the encoders", sensors.encoder_step),
            ("the noise of positions", sensors.position_noise),
            ("the noise of torques", sensors.torque_noise),
            ("the corner of the velocity filter", sensors.velocity_hz),
        ];
        for (what, value) in none_negative {
            if !(value >= 0.0 && value.is_finite()) {
                return Err(SimulateError::Setting {
                    what,
                    range: "0 or more",
                    value,
                });
            }
        }
        if trajectory.dof() != dof {
            return Err(SimulateError::Size {
                what: "the trajectory",
                found: trajectory.dof(),
                expected: dof,
            });
        }
        Ok(())
    }

    /// Runs a plant from the start of a trajectory, moving as that does, under a controller; `progress` is told the time now and
    /// then.
    ///
    /// # Errors
    /// [`SimulateError`]: a setting out of its range, or a motion without continuation.
    ///
    /// # Examples
    /// A block that is to follow a slow wave, with a controller of each joint by itself:
    /// ```
    /// # mod block { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/doc/block.rs")); }
    /// # use block::Block;
    /// use robot_model::simulate::{Gains, Loop, Pd, Trajectory};
    /// let time: Vec<f64> = (0..=100).map(|k| 0.02 * f64::from(k)).collect();
    /// let wave = vec![time.iter().map(|t| 0.1 * (3.0 * t).sin()).collect()];
    /// let wanted = Trajectory::new(time, wave, Vec::new(), Vec::new(), Vec::new())?;
    /// let mut controller = Pd::new(Gains::new(100.0, 1.0)?, vec![2.0]);
    /// let settings = Loop { duration: 2.0, log_rate: 100.0, ..Loop::default() };
    /// let (record, _) = settings.run(Block([2.0, 0.7]), &mut controller, &wanted, &mut |_| ())?;
    /// assert_eq!(record.time.len(), 201);
    /// assert!(record.tracking[0] < 1e-3); // m
    /// # Ok::<(), robot_model::simulate::SimulateError>(())
    /// ```
    pub fn run<P: Plant>(
        &self,
        plant: P,
        controller: &mut dyn Controller,
        trajectory: &Trajectory,
        progress: &mut dyn FnMut(f64),
    ) -> Result<(Record, Integrator<P>), SimulateError> {
        let dof = plant.joints();
        self.check(dof, trajectory)?;
        let start = trajectory.at(0.0);
        let mut arm = self.stand(plant, trajectory)?;
        let period = 1.0 / self.rate;
        let samples = whole_steps(self.duration * self.log_rate + 1e-9) + 1;
        let mut record = Record {
            q: vec![Vec::with_capacity(samples); dof],
            dq: vec![Vec::with_capacity(samples); dof],
            tracking: vec![0.0; dof],
            ..Record::default()
        };
        let mut noise = Noise::new(self.sensors.seed, 0);
        let mut log_noise = Noise::new(self.sensors.seed, 1);
        let mut measured = Vec::new();
        let (mut dq, mut last): (Vec<f64>, Option<Vec<f64>>) = (start.dq.clone(), None);
        let mut waiting: VecDeque<Vec<f64>> = VecDeque::new();
        let mut applied: Vec<Vec<f64>> = Vec::new();
        let mut row = Vec::new();
        while record.time.len() < samples {
            let tick = applied.len();
            let now = tick as f64 * period;
            if tick.is_multiple_of(256) {
                progress(now);
            }
            let desired = trajectory.at(now);
            for (joint, most) in record.tracking.iter_mut().enumerate() {
                *most = most.max((desired.q[joint] - arm.q()[joint]).abs());
            }
            self.sensors
                .positions(&arm.q()[..dof], &mut noise, &mut measured);
            self.velocities(&arm, &measured, last.as_deref(), &mut dq);
            last = Some(measured.clone());
            let inputs = self.inputs_at(trajectory, now);
            let mut torque = vec![0.0; dof];
            let measurement = Measured {
                time: now,
                period,
                q: &measured,
                dq: &dq,
                inputs: &inputs,
            };
            controller.torque(&measurement, &desired, &mut torque);
            if tick == 0 {
                // What it asks for first is there from the start, so that an arm that hangs does not drop.
                waiting.extend(vec![torque.clone(); self.delay]);
            }
            waiting.push_back(torque);
            let torque = waiting.pop_front().unwrap_or_default();
            let after = self.inputs_at(trajectory, now + period);
            let rates = inputs.iter().zip(after).map(|(x, y)| (y - x) / period);
            arm.drive(Drive {
                torque: torque.clone(),
                input_rates: rates.collect(),
                inputs,
                since: now,
            });
            applied.push(torque);
            let end = (tick + 1) as f64 * period;
            // Instants of the log within the period.
            while record.time.len() < samples {
                let instant = record.time.len() as f64 / self.log_rate;
                if instant >= end - 1e-12 * end {
                    break;
                }
                arm.advance(instant.max(arm.time()))?;
                record.time.push(instant);
                self.sensors
                    .positions(&arm.q()[..dof], &mut log_noise, &mut row);
                for joint in 0..dof {
                    record.q[joint].push(row[joint]);
                    let exact = self.sensors.are_exact();
                    record.dq[joint].push(if exact { arm.dq()[joint] } else { dq[joint] });
                }
            }
            if record.time.len() < samples {
                arm.advance(end)?;
            }
        }
        record.tau = self.logged_torque(&applied, &record.time, dof);
        let channels = trajectory.extra().iter().enumerate();
        record.extra = channels
            .map(|(k, channel)| Channel {
                name: channel.name.clone(),
                values: record
                    .time
                    .iter()
                    .map(|&t| trajectory.channel(k, t))
                    .collect(),
            })
            .collect();
        record.held = arm.held();
        record.work = arm.work();
        Ok((record, arm))
    }

    /// What effects read from outside.
    fn inputs_at(&self, trajectory: &Trajectory, time: f64) -> Vec<f64> {
        let inputs = self.inputs.iter();
        inputs.map(|&k| trajectory.channel(k, time)).collect()
    }

    /// A plant at the start of a trajectory; what hangs on its joints moves as they do.
    fn stand<P: Plant>(
        &self,
        mut plant: P,
        trajectory: &Trajectory,
    ) -> Result<Integrator<P>, SimulateError> {
        let start = trajectory.at(0.0);
        let (memory, switches) = (vec![0.0; plant.states()], vec![0.0; plant.switches()]);
        let q = plant.start(&Instant {
            time: 0.0,
            q: &start.q,
            dq: &start.dq,
            ddq: &start.ddq,
            memory: &memory,
            switches: &switches,
            torque: &vec![0.0; start.q.len()],
            inputs: &self.inputs_at(trajectory, 0.0),
        });
        let dq: Vec<f64> = (0..q.len()).map(|k| start.dq[plant.joint(k)]).collect();
        Integrator::new(plant, &q, &dq, self.tolerances)
    }

    /// Velocities as a controller has them.
    fn velocities<P: Plant>(
        &self,
        arm: &Integrator<P>,
        measured: &[f64],
        last: Option<&[f64]>,
        dq: &mut [f64],
    ) {
        if self.sensors.are_exact() {
            dq.copy_from_slice(&arm.dq()[..dq.len()]);
            return;
        }
        let Some(last) = last else {
            return;
        };
        let share = if self.sensors.velocity_hz > 0.0 {
            1.0 - (-std::f64::consts::TAU * self.sensors.velocity_hz / self.rate).exp()
        } else {
            1.0
        };
        for (joint, dq) in dq.iter_mut().enumerate() {
            let difference = (measured[joint] - last[joint]) * self.rate;
            *dq += share * (difference - *dq);
        }
    }

    /// Means of the torques that were held, in units of the logged channel, late and with noise.
    fn logged_torque(&self, applied: &[Vec<f64>], time: &[f64], dof: usize) -> Vec<Vec<f64>> {
        let mut noise = Noise::new(self.sensors.seed, 2);
        let interval = 1.0 / self.log_rate;
        let end = applied.len() as f64 / self.rate;
        let joints = (0..dof).map(|joint| {
            // Over the periods that an interval covers, each by its share: sums from the start would lose digits.
            let integral = |from: f64, to: f64| -> f64 {
                let (from, to) = (from * self.rate, to * self.rate);
                let last = applied.len() - 1;
                let ticks = whole_steps(from).min(last)..=whole_steps(to).min(last);
                let share = |tick: usize| {
                    let start = tick as f64;
                    (to.min(start + 1.0) - from.max(start)).max(0.0)
                };
                ticks.map(|tick| share(tick) * applied[tick][joint]).sum()
            };
            let gain = self.actuator_gain.get(joint).copied().unwrap_or(1.0);
            let mean = |&instant: &f64| {
                let middle = (instant - self.torque_delay).clamp(0.0, end);
                let from = (middle - 0.5 * interval).max(0.0);
                let to = (middle + 0.5 * interval).min(end);
                integral(from, to) / ((to - from) * self.rate) / gain
            };
            let mut torque: Vec<f64> = time.iter().map(mean).collect();
            self.sensors.disturb(&mut torque, interval, &mut noise);
            torque
        });
        joints.collect()
    }
}

//! Experiments with the link by hand, and what its sensors make of them.

use std::f64::consts::TAU;

use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;
use robot_model::log::Log;

use super::plant::{Link, State};
use super::truth;
use crate::paper::{Error, normal, rounded};

/// Steps of the integrator: one for each sample of the sensors.
pub const STEP_S: f64 = 1.0 / truth::SENSOR_HZ;

/// Noise of the transducer's current, as of a motor behind a bridge, A.
pub const CURRENT_NOISE: f64 = 0.01;

/// What the transducer and its resistor make of a current, V/A.
pub const VOLTS_PER_AMPERE: f64 = truth::TURNS * truth::RESISTOR;

/// Bits of the encoder that is called fine.
pub const FINE_BITS: i32 = 20;

/// A motion with the torque that made it, as it was.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Run {
    /// s.
    pub time: Vec<f64>,
    /// Angle from where the link hangs, rad.
    pub q: Vec<f64>,
    /// Torque of the motor, N m.
    pub torque: Vec<f64>,
}

/// Where the link may go, rad from where it hangs: the paper's angles with 180 degrees there.
#[must_use]
pub fn range() -> [f64; 2] {
    truth::RANGE_DEG.map(|angle| (angle - 180.0).to_radians())
}

/// Step of an encoder, rad.
#[must_use]
pub fn encoder_step(bits: i32) -> f64 {
    TAU / 2_f64.powi(bits)
}

/// The link under a torque of time, from rest at an angle until it is at the end of its range or `seconds` are over; every `every`-th
/// step is kept.
pub fn driven(
    link: &Link,
    angle: f64,
    seconds: f64,
    every: usize,
    torque: impl Fn(f64) -> f64,
) -> Run {
    let mut x = State {
        q: angle,
        ..State::default()
    };
    let mut run = Run::default();
    let [low, high] = range();
    let mut k = 0_usize;
    loop {
        let t = k as f64 * STEP_S;
        if k.is_multiple_of(every) {
            run.time.push(t);
            run.q.push(x.q);
            run.torque.push(torque(t));
        }
        if t >= seconds || x.q < low || x.q > high {
            return run;
        }
        x = link.step(x, torque(t + 0.5 * STEP_S), STEP_S);
        k += 1;
    }
}

/// Who holds a speed.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Loop {
    /// The gains of the paper at its 1 kHz, in N m, on the distance from where a constant speed would be.
    Printed,
    /// The same on the error of the speed: the damping of the bristles alone answers a torque within half a millisecond.
    PrintedOnSpeed,
    /// A stiffer one on the error of the speed, at 2 kHz: friction falls with speed by more than the printed gains
    /// make up for.
    Stiff,
}

/// Proportional and integral gain of the stiffer loop, N m s/rad and N m/rad, and its samples, Hz.
const STIFF: [f64; 2] = [2.2, 50.0];
const STIFF_HZ: f64 = 2000.0;

/// A run from rest at a wanted speed, from one end of the range over `way` rad; 1 kHz of it is kept.
#[must_use]
pub fn sweep(link: &Link, wanted: f64, way: f64, held_by: Loop) -> Run {
    let low = range()[0];
    let (rate, kept) = match held_by {
        Loop::Printed | Loop::PrintedOnSpeed => (truth::LOOP_HZ, 1),
        Loop::Stiff => (STIFF_HZ, 2),
    };
    let period = 1.0 / rate;
    let mut x = State {
        q: low,
        ..State::default()
    };
    let mut run = Run::default();
    let (mut sum, mut before) = (0.0, 0.0);
    let (mut held, mut t) = (0.0, 0.0);
    let mut k = 0_usize;
    // A link that sticks would never arrive.
    while x.q < low + way && t < 3.0 * way / wanted {
        t = k as f64 * period;
        let torque = match held_by {
            Loop::Printed | Loop::PrintedOnSpeed => {
                let [kp, ki, kd] = truth::PID;
                let error = if held_by == Loop::Printed {
                    low + wanted * t - x.q
                } else {
                    wanted - x.v
                };
                sum += error * period;
                let change = (error - before) / period;
                before = error;
                kp * error + ki * sum + kd * change
            }
            Loop::Stiff => {
                let error = wanted - x.v;
                sum += error * period;
                STIFF[0] * error + STIFF[1] * sum
            }
        };
        if k.is_multiple_of(kept) {
            run.time.push(t);
            run.q.push(x.q);
            // A drive's report is the mean over the interval around its instant.
            run.torque.push(0.5 * (held + torque));
        }
        held = torque;
        // Steps are exact for constant speeds, and need not be finer.
        for _ in 0..2 / kept {
            x = link.step(x, torque, 1.0 / STIFF_HZ);
        }
        k += 1;
    }
    run
}

/// The current in a log: the transducer makes a voltage of the motor's, with its noise, the converter counts that, and the count is taken
/// back through both. That the converter ends at 5 V is not in it: see `in_kgf_cm` of `audit`.
fn through_the_chain(current: f64) -> f64 {
    let step = 2.0 * truth::CONVERTER_VOLTS / 2_f64.powi(truth::CONVERTER_BITS);
    rounded(VOLTS_PER_AMPERE * current, step) / VOLTS_PER_AMPERE
}

impl Run {
    /// Largest voltage on the converter, V.
    #[must_use]
    pub fn volts(&self) -> f64 {
        let torques = self.torque.iter();
        let most = torques.fold(0.0, |most: f64, torque| most.max(torque.abs()));
        VOLTS_PER_AMPERE * most / truth::TORQUE_CONSTANT
    }

    /// What comes after so many rad, with time from 0.
    #[must_use]
    pub fn after(&self, way: f64) -> Self {
        let first = self.q[0];
        let start = self.q.partition_point(|q| q - first < way);
        Self {
            time: self.time[start..]
                .iter()
                .map(|t| t - self.time[start])
                .collect(),
            q: self.q[start..].to_vec(),
            torque: self.torque[start..].to_vec(),
        }
    }

    /// What an encoder and the current transducer log of it.
    ///
    /// # Errors
    /// None is expected: that of a log.
    pub fn log(&self, name: &str, bits: i32, seed: u64) -> Result<Log, Error> {
        let mut random = ChaCha8Rng::seed_from_u64(seed);
        self.log_of(name, bits, |current| {
            through_the_chain(current + CURRENT_NOISE * normal(&mut random))
        })
    }

    /// The same with currents as they are.
    ///
    /// # Errors
    /// As [`Self::log`].
    pub fn log_without_chain(&self, name: &str, bits: i32) -> Result<Log, Error> {
        self.log_of(name, bits, |current| current)
    }

    fn log_of(&self, name: &str, bits: i32, read: impl FnMut(f64) -> f64) -> Result<Log, Error> {
        let current = self
            .torque
            .iter()
            .map(|torque| torque / truth::TORQUE_CONSTANT);
        let current = current.map(read).collect();
        let step = encoder_step(bits);
        let q = self.q.iter().map(|q| rounded(*q, step)).collect();
        Ok(Log::from_samples(
            name,
            self.time.clone(),
            vec![q],
            vec![current],
        )?)
    }
}

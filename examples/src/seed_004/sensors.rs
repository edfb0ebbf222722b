//! What the rig measures with: encoders, converters of torque, velocities from encoders, and the log of them.

use rand_chacha::ChaCha8Rng;
use robot_model::log::Log;

pub use crate::paper::rounded;
use crate::paper::{Error, normal};

/// Rate of the controller and of the log, Hz.
pub const RATE: f64 = 1000.0;

/// Steps of an encoder, rad: 4000 a turn of the motor behind a transmission of 10.
pub const ENCODER: f64 = std::f64::consts::TAU / 40_000.0;

/// A step of a converter of 12 bits over -0.5 .. 0.5 N m.
pub const CONVERTER: f64 = 1.0 / 4096.0;

/// White noise of the torque that is measured, in steps of the converter.
const NOISE: f64 = 0.5;

/// Samples of the rig in so many seconds.
#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "a minute at the most"
)]
#[must_use]
pub fn samples(seconds: f64) -> usize {
    (seconds * RATE) as usize
}

/// What the rig logs.
#[derive(Debug, Clone, Default)]
pub struct Record {
    /// Time, s.
    pub time: Vec<f64>,
    /// Positions by the encoders, `[joint][sample]`.
    pub q: [Vec<f64>; 3],
    /// Torque by the converter.
    pub tau: [Vec<f64>; 3],
}

impl Record {
    /// What encoder and converter make of a joint's position and torque.
    pub(super) fn read(&mut self, joint: usize, q: f64, tau: f64, random: &mut ChaCha8Rng) {
        let noise = normal(random);
        self.q[joint].push(rounded(q, ENCODER));
        self.tau[joint].push(rounded(tau + NOISE * CONVERTER * noise, CONVERTER));
    }

    /// The samples within a part of the time, as a log.
    ///
    /// # Errors
    /// Those of [`Log::from_samples`].
    pub fn log(&self, name: &str, from: f64, to: f64) -> Result<Log, Error> {
        let first = self.time.partition_point(|&t| t < from);
        let end = self.time.partition_point(|&t| t < to);
        let part = |all: &[Vec<f64>; 3]| all.iter().map(|x| x[first..end].to_vec()).collect();
        Ok(Log::from_samples(
            name,
            self.time[first..end].to_vec(),
            part(&self.q),
            part(&self.tau),
        )?)
    }
}

/// A velocity from an encoder: differences through a low-pass.
#[derive(Debug, Clone, Copy)]
pub struct Velocity {
    weight: f64,
    last: Option<f64>,
    value: f64,
}

impl Velocity {
    /// With a corner in Hz.
    #[must_use]
    pub fn new(corner: f64) -> Self {
        Self {
            weight: 1.0 - (-std::f64::consts::TAU * corner / RATE).exp(),
            last: None,
            value: 0.0,
        }
    }

    /// The velocity after the next position.
    pub fn next(&mut self, q: f64) -> f64 {
        let slope = self.last.map_or(0.0, |last| (q - last) * RATE);
        self.last = Some(q);
        self.value += self.weight * (slope - self.value);
        self.value
    }
}

//! The rig of section 3.1: a PD controller at 1 kHz along sums of ten sines, and what it logs.

use rand::{RngExt as _, SeedableRng};
use rand_chacha::ChaCha8Rng;
use robot_model::log::Log;

use super::plant::{Plant, Three, bias, inertia};
use super::truth::Pi;
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

/// Lowest and highest frequency of the sines, rad/s.
const FREQUENCIES: [f64; 2] = [0.11, 5.0];

/// Motions that are drawn, and 50ths of a second for which they are looked at.
const DRAWS: usize = 100;
const SEEN: std::ops::Range<i32> = 0..3200;

/// A joint below this speed is slow, rad/s.
const SLOW: f64 = 0.1;

/// Poses between which a motion stays, rad.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Room {
    /// Lowest angles.
    pub low: Three,
    /// Highest angles.
    pub high: Three,
}

/// Where the inertia of all five columns of table 1 is positive definite, which it is not in the whole workspace.
pub const ROOM: Room = Room {
    low: [-0.9, -0.45, -0.10],
    high: [0.9, 0.50, 0.65],
};

/// A sum of sines around a pose, one sum a joint.
#[derive(Debug, Clone, PartialEq)]
pub struct Sines {
    center: Three,
    /// Amplitude, frequency in rad/s, phase.
    tones: [Vec<[f64; 3]>; 3],
}

impl Sines {
    /// So many sines a joint that fill a room. Amplitudes grow with the square of the frequency; of phases by chance those are taken with which the
    /// joint is slow for the shortest time, as friction holds it there.
    #[must_use]
    pub fn new(count: usize, room: &Room, seed: u64) -> Self {
        let mut random = ChaCha8Rng::seed_from_u64(seed);
        let [low, high] = FREQUENCIES;
        let center = std::array::from_fn(|j| 0.5 * (room.low[j] + room.high[j]));
        let tones = std::array::from_fn(|j| {
            let draws = (0..DRAWS).map(|_| {
                let mut tones: Vec<[f64; 3]> = (0..count)
                    .map(|k| {
                        // Joints have frequencies of their own, between those of the others.
                        let place = (k as f64 + [1.0, 0.8, 0.6][j]) / count as f64;
                        let w = low + place * (high - low);
                        let phase = random.random_range(0.0..std::f64::consts::TAU);
                        [w * w, w, phase]
                    })
                    .collect();
                let largest = SEEN.map(|t| sum(&tones, 0, 0.02 * f64::from(t)).abs());
                let scale = 0.5 * (room.high[j] - room.low[j]) / largest.fold(0.0, f64::max);
                for tone in &mut tones {
                    tone[0] *= scale;
                }
                let slow = SEEN.filter(|&t| sum(&tones, 1, 0.02 * f64::from(t)).abs() < SLOW);
                (slow.count(), tones)
            });
            draws
                .min_by_key(|(slow, _)| *slow)
                .map_or(Vec::new(), |(_, tones)| tones)
        });
        Self { center, tones }
    }

    /// The same, faster or slower.
    #[must_use]
    pub fn at_pace(mut self, pace: f64) -> Self {
        for tone in self.tones.iter_mut().flatten() {
            tone[1] *= pace;
        }
        self
    }

    /// Positions, velocities, accelerations.
    #[must_use]
    pub fn at(&self, t: f64) -> [Three; 3] {
        std::array::from_fn(|order| {
            std::array::from_fn(|j| {
                let center = if order == 0 { self.center[j] } else { 0.0 };
                center + sum(&self.tones[j], [0, 1, 2][order], t)
            })
        })
    }
}

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

/// So many poses of a room by chance.
#[must_use]
pub fn poses(room: &Room, count: usize, seed: u64) -> Vec<Three> {
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    let mut pose = || std::array::from_fn(|j| random.random_range(room.low[j]..room.high[j]));
    (0..count).map(|_| pose()).collect()
}

/// A sum of sines, differentiated so many times.
fn sum(tones: &[[f64; 3]], order: i32, t: f64) -> f64 {
    let shift = f64::from(order) * std::f64::consts::FRAC_PI_2;
    let all = tones.iter();
    all.map(|[a, w, p]| a * w.powi(order) * (w * t + p + shift).sin())
        .sum()
}

/// Gains of the PD controller: N m/rad and N m s/rad.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Gains {
    /// Of positions.
    pub stiffness: Three,
    /// Of velocities.
    pub damping: Three,
}

impl Gains {
    /// The same on all joints.
    #[must_use]
    pub const fn all(stiffness: f64, damping: f64) -> Self {
        Self {
            stiffness: [stiffness; 3],
            damping: [damping; 3],
        }
    }
}

/// What the rig logs, and what was there.
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
    fn read(&mut self, joint: usize, q: f64, tau: f64, random: &mut ChaCha8Rng) {
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

/// Torques of a device that follows a motion as it is wanted, with the same noise and steps; a joint turns round without resting.
#[must_use]
pub fn followed(pi: &Pi, motion: &Sines, seconds: f64, seed: u64) -> Record {
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    let mut record = Record::default();
    for k in 0..samples(seconds) {
        let t = k as f64 / RATE;
        let [q, v, a] = motion.at(t);
        let (m, bias) = (inertia(pi, &q), bias(pi, &q, &v));
        record.time.push(t);
        for j in 0..3 {
            let inertial: f64 = (0..3).map(|i| m[j][i] * a[i]).sum();
            let friction = pi[8 + j] * v[j] + pi[11 + j] * v[j].signum();
            record.read(j, q[j], inertial + bias[j] + friction, &mut random);
        }
    }
    record
}

/// Moves a plant along a motion for so many seconds.
///
/// The controller holds its torque for a sample. What is logged is the mean of the torque around a sample, as a current that
/// passes a converter's low-pass, with noise and in steps.
///
/// # Errors
/// That of [`Plant::advance`].
pub fn run(
    plant: Plant,
    motion: &Sines,
    gains: &Gains,
    seconds: f64,
    seed: u64,
) -> Result<Record, Error> {
    pushed(plant, motion, gains, seconds, seed, |_, _| [0.0; 3])
}

/// As [`run`], with a torque from outside that depends on time and pose.
///
/// # Errors
/// That of [`Plant::advance`].
pub fn pushed(
    mut plant: Plant,
    motion: &Sines,
    gains: &Gains,
    seconds: f64,
    seed: u64,
    outside: impl Fn(f64, &Three) -> Three,
) -> Result<Record, Error> {
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    let mut velocities = [Velocity::new(100.0); 3];
    let mut record = Record::default();
    let mut held = [0.0; 3];
    for k in 0..samples(seconds) {
        let t = k as f64 / RATE;
        let [wanted, speed, _] = motion.at(t);
        let q = plant.q().map(|q| rounded(q, ENCODER));
        let tau: Three = std::array::from_fn(|j| {
            let slip = speed[j] - velocities[j].next(q[j]);
            gains.stiffness[j] * (wanted[j] - q[j]) + gains.damping[j] * slip
        });
        record.time.push(t);
        for j in 0..3 {
            record.read(j, q[j], 0.5 * (held[j] + tau[j]), &mut random);
        }
        let from_outside = outside(t, &plant.q());
        let all: Three = std::array::from_fn(|j| tau[j] + from_outside[j]);
        plant.advance(&all, 1.0 / RATE)?;
        held = tau;
    }
    Ok(record)
}

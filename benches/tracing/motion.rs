//! Motions of the study: sums of sines with random amplitudes and phases, inside the limits of the spec.

use std::f64::consts::TAU;

use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use robot_model::log::{Channel, MOTION_PHASE};
use robot_model::motion::{Kinematics, Motion};
use robot_model::simulate::{SimulateError, Trajectory};
use robot_model_spec::Model;

/// Waves a joint, and their lowest and highest frequency, Hz; of motions that repeat, multiples of the lowest.
const WAVES: usize = 5;
const LOWEST_HZ: f64 = 0.1;
const HIGHEST: u32 = 9;

/// Share of the limits that is used; limits where the spec has none, rad and rad/s.
const SHARE: f64 = 0.8;
const LIMITS: (f64, f64) = (2.0, 2.0);

/// Rate of the trajectory's samples, Hz.
const RATE_HZ: f64 = 500.0;

/// One wave: amplitude, angular frequency, phase.
type Wave = (f64, f64, f64);

/// A motion and its derivatives at any time.
#[derive(Debug)]
pub struct Waves {
    joints: Vec<(f64, Vec<Wave>)>,
    seconds: f64,
}

impl Waves {
    /// Random ones; every seed has its own. With `repeats` they come back every `1 / LOWEST_HZ` seconds.
    pub fn new(model: &Model, seconds: f64, seed: u64, repeats: bool) -> Self {
        let mut random = ChaCha8Rng::seed_from_u64(seed);
        let joints = model.joints.iter().map(|joint| {
            let (low, high) = joint.limits.position.unwrap_or((-LIMITS.0, LIMITS.0));
            let fastest = joint.limits.velocity.unwrap_or(LIMITS.1);
            let mut wave = || {
                let multiple = f64::from(random.random_range(1..=HIGHEST));
                let astray = if repeats {
                    0.0
                } else {
                    random.random_range(-0.5..0.5)
                };
                let w = TAU * LOWEST_HZ * (multiple + astray);
                (
                    random.random_range(0.3..1.0) / w.sqrt(),
                    w,
                    random.random_range(0.0..TAU),
                )
            };
            let waves: Vec<Wave> = (0..WAVES).map(|_| wave()).collect();
            (
                0.5 * (low + high),
                scaled(waves, seconds, 0.5 * (high - low), fastest),
            )
        });
        Self {
            joints: joints.collect(),
            seconds,
        }
    }

    /// Positions, velocities and accelerations at these times.
    pub fn kinematics(&self, time: &[f64]) -> Kinematics {
        let all = |of: &dyn Fn(&Wave, f64) -> f64, middle: bool| -> Vec<Vec<f64>> {
            let joints = self.joints.iter().map(|(center, waves)| {
                let offset = if middle { *center } else { 0.0 };
                let at = |t: &f64| offset + waves.iter().map(|wave| of(wave, *t)).sum::<f64>();
                time.iter().map(at).collect()
            });
            joints.collect()
        };
        Kinematics {
            q: all(&|(a, w, p), t| a * (w * t + p).sin(), true),
            dq: all(&|(a, w, p), t| a * w * (w * t + p).cos(), false),
            ddq: all(&|(a, w, p), t| -a * w * w * (w * t + p).sin(), false),
        }
    }

    /// The same as a wanted motion, with its channels.
    ///
    /// # Errors
    /// Those of [`Trajectory::new`].
    pub fn trajectory(&self) -> Result<Trajectory, SimulateError> {
        let time = times(self.seconds, RATE_HZ);
        let Kinematics { q, dq, ddq } = self.kinematics(&time);
        let channels = channels(&time);
        Trajectory::new(time, q, dq, ddq, channels)
    }

    /// The same as an exact motion at this rate, Hz.
    pub fn exact(&self, rate_hz: f64) -> Motion {
        let time = times(self.seconds, rate_hz);
        let kinematics = self.kinematics(&time);
        Motion {
            extra: channels(&time),
            time,
            smooth: kinematics.clone(),
            wide: kinematics,
            ..Motion::default()
        }
    }
}

/// Waves as large as limits let them be.
fn scaled(waves: Vec<Wave>, seconds: f64, reach: f64, fastest: f64) -> Vec<Wave> {
    let (mut far, mut fast) = (0_f64, 0_f64);
    for t in times(seconds, 50.0) {
        let (q, dq) = waves.iter().fold((0.0, 0.0), |(q, dq), (a, w, p)| {
            (q + a * (w * t + p).sin(), dq + a * w * (w * t + p).cos())
        });
        far = far.max(q.abs());
        fast = fast.max(dq.abs());
    }
    let scale = SHARE * (reach / far).min(fastest / fast);
    waves
        .into_iter()
        .map(|(a, w, p)| (scale * a, w, p))
        .collect()
}

fn times(seconds: f64, rate_hz: f64) -> Vec<f64> {
    let samples = (0..).map(|k| f64::from(k) / rate_hz);
    samples.take_while(|t| *t <= seconds).collect()
}

/// Names of what is beside a motion: a temperature, which logs have, and the part of the period of a motion that repeats, which they have not.
pub const CHANNELS: [&str; 2] = ["temperature", MOTION_PHASE];

/// From 22 to 42 degrees Celsius, most of it within ten seconds; from 0 to 1 in every period.
fn channels(time: &[f64]) -> Vec<Channel> {
    let channel = |name: &str, of: &dyn Fn(&f64) -> f64| Channel {
        name: name.to_owned(),
        values: time.iter().map(of).collect(),
    };
    vec![
        channel(CHANNELS[0], &|t| 42.0 - 20.0 * (-t / 10.0).exp()),
        channel(CHANNELS[1], &|t| (t * LOWEST_HZ).fract()),
    ]
}

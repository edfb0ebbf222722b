//! Machines that share no line with the compiler: a law of arithmetic along a motion, noise, and encoders.
//!
//! In: a [`Machine`] and a motion. Out: a [`Log`], and the least deviations that any unbiased estimate from it can have.

use std::f64::consts::TAU;

use nalgebra::{DMatrix, DVector};
use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, StandardNormal};
use robot_model::log::Log;

/// Samples per second, and instants at which a sample's torque is evaluated: a drive reports the mean over its period.
pub const RATE_HZ: f64 = 500.0;
const INSTANTS: u32 = 20;

/// Step of the encoders, rad: 20 bits a turn.
const ENCODER: f64 = TAU / 1_048_576.0;

/// Acceleration of gravity, m/s^2, and length of the first of two links, m.
pub const GRAVITY: f64 = 9.81;
const LENGTH: f64 = 0.5;

/// The arm at an instant.
#[derive(Debug, Clone, Copy)]
pub struct Now {
    pub q: f64,
    pub dq: f64,
    pub time: f64,
    /// Torque of the rigid body at the first joint, N m.
    pub load: f64,
    /// Seconds since the instant before.
    pub step: f64,
}

/// Torque at the first joint beside that of the rigid body. `p` are the law's own constants, `z` its memory, which the law
/// moves on by [`Now::step`].
pub type Law = fn(p: &[f64], z: &mut f64, now: Now) -> f64;

/// Sums of sines, one list a joint: amplitude in rad, frequency in Hz, phase in rad.
pub type Tones = &'static [&'static [(f64, f64, f64)]];

/// An arm that moves in a vertical plane, with an effect on its first joint.
#[derive(Debug, Clone, Copy)]
pub struct Machine {
    /// One joint: inertia and the two first moments. Two joints: the same with what the second link adds, then those of the
    /// second link.
    pub body: &'static [f64],
    pub law: Law,
    pub constants: &'static [f64],
    /// Standard deviation of white noise of the torque, N m.
    pub noise: f64,
}

/// Dry friction as a machine has it: it turns round within 2 mrad/s.
pub fn dry(dq: f64) -> f64 {
    (dq / 0.002).tanh()
}

/// One step of Runge and Kutta's method of the fourth order, the signals those of the instant.
pub fn advance(z: &mut f64, step: f64, rate: impl Fn(f64) -> f64) {
    let k1 = rate(*z);
    let k2 = rate(*z + 0.5 * step * k1);
    let k3 = rate(*z + 0.5 * step * k2);
    let k4 = rate(*z + step * k3);
    *z += step / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + k4);
}

/// A position as its encoder tells it.
pub fn encoder(q: f64) -> f64 {
    (q / ENCODER).round() * ENCODER
}

/// Position, velocity and acceleration of a joint.
pub fn along(tones: &[(f64, f64, f64)], time: f64) -> [f64; 3] {
    tones.iter().fold([0.0; 3], |[q, dq, ddq], tone| {
        let (amplitude, w) = (tone.0, TAU * tone.1);
        let (sin, cos) = (w * time + tone.2).sin_cos();
        [
            q + amplitude * sin,
            dq + amplitude * w * cos,
            ddq - amplitude * w * w * sin,
        ]
    })
}

/// Torque of the rigid body, one number a joint. Lagrange's equations of two links, worked out by hand; frames stand in the
/// joints.
fn rigid(body: &[f64], state: &[[f64; 3]]) -> Vec<f64> {
    let (q1, v1, a1) = (state[0][0], state[0][1], state[0][2]);
    let weight = |mx: f64, my: f64, q: f64| GRAVITY * (mx * q.cos() - my * q.sin());
    let first = body[0] * a1 + weight(body[1], body[2], q1);
    let (Some(body), Some([q2, v2, a2])) = (body.get(3..6), state.get(1)) else {
        return vec![first];
    };
    let (izz, mx, my) = (body[0], body[1], body[2]);
    let across = LENGTH * (mx * q2.cos() - my * q2.sin());
    let slope = -LENGTH * (mx * q2.sin() + my * q2.cos());
    let second = izz * (a1 + a2) + weight(mx, my, q1 + q2);
    vec![
        first + second + across * (2.0 * a1 + a2) + slope * v2 * (2.0 * v1 + v2),
        second + across * a1 - slope * v1 * v1,
    ]
}

impl Machine {
    fn parameters(&self) -> Vec<f64> {
        [self.body, self.constants].concat()
    }

    /// Torque without noise, `[joint][sample]`.
    fn torque(&self, parameters: &[f64], tones: Tones, seconds: u32) -> Vec<Vec<f64>> {
        let (body, constants) = parameters.split_at(self.body.len());
        let mut memory = 0.0;
        let mut torque = vec![Vec::new(); tones.len()];
        let step = 1.0 / (RATE_HZ * f64::from(INSTANTS));
        for sample in 0..samples(seconds) {
            let mut sum = vec![0.0; tones.len()];
            for instant in 0..INSTANTS {
                let part = (f64::from(instant) + 0.5) / f64::from(INSTANTS) - 0.5;
                let time = (f64::from(sample) + part) / RATE_HZ;
                let state: Vec<[f64; 3]> = tones.iter().map(|tones| along(tones, time)).collect();
                let load = rigid(body, &state);
                let now = Now {
                    q: state[0][0],
                    dq: state[0][1],
                    time,
                    load: load[0],
                    step,
                };
                sum[0] += (self.law)(constants, &mut memory, now);
                sum.iter_mut()
                    .zip(&load)
                    .for_each(|(sum, load)| *sum += load);
            }
            for (torque, sum) in torque.iter_mut().zip(sum) {
                torque.push(sum / f64::from(INSTANTS));
            }
        }
        torque
    }

    /// What the machine's log holds: positions in steps of the encoder, torque with noise.
    pub fn log(&self, name: &str, tones: Tones, seconds: u32, seed: u64) -> Log {
        let mut torque = self.torque(&self.parameters(), tones, seconds);
        let mut random = ChaCha8Rng::seed_from_u64(seed);
        for value in torque.iter_mut().flatten() {
            let normal: f64 = StandardNormal.sample(&mut random);
            *value += self.noise * normal;
        }
        let time: Vec<f64> = (0..samples(seconds))
            .map(|k| f64::from(k) / RATE_HZ)
            .collect();
        let q = tones
            .iter()
            .map(|tones| time.iter().map(|t| encoder(along(tones, *t)[0])).collect());
        let q = q.collect();
        Log::from_samples(name, time, q, torque).expect("samples are in order")
    }

    /// Root mean square of the jumps of a joint's torque over all samples, N m. A jump within a sample is twice in the second
    /// differences, where little is left of what changes smoothly.
    pub fn jump(&self, joint: usize, tones: Tones, seconds: u32) -> f64 {
        let torque = self
            .torque(&self.parameters(), tones, seconds)
            .swap_remove(joint);
        let squares = torque
            .windows(3)
            .map(|t| (t[2] - 2.0 * t[1] + t[0]).powi(2));
        (0.5 * squares.sum::<f64>() / torque.len() as f64).sqrt()
    }

    /// Cramer and Rao's bound: the least standard deviation of an unbiased estimate of each of `wanted`, which are functions
    /// of body and constants. From the slopes of the torque by central differences.
    pub fn least_deviations(
        &self,
        tones: Tones,
        seconds: u32,
        wanted: impl Fn(&[f64]) -> Vec<f64>,
    ) -> Vec<f64> {
        let parameters = self.parameters();
        let slopes = |of: &dyn Fn(&[f64]) -> Vec<f64>| {
            let columns: Vec<DVector<f64>> = (0..parameters.len())
                .map(|k| {
                    let width = 1e-4 * parameters[k].abs().max(1e-2);
                    let shifted = |by: f64| {
                        let mut shifted = parameters.clone();
                        shifted[k] += by;
                        DVector::from_vec(of(&shifted))
                    };
                    (shifted(width) - shifted(-width)) / (2.0 * width)
                })
                .collect();
            DMatrix::from_columns(&columns)
        };
        let mut torque = slopes(&|parameters| self.torque(parameters, tones, seconds).concat());
        let mut wanted = slopes(&wanted);
        // In units in which every parameter shows alike; what the torque does not tell apart, no wanted value depends on.
        for k in 0..parameters.len() {
            let norm = torque.column(k).norm();
            torque.column_mut(k).unscale_mut(norm);
            wanted.column_mut(k).unscale_mut(norm);
        }
        let information = torque.tr_mul(&torque) / self.noise.powi(2);
        let tolerance = 1e-9 * information.norm();
        let covariance = information
            .pseudo_inverse(tolerance)
            .expect("the tolerance is positive");
        (&wanted * covariance * wanted.transpose())
            .diagonal()
            .iter()
            .map(|variance| variance.sqrt())
            .collect()
    }
}

fn samples(seconds: u32) -> u32 {
    seconds * 500
}

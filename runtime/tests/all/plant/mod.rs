//! A plant for tests: two joints without coupling, each a pendulum with friction, its columns written by hand.

use std::f64::consts::TAU;

use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, StandardNormal};
use robot_model::columns::{Arm, Columns, Entry, Shape, Unknown};
use robot_model::log::Log;
use robot_model::motion::{Kinematics, Motion};

/// Inertia, gravity torque, viscous and dry friction of each joint.
pub const TRUTH: [f64; 8] = [1.2, 9.0, 2.0, 3.0, 0.5, 4.0, 1.0, 1.5];

const NAMES: [&str; 4] = ["izz", "mx", "viscous_friction.fv", "coulomb_friction.fc"];

/// The declared model: every joint has `izz ddq + mx sin(q) + fv dq + fc sign(dq)`.
pub struct Pendulums {
    unknowns: Vec<Unknown>,
    names: Vec<String>,
}

impl Pendulums {
    pub fn new() -> Self {
        let unknown = |k: usize| Unknown {
            name: format!("joint{}.{}", k / 4 + 1, NAMES[k % 4]),
            nonnegative: k % 4 >= 2,
        };
        Self {
            unknowns: (0..8).map(unknown).collect(),
            names: vec!["joint1".to_owned(), "joint2".to_owned()],
        }
    }
}

/// `signum` that is 0 at rest.
pub fn sign(v: f64) -> f64 {
    if v == 0.0 { 0.0 } else { v.signum() }
}

pub fn column(values: impl Iterator<Item = f64>, joint: usize, column: usize) -> Entry {
    Entry {
        joint,
        column,
        values: values.collect(),
    }
}

impl Columns for Pendulums {
    fn unknowns(&self) -> &[Unknown] {
        &self.unknowns
    }

    fn shapes(&self) -> &[Shape] {
        &[]
    }

    fn uses_rigid_torque(&self) -> bool {
        false
    }

    fn entries(&self, motion: &Motion, _: &[f64]) -> Vec<Entry> {
        let Kinematics { q, ddq, .. } = &motion.smooth;
        let dq = &motion.wide.dq;
        (0..2)
            .flat_map(|j| {
                [
                    column(ddq[j].iter().copied(), j, 4 * j),
                    column(q[j].iter().map(|q| q.sin()), j, 4 * j + 1),
                    column(dq[j].iter().copied(), j, 4 * j + 2),
                    column(dq[j].iter().map(|v| sign(*v)), j, 4 * j + 3),
                ]
            })
            .collect()
    }
}

impl Arm for Pendulums {
    fn dof(&self) -> usize {
        2
    }

    fn joints(&self) -> &[String] {
        &self.names
    }

    fn actuator_gain(&self) -> &[f64] {
        &[1.0, 1.0]
    }

    fn known_torque(&self, motion: &Motion, _: &[f64]) -> Vec<Vec<f64>> {
        vec![vec![0.0; motion.time.len()]; 2]
    }

    fn rigid_torque(&self, motion: &Motion, _: &[f64], estimate: &[f64]) -> Vec<Vec<f64>> {
        let Kinematics { q, ddq, .. } = &motion.smooth;
        (0..2)
            .map(|j| {
                q[j].iter()
                    .zip(&ddq[j])
                    .map(|(q, a)| estimate[4 * j] * a + estimate[4 * j + 1] * q.sin())
                    .collect()
            })
            .collect()
    }
}

/// How a log is made.
pub struct Plant {
    pub seed: u64,
    /// Length, s.
    pub seconds: u32,
    /// Step of the encoders, rad.
    pub encoder: f64,
    /// Repeat every 10 s, or never.
    pub periodic: bool,
    /// Standard deviation of white torque noise.
    pub white: f64,
    /// Standard deviation of torque noise that is correlated.
    pub colored: f64,
    /// Over so many seconds.
    pub correlated_s: f64,
    /// Added to the torque: a function of joint, `q`, `dq`.
    pub extra: fn(usize, [f64; 2], [f64; 2]) -> f64,
}

impl Default for Plant {
    fn default() -> Self {
        Self {
            seed: 1,
            seconds: 30,
            encoder: 1e-5,
            periodic: true,
            white: 0.05,
            colored: 0.0,
            correlated_s: 0.005,
            extra: |_, _, _| 0.0,
        }
    }
}

impl Plant {
    /// Simulates a log at 500 Hz: five sines a joint.
    pub fn log(&self) -> Log {
        let mut random = ChaCha8Rng::seed_from_u64(self.seed);
        let mut normal = move || -> f64 { StandardNormal.sample(&mut random) };
        let sines: Vec<Vec<[f64; 3]>> = (0..2)
            .map(|_| {
                (1..=5)
                    .map(|k| {
                        let hz = if self.periodic {
                            0.1 * f64::from(k)
                        } else {
                            0.1 * f64::from(k) * (1.0 + 0.1 * normal())
                        };
                        [0.4 + 0.1 * normal(), TAU * hz, 3.0 * normal()]
                    })
                    .collect()
            })
            .collect();
        let samples = 500 * self.seconds;
        let time: Vec<f64> = (0..samples).map(|k| f64::from(k) / 500.0).collect();
        let (mut q, mut tau) = (vec![Vec::new(); 2], vec![Vec::new(); 2]);
        let mut wander = [0.0; 2];
        let keep = (-0.002 / self.correlated_s).exp();
        for t in &time {
            let at = |j: usize| {
                sines[j]
                    .iter()
                    .fold([0.0; 3], |sum, [amplitude, w, phase]| {
                        let (sin, cos) = (w * t + phase).sin_cos();
                        [
                            sum[0] + amplitude * sin,
                            sum[1] + amplitude * w * cos,
                            sum[2] - amplitude * w * w * sin,
                        ]
                    })
            };
            let states = [at(0), at(1)];
            let (positions, velocities) = (states.map(|s| s[0]), states.map(|s| s[1]));
            for j in 0..2 {
                let [x, v, a] = states[j];
                let p = &TRUTH[4 * j..];
                wander[j] = keep * wander[j] + (1.0 - keep * keep).sqrt() * normal();
                let noise = self.white * normal() + self.colored * wander[j];
                let torque = p[0] * a
                    + p[1] * x.sin()
                    + p[2] * v
                    + p[3] * v.signum()
                    + (self.extra)(j, positions, velocities);
                q[j].push((x / self.encoder).round() * self.encoder);
                tau[j].push(torque + noise);
            }
        }
        Log::from_samples("a simulated log", time, q, tau).expect("samples are in order")
    }
}

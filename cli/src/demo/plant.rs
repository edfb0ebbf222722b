//! The demo's plant: an arm that moves along embedded trajectories, with noise and encoders.
//!
//! Torque is that of the compiled plant on the exact motion, so its dry friction changes sign where the velocity does. The
//! log that comes out holds what a real one holds: positions in encoder steps, torque with noise that is partly correlated.

use std::f64::consts::TAU;

use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, StandardNormal};
use robot_model::columns::Arm;
use robot_model::identify::torque_of;
use robot_model::log::Log;
use robot_model::motion::{Kinematics, Motion};
use robot_model_codegen::{Compiled, compile_model};
use robot_model_spec::load;
use robot_model_spec::parameter::Status;

use crate::Error;
use crate::interpreted::InterpretedArm;

/// Fourier coefficients of the motions.
const MOTIONS: &str = include_str!("motions.csv");

/// Base frequency of the motions, Hz; rate of the logs, Hz, and their length: 30 s.
const BASE_HZ: f64 = 0.1;
const RATE_HZ: f64 = 500.0;
const SAMPLES: u32 = 15_000;

/// Steps of the encoders, rad; torque noise relative to each joint's torque, white and correlated over 4 ms.
const ENCODER: f64 = 2e-5;
const WHITE: f64 = 0.004;
const CORRELATED: f64 = 0.004;
const CORRELATION_S: f64 = 0.004;

/// A compiled spec with a number for every parameter.
pub(super) struct Plant {
    arm: InterpretedArm,
    beta: Vec<f64>,
}

impl Plant {
    /// The plant of a spec: link parameters as in the spec, effects' parameters by name.
    pub(super) fn new(
        source_name: &str,
        text: &str,
        effects: &[(&str, f64)],
    ) -> Result<Self, Error> {
        let compiled = compile_model(&load(source_name, text)?);
        let beta = compiled.base.beta(&standard(&compiled, effects)?);
        Ok(Self {
            arm: InterpretedArm::new(compiled),
            beta,
        })
    }

    /// Moves the plant along one of the embedded motions and logs it.
    pub(super) fn log(&self, motion: &str, seed: u64) -> Result<Log, Error> {
        let time: Vec<f64> = (0..SAMPLES).map(|k| f64::from(k) / RATE_HZ).collect();
        let exact = kinematics(motion, &time, self.arm.dof())?;
        let mut state = Motion {
            time,
            smooth: exact.clone(),
            wide: exact,
            rigid_torque: Vec::new(),
        };
        state.rigid_torque = self.arm.rigid_torque(&state, &self.beta);
        let mut tau = torque_of(&self.arm, &state, &[], &self.beta, self.arm.dof());
        let mut random = ChaCha8Rng::seed_from_u64(seed);
        for torque in &mut tau {
            let size = (torque.iter().map(|t| t * t).sum::<f64>() / torque.len() as f64).sqrt();
            let keep = (-1.0 / (RATE_HZ * CORRELATION_S)).exp();
            let mut slow = 0.0;
            for value in torque {
                let [white, fresh]: [f64; 2] =
                    std::array::from_fn(|_| StandardNormal.sample(&mut random));
                slow = keep * slow + (1.0 - keep * keep).sqrt() * fresh;
                *value += size * (WHITE * white + CORRELATED * slow);
            }
        }
        let q = state
            .wide
            .q
            .iter()
            .map(|q| q.iter().map(|x| (x / ENCODER).round() * ENCODER).collect())
            .collect();
        Log::from_samples(format!("{motion} log"), state.time, q, tau)
            .map_err(|error| Error::Argument(error.to_string()))
    }
}

/// A value for every standard parameter.
fn standard(compiled: &Compiled, effects: &[(&str, f64)]) -> Result<Vec<f64>, Error> {
    let value = |name: &str, status: Status| match status {
        Status::Nominal(value) | Status::Fixed(value) => Ok(value),
        Status::Unknown => effects
            .iter()
            .find(|(suffix, _)| *suffix == name)
            .map(|(_, value)| *value)
            .ok_or_else(|| Error::Argument(format!("the plant has no value for `{name}`"))),
    };
    compiled
        .standard
        .iter()
        .map(|parameter| value(&parameter.name, parameter.status))
        .collect()
}

/// Sums of five harmonics and their derivatives.
fn kinematics(motion: &str, time: &[f64], dof: usize) -> Result<Kinematics, Error> {
    let still = || vec![vec![0.0; time.len()]; dof];
    let mut sum = Kinematics {
        q: still(),
        dq: still(),
        ddq: still(),
    };
    let mut rows = csv::Reader::from_reader(MOTIONS.as_bytes());
    for row in rows.deserialize::<(String, usize, f64, f64, f64)>() {
        let (name, joint, harmonic, sine, cosine) =
            row.map_err(|error| Error::Argument(error.to_string()))?;
        if name != motion {
            continue;
        }
        let w = TAU * BASE_HZ * harmonic;
        for (k, t) in time.iter().enumerate() {
            let (sin, cos) = (w * t).sin_cos();
            sum.q[joint - 1][k] += sine * sin + cosine * cos;
            sum.dq[joint - 1][k] += w * (sine * cos - cosine * sin);
            sum.ddq[joint - 1][k] -= w * w * (sine * sin + cosine * cos);
        }
    }
    Ok(sum)
}

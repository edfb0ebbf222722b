//! The demo's plant: an arm that moves along embedded trajectories, with noise and encoders.
//!
//! Torque is the inverse dynamics of the compiled plant on the exact motion, state by state, so its dry friction changes sign
//! where the velocity does. The log that comes out holds what a real one holds: positions in encoder steps, torque with noise
//! that is partly correlated. Identification gets its own filtered motion from these positions.

use std::f64::consts::TAU;

use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, StandardNormal};
use robot_model::log::Log;
use robot_model::motion::Kinematics;
use robot_model_codegen::base::shape_values;
use robot_model_codegen::expr::Symbol;
use robot_model_codegen::interpreter::{Operand, Program};
use robot_model_codegen::{Compiled, compile_model};
use robot_model_spec::load;
use robot_model_spec::parameter::Status;

use crate::Error;

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
    inverse_dynamics: Program,
    /// Values of standard parameters, and of shape parameters.
    parameters: Vec<f64>,
    shapes: Vec<f64>,
    dof: usize,
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
            inverse_dynamics: compiled.inverse_dynamics(),
            parameters: compiled.parameter_values(&beta),
            shapes: shape_values(&compiled.model),
            dof: compiled.dof(),
        })
    }

    /// Torque at every instant of a motion: one state at a time, nothing filtered or averaged.
    fn torque(&self, time: &[f64], exact: &Kinematics) -> Vec<Vec<f64>> {
        let mut torque = vec![Vec::new(); self.dof];
        let bind = |symbol| match symbol {
            Symbol::Q(joint) => Operand::Column(&exact.q[joint]),
            Symbol::Dq(joint) => Operand::Column(&exact.dq[joint]),
            Symbol::Ddq(joint) => Operand::Column(&exact.ddq[joint]),
            Symbol::Time => Operand::Column(time),
            Symbol::Parameter(k) => Operand::Constant(self.parameters[k]),
            Symbol::Shape(k) => Operand::Constant(self.shapes[k]),
            Symbol::RigidTorque(_) => unreachable!("inverse dynamics knows its own load"),
            Symbol::MeasuredTorque(_)
            | Symbol::Input(_)
            | Symbol::State(_)
            | Symbol::Switch(_)
            | Symbol::Weight(_) => {
                unreachable!("no effect of the plant reads a log or has a memory")
            }
        };
        self.inverse_dynamics
            .eval_batch(time.len(), &bind, &mut torque);
        torque
    }

    /// Moves the plant along one of the embedded motions and logs it.
    pub(super) fn log(&self, motion: &str, seed: u64) -> Result<Log, Error> {
        let time: Vec<f64> = (0..SAMPLES).map(|k| f64::from(k) / RATE_HZ).collect();
        let exact = kinematics(motion, &time, self.dof)?;
        let mut tau = self.torque(&time, &exact);
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
        let encoder = |q: &Vec<f64>| q.iter().map(|x| (x / ENCODER).round() * ENCODER).collect();
        let q = exact.q.iter().map(encoder).collect();
        Log::from_samples(format!("{motion} log"), time, q, tau)
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

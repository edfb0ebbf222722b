//! Equations (3) and (4), as printed, beside those that the compiler derives from energies and from frames.

use std::array;

use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use robot_model::columns::Arm as _;
use robot_model::identify::torque_of;
use robot_model::motion::{Kinematics, Motion};
use robot_model::simulate::Functions as _;
use robot_model_cli::interpreted::InterpretedArm;
use robot_model_codegen::Compiled;

use super::model::{Model, chain};
use super::plant::torque;
use super::symbols;
use super::truth::{CAD, ESTIMATED, Physical};
use crate::paper::Error;

/// States at which equations are compared.
const STATES: usize = 1000;

/// Largest differences from the printed equations, over the largest torque.
#[derive(Debug, Clone)]
pub struct Differences {
    /// Of the equations from energies.
    pub energies: f64,
    /// Of those from frames.
    pub chain: f64,
    /// Terms that are left of each joint in symbols, where the printed equations are taken from those from energies.
    pub left: [Vec<String>; 2],
    /// The same of those from frames, at all of [`LENGTHS`].
    pub left_of_chain: [Vec<String>; 2],
    /// Names of the base parameters of the rigid body, from energies.
    pub base: Vec<String>,
}

/// Lengths of the first link, m, at which the equations from frames are compared in symbols: numbers in the frames, and three of them settle
/// what is of the second degree in them.
pub const LENGTHS: [f64; 3] = [CAD.l1, ESTIMATED.l1, 1.0];

/// Over random states, with the parameters of Table 2 and of Table 6.
///
/// # Errors
/// None are expected.
pub fn differences() -> Result<Differences, Error> {
    let model = Model::dry()?;
    let (mut energies, mut frames) = (0.0_f64, 0.0_f64);
    for physical in [CAD, ESTIMATED] {
        let rigid = Physical {
            viscous: [0.0; 2],
            dry: [0.0; 2],
            ..physical
        };
        let beta = model.constants.own(&rigid.values());
        energies = energies.max(difference(&model.compiled, &beta, &rigid));
        let chain = chain(rigid.l1)?;
        let beta = chain.base.beta(&of_chain(&chain, &rigid));
        frames = frames.max(difference(&chain, &beta, &rigid));
    }
    let mut left_of_chain = [Vec::new(), Vec::new()];
    for l1 in LENGTHS {
        let left = symbols::left_of_chain(&chain(l1)?, l1, symbols::PRINTED)?;
        for (all, left) in left_of_chain.iter_mut().zip(left) {
            all.extend(left);
        }
    }
    let names = model.compiled.base.names.iter();
    let of_effects = |name: &&String| name.contains("friction");
    Ok(Differences {
        energies,
        chain: frames,
        left: symbols::left(&model.compiled, symbols::PRINTED)?,
        left_of_chain,
        base: names.filter(|name| !of_effects(name)).cloned().collect(),
    })
}

/// Standard parameters of the chain: the frame of the first link is at its end.
fn of_chain(chain: &Compiled, p: &Physical) -> Vec<f64> {
    let ([m1, m2], [c1, c2], [i1, i2]) = (p.m, p.c, p.inertia);
    let x1 = c1 - p.l1;
    let value = |name: &str| match name {
        "q1.m" => m1,
        "q1.mx" => m1 * x1,
        "q1.izz" => i1 + m1 * x1 * x1,
        "q2.m" => m2,
        "q2.mx" => m2 * c2,
        "q2.izz" => i2 + m2 * c2 * c2,
        _ => 0.0,
    };
    let standard = chain.standard.iter();
    standard.map(|parameter| value(&parameter.name)).collect()
}

fn difference(compiled: &Compiled, beta: &[f64], physical: &Physical) -> f64 {
    let mut random = ChaCha8Rng::seed_from_u64(1);
    let mut channel = |size: f64| -> [Vec<f64>; 2] {
        array::from_fn(|_| {
            let values = (0..STATES).map(|_| size * (2.0 * random.random::<f64>() - 1.0));
            values.collect()
        })
    };
    let states = Kinematics {
        q: channel(3.1).to_vec(),
        dq: channel(5.0).to_vec(),
        ddq: channel(20.0).to_vec(),
    };
    let motion = Motion {
        time: (0..STATES).map(|k| k as f64).collect(),
        smooth: states.clone(),
        wide: states,
        ..Motion::default()
    };
    let arm = InterpretedArm::new(compiled.clone());
    let found = torque_of(&arm, &motion, &[], beta, arm.dof());
    let (mut most, mut largest) = (0.0_f64, 0.0_f64);
    for k in 0..STATES {
        let at = |values: &Vec<Vec<f64>>| array::from_fn(|joint| values[joint][k]);
        let states = &motion.smooth;
        let printed = torque(physical, at(&states.q), at(&states.dq), at(&states.ddq));
        for joint in 0..2 {
            most = most.max((found[joint][k] - printed[joint]).abs());
            largest = largest.max(printed[joint].abs());
        }
    }
    most / largest
}

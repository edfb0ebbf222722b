//! What a factor's columns are made of, in few numbers that tell arms apart.
//!
//! Two arms may have unknowns of the same names and other equations: another gravity, link length or gain, another body that the spec
//! fixes. So each column, the torque that is known, and the gains are put down along a motion that is always the same, as sums over
//! joints and samples. Names of files, comments and nominal values are in none of them.

use std::f64::consts::PI;

use crate::columns::Arm;
use crate::log::Channel;
use crate::motion::{Kinematics, Motion};

/// Samples of the motion: enough that a place which an effect has moved lies between two of them somewhere.
const SAMPLES: u32 = 256;

/// Their distance, s.
const STEP: f64 = 0.01;

/// Sums that differ by no more than this share of their size are alike: machines round sines in their own ways.
const ALIKE: f64 = 1e-9;

/// A sum that is a smaller share of the largest size is what rounding leaves of nothing.
const NOTHING: f64 = 1e-13;

/// What differs where these do.
pub(super) const OTHER: &str =
    "equations (kinematics, gravity, gains, effects or values that a spec fixes)";

/// A weighed sum of a column over joints and samples, and the sum of the sizes of its parts.
pub type Sum = [f64; 2];

/// Those of all columns, of the known torque, and of the gains.
pub(super) fn of(arm: &dyn Arm) -> Vec<Sum> {
    let motion = motion(arm);
    let mut columns = vec![[0.0; 2]; arm.unknowns().len()];
    for entry in arm.entries(&motion, &[]) {
        add(&mut columns[entry.column], entry.joint, &entry.values);
    }
    let mut known = [0.0; 2];
    for (joint, values) in arm.known_torque(&motion, &[]).iter().enumerate() {
        add(&mut known, joint, values);
    }
    let gains = arm.actuator_gain().iter().map(|gain| [*gain, gain.abs()]);
    columns.into_iter().chain([known]).chain(gains).collect()
}

/// Whether both are of the same equations.
pub(super) fn are_alike(one: &[Sum], other: &[Sum]) -> bool {
    let largest = one.iter().map(|sum| sum[1]).fold(0.0, f64::max);
    let is_alike = |(one, other): (&Sum, &Sum)| {
        let size = one[1].max(other[1]);
        let mut pairs = one.iter().zip(other);
        pairs.all(|(one, other)| (one - other).abs() <= ALIKE * size + NOTHING * largest)
    };
    one.len() == other.len() && one.iter().zip(other).all(is_alike)
}

/// Positions and what else columns read, one as free of the other as can be.
fn motion(arm: &dyn Arm) -> Motion {
    let samples = || (0..SAMPLES).map(f64::from);
    let wave = |channel: usize, size: f64| -> Vec<f64> {
        let turn = 0.754 + 0.213 * channel as f64;
        samples().map(|k| size * (turn * (k + 1.0)).sin()).collect()
    };
    let dof = arm.dof();
    let family = |number: usize, size: f64| -> Vec<Vec<f64>> {
        let joints = 0..dof;
        joints.map(|j| wave(number * dof + j, size)).collect()
    };
    let kinematics = Kinematics {
        q: family(0, PI),
        dq: family(1, 3.0),
        ddq: family(2, 9.0),
    };
    let inputs = arm.inputs().iter().enumerate();
    let channel = |(k, name): (usize, &String)| Channel {
        name: name.clone(),
        values: wave(4 * dof + k, 5.0),
    };
    Motion {
        time: samples().map(|k| STEP * k).collect(),
        smooth: kinematics.clone(),
        wide: kinematics,
        tau: family(3, 20.0),
        extra: inputs.map(channel).collect(),
        ..Motion::default()
    }
}

/// Where an effect has no value there is nothing to compare.
fn add(sum: &mut Sum, joint: usize, values: &[f64]) {
    for (k, value) in values.iter().enumerate().filter(|(_, x)| x.is_finite()) {
        let weight = 1.0 + 0.5 * (1.7 * joint as f64 + 0.9 * k as f64).sin();
        sum[0] += weight * value;
        sum[1] += weight * value.abs();
    }
}

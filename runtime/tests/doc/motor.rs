// The arm of the documentation's examples of friction curves, which include this file: a motor alone, and a log of it.

use robot_model::columns::{Arm, Columns, Entry, Shape, Unknown};
use robot_model::friction_curve::{Bristles, FrictionError, Law, Measured};
use robot_model::log::Log;
use robot_model::motion::Motion;

pub struct Motor([String; 1]);

pub fn motor() -> Motor {
    Motor(["motor".to_owned()])
}

/// Its friction is all of its torque.
pub fn measured(motor: &Motor) -> Measured<'_> {
    Measured {
        arm: motor,
        joint: 0,
        shapes: Vec::new(),
        columns: Vec::new(),
        known: None,
    }
}

/// 2 s at each of six speeds, 0.5 to 3 rad/s, with friction of 0.5 N m and 0.1 N m s/rad.
pub fn runs() -> Log {
    let (mut time, mut q, mut tau) = (vec![0.0], vec![0.0], vec![0.55]);
    for k in 0..6000 {
        let speed = 0.5 * f64::from(1 + k / 1000);
        time.push(0.002 * f64::from(k + 1));
        q.push(q[q.len() - 1] + 0.002 * speed);
        tau.push(0.5 + 0.1 * speed);
    }
    Log::from_samples("a motor", time, vec![q], vec![tau]).expect("the samples are uniform")
}

/// 4 s of a torque that rises from 0 to 0.45 N m: bristles of 100 N m/rad give by `tau / 100`, and the motor by
/// `-0.5 / 100 ln(1 - tau / 0.5)`, as they creep.
pub fn loading() -> Log {
    let time: Vec<f64> = (0..=2000).map(|k| 0.002 * f64::from(k)).collect();
    let tau: Vec<f64> = time.iter().map(|t| 0.45 * t / 4.0).collect();
    let q = tau.iter().map(|tau| -0.005 * (-tau / 0.5).ln_1p()).collect();
    Log::from_samples("a motor", time, vec![q], vec![tau]).expect("the samples are uniform")
}

/// What both logs say of its bristles.
pub fn bristles() -> Result<Bristles, FrictionError> {
    let motor = motor();
    let curve = measured(&motor).curve(&[runs()])?;
    measured(&motor).bristles(&curve, &Law::fit(&curve)?, &loading())
}

impl Columns for Motor {
    fn unknowns(&self) -> &[Unknown] {
        &[]
    }
    fn shapes(&self) -> &[Shape] {
        &[]
    }
    fn uses_rigid_torque(&self) -> bool {
        false
    }
    fn entries(&self, _: &Motion, _: &[f64]) -> Vec<Entry> {
        Vec::new()
    }
}

impl Arm for Motor {
    fn dof(&self) -> usize {
        1
    }
    fn joints(&self) -> &[String] {
        &self.0
    }
    fn actuator_gain(&self) -> &[f64] {
        &[1.0]
    }
    fn known_torque(&self, motion: &Motion, _: &[f64]) -> Vec<Vec<f64>> {
        vec![vec![0.0; motion.time.len()]]
    }
    fn rigid_torque(&self, motion: &Motion, _: &[f64], _: &[f64]) -> Vec<Vec<f64>> {
        vec![vec![0.0; motion.time.len()]]
    }
}

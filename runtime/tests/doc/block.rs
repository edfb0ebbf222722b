// The plant of the documentation's examples of simulation and output error, which include this file: a block on oil.

use nalgebra::{DMatrix, DVector};
use robot_model::log::Log;
use robot_model::simulate::{
    Adjustable, Drive, Instant, Integrator, ParameterSlopes, Plant, Slopes, Tolerances,
};

/// `m ddq + c dq = tau`, with `m` in kg and `c` in N s/m.
#[derive(Debug, Clone)]
pub struct Block(pub [f64; 2]);

impl Plant for Block {
    fn dof(&self) -> usize {
        1
    }
    fn torque(&mut self, at: &Instant<'_>, torque: &mut DVector<f64>, inertia: &mut DMatrix<f64>) {
        let [m, c] = self.0;
        torque[0] = m * at.ddq[0] + c * at.dq[0];
        inertia[(0, 0)] = m;
    }
    fn slopes(&mut self, _: &Instant<'_>, slopes: &mut Slopes) {
        slopes.torque[0][(0, 0)] = 0.0;
        slopes.torque[1][(0, 0)] = self.0[1];
    }
}

impl Adjustable for Block {
    fn values(&self) -> Vec<f64> {
        self.0.to_vec()
    }
    fn adjust(&mut self, values: &[f64]) {
        self.0.copy_from_slice(values);
    }
    fn parameter_slopes(&mut self, at: &Instant<'_>, slopes: &mut ParameterSlopes) {
        slopes.torque.copy_from_slice(&[at.ddq[0], at.dq[0]]);
    }
}

/// 0.5 m/s and 3 m/s^2.
pub const MOVING: Instant<'_> = Instant {
    time: 0.0,
    q: &[0.0],
    dq: &[0.5],
    ddq: &[3.0],
    memory: &[],
    switches: &[],
    torque: &[0.0],
    inputs: &[],
};

/// A block with `m = 2` and `c = 0.7`, at 0.2 m with 0.5 m/s.
pub fn sliding() -> Integrator<Block> {
    Integrator::new(Block([2.0, 0.7]), &[0.2], &[0.5], Tolerances::default()).expect("one joint")
}

/// 3 s at 100 Hz of this block, pushed by forces that are held between samples.
pub fn measure() -> Log {
    let mut block = sliding();
    let (mut time, mut q, mut tau) = (Vec::new(), Vec::new(), Vec::new());
    for k in 0..300 {
        let t = 0.01 * f64::from(k);
        let push = 4.0 * (2.3 * t).sin() + 2.5 * (5.1 * t).cos();
        time.push(t);
        q.push(block.q()[0]);
        tau.push(push);
        block.drive(Drive {
            torque: vec![push],
            ..Drive::default()
        });
        block.advance(t + 0.01).expect("a smooth motion");
    }
    Log::from_samples("block", time, vec![q], vec![tau])
        .expect("the samples are finite and uniform")
}

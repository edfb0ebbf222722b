use nalgebra::{DMatrix, DVector};
use robot_model::simulate::{Instant, Jumps, Plant, Slopes};

/// A motor of 1 kg, at `q[0]`, drags a load of 2 kg, at `q[1]`, by a spring of 100 N/m. Dry friction of 3 N is at the load, and
/// a filter of 0.5 s sees its velocity: `dz/dt = (dq[1] - z) / 0.5`.
#[derive(Debug, Clone)]
pub struct Cart;

impl Plant for Cart {
    fn dof(&self) -> usize {
        2
    }
    fn joints(&self) -> usize {
        1
    }
    fn joint(&self, _coordinate: usize) -> usize {
        0
    }
    fn start(&mut self, joints: &Instant<'_>) -> Vec<f64> {
        vec![joints.q[0]; 2]
    }
    fn states(&self) -> usize {
        1
    }
    fn switches(&self) -> usize {
        1
    }
    fn torque(&mut self, at: &Instant<'_>, torque: &mut DVector<f64>, inertia: &mut DMatrix<f64>) {
        let pull = 100.0 * (at.q[0] - at.q[1]);
        torque[0] = at.ddq[0] + pull;
        torque[1] = 2.0 * at.ddq[1] - pull + 3.0 * at.switches[0];
        inertia.copy_from_slice(&[1.0, 0.0, 0.0, 2.0]);
    }
    fn rates(&mut self, at: &Instant<'_>, rates: &mut [f64]) {
        rates[0] = (at.dq[1] - at.memory[0]) / 0.5;
    }
    fn arguments(&mut self, at: &Instant<'_>, arguments: &mut [f64]) {
        arguments[0] = at.dq[1];
    }
    fn jumps(&mut self, _: &Instant<'_>, jumps: &mut Jumps) {
        jumps.halves[(1, 0)] = 3.0;
        jumps.directions[(0, 1)] = 1.0;
    }
    fn slopes(&mut self, _: &Instant<'_>, slopes: &mut Slopes) {
        slopes.torque[0].copy_from_slice(&[100.0, -100.0, -100.0, 100.0]);
        slopes.rates[1][(0, 1)] = 2.0;
        slopes.rates[2][(0, 0)] = -2.0;
    }
}

/// The load stands at 0, with the motor where the spring pulls as far as 0.02 m.
pub const PULLED: Instant<'_> = Instant {
    time: 0.0,
    q: &[0.02, 0.0],
    dq: &[0.0, 0.0],
    ddq: &[0.0, 0.0],
    memory: &[0.0],
    switches: &[0.0],
    torque: &[0.0, 0.0],
    inputs: &[],
};

//! Accelerations by Newton's method.

use nalgebra::{DMatrix, DVector};

use super::{Moving, share_size};
use crate::simulate::error::SimulateError;
use crate::simulate::plant::Plant;

/// Most steps of Newton's method for accelerations, and its last step relative to them.
pub(super) const STEPS: usize = 40;
const SETTLED: f64 = 1e-12;

/// The same where steps are halved, and what is missing of the torque that is rounding.
const DAMPED_STEPS: usize = 400;
const ROUNDING: f64 = 1e-11;

/// Whether a pivot of a factored matrix is nothing but rounding.
fn is_singular(factored: &DMatrix<f64>) -> bool {
    let pivots = factored.diagonal().abs();
    pivots.min() <= 1e-14 * pivots.max()
}

impl<P: Plant> Moving<P> {
    /// Newton's steps from no acceleration on, `None` where they do not settle. Damped ones are halved where they lead away, as where a
    /// torque is bent sharply.
    pub(super) fn newton(
        &mut self,
        time: f64,
        x: &DVector<f64>,
        held: &[usize],
        is_damped: bool,
    ) -> Result<Option<DMatrix<f64>>, SimulateError> {
        let dof = self.plant.dof();
        let is_one_step = self.plant.is_affine() && held.is_empty();
        let steps = if is_damped { DAMPED_STEPS } else { STEPS };
        let mut last: Option<(DVector<f64>, f64)> = None;
        self.ddq.fill(0.0);
        for step in 0..steps {
            self.with(time, x, |plant, at, torque, inertia, jumps| {
                plant.torque(at, torque, inertia);
                if !held.is_empty() && step == 0 {
                    plant.jumps(at, jumps);
                }
            });
            let matrix = self.bordered(held);
            let mut change = DVector::zeros(dof + held.len());
            for joint in 0..dof {
                change[joint] = self.drive.torque[joint] - self.torque[joint];
            }
            for (row, &k) in held.iter().enumerate() {
                let rate = (self.jumps.directions.row(k) * &self.ddq)[0] + self.jumps.drifts[k];
                change[dof + row] = -rate;
            }
            let missing = change.norm();
            match &mut last {
                Some((step, before)) if is_damped && (missing.is_nan() || missing >= *before) => {
                    if missing <= ROUNDING * self.torque.norm() {
                        return Ok(Some(matrix));
                    }
                    *step *= 0.5;
                    let step = step.clone();
                    self.go(&step, -1.0, held);
                    continue;
                }
                _ => {}
            }
            let lu = matrix.clone().lu();
            let is_singular = held.is_empty() && is_singular(lu.lu_internal());
            if is_singular || !lu.solve_mut(&mut change) || !change.iter().all(|x| x.is_finite()) {
                return Err(self.no_solution(time, x));
            }
            self.go(&change, 1.0, held);
            // Held joints stand, to the last digit.
            for &k in held {
                if let (Some(joint), true) = (self.lone_joint(k), self.jumps.drifts[k] == 0.0) {
                    self.ddq[joint] = 0.0;
                }
            }
            let largest = self.ddq.amax() + share_size(held);
            if is_one_step || (step > 0 && change.amax() <= SETTLED * largest) {
                return Ok(Some(matrix));
            }
            last = Some((change, missing));
        }
        Ok(None)
    }

    /// Accelerations and shares of what is held, `factor` times a step on.
    fn go(&mut self, step: &DVector<f64>, factor: f64, held: &[usize]) {
        let dof = self.ddq.len();
        self.ddq += step.rows(0, dof) * factor;
        for (row, &k) in held.iter().enumerate() {
            self.shares[k] += factor * step[dof + row];
        }
    }
}

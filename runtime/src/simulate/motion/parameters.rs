//! Slopes of a motion's equations by the parameters of its plant.

use nalgebra::{DMatrix, DVector};

use super::Moving;
use crate::simulate::adjustable::{Adjustable, ParameterSlopes};

impl<P: Adjustable> Moving<P> {
    pub fn parameter_slopes(&mut self, time: f64, x: &DVector<f64>, slopes: &mut ParameterSlopes) {
        self.with(time, x, |plant, at, _, _, _| {
            plant.parameter_slopes(at, slopes);
        });
    }

    /// Slopes of what a switch is the sign of by unknowns, where those of the state are `tangent`, and its speed along the motion, whose
    /// rate is `rate`.
    pub fn argument_slopes(
        &mut self,
        time: f64,
        x: &DVector<f64>,
        rate: &DVector<f64>,
        switch: usize,
        tangent: &DMatrix<f64>,
    ) -> (DVector<f64>, f64) {
        let dof = self.plant.dof();
        self.with(time, x, |plant, at, _, _, jumps| plant.jumps(at, jumps));
        let direction = self.jumps.directions.row(switch).into_owned();
        let speed = (&direction * rate.rows(dof, dof))[0] + self.jumps.drifts[switch];
        let mut slopes = (direction * tangent.rows(dof, dof)).transpose();
        // By positions, as far as arguments know them.
        let size = 1e-6 * (1.0 + x.rows(0, dof).amax());
        for (u, column) in tangent.column_iter().enumerate() {
            let length = column.rows(0, dof).amax();
            if length > 0.0 {
                let step = size / length;
                let [up, down] = [step, -step].map(|step| {
                    let mut near = x.clone();
                    near.rows_mut(0, dof).axpy(step, &column.rows(0, dof), 1.0);
                    self.arguments(time, &near)[switch]
                });
                slopes[u] += (up - down) / (2.0 * step);
            }
        }
        (slopes, speed)
    }
}

//! All shapes at once, along the slopes of the torque (Gauss and Newton): what makes up for each other across effects is not
//! found one effect after the other.

use crate::columns::Arm;
use crate::identify::least_squares::Factors;
use crate::identify::{Identify, IdentifyError, slope};
use crate::signal::Prepared;

use super::{moved, with_slopes};

/// Most steps, the shares of one that are tried, and by how much the cost has to fall: a ten thousandth of a deviation.
const STEPS: usize = 12;
const SHARES: [f64; 4] = [1.0, 0.5, 0.25, 0.125];
const LEAST_FALL: f64 = 1e-4;

impl Identify {
    /// Shapes from `shapes` on, as long as the cost falls.
    ///
    /// # Errors
    /// Those of [`Self::solve_stack`].
    pub(in crate::identify) fn together(
        &self,
        arm: &dyn Arm,
        logs: &[Prepared],
        mut shapes: Vec<f64>,
    ) -> Result<Vec<f64>, IdentifyError> {
        let mut cost = self.cost(arm, logs, &shapes)?;
        for _ in 0..STEPS {
            let step = self.step(arm, logs, &shapes)?;
            let mut next = None;
            for share in SHARES {
                let free = arm.shapes().iter().zip(&shapes).zip(&step);
                let trial =
                    free.map(|((shape, value), step)| moved(&shape.grid, *value, share * step));
                let trial: Vec<f64> = trial.collect();
                let there = self.cost(arm, logs, &trial)?;
                if there < cost - LEAST_FALL {
                    next = Some((there, trial));
                    break;
                }
            }
            let Some((there, trial)) = next else {
                break;
            };
            (cost, shapes) = (there, trial);
        }
        Ok(shapes)
    }

    /// Where least squares with slopes for columns moves the shapes.
    fn step(
        &self,
        arm: &dyn Arm,
        logs: &[Prepared],
        shapes: &[f64],
    ) -> Result<Vec<f64>, IdentifyError> {
        let rows = |shapes: &[f64]| self.rows(arm, logs, shapes);
        let stack = rows(shapes);
        let solution = self.solve_stack(&stack)?;
        let (linear, dof) = (solution.estimate.len(), stack.dof());
        let whole = with_slopes(
            arm,
            &rows,
            shapes,
            0..shapes.len(),
            stack,
            &solution.estimate,
            slope::smooth,
        );
        let beside = Factors::new(&whole).solve(&solution.scale, &vec![1.0; dof]);
        Ok(beside.estimate[linear..].to_vec())
    }
}

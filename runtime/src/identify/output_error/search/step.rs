//! A step of a search, from equations of where it stands: `min |z + R d|` with what keeps it near.

use nalgebra::{DMatrix, DVector};

use super::super::equations::{Equations, Reduced, triangle};

/// Least damping, of columns of length one: directions that outputs do not answer to are left alone.
pub(super) const LEAST: f64 = 1e-10;

/// A step of parameters and of the starts of windows.
pub(super) struct Step {
    pub parameters: DVector<f64>,
    pub starts: Vec<DVector<f64>>,
    /// By how much it is foretold to lower the cost, and its length in units of columns.
    pub predicted: f64,
    pub length: f64,
}

/// How far parameters may go from where they are.
pub(super) struct Room<'a> {
    pub values: &'a [f64],
    pub bounds: &'a [[f64; 2]],
    /// Lengths of their columns, 0 where they do nothing.
    pub scale: &'a DVector<f64>,
}

impl Room<'_> {
    /// The step of least `|z + R d|^2 + lambda |D d|^2` that stays within the bounds: parameters that would leave them are set there,
    /// the others again.
    fn parameters(&self, reduced: &Reduced, lambda: f64) -> DVector<f64> {
        let unknowns = self.values.len();
        let mut step = DVector::zeros(unknowns);
        let mut free: Vec<usize> = (0..unknowns)
            .filter(|&k| self.bounds[k][0] < self.bounds[k][1] && self.scale[k] > 0.0)
            .collect();
        while !free.is_empty() {
            let count = free.len();
            let mut rows = DMatrix::zeros(unknowns + count, count + 1);
            let right = &reduced.z + &reduced.r * &step;
            for (place, &k) in free.iter().enumerate() {
                rows.view_mut((0, place), (unknowns, 1))
                    .copy_from(&reduced.r.column(k));
                rows[(unknowns + place, place)] = lambda.sqrt() * self.scale[k];
            }
            rows.view_mut((0, count), (unknowns, 1)).copy_from(&right);
            let rows = triangle(rows);
            let r = rows.view((0, 0), (count, count)).into_owned();
            let z: DVector<f64> = -rows.view((0, count), (count, 1)).column(0);
            let Some(found) = r.solve_upper_triangular(&z) else {
                return step;
            };
            let mut stays = Vec::new();
            for (&k, &change) in free.iter().zip(found.iter()) {
                let [low, high] = self.bounds[k];
                let value = self.values[k] + change;
                if value < low || value > high {
                    step[k] = value.clamp(low, high) - self.values[k];
                } else {
                    stays.push((k, change));
                }
            }
            if stays.len() == count {
                for (k, change) in stays {
                    step[k] = change;
                }
                return step;
            }
            free = stays.into_iter().map(|(k, _)| k).collect();
        }
        step
    }

    /// The same with the starts, damped alike.
    pub fn damped(&self, equations: &Equations, lambda: f64) -> Step {
        let reduced = equations.reduced(lambda);
        let parameters = self.parameters(&reduced, lambda);
        let starts = reduced.starts.iter();
        let starts: Vec<DVector<f64>> = starts.map(|start| start.step(&parameters)).collect();
        let (predicted, square) = equations.foretold(&parameters, &starts);
        let own = parameters.component_mul(self.scale).norm_squared();
        Step {
            parameters,
            starts,
            predicted,
            length: (own + square).sqrt(),
        }
    }

    /// The longest of them within a radius.
    pub fn within(&self, equations: &Equations, radius: f64) -> Step {
        let step = self.damped(equations, LEAST);
        if step.length <= radius {
            return step;
        }
        let (mut low, mut high) = (LEAST.ln(), 1e12_f64.ln());
        for _ in 0..40 {
            let middle = 0.5 * (low + high);
            if self.damped(equations, middle.exp()).length > radius {
                low = middle;
            } else {
                high = middle;
            }
        }
        self.damped(equations, high.exp())
    }
}

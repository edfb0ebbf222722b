//! How sure output error is of what it found.
//!
//! An estimate's error is `sum_w X_w' e_w` with `X_w = V_w (R'R)^-1`, where `V_w` are the slopes of a window's errors by the parameters with
//! its start following them. Errors of a simulation are slow: noise of the torque pushes the simulated arm for the rest of a window, so they
//! are autoregressions, as those of least squares are, and starts and parameters take a good part of them.

use nalgebra::{DMatrix, DVector};

use super::equations::{Reduced, Start};
use super::window::Rows;
use crate::identify::autoregression::long_run_sum;
use crate::identify::short::{Noise, shortfalls, variances};

/// What the deviations of one estimate rest on.
pub(super) struct Deviations<'a> {
    joints: usize,
    windows: Vec<Part<'a>>,
    inverse: &'a DMatrix<f64>,
    /// Errors over what is left of them beside all that was fitted.
    freedom: f64,
}

/// Those of a window, joint after joint.
struct Part<'a> {
    errors: &'a DVector<f64>,
    /// Slopes by the parameters, with the start following them.
    own: DMatrix<f64>,
    /// Directions that the start takes of errors, orthogonal and of length 1.
    start: Option<DMatrix<f64>>,
}

impl Part<'_> {
    fn samples(&self, joints: usize) -> usize {
        self.errors.len() / joints
    }
}

impl<'a> Deviations<'a> {
    /// Of the `free` parameters with their `(R'R)^-1`.
    pub fn new(
        joints: usize,
        (rows, reduced): (&'a [Rows], &Reduced),
        (free, inverse): (&[usize], &'a DMatrix<f64>),
    ) -> Self {
        let windows = rows.iter().zip(&reduced.starts);
        let windows: Vec<Part> = windows
            .map(|(rows, start)| Part {
                errors: &rows.errors,
                own: rows.own(start).select_columns(free),
                start: start.directions(&rows.by_start),
            })
            .collect();
        let count: usize = rows.iter().map(|rows| rows.errors.len()).sum();
        let fitted = free.len() + reduced.starts.iter().map(Start::moving).sum::<usize>();
        Self {
            joints,
            windows,
            inverse,
            freedom: count as f64 / (count as f64 - fitted as f64).max(1.0),
        }
    }

    /// Of functions of the parameters with these slopes: the larger of those of products and of noise that is the same all along, and what
    /// both lack of short logs.
    pub fn of(&self, slopes: &DMatrix<f64>) -> Vec<f64> {
        let inverse = self.inverse * slopes;
        let count = inverse.ncols();
        let mut weights = vec![vec![Vec::new(); count]; self.joints];
        let mut products = vec![0.0; count];
        for window in &self.windows {
            let all = &window.own * &inverse;
            let samples = window.samples(self.joints);
            for (k, all) in all.column_iter().enumerate() {
                let mut series = vec![0.0; samples];
                for (joint, weights) in weights.iter_mut().enumerate() {
                    let some = all.rows(joint * samples, samples);
                    let errors = window.errors.rows(joint * samples, samples);
                    let parts = series.iter_mut().zip(some.iter().zip(errors.iter()));
                    parts.for_each(|(sum, (weight, error))| *sum += weight * error);
                    weights[k].extend(some.iter());
                }
                products[k] += long_run_sum(&series);
            }
        }
        let errors = self.by_joint(self.windows.iter().map(|window| window.errors.clone()));
        let noise = weights.into_iter().zip(&errors);
        let noise: Vec<Noise> = noise
            .map(|(weights, errors)| Noise::new(weights, errors))
            .collect();
        let steady = variances(&noise, count);
        let lack = shortfalls(&noise, &steady, self.freedom, |drawn| self.rest(drawn));
        let all = products.into_iter().zip(steady).zip(lack);
        all.map(|((products, steady), lack)| {
            (self.freedom * lack * products.max(steady)).max(0.0).sqrt()
        })
        .collect()
    }

    /// What starts and parameters leave of errors of each joint.
    fn rest(&self, errors: &[Vec<f64>]) -> Vec<Vec<f64>> {
        let mut first = 0;
        let windows = self.windows.iter().map(|window| {
            let samples = window.samples(self.joints);
            let joints = errors.iter();
            let some = joints.flat_map(|errors| &errors[first..first + samples]);
            let some = DVector::from_iterator(window.errors.len(), some.copied());
            first += samples;
            match &window.start {
                Some(start) => &some - start * start.tr_mul(&some),
                None => some,
            }
        });
        let windows: Vec<DVector<f64>> = windows.collect();
        let mut step = DVector::zeros(self.inverse.ncols());
        for (window, errors) in self.windows.iter().zip(&windows) {
            step += window.own.tr_mul(errors);
        }
        let step = self.inverse * step;
        let windows = self.windows.iter().zip(windows);
        self.by_joint(windows.map(|(window, errors)| errors - &window.own * &step))
    }

    /// Errors of windows, in one row a joint.
    fn by_joint(&self, windows: impl Iterator<Item = DVector<f64>>) -> Vec<Vec<f64>> {
        let mut joints = vec![Vec::new(); self.joints];
        for errors in windows {
            let samples = errors.len() / self.joints;
            for (joint, all) in joints.iter_mut().enumerate() {
                all.extend(errors.rows(joint * samples, samples).iter());
            }
        }
        joints
    }
}

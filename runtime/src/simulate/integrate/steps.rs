//! Steps of high order: their kind, their error, their length.
//!
//! In: a motion whose jumps stay on their sides. Out: its state a step later, if the error is within the tolerances, by explicit
//! steps or, where the motion is stiff, by linearly implicit ones.

use nalgebra::{DMatrix, DVector};

use super::{Integrator, Tolerances};
use crate::simulate::error::SimulateError;
use crate::simulate::plant::Plant;
use crate::simulate::{explicit, implicit};

/// Stability of the explicit steps ends here, and so many steps beyond it are enough to know.
const STIFF: f64 = 3.25;
const STIFF_STEPS: u32 = 6;

/// Implicit steps after which explicit ones are tried again.
const TRIAL: u32 = 400;

/// A trial of a step.
pub(super) struct Trial {
    pub end: DVector<f64>,
    /// Error over what is allowed.
    pub error: f64,
    stiffness: f64,
    /// Rate at the end, where the step has it.
    pub rate: Option<DVector<f64>>,
}

/// What the steps of one start share.
pub(super) struct Start {
    pub rate: DVector<f64>,
    /// For implicit steps: slopes by the state and by time.
    pub slopes: Option<(DMatrix<f64>, DVector<f64>)>,
}

impl<P: Plant> Integrator<P> {
    /// The start of further tries, if the kind of steps is the same.
    pub(super) fn same_start(&self, from: Start) -> Option<Start> {
        (from.slopes.is_some() == self.is_stiff).then_some(from)
    }

    pub(super) fn start(&mut self) -> Result<Start, SimulateError> {
        if !self.is_stiff {
            return Ok(Start {
                rate: self.moving.rate(self.time, &self.x)?,
                slopes: None,
            });
        }
        let (rate, jacobian) = self.moving.linearized(self.time, &self.x)?;
        let by_time = if self.moving.plant.is_timed() {
            // Half of the digits; what depends on time is slow.
            let ahead = 1e-7 * self.time.abs().max(1.0);
            (self.moving.rate(self.time + ahead, &self.x)? - &rate) / ahead
        } else {
            DVector::zeros(rate.len())
        };
        Ok(Start {
            rate,
            slopes: Some((jacobian, by_time)),
        })
    }

    pub(super) fn trial(&mut self, from: &Start, h: f64) -> Result<Trial, SimulateError> {
        let moving = &mut self.moving;
        let rate = |time: f64, x: &DVector<f64>| moving.rate(time, x);
        let (end, error, stiffness, rate) = match &from.slopes {
            None => {
                let step = explicit::step(rate, self.time, &self.x, &from.rate, h)?;
                (step.end, step.error, step.stiffness, Some(step.rate))
            }
            Some((jacobian, by_time)) => {
                let known = (&from.rate, jacobian, by_time);
                let step = implicit::step(rate, self.time, &self.x, known, h)?;
                let (end, error) = step.ok_or(SimulateError::NoAcceleration { time: self.time })?;
                (end, error, 0.0, None)
            }
        };
        let Tolerances {
            relative, absolute, ..
        } = self.tolerances;
        let allowed = |k: usize| absolute + relative * self.x[k].abs().max(end[k].abs());
        let sizes = error
            .iter()
            .enumerate()
            .map(|(k, error)| error.abs() / allowed(k));
        // A maximum that does not lose what is no number.
        let error = sizes.fold(
            0.0,
            |most: f64, size| if size <= most { most } else { size },
        );
        Ok(Trial {
            end,
            error,
            stiffness,
            rate,
        })
    }

    pub(super) fn factor(&self, error: f64) -> f64 {
        let order = if self.is_stiff { 4.0 } else { 5.0 };
        (0.9 * error.max(1e-10).powf(-1.0 / order)).clamp(0.2, 5.0)
    }

    pub(super) fn shorten(&mut self, h: f64, factor: f64) {
        self.work.rejected += 1;
        self.step = h * factor;
        // Before the floor ends the explicit steps, implicit ones are tried.
        if !self.is_stiff && self.step < 10.0 * self.tolerances.floor {
            self.is_stiff = true;
            self.implicit_steps = 0;
        }
    }

    pub(super) fn accept(&mut self, h: f64, left: f64, trial: &Trial) {
        self.x.copy_from(&trial.end);
        self.time += h;
        let next = h * self.factor(trial.error);
        // A step that ends with the interval says nothing against a longer one before it.
        self.step = if h < left { next } else { next.max(self.step) };
        if self.time - self.last_event > 4.0 * self.reach {
            (self.crowd, self.reach) = (0, self.tolerances.floor);
        }
        if self.is_stiff {
            self.work.implicit += 1;
            self.implicit_steps += 1;
            if self.implicit_steps >= TRIAL {
                (self.is_stiff, self.stiff_steps) = (false, 0);
            }
        } else {
            self.work.explicit += 1;
            if trial.stiffness > STIFF {
                self.stiff_steps += 1;
            } else {
                self.stiff_steps = self.stiff_steps.saturating_sub(1);
            }
            if self.stiff_steps >= STIFF_STEPS {
                (self.is_stiff, self.implicit_steps) = (true, 0);
            }
        }
    }
}

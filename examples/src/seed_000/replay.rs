//! Figures 7 and 8 of an arm that has the parameters that are printed with them: along its own current, without noise, from its own start.
//!
//! What a motor's back-EMF leaves of its voltage keeps an arm in order while it moves. The same current, given once more, does not: it knows
//! nothing of where the arm is. So model (5.1) multiplies what is off while the arm is up, and as far as this current goes is as far as
//! the model has it, whatever noise a log has.

use robot_model::simulate::{Integrator, Tolerances};

use super::law::Law;
use super::motion::held;
use super::plant::{TURN, VOLTS};
use super::truth::{BACK_EMF, FIGURE_7, RATE};
use crate::paper::Error;

/// How often a current is set anew from sample to sample: forty times within the time in which the back-EMF brakes the arm.
const FINER: usize = 40;

/// An arm's motion from 1.67 s on, with its current.
#[derive(Debug, Clone)]
pub struct Own {
    /// Position and velocity at the start.
    pub start: [f64; 2],
    /// What is left of its voltage, V, [`FINER`] values a sample.
    current: Vec<f64>,
    /// Positions at samples, rad.
    pub path: Vec<f64>,
}

/// Positions of model (5.1) at so many samples, and the last state, under a current by its number and the state.
fn moved(
    values: &[f64; 4],
    [angle, velocity]: [f64; 2],
    samples: usize,
    mut current: impl FnMut(usize, [f64; 2]) -> f64,
) -> Result<(Vec<f64>, [f64; 2]), Error> {
    let plant = Law::Directional.plant(values)?;
    let mut arm = Integrator::new(plant, &[angle], &[velocity], Tolerances::default())?;
    let mut path = Vec::new();
    for k in 0..samples * FINER {
        let state = [arm.q()[0], arm.dq()[0]];
        if k.is_multiple_of(FINER) {
            path.push(state[0]);
        }
        arm.drive(held(current(k, state)));
        arm.advance((k + 1) as f64 / (RATE * FINER as f64))?;
    }
    Ok((path, [arm.q()[0], arm.dq()[0]]))
}

impl Own {
    /// The motion of an arm with the parameters of figure 7 under the voltage of the experiment: `fitted` samples after the first `before`.
    ///
    /// # Errors
    /// Where the simulator stops.
    pub fn new(before: usize, fitted: usize) -> Result<Self, Error> {
        let mut v = -VOLTS;
        let mut left = |k: usize, [angle, velocity]: [f64; 2]| {
            if k.is_multiple_of(FINER) && angle.abs() > TURN {
                v = -VOLTS * angle.signum();
            }
            v - BACK_EMF * velocity
        };
        let (_, start) = moved(&FIGURE_7, [0.0; 2], before, &mut left)?;
        let mut current = Vec::new();
        let (path, _) = moved(&FIGURE_7, start, fitted, |k, state| {
            current.push(left(k, state));
            current[k]
        })?;
        Ok(Self {
            start,
            current,
            path,
        })
    }

    /// The motion along the same current with other parameters, from another start.
    ///
    /// # Errors
    /// Where the simulator stops.
    pub fn again(&self, values: &[f64; 4], start: [f64; 2]) -> Result<Vec<f64>, Error> {
        let samples = self.path.len();
        Ok(moved(values, start, samples, |k, _| self.current[k])?.0)
    }
}

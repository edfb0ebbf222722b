//! Excitation: the motion from which parameters are identified best, within the limits of the arm.
//!
//! In: columns of a model as functions of the motion, with their slopes ([`Regressor`]), limits, and a [`Criterion`]. Out: a
//! [`Design`] with a periodic [`Fourier`] motion that keeps the limits at all times.
//!
//! Descent starts at random motions and stays inside the limits, so it may be stopped at any time; slopes of the criterion are exact.
//! The same seed gives the same motion, unless it is stopped early.

mod basis;
mod check;
mod clearance;
mod criterion;
mod error;
mod fourier;
mod function;
mod interior;
mod limits;
mod problem;
mod slack;
mod start;
#[cfg(test)]
mod tests;
mod verify;

pub use basis::Basis;
pub use clearance::{Ball, Clearance, Room, Tell, TorqueLimits};
pub use criterion::{Criterion, Rivals, Scaling};
pub use error::ExciteError;
pub use fourier::{Ends, Fourier};
pub use function::{Function, Regressor};
pub use limits::Limits;
pub use verify::Quality;

use criterion::Sharpness;
use fourier::Freedom;
use problem::{Problem, Stage};
use std::cell::Cell;

/// Instants of a period per harmonic, on which the criterion is computed and limits are kept.
const SAMPLES_PER_HARMONIC: usize = 40;

/// Barrier and sharpness from stage to stage, and most steps of each. Values are logarithms of a mean over parameters, barriers
/// means over instants: the last one costs some thousandths.
const STAGES: [(f64, f64, usize); 4] = [
    (3e-2, 2.0, 60),
    (5e-3, 4.0, 60),
    (1e-3, 8.0, 60),
    (2e-4, 16.0, 100),
];

/// Steps of all stages.
const MOST_STEPS: f64 = {
    let [first, second, third, last] = STAGES;
    (first.2 + second.2 + third.2 + last.2) as f64
};

/// How often a start from which some columns are not seen, as those of what sets in at a large torque, moves on by so many steps
/// toward a larger motion.
const WARMING: usize = 12;
const WARMING_STEPS: usize = 10;

/// Condition number of unit columns from which on its square is the rounding of a double: what is beyond tells nothing.
const MOST_CONDITION: f64 = 1e7;

/// A motion that is wanted.
#[derive(Debug)]
pub struct Request {
    /// Names of the joints.
    pub joints: Vec<String>,
    /// What is to be excited.
    pub regressor: Regressor,
    /// Of positions and their derivatives.
    pub limits: Limits,
    /// Of anything else.
    pub clearances: Vec<Box<dyn Clearance>>,
    /// What is wanted of the motion.
    pub criterion: Criterion,
    /// Parameters whose columns the criterion counts, in place of the regressor's own.
    pub basis: Option<Basis>,
    /// Columns as the criterion counts them.
    pub scaling: Scaling,
    /// Standard deviation of each joint's torque noise, N m or N, or in proportion to it.
    pub noise: Vec<f64>,
    /// Time after which the motion repeats, s.
    pub period: f64,
    /// Waves a joint.
    pub harmonics: usize,
    /// How it begins and ends.
    pub ends: Ends,
    /// Random motions to start from.
    pub starts: usize,
    /// Of the random motions.
    pub seed: u64,
}

/// Where the search is.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct Progress {
    /// Motions that were started from, this one among them.
    pub start: usize,
    /// What part of its steps this start has behind it, of as many as it takes at most: from 0 to 1.
    pub part: f64,
    /// The best value of the criterion so far.
    pub best: Option<f64>,
}

/// A motion, and what it is worth.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct Design {
    /// The motion.
    pub motion: Fourier,
    /// All criteria at it.
    pub quality: Quality,
    /// Variables of the search: the coefficients that are left free by how the motion begins and ends, of all joints.
    pub variables: usize,
    /// Motions that were started from.
    pub starts: usize,
    /// Whether it was stopped before the last one.
    pub stopped: bool,
}

impl Request {
    /// Looks for the motion. `watch` is told where the search is, and asked whether to go on; the best motion so far is what
    /// comes out.
    ///
    /// # Errors
    /// Limits that leave no motion, numbers that are none, columns that no motion within the limits excites.
    ///
    /// # Examples
    /// A rotor with a spring, `tau = ia ddq + k q`, that may move by 0.5 rad at 2 rad/s:
    /// ```
    /// # mod rotor { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/doc/rotor.rs")); }
    /// let request = rotor::request();
    /// let design = request.run(&|_| true)?;
    /// let along = design.motion.motion(&design.motion.instants(1000));
    /// assert!(along.q[0].iter().all(|q| q.abs() < 0.5) && along.dq[0].iter().all(|dq| dq.abs() < 2.0));
    /// assert_eq!(design.quality.violation, 0.0);
    /// // One joint with three harmonics: its mean, three sines and three cosines.
    /// assert_eq!(design.variables, 1 + 2 * 3);
    /// # Ok::<(), robot_model::excite::ExciteError>(())
    /// ```
    pub fn run(&self, watch: &dyn Fn(Progress) -> bool) -> Result<Design, ExciteError> {
        self.check()?;
        let weights: Vec<f64> = self.noise.iter().map(|noise| 1.0 / noise).collect();
        let mut problem = Problem::new(self, &weights);
        let mut best: Option<(f64, Fourier)> = None;
        let (mut starts, stopped) = (0, Cell::new(false));
        for start in 0..self.starts.max(1) {
            let value = |best: &Option<(f64, Fourier)>| best.as_ref().map(|best| best.0);
            let steps = Cell::new(0);
            let go_on = || {
                let so_far = Progress {
                    start: start + 1,
                    part: (f64::from(steps.get()) / MOST_STEPS).min(1.0),
                    best: value(&best),
                };
                steps.set(steps.get() + 1);
                stopped.set(stopped.get() || !watch(so_far));
                !stopped.get()
            };
            if best.is_some() && !go_on() {
                break;
            }
            starts += 1;
            let found = self.descend(&mut problem, start, &go_on)?;
            if value(&best).is_none_or(|best| found.0 < best) {
                best = Some(found);
            }
        }
        let (_, motion) = best.expect("at least one start");
        let quality = self.quality(&motion)?;
        let condition = quality.condition_of_unit_columns;
        if condition.is_nan() || condition > MOST_CONDITION {
            // Distances are squared.
            let is_imitated =
                |distances: [f64; 2]| distances.iter().any(|d| *d < MOST_CONDITION.powi(-2));
            let what = if quality.shares.is_some_and(is_imitated) {
                "one effect from the other one together with the arm's parameters"
            } else {
                "the parameters from each other"
            };
            return Err(ExciteError::NotExcited(what.to_owned()));
        }
        Ok(Design {
            quality,
            motion,
            variables: self.variables(),
            starts,
            stopped: stopped.get(),
        })
    }

    /// Coefficients that ends leave free, of all joints.
    fn variables(&self) -> usize {
        let joints = 0..self.joints.len();
        let freedom = |joint| Freedom::new(self.harmonics, self.period, &self.ends, joint);
        joints.map(|joint| freedom(joint).len()).sum()
    }

    /// Instants of a period on the coarse grid.
    fn samples(&self) -> usize {
        SAMPLES_PER_HARMONIC * self.harmonics
    }

    /// One descent.
    fn descend(
        &self,
        problem: &mut Problem<'_>,
        start: usize,
        go_on: &dyn Fn() -> bool,
    ) -> Result<(f64, Fourier), ExciteError> {
        problem.reserve.fill(0.0);
        let inside = start::inside(self, problem, start)?;
        let mut z = inside.clone();
        let stages = STAGES.map(|(barrier, sharpness, steps)| {
            let sharpness = Sharpness(sharpness);
            (Stage { barrier, sharpness }, steps)
        });
        problem.warms_up = true;
        for _ in 0..WARMING {
            if problem.has_a_value(&z) {
                break;
            }
            interior::descend(problem, &mut z, stages[0].0, WARMING_STEPS, go_on);
        }
        problem.warms_up = false;
        for (stage, steps) in stages {
            interior::descend(problem, &mut z, stage, steps, go_on);
        }
        let (last, steps) = stages[stages.len() - 1];
        // Reserves grow until the fine grid keeps all limits; beyond what the start has of slack there is only the start.
        while let Some(reserves) = self.missing(problem, &z) {
            problem.reserve = reserves;
            if !start::back_inside(problem, &inside, &mut z) {
                z = inside;
                break;
            }
            interior::descend(problem, &mut z, last, steps, go_on);
        }
        let motion = problem.fourier(&z);
        let mut a = problem.information_of(&problem.motion(&z));
        if let Some(basis) = &self.basis {
            a = basis.information(&a);
        }
        let exact = self.criterion.evaluate(&a, self.scaling, Sharpness(1e3));
        Ok((exact.map_or(f64::INFINITY, |valued| valued.value), motion))
    }
}

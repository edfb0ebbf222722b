//! Excitation: the motion from which parameters are identified best, within the limits of the arm.
//!
//! In: columns of a model as functions of the motion, with their slopes ([`Regressor`]), limits, and a [`Criterion`]. Out: a
//! [`Design`] with a periodic [`Fourier`] motion that keeps the limits at all times.
//!
//! Descent starts at random motions and stays inside the limits, so it may be stopped at any time; slopes of the criterion are exact.
//! The same seed gives the same motion, unless it is stopped early.

mod clearance;
mod criterion;
mod error;
mod fourier;
mod function;
mod interior;
mod limits;
mod problem;
mod start;
#[cfg(test)]
mod tests;
mod verify;

pub use clearance::{Ball, Clearance, Room, Tell, TorqueLimits};
pub use criterion::{Criterion, Rivals, Scaling};
pub use error::ExciteError;
pub use fourier::{Ends, Fourier};
pub use function::{Function, Regressor};
pub use limits::Limits;
pub use verify::Quality;

use criterion::Sharpness;
use problem::{Problem, Stage};

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
pub struct Progress {
    /// Motions that were started from, this one among them.
    pub start: usize,
    /// The best value of the criterion so far.
    pub best: Option<f64>,
}

/// A motion, and what it is worth.
#[derive(Debug, Clone, PartialEq)]
pub struct Design {
    /// The motion.
    pub motion: Fourier,
    /// All criteria at it.
    pub quality: Quality,
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
    pub fn run(&self, watch: &dyn Fn(Progress) -> bool) -> Result<Design, ExciteError> {
        self.check()?;
        let weights: Vec<f64> = self.noise.iter().map(|noise| 1.0 / noise).collect();
        let mut problem = Problem::new(
            &self.regressor,
            &self.clearances,
            &self.limits,
            &self.criterion,
            self.scaling,
            &weights,
            self.period,
            self.harmonics,
            &self.ends,
            self.samples(),
        );
        let mut best: Option<(f64, Fourier)> = None;
        let (mut starts, mut stopped) = (0, false);
        for start in 0..self.starts.max(1) {
            let value = |best: &Option<(f64, Fourier)>| best.as_ref().map(|best| best.0);
            let so_far = Progress {
                start: start + 1,
                best: value(&best),
            };
            if best.is_some() && !watch(so_far) {
                stopped = true;
                break;
            }
            starts += 1;
            let go_on = || watch(so_far);
            let found = self.descend(&mut problem, start, &go_on)?;
            if value(&best).is_none_or(|best| found.0 < best) {
                best = Some(found);
            }
        }
        let (_, motion) = best.expect("at least one start");
        Ok(Design {
            quality: self.quality(&motion)?,
            motion,
            starts,
            stopped,
        })
    }

    /// Instants of a period on the coarse grid.
    fn samples(&self) -> usize {
        SAMPLES_PER_HARMONIC * self.harmonics
    }

    /// One descent, with reserves that grow until the fine grid keeps all limits.
    fn descend(
        &self,
        problem: &mut Problem<'_>,
        start: usize,
        go_on: &dyn Fn() -> bool,
    ) -> Result<(f64, Fourier), ExciteError> {
        let inside = start::inside(self, problem, start)?;
        let mut z = inside.clone();
        let last = STAGES.len() - 1;
        for (k, &(barrier, sharpness, steps)) in STAGES.iter().enumerate() {
            let stage = Stage {
                barrier,
                sharpness: Sharpness(sharpness),
            };
            interior::descend(problem, &mut z, stage, steps, go_on);
            if k < last {
                continue;
            }
            while let Some(reserves) = self.missing(problem, &z) {
                problem.reserve = reserves;
                start::back_inside(problem, &inside, &mut z);
                interior::descend(problem, &mut z, stage, steps, go_on);
            }
        }
        let motion = problem.fourier(&z);
        let a = problem.information_of(&problem.motion(&z));
        let exact = self.criterion.evaluate(&a, self.scaling, Sharpness(1e3));
        Ok((exact.map_or(f64::INFINITY, |valued| valued.value), motion))
    }

    fn check(&self) -> Result<(), ExciteError> {
        let dof = self.joints.len();
        self.limits.check(&self.joints)?;
        let positive = [("period", self.period)];
        for (what, value) in positive {
            if !(value > 0.0 && value.is_finite()) {
                return Err(ExciteError::NotPositive { what, value });
            }
        }
        if self.harmonics < 2 {
            return Err(ExciteError::FewHarmonics(self.harmonics));
        }
        for (joint, &noise) in self.joints.iter().zip(&self.noise) {
            if !(noise > 0.0 && noise.is_finite()) {
                return Err(ExciteError::Noise {
                    joint: joint.clone(),
                    noise,
                });
            }
        }
        if let Ends::At(position) = &self.ends
            && position.len() != dof
        {
            return Err(ExciteError::Ends {
                given: position.len(),
                joints: dof,
            });
        }
        Ok(())
    }
}

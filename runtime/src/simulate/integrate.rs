//! Motion in time: smooth steps between events, events where they are, and a step of impulses where they crowd.
//!
//! Between events the sides of all jumps are held, so that steps are of high order. Where a velocity comes to zero, or a joint that
//! stands breaks away, the step ends there, to rounding, and what sticks is decided anew. Where that is too often, or a step would
//! have to be shorter than the floor, one implicit step of the first order over impulses is taken: no step is ever shorter.
//! In: a [`Plant`], where it is, and a [`Drive`]. Out: where it is at later times.

mod events;
mod steps;
mod tolerances;

use nalgebra::DVector;

use super::adjustable::Adjustable;
use super::error::SimulateError;
use super::motion::{Drive, Moving, Side};
use super::plant::Plant;
use super::tangent::{Passage, Tangent, Watch};
use steps::Start;
pub use tolerances::{Tolerances, Work};

/// Events with less than a step of impulses between them, after which these take over, and how far such steps grow.
const CROWD: u32 = 6;
const REACH: f64 = 256.0;

/// A plant in motion.
///
/// # Examples
/// A block on a table, that dry friction brings to rest:
/// ```
/// use nalgebra::{DMatrix, DVector};
/// use robot_model::simulate::{Instant, Integrator, Jumps, Plant, Slopes, Tolerances};
///
/// struct Block;
/// impl Plant for Block {
///     fn dof(&self) -> usize { 1 }
///     fn switches(&self) -> usize { 1 }
///     // 2 kg, and 3 N against the motion.
///     fn torque(&mut self, at: &Instant<'_>, torque: &mut DVector<f64>, inertia: &mut DMatrix<f64>) {
///         torque[0] = 2.0 * at.ddq[0] + 3.0 * at.switches[0];
///         inertia[(0, 0)] = 2.0;
///     }
///     fn arguments(&mut self, at: &Instant<'_>, arguments: &mut [f64]) { arguments[0] = at.dq[0]; }
///     fn jumps(&mut self, _: &Instant<'_>, jumps: &mut Jumps) {
///         jumps.halves[(0, 0)] = 3.0;
///         jumps.directions[(0, 0)] = 1.0;
///     }
///     fn slopes(&mut self, _: &Instant<'_>, _: &mut Slopes) {}
/// }
///
/// let mut block = Integrator::new(Block, &[0.0], &[1.0], Tolerances::default())?;
/// block.advance(2.0)?;
/// assert!((block.q()[0] - 2.0 / (2.0 * 3.0)).abs() < 1e-12);          // m v^2 / (2 F)
/// assert_eq!(block.dq()[0], 0.0);
/// # Ok::<(), robot_model::simulate::SimulateError>(())
/// ```
#[derive(Debug)]
pub struct Integrator<P> {
    moving: Moving<P>,
    tolerances: Tolerances,
    time: f64,
    x: DVector<f64>,
    /// Length of the next step.
    step: f64,
    is_stiff: bool,
    stiff_steps: u32,
    implicit_steps: u32,
    crowd: u32,
    /// Length of the next step of impulses.
    reach: f64,
    last_event: f64,
    work: Work,
}

impl<P: Plant> Integrator<P> {
    /// A plant at positions `q` with velocities `dq`, effects' states zero, at time 0 without torque.
    ///
    /// # Errors
    /// [`SimulateError::Size`] for other numbers of joints, [`SimulateError::Setting`] for tolerances that are none.
    ///
    /// # Examples
    /// ```
    /// # mod block { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/doc/block.rs")); }
    /// use robot_model::simulate::{Integrator, Tolerances};
    /// let block = Integrator::new(block::Block([2.0, 0.7]), &[0.2], &[0.5], Tolerances::default())?;
    /// assert_eq!((block.q()[0], block.dq()[0], block.time()), (0.2, 0.5, 0.0));
    /// # Ok::<(), robot_model::simulate::SimulateError>(())
    /// ```
    pub fn new(
        plant: P,
        q: &[f64],
        dq: &[f64],
        tolerances: Tolerances,
    ) -> Result<Self, SimulateError> {
        for (what, found) in [("the initial position", q), ("the initial velocity", dq)] {
            if found.len() != plant.dof() {
                return Err(SimulateError::Size {
                    what,
                    found: found.len(),
                    expected: plant.dof(),
                });
            }
        }
        for (what, value) in [
            ("the relative tolerance", tolerances.relative),
            ("the absolute tolerance", tolerances.absolute),
            ("the shortest step", tolerances.floor),
        ] {
            if !(value > 0.0 && value < 1.0) {
                return Err(SimulateError::Setting {
                    what,
                    range: "between 0 and 1",
                    value,
                });
            }
        }
        let memory = vec![0.0; plant.states()];
        Ok(Self {
            moving: Moving::new(plant),
            tolerances,
            time: 0.0,
            x: DVector::from_vec([q, dq, &memory].concat()),
            step: 1e-3,
            is_stiff: false,
            stiff_steps: 0,
            implicit_steps: 0,
            crowd: 0,
            reach: tolerances.floor,
            last_event: f64::NEG_INFINITY,
            work: Work::default(),
        })
    }

    /// The same motion, begun at another time than 0.
    ///
    /// # Examples
    /// ```
    /// # mod block { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/doc/block.rs")); }
    /// assert_eq!(block::sliding().begun_at(7.0).time(), 7.0);
    /// ```
    #[must_use]
    pub fn begun_at(mut self, time: f64) -> Self {
        self.time = time;
        self
    }

    /// Time, s.
    ///
    /// # Examples
    /// ```
    /// # mod block { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/doc/block.rs")); }
    /// let mut block = block::sliding();
    /// block.advance(0.3)?;
    /// assert_eq!(block.time(), 0.3);
    /// # Ok::<(), robot_model::simulate::SimulateError>(())
    /// ```
    #[must_use]
    pub fn time(&self) -> f64 {
        self.time
    }

    /// Positions, rad or m.
    ///
    /// # Examples
    /// ```
    /// # mod block { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/doc/block.rs")); }
    /// let mut block = block::sliding(); // from 0.2 m with 0.5 m/s, and 0.7 N s/m hold 2 kg back
    /// block.advance(1.0)?;
    /// assert!((block.q()[0] - (0.2 + 0.5 * (1.0 - (-0.35_f64).exp()) / 0.35)).abs() < 1e-9);
    /// # Ok::<(), robot_model::simulate::SimulateError>(())
    /// ```
    #[must_use]
    pub fn q(&self) -> &[f64] {
        &self.x.as_slice()[..self.moving.plant.dof()]
    }

    /// Velocities.
    ///
    /// # Examples
    /// ```
    /// # mod block { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/doc/block.rs")); }
    /// let mut block = block::sliding(); // 2 kg with 0.5 m/s that 0.7 N s/m hold back
    /// block.advance(1.0)?;
    /// assert!((block.dq()[0] - 0.5 * (-0.35_f64).exp()).abs() < 1e-9);
    /// # Ok::<(), robot_model::simulate::SimulateError>(())
    /// ```
    #[must_use]
    pub fn dq(&self) -> &[f64] {
        let dof = self.moving.plant.dof();
        &self.x.as_slice()[dof..2 * dof]
    }

    /// Internal states of effects.
    ///
    /// # Examples
    /// ```
    /// # mod cart { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/doc/cart.rs")); }
    /// use robot_model::simulate::{Integrator, Tolerances};
    /// // A filter of 0.5 s sees a load that begins with 1 m/s.
    /// let mut cart = Integrator::new(cart::Cart, &[0.0, 0.0], &[1.0, 1.0], Tolerances::default())?;
    /// cart.advance(0.001)?;
    /// assert!((cart.memory()[0] - 0.002).abs() < 1e-5);
    /// # Ok::<(), robot_model::simulate::SimulateError>(())
    /// ```
    #[must_use]
    pub fn memory(&self) -> &[f64] {
        &self.x.as_slice()[2 * self.moving.plant.dof()..]
    }

    /// Which switches are held on their jumps: joints that stick, as a rule.
    ///
    /// # Examples
    /// ```
    /// # mod cart { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/doc/cart.rs")); }
    /// use robot_model::simulate::{Integrator, Tolerances};
    /// // A spring pulls a load with 2 N, which friction of 3 N holds.
    /// let mut cart = Integrator::new(cart::Cart, &[0.02, 0.0], &[0.0, 0.0], Tolerances::default())?;
    /// let _ = cart.accelerations()?;
    /// assert_eq!(cart.held(), [true]);
    /// # Ok::<(), robot_model::simulate::SimulateError>(())
    /// ```
    #[must_use]
    pub fn held(&self) -> Vec<bool> {
        let sides = self.moving.sides.iter();
        sides.map(|side| !matches!(side, Side::Free(_))).collect()
    }

    /// The plant.
    ///
    /// # Examples
    /// ```
    /// # mod block { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/doc/block.rs")); }
    /// let mut block = block::sliding();
    /// // 0.7 N s/m at 0.5 m/s hold it back; then it weighs 7 kg.
    /// assert_eq!(block.accelerations()?, [-0.175]);
    /// block.plant_mut().0[0] = 7.0;
    /// assert!((block.accelerations()?[0] + 0.05).abs() < 1e-15);
    /// # Ok::<(), robot_model::simulate::SimulateError>(())
    /// ```
    pub fn plant_mut(&mut self) -> &mut P {
        &mut self.moving.plant
    }

    /// What the motion took so far.
    ///
    /// # Examples
    /// ```
    /// # mod block { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/doc/block.rs")); }
    /// let mut block = block::sliding();
    /// block.advance(1.0)?;
    /// assert!(block.work().explicit > 0 && block.work().events == 0); // on oil nothing jumps
    /// # Ok::<(), robot_model::simulate::SimulateError>(())
    /// ```
    #[must_use]
    pub fn work(&self) -> Work {
        Work {
            evaluations: self.moving.evaluations,
            ..self.work
        }
    }

    /// From here on torque and inputs are these; degrees of freedom without a motor have no torque.
    ///
    /// # Examples
    /// ```
    /// # mod block { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/doc/block.rs")); }
    /// use robot_model::simulate::{Drive, Integrator, Tolerances};
    /// // 2 kg that are pushed with 4 N, from 7 s on.
    /// let mut block = Integrator::new(block::Block([2.0, 0.0]), &[0.0], &[0.0], Tolerances::default())?.begun_at(7.0);
    /// block.drive(Drive { torque: vec![4.0], ..Drive::default() });
    /// assert_eq!(block.accelerations()?, [2.0]);
    /// block.advance(10.0)?;
    /// assert!((block.dq()[0] - 6.0).abs() < 1e-9 && (block.q()[0] - 9.0).abs() < 1e-9);
    /// # Ok::<(), robot_model::simulate::SimulateError>(())
    /// ```
    pub fn drive(&mut self, mut drive: Drive) {
        drive.torque.resize(self.moving.plant.dof(), 0.0);
        self.moving.drive = drive;
    }

    /// Accelerations at this instant.
    ///
    /// # Errors
    /// As [`Self::advance`].
    ///
    /// # Examples
    /// ```
    /// # mod block { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/doc/block.rs")); }
    /// assert_eq!(block::sliding().accelerations()?, [-0.175]); // 0.7 N s/m at 0.5 m/s, of 2 kg
    /// # Ok::<(), robot_model::simulate::SimulateError>(())
    /// ```
    pub fn accelerations(&mut self) -> Result<Vec<f64>, SimulateError> {
        self.moving.settle(self.time, &mut self.x)?;
        self.moving.rate(self.time, &self.x)?;
        Ok(self.moving.ddq.as_slice().to_vec())
    }

    /// Moves on to `end`, s, under a torque that is held.
    ///
    /// # Errors
    /// [`SimulateError`] says where the motion has no continuation; [`SimulateError::Setting`] of an end that is before the present time.
    ///
    /// # Examples
    /// ```
    /// # mod block { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/doc/block.rs")); }
    /// let mut block = block::sliding();
    /// block.advance(2.0)?;
    /// assert!((block.dq()[0] - 0.5 * (-0.35 * 2.0_f64).exp()).abs() < 1e-9);
    /// # Ok::<(), robot_model::simulate::SimulateError>(())
    /// ```
    pub fn advance(&mut self, end: f64) -> Result<(), SimulateError> {
        self.go(end, &mut ())
    }

    /// As [`Self::advance`], with sensitivities beside the motion.
    ///
    /// # Errors
    /// As [`Self::advance`].
    ///
    /// # Examples
    /// ```
    /// # mod block { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/doc/block.rs")); }
    /// use robot_model::simulate::Tangent;
    /// // dq = v exp(-c t / m), so d dq / dc = -t dq / m; unknown are m and c, on which the start does not depend.
    /// let mut tangent = Tangent::new(&block::Block([2.0, 0.7]), nalgebra::DMatrix::zeros(2, 2));
    /// let mut block = block::sliding();
    /// block.advance_with(1.0, &mut tangent)?;
    /// assert!((tangent.state[(1, 1)] + 0.5 * block.dq()[0]).abs() < 1e-8);
    /// # Ok::<(), robot_model::simulate::SimulateError>(())
    /// ```
    pub fn advance_with(&mut self, end: f64, tangent: &mut Tangent) -> Result<(), SimulateError>
    where
        P: Adjustable,
    {
        self.go(end, tangent)
    }

    fn go(&mut self, end: f64, watch: &mut impl Watch<P>) -> Result<(), SimulateError> {
        if end.is_nan() || end < self.time {
            return Err(SimulateError::back_to(end));
        }
        self.moving.settle(self.time, &mut self.x)?;
        let mut start = None;
        // What is less than a rounding of time is no time.
        while end - self.time > 1e-15 * end.abs().max(1.0) {
            let left = end - self.time;
            // Two steps of half the length in place of a long one and a tiny one.
            let h = match self.step {
                step if step >= left => left,
                step if step >= 0.5 * left => 0.5 * left,
                step => step,
            };
            if let Some(error) = self.moving.unbounded(self.time, &self.x) {
                return Err(error);
            }
            let from = match start.take() {
                Some(from) => from,
                None => self.start()?,
            };
            if h < self.tolerances.floor && h < left {
                self.impulse(left, watch)?;
                continue;
            }
            let trial = self.trial(&from, h);
            let trial = match trial {
                Ok(trial) if trial.error.is_finite() => trial,
                _ => {
                    self.shorten(h, 0.1);
                    start = self.same_start(from);
                    continue;
                }
            };
            if trial.error > 1.0 {
                self.shorten(h, self.factor(trial.error));
                start = self.same_start(from);
                continue;
            }
            let passed = self.passed(self.time + h, &trial.end)?;
            if passed.is_empty() {
                let step = Passage {
                    start: self.time,
                    length: h,
                    x: &self.x,
                    y: &trial.end,
                    is_explicit: !self.is_stiff,
                };
                watch.moved(&mut self.moving, &step)?;
                self.accept(h, left, &trial);
                let next = trial.rate.filter(|_| !self.is_stiff);
                start = next.map(|rate| Start { rate, slopes: None });
            } else if self.crowd < CROWD {
                self.event(&from, h, trial.end, &passed, watch)?;
            } else {
                self.impulse(left, watch)?;
            }
        }
        self.time = end;
        Ok(())
    }
}

//! Motion in time: smooth steps between events, events where they are, and a step of impulses where they crowd.
//!
//! Between events the sides of all jumps are held, so that steps are of high order. Where a velocity comes to zero, or a joint that
//! stands breaks away, the step ends there, to rounding, and what sticks is decided anew. Where that is too often, or a step would
//! have to be shorter than the floor, one implicit step of the first order over impulses is taken: no step is ever shorter.

use nalgebra::{DMatrix, DVector};

use super::error::SimulateError;
use super::motion::{Drive, Moving, Side, ZERO};
use super::plant::Plant;
use super::{explicit, implicit};

/// How exact a motion is.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Tolerances {
    /// Error of a step relative to each position, velocity and state.
    pub relative: f64,
    /// The same of what is near zero.
    pub absolute: f64,
    /// Shortest step of high order, s: below it impulses take over, which grow where they follow each other.
    pub floor: f64,
}

impl Default for Tolerances {
    fn default() -> Self {
        Self {
            relative: 1e-10,
            absolute: 1e-11,
            floor: 1e-6,
        }
    }
}

/// What a motion took.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Work {
    /// Steps of high order for motions that are not stiff.
    pub explicit: u64,
    /// Linearly implicit steps of high order.
    pub implicit: u64,
    /// Steps of the first order over impulses.
    pub impulses: u64,
    /// Steps that were too long.
    pub rejected: u64,
    /// Joints that stop, turn round, or break away, and other jumps.
    pub events: u64,
    /// Solutions for accelerations.
    pub evaluations: u64,
}

/// Stability of the explicit steps ends here, and so many steps beyond it are enough to know.
const STIFF: f64 = 3.25;
const STIFF_STEPS: u32 = 6;

/// Implicit steps after which explicit ones are tried again.
const TRIAL: u32 = 400;

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

/// A trial of a step.
struct Trial {
    end: DVector<f64>,
    /// Error over what is allowed.
    error: f64,
    stiffness: f64,
    /// Rate at the end, where the step has it.
    rate: Option<DVector<f64>>,
}

/// What the steps of one start share.
struct Start {
    rate: DVector<f64>,
    /// For implicit steps: slopes by the state and by time.
    slopes: Option<(DMatrix<f64>, DVector<f64>)>,
}

impl<P: Plant> Integrator<P> {
    /// A plant at positions `q` with velocities `dq`, effects' states zero, at time 0 without torque.
    ///
    /// # Errors
    /// [`SimulateError::Size`] for other numbers of joints, [`SimulateError::Setting`] for tolerances that are none.
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

    /// Time, s.
    #[must_use]
    pub fn time(&self) -> f64 {
        self.time
    }

    /// Positions, rad or m.
    #[must_use]
    pub fn q(&self) -> &[f64] {
        &self.x.as_slice()[..self.moving.plant.dof()]
    }

    /// Velocities.
    #[must_use]
    pub fn dq(&self) -> &[f64] {
        let dof = self.moving.plant.dof();
        &self.x.as_slice()[dof..2 * dof]
    }

    /// Internal states of effects.
    #[must_use]
    pub fn memory(&self) -> &[f64] {
        &self.x.as_slice()[2 * self.moving.plant.dof()..]
    }

    /// Which switches are held on their jumps: joints that stick, as a rule.
    #[must_use]
    pub fn held(&self) -> Vec<bool> {
        let sides = self.moving.sides.iter();
        sides.map(|side| !matches!(side, Side::Free(_))).collect()
    }

    /// The plant.
    pub fn plant_mut(&mut self) -> &mut P {
        &mut self.moving.plant
    }

    /// What the motion took so far.
    #[must_use]
    pub fn work(&self) -> Work {
        Work {
            evaluations: self.moving.evaluations,
            ..self.work
        }
    }

    /// From here on torque and inputs are these.
    pub fn drive(&mut self, drive: Drive) {
        self.moving.drive = drive;
    }

    /// Accelerations at this instant.
    ///
    /// # Errors
    /// As [`Self::advance`].
    pub fn accelerations(&mut self) -> Result<Vec<f64>, SimulateError> {
        self.moving.settle(self.time, &mut self.x)?;
        self.moving.rate(self.time, &self.x)?;
        Ok(self.moving.ddq.as_slice().to_vec())
    }

    /// Moves on to `end`, s, under a torque that is held.
    ///
    /// # Errors
    /// [`SimulateError`] says where the motion has no continuation.
    pub fn advance(&mut self, end: f64) -> Result<(), SimulateError> {
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
                self.impulse(left)?;
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
                self.accept(h, left, &trial);
                let next = trial.rate.filter(|_| !self.is_stiff);
                start = next.map(|rate| Start { rate, slopes: None });
            } else if self.crowd < CROWD {
                self.event(&from, h, trial.end, &passed)?;
            } else {
                self.impulse(left)?;
            }
        }
        self.time = end;
        Ok(())
    }

    /// The start of further tries, if the kind of steps is the same.
    fn same_start(&self, from: Start) -> Option<Start> {
        (from.slopes.is_some() == self.is_stiff).then_some(from)
    }

    fn start(&mut self) -> Result<Start, SimulateError> {
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

    fn trial(&mut self, from: &Start, h: f64) -> Result<Trial, SimulateError> {
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
                let (end, error) = step.ok_or(SimulateError::NoInertia { time: self.time })?;
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

    fn factor(&self, error: f64) -> f64 {
        let order = if self.is_stiff { 4.0 } else { 5.0 };
        (0.9 * error.max(1e-10).powf(-1.0 / order)).clamp(0.2, 5.0)
    }

    fn shorten(&mut self, h: f64, factor: f64) {
        self.work.rejected += 1;
        self.step = h * factor;
        // Before the floor ends the explicit steps, implicit ones are tried.
        if !self.is_stiff && self.step < 10.0 * self.tolerances.floor {
            self.is_stiff = true;
            self.implicit_steps = 0;
        }
    }

    fn accept(&mut self, h: f64, left: f64, trial: &Trial) {
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

    /// How far each switch is from the end of its side: negative beyond it.
    fn margins(&mut self, time: f64, x: &DVector<f64>) -> Result<Vec<f64>, SimulateError> {
        let arguments = self.moving.arguments(time, x);
        if self.moving.holds_any() {
            self.moving.rate(time, x)?;
        }
        let sides = self.moving.sides.iter().enumerate();
        let margins = sides.map(|(k, side)| match side {
            Side::Free(sign) => sign * arguments[k],
            Side::Held => 1.0 - self.moving.shares[k].abs(),
            // It follows those that hold with it.
            Side::Shared(_) => 1.0,
        });
        Ok(margins.collect())
    }

    /// Switches whose side ends before the end of a step.
    fn passed(&mut self, time: f64, end: &DVector<f64>) -> Result<Vec<usize>, SimulateError> {
        if self.moving.sides.is_empty() {
            return Ok(Vec::new());
        }
        let margins = self.margins(time, end)?;
        let passed = |k: &usize| margins[*k] < -0.1 * ZERO;
        Ok((0..margins.len()).filter(passed).collect())
    }

    /// Goes to the first of events in a step.
    fn event(
        &mut self,
        from: &Start,
        h: f64,
        end: DVector<f64>,
        passed: &[usize],
    ) -> Result<(), SimulateError> {
        let start = self.time;
        let margin =
            |integrator: &mut Self, share: f64| -> Result<(f64, DVector<f64>), SimulateError> {
                let x = integrator.trial(from, share * h)?.end;
                let margins = integrator.margins(start + share * h, &x)?;
                let least = passed
                    .iter()
                    .map(|&k| margins[k])
                    .fold(f64::INFINITY, f64::min);
                Ok((least, x))
            };
        let margins = self.margins(start + h, &end)?;
        let beyond = passed
            .iter()
            .map(|&k| margins[k])
            .fold(f64::INFINITY, f64::min);
        let (mut low, mut at_low) = (0.0, 0.0);
        let (mut high, mut at_high, mut x) = (1.0, beyond, end);
        // What has just begun to move has no margin yet: the first share at which it has one.
        let begins = self.margins(start, &self.x.clone())?;
        let least = passed
            .iter()
            .map(|&k| begins[k])
            .fold(f64::INFINITY, f64::min);
        if least > ZERO {
            at_low = least;
        } else {
            let mut share = 0.5;
            while share * h > 0.1 * self.tolerances.floor {
                let (value, place) = margin(self, share)?;
                if value > 0.0 {
                    (low, at_low) = (share, value);
                    break;
                }
                (high, at_high, x) = (share, value, place);
                share *= 0.5;
            }
        }
        // Illinois: secants that halve the weight of an end that stays.
        let mut last = 0;
        for _ in 0..80 {
            if at_high.abs() < 1e-15 || (high - low) * h < 1e-15 * start.abs().max(1e-3) {
                break;
            }
            let mut share = (low * at_high - high * at_low) / (at_high - at_low);
            if !(share > low && share < high) {
                share = 0.5 * (low + high);
            }
            let (value, place) = margin(self, share)?;
            if value > 0.0 {
                (low, at_low) = (share, value);
                if last == 1 {
                    at_high *= 0.5;
                }
                last = 1;
            } else {
                (high, at_high, x) = (share, value, place);
                if last == -1 {
                    at_low *= 0.5;
                }
                last = -1;
            }
        }
        let at = high * h;
        self.x = x;
        self.time = start + at;
        // The step is not to be blamed for the event.
        self.step = self.step.max(h);
        self.work.events += 1;
        if at < self.reach && start - self.last_event <= self.reach {
            self.crowd += 1;
        }
        self.last_event = self.time;
        let margins = self.margins(self.time, &self.x.clone())?;
        for &k in passed {
            if let (Side::Free(sign), true) = (self.moving.sides[k], margins[k] <= ZERO) {
                self.moving.sides[k] = Side::Free(-sign);
            }
        }
        self.moving.settle(self.time, &mut self.x)
    }

    /// A step of impulses.
    fn impulse(&mut self, left: f64) -> Result<(), SimulateError> {
        let h = self.reach.min(left);
        self.x = self.moving.impulse(self.time, &self.x, h)?;
        self.time += h;
        self.reach = (2.0 * self.reach).min(REACH * self.tolerances.floor);
        self.step = self.step.max(8.0 * self.tolerances.floor);
        self.crowd = self.crowd.saturating_sub(1);
        self.last_event = self.time;
        self.work.impulses += 1;
        self.moving.settle(self.time, &mut self.x)
    }
}

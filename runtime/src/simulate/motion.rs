//! Accelerations of a plant, with jumps of its torque held or crossed.
//!
//! In: a [`Plant`], a state `x = (q, dq, z)` and on which side of each jump the motion is. Out: its rate `dx/dt` and slopes.
//! Where it is on a jump, `contacts` decides on which side it goes on.

mod contacts;
mod newton;
mod parameters;

use std::iter::repeat;

use nalgebra::{DMatrix, DVector, Dyn, LU};

use super::error::SimulateError;
use super::plant::{Instant, Jumps, Plant, Slopes};

/// Arguments of switches this small are zero: velocities of joints that stand.
pub(super) const ZERO: f64 = 1e-11;

/// Where a motion is with regard to a jump.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Side {
    /// On one side: 1 or -1.
    Free(f64),
    /// On the jump, held by as much of it as that takes.
    Held,
    /// On the jump, which other contacts hold as well: with this share of it.
    Shared(f64),
}

/// What comes from outside: torque that is held, inputs that change linearly.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Drive {
    /// Torque of the motors, N m or N; those that are missing have none.
    pub torque: Vec<f64>,
    /// Inputs at [`Self::since`].
    pub inputs: Vec<f64>,
    /// Their rates, 1/s; those that are missing are zero.
    pub input_rates: Vec<f64>,
    /// When the inputs have their values, s.
    pub since: f64,
}

impl Drive {
    fn inputs_at(&self, time: f64) -> Vec<f64> {
        let rates = self.input_rates.iter().copied().chain(repeat(0.0));
        let inputs = self.inputs.iter().zip(rates);
        inputs
            .map(|(x, rate)| x + rate * (time - self.since))
            .collect()
    }
}

/// A motion's slopes at a state.
pub(super) struct Linear {
    pub rate: DVector<f64>,
    /// By the state.
    pub jacobian: DMatrix<f64>,
    /// `[A W; G 0]` of what is held, factored.
    bordered: LU<f64, Dyn, Dyn>,
    rates_by_acceleration: DMatrix<f64>,
}

/// A plant with where it is on its jumps.
#[derive(Debug)]
pub(super) struct Moving<P> {
    pub plant: P,
    pub drive: Drive,
    pub sides: Vec<Side>,
    /// Accelerations and shares of the last solution.
    pub ddq: DVector<f64>,
    pub shares: DVector<f64>,
    torque: DVector<f64>,
    inertia: DMatrix<f64>,
    jumps: Jumps,
    pub evaluations: u64,
}

/// Positions, velocities and states of a whole state.
fn parts(x: &DVector<f64>, dof: usize) -> (&[f64], &[f64], &[f64]) {
    let (q, rest) = x.as_slice().split_at(dof);
    let (dq, z) = rest.split_at(dof);
    (q, dq, z)
}

/// What shares that are looked for are measured by: all of a jump, not the little of it that may hold a joint.
pub(super) fn share_size(looked_for: &[usize]) -> f64 {
    if looked_for.is_empty() { 0.0 } else { 1.0 }
}

impl<P: Plant> Moving<P> {
    pub fn new(plant: P) -> Self {
        let (n, m) = (plant.dof(), plant.switches());
        Self {
            drive: Drive {
                torque: vec![0.0; n],
                ..Drive::default()
            },
            sides: vec![Side::Free(1.0); m],
            ddq: DVector::zeros(n),
            shares: DVector::zeros(m),
            torque: DVector::zeros(n),
            inertia: DMatrix::zeros(n, n),
            jumps: Jumps::zeros(&plant),
            plant,
            evaluations: 0,
        }
    }

    fn with<R>(
        &mut self,
        time: f64,
        x: &DVector<f64>,
        call: impl FnOnce(&mut P, &Instant<'_>, &mut DVector<f64>, &mut DMatrix<f64>, &mut Jumps) -> R,
    ) -> R {
        let (q, dq, memory) = parts(x, self.plant.dof());
        let inputs = self.drive.inputs_at(time);
        let at = Instant {
            time,
            q,
            dq,
            ddq: self.ddq.as_slice(),
            memory,
            switches: self.shares.as_slice(),
            torque: &self.drive.torque,
            inputs: &inputs,
        };
        call(
            &mut self.plant,
            &at,
            &mut self.torque,
            &mut self.inertia,
            &mut self.jumps,
        )
    }

    /// What switches are signs of.
    pub fn arguments(&mut self, time: f64, x: &DVector<f64>) -> Vec<f64> {
        let mut arguments = vec![0.0; self.plant.switches()];
        if !arguments.is_empty() {
            self.with(time, x, |plant, at, _, _, _| {
                plant.arguments(at, &mut arguments);
            });
        }
        arguments
    }

    fn held(&self) -> Vec<usize> {
        let sides = self.sides.iter().enumerate();
        let held = sides.filter(|(_, side)| **side == Side::Held);
        held.map(|(k, _)| k).collect()
    }

    pub fn holds_any(&self) -> bool {
        self.sides.iter().any(|side| !matches!(side, Side::Free(_)))
    }

    /// Accelerations and shares, with everything held that is.
    fn accelerate(&mut self, time: f64, x: &DVector<f64>) -> Result<DMatrix<f64>, SimulateError> {
        self.evaluations += 1;
        for (share, side) in self.shares.iter_mut().zip(&self.sides) {
            *share = match *side {
                Side::Free(sign) => sign,
                Side::Held => 0.0,
                Side::Shared(share) => share,
            };
        }
        let held = self.held();
        let shares = self.shares.clone();
        if let Some(matrix) = self.newton(time, x, &held, false)? {
            return Ok(matrix);
        }
        self.shares = shares;
        let matrix = self.newton(time, x, &held, true)?;
        matrix.ok_or(SimulateError::NoAcceleration { time })
    }

    /// The joint whose velocity alone a switch looks at.
    fn lone_joint(&self, switch: usize) -> Option<usize> {
        let row = self.jumps.directions.row(switch);
        let mut joints = row.iter().enumerate().filter(|(_, slope)| **slope != 0.0);
        let (joint, _) = joints.next()?;
        joints.next().is_none().then_some(joint)
    }

    /// `[A W; G 0]` of what is held.
    fn bordered(&self, held: &[usize]) -> DMatrix<f64> {
        let dof = self.plant.dof();
        let size = dof + held.len();
        let mut matrix = DMatrix::zeros(size, size);
        matrix.view_mut((0, 0), (dof, dof)).copy_from(&self.inertia);
        for (row, &k) in held.iter().enumerate() {
            for joint in 0..dof {
                matrix[(joint, dof + row)] = self.jumps.halves[(joint, k)];
                matrix[(dof + row, joint)] = self.jumps.directions[(k, joint)];
            }
        }
        matrix
    }

    /// Why there are no accelerations.
    fn no_solution(&self, time: f64, x: &DVector<f64>) -> SimulateError {
        if let Some(error) = self.unbounded(time, x) {
            return error;
        }
        match self.torque.iter().position(|torque| torque.is_nan()) {
            Some(k) => SimulateError::NoTorque {
                time,
                joint: self.plant.joint(k) + 1,
            },
            None => SimulateError::NoInertia { time },
        }
    }

    /// The first entry of a state that is no number.
    pub fn unbounded(&self, time: f64, x: &DVector<f64>) -> Option<SimulateError> {
        /// Nothing that an arm does is as large: no position and no velocity, no state of an effect.
        const MOST: [f64; 2] = [1e6, 1e9];
        let dof = self.plant.dof();
        let most = |k: usize| MOST[usize::from(k >= 2 * dof)];
        let k = (0..x.len()).find(|&k| x[k].is_nan() || x[k].abs() > most(k))?;
        Some(if k < 2 * dof {
            SimulateError::Unbounded {
                time,
                joint: self.plant.joint(k % dof) + 1,
            }
        } else {
            SimulateError::UnboundedState {
                time,
                state: k - 2 * dof + 1,
            }
        })
    }

    /// `dx/dt`
    pub fn rate(&mut self, time: f64, x: &DVector<f64>) -> Result<DVector<f64>, SimulateError> {
        self.accelerate(time, x)?;
        Ok(self.rate_at_solution(time, x))
    }

    fn rate_at_solution(&mut self, time: f64, x: &DVector<f64>) -> DVector<f64> {
        let dof = self.plant.dof();
        let mut rate = DVector::zeros(x.len());
        rate.rows_mut(0, dof).copy_from(&x.rows(dof, dof));
        rate.rows_mut(dof, dof).copy_from(&self.ddq);
        if self.plant.states() > 0 {
            let rates = &mut rate.as_mut_slice()[2 * dof..];
            self.with(time, x, |plant, at, _, _, _| plant.rates(at, rates));
        }
        rate
    }

    /// `dx/dt` and its slope by `x`.
    pub fn linearized(
        &mut self,
        time: f64,
        x: &DVector<f64>,
    ) -> Result<(DVector<f64>, DMatrix<f64>), SimulateError> {
        let linear = self.linearize(time, x)?;
        Ok((linear.rate, linear.jacobian))
    }

    /// The same, with what other slopes are made of.
    pub fn linearize(&mut self, time: f64, x: &DVector<f64>) -> Result<Linear, SimulateError> {
        let dof = self.plant.dof();
        let bordered = self.accelerate(time, x)?.lu();
        let mut slopes = Slopes::zeros(&self.plant);
        self.with(time, x, |plant, at, _, _, _| plant.slopes(at, &mut slopes));
        let side_by_side = |parts: &[DMatrix<f64>; 3], rows: usize, sign: f64| {
            let mut all = DMatrix::zeros(rows, x.len());
            let mut column = 0;
            for part in parts {
                all.view_mut((0, column), part.shape())
                    .copy_from(&(part * sign));
                column += part.ncols();
            }
            all
        };
        let torque = side_by_side(&slopes.torque, dof, -1.0);
        let rates = side_by_side(&slopes.rates, self.plant.states(), 1.0);
        let mut linear = Linear {
            rate: self.rate_at_solution(time, x),
            jacobian: DMatrix::zeros(0, 0),
            bordered,
            rates_by_acceleration: slopes.rates_by_acceleration,
        };
        let Ok(mut jacobian) = self.by_unknowns(time, &linear, &torque, &rates) else {
            return Err(self.no_solution(time, x));
        };
        for joint in 0..dof {
            jacobian[(joint, dof + joint)] = 1.0;
        }
        linear.jacobian = jacobian;
        Ok(linear)
    }

    /// Slopes of `dx/dt` by unknowns, where with accelerations held those of torque left over and of states' rates are these.
    pub fn by_unknowns(
        &self,
        time: f64,
        linear: &Linear,
        torque: &DMatrix<f64>,
        rates: &DMatrix<f64>,
    ) -> Result<DMatrix<f64>, SimulateError> {
        let (dof, states, count) = (self.plant.dof(), self.plant.states(), torque.ncols());
        let held = self.held();
        let mut right = DMatrix::zeros(dof + held.len(), count);
        right.rows_mut(0, dof).copy_from(torque);
        if !linear.bordered.solve_mut(&mut right) {
            return Err(SimulateError::NoInertia { time });
        }
        for joint in self.standing() {
            right.row_mut(joint).fill(0.0);
        }
        let accelerations = right.rows(0, dof);
        let mut slopes = DMatrix::zeros(2 * dof + states, count);
        slopes.rows_mut(dof, dof).copy_from(&accelerations);
        slopes
            .rows_mut(2 * dof, states)
            .copy_from(&(&linear.rates_by_acceleration * accelerations + rates));
        // Where an equation has a cusp, as `abs(z)^n` has, a step does without the slope.
        slopes.apply(|slope| {
            if !slope.is_finite() {
                *slope = 0.0;
            }
        });
        Ok(slopes)
    }

    /// Joints whose velocities are held at zero.
    pub fn standing(&self) -> impl Iterator<Item = usize> {
        let held = self.held().into_iter();
        held.filter_map(|k| self.lone_joint(k))
    }
}

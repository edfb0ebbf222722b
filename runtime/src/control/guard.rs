//! The frame of every cycle: look at what was read, run the law or hold the arm, stay within the limits.

use super::command::{Command, Reason, Signal, Status};
use super::error::ControlError;
use super::safety::Safety;
use crate::model::{RobotModel, Vector};
use crate::scalar::Scalar;
use crate::state::State;

/// Limits, and what the safe torque needs to know of earlier cycles.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Guard<const D: usize> {
    safety: Safety<D>,
    /// Names of the joints, for what is said of limits.
    joints: &'static [&'static str; D],
    /// The last position that was numbers inside of its limits.
    seen: Option<Vector<D>>,
}

impl<const D: usize> Guard<D> {
    /// Without limits.
    pub(super) fn new(joints: &'static [&'static str; D]) -> Self {
        Self {
            safety: Safety::new(),
            joints,
            seen: None,
        }
    }

    /// The same within limits, where these make sense, before its first cycle.
    pub(super) fn within(self, safety: Safety<D>) -> Result<Self, ControlError> {
        safety.check(self.joints)?;
        Ok(Self {
            safety,
            seen: None,
            ..self
        })
    }

    /// One cycle: the law's torque where all that it reads is sound and its torque finite, the safe torque else.
    pub(super) fn cycle<
        A,
        const S: usize,
        const B: usize,
        const H: usize,
        const M: usize,
        const I: usize,
    >(
        &mut self,
        arm: &A,
        measured: &State<D, M, I>,
        desired: Option<&State<D>>,
        law: impl FnOnce() -> Vector<D>,
    ) -> Command<D>
    where
        A: RobotModel<D, S, B, H, M, I>,
    {
        if let Some(reason) = self.fault(measured, desired) {
            return self.hold(arm, measured, reason);
        }
        let torque = law();
        match flaw(torque.as_slice()) {
            Some(index) => self.hold(arm, measured, Reason::NoTorque { index }),
            None => self.cut(torque, Status::Normal),
        }
    }

    /// What is wrong with the readings or with what is desired; notes the position where it is sound.
    pub(super) fn fault<const M: usize, const I: usize>(
        &mut self,
        measured: &State<D, M, I>,
        desired: Option<&State<D>>,
    ) -> Option<Reason> {
        let no_number = |signal: Signal, values: &[f64]| {
            flaw(values).map(|index| Reason::NoNumber { signal, index })
        };
        let outside = |signal: Signal, index: usize| Reason::OutsideLimits { signal, index };
        if let Some(reason) = no_number(Signal::Position, measured.q.as_slice()) {
            return Some(reason);
        }
        let ends = self.safety.lower.iter().zip(self.safety.upper.iter());
        let mut positions = measured.q.iter().zip(ends);
        if let Some(index) = positions.position(|(q, (lower, upper))| q < lower || q > upper) {
            return Some(outside(Signal::Position, index));
        }
        self.seen = Some(measured.q);
        if let Some(reason) = no_number(Signal::Velocity, measured.dq.as_slice()) {
            return Some(reason);
        }
        let mut velocities = measured.dq.iter().zip(self.safety.velocity.iter());
        if let Some(index) = velocities.position(|(dq, limit)| dq.abs() > *limit) {
            return Some(outside(Signal::Velocity, index));
        }
        let beside = no_number(Signal::Memory, measured.memory.as_slice())
            .or_else(|| no_number(Signal::Input, measured.inputs.as_slice()))
            .or_else(|| no_number(Signal::Torque, measured.measured_torque.as_slice()))
            .or_else(|| no_number(Signal::Time, &[measured.time]));
        let Some(desired) = desired else {
            return beside;
        };
        beside
            .or_else(|| no_number(Signal::DesiredPosition, desired.q.as_slice()))
            .or_else(|| no_number(Signal::DesiredVelocity, desired.dq.as_slice()))
            .or_else(|| no_number(Signal::DesiredAcceleration, desired.ddq.as_slice()))
    }

    /// The safe torque; see [`Safety`].
    fn hold<A, const S: usize, const B: usize, const H: usize, const M: usize, const I: usize>(
        &self,
        arm: &A,
        measured: &State<D, M, I>,
        reason: Reason,
    ) -> Command<D>
    where
        A: RobotModel<D, S, B, H, M, I>,
    {
        let mut torque = Vector::<D>::zeros();
        if let Some(q) = self.seen {
            let place = State {
                q,
                inputs: measured.inputs.map(|value| value.finite_or(0.0)),
                time: measured.time.finite_or(0.0),
                ..*measured
            };
            let still = still(arm, &place);
            let inertia = arm.mass_matrix(&q).diagonal();
            for (k, entry) in torque.iter_mut().enumerate() {
                let limit = self.safety.velocity[k];
                // The larger of a number and no number is the number.
                let inertia = inertia[k].finite_or(0.0).max(0.0);
                let dq = measured.dq[k].finite_or(0.0).max(-limit).min(limit);
                let brake = self.safety.brake * inertia * dq;
                *entry = still[k].finite_or(0.0) - brake.finite_or(0.0);
            }
        }
        self.cut(torque, Status::Held(reason))
    }

    /// Torques within their limits.
    fn cut(&self, mut torque: Vector<D>, status: Status) -> Command<D> {
        let mut saturated = [false; D];
        let entries = torque.iter_mut().zip(self.safety.torque.iter());
        for ((torque, limit), saturated) in entries.zip(&mut saturated) {
            *saturated = torque.abs() > *limit;
            // Not `clamp`, which has a panic in it.
            *torque = torque.max(-limit).min(*limit);
        }
        // All of them are looked at: a cycle is as long whatever its torque.
        let is_cut = saturated.iter().filter(|joint| **joint).count() > 0;
        Command {
            torque,
            status: match status {
                Status::Normal if is_cut => Status::Saturated,
                other => other,
            },
            saturated,
        }
    }
}

/// The torque that holds an arm where it is: gravity, and what of the effects does not need motion. Memories are at zero.
pub(super) fn still<
    A,
    const D: usize,
    const S: usize,
    const B: usize,
    const H: usize,
    const M: usize,
    const I: usize,
>(
    arm: &A,
    place: &State<D, M, I>,
) -> Vector<D>
where
    A: RobotModel<D, S, B, H, M, I>,
{
    arm.inverse_dynamics_at(&State {
        dq: Vector::zeros(),
        ddq: Vector::zeros(),
        memory: Vector::zeros(),
        rigid_torque: Vector::zeros(),
        measured_torque: Vector::zeros(),
        ..*place
    })
}

/// The first entry that is infinite or no number.
pub(super) fn flaw(values: &[f64]) -> Option<usize> {
    values.iter().position(|value| !value.is_finite())
}

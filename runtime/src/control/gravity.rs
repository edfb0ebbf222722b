//! Gravity compensation: an arm that stays where it is put.

use super::command::Command;
use super::error::ControlError;
use super::guard::{Guard, still};
use super::safety::Safety;
use crate::model::RobotModel;
use crate::state::State;

/// The torque that holds the arm still, `tau = G(q)` with what of the declared effects acts at rest: springs, offsets.
///
/// # Examples
#[cfg_attr(feature = "derive", doc = "```")]
#[cfg_attr(not(feature = "derive"), doc = "```ignore")]
/// # mod arms { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/doc/two_link.rs")); }
/// use robot_model::control::GravityCompensation;
/// use robot_model::{RobotModel, State, Vector};
///
/// let arm = arms::two_link();
/// let mut control = GravityCompensation::new(arm);
/// // A hand moves the arm: friction and Coriolis torques are its own.
/// let moving = State::new(Vector::from([0.4, 0.1]), Vector::from([1.0, -2.0]), Vector::zeros());
/// let torque = control.torque(&moving).torque;
/// assert!((torque - arm.gravity(&moving.q)).norm() < 1e-12);
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct GravityCompensation<A, const D: usize> {
    arm: A,
    guard: Guard<D>,
}

impl<A, const D: usize> GravityCompensation<A, D> {
    /// Of an arm with its parameters.
    ///
    /// # Examples
    /// That of [`GravityCompensation`].
    pub fn new<const S: usize, const B: usize, const H: usize, const M: usize, const I: usize>(
        arm: A,
    ) -> Self
    where
        A: RobotModel<D, S, B, H, M, I>,
    {
        Self {
            arm,
            guard: Guard::new(&A::JOINTS),
        }
    }

    /// The same within limits.
    ///
    /// # Errors
    /// Those of [`Safety`], where a limit makes no sense.
    ///
    /// # Examples
    /// That of [`Safety`].
    pub fn with_safety(self, safety: Safety<D>) -> Result<Self, ControlError> {
        Ok(Self {
            guard: self.guard.within(safety)?,
            ..self
        })
    }

    /// One cycle.
    ///
    /// # Examples
    /// That of [`GravityCompensation`].
    pub fn torque<const S: usize, const B: usize, const H: usize, const M: usize, const I: usize>(
        &mut self,
        measured: &State<D, M, I>,
    ) -> Command<D>
    where
        A: RobotModel<D, S, B, H, M, I>,
    {
        let Self { arm, guard } = self;
        guard.cycle(arm, measured, None, || still(arm, measured))
    }
}

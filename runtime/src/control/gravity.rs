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
    #[cfg_attr(feature = "derive", doc = "```")]
    #[cfg_attr(not(feature = "derive"), doc = "```ignore")]
    /// # mod arms { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/doc/two_link.rs")); }
    /// use robot_model::control::GravityCompensation;
    /// use robot_model::{State, Vector};
    ///
    /// let mut control = GravityCompensation::new(arms::two_link());
    /// // Stretched: 2.5 kg at 0.2 m from the elbow.
    /// let torque = control.torque(&State::at_rest(Vector::from([0.0, 0.0]))).torque;
    /// assert!((torque[1] - 9.81 * 2.5 * 0.2).abs() < 1e-12);
    /// ```
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
    #[cfg_attr(feature = "derive", doc = "```")]
    #[cfg_attr(not(feature = "derive"), doc = "```ignore")]
    /// # mod arms { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/doc/two_link.rs")); }
    /// use robot_model::control::{GravityCompensation, Safety};
    /// use robot_model::{State, Vector};
    ///
    /// let limits = Safety::new().torque([20.0, 25.0]);
    /// let mut control = GravityCompensation::new(arms::two_link()).with_safety(limits)?;
    /// // Stretched, the arm weighs 27 N m on the shoulder: cut at 20.
    /// let torque = control.torque(&State::at_rest(Vector::from([0.0, 0.0]))).torque;
    /// assert_eq!(torque[0], 20.0);
    /// # Ok::<(), robot_model::control::ControlError>(())
    /// ```
    pub fn with_safety(self, safety: Safety<D>) -> Result<Self, ControlError> {
        Ok(Self {
            guard: self.guard.within(safety)?,
            ..self
        })
    }

    /// One cycle.
    ///
    /// # Examples
    #[cfg_attr(feature = "derive", doc = "```")]
    #[cfg_attr(not(feature = "derive"), doc = "```ignore")]
    /// # mod arms { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/doc/two_link.rs")); }
    /// use robot_model::control::{GravityCompensation, Status};
    /// use robot_model::{State, Vector};
    ///
    /// // Upright there is nothing to hold.
    /// let mut control = GravityCompensation::new(arms::two_link());
    /// let command = control.torque(&State::at_rest(Vector::from([std::f64::consts::FRAC_PI_2, 0.0])));
    /// assert!(command.status == Status::Normal && command.torque.norm() < 1e-12);
    /// ```
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

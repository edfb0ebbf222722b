//! Computed torque: an arm that behaves as double integrators with a linear loop around each.

use super::command::Command;
use super::error::ControlError;
use super::friction::{Friction, FrictionVelocity, compensated};
use super::gains::Gains;
use super::guard::Guard;
use super::safety::Safety;
use crate::model::RobotModel;
use crate::state::State;

/// Computed torque, also called inverse dynamics control:
///
/// ```text
/// tau = M (ddq_d + kd (dq_d - dq) + kp (q_d - q)) + C dq + G + effects
/// ```
///
/// With the arm's own parameters the error obeys `e'' + kd e' + kp e = 0`. Of the effects, all of the friction is compensated at
/// the desired velocity unless [`Self::with_friction`] says otherwise. Torques in N m or N, gains of [`Gains`].
///
/// Source: Siciliano et al. 2009, ch. 8; seed 004, section 4.3.
///
/// # Examples
#[cfg_attr(feature = "derive", doc = "```")]
#[cfg_attr(not(feature = "derive"), doc = "```ignore")]
/// # mod arms { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/doc/two_link.rs")); }
/// use robot_model::control::{ComputedTorque, Gains};
/// use robot_model::{Mechanics, State, Vector};
///
/// let arm = arms::two_link();
/// let mut control = ComputedTorque::new(arm, Gains::critically_damped(25.0))?;
/// let desired = State::at_rest(Vector::from([0.3, -0.8]));
/// let measured = State::at_rest(Vector::from([0.2, -0.8]));
/// let tau = control.torque(&measured, &desired).torque;
/// // kp times the error, on this joint only.
/// let ddq = arm.forward_dynamics(&measured.q, &measured.dq, &tau).expect("an arm that could be built");
/// assert!((ddq - Vector::from([62.5, 0.0])).norm() < 1e-9);
/// # Ok::<(), robot_model::control::ControlError>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ComputedTorque<A, const D: usize> {
    arm: A,
    gains: Gains<D>,
    friction: Friction,
    guard: Guard<D>,
}

impl<A, const D: usize> ComputedTorque<A, D> {
    /// Of an arm with its parameters.
    ///
    /// # Errors
    /// [`ControlError::Joint`], where a gain is not positive.
    ///
    /// # Examples
    #[cfg_attr(feature = "derive", doc = "```")]
    #[cfg_attr(not(feature = "derive"), doc = "```ignore")]
    /// # mod arms { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/doc/two_link.rs")); }
    /// use robot_model::control::{ComputedTorque, Gains};
    ///
    /// assert!(ComputedTorque::new(arms::two_link(), Gains::new(25.0, 0.7)).is_ok());
    /// assert!(ComputedTorque::new(arms::two_link(), Gains::new(25.0, f64::NAN)).is_err());
    /// ```
    pub fn new<const S: usize, const B: usize, const H: usize, const M: usize, const I: usize>(
        arm: A,
        gains: Gains<D>,
    ) -> Result<Self, ControlError>
    where
        A: RobotModel<D, S, B, H, M, I>,
    {
        gains.check(&A::JOINTS)?;
        Ok(Self {
            arm,
            gains,
            friction: Friction::full(),
            guard: Guard::new(&A::JOINTS),
        })
    }

    /// The same with another compensation of friction.
    ///
    /// # Errors
    /// [`ControlError::Number`], where the share is not from 0 to 1.
    ///
    /// # Examples
    #[cfg_attr(feature = "derive", doc = "```")]
    #[cfg_attr(not(feature = "derive"), doc = "```ignore")]
    /// # mod arms { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/doc/two_link.rs")); }
    /// use robot_model::control::{ComputedTorque, Friction, Gains};
    ///
    /// let control = ComputedTorque::new(arms::two_link(), Gains::new(25.0, 0.7))?;
    /// let refused = control.with_friction(Friction::part(1.5)).unwrap_err();
    /// assert_eq!(refused.to_string(), "share of friction is 1.5; give a number from 0 to 1");
    /// # Ok::<(), robot_model::control::ControlError>(())
    /// ```
    pub fn with_friction(self, friction: Friction) -> Result<Self, ControlError> {
        friction.check()?;
        Ok(Self { friction, ..self })
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
    /// use robot_model::control::{ComputedTorque, Gains, Safety};
    /// use robot_model::{State, Vector};
    ///
    /// let limits = Safety::new().torque([60.0, 25.0]);
    /// let mut control = ComputedTorque::new(arms::two_link(), Gains::critically_damped(25.0))?.with_safety(limits)?;
    /// // An error of 1 rad at the shoulder asks for 625 rad/s^2.
    /// let (measured, desired) = (Vector::from([0.0, 0.0]), Vector::from([1.0, 0.0]));
    /// let command = control.torque(&State::at_rest(measured), &State::at_rest(desired));
    /// assert_eq!(command.torque, Vector::from([60.0, 25.0]));
    /// # Ok::<(), robot_model::control::ControlError>(())
    /// ```
    pub fn with_safety(self, safety: Safety<D>) -> Result<Self, ControlError> {
        Ok(Self {
            guard: self.guard.within(safety)?,
            ..self
        })
    }

    /// The arm.
    ///
    /// # Examples
    #[cfg_attr(feature = "derive", doc = "```")]
    #[cfg_attr(not(feature = "derive"), doc = "```ignore")]
    /// # mod arms { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/doc/two_link.rs")); }
    /// use robot_model::control::{ComputedTorque, Gains};
    ///
    /// let control = ComputedTorque::new(arms::two_link(), Gains::new(25.0, 0.7))?;
    /// assert_eq!(*control.arm(), arms::two_link());
    /// # Ok::<(), robot_model::control::ControlError>(())
    /// ```
    pub const fn arm(&self) -> &A {
        &self.arm
    }

    /// One cycle. Of `desired` position, velocity and acceleration are read; of `measured` what
    /// [the module](super) says.
    ///
    /// # Examples
    #[cfg_attr(feature = "derive", doc = "```")]
    #[cfg_attr(not(feature = "derive"), doc = "```ignore")]
    /// # mod arms { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/doc/two_link.rs")); }
    /// use robot_model::control::{ComputedTorque, Gains};
    /// use robot_model::{RobotModel, State, Vector};
    ///
    /// let mut control = ComputedTorque::new(arms::two_link(), Gains::critically_damped(25.0))?;
    /// // Along the motion that is desired it is the torque of the model.
    /// let state = State::new(Vector::from([0.3, -0.8]), Vector::from([1.0, 0.5]), Vector::from([2.0, -3.0]));
    /// let wanted = arms::two_link().inverse_dynamics(&state.q, &state.dq, &state.ddq);
    /// assert!((control.torque(&state, &state).torque - wanted).norm() < 1e-12);
    /// # Ok::<(), robot_model::control::ControlError>(())
    /// ```
    pub fn torque<const S: usize, const B: usize, const H: usize, const M: usize, const I: usize>(
        &mut self,
        measured: &State<D, M, I>,
        desired: &State<D>,
    ) -> Command<D>
    where
        A: RobotModel<D, S, B, H, M, I>,
    {
        let Self {
            arm,
            gains,
            friction,
            guard,
        } = self;
        guard.cycle(arm, measured, Some(desired), || {
            let error = desired.q - measured.q;
            let slip = desired.dq - measured.dq;
            let ddq =
                desired.ddq + gains.kd().component_mul(&slip) + gains.kp().component_mul(&error);
            let v = match friction.velocity {
                FrictionVelocity::Desired => &desired.dq,
                FrictionVelocity::Measured => &measured.dq,
            };
            compensated(arm, measured, ddq, v, friction.share)
        })
    }
}

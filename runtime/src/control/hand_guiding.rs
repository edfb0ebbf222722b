//! Hand guiding: an arm that is led by hand.

use super::command::Command;
use super::error::{ControlError, NOT_NEGATIVE, each_joint, is_not_negative, number};
use super::friction::compensated;
use super::guard::Guard;
use super::safety::Safety;
use crate::model::{RobotModel, Vector};
use crate::state::State;

/// Hand guiding without a force sensor: `tau = {C dq + G + tau_f} - K_d dq`, no inertia and no stiffness.
///
/// What is compensated need not be pushed: the hand feels the inertia and the damping `K_d`, N m s/rad or N s/m a joint. All
/// friction is compensated at the measured velocity, or the share of [`Self::with_friction`]. Where more is compensated than
/// there is, `K_d` has to outweigh it.
///
/// Source: seed 002, equation 31.
///
/// # Examples
#[cfg_attr(feature = "derive", doc = "```")]
#[cfg_attr(not(feature = "derive"), doc = "```ignore")]
/// # mod arms { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/doc/two_link.rs")); }
/// use robot_model::control::HandGuiding;
/// use robot_model::{RobotModel, State, Vector};
///
/// let arm = arms::two_link();
/// let mut control = HandGuiding::new(arm, [0.5, 0.2])?;
/// let dragged = State::new(Vector::from([0.4, 0.1]), Vector::from([0.3, 0.0]), Vector::zeros());
/// let tau = control.torque(&dragged).torque;
/// // The hand has the damping to overcome: 0.5 N m s/rad at 0.3 rad/s.
/// let needed = arm.inverse_dynamics(&dragged.q, &dragged.dq, &Vector::zeros()) - tau;
/// assert!((needed - Vector::from([0.15, 0.0])).norm() < 1e-12);
/// # Ok::<(), robot_model::control::ControlError>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct HandGuiding<A, const D: usize> {
    arm: A,
    damping: Vector<D>,
    share: f64,
    guard: Guard<D>,
}

impl<A, const D: usize> HandGuiding<A, D> {
    /// Of an arm with its parameters; `damping` is `K_d`.
    ///
    /// # Errors
    /// [`ControlError::Joint`], where a damping is negative or no finite number.
    ///
    /// # Examples
    #[cfg_attr(feature = "derive", doc = "```")]
    #[cfg_attr(not(feature = "derive"), doc = "```ignore")]
    /// # mod arms { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/doc/two_link.rs")); }
    /// use robot_model::control::HandGuiding;
    ///
    /// let refused = HandGuiding::new(arms::two_link(), [-1.0, 0.2]).unwrap_err();
    /// assert_eq!(
    ///     refused.to_string(),
    ///     "damping of joint `shoulder` is -1 N m s/rad or N s/m; give a finite number that is not negative"
    /// );
    /// ```
    pub fn new<const S: usize, const B: usize, const H: usize, const M: usize, const I: usize>(
        arm: A,
        damping: [f64; D],
    ) -> Result<Self, ControlError>
    where
        A: RobotModel<D, S, B, H, M, I>,
    {
        let what = ("damping", " N m s/rad or N s/m", NOT_NEGATIVE);
        each_joint(&A::JOINTS, &damping, what, is_not_negative)?;
        Ok(Self {
            arm,
            damping: damping.into(),
            share: 1.0,
            guard: Guard::new(&A::JOINTS),
        })
    }

    /// The same with a share of friction, from 0 to 1.
    ///
    /// # Errors
    /// [`ControlError::Number`], where the share is not from 0 to 1.
    ///
    /// # Examples
    #[cfg_attr(feature = "derive", doc = "```")]
    #[cfg_attr(not(feature = "derive"), doc = "```ignore")]
    /// # mod arms { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/doc/two_link.rs")); }
    /// use robot_model::control::HandGuiding;
    ///
    /// let control = HandGuiding::new(arms::two_link(), [0.5, 0.2])?;
    /// assert!(control.with_friction(0.8).is_ok() && control.with_friction(f64::NAN).is_err());
    /// # Ok::<(), robot_model::control::ControlError>(())
    /// ```
    pub fn with_friction(self, share: f64) -> Result<Self, ControlError> {
        let what = ("share of friction", "", "a number from 0 to 1");
        number(share, what, (0.0..=1.0).contains(&share))?;
        Ok(Self { share, ..self })
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
    /// use robot_model::control::{HandGuiding, Safety};
    /// use robot_model::{State, Vector};
    ///
    /// let limits = Safety::new().torque([20.0, 25.0]);
    /// let mut control = HandGuiding::new(arms::two_link(), [0.5, 0.2])?.with_safety(limits)?;
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

    /// The arm.
    ///
    /// # Examples
    #[cfg_attr(feature = "derive", doc = "```")]
    #[cfg_attr(not(feature = "derive"), doc = "```ignore")]
    /// # mod arms { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/doc/two_link.rs")); }
    /// use robot_model::control::HandGuiding;
    ///
    /// let control = HandGuiding::new(arms::two_link(), [0.5, 0.2])?;
    /// assert_eq!(control.arm().elbow.inertial.mass, 2.5);
    /// # Ok::<(), robot_model::control::ControlError>(())
    /// ```
    pub const fn arm(&self) -> &A {
        &self.arm
    }

    /// One cycle.
    ///
    /// # Examples
    #[cfg_attr(feature = "derive", doc = "```")]
    #[cfg_attr(not(feature = "derive"), doc = "```ignore")]
    /// # mod arms { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/doc/two_link.rs")); }
    /// use robot_model::control::HandGuiding;
    /// use robot_model::{State, Vector};
    ///
    /// let mut control = HandGuiding::new(arms::two_link(), [0.5, 0.2])?;
    /// // Stretched, the elbow is led at 2 rad/s: gravity and friction less the damping.
    /// let led = State::new(Vector::from([0.0, 0.0]), Vector::from([0.0, 2.0]), Vector::zeros());
    /// let torque = control.torque(&led).torque;
    /// assert!((torque[1] - (4.905 + 0.6 * 2.0 + 0.8 - 0.2 * 2.0)).abs() < 1e-12);
    /// # Ok::<(), robot_model::control::ControlError>(())
    /// ```
    pub fn torque<const S: usize, const B: usize, const H: usize, const M: usize, const I: usize>(
        &mut self,
        measured: &State<D, M, I>,
    ) -> Command<D>
    where
        A: RobotModel<D, S, B, H, M, I>,
    {
        let Self {
            arm,
            damping,
            share,
            guard,
        } = self;
        guard.cycle(arm, measured, None, || {
            let dq = &measured.dq;
            compensated(arm, measured, Vector::zeros(), dq, *share) - damping.component_mul(dq)
        })
    }
}

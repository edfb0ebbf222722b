//! Feed-forward: the torque of the desired motion, and a linear loop for what it misses.

use super::command::Command;
use super::error::{ControlError, NOT_NEGATIVE, each_joint, is_not_negative};
use super::guard::Guard;
use super::safety::Safety;
use crate::model::{RobotModel, Vector};
use crate::state::State;

/// Torque along a desired motion, with stiffness and damping a joint:
///
/// ```text
/// tau = inverse_dynamics(q_d, dq_d, ddq_d) + k (q_d - q) + d (dq_d - dq)
/// ```
///
/// The model sees nothing that is measured, so its part can be computed ahead ([`Self::along`]) and closes no loop. `k` in N m/rad
/// or N/m, `d` in N m s/rad or N s/m.
///
/// Source: Siciliano et al. 2009, ch. 8.
///
/// # Examples
#[cfg_attr(feature = "derive", doc = "```")]
#[cfg_attr(not(feature = "derive"), doc = "```ignore")]
/// # mod arms { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/doc/two_link.rs")); }
/// use robot_model::control::FeedForward;
/// use robot_model::{State, Vector};
///
/// let mut control = FeedForward::new(arms::two_link(), [200.0, 80.0], [20.0, 6.0])?;
/// let desired = State::new(Vector::from([0.3, -0.8]), Vector::from([1.0, 0.5]), Vector::zeros());
/// let measured = State { q: desired.q + Vector::from([-0.01, 0.0]), ..desired };
/// let torque = control.torque(&measured, &desired).torque;
/// assert!((torque - control.along(&desired) - Vector::from([2.0, 0.0])).norm() < 1e-9);
/// # Ok::<(), robot_model::control::ControlError>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FeedForward<A, const D: usize> {
    arm: A,
    stiffness: Vector<D>,
    damping: Vector<D>,
    guard: Guard<D>,
}

impl<A, const D: usize> FeedForward<A, D> {
    /// Of an arm with its parameters.
    ///
    /// # Errors
    /// [`ControlError::Joint`], where a stiffness or a damping is negative or no finite number.
    ///
    /// # Examples
    #[cfg_attr(feature = "derive", doc = "```")]
    #[cfg_attr(not(feature = "derive"), doc = "```ignore")]
    /// # mod arms { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/doc/two_link.rs")); }
    /// use robot_model::control::FeedForward;
    ///
    /// let refused = FeedForward::new(arms::two_link(), [200.0, f64::INFINITY], [20.0, 6.0]).unwrap_err();
    /// assert_eq!(
    ///     refused.to_string(),
    ///     "stiffness of joint `elbow` is inf N m/rad or N/m; give a finite number that is not negative"
    /// );
    /// ```
    pub fn new<const S: usize, const B: usize, const H: usize, const M: usize, const I: usize>(
        arm: A,
        stiffness: [f64; D],
        damping: [f64; D],
    ) -> Result<Self, ControlError>
    where
        A: RobotModel<D, S, B, H, M, I>,
    {
        let what = ("stiffness", " N m/rad or N/m", NOT_NEGATIVE);
        each_joint(&A::JOINTS, &stiffness, what, is_not_negative)?;
        let what = ("damping", " N m s/rad or N s/m", NOT_NEGATIVE);
        each_joint(&A::JOINTS, &damping, what, is_not_negative)?;
        Ok(Self {
            arm,
            stiffness: stiffness.into(),
            damping: damping.into(),
            guard: Guard::new(&A::JOINTS),
        })
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
    /// use robot_model::control::{FeedForward, Safety};
    /// use robot_model::{State, Vector};
    ///
    /// let control = FeedForward::new(arms::two_link(), [200.0, 80.0], [20.0, 6.0])?;
    /// let mut control = control.with_safety(Safety::new().torque([20.0, 25.0]))?;
    /// // Stretched, the arm weighs 27 N m on the shoulder: cut at 20.
    /// let still = State::at_rest(Vector::from([0.0, 0.0]));
    /// assert_eq!(control.torque(&still, &still).torque[0], 20.0);
    /// # Ok::<(), robot_model::control::ControlError>(())
    /// ```
    pub fn with_safety(self, safety: Safety<D>) -> Result<Self, ControlError> {
        Ok(Self {
            guard: self.guard.within(safety)?,
            ..self
        })
    }

    /// The model's part, N m or N: the torque that the desired motion takes.
    ///
    /// # Examples
    #[cfg_attr(feature = "derive", doc = "```")]
    #[cfg_attr(not(feature = "derive"), doc = "```ignore")]
    /// # mod arms { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/doc/two_link.rs")); }
    /// use robot_model::control::FeedForward;
    /// use robot_model::{State, Vector};
    ///
    /// let control = FeedForward::new(arms::two_link(), [200.0, 80.0], [20.0, 6.0])?;
    /// // Stretched and at rest: 2.5 kg at 0.2 m from the elbow.
    /// let along = control.along(&State::at_rest(Vector::from([0.0, 0.0])));
    /// assert!((along[1] - 9.81 * 2.5 * 0.2).abs() < 1e-12);
    /// # Ok::<(), robot_model::control::ControlError>(())
    /// ```
    #[must_use]
    pub fn along<const S: usize, const B: usize, const H: usize, const M: usize, const I: usize>(
        &self,
        desired: &State<D, M, I>,
    ) -> Vector<D>
    where
        A: RobotModel<D, S, B, H, M, I>,
    {
        self.arm.inverse_dynamics_at(desired)
    }

    /// One cycle. Memory, channels and time are those of `measured`.
    ///
    /// # Examples
    #[cfg_attr(feature = "derive", doc = "```")]
    #[cfg_attr(not(feature = "derive"), doc = "```ignore")]
    /// # mod arms { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/doc/two_link.rs")); }
    /// use robot_model::control::FeedForward;
    /// use robot_model::{State, Vector};
    ///
    /// let mut control = FeedForward::new(arms::two_link(), [200.0, 80.0], [20.0, 6.0])?;
    /// // The elbow is 0.1 rad behind: 80 N m/rad beside the 4.905 N m of gravity that the desired pose takes.
    /// let measured = State::at_rest(Vector::from([0.0, -0.1]));
    /// let torque = control.torque(&measured, &State::at_rest(Vector::from([0.0, 0.0]))).torque;
    /// assert!((torque[1] - (4.905 + 8.0)).abs() < 1e-12);
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
            stiffness,
            damping,
            guard,
        } = self;
        guard.cycle(arm, measured, Some(desired), || {
            let along = State {
                q: desired.q,
                dq: desired.dq,
                ddq: desired.ddq,
                ..*measured
            };
            arm.inverse_dynamics_at(&along)
                + stiffness.component_mul(&(desired.q - measured.q))
                + damping.component_mul(&(desired.dq - measured.dq))
        })
    }
}

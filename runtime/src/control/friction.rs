//! Compensation of friction, in part.

use super::error::{ControlError, number};
use crate::model::{RobotModel, Vector};
use crate::state::State;

/// At which velocity friction is computed.
///
/// # Examples
/// ```
/// use robot_model::control::{Friction, FrictionVelocity};
/// assert_eq!(Friction::full().velocity, FrictionVelocity::Desired);
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum FrictionVelocity {
    /// The desired one: a feed-forward. It does not chatter with the noise of a velocity near zero, and as it closes no loop,
    /// full compensation cannot drive the arm; at a desired standstill it compensates nothing.
    Desired,
    /// The measured one: it helps whatever moves the arm, also the last bit to a resting place. It is positive feedback, which too
    /// much friction in the model makes unstable: seed 004 takes 50 %.
    Measured,
}

/// Which share of the declared friction a controller compensates, and at which velocity.
///
/// Friction is what velocity and memory add to the torque of the declared effects:
/// `tau_f = effects(q, v, ddq, z) - effects(q, 0, ddq, 0)`. Rotor inertias, springs and offsets are not among it, and are
/// always compensated.
///
/// # Examples
#[cfg_attr(feature = "derive", doc = "```")]
#[cfg_attr(not(feature = "derive"), doc = "```ignore")]
/// # mod arms { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/doc/two_link.rs")); }
/// use robot_model::control::{ComputedTorque, Friction, Gains};
/// use robot_model::{State, Vector};
///
/// let gains = Gains::new(25.0, 0.7);
/// let moving = State::new(Vector::zeros(), Vector::from([1.0, 0.0]), Vector::zeros());
/// let torque = |friction| {
///     let mut control = ComputedTorque::new(arms::two_link(), gains)?.with_friction(friction)?;
///     Ok::<f64, robot_model::control::ControlError>(control.torque(&moving, &moving).torque[0])
/// };
/// // 1.5 N m s/rad and 2 N m.
/// assert!((torque(Friction::full())? - torque(Friction::none())? - 3.5).abs() < 1e-12);
/// assert!((torque(Friction::part(0.5).at_measured_velocity())? - torque(Friction::none())? - 1.75).abs() < 1e-12);
/// # Ok::<(), robot_model::control::ControlError>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Friction {
    /// 0 for none, 1 for all of it.
    pub share: f64,
    /// At which velocity.
    pub velocity: FrictionVelocity,
}

impl Friction {
    /// No compensation.
    ///
    /// # Examples
    /// ```
    /// # use robot_model::control::Friction;
    /// assert_eq!(Friction::none().share, 0.0);
    /// ```
    #[must_use]
    pub const fn none() -> Self {
        Self::part(0.0)
    }

    /// All of it, at the desired velocity.
    ///
    /// # Examples
    /// ```
    /// # use robot_model::control::Friction;
    /// assert_eq!(Friction::full(), Friction::part(1.0));
    /// ```
    #[must_use]
    pub const fn full() -> Self {
        Self::part(1.0)
    }

    /// A share from 0 to 1, at the desired velocity.
    ///
    /// # Examples
    /// ```
    /// # use robot_model::control::Friction;
    /// assert_eq!(Friction::part(0.5).share, 0.5);
    /// ```
    #[must_use]
    pub const fn part(share: f64) -> Self {
        Self {
            share,
            velocity: FrictionVelocity::Desired,
        }
    }

    /// The same share at the measured velocity.
    ///
    /// # Examples
    /// ```
    /// # use robot_model::control::{Friction, FrictionVelocity};
    /// assert_eq!(Friction::part(0.5).at_measured_velocity().velocity, FrictionVelocity::Measured);
    /// ```
    #[must_use]
    pub const fn at_measured_velocity(self) -> Self {
        Self {
            velocity: FrictionVelocity::Measured,
            ..self
        }
    }

    pub(super) fn check(self) -> Result<(), ControlError> {
        let what = ("share of friction", "", "a number from 0 to 1");
        number(self.share, what, (0.0..=1.0).contains(&self.share))
    }
}

/// `M ddq + C dq + G` with the effects that friction is none of, and the share of friction at the velocity `v`, N m or N.
///
/// With `F(v) = inverse_dynamics(q, v, ddq, z) - bias(q, v)`, in which only the share changes with `v`, it is
/// `share F(v) + (1 - share) F(0) + bias(q, dq)`, where `F(0)` is without memory.
pub(super) fn compensated<
    A,
    const D: usize,
    const S: usize,
    const B: usize,
    const H: usize,
    const M: usize,
    const I: usize,
>(
    arm: &A,
    measured: &State<D, M, I>,
    ddq: Vector<D>,
    v: &Vector<D>,
    share: f64,
) -> Vector<D>
where
    A: RobotModel<D, S, B, H, M, I>,
{
    let q = &measured.q;
    let mut torque = arm.bias(q, &measured.dq);
    if share > 0.0 {
        let moving = State {
            dq: *v,
            ddq,
            ..*measured
        };
        torque += (arm.inverse_dynamics_at(&moving) - arm.bias(q, v)) * share;
    }
    if share < 1.0 {
        let resting = State {
            dq: Vector::zeros(),
            ddq,
            memory: Vector::zeros(),
            ..*measured
        };
        torque += (arm.inverse_dynamics_at(&resting) - arm.gravity(q)) * (1.0 - share);
    }
    torque
}

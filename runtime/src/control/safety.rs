//! What a controller may do, and where it stops.

use core::cmp::Ordering;

use super::error::{ControlError, NOT_NEGATIVE, POSITIVE, each_joint, is_not_negative, number};
use crate::model::Vector;

/// How fast the safe torque brakes without another word, 1/s.
const BRAKE: f64 = 10.0;

/// Limits of torque and state, and the safe torque.
///
/// No limit is set at first. The law's torque is cut at the limits of torque. Outside of the limits of position or velocity,
/// and where a number is none, the **safe torque** is held in its place:
///
/// ```text
/// tau = still(q_s) - brake * M_jj(q_s) * dq
/// ```
///
/// - `q_s` is the last position that was read as numbers inside of its limits;
/// - `still` is the torque that holds the arm there: gravity, springs and offsets, with effects' memories at zero;
/// - `M_jj` is the joint's entry of the mass matrix. A velocity that is no number does not brake its joint, and one beyond its
///   limit brakes as at the limit. The brake takes energy out of the arm whatever its parameters are, as its factors are not
///   negative;
/// - it is cut at the limits of torque, and zero as long as no position was read.
///
/// Every controller takes them by its `with_safety`, which refuses what makes no sense: [`ControlError::Joint`] for a largest
/// torque or speed that is not positive, [`ControlError::EmptyRange`] for ends of positions that are not in order,
/// [`ControlError::Number`] for a brake that is negative or no finite number.
///
/// # Examples
#[cfg_attr(feature = "derive", doc = "```")]
#[cfg_attr(not(feature = "derive"), doc = "```ignore")]
/// # mod arms { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/doc/two_link.rs")); }
/// use robot_model::control::{HandGuiding, Safety, Status};
/// use robot_model::{RobotModel, State, Vector};
///
/// let limits = Safety::new().velocity([2.0, 2.0]).brake(5.0);
/// let mut control = HandGuiding::new(arms::two_link(), [1.0, 1.0])?.with_safety(limits)?;
/// let q = Vector::from([0.2, 0.4]);
/// let pushed = State::new(q, Vector::from([3.0, 0.0]), Vector::zeros());
/// let command = control.torque(&pushed);
/// assert!(matches!(command.status, Status::Held(_)));
/// let arm = control.arm();
/// let brake = 5.0 * arm.mass_matrix(&q)[(0, 0)] * 2.0;
/// assert!((command.torque[0] - (arm.gravity(&q)[0] - brake)).abs() < 1e-12);
/// # Ok::<(), robot_model::control::ControlError>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Safety<const D: usize> {
    pub(super) torque: Vector<D>,
    pub(super) velocity: Vector<D>,
    pub(super) lower: Vector<D>,
    pub(super) upper: Vector<D>,
    pub(super) brake: f64,
}

impl<const D: usize> Default for Safety<D> {
    fn default() -> Self {
        Self::new()
    }
}

impl<const D: usize> Safety<D> {
    /// No limits, and a brake of 10 1/s.
    ///
    /// # Examples
    /// ```
    /// use robot_model::control::Safety;
    /// assert_eq!(Safety::<2>::new(), Safety::default());
    /// ```
    #[must_use]
    pub fn new() -> Self {
        let endless = Vector::repeat(f64::INFINITY);
        Self {
            torque: endless,
            velocity: endless,
            lower: -endless,
            upper: endless,
            brake: BRAKE,
        }
    }

    /// Largest torques, N m or N; of the safe torque too.
    ///
    /// # Examples
    #[cfg_attr(feature = "derive", doc = "```")]
    #[cfg_attr(not(feature = "derive"), doc = "```ignore")]
    /// # mod arms { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/doc/two_link.rs")); }
    /// use robot_model::control::{ComputedTorque, Gains, Safety};
    ///
    /// let control = ComputedTorque::new(arms::two_link(), Gains::new(25.0, 0.7))?;
    /// assert!(control.with_safety(Safety::new().torque([60.0, 25.0])).is_ok());
    /// let refused = control.with_safety(Safety::new().torque([60.0, -25.0])).unwrap_err();
    /// assert_eq!(
    ///     refused.to_string(),
    ///     "torque limit of joint `elbow` is -25 N m or N; give a positive, finite number"
    /// );
    /// # Ok::<(), robot_model::control::ControlError>(())
    /// ```
    #[must_use]
    pub fn torque(self, largest: [f64; D]) -> Self {
        Self {
            torque: largest.into(),
            ..self
        }
    }

    /// Largest speeds, rad/s or m/s: beyond them the arm is held.
    ///
    /// # Examples
    #[cfg_attr(feature = "derive", doc = "```")]
    #[cfg_attr(not(feature = "derive"), doc = "```ignore")]
    /// # mod arms { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/doc/two_link.rs")); }
    /// use robot_model::control::{GravityCompensation, Safety, Status};
    /// use robot_model::{State, Vector};
    ///
    /// let limits = Safety::new().velocity([2.175, 2.61]);
    /// let mut control = GravityCompensation::new(arms::two_link()).with_safety(limits)?;
    /// let turning = |speed: f64| State::new(Vector::zeros(), Vector::from([speed, 0.0]), Vector::zeros());
    /// assert_eq!(control.torque(&turning(2.0)).status, Status::Normal);
    /// assert!(matches!(control.torque(&turning(-2.2)).status, Status::Held(_)));
    /// # Ok::<(), robot_model::control::ControlError>(())
    /// ```
    #[must_use]
    pub fn velocity(self, largest: [f64; D]) -> Self {
        Self {
            velocity: largest.into(),
            ..self
        }
    }

    /// Ends of the ranges of positions, rad or m: beyond them the arm is held.
    ///
    /// # Examples
    #[cfg_attr(feature = "derive", doc = "```")]
    #[cfg_attr(not(feature = "derive"), doc = "```ignore")]
    /// # mod arms { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/doc/two_link.rs")); }
    /// use robot_model::control::{FeedForward, Safety};
    ///
    /// let control = FeedForward::new(arms::two_link(), [200.0, 80.0], [20.0, 6.0])?;
    /// assert!(control.with_safety(Safety::new().position([-2.0, -1.0], [2.0, 1.0])).is_ok());
    /// let refused = control.with_safety(Safety::new().position([1.0, -2.0], [-1.0, 2.0])).unwrap_err();
    /// assert_eq!(
    ///     refused.to_string(),
    ///     "the position range of joint `shoulder` from 1 to -1 is empty; give the lower end first"
    /// );
    /// # Ok::<(), robot_model::control::ControlError>(())
    /// ```
    #[must_use]
    pub fn position(self, lower: [f64; D], upper: [f64; D]) -> Self {
        Self {
            lower: lower.into(),
            upper: upper.into(),
            ..self
        }
    }

    /// How fast the safe torque brakes, 1/s; 0 for not at all. Stable as long as it is below the rate of the cycles.
    ///
    /// # Examples
    #[cfg_attr(feature = "derive", doc = "```")]
    #[cfg_attr(not(feature = "derive"), doc = "```ignore")]
    /// # mod arms { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/doc/two_link.rs")); }
    /// use robot_model::control::{GravityCompensation, Safety};
    /// use robot_model::{State, Vector};
    ///
    /// // Too fast for its limit, an arm that is not braked coasts: the torque of gravity alone.
    /// let limits = Safety::new().velocity([2.0, 2.0]).brake(0.0);
    /// let mut control = GravityCompensation::new(arms::two_link()).with_safety(limits)?;
    /// let fast = State::new(Vector::zeros(), Vector::from([0.0, 3.0]), Vector::zeros());
    /// assert!((control.torque(&fast).torque[1] - 9.81 * 2.5 * 0.2).abs() < 1e-12);
    /// # Ok::<(), robot_model::control::ControlError>(())
    /// ```
    #[must_use]
    pub fn brake(self, rate: f64) -> Self {
        Self {
            brake: rate,
            ..self
        }
    }

    pub(super) fn check(&self, joints: &[&'static str; D]) -> Result<(), ControlError> {
        // An infinite limit is none.
        let is_limit = |value: f64| value > 0.0;
        let torque = ("torque limit", " N m or N", POSITIVE);
        each_joint(joints, self.torque.as_slice(), torque, is_limit)?;
        let velocity = ("velocity limit", " rad/s or m/s", POSITIVE);
        each_joint(joints, self.velocity.as_slice(), velocity, is_limit)?;
        let ends = self.lower.iter().zip(self.upper.iter());
        for (&joint, (&lower, &upper)) in joints.iter().zip(ends) {
            // Also where one of them is no number.
            if lower.partial_cmp(&upper) != Some(Ordering::Less) {
                return Err(ControlError::EmptyRange {
                    joint,
                    lower,
                    upper,
                });
            }
        }
        let brake = ("brake of the safe torque", " 1/s", NOT_NEGATIVE);
        number(self.brake, brake, is_not_negative(self.brake))
    }
}

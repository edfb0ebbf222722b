//! What a controller says once a cycle.

use core::fmt;

use crate::model::Vector;

/// Torque of one cycle, and what it is.
///
/// The torque is finite and within the limits whatever was measured.
///
/// # Examples
#[cfg_attr(feature = "derive", doc = "```")]
#[cfg_attr(not(feature = "derive"), doc = "```ignore")]
/// # mod arms { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/doc/two_link.rs")); }
/// use robot_model::control::{GravityCompensation, Safety, Status};
/// use robot_model::{State, Vector};
///
/// let weak = Safety::new().torque([5.0, 5.0]);
/// let mut control = GravityCompensation::new(arms::two_link()).with_safety(weak)?;
/// let command = control.torque(&State::at_rest(Vector::zeros()));
/// assert_eq!((command.status, command.saturated), (Status::Saturated, [true, false]));
/// assert_eq!(command.torque[0], 5.0);
/// # Ok::<(), robot_model::control::ControlError>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
#[must_use]
#[non_exhaustive]
pub struct Command<const D: usize> {
    /// Joint torques, N m or N.
    pub torque: Vector<D>,
    /// Where they come from.
    pub status: Status,
    /// Joints whose torque is at its limit.
    pub saturated: [bool; D],
}

/// What a cycle ended in.
///
/// # Examples
/// ```
/// use robot_model::control::{Reason, Signal, Status};
///
/// let lost = Status::Held(Reason::NoNumber { signal: Signal::Velocity, index: 2 });
/// assert_eq!(lost.to_string(), "held: the measured velocity of joint 3 is no finite number");
/// assert_eq!(Status::Saturated.to_string(), "saturated");
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum Status {
    /// The law's torque.
    Normal,
    /// The law's torque, cut to the limits.
    Saturated,
    /// The safe torque: the law has none.
    Held(Reason),
}

/// Why the safe torque is held. Indices count from 0, in words from 1.
///
/// # Examples
/// ```
/// use robot_model::control::{Reason, Signal};
///
/// let reason = Reason::OutsideLimits { signal: Signal::Position, index: 0 };
/// assert_eq!(reason.to_string(), "the measured position of joint 1 is outside of its limits");
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum Reason {
    /// A reading or a desired value is infinite or no number.
    NoNumber {
        /// Which.
        signal: Signal,
        /// Whose.
        index: usize,
    },
    /// A reading lies outside of the limits of [`Safety`](super::Safety).
    OutsideLimits {
        /// Which.
        signal: Signal,
        /// Whose.
        index: usize,
    },
    /// From sound readings the model makes a torque that is infinite or no number.
    NoTorque {
        /// Of which joint.
        index: usize,
    },
}

/// What a controller reads.
///
/// # Examples
/// ```
/// use robot_model::control::Signal;
/// assert_eq!(Signal::DesiredPosition.to_string(), "desired position");
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum Signal {
    /// Measured position of a joint.
    Position,
    /// Measured velocity of a joint.
    Velocity,
    /// Measured acceleration of a joint.
    Acceleration,
    /// Torque of a joint.
    Torque,
    /// Internal state of an effect.
    Memory,
    /// Channel that effects read.
    Input,
    /// The time.
    Time,
    /// Desired position of a joint.
    DesiredPosition,
    /// Desired velocity of a joint.
    DesiredVelocity,
    /// Desired acceleration of a joint.
    DesiredAcceleration,
}

impl Signal {
    const fn words(self) -> [&'static str; 2] {
        match self {
            Self::Position => ["measured position", "joint"],
            Self::Velocity => ["measured velocity", "joint"],
            Self::Acceleration => ["measured acceleration", "joint"],
            Self::Torque => ["torque", "joint"],
            Self::Memory => ["internal state", "number"],
            Self::Input => ["channel", "number"],
            Self::Time => ["time", "cycle"],
            Self::DesiredPosition => ["desired position", "joint"],
            Self::DesiredVelocity => ["desired velocity", "joint"],
            Self::DesiredAcceleration => ["desired acceleration", "joint"],
        }
    }
}

impl fmt::Display for Signal {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.words()[0])
    }
}

/// `velocity of joint 3`
struct Of(Signal, usize);

impl fmt::Display for Of {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let [what, whose] = self.0.words();
        match self.0 {
            Signal::Time => f.write_str(what),
            Signal::Memory | Signal::Input => write!(f, "{what} {}", self.1 + 1),
            _ => write!(f, "{what} of {whose} {}", self.1 + 1),
        }
    }
}

impl fmt::Display for Reason {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match *self {
            Self::NoNumber { signal, index } => {
                write!(f, "the {} is no finite number", Of(signal, index))
            }
            Self::OutsideLimits { signal, index } => {
                write!(f, "the {} is outside of its limits", Of(signal, index))
            }
            Self::NoTorque { index } => {
                write!(f, "the model has no finite torque for joint {}", index + 1)
            }
        }
    }
}

impl fmt::Display for Status {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Normal => f.write_str("normal"),
            Self::Saturated => f.write_str("saturated"),
            Self::Held(reason) => write!(f, "held: {reason}"),
        }
    }
}

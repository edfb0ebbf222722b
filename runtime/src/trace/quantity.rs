//! What a residual may be a function of.

use crate::signal::Prepared;

/// What a torque may follow from.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum Quantity {
    /// Position of a joint, from 0.
    Position(usize),
    /// Velocity of a joint; its curve may jump where the joint turns round.
    Velocity(usize),
    /// Acceleration of a joint.
    Acceleration(usize),
    /// What the transmission of a joint carries: torque of the rigid body.
    Load(usize),
    /// Position and velocity of a joint at once, one surface over both.
    Motion(usize),
    /// Positions of two joints at once.
    Positions(usize, usize),
    /// Velocities of two joints at once; the surface may jump where the first turns round.
    Velocities(usize, usize),
    /// Velocity of a joint and position of another one at once; the surface may jump where the first turns round.
    VelocityAndPosition(usize, usize),
    /// Velocity of a joint and time at once; the surface may jump where the joint turns round.
    VelocityAndTime(usize),
    /// Time since the start of a log.
    Time,
}

impl Quantity {
    /// Name in JSON.
    ///
    /// # Examples
    /// ```
    /// assert_eq!(robot_model::trace::Quantity::Time.name(), "time");
    /// ```
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Position(_) => "position",
            Self::Velocity(_) => "velocity",
            Self::Acceleration(_) => "acceleration",
            Self::Load(_) => "load",
            Self::Motion(_) => "position-and-velocity",
            Self::Positions(..) => "positions",
            Self::Velocities(..) => "velocities",
            Self::VelocityAndPosition(..) => "velocity-and-position",
            Self::VelocityAndTime(_) => "velocity-and-time",
            Self::Time => "time",
        }
    }

    /// The joints, from 0; none of time.
    ///
    /// # Examples
    /// ```
    /// use robot_model::trace::Quantity;
    /// assert_eq!(Quantity::Velocity(2).joints(), [2]);
    /// assert_eq!(Quantity::Positions(2, 0).joints(), [2, 0]);
    /// assert!(Quantity::Time.joints().is_empty());
    /// ```
    #[must_use]
    pub fn joints(self) -> Vec<usize> {
        match self {
            Self::Position(joint)
            | Self::Velocity(joint)
            | Self::Acceleration(joint)
            | Self::Load(joint)
            | Self::Motion(joint)
            | Self::VelocityAndTime(joint) => vec![joint],
            Self::Positions(joint, other)
            | Self::Velocities(joint, other)
            | Self::VelocityAndPosition(joint, other) => vec![joint, other],
            Self::Time => Vec::new(),
        }
    }

    /// Whether it is two quantities at once.
    ///
    /// # Examples
    /// ```
    /// use robot_model::trace::Quantity;
    /// assert!(Quantity::Motion(0).is_surface() && !Quantity::Load(0).is_surface());
    /// ```
    #[must_use]
    pub const fn is_surface(self) -> bool {
        match self {
            Self::Position(_)
            | Self::Velocity(_)
            | Self::Acceleration(_)
            | Self::Load(_)
            | Self::Time => false,
            Self::Motion(_)
            | Self::Positions(..)
            | Self::Velocities(..)
            | Self::VelocityAndPosition(..)
            | Self::VelocityAndTime(_) => true,
        }
    }

    /// What runs along the axes of its curve or surface; the last one may be a velocity.
    pub(super) fn axes(self) -> Vec<Axis> {
        match self {
            Self::Position(joint) => vec![Axis::Position(joint)],
            Self::Velocity(joint) => vec![Axis::Velocity(joint)],
            Self::Acceleration(joint) => vec![Axis::Acceleration(joint)],
            Self::Load(joint) => vec![Axis::Load(joint)],
            Self::Time => vec![Axis::Time],
            Self::Motion(joint) => vec![Axis::Position(joint), Axis::Velocity(joint)],
            Self::Positions(joint, other) => vec![Axis::Position(other), Axis::Position(joint)],
            Self::Velocities(joint, other) => vec![Axis::Velocity(other), Axis::Velocity(joint)],
            Self::VelocityAndPosition(joint, other) => {
                vec![Axis::Position(other), Axis::Velocity(joint)]
            }
            Self::VelocityAndTime(joint) => vec![Axis::Time, Axis::Velocity(joint)],
        }
    }
}

/// One quantity, of which a log has a value at each instant.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Axis {
    Position(usize),
    Velocity(usize),
    Acceleration(usize),
    Load(usize),
    Time,
}

impl Axis {
    pub(super) fn values(self, log: &Prepared) -> &[f64] {
        let motion = &log.motion;
        match self {
            Self::Position(joint) => &motion.wide.q[joint],
            Self::Velocity(joint) => &motion.wide.dq[joint],
            Self::Acceleration(joint) => &motion.smooth.ddq[joint],
            Self::Load(joint) => &motion.rigid_torque[joint],
            Self::Time => &motion.time,
        }
    }
}

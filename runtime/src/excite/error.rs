//! Why there is no motion.

/// A design that cannot be made.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum ExciteError {
    /// A joint that cannot move.
    #[error(
        "joint `{joint}` has no range: its position is limited to {low} .. {high}; widen the range, or keep the joint still with a small \
         range around its pose"
    )]
    NoRange {
        /// The joint.
        joint: String,
        /// Its limits.
        low: f64,
        /// Its limits.
        high: f64,
    },
    /// A limit that is not above zero.
    #[error(
        "joint `{joint}` has a {what} limit of {limit}, which allows no motion; write a positive number"
    )]
    NoRoom {
        /// The joint.
        joint: String,
        /// What is limited.
        what: &'static str,
        /// The limit.
        limit: f64,
    },
    /// A joint whose velocity has no limit.
    #[error(
        "joint `{joint}` has no velocity limit, so the best motion would be infinitely fast; write `velocity = ..` into its spec"
    )]
    Unlimited {
        /// The joint.
        joint: String,
    },
    /// A number that has to be positive.
    #[error("the {what} is {value}; it must be a positive number")]
    NotPositive {
        /// Which one.
        what: &'static str,
        /// What was given.
        value: f64,
    },
    /// Too few waves for its ends, or more than a controller could follow.
    #[error(
        "{harmonics} harmonics are not from {least} to {most}: a motion that begins and ends at rest has at least two, one in motion at least one"
    )]
    Harmonics {
        /// What was given.
        harmonics: usize,
        /// Fewest.
        least: usize,
        /// Most.
        most: usize,
    },
    /// Nothing that a motion could tell.
    #[error(
        "no column of the regressor depends on the motion: there is nothing to design; declare a link or an effect with unknown parameters"
    )]
    NoColumns,
    /// Numbers for another arm.
    #[error("{found} {what}, {expected} are needed")]
    Size {
        /// Of what.
        what: &'static str,
        /// How many there are.
        found: usize,
        /// How many there have to be.
        expected: usize,
    },
    /// Two effects that are none, or not two.
    #[error("two effects need columns of their own, with sizes that are not all zero: {0}")]
    Rivals(&'static str),
    /// A pose that is none, or beyond the limits.
    #[error("the pose has joint `{joint}` at {position}, which is not within {low} .. {high}")]
    Pose {
        /// The joint.
        joint: String,
        /// Where it should begin.
        position: f64,
        /// Its limits.
        low: f64,
        /// Its limits.
        high: f64,
    },
    /// Noise that is no deviation.
    #[error("the torque noise of joint `{joint}` is {noise}; write a positive standard deviation")]
    Noise {
        /// The joint.
        joint: String,
        /// What was given.
        noise: f64,
    },
    /// A pose for another arm.
    #[error("the pose has {given} positions, the arm {joints} joints")]
    Ends {
        /// Positions given.
        given: usize,
        /// Joints of the arm.
        joints: usize,
    },
    /// No motion inside the limits was found.
    #[error(
        "no motion keeps the limits: {poses}, however small the motion; the last one exceeds the limit on the {what} by {by}"
    )]
    Infeasible {
        /// Poses that were tried.
        poses: String,
        /// The limit.
        what: String,
        /// By how much it is missed.
        by: String,
    },
    /// Parameters that no motion tells which was found.
    #[error(
        "no motion found within these limits separates {0}: fix them in the spec, widen the limits of the joints that excite them, try more \
         starts, or give the arm's parameters if the effects depend on the load"
    )]
    NotExcited(String),
}

//! Why there is no motion.

/// A design that cannot be made.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum ExciteError {
    /// A joint that cannot move.
    #[error(
        "joint `{joint}` has no range: its position is limited to {low} .. {high}; give it one, or take the joint out of the motion with a range around its pose"
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
        "joint `{joint}` has a {what} limit of {limit}, which leaves no motion; limits are positive numbers"
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
        "joint `{joint}` has no velocity limit, so faster is always better; write `velocity = ..` into its spec"
    )]
    Unlimited {
        /// The joint.
        joint: String,
    },
    /// A number that has to be positive.
    #[error("the {what} is {value}; it has to be a positive number")]
    NotPositive {
        /// Which one.
        what: &'static str,
        /// What was given.
        value: f64,
    },
    /// Too few waves for a motion that begins at rest.
    #[error("{0} harmonics are too few: a motion that begins and ends at rest has at least two")]
    FewHarmonics(usize),
    /// Noise that is no deviation.
    #[error("the torque noise of joint `{joint}` is {noise}; a standard deviation is positive")]
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
        "no motion keeps the limits: of {tries} random poses none does so at rest; the last one misses the limit on the {what} by {percent:.0} %"
    )]
    Infeasible {
        /// Poses that were tried.
        tries: usize,
        /// The limit.
        what: String,
        /// By how much it is missed.
        percent: f64,
    },
    /// Parameters that no motion tells.
    #[error(
        "no motion within these limits tells {0}: fix them in the spec, or widen the limits of the joints that move them"
    )]
    NotExcited(String),
}

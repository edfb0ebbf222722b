//! Numbers that no controller can have, and the words for them.

use core::fmt;

/// Why a controller was refused. Joints are called by the arm's names.
///
/// # Examples
#[cfg_attr(feature = "derive", doc = "```")]
#[cfg_attr(not(feature = "derive"), doc = "```ignore")]
/// # mod arms { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/doc/two_link.rs")); }
/// use robot_model::control::{ComputedTorque, Gains};
///
/// let refused = ComputedTorque::new(arms::two_link(), Gains::each([25.0, -3.0], [1.0, 1.0])).unwrap_err();
/// assert_eq!(
///     refused.to_string(),
///     "natural frequency of joint `elbow` is -3 rad/s; give a positive, finite number"
/// );
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub enum ControlError {
    /// A number of a joint.
    Joint {
        /// What it is.
        what: &'static str,
        /// Name of the joint.
        joint: &'static str,
        /// As given.
        value: f64,
        /// Its unit, with a space in front; nothing where it has none.
        unit: &'static str,
        /// What would do.
        wanted: &'static str,
    },
    /// A number of the controller.
    Number {
        /// What it is.
        what: &'static str,
        /// As given.
        value: f64,
        /// Its unit, with a space in front; nothing where it has none.
        unit: &'static str,
        /// What would do.
        wanted: &'static str,
    },
    /// A range of positions in which there is none.
    EmptyRange {
        /// Name of the joint.
        joint: &'static str,
        /// Its lower end, rad or m.
        lower: f64,
        /// Its upper end, rad or m.
        upper: f64,
    },
    /// A range of a parameter that does not hold the arm's own value.
    Outside {
        /// Name of the base parameter.
        parameter: &'static str,
        /// Value of the arm.
        value: f64,
        /// The range's lower end.
        lower: f64,
        /// The range's upper end.
        upper: f64,
    },
    /// A weight that would have to be negative.
    NegativeWeight {
        /// What is to be balanced, N m.
        moment: f64,
    },
}

impl fmt::Display for ControlError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Joint {
                what,
                joint,
                value,
                unit,
                wanted,
            } => write!(
                f,
                "{what} of joint `{joint}` is {value}{unit}; give {wanted}"
            ),
            Self::Number {
                what,
                value,
                unit,
                wanted,
            } => write!(f, "{what} is {value}{unit}; give {wanted}"),
            Self::EmptyRange {
                joint,
                lower,
                upper,
            } => write!(
                f,
                "the position range of joint `{joint}` from {lower} to {upper} is empty; give the lower end first"
            ),
            Self::Outside {
                parameter,
                value,
                lower,
                upper,
            } => write!(
                f,
                "parameter `{parameter}` is {value}, outside of its range from {lower} to {upper}; give a range with that value in it"
            ),
            Self::NegativeWeight { moment } => write!(
                f,
                "no counterweight on this side of the axis balances a moment of {moment} N m; put it on the other side, and give the moment \
                 with the opposite sign"
            ),
        }
    }
}

impl core::error::Error for ControlError {}

pub(super) const POSITIVE: &str = "a positive, finite number";
pub(super) const NOT_NEGATIVE: &str = "a finite number that is not negative";

/// One number a joint, each as `is_sound` wants it.
pub(super) fn each_joint<const D: usize>(
    joints: &[&'static str; D],
    values: &[f64],
    (what, unit, wanted): (&'static str, &'static str, &'static str),
    is_sound: impl Fn(f64) -> bool,
) -> Result<(), ControlError> {
    let wrong = joints
        .iter()
        .zip(values)
        .find(|(_, value)| !is_sound(**value));
    match wrong {
        None => Ok(()),
        Some((&joint, &value)) => Err(ControlError::Joint {
            what,
            joint,
            value,
            unit,
            wanted,
        }),
    }
}

/// One number, as `is_sound` wants it.
pub(super) fn number(
    value: f64,
    (what, unit, wanted): (&'static str, &'static str, &'static str),
    is_sound: bool,
) -> Result<(), ControlError> {
    if is_sound {
        return Ok(());
    }
    Err(ControlError::Number {
        what,
        value,
        unit,
        wanted,
    })
}

pub(super) fn is_positive(value: f64) -> bool {
    value > 0.0 && value.is_finite()
}

pub(super) fn is_not_negative(value: f64) -> bool {
    value >= 0.0 && value.is_finite()
}

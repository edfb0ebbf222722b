//! Why a candidate is not named.

use std::fmt;

use super::super::gate::MATERIAL_PERCENT;

/// Why a candidate is not named.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum Refusal {
    /// Its score may be that of noise, with all candidates tried.
    Chance,
    /// A shape parameter is best at the end of its range: the law is another one.
    EndOfRange,
    /// Its parameters differ from fold to fold.
    Unsteady,
    /// A parameter that is never negative is.
    Sign,
    /// It is worse on data that it was not fitted on, in more than one fold or altogether.
    HeldOut,
    /// It lowers the error of none of its joints by as much as matters.
    Small,
    /// The arm with it has no solution inside the ranges of its shapes.
    Unsolved,
    /// It reads the logged torque, whose noise explains itself: there is no structure, or the model's own torque in its place says next to
    /// nothing.
    Noise,
    /// It is a law of the part of the motion's period, and leaves of what comes back in every period.
    ComesBack,
    /// None of its parameters stands out of its deviation, with its shapes open: one is traded for another.
    Undetermined,
    /// It lowers errors where joints turn alone, whose dry friction holds them there by what no law of the model says.
    AtTurns,
}

impl Refusal {
    /// Name in JSON.
    ///
    /// # Examples
    /// ```
    /// assert_eq!(robot_model::trace::Refusal::HeldOut.name(), "held-out");
    /// ```
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Chance => "chance",
            Self::EndOfRange => "end-of-range",
            Self::Unsteady => "unsteady",
            Self::Sign => "sign",
            Self::HeldOut => "held-out",
            Self::Small => "small",
            Self::Unsolved => "unsolved",
            Self::Noise => "noise",
            Self::ComesBack => "comes-back",
            Self::Undetermined => "undetermined",
            Self::AtTurns => "at-turns",
        }
    }
}

impl fmt::Display for Refusal {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Chance => write!(f, "not significant"),
            Self::EndOfRange => write!(f, "shape at its limit"),
            Self::Unsteady => write!(f, "folds disagree"),
            Self::Sign => write!(f, "wrong sign"),
            Self::HeldOut => write!(f, "no better held out"),
            Self::Small => write!(f, "under {MATERIAL_PERCENT} % of the error"),
            Self::Unsolved => write!(f, "no solution in its ranges"),
            Self::Noise => write!(f, "only measurement noise"),
            Self::ComesBack => write!(f, "leaves a repeating residual"),
            Self::Undetermined => write!(f, "no parameter is significant"),
            Self::AtTurns => write!(f, "only near velocity reversals"),
        }
    }
}

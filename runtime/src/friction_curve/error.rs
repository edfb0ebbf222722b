//! Why a friction curve cannot be had, and the words for it.

use crate::signal::SignalError;

/// Why a friction curve, its law or its bristles cannot be had.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum FrictionError {
    /// No log has the joint at constant speed.
    #[error(
        "joint {joint} never moves at a constant speed for 0.3 s while all others rest; drive it so, at several speeds"
    )]
    NoStretch {
        /// Name of the joint.
        joint: String,
    },
    /// The log's bands are too narrow, or it is too short.
    #[error(transparent)]
    Signal(#[from] SignalError),
    /// The torque beside friction is nearly the same at all times of each speed.
    #[error(
        "the rigid body's torque at joint {joint} cannot be separated from friction: of {columns} that act on it only {rank} can, over \
         {travel:.3} rad or m of travel; move further, or give the arm's parameters with `--parameters`",
        columns = counted(*.columns)
    )]
    NotSeparated {
        /// Name of the joint.
        joint: String,
        /// Directions of the rigid body's columns that change at all.
        columns: usize,
        /// Those that change while the speed stays.
        rank: usize,
        /// How far the joint moves, rad or m.
        travel: f64,
    },
    /// A constant torque beside friction, and no motion back.
    #[error(
        "a constant torque at joint {joint}, such as gravity on a rail or over a short travel, cannot be separated from friction in one \
         direction; move further, or also back at the same speeds, or give the arm's parameters with `--parameters`"
    )]
    Constant {
        /// Name of the joint.
        joint: String,
    },
    /// Too few speeds for a law.
    #[error(
        "a friction law needs {least} speeds, but there are {found}; drive the joint at more speeds"
    )]
    TooFewSpeeds {
        /// How many there are, both directions counted once.
        found: usize,
        /// How many there have to be.
        least: usize,
    },
    /// Speeds that do not tell the parameters of a law apart.
    #[error(
        "the speeds do not separate Coulomb from viscous friction; drive the joint at speeds further apart"
    )]
    SpeedsAlike,
    /// The joint moves from the start.
    #[error("{source_name}: the joint does not rest at the start; pre-sliding begins at rest")]
    NoRest {
        /// Name of the log.
        source_name: String,
    },
    /// The torque does not rise far enough.
    #[error(
        "{source_name}: the friction torque rises to {reached:.4} only before the joint slides, where it breaks away at {breakaway:.4}; raise the \
         torque slowly from rest until the joint breaks away"
    )]
    NoRise {
        /// Name of the log.
        source_name: String,
        /// Its largest value at rest, N m or N.
        reached: f64,
        /// What the static law says, N m or N.
        breakaway: f64,
    },
    /// Positions that do not follow the torque.
    #[error(
        "{source_name}: the positions do not follow the torque before the joint slides: the bristles are too stiff for the encoder (its \
         step is {step:.3e}), or the torque rises too fast"
    )]
    NoDeflection {
        /// Name of the log.
        source_name: String,
        /// Step of the encoder, rad or m.
        step: f64,
    },
    /// Other joints stand elsewhere than while the curve was measured.
    #[error(
        "{source_name}: joint {joint} is at another position than when the curve was measured, so gravity is unknown; put it there, or give \
         the arm's parameters with `--parameters`"
    )]
    OtherPose {
        /// Name of the log.
        source_name: String,
        /// Name of the joint.
        joint: String,
    },
}

fn counted(columns: usize) -> String {
    match columns {
        1 => "1 column".to_owned(),
        _ => format!("{columns} columns"),
    }
}

//! Why there is no estimate by output error.

use thiserror::Error;

use crate::simulate::SimulateError;

/// Why there is no estimate.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum OutputErrorError {
    /// The arm cannot be simulated where the search starts.
    #[error(
        "{log}: with the start parameters: {error}; start nearer to the arm, cut the log into windows, or simulate its controller too"
    )]
    Start {
        /// The log.
        log: String,
        /// What happened.
        error: SimulateError,
    },
    /// An arm with given parameters does not stay near its log.
    #[error(
        "{log}: with these parameters the simulated arm diverges from it: {error}; use shorter windows"
    )]
    Away {
        /// The log.
        log: String,
        /// What happened.
        error: SimulateError,
    },
    /// The first part of a search has led no deeper than another search did, see [`OutputError::below`](super::OutputError::below).
    #[error("the search reached a cost of {cost:.6e}, not below {below:.6e}")]
    NotDeeper {
        /// Where it has led.
        cost: f64,
        /// What it was to be below.
        below: f64,
    },
    /// Positions are the same all along.
    #[error("no joint moves in these logs, so simulated positions determine nothing: move the arm")]
    Still,
    /// A controller remembers across windows.
    #[error("a controller is simulated along whole logs; remove the window")]
    WindowedLaw,
    /// Starts that are held are those of whole logs.
    #[error("held starts belong to whole logs; remove the window")]
    WindowedStarts,
    /// Parts have other sizes than the arm.
    #[error("{what}: {found} for an arm with {expected}")]
    Size {
        /// What it is.
        what: &'static str,
        /// How many there are.
        found: usize,
        /// How many there should be.
        expected: usize,
    },
    /// A start outside of its bounds.
    #[error("parameter {name} starts at {value}, outside of its bounds {low} .. {high}")]
    Outside {
        /// The parameter.
        name: String,
        /// Where it starts.
        value: f64,
        /// Its least value.
        low: f64,
        /// Its largest.
        high: f64,
    },
    /// A log lacks what its controller reads.
    #[error("{log}: it has no column `{channel}`, which the controller reads")]
    NoChannel {
        /// The log.
        log: String,
        /// The channel.
        channel: String,
    },
    /// A window without room for a motion.
    #[error("windows of {seconds} s have too few samples for a motion; make them longer")]
    Short {
        /// Its length, s.
        seconds: f64,
    },
}

//! What can be wrong with a filter or with a log that is to be filtered, and the words for it.

use thiserror::Error;

/// Why signals cannot be prepared.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum SignalError {
    /// The order of a low-pass is odd or zero.
    #[error("a Butterworth low-pass of order {order}: the order must be even, and at least 2")]
    Order {
        /// As asked for.
        order: usize,
    },
    /// A cutoff at zero or below, or at half the sample rate or above.
    #[error(
        "a low-pass at {} Hz on samples at {} Hz: the cutoff must lie between 0 and {} Hz",
        short(*.cutoff_hz), short(*.rate_hz), short(*.rate_hz / 2.0)
    )]
    Cutoff {
        /// As asked for.
        cutoff_hz: f64,
        /// Sample rate.
        rate_hz: f64,
    },
    /// A wide band at half the rate or above that logs are brought down to before columns are formed.
    #[error(
        "a wide band of {} Hz: a log of {} Hz is brought down to {} Hz before columns are formed, so all bands must lie below {} Hz",
        short(*.wide_hz), short(*.logged_hz), short(*.rate_hz), short(*.rate_hz / 2.0)
    )]
    Reduced {
        /// As asked for.
        wide_hz: f64,
        /// Sample rate of the log.
        logged_hz: f64,
        /// Sample rate of the columns.
        rate_hz: f64,
    },
    /// A corner of a first-order filter at zero or below, or too fast for the samples.
    #[error(
        "a corner of {} rad/s on samples at {} Hz: it must lie between 0 and {} rad/s",
        short(*.corner), short(*.rate_hz), short(*.largest)
    )]
    Corner {
        /// As asked for, rad/s.
        corner: f64,
        /// Sample rate.
        rate_hz: f64,
        /// The end of the range, rad/s.
        largest: f64,
    },
    /// Bands that are not one inside the other.
    #[error(
        "bands of {} Hz (shared), {} Hz (smooth) and {} Hz (wide): each must be at least the one before it",
        short(*.shared_hz), short(*.smooth_hz), short(*.wide_hz)
    )]
    Bands {
        /// Band of the filter that torque and columns share.
        shared_hz: f64,
        /// Band of rigid-body kinematics.
        smooth_hz: f64,
        /// Band of effects' kinematics.
        wide_hz: f64,
    },
    /// The filters' transients are as long as the log.
    #[error(
        "{source_name}: a log of {seconds:.3} s is too short for a low-pass at {} Hz; at least {needed:.3} s are needed; record a longer motion, or give wider bands, as `--bands` does",
        short(*.shared_hz)
    )]
    TooShort {
        /// The log.
        source_name: String,
        /// Its length.
        seconds: f64,
        /// Length from which on something is left.
        needed: f64,
        /// Band of the filter that torque and columns share.
        shared_hz: f64,
    },
}

/// Four decimals at most: a rate that was measured has no more.
fn short(value: f64) -> String {
    let text = format!("{value:.4}");
    if text.contains('.') {
        text.trim_end_matches('0').trim_end_matches('.').to_owned()
    } else {
        text
    }
}

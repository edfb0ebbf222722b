//! What is said of faults.

use std::fmt;

use super::{Fault, LateChannel, velocity};

impl fmt::Display for Fault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Spikes {
                channel,
                samples,
                first,
            } => write!(
                f,
                "{channel}: {samples} samples are far from both neighbors, the first at {first:.3} s; they were replaced by interpolation"
            ),
            Self::Held { channel, at } => {
                write!(f, "{channel} is frozen while the arm moves, {at}")
            }
            Self::Dropouts { channel, at } => {
                write!(f, "{channel} jumps to a constant and back, {at}")
            }
            Self::Bursts { channel, at } => {
                write!(f, "{channel} jumps far away and back, {at}")
            }
            Self::Wrapped {
                channel,
                times,
                first,
            } => write!(
                f,
                "{channel} wraps around {}; whole turns were removed",
                how_often(*times, *first)
            ),
            Self::Slips {
                channel,
                times,
                first,
                largest,
            } => write!(
                f,
                "{channel} jumps and stays {}, by {largest:.4}{}: an encoder slipped or was reset; nothing is fitted around the jump, and \
                 positions after it were shifted back; if those before it are wrong, remove them from the log",
                how_often(*times, *first),
                if *times == 1 { "" } else { " at most" }
            ),
            Self::Coincident { samples, first } => write!(
                f,
                "{samples} samples nearly coincide in time with the one before, the first at {first:.3} s; each pair was replaced by its mean"
            ),
            Self::Jitter { step, rms, largest } => write!(
                f,
                "time stamps are not uniform: steps differ from their median of {:.4} ms by {:.4} ms RMS, {:.4} ms at most; the log was \
                 resampled",
                1e3 * step,
                1e3 * rms,
                1e3 * largest
            ),
            Self::Gaps { at } => write!(f, "samples are missing, {at}"),
            Self::Clipped {
                channel,
                value,
                share,
            } => write!(
                f,
                "{channel} is at its limit of {value:.4} for {:.1} % of the samples: the drive saturated; `identify` leaves out these \
                 samples of the joint unless `torque_saturation` is declared; log a motion that needs less torque",
                100.0 * share
            ),
            Self::VelocityLate { channel, delay } => write!(
                f,
                "{channel} is {:.4} s {} against the derivative of the position; it is not used, velocities are computed from positions",
                delay.abs(),
                late_or_early(*delay)
            ),
            Self::Late {
                late,
                channel,
                joint,
                delay,
                std,
                gain,
            } => {
                let (rest, way_out) = late.words(*delay);
                write!(
                    f,
                    "{channel} of joint `{joint}` is {:.5} s +- {std:.1e} {} against {rest} are biased by that; correcting it reduces the \
                     joint's error by {:.0} %: {way_out}",
                    delay.abs(),
                    late_or_early(*delay),
                    100.0 * gain
                )
            }
            Self::VelocityScale { channel, factor } => said_of_scale(f, channel, *factor),
            Self::Still { channel } => write!(
                f,
                "{channel} is the same at all times: the joint does not move"
            ),
            Self::AtRest { channel, rms } => write!(
                f,
                "{channel} moves by no more than its noise of {rms:.1e} RMS: the joint is at rest, and its mean is used"
            ),
            Self::Constant { channel, value } => write!(
                f,
                "{channel} is {value} at all times: nothing was logged, or the drive was off"
            ),
        }
    }
}

fn said_of_scale(f: &mut fmt::Formatter<'_>, channel: &str, factor: f64) -> fmt::Result {
    write!(
        f,
        "{channel} is {factor:.4} times the derivative of the position{}; it is not used, but check that position and torque are in SI units",
        velocity::unit(factor)
    )
}

impl LateChannel {
    /// Against what it is late by so much and what is found so, and the way out. No recorder has torques before their time.
    fn words(self, delay: f64) -> (&'static str, &'static str) {
        match self {
            Self::Torque if delay < 0.0 => (
                "the position, and values of friction and inertia",
                "either the position is late, or an undeclared effect looks like it, such as the inertia of a rotor: `trace` looks for it; `time_delay;` in `effects` identifies one delay of all joints",
            ),
            Self::Torque => (
                "the position, and values of friction and inertia",
                "declare `time_delay;` in `effects` to identify one delay of all joints, up to 0.03 s; correct longer ones in the log",
            ),
            Self::Position => (
                "all other channels, and all values that depend on it",
                "shift the column by that time",
            ),
        }
    }
}

/// How often something was there, and at which second first.
pub(super) fn how_often(times: usize, first: f64) -> String {
    match times {
        1 => format!("once, at {first:.3} s"),
        _ => format!("{times} times, the first at {first:.3} s"),
    }
}

fn late_or_early(delay: f64) -> &'static str {
    if delay > 0.0 { "late" } else { "early" }
}

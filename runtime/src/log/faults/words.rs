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
                "{channel}: {samples} samples are far from both their neighbors, the first at {first:.3} s; they were replaced by straight lines"
            ),
            Self::Held { channel, at } => {
                write!(f, "{channel} stands still while the arm moves on, {at}")
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
                "{channel} begins its turn again {}; whole turns were taken out",
                how_often(*times, *first)
            ),
            Self::Slips {
                channel,
                times,
                first,
                largest,
            } => write!(
                f,
                "{channel} jumps and stays {}, by {largest:.4}{}: an encoder slipped or was set anew; nothing is fitted around it, and \
                 positions behind it were moved back by it, as an arm does not jump: if those before it are wrong, leave them out of the log",
                how_often(*times, *first),
                if *times == 1 { "" } else { " at most" }
            ),
            Self::Coincident { samples, first } => write!(
                f,
                "{samples} samples nearly coincide in time with the one before, the first at {first:.3} s; their mean stands for both"
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
                "{channel} stands at its limit of {value:.4} for {:.1} % of the samples: the drive gave no more; `identify` leaves the joint's \
                 samples there out unless `torque_saturation` is declared; log a motion that asks for less",
                100.0 * share
            ),
            Self::VelocityLate { channel, delay } => write!(
                f,
                "{channel} is {:.4} s {} against the slope of the position; it is not used, velocities are computed from positions",
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
                let (rest, way_out) = late.words();
                write!(
                    f,
                    "{channel} of joint `{joint}` is {:.5} s +- {std:.1e} {} against {rest} are off by what makes up for that; its error is {:.0} % less without that: \
                     {way_out}",
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
                "{channel} moves by no more than its noise of {rms:.1e} RMS: the joint stands still, and its mean stands for it"
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
        "{channel} is {factor:.4} times the slope of the position{}; it is not used, but see whether position and torque are in SI units",
        velocity::unit(factor)
    )
}

impl LateChannel {
    /// Against what it is late and what is found so, and the way out.
    const fn words(self) -> (&'static str, &'static str) {
        match self {
            Self::Torque => (
                "the position, and values of friction and inertia",
                "`time_delay;` among the effects finds one delay of all joints, up to 0.03 s, longer ones are to be taken out of the log",
            ),
            Self::Position => (
                "all other channels, and values of all that depends on it",
                "move the column by so much",
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

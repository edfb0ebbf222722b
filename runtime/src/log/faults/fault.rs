//! What can be wrong with the data of a log, and the words for it.

use std::f64::consts::TAU;
use std::fmt;

use super::velocity;
use crate::log::Note;

/// What is wrong with the data of a log.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub enum Fault {
    /// Samples far from both their neighbors; they were replaced by a straight line.
    Spikes {
        /// Name of the channel, `q1` or `tau1`.
        channel: String,
        /// How many samples.
        samples: usize,
        /// Time of the first, s.
        first: f64,
    },
    /// A value that stood still while the arm moved on; short holds were replaced by a straight line, at longer ones the log has a hole.
    Held {
        /// Name of the channel.
        channel: String,
        /// How often and how long.
        at: Stretches,
    },
    /// A constant to which a channel jumps, and from which it jumps back; short ones were replaced by a straight line, at longer ones the log
    /// has a hole.
    Dropouts {
        /// Name of the channel.
        channel: String,
        /// How often and how long.
        at: Stretches,
    },
    /// Samples that are far from those around them for some time, and come back; short ones were replaced by a straight line, at longer ones
    /// the log has a hole.
    Bursts {
        /// Name of the channel.
        channel: String,
        /// How often and how long.
        at: Stretches,
    },
    /// A position that jumps and stays; the log has a hole there.
    Slips {
        /// Name of the channel.
        channel: String,
        /// How often.
        times: usize,
        /// Time of the first, s.
        first: f64,
        /// The largest, rad or m.
        largest: f64,
    },
    /// Samples that nearly coincide in time with the one before, as the reader tells: their mean stands for both.
    Coincident {
        /// How many.
        samples: usize,
        /// Time of the first, s.
        first: f64,
    },
    /// Time stamps that are not uniform, as the reader tells: the log is interpolated onto a grid of their median step.
    Jitter {
        /// That step, s.
        step: f64,
        /// Root mean square of what steps differ from it, s.
        rms: f64,
        /// The most that one does, s.
        largest: f64,
    },
    /// Samples that are missing in time, as the reader tells; short gaps were filled by a straight line, at longer ones the log has a hole.
    Gaps {
        /// How often and how long.
        at: Stretches,
    },
    /// A torque that stands at its largest or smallest value.
    Clipped {
        /// Name of the channel.
        channel: String,
        /// That value, in the log's unit.
        value: f64,
        /// Share of the samples.
        share: f64,
    },
    /// A logged velocity that is not the slope of the position at the same time.
    VelocityLate {
        /// Name of the channel.
        channel: String,
        /// By how much it is late, s; negative where it is early.
        delay: f64,
    },
    /// A torque that is not of the time of the position, as an identification tells it; no log is mended of it.
    TorqueLate {
        /// Name of the channel.
        channel: String,
        /// Name of the joint.
        joint: String,
        /// By how much it is late, s; negative where it is early.
        delay: f64,
        /// Its standard deviation, s.
        std: f64,
        /// By which share the joint's error is less without it.
        gain: f64,
    },
    /// A logged velocity in another unit than the position, or of the other sign.
    VelocityScale {
        /// Name of the channel.
        channel: String,
        /// Logged velocity over slope of the position.
        factor: f64,
    },
    /// A joint that does not move.
    Still {
        /// Name of the channel.
        channel: String,
    },
    /// A torque that is the same at all times.
    Constant {
        /// Name of the channel.
        channel: String,
        /// That value.
        value: f64,
    },
}

/// Samples in a row that are not the sensor's, as often as there are.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Stretches {
    /// How often.
    pub times: usize,
    /// How many samples.
    pub samples: usize,
    /// Time of the first, s.
    pub first: f64,
    /// The longest, s.
    pub longest: f64,
}

impl fmt::Display for Stretches {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self {
            times,
            samples,
            first,
            longest,
        } = self;
        write!(
            f,
            "{times} times, {samples} samples in all, {longest:.3} s at most, the first at {first:.3} s; they were replaced by straight \
             lines, and nothing is fitted around those of more than 10 ms"
        )
    }
}

impl Fault {
    /// What the reader noted and had to mend.
    pub(super) fn of_note(note: &Note) -> Option<Self> {
        match note {
            Note::Coincident { samples, first } => Some(Self::Coincident {
                samples: *samples,
                first: *first,
            }),
            Note::Gaps { at } => Some(Self::Gaps { at: *at }),
            Note::Resampled {
                step,
                jitter_rms,
                jitter_max,
                ..
            } => Some(Self::Jitter {
                step: *step,
                rms: *jitter_rms,
                largest: *jitter_max,
            }),
            _ => None,
        }
    }

    /// Whether [`Log::report`](crate::log::Log::report) tells it, too.
    #[must_use]
    pub const fn is_in_report(&self) -> bool {
        matches!(
            self,
            Self::Coincident { .. } | Self::Jitter { .. } | Self::Gaps { .. }
        )
    }

    /// Kebab-case name of its kind.
    #[must_use]
    pub const fn kind(&self) -> &'static str {
        match self {
            Self::Spikes { .. } => "spikes",
            Self::Held { .. } => "held",
            Self::Dropouts { .. } => "dropouts",
            Self::Bursts { .. } => "bursts",
            Self::Slips { .. } => "slips",
            Self::Coincident { .. } => "coincident",
            Self::Jitter { .. } => "jitter",
            Self::Gaps { .. } => "gaps",
            Self::Clipped { .. } => "clipped",
            Self::VelocityLate { .. } => "velocity-late",
            Self::TorqueLate { .. } => "late-torque",
            Self::VelocityScale { .. } => "velocity-scale",
            Self::Still { .. } => "still",
            Self::Constant { .. } => "constant",
        }
    }

    /// Name of the channel that has it; `time` where that is all of them.
    #[must_use]
    pub fn channel(&self) -> &str {
        match self {
            Self::Spikes { channel, .. }
            | Self::Held { channel, .. }
            | Self::Dropouts { channel, .. }
            | Self::Bursts { channel, .. }
            | Self::Slips { channel, .. }
            | Self::Clipped { channel, .. }
            | Self::VelocityLate { channel, .. }
            | Self::TorqueLate { channel, .. }
            | Self::VelocityScale { channel, .. }
            | Self::Still { channel }
            | Self::Constant { channel, .. } => channel,
            Self::Coincident { .. } | Self::Jitter { .. } | Self::Gaps { .. } => "time",
        }
    }
}

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
            Self::Slips {
                channel,
                times,
                first,
                largest,
            } => {
                let way_out = if (largest.abs() / TAU - 1.0).abs() < 0.01 {
                    "it is a whole turn: unwrap the angle"
                } else {
                    "an encoder slipped or was set anew: split the log there and leave out what is wrong"
                };
                write!(
                    f,
                    "{channel} jumps and stays {times} times, the first at {first:.3} s, by {largest:.4} at most; nothing is fitted around \
                     it, but positions before and behind do not have the same zero; {way_out}"
                )
            }
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
            Self::VelocityLate { channel, delay } => {
                let word = if *delay > 0.0 { "late" } else { "early" };
                write!(
                    f,
                    "{channel} is {:.4} s {word} against the slope of the position; it is not used, velocities are computed from positions",
                    delay.abs()
                )
            }
            Self::TorqueLate {
                channel,
                joint,
                delay,
                std,
                gain,
            } => {
                let word = if *delay > 0.0 { "late" } else { "early" };
                write!(
                    f,
                    "{channel} of joint `{joint}` is {:.5} s +- {std:.1e} {word} against the position, and friction and inertia are found with it; \
                     its error is {:.0} % less without that: `time_delay;` among the effects finds one delay of all joints, up to 0.03 s, \
                     longer ones are to be taken out of the log",
                    delay.abs(),
                    100.0 * gain
                )
            }
            Self::VelocityScale { channel, factor } => {
                write!(
                    f,
                    "{channel} is {factor:.4} times the slope of the position{}; it is not used, but see whether position and torque are in SI units",
                    velocity::unit(*factor)
                )
            }
            Self::Still { channel } => write!(
                f,
                "{channel} is the same at all times: the joint does not move"
            ),
            Self::Constant { channel, value } => write!(
                f,
                "{channel} is {value} at all times: nothing was logged, or the drive was off"
            ),
        }
    }
}

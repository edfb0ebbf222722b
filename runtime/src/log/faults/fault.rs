//! What can be wrong with the data of a log, and the words for it.

use std::fmt;

use super::words::how_often;
use crate::log::Note;

/// Which channel of a joint is not of the time of the others.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum LateChannel {
    /// Its torque, against the position.
    Torque,
    /// Its position and what is computed from it, against all others.
    Position,
}

impl LateChannel {
    /// Name of that column of a joint, from 0.
    ///
    /// # Examples
    /// ```
    /// use robot_model::log::LateChannel;
    /// assert_eq!(LateChannel::Torque.column(2), "tau3");
    /// ```
    #[must_use]
    pub fn column(self, joint: usize) -> String {
        let name = match self {
            Self::Torque => "tau",
            Self::Position => "q",
        };
        format!("{name}{}", joint + 1)
    }

    const fn kind(self) -> &'static str {
        match self {
            Self::Torque => "late-torque",
            Self::Position => "late-position",
        }
    }
}

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
    /// An angle that begins its turn again; whole turns were taken out.
    Wrapped {
        /// Name of the channel.
        channel: String,
        /// How often.
        times: usize,
        /// Time of the first, s.
        first: f64,
    },
    /// A position that jumps and stays; the log has a hole there, and positions behind it were moved back by the jump.
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
    /// A channel of a joint that is not of the time of the others, as an identification tells it; no log is mended of it.
    Late {
        /// Which one.
        late: LateChannel,
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
    /// A joint whose position moves by no more than its noise; its mean stands for it.
    AtRest {
        /// Name of the channel.
        channel: String,
        /// Root mean square of what it differs from its mean by, rad or m.
        rms: f64,
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
#[non_exhaustive]
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
        let [plural, in_all, at_most] = match (times, samples) {
            (1, 1) => ["", "", ""],
            (1, _) => ["s", "", ""],
            _ => ["s", " in all", " at most"],
        };
        write!(
            f,
            "{}, {samples} sample{plural}{in_all}, {longest:.3} s{at_most}; they were replaced by interpolation, and nothing is fitted around \
             those of more than 10 ms",
            how_often(*times, *first)
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
    ///
    /// # Examples
    /// ```
    /// use robot_model::log::Log;
    /// let time: Vec<f64> = (0..1000).map(|k| 0.001 * f64::from(k)).collect();
    /// let q = time.iter().map(|t| (6.0 * t).sin()).collect();
    /// let mut tau: Vec<f64> = time.iter().map(|t| (6.0 * t).cos()).collect();
    /// tau[300] = 50.0; // a spike
    /// let mended = Log::from_samples("a plant", time, vec![q], vec![tau])?.mended();
    /// // Reading a log tells what time was like, and no more.
    /// assert!(!mended.faults[0].is_in_report() && mended.log.report.is_empty());
    /// # Ok::<(), robot_model::log::LogError>(())
    /// ```
    #[must_use]
    pub const fn is_in_report(&self) -> bool {
        matches!(
            self,
            Self::Coincident { .. } | Self::Jitter { .. } | Self::Gaps { .. }
        )
    }

    /// Kebab-case name of its kind.
    ///
    /// # Examples
    /// ```
    /// use robot_model::log::Log;
    /// let time: Vec<f64> = (0..1000).map(|k| 0.001 * f64::from(k)).collect();
    /// let q = time.iter().map(|t| (6.0 * t).sin()).collect();
    /// let mut tau: Vec<f64> = time.iter().map(|t| (6.0 * t).cos()).collect();
    /// tau[300] = 50.0;
    /// let mended = Log::from_samples("a plant", time, vec![q], vec![tau])?.mended();
    /// let fault = &mended.faults[0];
    /// assert_eq!((fault.kind(), fault.channel(), fault.is_in_report()), ("spikes", "tau1", false));
    /// # Ok::<(), robot_model::log::LogError>(())
    /// ```
    #[must_use]
    pub const fn kind(&self) -> &'static str {
        match self {
            Self::Spikes { .. } => "spikes",
            Self::Held { .. } => "held",
            Self::Dropouts { .. } => "dropouts",
            Self::Bursts { .. } => "bursts",
            Self::Wrapped { .. } => "wrapped",
            Self::Slips { .. } => "slips",
            Self::Coincident { .. } => "coincident",
            Self::Jitter { .. } => "jitter",
            Self::Gaps { .. } => "gaps",
            Self::Clipped { .. } => "clipped",
            Self::VelocityLate { .. } => "velocity-late",
            Self::Late { late, .. } => late.kind(),
            Self::VelocityScale { .. } => "velocity-scale",
            Self::Still { .. } => "still",
            Self::AtRest { .. } => "at-rest",
            Self::Constant { .. } => "constant",
        }
    }

    /// Name of the channel that has it; `time` where that is all of them.
    ///
    /// # Examples
    /// ```
    /// use robot_model::log::Log;
    /// let time: Vec<f64> = (0..1000).map(|k| 0.001 * f64::from(k)).collect();
    /// let q = time.iter().map(|t| (6.0 * t).sin()).collect();
    /// let mut tau: Vec<f64> = time.iter().map(|t| (6.0 * t).cos()).collect();
    /// tau[300] = 50.0; // a spike
    /// let mended = Log::from_samples("a plant", time, vec![q], vec![tau])?.mended();
    /// assert_eq!(mended.faults[0].channel(), "tau1");
    /// # Ok::<(), robot_model::log::LogError>(())
    /// ```
    #[must_use]
    pub fn channel(&self) -> &str {
        match self {
            Self::Spikes { channel, .. }
            | Self::Held { channel, .. }
            | Self::Dropouts { channel, .. }
            | Self::Bursts { channel, .. }
            | Self::Wrapped { channel, .. }
            | Self::Slips { channel, .. }
            | Self::Clipped { channel, .. }
            | Self::VelocityLate { channel, .. }
            | Self::Late { channel, .. }
            | Self::VelocityScale { channel, .. }
            | Self::Still { channel }
            | Self::AtRest { channel, .. }
            | Self::Constant { channel, .. } => channel,
            Self::Coincident { .. } | Self::Jitter { .. } | Self::Gaps { .. } => "time",
        }
    }
}

//! Faults of the data themselves: what a sensor or a recorder did, not the arm.
//!
//! In: a [`Log`]. Out: the log without what can be mended, and a list of what was found. Spikes and holds are replaced by straight lines;
//! around longer holds the log has a [hole](Log::holes), of which no row of identification knows. Velocities are compared with the slopes
//! of positions and used for nothing; a torque that stands at its limit is told, and [where](Log::clipped). The thresholds are wide, so that sound logs have
//! hardly any.

mod clipped;
mod held;
mod spikes;
mod velocity;

use std::fmt;
use std::ops::Range;

use super::Log;

/// Holds up to this long are bridged, s: a tenth of the fastest period that identification keeps as a rule. Longer ones are holes.
const BRIDGED_S: f64 = 0.01;

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
        /// How often.
        times: usize,
        /// How many samples.
        samples: usize,
        /// Time of the first, s.
        first: f64,
        /// The longest, s.
        longest: f64,
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

impl Fault {
    /// Kebab-case name of its kind.
    #[must_use]
    pub const fn kind(&self) -> &'static str {
        match self {
            Self::Spikes { .. } => "spikes",
            Self::Held { .. } => "held",
            Self::Clipped { .. } => "clipped",
            Self::VelocityLate { .. } => "velocity-late",
            Self::TorqueLate { .. } => "late-torque",
            Self::VelocityScale { .. } => "velocity-scale",
            Self::Still { .. } => "still",
            Self::Constant { .. } => "constant",
        }
    }

    /// Name of the channel that has it.
    #[must_use]
    pub fn channel(&self) -> &str {
        match self {
            Self::Spikes { channel, .. }
            | Self::Held { channel, .. }
            | Self::Clipped { channel, .. }
            | Self::VelocityLate { channel, .. }
            | Self::TorqueLate { channel, .. }
            | Self::VelocityScale { channel, .. }
            | Self::Still { channel }
            | Self::Constant { channel, .. } => channel,
        }
    }
}

/// A log after its faults were looked for.
#[derive(Debug, Clone, PartialEq)]
pub struct Mended {
    /// The log, with [`Log::holes`].
    pub log: Log,
    /// What was found, channel by channel.
    pub faults: Vec<Fault>,
}

impl Log {
    /// Looks for faults of the data, and mends what can be.
    ///
    /// # Examples
    /// ```
    /// use robot_model::log::{Fault, Log};
    /// let time: Vec<f64> = (0..1000).map(|k| 0.001 * f64::from(k)).collect();
    /// let q: Vec<f64> = time.iter().map(|t| (6.0 * t).sin()).collect();
    /// let mut tau: Vec<f64> = time.iter().map(|t| (6.0 * t).cos()).collect();
    /// tau[300] = 50.0;
    /// let mended = Log::from_samples("a plant", time, vec![q], vec![tau])?.mended();
    /// assert!(matches!(&mended.faults[..], [Fault::Spikes { samples: 1, .. }]));
    /// assert!((mended.log.tau[0][300] - 1.8_f64.cos()).abs() < 1e-3);
    /// # Ok::<(), robot_model::log::LogError>(())
    /// ```
    #[must_use]
    pub fn mended(mut self) -> Mended {
        let mut faults = Vec::new();
        let bridged = (BRIDGED_S * self.rate_hz()).max(1.0);
        let (start, step) = (self.time[0], 1.0 / self.rate_hz());
        let after = |sample: usize| step * sample as f64;
        for joint in 0..self.dof() {
            for family in ["q", "tau"] {
                let is_position = family == "q";
                let channel = format!("{family}{}", joint + 1);
                let mut values = std::mem::take(if is_position {
                    &mut self.q[joint]
                } else {
                    &mut self.tau[joint]
                });
                let found = spikes::find(&values);
                if let Some(first) = found.first() {
                    faults.push(Fault::Spikes {
                        channel: channel.clone(),
                        samples: found.iter().map(Range::len).sum(),
                        first: start + after(first.start),
                    });
                }
                for range in found {
                    bridge(&mut values, range);
                }
                let found = if is_position {
                    held::of_position(&values)
                } else {
                    held::of_torque(&values, &self.q[joint])
                };
                if let Some(first) = found.first() {
                    let longest = found.iter().map(Range::len).max().unwrap_or(0);
                    faults.push(Fault::Held {
                        channel,
                        times: found.len(),
                        samples: found.iter().map(Range::len).sum(),
                        first: start + after(first.start),
                        longest: after(longest),
                    });
                }
                for range in found {
                    if range.len() as f64 > bridged {
                        self.holes.push(after(range.start)..after(range.end));
                    }
                    bridge(&mut values, range);
                }
                if is_position {
                    self.q[joint] = values;
                } else {
                    self.tau[joint] = values;
                }
            }
        }
        faults.extend(self.standing());
        let clipped = clipped::find(&self);
        faults.extend(clipped.faults);
        let in_seconds = |samples: &Range<usize>| after(samples.start)..after(samples.end - 1);
        let spans = clipped.spans.iter();
        self.clipped = spans
            .map(|spans| spans.iter().map(in_seconds).collect())
            .collect();
        faults.extend(velocity::find(&self));
        Mended { log: self, faults }
    }

    /// Channels that say the same at all times.
    fn standing(&self) -> impl Iterator<Item = Fault> {
        let is_constant =
            |values: &[f64]| values.iter().all(|value| (value - values[0]).abs() == 0.0);
        let still = self
            .q
            .iter()
            .enumerate()
            .filter(move |(_, q)| is_constant(q));
        let dead = self.tau.iter().enumerate();
        let dead = dead.filter(move |(_, tau)| is_constant(tau));
        still
            .map(|(joint, _)| Fault::Still {
                channel: format!("q{}", joint + 1),
            })
            .chain(dead.map(|(joint, tau)| Fault::Constant {
                channel: format!("tau{}", joint + 1),
                value: tau[0],
            }))
    }
}

/// A straight line from the sample before to that behind.
fn bridge(values: &mut [f64], range: Range<usize>) {
    let before = range.start.checked_sub(1).map(|k| values[k]);
    let behind = values.get(range.end).copied();
    let (Some(low), Some(high)) = (before.or(behind), behind.or(before)) else {
        return;
    };
    let steps = (range.len() + 1) as f64;
    for (k, value) in values[range].iter_mut().enumerate() {
        *value = low + (high - low) * (k + 1) as f64 / steps;
    }
}

/// The value that so large a share of others is below.
fn quantile(mut values: Vec<f64>, share: f64) -> f64 {
    if values.is_empty() {
        return 0.0;
    }
    let place = (share * (values.len() - 1) as f64).round();
    let place = crate::signal::resample::whole_steps(place);
    *values.select_nth_unstable_by(place, f64::total_cmp).1
}

/// Sizes of the steps from sample to sample.
fn steps(values: &[f64]) -> Vec<f64> {
    let pairs = values.windows(2);
    pairs.map(|pair| (pair[1] - pair[0]).abs()).collect()
}

/// Those that are not zero.
fn moved(values: &[f64]) -> Vec<f64> {
    values
        .iter()
        .copied()
        .filter(|value| *value > 0.0)
        .collect()
}

/// What the sensor resolves: one of the smallest steps that are not zero, as rounding makes smaller ones here and there.
fn quantum(steps: &[f64]) -> f64 {
    quantile(moved(steps), 0.1)
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
            Self::Held {
                channel,
                times,
                samples,
                first,
                longest,
            } => write!(
                f,
                "{channel} stands still {times} times while the arm moves on, {samples} samples in all, {longest:.3} s at most, the first at \
                 {first:.3} s; they were replaced by straight lines, and nothing is fitted around those of more than 10 ms"
            ),
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

#[cfg(test)]
mod tests;

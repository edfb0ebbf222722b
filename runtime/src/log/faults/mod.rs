//! Faults of the data themselves: what a sensor or a recorder did, not the arm.
//!
//! In: a [`Log`]. Out: the log without what can be mended, and a list of what was found. Spikes, dropouts, bursts and holds are replaced by
//! straight lines; around longer ones, and where a position jumps and stays, the log has a [hole](Log::holes), of which no row of
//! identification knows. What such a jump adds to all that follows is taken out, as no arm jumps, and so are whole turns. Velocities are
//! compared with the slopes of positions and used for nothing; a torque that stands at its limit is told, and [where](Log::clipped). The
//! thresholds are wide, so that sound logs have hardly any.

mod bursts;
mod clipped;
mod dropouts;
mod fault;
mod held;
mod pushes;
mod resting;
mod reversals;
mod slips;
mod spikes;
mod velocity;
mod words;
mod wraps;

use std::ops::Range;

pub use fault::{Fault, LateChannel, Stretches};

use super::Log;
use crate::signal::encoder_step;

/// What is replaced up to this long is bridged, s: a tenth of the fastest period that identification keeps as a rule. Longer ones are holes.
pub(super) const BRIDGED_S: f64 = 0.01;

/// Samples and steps beyond this share are faults' own, where there are any; a step is steep beyond so many times what others are below.
const FEW: f64 = 0.9;
const STEEP: f64 = 8.0;

/// One of the smallest: rounding makes smaller ones here and there.
const FEWEST: f64 = 0.1;

/// A log after its faults were looked for.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
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
        let mut faults: Vec<Fault> = self.report.iter().filter_map(Fault::of_note).collect();
        for joint in 0..self.dof() {
            let mut q = std::mem::take(&mut self.q[joint]);
            faults.extend(self.mend_position(joint, &mut q));
            self.q[joint] = q;
            let mut tau = std::mem::take(&mut self.tau[joint]);
            faults.extend(self.mend_torque(joint, &mut tau));
            self.tau[joint] = tau;
        }
        faults.extend(self.standing());
        faults.extend(self.at_rest());
        let clipped = clipped::find(&self);
        faults.extend(clipped.faults);
        let step = 1.0 / self.rate_hz();
        let after = |sample: usize| step * sample as f64;
        let in_seconds = |samples: &Range<usize>| after(samples.start)..after(samples.end - 1);
        let spans = clipped.spans.iter();
        self.clipped = spans
            .map(|spans| spans.iter().map(in_seconds).collect())
            .collect();
        faults.extend(velocity::find(&self));
        Mended { log: self, faults }
    }

    /// A position without what was found in it.
    ///
    /// The order matters: what jumps away and back has two steps of a slip, and holds come before slips. A position that is updated slower than
    /// the log stands for some samples and then steps by what the joint moved in all of them; where it mostly rests slips alone would take each
    /// such step for a jump that stays, and once holds are bridged they are slopes. Yet where it is slow holds are none and its steps stay,
    /// steep beside those slopes: so a slip has to be one before holds are bridged, too.
    fn mend_position(&mut self, joint: usize, q: &mut [f64]) -> Vec<Fault> {
        let channel = || format!("q{}", joint + 1);
        let wraps = wraps::take_out(q);
        let wraps = wraps.first().map(|&first| Fault::Wrapped {
            channel: channel(),
            times: wraps.len(),
            first: self.time[first + 1],
        });
        let at = self.cut_out(q, dropouts::of_position(q));
        let dropouts = at.map(|at| Fault::Dropouts {
            channel: channel(),
            at,
        });
        let at = self.cut_out(q, bursts::find(q, self.rate_hz()));
        let bursts = at.map(|at| Fault::Bursts {
            channel: channel(),
            at,
        });
        let spikes = self.replace_spikes(q, spikes::find(q), channel());
        let jumps = slips::find(q);
        let at = self.cut_out(q, held::of_position(q));
        let held = at.map(|at| Fault::Held {
            channel: channel(),
            at,
        });
        let mut slips = slips::find(q);
        slips.retain(|slip| jumps.binary_search(slip).is_ok());
        let slips = self.close_slips(q, &slips, channel());
        let found = [wraps, dropouts, bursts, spikes, held, slips];
        found.into_iter().flatten().collect()
    }

    /// A torque without what was found in it.
    fn mend_torque(&mut self, joint: usize, tau: &mut [f64]) -> Vec<Fault> {
        if has_few_levels(tau, LEVELS) {
            return Vec::new();
        }
        let channel = || format!("tau{}", joint + 1);
        let faulty = |log: &Self, tau: &[f64], found| {
            let found = pushes::without(found, &log.q);
            reversals::without(found, tau, &log.q[joint], log.rate_hz())
        };
        let found = dropouts::of_torque(tau, &self.q[joint], self.rate_hz());
        let at = self.cut_out(tau, pushes::without(found, &self.q));
        let dropouts = at.map(|at| Fault::Dropouts {
            channel: channel(),
            at,
        });
        let found = faulty(self, tau, bursts::find(tau, self.rate_hz()));
        let at = self.cut_out(tau, found);
        let bursts = at.map(|at| Fault::Bursts {
            channel: channel(),
            at,
        });
        let found = faulty(self, tau, spikes::find(tau));
        let spikes = self.replace_spikes(tau, found, channel());
        let at = self.cut_out(tau, held::of_torque(tau, &self.q[joint]));
        let held = at.map(|at| Fault::Held {
            channel: channel(),
            at,
        });
        let found = [dropouts, bursts, spikes, held];
        found.into_iter().flatten().collect()
    }

    fn replace_spikes(
        &self,
        values: &mut [f64],
        found: Vec<Range<usize>>,
        channel: String,
    ) -> Option<Fault> {
        let first = found.first()?.start;
        let samples = found.iter().map(Range::len).sum();
        for range in found {
            bridge(values, range);
        }
        Some(Fault::Spikes {
            channel,
            samples,
            first: self.time[first],
        })
    }

    /// Holes over jumps that stay, and what follows moved back by them: filters would carry a jump far beyond its hole.
    fn close_slips(
        &mut self,
        values: &mut [f64],
        found: &[usize],
        channel: String,
    ) -> Option<Fault> {
        let first = *found.first()?;
        // The joint moves on meanwhile.
        let jump = |k: usize| {
            let step = |k: usize| values[k + 1] - values[k];
            step(k) - 0.5 * (step(k - 1) + step(k + 1))
        };
        let jumps: Vec<f64> = found.iter().map(|&k| jump(k)).collect();
        let larger = |a: &f64, b: &f64| a.abs().total_cmp(&b.abs());
        let largest = jumps.iter().copied().max_by(larger)?;
        let after = |sample: usize| sample as f64 / self.rate_hz();
        let holes: Vec<Range<f64>> = found.iter().map(|&k| after(k)..after(k + 1)).collect();
        self.holes.extend(holes);
        for (&k, jump) in found.iter().zip(jumps) {
            values[k + 1..].iter_mut().for_each(|value| *value -= jump);
        }
        Some(Fault::Slips {
            channel,
            times: found.len(),
            first: self.time[first + 1],
            largest,
        })
    }

    /// Straight lines in place of ranges, and holes where they are long; says how much that was, where there are any.
    fn cut_out(&mut self, values: &mut [f64], ranges: Vec<Range<usize>>) -> Option<Stretches> {
        let rate_hz = self.rate_hz();
        let bridged = (BRIDGED_S * rate_hz).max(1.0);
        let after = |sample: usize| sample as f64 / rate_hz;
        let at = Stretches {
            times: ranges.len(),
            samples: ranges.iter().map(Range::len).sum(),
            first: self.time[ranges.first()?.start],
            longest: after(ranges.iter().map(Range::len).max()?),
        };
        for range in ranges {
            if range.len() as f64 > bridged {
                self.holes.push(after(range.start)..after(range.end));
            }
            bridge(values, range);
        }
        Some(at)
    }

    /// Means in place of positions that are noise about them.
    fn at_rest(&mut self) -> Vec<Fault> {
        let rate_hz = self.rate_hz();
        let joints = self.q.iter_mut().enumerate();
        let found = joints.filter_map(|(joint, q)| {
            let noise = resting::noise(q, rate_hz)?;
            q.fill(noise.mean);
            Some(Fault::AtRest {
                channel: format!("q{}", joint + 1),
                rms: noise.rms,
            })
        });
        found.collect()
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

/// Most values of a torque that is a command of a few levels, as a square wave or a random binary one: what stands and jumps there is no fault.
const LEVELS: usize = 16;

/// Values that differ by this share of the largest are one value, written by a program that computed it.
const SAME: f64 = 1e-9;

/// Whether a channel has no more than so many values.
fn has_few_levels(values: &[f64], most: usize) -> bool {
    let largest = values
        .iter()
        .fold(0.0, |most: f64, value| most.max(value.abs()));
    let mut levels: Vec<f64> = Vec::new();
    values.iter().all(|value| {
        let is_old = |level: &f64| (level - value).abs() <= SAME * largest;
        if !levels.iter().any(is_old) {
            levels.push(*value);
        }
        levels.len() <= most
    })
}

/// What an encoder resolves. Where a joint moves by many steps at a time these do not say it, but how they change from one to the next does.
fn resolution(position: &[f64]) -> f64 {
    encoder_step(position).unwrap_or_else(|| {
        let bends = position
            .windows(3)
            .map(|p| (p[2] - 2.0 * p[1] + p[0]).abs());
        quantile(moved(&bends.collect::<Vec<_>>()), FEWEST)
    })
}

/// Those that are not zero.
fn moved(values: &[f64]) -> Vec<f64> {
    values
        .iter()
        .copied()
        .filter(|value| *value > 0.0)
        .collect()
}

/// Steps from sample to sample of a channel and what all of them say, taken once: it is asked for at every place where something may be.
struct Steps {
    /// Their sizes.
    sizes: Vec<f64>,
    /// What the sensor resolves: one of the smallest that are not zero, as rounding makes smaller ones here and there.
    quantum: f64,
    /// The middle one of those that are not zero.
    typical: f64,
    /// What all but a few of these are below.
    usual: f64,
    /// The smallest and the largest value of the channel.
    least: f64,
    most: f64,
}

impl Steps {
    fn of(values: &[f64]) -> Self {
        let pairs = values.windows(2);
        let sizes: Vec<f64> = pairs.map(|pair| (pair[1] - pair[0]).abs()).collect();
        let moved = moved(&sizes);
        Self {
            quantum: quantile(moved.clone(), 0.1),
            typical: quantile(moved.clone(), 0.5),
            usual: quantile(moved, FEW),
            least: values.iter().copied().fold(f64::INFINITY, f64::min),
            most: values.iter().copied().fold(f64::NEG_INFINITY, f64::max),
            sizes,
        }
    }

    /// Whether that is the largest or the smallest value of all.
    fn is_limit(&self, value: f64) -> bool {
        value >= self.most || value <= self.least
    }

    /// From here on a step is none of the arm's own.
    fn steep(&self) -> f64 {
        STEEP * self.usual.max(self.quantum)
    }
}

#[cfg(test)]
mod tests;

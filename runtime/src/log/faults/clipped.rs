//! Torques that stand at a limit.

use std::ops::Range;

use super::{FEW, Fault, LEVELS, Steps, has_few_levels, moved, quantile};
use crate::log::Log;

/// Fewest samples in a row, and share of the log, that stand at a limit.
const IN_A_ROW: usize = 5;
const SHARE: f64 = 0.002;

/// A limit is beyond this share of the largest torque on its side, which is beyond it where filters ring.
const NEAR: f64 = 0.95;

/// Values that differ by less than this share of the range are one.
const ALIKE: f64 = 1e-9;

/// So many times more samples stand at a limit than at the next value: a coarse torque stands at the top of its waves, too.
const PILE: usize = 6;

/// A measured limit is noisy: it is where steps are quiet, below this share of what nine of ten are below, while the joint moves by no less than this
/// share of its typical step. It is as wide as so many times what nine of ten quiet samples are within, and no wider than this share of the range.
const QUIET: f64 = 0.1;
const MOVES: f64 = 0.2;
const WIDE: f64 = 3.0;
const WIDEST: f64 = 0.05;

/// What was found.
#[derive(Default)]
pub(super) struct Found {
    pub faults: Vec<Fault>,
    /// Samples at a limit, `[joint]`.
    pub spans: Vec<Vec<Range<usize>>>,
}

/// Where a torque stands, and how wide that is to either side.
struct Limit {
    value: f64,
    width: f64,
    samples: usize,
}

impl Limit {
    fn has(&self, value: f64) -> bool {
        (value - self.value).abs() <= self.width
    }
}

pub(super) fn find(log: &Log) -> Found {
    let mut found = Found::default();
    for (joint, tau) in log.tau.iter().enumerate() {
        let high = tau.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        let low = tau.iter().copied().fold(f64::INFINITY, f64::min);
        let range = high - low;
        // A torque that has one sign has a limit on that side alone.
        let ends = [high.max(0.0), low.min(0.0)].into_iter();
        let ends = ends.filter(|end| *end != 0.0 && range > 0.0 && !has_few_levels(tau, LEVELS));
        let limits = ends.filter_map(|end| {
            let exact = standing(tau, end, ALIKE * range);
            exact.or_else(|| plateau(tau, &log.q[joint], end, range))
        });
        let limits: Vec<Limit> = limits.collect();
        let samples: usize = limits.iter().map(|limit| limit.samples).sum();
        let share = samples as f64 / tau.len() as f64;
        let most = limits.iter().max_by_key(|limit| limit.samples);
        let Some(&Limit { value, .. }) = most.filter(|_| share > SHARE) else {
            found.spans.push(Vec::new());
            continue;
        };
        let is_at_limit = |value: &f64| limits.iter().any(|limit| limit.has(*value));
        found.spans.push(runs(tau, is_at_limit));
        found.faults.push(Fault::Clipped {
            channel: format!("tau{}", joint + 1),
            value,
            share,
        });
    }
    found
}

/// Ranges of samples for which that is so.
fn runs(values: &[f64], is_so: impl Fn(&f64) -> bool) -> Vec<Range<usize>> {
    let mut runs: Vec<Range<usize>> = Vec::new();
    for (k, _) in values.iter().enumerate().filter(|(_, value)| is_so(value)) {
        match runs.last_mut() {
            Some(last) if last.end == k => last.end = k + 1,
            _ => runs.push(k..k + 1),
        }
    }
    runs
}

/// Where a torque stands towards one of its ends, and for how many samples; rest without torque is no limit.
fn standing(tau: &[f64], end: f64, alike: f64) -> Option<Limit> {
    let is_near = |value: f64| value * end.signum() > NEAR * end.abs();
    let runs = tau.chunk_by(|x, y| (x - y).abs() <= alike);
    let longest = runs
        .filter(|run| run.len() >= IN_A_ROW && is_near(run[0]))
        .max_by_key(|run| run.len())?;
    let limit = longest[0];
    let at = |level: f64| {
        tau.iter()
            .filter(|value| (*value - level).abs() <= alike)
            .count()
    };
    // The value next to the limit on the side of zero.
    let below = tau.iter().copied().filter(|value| {
        let inside = (limit - value) * end.signum();
        inside > alike
    });
    let next = below.min_by(|x, y| (limit - x).abs().total_cmp(&(limit - y).abs()))?;
    let samples = at(limit);
    (samples > PILE * at(next)).then_some(Limit {
        value: limit,
        width: alike,
        samples,
    })
}

/// Where a torque stands towards one of its ends but for noise, which is far below its own changes elsewhere. The top of a wave has no more
/// than two and a half times as many samples as what is next to it, a torque that holds a joint at rest is no limit, and one that is as noisy
/// as elsewhere may be the arm's own.
fn plateau(tau: &[f64], position: &[f64], end: f64, range: f64) -> Option<Limit> {
    let (steps, travels) = (Steps::of(tau), Steps::of(position));
    let is_near = |k: usize| tau[k] * end.signum() > NEAR * end.abs();
    let is_quiet = |k: usize| is_near(k) && steps.sizes[k] < QUIET * steps.usual;
    let samples: Vec<usize> = (0..steps.sizes.len()).collect();
    let quiet = samples.chunk_by(|a, b| is_quiet(*a) == is_quiet(*b));
    let quiet = quiet.filter(|run| {
        let (first, last) = (run[0], run[run.len() - 1]);
        let way = (position[last + 1] - position[first]).abs();
        run.len() >= IN_A_ROW && is_quiet(first) && way > MOVES * travels.typical * run.len() as f64
    });
    let quiet: Vec<f64> = quiet.flatten().map(|k| tau[*k]).collect();
    if quiet.len() as f64 <= SHARE * tau.len() as f64 {
        return None;
    }
    let value = quantile(quiet.clone(), 0.5);
    let off: Vec<f64> = quiet.iter().map(|x| (x - value).abs()).collect();
    let width = WIDE * quantile(moved(&off), FEW);
    let within = |low: f64, high: f64| {
        let inside = tau.iter().map(|x| (value - x) * end.signum());
        inside.filter(|x| *x > low && *x <= high).count()
    };
    let samples = within(-width, width);
    let is_end = PILE * within(f64::NEG_INFINITY, -width) < samples;
    let is_pile = PILE * within(width, 3.0 * width) < samples;
    (width > 0.0 && width < WIDEST * range && is_end && is_pile).then_some(Limit {
        value,
        width,
        samples,
    })
}

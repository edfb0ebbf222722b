//! Torques that stand at a limit.

use std::ops::Range;

use super::Fault;
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

/// What was found.
#[derive(Default)]
pub(super) struct Found {
    pub faults: Vec<Fault>,
    /// Samples at a limit, `[joint]`.
    pub spans: Vec<Vec<Range<usize>>>,
}

pub(super) fn find(log: &Log) -> Found {
    let mut found = Found::default();
    for (joint, tau) in log.tau.iter().enumerate() {
        let high = tau.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        let low = tau.iter().copied().fold(f64::INFINITY, f64::min);
        let alike = ALIKE * (high - low);
        let ends = [high, low].into_iter().filter(|_| high > low);
        let limits = ends.filter_map(|end| standing(tau, end, alike));
        let limits: Vec<(f64, usize)> = limits.collect();
        let samples: usize = limits.iter().map(|(_, samples)| samples).sum();
        let share = samples as f64 / tau.len() as f64;
        let most = limits.iter().max_by_key(|(_, samples)| *samples);
        let Some(&(value, _)) = most.filter(|_| share > SHARE) else {
            found.spans.push(Vec::new());
            continue;
        };
        let is_at_limit = |value: &f64| {
            let mut limits = limits.iter();
            limits.any(|(limit, _)| (value - limit).abs() <= alike)
        };
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
fn standing(tau: &[f64], end: f64, alike: f64) -> Option<(f64, usize)> {
    if end == 0.0 {
        return None;
    }
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
    (samples > PILE * at(next)).then_some((limit, samples))
}

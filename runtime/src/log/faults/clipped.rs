//! Torques that stand at a limit.

use super::{Fault, quantum, steps};
use crate::log::Log;

/// Fewest samples in a row, and share of the log, that stand at a limit.
const IN_A_ROW: usize = 5;
const SHARE: f64 = 0.002;

/// A sensor that resolves no more than this share of its range stands at its largest value now and then.
const COARSE: f64 = 0.02;

pub(super) fn find(log: &Log) -> impl Iterator<Item = Fault> {
    let channels = log.tau.iter().enumerate();
    channels.filter_map(|(joint, tau)| {
        let high = tau.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        let low = tau.iter().copied().fold(f64::INFINITY, f64::min);
        if high <= low || quantum(&steps(tau)) > COARSE * (high - low) {
            return None;
        }
        let standing = |limit: f64| -> usize {
            let runs = tau
                .split(|value| (value - limit).abs() > 0.0)
                .map(<[f64]>::len);
            runs.filter(|run| *run >= IN_A_ROW).sum()
        };
        // Rest without torque is no limit.
        let ends = [high, low].into_iter().filter(|limit| *limit != 0.0);
        let (value, samples) = ends
            .map(|limit| (limit, standing(limit)))
            .max_by_key(|(_, samples)| *samples)?;
        let share = samples as f64 / tau.len() as f64;
        (share > SHARE).then(|| Fault::Clipped {
            channel: format!("tau{}", joint + 1),
            value,
            share,
        })
    })
}

//! Positions that look like torques, and torques that look like positions.

use super::{Log, Note};
use crate::signal::white_noise;

/// An arm moves smoothly: white noise of this share of a position's deviation is no encoder's, which have some thousands of steps or more.
const ROUGH: f64 = 2e-3;

/// Torques are the positions where their noise is smaller by this factor.
const SMOOTHER: f64 = 0.1;

/// That all positions of a log are rough and all its torques are not.
pub(super) fn note(log: &Log) -> Option<Note> {
    let roughness = |values: &[f64]| {
        let count = values.len() as f64;
        let mean = values.iter().sum::<f64>() / count;
        let power = values
            .iter()
            .map(|value| (value - mean).powi(2))
            .sum::<f64>()
            / count;
        white_noise(values) / power.sqrt()
    };
    // What stands still has no roughness.
    let of = |channels: &[Vec<f64>]| -> Vec<f64> {
        let all = channels.iter().map(|values| roughness(values));
        all.filter(|share| share.is_finite()).collect()
    };
    let [q, tau] = [of(&log.q), of(&log.tau)];
    let smoothest = q.iter().copied().fold(f64::INFINITY, f64::min);
    let roughest = tau.iter().copied().fold(0.0, f64::max);
    let is_exchanged = smoothest.is_finite()
        && smoothest > ROUGH
        && !tau.is_empty()
        && roughest < SMOOTHER * smoothest;
    is_exchanged.then_some(Note::Exchanged)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn smooth_torques_beside_rough_positions_are_told() {
        let time: Vec<f64> = (0..1000).map(|k| 0.002 * f64::from(k)).collect();
        let smooth: Vec<f64> = time.iter().map(|t| (3.0 * t).sin()).collect();
        let noise = |k: usize| 0.02 * (7919.0 * k as f64).sin();
        let rough: Vec<f64> = (0..1000).map(|k| 9.0 * (smooth[k] + noise(k))).collect();
        let log = |q: &[f64], tau: &[f64]| {
            let read =
                Log::from_samples("a log", time.clone(), vec![q.to_vec()], vec![tau.to_vec()]);
            read.expect("it is sound").report
        };
        assert_eq!(log(&smooth, &rough), []);
        assert_eq!(log(&rough, &smooth), [Note::Exchanged]);
        // An arm that stands still, and torques without noise.
        assert_eq!(log(&vec![0.1; 1000], &smooth), []);
        assert_eq!(log(&smooth, &smooth), []);
    }
}

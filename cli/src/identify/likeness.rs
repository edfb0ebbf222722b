//! Instruments of another motion than the log's.

use std::path::PathBuf;

use robot_model::log::Log;
use robot_model::simulate::Trajectory;
use robot_model_spec::Model;

/// Least correlation of positions of one motion: a controller that follows badly leaves more.
const ALIKE: f64 = 0.9;

/// Mean square of positions, rad^2 or m^2, below which a joint stands.
const STILL: f64 = 1e-18;

/// Sentences about motions that hardly resemble the log that they are given for.
pub(super) fn doubts<'a>(
    model: &Model,
    logs: &[Log],
    motions: impl Iterator<Item = (&'a PathBuf, &'a Trajectory)>,
) -> Vec<String> {
    let pairs = logs.iter().zip(motions);
    let told = pairs.filter_map(|(log, (path, motion))| {
        let joints = model.joints.iter().zip(correlations(log, motion));
        let apart = joints.filter(|(_, correlation)| *correlation < ALIKE);
        let apart: Vec<String> = apart
            .map(|(joint, correlation)| format!("`{}` {correlation:.2}", joint.name))
            .collect();
        (!apart.is_empty()).then(|| {
            format!(
                "{} hardly resembles the motion of {} (correlation of positions: {}): such instruments are weak and standard deviations are \
                 large; is it the motion of another log, or does it start at another time?",
                path.display(),
                log.source,
                apart.join(", ")
            )
        })
    });
    told.collect()
}

/// How positions of a log go with those of a motion from its start on, one a joint; 1 where one of both stands.
fn correlations(log: &Log, motion: &Trajectory) -> Vec<f64> {
    let start = log.time.first().copied().unwrap_or_default();
    let samples = log.time.iter().map(|time| motion.at(time - start).q);
    let wanted: Vec<Vec<f64>> = samples.collect();
    let joints = log.q.iter().enumerate();
    let one = joints.map(|(joint, q)| {
        let other: Vec<f64> = wanted.iter().map(|q| q[joint]).collect();
        correlation(q, &other)
    });
    one.collect()
}

fn correlation(one: &[f64], other: &[f64]) -> f64 {
    let mean = |values: &[f64]| values.iter().sum::<f64>() / values.len().max(1) as f64;
    let (a, b) = (mean(one), mean(other));
    let pairs = one.iter().zip(other);
    let [aa, ab, bb] = pairs.fold([0.0; 3], |[aa, ab, bb], (x, y)| {
        let (x, y) = (x - a, y - b);
        [aa + x * x, ab + x * y, bb + y * y]
    });
    let moves = |squares: f64| squares > STILL * one.len() as f64;
    if moves(aa) && moves(bb) {
        ab / (aa * bb).sqrt()
    } else {
        1.0
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_motion_goes_with_itself_and_not_with_another() {
        let wave = |rate: f64| -> Vec<f64> {
            let samples = 0..1000;
            samples
                .map(|k| (0.01 * rate * f64::from(k)).sin())
                .collect()
        };
        let near: Vec<f64> = wave(3.0).iter().map(|q| 2.0 + 0.9 * q).collect();
        assert!(correlation(&wave(3.0), &near) > 0.999);
        assert!(correlation(&wave(3.0), &wave(5.0)).abs() < 0.3);
        let rest = vec![0.4; 1000];
        assert!((correlation(&wave(3.0), &rest) - 1.0).abs() < f64::EPSILON);
    }
}

//! How a log is cut for cross-validation, so that no fold is judged by what it was fitted on.
//!
//! A motion that repeats shows every fold the same phase again, so folds of a periodic log are intervals of the phase, the
//! same in every period. Folds of other logs are blocks of time. Training keeps a gap to both sides of what is tested.

use crate::identify::Segment;
use crate::motion::Motion;
use crate::signal::resample::whole_steps;

/// Number of folds.
pub(super) const FOLDS: usize = 5;

/// Intervals of the phase per fold for periodic motions.
const INTERVALS_PER_FOLD: usize = 2;

/// Length of a block of a motion without period, s, and the least number of blocks per fold.
const BLOCK_S: f64 = 3.0;
const LEAST_BLOCKS_PER_FOLD: usize = 2;

/// Gap between training and test samples, s: several times the shared filter's memory.
const GAP_S: f64 = 0.4;

/// A motion repeats when samples a period apart differ, relative to the motion's spread, by no more than this.
const REPEAT_TOLERANCE: f64 = 0.02;

/// Shortest period that is looked for, s, and rate at which it is looked for, Hz.
const SHORTEST_PERIOD_S: f64 = 2.0;
const PERIOD_RATE_HZ: f64 = 20.0;

/// One fold: rows to judge on, rows to fit on.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Fold {
    pub(super) test: Vec<usize>,
    pub(super) train: Vec<usize>,
}

/// The period of a motion in s, where it fits at least twice into the log and all joints repeat.
pub(super) fn period(motion: &Motion, rate_hz: f64) -> Option<f64> {
    let step = whole_steps((rate_hz / PERIOD_RATE_HZ).max(1.0));
    let joints: Vec<Vec<f64>> = motion
        .wide
        .q
        .iter()
        .map(|q| q.iter().step_by(step).copied().collect())
        .collect();
    let samples = joints.first()?.len();
    let spread = |q: &Vec<f64>| {
        let mean = q.iter().sum::<f64>() / samples as f64;
        q.iter().map(|x| (x - mean).powi(2)).sum::<f64>() / samples as f64
    };
    let moving: Vec<(&Vec<f64>, f64)> = joints
        .iter()
        .map(|q| (q, spread(q)))
        .filter(|(_, s)| *s > 1e-8)
        .collect();
    let shortest = whole_steps(SHORTEST_PERIOD_S * rate_hz / step as f64).max(1);
    (shortest..=samples / 2)
        .find(|&lag| {
            !moving.is_empty()
                && moving.iter().all(|(q, spread)| {
                    let change: f64 = q[lag..]
                        .iter()
                        .zip(q.iter())
                        .map(|(a, b)| (a - b).powi(2))
                        .sum();
                    change / ((samples - lag) as f64) < 2.0 * spread * REPEAT_TOLERANCE.powi(2)
                })
        })
        .map(|lag| (lag * step) as f64 / rate_hz)
}

/// Cuts the rows of all logs into folds. `periods` has one entry a log.
pub(super) fn cut(segments: &[Segment], periods: &[Option<f64>]) -> Vec<Fold> {
    let mut number = Vec::new();
    for (segment, period) in segments.iter().zip(periods) {
        let first = segment.time.first().copied().unwrap_or(0.0);
        let length = segment
            .time
            .last()
            .map_or(0.0, |last| last - first)
            .max(f64::MIN_POSITIVE);
        let (cycle, intervals) = if let Some(period) = period {
            (*period, FOLDS * INTERVALS_PER_FOLD)
        } else {
            let blocks = whole_steps(length / (BLOCK_S * FOLDS as f64)).max(LEAST_BLOCKS_PER_FOLD);
            (length * (1.0 + 1e-9), FOLDS * blocks)
        };
        number.extend(segment.time.iter().map(|time| {
            let phase = ((time - first) / cycle).fract();
            whole_steps(phase * intervals as f64) % FOLDS
        }));
    }
    (0..FOLDS)
        .map(|fold| {
            let test: Vec<usize> = (0..number.len()).filter(|k| number[*k] == fold).collect();
            let mut near = vec![false; number.len()];
            for segment in segments {
                let rows = segment.time.len();
                let rate = if rows > 1 {
                    (rows - 1) as f64 / (segment.time[rows - 1] - segment.time[0])
                } else {
                    1.0
                };
                let gap = whole_steps(GAP_S * rate);
                for k in (segment.start..segment.start + rows).filter(|k| number[*k] == fold) {
                    let from = k.saturating_sub(gap).max(segment.start);
                    let to = (k + gap + 1).min(segment.start + rows);
                    near[from..to].fill(true);
                }
            }
            Fold {
                test,
                train: (0..number.len()).filter(|k| !near[*k]).collect(),
            }
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::motion::Kinematics;

    fn motion(f: impl Fn(f64) -> f64, seconds: f64, rate: f64) -> Motion {
        let time: Vec<f64> = (0..whole_steps(seconds * rate))
            .map(|k| k as f64 / rate)
            .collect();
        let q = vec![time.iter().map(|t| f(*t)).collect()];
        Motion {
            time,
            wide: Kinematics {
                q,
                ..Kinematics::default()
            },
            ..Motion::default()
        }
    }

    #[test]
    fn a_repeated_motion_has_its_period() {
        let found = period(
            &motion(
                |t| {
                    (std::f64::consts::TAU * t / 5.0).sin()
                        + (std::f64::consts::TAU * t / 2.5).cos()
                },
                20.0,
                500.0,
            ),
            500.0,
        );
        assert!((found.expect("it repeats") - 5.0).abs() < 0.06, "{found:?}");
    }

    #[test]
    fn a_motion_without_period_has_none() {
        assert_eq!(
            period(
                &motion(
                    |t| (1.3 * t).sin() + (t * 2.0_f64.sqrt()).cos() + 0.05 * t,
                    20.0,
                    500.0
                ),
                500.0
            ),
            None
        );
    }

    #[test]
    fn folds_of_a_periodic_log_never_share_a_phase() {
        let time: Vec<f64> = (0..1200).map(|k| 0.1 + f64::from(k) / 40.0).collect();
        let phase = |k: usize| ((time[k] - time[0]) / 10.0).fract();
        let folds = cut(
            &[Segment {
                start: 0,
                time: time.clone(),
            }],
            &[Some(10.0)],
        );
        assert_eq!(folds.iter().map(|f| f.test.len()).sum::<usize>(), 1200);
        for fold in &folds {
            for &test in &fold.test {
                let nearest = fold
                    .train
                    .iter()
                    .map(|k| (phase(*k) - phase(test)).abs())
                    .fold(f64::INFINITY, f64::min);
                assert!(
                    nearest > 0.03,
                    "a phase of the test is in the training rows: {nearest}"
                );
            }
        }
    }
}

//! How a log is cut for cross-validation, so that no fold is judged by what it was fitted on.
//!
//! A motion that repeats shows every fold the same phase again, so folds of a periodic log are intervals of the phase, the
//! same in every period. Folds of other logs are blocks of time. Training keeps a gap to both sides of what is tested.

use crate::identify::Segment;
use crate::motion::Motion;
use crate::signal::resample::whole_steps;

/// Number of folds.
pub(super) const FOLDS: usize = 5;

/// Shortest interval of the phase of which a fold has two, s; below it has one.
const INTERVAL_S: f64 = 1.0;

/// Length of a block of a motion without period, s, and the least number of blocks per fold.
const BLOCK_S: f64 = 3.0;
const LEAST_BLOCKS_PER_FOLD: usize = 2;

/// Gap between training and test samples, s: several times the shared filter's memory; and its largest share of a period,
/// so that short periods keep rows to train on.
const GAP_S: f64 = 0.4;
const GAP_SHARE: f64 = 0.08;

/// A motion repeats when samples a period apart differ, relative to the motion's spread, by no more than this.
const REPEAT_TOLERANCE: f64 = 0.02;

/// The same on the coarse grid of lags, where the lag may be off by half a step.
const COARSE_TOLERANCE: f64 = 0.3;

/// Shortest period that is looked for, s, and rate of the coarse grid of lags, Hz.
const SHORTEST_PERIOD_S: f64 = 0.5;
const COARSE_HZ: f64 = 20.0;

/// One fold: rows to judge on, rows to fit on.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Fold {
    pub(super) test: Vec<usize>,
    pub(super) train: Vec<usize>,
}

/// The shortest period of a motion in s, where it fits at least twice into the log and all joints repeat.
pub(super) fn period(motion: &Motion, rate_hz: f64) -> Option<f64> {
    let step = whole_steps((rate_hz / COARSE_HZ).max(1.0));
    let fine = Repeats::new(motion.wide.q.iter().map(Vec::clone).collect());
    let coarse = Repeats::new(
        motion
            .wide
            .q
            .iter()
            .map(|q| q.iter().step_by(step).copied().collect())
            .collect(),
    );
    let samples = coarse.joints.first()?.len();
    let shortest = whole_steps(SHORTEST_PERIOD_S * rate_hz / step as f64).max(2);
    let changes: Vec<f64> = (shortest - 1..=samples / 2 + 1)
        .map(|lag| coarse.change(lag))
        .collect();
    (1..changes.len().saturating_sub(1))
        .filter(|&k| {
            changes[k] < COARSE_TOLERANCE.powi(2)
                && changes[k] <= changes[k - 1]
                && changes[k] <= changes[k + 1]
        })
        .find_map(|k| fine.minimum((shortest - 1 + k) * step, step))
        .map(|lag| lag / rate_hz)
}

/// Positions of the joints that move, less their means, each over its spread.
struct Repeats {
    joints: Vec<Vec<f64>>,
}

impl Repeats {
    fn new(joints: Vec<Vec<f64>>) -> Self {
        let scaled = joints.into_iter().filter_map(|mut q| {
            let samples = q.len() as f64;
            let mean = q.iter().sum::<f64>() / samples;
            for x in &mut q {
                *x -= mean;
            }
            let spread = (q.iter().map(|x| x * x).sum::<f64>() / samples).sqrt();
            for x in &mut q {
                *x /= spread;
            }
            (spread > 1e-4).then_some(q)
        });
        Self {
            joints: scaled.collect(),
        }
    }

    /// Mean square of what changes over `lag` samples, of the joint where that is most: 0 for a repetition, 1 for noise.
    fn change(&self, lag: usize) -> f64 {
        let of = |q: &Vec<f64>| {
            let pairs = q.len().saturating_sub(lag);
            q.iter()
                .skip(lag)
                .zip(q)
                .map(|(a, b)| (a - b).powi(2))
                .sum::<f64>()
                / (2 * pairs.max(1)) as f64
        };
        self.joints.iter().map(of).fold(0.0, f64::max)
    }

    /// The lag within `reach` of `about` at which the motion repeats, between samples by a parabola.
    fn minimum(&self, about: usize, reach: usize) -> Option<f64> {
        let lags: Vec<usize> = (about.saturating_sub(reach).max(1)..=about + reach).collect();
        let changes: Vec<f64> = lags.iter().map(|lag| self.change(*lag)).collect();
        let k =
            (1..lags.len().saturating_sub(1)).min_by(|a, b| changes[*a].total_cmp(&changes[*b]))?;
        let (before, at, after) = (changes[k - 1], changes[k], changes[k + 1]);
        let curvature = before - 2.0 * at + after;
        let part = if curvature > 0.0 {
            (0.5 * (before - after) / curvature).clamp(-0.5, 0.5)
        } else {
            0.0
        };
        (at < REPEAT_TOLERANCE.powi(2)).then_some(lags[k] as f64 + part)
    }
}

/// Cuts the rows of all logs into folds. `periods` has one entry a log.
pub(super) fn cut(segments: &[Segment], periods: &[Option<f64>]) -> Vec<Fold> {
    // For every row the fold that it tests, and those of the instants a gap before and after it.
    let mut places: Vec<[usize; 3]> = Vec::new();
    for (segment, period) in segments.iter().zip(periods) {
        let cut = Cut::new(segment, *period);
        places.extend(
            segment
                .time
                .iter()
                .map(|time| [-cut.gap, 0.0, cut.gap].map(|shift| cut.fold(time + shift))),
        );
    }
    (0..FOLDS)
        .map(|fold| Fold {
            test: (0..places.len())
                .filter(|k| places[*k][1] == fold)
                .collect(),
            train: (0..places.len())
                .filter(|k| !places[*k].contains(&fold))
                .collect(),
        })
        .collect()
}

/// How one log is cut.
struct Cut {
    first: f64,
    /// Period of the motion, or length of the log, s.
    cycle: f64,
    intervals: usize,
    gap: f64,
}

impl Cut {
    fn new(segment: &Segment, period: Option<f64>) -> Self {
        let first = segment.time.first().copied().unwrap_or(0.0);
        let length = segment
            .time
            .last()
            .map_or(0.0, |last| last - first)
            .max(f64::MIN_POSITIVE);
        let (cycle, per_fold) = match period {
            Some(period) if period >= 2.0 * FOLDS as f64 * INTERVAL_S => (period, 2),
            Some(period) => (period, 1),
            None => (
                length,
                whole_steps(length / (BLOCK_S * FOLDS as f64)).max(LEAST_BLOCKS_PER_FOLD),
            ),
        };
        Self {
            first,
            cycle,
            intervals: FOLDS * per_fold,
            gap: GAP_S.min(GAP_SHARE * cycle),
        }
    }

    /// The fold that tests an instant. The ends of a cycle touch; those of a log without period may as well.
    fn fold(&self, time: f64) -> usize {
        // A little more than nothing: a sample on a boundary falls to the same side in every period.
        let phase = ((time - self.first) / self.cycle + 1e-9).rem_euclid(1.0);
        whole_steps(phase * self.intervals as f64) % FOLDS
    }
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
        for true_period in [0.8, 2.53, 5.0, 20.0 / 3.0, 10.0] {
            let w = std::f64::consts::TAU / true_period;
            let found = period(
                &motion(|t| (w * t).sin() + (2.0 * w * t + 1.0).cos(), 25.0, 500.0),
                500.0,
            );
            let found = found.expect("it repeats");
            assert!(
                (found - true_period).abs() < 1e-3,
                "{found} for {true_period}"
            );
        }
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
        for cycle in [0.8, 2.0, 5.0, 20.0 / 3.0, 10.0] {
            let time: Vec<f64> = (0..1200).map(|k| 0.1 + f64::from(k) / 40.0).collect();
            let phase = |k: usize| ((time[k] - time[0]) / cycle).fract();
            let segment = Segment {
                start: 0,
                time: time.clone(),
            };
            let folds = cut(&[segment], &[Some(cycle)]);
            assert_eq!(folds.iter().map(|f| f.test.len()).sum::<usize>(), 1200);
            for fold in &folds {
                assert!(
                    fold.train.len() > 400,
                    "period {cycle}: {} rows to train on",
                    fold.train.len()
                );
                for &test in &fold.test {
                    let apart = |k: &usize| {
                        let difference = (phase(*k) - phase(test)).abs();
                        difference.min(1.0 - difference)
                    };
                    let nearest = fold.train.iter().map(apart).fold(f64::INFINITY, f64::min);
                    assert!(
                        nearest > 0.02,
                        "period {cycle}: a phase of the test is trained on: {nearest}"
                    );
                }
            }
        }
    }
}

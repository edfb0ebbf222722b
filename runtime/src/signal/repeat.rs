//! Whether a motion repeats.

use super::resample::whole_steps;

/// A motion repeats when samples a period apart differ, relative to the motion's spread, by no more than this.
const REPEAT_TOLERANCE: f64 = 0.02;

/// The same on the coarse grid of lags, where the lag may be off by half a step.
const COARSE_TOLERANCE: f64 = 0.3;

/// Shortest and longest period that are looked for, s, and rate of the coarse grid of lags, Hz.
const SHORTEST_PERIOD_S: f64 = 0.5;
const LONGEST_PERIOD_S: f64 = 120.0;
const COARSE_HZ: f64 = 20.0;

/// The shortest period of positions `[joint][sample]` in s, where it fits at least twice into the log and all joints repeat.
pub(crate) fn period(q: &[Vec<f64>], rate_hz: f64) -> Option<f64> {
    let step = whole_steps((rate_hz / COARSE_HZ).max(1.0));
    let fine = Repeats::new(q.to_vec());
    let coarse = Repeats::new(
        q.iter()
            .map(|q| q.iter().step_by(step).copied().collect())
            .collect(),
    );
    let samples = coarse.joints.first()?.len();
    let lags = |seconds: f64| whole_steps(seconds * rate_hz / step as f64);
    let shortest = lags(SHORTEST_PERIOD_S).max(2);
    let longest = (samples / 2).min(lags(LONGEST_PERIOD_S));
    let changes: Vec<f64> = (shortest - 1..=longest + 1)
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

#[cfg(test)]
mod tests {
    use super::*;

    fn motion(f: impl Fn(f64) -> f64, seconds: f64, rate: f64) -> Vec<Vec<f64>> {
        let samples = 0..whole_steps(seconds * rate);
        vec![samples.map(|k| f(k as f64 / rate)).collect()]
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
}

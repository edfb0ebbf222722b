//! Stretches of a log in which a joint moves at a constant speed and all others stand.
//!
//! Positions are cut into short blocks, each with its straight line. Neighboring blocks of one slope are a stretch, which gives its
//! first and last block away, where the speed still settles. A slope that differs by what the encoder's noise makes of it does not
//! differ; a ripple inside of blocks that is smoother than noise is stick-slip.

use std::f64::consts::TAU;
use std::ops::Range;

use crate::log::Log;
use crate::signal::resample::whole_steps;
use crate::signal::white_noise;

/// Length of a block, s, and the samples that it has at least.
pub(super) const BLOCK_S: f64 = 0.05;
const BLOCK_SAMPLES: usize = 8;

/// Blocks of a stretch at least, its ends among them: 0.2 s are left.
const LEAST_BLOCKS: usize = 6;

/// A speed is constant that stays within this share of its mean; so are two speeds alike.
pub(super) const SAME: f64 = 0.05;

/// A joint stands whose speed is below this share of that of the one that moves, or that travels less than so many of its
/// encoder's steps.
const STANDS: f64 = 0.05;
const STANDING_STEPS: f64 = 2.0;

/// Steps of the encoder that a stretch has at least: fewer do not tell its speed to [`SAME`].
const LEAST_STEPS: f64 = 10.0;

/// Deviations of a slope that are noise.
const NOISE: f64 = 3.0;

/// Samples of a log over which a joint moves at a constant speed.
///
/// # Examples
/// ```
/// use robot_model::friction_curve::Stretch;
/// use robot_model::log::Log;
///
/// // 2 s at 0.5 rad/s, then ever faster.
/// let time: Vec<f64> = (0..400).map(|k| 0.01 * f64::from(k)).collect();
/// let q = time.iter().map(|t| 0.5 * t + 0.5 * (t - 2.0).max(0.0).powi(2)).collect();
/// let log = Log::from_samples("a plant", time, vec![q], vec![vec![0.0; 400]])?;
/// let found = Stretch::find(&log, 0);
/// assert_eq!(found.len(), 1);
/// assert!((found[0].speed - 0.5).abs() < 0.005 && found[0].samples.end < 215);
/// # Ok::<(), robot_model::log::LogError>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct Stretch {
    /// Samples of the log.
    pub samples: Range<usize>,
    /// Slope of the straight line through the positions, rad/s or m/s.
    pub speed: f64,
}

/// The straight line through a block's positions.
#[derive(Debug, Clone, Copy)]
struct Line {
    /// rad/s or m/s.
    slope: f64,
    /// Root mean square of what it leaves, rad or m.
    rest: f64,
}

impl Line {
    fn through(q: &[f64], step: f64) -> Self {
        let n = q.len() as f64;
        let (middle, mean) = (0.5 * (n - 1.0), q.iter().sum::<f64>() / n);
        let at = |k: usize| k as f64 - middle;
        let power = n * (n * n - 1.0) / 12.0;
        let product: f64 = q.iter().enumerate().map(|(k, q)| at(k) * (q - mean)).sum();
        let slope = product / power;
        let rest = q.iter().enumerate().map(|(k, q)| q - mean - slope * at(k));
        Self {
            slope: slope / step,
            rest: (rest.map(|r| r * r).sum::<f64>() / n).sqrt(),
        }
    }

    /// What noise of the positions does to the slope, at most.
    fn doubt(&self, samples: usize, step: f64, encoder: f64) -> f64 {
        let n = samples as f64;
        (NOISE * self.rest * (12.0 / n.powi(3)).sqrt()).max(encoder / n) / step
    }
}

/// The smallest difference of two neighboring positions that is not rounding: the step of the encoder, or less.
pub(super) fn encoder_step(q: &[f64]) -> f64 {
    let most = q.iter().fold(0.0, |most: f64, q| most.max(q.abs()));
    let steps = q.windows(2).map(|pair| (pair[1] - pair[0]).abs());
    let least = steps
        .filter(|step| *step > 1e-9 * most)
        .fold(f64::INFINITY, f64::min);
    if least.is_finite() { least } else { 0.0 }
}

impl Stretch {
    /// All of a log in which joint `joint`, from 0, moves and the others stand, in the order of time; none within its holes.
    ///
    /// # Examples
    /// ```
    /// # mod motor { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/doc/motor.rs")); }
    /// use robot_model::friction_curve::Stretch;
    /// // Six speeds, one after the other.
    /// assert_eq!(Stretch::find(&motor::runs(), 0).len(), 6);
    /// ```
    #[must_use]
    pub fn find(log: &Log, joint: usize) -> Vec<Self> {
        let step = 1.0 / log.rate_hz();
        let block = whole_steps((BLOCK_S / step).round()).max(BLOCK_SAMPLES);
        let q = &log.q[joint];
        let encoder = encoder_step(q);
        let lines = q.chunks_exact(block).map(|q| Line::through(q, step));
        let lines: Vec<Line> = lines.collect();
        let mut found = Vec::new();
        let mut start = 0;
        while start < lines.len() {
            let end = same(&lines, start, block, step, encoder);
            if end - start < LEAST_BLOCKS {
                start += 1;
                continue;
            }
            let samples = (start + 1) * block..(end - 1) * block;
            let stretch = Self {
                speed: Line::through(&q[samples.clone()], step).slope,
                samples,
            };
            let is_steady = stretch.is_told(q, encoder)
                && stretch.is_smooth(&lines[start + 1..end - 1], q, block, step, encoder);
            if is_steady && stretch.is_alone(log, joint) {
                found.push(stretch);
            }
            start = end;
        }
        found
    }

    /// Whether the encoder tells the speed.
    fn is_told(&self, q: &[f64], encoder: f64) -> bool {
        let travel = (q[self.samples.end - 1] - q[self.samples.start]).abs();
        travel > 0.0 && travel >= LEAST_STEPS * encoder
    }

    /// Whether what lines leave of the positions is the encoder's, and no motion of its own.
    fn is_smooth(&self, lines: &[Line], q: &[f64], block: usize, step: f64, encoder: f64) -> bool {
        let noise = (2.0 * white_noise(&q[self.samples.clone()])).max(0.6 * encoder);
        let rest = lines.iter().map(|line| line.rest * line.rest).sum::<f64>() / lines.len() as f64;
        let told = (rest - noise * noise).max(0.0).sqrt();
        // The slowest ripple within a block has the least speed.
        told * TAU / (block as f64 * step) <= 2.0 * SAME * self.speed.abs()
    }

    /// Whether all other joints stand, and the log is whole.
    fn is_alone(&self, log: &Log, joint: usize) -> bool {
        let seconds = self.samples.len() as f64 / log.rate_hz();
        let stands = |other: &Vec<f64>| {
            let q = &other[self.samples.clone()];
            let (low, high) = ends(q);
            let allowed = STANDS * self.speed.abs() * seconds;
            high - low <= allowed.max(STANDING_STEPS * encoder_step(q))
        };
        let time = |sample: usize| log.time[sample] - log.time[0];
        let (from, to) = (time(self.samples.start), time(self.samples.end - 1));
        let is_whole = log
            .holes
            .iter()
            .all(|hole| hole.end < from || hole.start > to);
        let mut others = (0..log.dof()).filter(|&other| other != joint);
        is_whole && others.all(|other| stands(&log.q[other]))
    }
}

/// The block behind the last one whose slope is that of the blocks from `start` on.
fn same(lines: &[Line], start: usize, block: usize, step: f64, encoder: f64) -> usize {
    let (mut low, mut high) = (f64::INFINITY, f64::NEG_INFINITY);
    let (mut sum, mut doubts) = (0.0, 0.0);
    for (k, line) in lines[start..].iter().enumerate() {
        low = low.min(line.slope);
        high = high.max(line.slope);
        sum += line.slope;
        doubts += line.doubt(block, step, encoder);
        let count = (k + 1) as f64;
        let mean = (sum / count).abs();
        let is_moving = low * high > 0.0;
        if !is_moving || high - low > 2.0 * (SAME * mean + doubts / count) {
            return start + k;
        }
    }
    lines.len()
}

/// The least and the largest value.
pub(super) fn ends(values: &[f64]) -> (f64, f64) {
    let start = (f64::INFINITY, f64::NEG_INFINITY);
    values
        .iter()
        .fold(start, |(low, high), x| (low.min(*x), high.max(*x)))
}

#[cfg(test)]
mod tests {
    use rand::SeedableRng;
    use rand_chacha::ChaCha8Rng;
    use rand_distr::{Distribution, StandardNormal};

    use super::*;

    const RATE: f64 = 500.0;

    fn log(positions: &[&dyn Fn(f64) -> f64], seconds: f64) -> Log {
        let count = whole_steps(RATE * seconds);
        let time: Vec<f64> = (0..count).map(|k| k as f64 / RATE).collect();
        let q = positions
            .iter()
            .map(|q| time.iter().map(|t| q(*t)).collect());
        let tau = vec![vec![0.0; count]; positions.len()];
        Log::from_samples("test", time.clone(), q.collect(), tau).expect("a log")
    }

    fn rounded(q: f64, step: f64) -> f64 {
        step * (q / step).round()
    }

    #[test]
    fn speeds_are_found_behind_an_encoder_and_their_ends_are_cut() {
        // 1 s each at 0.1, 1 and 4 rad/s with 0.1 s between them.
        let speed = |t: f64| {
            let speeds = [0.1, 1.0, 4.0];
            let k = whole_steps(t / 1.1).min(2);
            let share = ((t - 1.1 * k as f64 - 1.0) / 0.1).clamp(0.0, 1.0);
            let next = speeds[(k + 1).min(2)];
            speeds[k] + share * (next - speeds[k])
        };
        let mut q = vec![0.0];
        for k in 0..1700 {
            q.push(q[k] + speed(k as f64 / RATE) / RATE);
        }
        for bits in [12, 20] {
            let step = TAU / 2_f64.powi(bits);
            let at = |t: f64| rounded(q[whole_steps((t * RATE).round())], step);
            let found = Stretch::find(&log(&[&at], 3.2), 0);
            let speeds: Vec<f64> = found.iter().map(|stretch| stretch.speed).collect();
            assert_eq!(found.len(), 3, "{bits}: {speeds:?}");
            for (found, (speed, from)) in found.iter().zip([(0.1, 0.0), (1.0, 1.1), (4.0, 2.2)]) {
                assert!(
                    (found.speed / speed - 1.0).abs() < 0.02,
                    "{bits}: {speeds:?}"
                );
                let seconds = found.samples.start as f64 / RATE..found.samples.end as f64 / RATE;
                assert!(
                    seconds.start > from && seconds.end < from + 1.06,
                    "{seconds:?}"
                );
                assert!(seconds.end - seconds.start > 0.7, "{seconds:?}");
            }
        }
    }

    #[test]
    fn stick_slip_and_ramps_are_no_constant_speeds() {
        for hz in [2.0, 15.0, 60.0] {
            let slip = |t: f64| 0.2 * t + 0.2 * 0.9 * (TAU * hz * t).sin() / (TAU * hz);
            assert_eq!(Stretch::find(&log(&[&slip], 3.0), 0), [], "{hz}");
        }
        assert_eq!(Stretch::find(&log(&[&|t| t * t], 2.0), 0), []);
        assert_eq!(Stretch::find(&log(&[&|_| 0.4], 3.0), 0), []);
    }

    #[test]
    fn noise_is_no_ripple() {
        let mut random = ChaCha8Rng::seed_from_u64(3);
        let noise: Vec<f64> = (0..2000)
            .map(|_| StandardNormal.sample(&mut random))
            .collect();
        let at = |t: f64| 0.3 * t + 3e-4 * noise[whole_steps((t * RATE).round())];
        let found = Stretch::find(&log(&[&at], 3.0), 0);
        let samples: usize = found.iter().map(|stretch| stretch.samples.len()).sum();
        assert!(samples > 1100, "{found:?}");
    }

    #[test]
    fn other_joints_have_to_stand() {
        let steady = |t: f64| 0.5 * t;
        let swing = |t: f64| 0.3 * t.sin();
        assert_eq!(Stretch::find(&log(&[&steady, &swing], 3.0), 0), []);
        let breath = |t: f64| 1e-3 * t.sin();
        assert_eq!(Stretch::find(&log(&[&steady, &breath], 3.0), 0).len(), 1);
        let mut log = log(&[&steady], 3.0);
        log.holes.push(1.0..1.2);
        assert_eq!(Stretch::find(&log, 0), []);
    }
}

//! Twenty releases of a link from one height, as an encoder sees them, and their mean and band.

use std::array;

use rand::seq::SliceRandom;
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

use super::plant::{Position, release, with_dry};
use super::truth::{ESTIMATED, Height, PULSE, RELEASES, Starts};
use crate::paper::{normal, rounded};

/// Dry friction differs from release to release by so much of itself, one standard deviation.
const SPREAD: f64 = 0.05;

/// All releases of one link from one height, on one side.
#[derive(Debug, Clone)]
pub struct Batch {
    /// Where the link was let go, degrees, each release.
    pub starts: Vec<f64>,
    /// Mean over releases, sample by sample.
    pub mean: Vec<Position>,
    /// Standard deviation over releases.
    pub deviation: Vec<Position>,
    /// Whether the arm of each release stands after the last sample.
    pub ends: Vec<bool>,
}

/// What a box plot shows.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BoxPlot {
    /// Least value.
    pub least: f64,
    /// Quartiles, the second of them the median.
    pub quartiles: [f64; 3],
    /// Largest value.
    pub most: f64,
    /// The value that comes most often, the largest of several.
    pub mode: f64,
    /// Mean.
    pub mean: f64,
}

impl BoxPlot {
    /// Of at least one value.
    #[must_use]
    pub fn new(values: &[f64]) -> Self {
        let mut sorted = values.to_vec();
        sorted.sort_by(f64::total_cmp);
        let last = sorted.len() - 1;
        let quartile = |share: f64| {
            let place = share * last as f64;
            let (low, part) = (place.floor(), place.fract());
            #[expect(
                clippy::cast_possible_truncation,
                clippy::cast_sign_loss,
                reason = "a place in the list"
            )]
            let low = low as usize;
            sorted[low] + part * (sorted[(low + 1).min(last)] - sorted[low])
        };
        let count = |value: f64| {
            let same = sorted.iter();
            same.filter(|other| other.total_cmp(&value).is_eq()).count()
        };
        let by_count = |x: &&f64, y: &&f64| count(**x).cmp(&count(**y));
        Self {
            least: sorted[0],
            quartiles: [0.25, 0.5, 0.75].map(quartile),
            most: sorted[last],
            mode: sorted.iter().max_by(by_count).copied().unwrap_or(sorted[0]),
            mean: sorted.iter().sum::<f64>() / sorted.len() as f64,
        }
    }
}

/// The nearest angle that the encoder knows, degrees.
fn seen(angle: f64) -> f64 {
    rounded(angle, PULSE)
}

/// Initial angles, which are an input of the simulation: with the printed least, largest and most frequent value, and others between.
fn initial(starts: &Starts, random: &mut ChaCha8Rng) -> Vec<f64> {
    let pulses = |angle: f64| (angle / PULSE).round();
    let [least, most, mode] = [starts.least, starts.most, starts.mode].map(pulses);
    let mut found = vec![mode; starts.often];
    found.extend([least, most].into_iter().filter(|end| {
        // The mode may be one of them.
        (end - mode).abs() > 0.5
    }));
    while found.len() < RELEASES {
        let next = least + (random.random::<f64>() * (most - least)).round();
        let same = found.iter().filter(|other| (*other - next).abs() < 0.5);
        if same.count() + 1 < starts.often {
            found.push(next);
        }
    }
    found.shuffle(random);
    found.iter().map(|pulses| pulses * PULSE).collect()
}

/// Where the arm is let go when a link is, rad: the second one on the other side, as in the paper; the other link hangs.
#[must_use]
pub fn at(link: usize, degrees: f64) -> Position {
    let angle = degrees.to_radians();
    if link == 0 {
        [angle, 0.0]
    } else {
        [0.0, -angle]
    }
}

impl Batch {
    /// Twenty releases of the arm of Table 6, every other one to the other side and mirrored.
    #[must_use]
    pub fn measured(height: &Height, link: usize, seed: u64) -> Self {
        let mut random = ChaCha8Rng::seed_from_u64(seed);
        let starts = initial(&height.starts[link], &mut random);
        let mut sums = vec![[0.0; 2]; height.samples];
        let mut squares = sums.clone();
        let mut ends = Vec::with_capacity(starts.len());
        for (k, &start) in starts.iter().enumerate() {
            let side = if k % 2 == 0 { 1.0 } else { -1.0 };
            let factors = array::from_fn(|_| 1.0 + SPREAD * normal(&mut random));
            let (positions, arm) = release(
                with_dry(ESTIMATED, factors),
                at(link, side * start),
                height.samples,
            );
            ends.push(arm.is_at_rest());
            for (sample, q) in positions.iter().enumerate() {
                for joint in 0..2 {
                    let angle = side * seen(q[joint].to_degrees()).to_radians();
                    sums[sample][joint] += angle;
                    squares[sample][joint] += angle * angle;
                }
            }
        }
        let count = RELEASES as f64;
        let deviation = |sum: f64, square: f64| {
            let variance = (square - sum * sum / count) / (count - 1.0);
            variance.max(0.0).sqrt()
        };
        let pairs = sums.iter().zip(&squares);
        Self {
            deviation: pairs
                .map(|(sum, square)| array::from_fn(|k| deviation(sum[k], square[k])))
                .collect(),
            mean: sums.iter().map(|sum| sum.map(|x| x / count)).collect(),
            starts,
            ends,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::seed_001::truth::HEIGHTS;

    #[test]
    fn a_box_plot_has_quartiles_between_values() {
        let plot = BoxPlot::new(&[4.0, 1.0, 2.0, 2.0, 3.0]);
        let found = [plot.least, plot.most, plot.mode, plot.mean];
        for (found, wanted) in found.iter().zip([1.0, 4.0, 2.0, 2.4]) {
            assert!((found - wanted).abs() < 1e-12, "{plot:?}");
        }
        for (found, wanted) in plot.quartiles.iter().zip([2.0, 2.0, 3.0]) {
            assert!((found - wanted).abs() < 1e-12, "{plot:?}");
        }
    }

    #[test]
    fn printed_angles_are_whole_pulses() {
        let starts = HEIGHTS.iter().flat_map(|height| &height.starts);
        for starts in starts {
            for angle in [starts.least, starts.most, starts.mode] {
                assert!((seen(angle) - angle).abs() < 1e-9, "{angle}");
            }
        }
    }
}

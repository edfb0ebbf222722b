//! Motions of section 3.1: sums of ten sines a joint that fill a room.

use rand::{RngExt as _, SeedableRng};
use rand_chacha::ChaCha8Rng;

use super::plant::Three;
use super::truth::FREQUENCIES;

/// Motions that are drawn, and 50ths of a second for which they are looked at.
const DRAWS: usize = 100;
const SEEN: std::ops::Range<i32> = 0..3200;

/// A joint below this speed is slow, rad/s.
const SLOW: f64 = 0.1;

/// Poses between which a motion stays, rad.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Room {
    /// Lowest angles.
    pub low: Three,
    /// Highest angles.
    pub high: Three,
}

/// Where the inertia of all five columns of table 1 is positive definite, which it is not in the whole workspace.
pub const ROOM: Room = Room {
    low: [-0.9, -0.45, -0.10],
    high: [0.9, 0.50, 0.65],
};

/// A sum of sines around a pose, one sum a joint.
#[derive(Debug, Clone, PartialEq)]
pub struct Sines {
    center: Three,
    /// Amplitude, frequency in rad/s, phase.
    tones: [Vec<[f64; 3]>; 3],
}

impl Sines {
    /// So many sines a joint that fill a room. Amplitudes grow with the square of the frequency; of phases by chance those are taken with which the
    /// joint is slow for the shortest time, as friction holds it there.
    #[must_use]
    pub fn new(count: usize, room: &Room, seed: u64) -> Self {
        let mut random = ChaCha8Rng::seed_from_u64(seed);
        let [low, high] = FREQUENCIES;
        let center = std::array::from_fn(|j| 0.5 * (room.low[j] + room.high[j]));
        let tones = std::array::from_fn(|j| {
            let draws = (0..DRAWS).map(|_| {
                let mut tones: Vec<[f64; 3]> = (0..count)
                    .map(|k| {
                        let w = low + place(k, count, j) * (high - low);
                        let phase = random.random_range(0.0..std::f64::consts::TAU);
                        [w * w, w, phase]
                    })
                    .collect();
                let largest = SEEN.map(|t| sum(&tones, 0, 0.02 * f64::from(t)).abs());
                let scale = 0.5 * (room.high[j] - room.low[j]) / largest.fold(0.0, f64::max);
                for tone in &mut tones {
                    tone[0] *= scale;
                }
                let slow = SEEN.filter(|&t| sum(&tones, 1, 0.02 * f64::from(t)).abs() < SLOW);
                (slow.count(), tones)
            });
            draws
                .min_by_key(|(slow, _)| *slow)
                .map_or(Vec::new(), |(_, tones)| tones)
        });
        Self { center, tones }
    }

    /// Lowest and highest frequency of each joint, rad/s.
    #[must_use]
    pub fn frequencies(&self) -> [[f64; 2]; 3] {
        std::array::from_fn(|j| {
            let all = self.tones[j].iter().map(|tone| tone[1]);
            all.fold([f64::INFINITY, 0.0], |[low, high], w| {
                [low.min(w), high.max(w)]
            })
        })
    }

    /// The same, faster or slower.
    #[must_use]
    pub fn at_pace(mut self, pace: f64) -> Self {
        for tone in self.tones.iter_mut().flatten() {
            tone[1] *= pace;
        }
        self
    }

    /// Positions, velocities, accelerations.
    #[must_use]
    pub fn at(&self, t: f64) -> [Three; 3] {
        std::array::from_fn(|order| {
            std::array::from_fn(|j| {
                let center = if order == 0 { self.center[j] } else { 0.0 };
                center + sum(&self.tones[j], [0, 1, 2][order], t)
            })
        })
    }
}

/// So many poses of a room by chance.
#[must_use]
pub fn poses(room: &Room, count: usize, seed: u64) -> Vec<Three> {
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    let mut pose = || std::array::from_fn(|j| random.random_range(room.low[j]..room.high[j]));
    (0..count).map(|_| pose()).collect()
}

/// Where a tone is between the lowest frequency and the highest, which are those of every joint; between them joints have frequencies of
/// their own.
fn place(tone: usize, count: usize, joint: usize) -> f64 {
    let last = count.saturating_sub(1).max(1);
    let shift = if tone == 0 || tone == last {
        0.0
    } else {
        [0.0, -0.3, 0.3][joint]
    };
    (tone as f64 + shift) / last as f64
}

/// A sum of sines, differentiated so many times.
fn sum(tones: &[[f64; 3]], order: i32, t: f64) -> f64 {
    let shift = f64::from(order) * std::f64::consts::FRAC_PI_2;
    let all = tones.iter();
    all.map(|[a, w, p]| a * w.powi(order) * (w * t + p + shift).sin())
        .sum()
}

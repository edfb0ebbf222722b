//! Sensors as real ones are: steps of encoders, noise.

use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, StandardNormal};

/// Time over which the slow part of a torque's noise changes, s.
const CORRELATION_S: f64 = 0.004;

/// What lies between the arm and its log. The default is exact.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Sensors {
    /// Step of the encoders, rad or m; 0 for exact ones.
    pub encoder_step: f64,
    /// Standard deviation of the noise of positions, rad or m.
    pub position_noise: f64,
    /// Standard deviation of the noise of logged torques, relative to the root mean square of each joint's torque; half of its power
    /// is white, half changes over 4 ms.
    pub torque_noise: f64,
    /// Corner of the first-order filter of velocities from differences of measured positions, Hz. Exact positions have exact
    /// velocities.
    pub velocity_hz: f64,
    /// Of all noise: the same seed, the same log.
    pub seed: u64,
}

/// Random numbers of one purpose.
#[derive(Debug)]
pub(super) struct Noise(ChaCha8Rng);

impl Noise {
    pub fn new(seed: u64, purpose: u64) -> Self {
        let mut random = ChaCha8Rng::seed_from_u64(seed);
        random.set_stream(purpose);
        Self(random)
    }

    fn normal(&mut self) -> f64 {
        StandardNormal.sample(&mut self.0)
    }
}

impl Sensors {
    pub(super) fn are_exact(&self) -> bool {
        self.encoder_step == 0.0 && self.position_noise == 0.0
    }

    /// Positions as measured.
    pub(super) fn positions(&self, q: &[f64], noise: &mut Noise, measured: &mut Vec<f64>) {
        measured.clear();
        measured.extend(q.iter().map(|&q| {
            let q = if self.position_noise > 0.0 {
                q + self.position_noise * noise.normal()
            } else {
                q
            };
            if self.encoder_step > 0.0 {
                (q / self.encoder_step).round() * self.encoder_step
            } else {
                q
            }
        }));
    }

    /// Adds noise to a logged torque.
    pub(super) fn disturb(&self, torque: &mut [f64], interval: f64, noise: &mut Noise) {
        if self.torque_noise == 0.0 || torque.is_empty() {
            return;
        }
        let power = torque.iter().map(|x| x * x).sum::<f64>() / torque.len() as f64;
        let size = self.torque_noise * (0.5 * power).sqrt();
        let keep = (-interval / CORRELATION_S).exp();
        let mut slow = noise.normal();
        for value in torque {
            slow = keep * slow + (1.0 - keep * keep).sqrt() * noise.normal();
            *value += size * (slow + noise.normal());
        }
    }
}

//! Noise of torques: white, colored, and a zero that wanders.

use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, StandardNormal};

use crate::experiment::{RATE_HZ, SECONDS, rms};

/// Shares of the torque's root mean square.
#[derive(Debug, Clone, Copy)]
pub struct Noise {
    /// What tables call it; nothing for that of a usual drive.
    pub name: &'static str,
    white: f64,
    colored: f64,
    /// Of the colored part, from one sample to the next.
    correlation: f64,
    /// Deviation of the zero's random walk at the end of the log that is fitted.
    wander: f64,
}

/// Of a usual drive: colored over 20 ms.
pub const DRIVE: Noise = Noise {
    name: "",
    white: 0.004,
    colored: 0.006,
    correlation: 0.9,
    wander: 0.002,
};

/// Colored over 80 ms.
pub const SLOW: Noise = Noise {
    name: "noise over 80 ms",
    correlation: 0.975,
    ..DRIVE
};

/// A zero that ends up 1 % away.
pub const WANDERING: Noise = Noise {
    name: "a zero that wanders by 1 %",
    wander: 0.01,
    ..DRIVE
};

/// A zero that ends up 3 % away.
pub const FAR: Noise = Noise {
    name: "a zero that wanders by 3 %",
    wander: 0.03,
    ..DRIVE
};

impl Noise {
    /// Adds it to a torque.
    pub fn disturb(&self, values: &mut [f64], random: &mut ChaCha8Rng) {
        let size = rms(values.iter().copied());
        let mut normal = || -> f64 { StandardNormal.sample(random) };
        let (mut colored, mut wander) = (normal(), 0.0);
        let step = (RATE_HZ * SECONDS[0]).sqrt().recip();
        let fresh = (1.0 - self.correlation * self.correlation).sqrt();
        for value in values {
            colored = self.correlation * colored + fresh * normal();
            wander += step * normal();
            let noise = self.white * normal() + self.colored * colored + self.wander * wander;
            *value += size * noise;
        }
    }
}

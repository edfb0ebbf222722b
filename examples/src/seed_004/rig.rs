//! The rig of section 3.1: a PD controller at 1 kHz along a motion, and what it logs.

use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;

use super::plant::{Plant, Three};
use super::sensors::{ENCODER, RATE, Record, Velocity, rounded, samples};
use super::sines::Sines;
use crate::paper::Error;

/// Gains of the PD controller: N m/rad and N m s/rad.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Gains {
    /// Of positions.
    pub stiffness: Three,
    /// Of velocities.
    pub damping: Three,
}

impl Gains {
    /// The same on all joints.
    #[must_use]
    pub const fn all(stiffness: f64, damping: f64) -> Self {
        Self {
            stiffness: [stiffness; 3],
            damping: [damping; 3],
        }
    }
}

/// Moves a plant along a motion for so many seconds.
///
/// The controller holds its torque for a sample. What is logged is the mean of the torque around a sample, as a current that
/// passes a converter's low-pass, with noise and in steps.
///
/// # Errors
/// That of [`Plant::advance`].
pub fn run(
    plant: Plant,
    motion: &Sines,
    gains: &Gains,
    seconds: f64,
    seed: u64,
) -> Result<Record, Error> {
    pushed(plant, motion, gains, seconds, seed, |_, _| [0.0; 3])
}

/// As [`run`], with a torque from outside that depends on time and pose.
///
/// # Errors
/// That of [`Plant::advance`].
pub fn pushed(
    mut plant: Plant,
    motion: &Sines,
    gains: &Gains,
    seconds: f64,
    seed: u64,
    outside: impl Fn(f64, &Three) -> Three,
) -> Result<Record, Error> {
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    let mut velocities = [Velocity::new(100.0); 3];
    let mut record = Record::default();
    let mut held = [0.0; 3];
    for k in 0..samples(seconds) {
        let t = k as f64 / RATE;
        let [wanted, speed, _] = motion.at(t);
        let q = plant.q().map(|q| rounded(q, ENCODER));
        let tau: Three = std::array::from_fn(|j| {
            let slip = speed[j] - velocities[j].next(q[j]);
            gains.stiffness[j] * (wanted[j] - q[j]) + gains.damping[j] * slip
        });
        record.time.push(t);
        for j in 0..3 {
            record.read(j, q[j], 0.5 * (held[j] + tau[j]), &mut random);
        }
        let from_outside = outside(t, &plant.q());
        let all: Three = std::array::from_fn(|j| tau[j] + from_outside[j]);
        plant.advance(&all, 1.0 / RATE)?;
        held = tau;
    }
    Ok(record)
}

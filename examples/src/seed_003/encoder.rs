//! Which bristles an encoder tells: torques that rise, on bristles of several stiffnesses, through encoders of several resolutions.

use robot_model::friction_curve::{Bristles, Curve, Law};

use super::experiments::rise;
use super::plant::{Friction, PRINTED};
use super::tool;
use crate::paper::Error;

/// Bits a turn.
pub const BITS: [i32; 5] = [12, 14, 16, 18, 20];

/// Stiffnesses, N m/rad: around what encoders of 12 to 18 bits tell.
pub const STIFFNESSES: [f64; 8] = [20.0, 50.0, 100.0, 200.0, 500.0, 1000.0, 2000.0, 4000.0];

/// How fast the torque rises, N m/s, and which of the samples are kept.
const RATE: f64 = 0.1;
const EVERY: usize = 20;

/// Found is what is off by less than that.
pub const CLOSE: f64 = 0.1;

/// One stiffness through one encoder.
#[derive(Debug, Clone, PartialEq)]
pub struct Trial {
    /// Bits of the encoder.
    pub bits: i32,
    /// True stiffness, N m/rad.
    pub stiffness: f64,
    /// What is found, N m/rad; none where positions do not follow the torque.
    pub found: Option<f64>,
    /// Whether the encoder is said to tell it.
    pub is_resolved: bool,
    /// The largest stiffness that it is said to tell, N m/rad.
    pub most: f64,
}

/// All trials.
///
/// # Errors
/// Those of logs.
pub fn study(curve: &Curve, law: &Law) -> Result<Vec<Trial>, Error> {
    let mut trials = Vec::new();
    for (seed, stiffness) in (100..).zip(STIFFNESSES) {
        let run = rise(
            Friction {
                stiffness,
                ..PRINTED
            },
            RATE,
            EVERY,
        );
        for bits in BITS {
            let log = run.log("rise", bits, seed)?;
            let found = tool::bristles(curve, law, &log).ok();
            trials.push(Trial {
                bits,
                stiffness,
                is_resolved: found.as_ref().is_some_and(Bristles::is_resolved),
                most: found.as_ref().map_or(f64::NAN, Bristles::most_stiffness),
                found: found.map(|found| found.stiffness.value),
            });
        }
    }
    Ok(trials)
}

impl Trial {
    /// Whether the stiffness came back.
    #[must_use]
    pub fn is_close(&self) -> bool {
        self.found
            .is_some_and(|found| (found / self.stiffness - 1.0).abs() < CLOSE)
    }
}

/// The stiffest bristles that came back through an encoder, with all softer ones, N m/rad.
#[must_use]
pub fn stiffest(trials: &[Trial], bits: i32) -> f64 {
    let through = trials.iter().filter(|trial| trial.bits == bits);
    through
        .take_while(|trial| trial.is_close())
        .fold(0.0, |_, trial| trial.stiffness)
}

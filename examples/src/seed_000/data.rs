//! What the paper makes of its measurements: velocities, the commanded voltage, and the stretch that is fitted.

use std::ops::Range;

use robot_model::calibrate::{Commanded, Windows};
use robot_model::identify::output_error::Recording;
use robot_model::log::Log;

use super::plant::{Experiment, differences};
use super::truth::BACK_EMF;
use crate::paper::Error;

/// Measurements, and what follows from them; `[sample]`.
#[derive(Debug, Clone)]
pub struct Data {
    /// s
    pub time: Vec<f64>,
    /// Measured position, rad.
    pub y: Vec<f64>,
    /// Measured voltage across the known resistance, V: the input of model (5.1).
    pub u: Vec<f64>,
    /// Backward differences of `y`, rad/s: Figure 5.
    pub velocity: Vec<f64>,
    /// The back-EMF constant that makes the commanded voltage constant in pieces, with its pieces.
    pub commanded: Commanded,
    /// `u + 1.5 velocity`, V: Figure 6.
    pub synthesized: Vec<f64>,
    /// Its square wave, V: the input of model (5.2).
    pub wave: Vec<f64>,
    /// Samples that are fitted.
    pub window: Range<usize>,
}

impl Data {
    /// From measurements.
    ///
    /// # Errors
    /// Where no factor makes the commanded voltage a square wave.
    pub fn new(experiment: &Experiment) -> Result<Self, Error> {
        let Experiment { time, y, u, .. } = experiment;
        let velocity = differences(y);
        let commanded = Commanded::find_in(&Windows::new(time, y)?, u)?;
        let synthesized = synthesized(u, &velocity, BACK_EMF);
        let levels = commanded.pieces.iter().map(|piece| piece.level.abs());
        let level = levels.sum::<f64>() / commanded.pieces.len() as f64;
        Ok(Self {
            wave: synthesized.iter().map(|v| level * v.signum()).collect(),
            window: experiment.window(),
            time: time.clone(),
            y: y.clone(),
            u: u.clone(),
            velocity,
            commanded,
            synthesized,
        })
    }

    /// The fitted stretch of the position, driven by one of the inputs.
    ///
    /// # Errors
    /// Those of a log without room for a motion.
    pub fn driven_by(&self, input: &[f64]) -> Result<Recording, Error> {
        let part = |channel: &[f64]| channel[self.window.clone()].to_vec();
        let log = Log::from_samples(
            "shoulder",
            part(&self.time),
            vec![part(&self.y)],
            vec![part(input)],
        )?;
        Ok(Recording::new(&log, &[1.0], 0.0, Vec::new()))
    }

    /// Position and velocity where the fit starts: measured, and its difference.
    #[must_use]
    pub fn start(&self) -> [f64; 2] {
        [self.y[self.window.start], self.velocity[self.window.start]]
    }
}

/// `u + k velocity`
#[must_use]
pub fn synthesized(u: &[f64], velocity: &[f64], k: f64) -> Vec<f64> {
    let pairs = u.iter().zip(velocity);
    pairs.map(|(u, velocity)| u + k * velocity).collect()
}

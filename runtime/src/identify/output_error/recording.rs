//! Logs as they drive a simulation.

use super::window::range;
use crate::log::Log;
use crate::signal::resample::cubic;

/// Logged torque between samples.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Hold {
    /// The mean of both, as of a straight line: for torques that are means over the interval around their sample, or measured.
    #[default]
    Mean,
    /// That of the sample before: for commands that are held.
    Sample,
}

/// A log as it drives a simulation.
#[derive(Debug, Clone, PartialEq)]
pub struct Recording {
    pub(super) log: Log,
    /// Joint torques, at the instants of positions.
    pub(super) torque: Vec<Vec<f64>>,
    /// Places of the channels that effects read, in their order.
    pub(super) inputs: Vec<usize>,
}

/// A range of positions, rad or m, that is none.
const STILL: f64 = 1e-9;

impl Recording {
    /// Whether any of its joints does.
    pub(super) fn moves(&self) -> bool {
        let mut positions = self.log.q.iter();
        positions.any(|q| range(q) > STILL)
    }

    /// `gain` is joint torque over what is logged, one a joint; logged torques are `late` by so many seconds; `inputs` are channels that
    /// effects read, by their places.
    ///
    /// # Examples
    /// A drive that logs a current, 0.5 N/A:
    /// ```
    /// # mod block { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/doc/block.rs")); }
    /// # use block::{Block, measure};
    /// # use robot_model::identify::output_error::{Hold, OutputError, Recording};
    /// let mut log = measure();
    /// log.tau[0].iter_mut().for_each(|tau| *tau /= 0.5);
    /// let recording = Recording::new(&log, &[0.5], 0.0, Vec::new());
    /// let settings = OutputError { hold: Some(Hold::Sample), ..OutputError::default() };
    /// let found = settings.compare(&Block([2.0, 0.7]), &[2.0, 0.7], &[recording])?;
    /// assert!(found.position[0].rmse < 1e-6);
    /// # Ok::<(), robot_model::identify::output_error::OutputErrorError>(())
    /// ```
    #[must_use]
    pub fn new(log: &Log, gain: &[f64], late: f64, inputs: Vec<usize>) -> Self {
        let (first, last) = (log.time[0], log.time[log.time.len() - 1]);
        let instants: Vec<f64> = log
            .time
            .iter()
            .map(|t| (t + late).clamp(first, last))
            .collect();
        let torque = log.tau.iter().zip(gain).map(|(tau, gain)| {
            let tau: Vec<f64> = tau.iter().map(|tau| gain * tau).collect();
            if late == 0.0 {
                tau
            } else {
                cubic(&log.time, &tau, &instants)
            }
        });
        Self {
            torque: torque.collect(),
            log: log.clone(),
            inputs,
        }
    }
}

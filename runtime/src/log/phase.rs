//! Where in its period a motion that repeats is.

use super::{Channel, Log};
use crate::signal::period;

/// Name of the channel that [`Log::with_motion_phase`] adds.
pub const MOTION_PHASE: &str = "motion_phase";

impl Log {
    /// The shortest period of the motion, s, where it fits at least twice into the log and all joints repeat, to 2 % of how far they move.
    /// Periods are looked for from 0.5 to 120 s.
    ///
    /// # Examples
    /// ```
    /// # use robot_model::log::Log;
    /// let time: Vec<f64> = (0..900).map(|k| 0.01 * f64::from(k)).collect();
    /// let q = vec![time.iter().map(|t| (std::f64::consts::TAU * t / 3.0).sin()).collect()];
    /// let log = Log::from_samples("a plant", time, q, vec![vec![0.0; 900]])?;
    /// assert!((log.period().unwrap() - 3.0).abs() < 1e-3);
    ///
    /// let log = log.with_motion_phase(None);
    /// assert_eq!(log.extra[0].name, "motion_phase");
    /// assert!((log.extra[0].values[450] - 0.5).abs() < 1e-3);
    /// # Ok::<(), robot_model::log::LogError>(())
    /// ```
    #[must_use]
    pub fn period(&self) -> Option<f64> {
        period(&self.q, self.rate_hz())
    }

    /// Adds the channel [`MOTION_PHASE`], `(t - t_0) / T mod 1` with the log's own [period](Self::period) `T`, or with `otherwise` where it
    /// has none. A log that has such a channel, or neither period, stays as it is.
    ///
    /// # Examples
    /// A log that is shorter than twice the period which one knows it to have:
    /// ```
    /// # use robot_model::log::Log;
    /// let time: Vec<f64> = (0..300).map(|k| 0.01 * f64::from(k)).collect();
    /// let q = vec![time.iter().map(|t| (0.5 * t).sin()).collect()];
    /// let log = Log::from_samples("a plant", time, q, vec![vec![0.0; 300]])?.with_motion_phase(Some(4.0));
    /// assert!((log.extra[0].values[100] - 0.25).abs() < 1e-9);
    /// # Ok::<(), robot_model::log::LogError>(())
    /// ```
    #[must_use]
    pub fn with_motion_phase(mut self, otherwise: Option<f64>) -> Self {
        if self.extra.iter().any(|one| one.name == MOTION_PHASE) {
            return self;
        }
        if let Some(period) = self.period().or(otherwise) {
            let start = self.time[0];
            let phase = self.time.iter().map(|t| ((t - start) / period).fract());
            self.extra.push(Channel {
                name: MOTION_PHASE.to_owned(),
                values: phase.collect(),
            });
        }
        self
    }
}

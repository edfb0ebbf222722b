//! The bands of the motion whose torque is compared with raw samples.
//!
//! A fit looks at one band of the torque, and its motion is filtered wider than that. Raw samples are another matter: each hertz of the
//! smooth band adds noise of accelerations, and how sharply velocities turn decides over the pulses at reversals of dry friction. So the
//! bands of predictions are those with which the errors on the fitted logs are least.

use super::{Errors, Estimate, IdentifyError};
use crate::columns::Arm;
use crate::log::Log;
use crate::signal::Bands;
use crate::threads;

/// Wide bands that are tried, Hz, up to this share of the sample rate.
const WIDE_HZ: [f64; 5] = [30.0, 45.0, 60.0, 90.0, 120.0];
const MOST_OF_RATE: f64 = 0.36;

impl Estimate {
    /// The estimate with the [`Estimate::motion_bands`] of least error on the logs that were fitted: of their logarithms of the mean square
    /// over all joints, raw samples. Parameters stay as they are.
    ///
    /// # Errors
    /// Those of [`Self::errors`].
    ///
    /// # Examples
    /// ```
    /// # mod pendulum { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/doc/pendulum.rs")); }
    /// # use pendulum::{measure, pendulum};
    /// # use robot_model::identify::Identify;
    /// let (arm, log) = (pendulum(), measure(0.0));
    /// let estimate = Identify::default().fit(&arm, std::slice::from_ref(&log))?;
    /// let before = estimate.errors(&arm, &log)?.rmse[0];
    /// let estimate = estimate.with_best_motion(&arm, std::slice::from_ref(&log))?;
    /// assert!(estimate.errors(&arm, &log)?.rmse[0] <= before);
    /// # Ok::<(), robot_model::identify::IdentifyError>(())
    /// ```
    pub fn with_best_motion(mut self, arm: &dyn Arm, logs: &[Log]) -> Result<Self, IdentifyError> {
        let slowest = logs.iter().map(Log::rate_hz).fold(f64::INFINITY, f64::min);
        let narrow = Bands::for_rate(slowest).smooth_hz;
        let wide = WIDE_HZ
            .into_iter()
            .filter(|hz| *hz <= MOST_OF_RATE * slowest);
        let of_narrow = wide.map(|wide_hz| self.with_motion(narrow, wide_hz));
        self.motion_bands = self.least(arm, logs, of_narrow.collect())?;
        // A calm one, of the band that is fitted, is for accelerations that are mostly noise.
        let smooth = [self.bands.smooth_hz, self.bands.shared_hz];
        let of_wide = smooth.map(|hz| self.with_motion(hz, self.motion_bands.wide_hz));
        self.motion_bands = self.least(arm, logs, of_wide.to_vec())?;
        Ok(self)
    }

    fn with_motion(&self, smooth_hz: f64, wide_hz: f64) -> Bands {
        Bands {
            smooth_hz,
            wide_hz: wide_hz.max(smooth_hz),
            shared_hz: self.bands.shared_hz.min(smooth_hz),
        }
    }

    /// Of bands and the present ones those of least error.
    fn least(
        &self,
        arm: &dyn Arm,
        logs: &[Log],
        mut bands: Vec<Bands>,
    ) -> Result<Bands, IdentifyError> {
        bands.insert(0, self.motion_bands);
        bands.dedup();
        let merit = |bands: &Bands| -> Result<f64, IdentifyError> {
            let mut with = self.clone();
            with.motion_bands = *bands;
            let errors = logs.iter().map(|log| with.raw_errors(arm, log));
            let errors = Errors::of_all(&errors.collect::<Result<Vec<_>, _>>()?);
            let told = errors.rmse.iter().filter(|rmse| **rmse > 0.0);
            Ok(told.map(|rmse| rmse.ln()).sum())
        };
        let merits = threads::map(&bands, merit).into_iter();
        let merits = merits.collect::<Result<Vec<f64>, _>>()?;
        let best = bands.iter().zip(merits).min_by(|a, b| a.1.total_cmp(&b.1));
        Ok(best.map_or(self.motion_bands, |(bands, _)| *bands))
    }
}

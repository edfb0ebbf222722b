//! The filtered form: identification without accelerations.
//!
//! With `tau = d/dt (Y_p beta) - Y_h beta` and `L(s) = w / (s + w)`, both sides pass `L`: `L{tau} = Y_L beta` where
//! `Y_L = w (Y_p - L{Y_p}) - L{Y_h}`. Here `Y_L` stands behind the trait of any arm, so that everything else, from the choice
//! of bands to the deviations, is that of the usual form.
//!
//! The transient is no approximation: the difference of both sides decays as `exp(-w t)` and is zero at the start, since
//! `L{Y_p}` starts at `Y_p` and the other filters at zero. They start where the filters of the motion have settled; before
//! that both sides are zero. Where rows around turns of dry joints are left out they start anew behind each, which the same argument
//! allows: `L` has a torque that no law says for as long as it remembers, not only while the joint stands.

use crate::columns::MomentumArm;
use crate::log::Log;
use crate::signal::Bands;

use super::errors::Errors;
use super::estimate::{Estimate, Form};
use super::stack::Stack;
use super::{Identify, IdentifyError, band, check_logs, instruments, shapes, slowest_bands};

mod arm;

use arm::FilteredArm;

/// The corner where none is given, rad/s: the end of the band that torque and columns share.
pub(super) fn default_corner(bands: &Bands) -> f64 {
    std::f64::consts::TAU * bands.shared_hz
}

/// The rows of a log of an arm without shapes and, where a joint has dry friction, those of `L` that starts anew behind each turn: both with
/// the rows at turns, which are noted.
pub(super) fn rows(
    arm: &dyn MomentumArm,
    log: &Log,
    bands: &Bands,
    corner: Option<f64>,
) -> Result<(Stack, Option<Stack>), IdentifyError> {
    let rows = |starts_anew: bool| -> Result<Stack, IdentifyError> {
        let filtered = FilteredArm {
            starts_anew,
            ..FilteredArm::new(arm, *bands, corner)
        };
        Ok(Identify::default().rows(&filtered, &[filtered.prepare(log)?], &[]))
    };
    let is_dry = !arm.dry_joints().is_empty();
    Ok((rows(false)?, is_dry.then(|| rows(true)).transpose()?))
}

impl Identify {
    /// Identifies from one or several logs without computing an acceleration.
    ///
    /// `corner` is `w` of `L(s) = w / (s + w)` in rad/s: above the band of the motion, below that of its noise; without it the
    /// end of the shared band. The parameters are those of [`Self::fit`]; errors are of the filtered torque, see
    /// [`Estimate::filtered_errors`].
    ///
    /// # Errors
    /// Those of [`Self::fit`], and [`IdentifyError::Signal`] for a corner that does not fit the logs' rate.
    ///
    /// # Examples
    /// A pendulum, `tau = d/dt (izz dq) + mx sin(q) + fv dq`:
    /// ```
    /// # mod pendulum { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/doc/pendulum.rs")); }
    /// # use pendulum::{measure, pendulum};
    /// use robot_model::identify::{Form, Identify};
    /// let estimate = Identify::default().fit_filtered(&pendulum(), &[measure(0.0)], Some(60.0))?;
    /// assert_eq!(estimate.form, Form::Filtered { corner: 60.0 });
    /// for (value, truth) in estimate.values().iter().zip([2.0, 9.0, 1.0]) {
    ///     assert!((value - truth).abs() < 0.01 * truth);
    /// }
    /// # Ok::<(), robot_model::identify::IdentifyError>(())
    /// ```
    pub fn fit_filtered(
        &self,
        arm: &dyn MomentumArm,
        logs: &[Log],
        corner: Option<f64>,
    ) -> Result<Estimate, IdentifyError> {
        check_logs(arm, logs)?;
        self.away_from_turns(arm, &|identify| {
            identify.fit_filtered_rows(arm, logs, corner)
        })
    }

    fn fit_filtered_rows(
        &self,
        arm: &dyn MomentumArm,
        logs: &[Log],
        corner: Option<f64>,
    ) -> Result<Estimate, IdentifyError> {
        let bands = match self.bands {
            Some(bands) => bands,
            None => self.choose_filtered_bands(arm, logs, corner)?,
        };
        let filtered = FilteredArm {
            starts_anew: self.leaves_out_turns(),
            ..FilteredArm::new(arm, bands, corner)
        };
        let mut prepared = filtered.prepare_all(logs)?;
        let solved = self.solve(&filtered, &mut prepared, self.given_shapes(&filtered)?)?;
        let of_logs = (logs, prepared.as_slice(), &bands);
        let prepare = |logs: &[Log]| filtered.prepare_all(logs);
        let solved = self.without_drowned(&filtered, of_logs, prepare, solved)?;
        let form = Form::Filtered {
            corner: filtered.corner,
        };
        let shapes = solved.1.clone();
        let solved = self.deviated(&filtered, &prepared, solved);
        let without = self.surer_without(&solved, &|identify| {
            identify.fit_filtered_rows(arm, logs, corner)
        });
        if let Some(without) = without {
            return Ok(without);
        }
        let lacking = self.lacking(
            &filtered,
            &prepared,
            &|log, joint, tau| filtered.behind(log, joint, &tau),
            &solved,
        );
        let estimate = self.estimate(&filtered, form, bands, (solved, lacking), &|| {
            let wanted = filtered.prepare_all(&self.wanted(logs)?)?;
            Ok(instruments::rows(&filtered, &wanted, &shapes))
        })?;
        Ok(estimate.with_late(self.delays_of_logs(arm, logs, &bands, &shapes)))
    }

    /// The bands of a first log, chosen as [`Self::fit_filtered`] does.
    ///
    /// # Errors
    /// Those of [`Self::fit_filtered`].
    ///
    /// # Examples
    /// ```
    /// # mod pendulum { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/doc/pendulum.rs")); }
    /// # use pendulum::{measure, pendulum};
    /// # use robot_model::identify::Identify;
    /// let (arm, log) = (pendulum(), measure(0.0));
    /// let bands = Identify::default().filtered_bands_of(&arm, &log, None)?;
    /// assert_eq!(bands, Identify::default().fit_filtered(&arm, &[log], None)?.bands);
    /// # Ok::<(), robot_model::identify::IdentifyError>(())
    /// ```
    pub fn filtered_bands_of(
        &self,
        arm: &dyn MomentumArm,
        log: &Log,
        corner: Option<f64>,
    ) -> Result<Bands, IdentifyError> {
        let logs = std::slice::from_ref(log);
        check_logs(arm, logs)?;
        match self.bands {
            Some(bands) => Ok(bands),
            None => self.choose_filtered_bands(arm, logs, corner),
        }
    }

    /// As for the usual form: `L` weakens the model's torque and what it leaves alike, so their ratio is the same.
    fn choose_filtered_bands(
        &self,
        arm: &dyn MomentumArm,
        logs: &[Log],
        corner: Option<f64>,
    ) -> Result<Bands, IdentifyError> {
        let mut bands = slowest_bands(logs);
        bands.smooth_hz = bands.wide_hz;
        let filtered = FilteredArm::new(arm, bands, corner);
        let mut prepared = filtered.prepare_all(logs)?;
        let middle = Some(shapes::middle(arm));
        let (solution, shapes, _) = self.solve(&filtered, &mut prepared, middle)?;
        let chosen = band::choose(&filtered, &prepared, &shapes, &solution.estimate);
        Ok(chosen)
    }
}

impl Estimate {
    /// Errors on a log of the filtered torque `L{tau}`, which no acceleration is needed for: the root mean square over
    /// samples at the rate of the motion, first and last second cut, and the relative error as for identification.
    ///
    /// `L` is that of the identification; an estimate of the usual form takes the end of its shared band for a corner.
    ///
    /// # Errors
    /// [`IdentifyError`] where the log is of another arm or cannot be filtered.
    ///
    /// # Examples
    /// `L` takes noise off the torque, which raw samples have:
    /// ```
    /// # mod pendulum { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/doc/pendulum.rs")); }
    /// # use pendulum::{measure, pendulum};
    /// # use robot_model::identify::Identify;
    /// let (arm, log) = (pendulum(), measure(0.0));
    /// let estimate = Identify::default().fit_filtered(&arm, &[log.clone()], None)?;
    /// let filtered = estimate.filtered_errors(&arm, &log)?.rmse[0];
    /// assert!(filtered < 0.6 * estimate.errors(&arm, &log)?.rmse[0]);
    /// # Ok::<(), robot_model::identify::IdentifyError>(())
    /// ```
    pub fn filtered_errors(
        &self,
        arm: &dyn MomentumArm,
        log: &Log,
    ) -> Result<Errors, IdentifyError> {
        check_logs(arm, std::slice::from_ref(log))?;
        let corner = match self.form {
            Form::Filtered { corner } => Some(corner),
            Form::Acceleration => None,
        };
        let bands = self.bands.at_rate(log.rate_hz());
        let filtered = FilteredArm::new(arm, bands, corner);
        let prepared = filtered.prepare(log)?;
        Ok(self.errors_of(&filtered, &prepared, &prepared.tau, 1))
    }
}

#[cfg(test)]
mod tests;

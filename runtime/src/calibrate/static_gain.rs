//! From current to torque, on an arm that is blocked.

use super::branches::branches;
use super::regression::{Regression, quantile};
use super::statistics::{correlation, mean, stands};
use super::{CalibrateError, Measured, check};

/// Fewest points of a line with an error.
const LEAST: usize = 3;

/// `torque = gain * current + offset`, by least squares (Youden 1951, for the deviations of such lines).
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct StaticGain {
    /// The slope, N m/A.
    pub gain: Measured,
    /// The torque without current, N m.
    pub offset: Measured,
    /// Pearson's correlation of torque and current.
    pub r: f64,
    /// Standard deviation of the torque about the line, N m.
    pub residual_std: f64,
    /// Points.
    pub samples: usize,
    /// The term `c i |i|` beside the line, as a drive that saturates has one, N m/A^2; `None` where there are fewer than three currents or four points.
    pub curvature: Option<Term>,
    /// What rising and falling currents differ by; `None` where currents go one way only.
    pub hysteresis: Option<Hysteresis>,
    mean_current: f64,
    quantile: f64,
}

/// A term that a line does not have.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct Term {
    /// Its coefficient.
    pub value: Measured,
    /// How probable one as far from zero is by chance, where there is none: the t-test, and the F-test of one term.
    pub p: f64,
}

impl Term {
    /// Whether chance is less probable than 5 %.
    ///
    /// # Examples
    /// ```
    /// use robot_model::calibrate::StaticGain;
    /// let curvature = |torque: &[f64]| StaticGain::fit(&[0.0, 1.0, 2.0, 3.0, 4.0, 5.0], torque).map(|line| line.curvature);
    /// let saturated = curvature(&[0.0, 0.1, 0.19, 0.27, 0.34, 0.4])?.expect("six currents");
    /// let straight = curvature(&[0.0, 0.11, 0.19, 0.3, 0.41, 0.49])?.expect("six currents");
    /// assert!(saturated.is_told() && !straight.is_told());
    /// # Ok::<(), robot_model::calibrate::CalibrateError>(())
    /// ```
    #[must_use]
    pub fn is_told(&self) -> bool {
        self.p < 0.05
    }
}

/// Friction of a gear holds back what rises and holds up what falls.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct Hysteresis {
    /// Torque at falling currents minus that at rising ones, beside a common slope, N m.
    pub difference: Term,
    /// The slope beside a constant for each way, N m/A.
    pub gain: Measured,
    /// Half of it, by the sign of the gain, N m: friction, where it is above zero.
    pub friction: f64,
    /// Points that were reached by rising currents.
    pub rising: usize,
    /// Points that were reached by falling ones.
    pub falling: usize,
}

impl StaticGain {
    /// The line through points, A and N m, in the order in which they were measured.
    ///
    /// Deviations are those of errors that do not know of each other.
    ///
    /// # Errors
    /// [`CalibrateError`] for channels of different lengths, values that are not finite, fewer than three points, currents that are
    /// all the same.
    ///
    /// # Examples
    /// ```
    /// use robot_model::calibrate::StaticGain;
    /// let line = StaticGain::fit(&[0.0, 1.0, 2.0, 3.0], &[0.1, 0.21, 0.32, 0.43])?;
    /// assert!((line.gain.value - 0.11).abs() < 1e-12 && (line.offset.value - 0.1).abs() < 1e-12);
    /// # Ok::<(), robot_model::calibrate::CalibrateError>(())
    /// ```
    pub fn fit(current: &[f64], torque: &[f64]) -> Result<Self, CalibrateError> {
        check(&[current, torque], LEAST)?;
        let stands_still = CalibrateError::Stands {
            what: "current",
            mend: "measure at several currents",
        };
        if stands(current) {
            return Err(stands_still);
        }
        let ones = vec![1.0; current.len()];
        let line = Regression::new(&[current, &ones], torque).ok_or(stands_still)?;
        let mean_current = mean(current);
        let branch = branches(current);
        // Parabola and branches are looked for beside each other, so that neither is taken for noise of the other.
        // Less its own line about the mean, which the other columns have.
        let line_of = |i: f64| mean_current.abs() * (2.0 * i - mean_current);
        let bent = current.iter().map(|&i| i * i.abs() - line_of(i));
        let bent: Vec<f64> = bent.collect();
        let mut columns = vec![current, &ones, &bent];
        columns.extend(branch.as_deref());
        let with_both = Regression::new(&columns, torque);
        let curvature = with_both.as_ref().map(|fit| term(fit, 2, 1.0));
        let hysteresis = branch.as_deref().and_then(|branch| {
            let alone = Regression::new(&[current, &ones, branch], torque)?;
            let difference = with_both
                .as_ref()
                .map_or_else(|| term(&alone, 2, -2.0), |fit| term(fit, 3, -2.0));
            let rising = branch.iter().filter(|sign| **sign > 0.0).count();
            let gain = alone.of_white_errors(0);
            Some(Hysteresis {
                difference,
                gain,
                friction: 0.5 * difference.value.value * gain.value.signum(),
                rising,
                falling: branch.len() - rising,
            })
        });
        Ok(Self {
            gain: line.of_white_errors(0),
            offset: line.of_white_errors(1),
            r: correlation(current, torque),
            residual_std: line.residual_std(),
            samples: current.len(),
            curvature,
            hysteresis,
            mean_current,
            quantile: quantile(line.freedom),
        })
    }

    /// The gain to go on with: that beside a constant for each way where rising and falling currents differ, which friction does not
    /// move; else that of the line.
    ///
    /// # Examples
    /// ```
    /// use robot_model::calibrate::StaticGain;
    /// let current = [0.0, 1.0, 2.0, 3.0, 2.0, 1.0, 0.0];
    /// let torque = [0.0, 0.11, 0.19, 0.3, 0.25, 0.15, 0.05];
    /// let line = StaticGain::fit(&current, &torque)?;
    /// assert!(line.best().std < line.gain.std);
    /// # Ok::<(), robot_model::calibrate::CalibrateError>(())
    /// ```
    #[must_use]
    pub fn best(&self) -> Measured {
        let told = self.hysteresis.filter(|found| found.difference.is_told());
        told.map_or(self.gain, |found| found.gain)
    }

    /// The torque that the line has at a current, with the interval that holds the line there with 95 %, N m.
    ///
    /// # Examples
    /// ```
    /// use robot_model::calibrate::StaticGain;
    /// let line = StaticGain::fit(&[0.0, 1.0, 2.0, 3.0], &[0.1, 0.22, 0.31, 0.43])?;
    /// let width = |current| line.torque(current).std;
    /// assert!(width(1.5) < width(0.0));
    /// # Ok::<(), robot_model::calibrate::CalibrateError>(())
    /// ```
    #[must_use]
    pub fn torque(&self, current: f64) -> Measured {
        let value = self.gain.value * current + self.offset.value;
        let at_mean = self.residual_std / (self.samples as f64).sqrt();
        let std = at_mean.hypot(self.gain.std * (current - self.mean_current));
        let reach = self.quantile * std;
        Measured {
            value,
            std,
            interval: [value - reach, value + reach],
        }
    }
}

/// A coefficient times a factor.
fn term(fit: &Regression, place: usize, factor: f64) -> Term {
    let found = fit.of_white_errors(place);
    let std = factor.abs() * found.std;
    Term {
        value: Measured::new(factor * found.value, std, fit.freedom),
        p: fit.p_value(place),
    }
}

#[cfg(test)]
mod tests;

//! Velocities from positions, and what belongs to them.

use super::{CalibrateError, check};

/// Samples on each side of a window's middle.
///
/// The noise of a velocity falls with the length of its window, the samples that a switch of the voltage spoils grow with it.
pub const REACH: usize = 2;

/// A step longer than this many median steps is a gap.
const GAP: f64 = 5.0;

/// Means over windows of five samples, about each sample but the first and last two.
///
/// The mean velocity over a window is the difference of the positions at its ends over its length, without the error of a
/// differentiation. Channels that an equation puts beside it are averaged over the same windows (trapezoidal rule), so that what
/// holds at each instant holds for the means.
#[derive(Debug, Clone, PartialEq)]
pub struct Windows {
    logged: Vec<f64>,
    /// The middles, s.
    pub time: Vec<f64>,
    /// Mean velocities, rad/s or m/s.
    pub velocity: Vec<f64>,
}

impl Windows {
    /// Windows of a motion.
    ///
    /// # Errors
    /// [`CalibrateError`] for channels of different lengths, values that are not finite, fewer than five samples, time that does not
    /// rise or has a gap of more than five median steps.
    ///
    /// # Examples
    /// ```
    /// use robot_model::calibrate::Windows;
    /// let time: Vec<f64> = (0..8).map(f64::from).collect();
    /// let position: Vec<f64> = time.iter().map(|t| t * t).collect();
    /// let windows = Windows::new(&time, &position)?;
    /// assert_eq!(windows.time, [2.0, 3.0, 4.0, 5.0]);
    /// assert_eq!(windows.velocity, [4.0, 6.0, 8.0, 10.0]);
    /// assert_eq!(windows.means(&time), windows.time);
    /// # Ok::<(), robot_model::calibrate::CalibrateError>(())
    /// ```
    pub fn new(time: &[f64], position: &[f64]) -> Result<Self, CalibrateError> {
        check(&[time, position], 2 * REACH + 1)?;
        check_time(time)?;
        let middles = REACH..time.len() - REACH;
        let mean = |k: usize| {
            let (first, last) = (k - REACH, k + REACH);
            (position[last] - position[first]) / (time[last] - time[first])
        };
        Ok(Self {
            logged: time.to_vec(),
            time: time[middles.clone()].to_vec(),
            velocity: middles.map(mean).collect(),
        })
    }

    /// Samples of the motion.
    pub(super) fn logged(&self) -> usize {
        self.logged.len()
    }

    /// Means of a channel that has one value for each of the motion's samples.
    ///
    /// # Panics
    /// Where the channel is shorter than the motion.
    ///
    /// # Examples
    /// ```
    /// use robot_model::calibrate::Windows;
    /// // Over four steps about 2 s and 3 s: the integral of t^2 from 0 to 4 by trapezes is 22, from 1 to 5 it is 42.
    /// let time: Vec<f64> = (0..6).map(f64::from).collect();
    /// let squares: Vec<f64> = time.iter().map(|t| t * t).collect();
    /// assert_eq!(Windows::new(&time, &time)?.means(&squares), [22.0 / 4.0, 42.0 / 4.0]);
    /// # Ok::<(), robot_model::calibrate::CalibrateError>(())
    /// ```
    #[must_use]
    pub fn means(&self, channel: &[f64]) -> Vec<f64> {
        let time = &self.logged;
        let middles = REACH..time.len() - REACH;
        let mean = |k: usize| {
            let (first, last) = (k - REACH, k + REACH);
            let steps = first..last;
            let area = |k: usize| 0.5 * (channel[k] + channel[k + 1]) * (time[k + 1] - time[k]);
            steps.map(area).sum::<f64>() / (time[last] - time[first])
        };
        middles.map(mean).collect()
    }
}

/// Refuses time that does not rise or has a gap.
pub(super) fn check_time(time: &[f64]) -> Result<(), CalibrateError> {
    let steps: Vec<f64> = time.windows(2).map(|pair| pair[1] - pair[0]).collect();
    if let Some(k) = steps.iter().position(|step| *step <= 0.0) {
        return Err(CalibrateError::TimeOrder { sample: k + 1 });
    }
    let mut sorted = steps.clone();
    sorted.sort_unstable_by(f64::total_cmp);
    let median = sorted.get(sorted.len() / 2).copied().unwrap_or_default();
    match steps.iter().position(|step| *step > GAP * median) {
        Some(k) => Err(CalibrateError::Gap {
            sample: k + 1,
            steps: steps[k] / median,
        }),
        None => Ok(()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// `u + k q'` is constant wherever the sampling is not even.
    #[test]
    fn what_holds_at_each_instant_holds_for_the_means() {
        let time: Vec<f64> = (0..200)
            .map(|k| 0.01 * f64::from(k) + 0.003 * f64::from(k * k % 5) / 5.0)
            .collect();
        let position: Vec<f64> = time.iter().map(|t| (2.0 * t).sin()).collect();
        let drop: Vec<f64> = time.iter().map(|t| 4.0 - 3.0 * (2.0 * t).cos()).collect();
        let windows = Windows::new(&time, &position).expect("a motion");
        for (drop, velocity) in windows.means(&drop).iter().zip(&windows.velocity) {
            let v = drop + 1.5 * velocity;
            assert!((v - 4.0).abs() < 5e-4, "{v}");
        }
    }

    #[test]
    fn time_rises_without_gaps() {
        let position = [0.0; 6];
        let found = Windows::new(&[0.0, 1.0, 2.0, 2.0, 3.0, 4.0], &position);
        assert_eq!(found, Err(CalibrateError::TimeOrder { sample: 3 }));
        let found = Windows::new(&[0.0, 1.0, 2.0, 3.0, 9.0, 10.0], &position);
        let (sample, steps) = (4, 6.0);
        assert_eq!(found, Err(CalibrateError::Gap { sample, steps }));
    }
}

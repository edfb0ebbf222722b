//! The one filter that torque and regressor columns share.

use super::resample::whole_steps;
use super::{Bands, LowPass, SignalError};

/// Order per direction.
const ORDER: usize = 4;

/// Samples kept per second and per hertz of the band: twice the least that the band needs, as a filter is no wall.
const OVERSAMPLING: f64 = 4.0;

/// Length cut from either end, in periods of the cutoff. Every column has the same filter, so what is cut is not this
/// filter's own transient but that of the motion's filters and derivatives.
const BORDER_PERIODS: f64 = 1.0;

/// Samples cut from either end of columns at `rate_hz`.
pub(crate) fn border(bands: &Bands, rate_hz: f64) -> usize {
    whole_steps((BORDER_PERIODS * rate_hz / bands.shared_hz).round())
}

/// A zero-phase low-pass with decimation, for columns on a motion's grid: torque and every regressor column go through the
/// same one, after their nonlinear terms are formed.
#[derive(Debug, Clone, PartialEq)]
pub struct SharedFilter {
    low_pass: LowPass,
    border: usize,
    stride: usize,
}

impl SharedFilter {
    /// The filter of [`Bands::shared_hz`] for columns at `rate_hz`.
    ///
    /// # Errors
    /// [`SignalError::Cutoff`] where the band does not lie below half the rate.
    ///
    /// # Examples
    /// ```
    /// use robot_model::signal::{Bands, SharedFilter};
    /// let filter = SharedFilter::new(&Bands::for_rate(500.0), 500.0)?;
    /// let (torque, column) = (vec![3.0; 1000], vec![1.5; 1000]);
    /// let (mut filtered_torque, mut filtered_column) = (Vec::new(), Vec::new());
    /// filter.apply(&torque, &mut filtered_torque);
    /// filter.apply(&column, &mut filtered_column);
    /// assert_eq!(filtered_torque.len(), filter.kept(1000).len());
    /// assert!((filtered_torque[7] - 2.0 * filtered_column[7]).abs() < 1e-12);
    /// # Ok::<(), robot_model::signal::SignalError>(())
    /// ```
    pub fn new(bands: &Bands, rate_hz: f64) -> Result<Self, SignalError> {
        let low_pass = LowPass::butterworth(ORDER, bands.shared_hz, rate_hz)?;
        Ok(Self {
            low_pass,
            border: border(bands, rate_hz),
            stride: whole_steps(rate_hz / (OVERSAMPLING * bands.shared_hz) + 1e-3).max(1),
        })
    }

    /// Writes the kept samples of the filtered column to `out`, whose memory is used again.
    pub fn apply(&self, column: &[f64], out: &mut Vec<f64>) {
        self.low_pass.apply(column, out);
        for (to, from) in self.kept(column.len()).enumerate() {
            out[to] = out[from];
        }
        out.truncate(self.kept(column.len()).len());
    }

    /// Which samples of a column of `count` are kept; none where both ends take all.
    #[must_use]
    pub fn kept(&self, count: usize) -> impl ExactSizeIterator<Item = usize> + Clone + use<> {
        (self.border.min(count)..count.saturating_sub(self.border)).step_by(self.stride)
    }

    /// Samples cut from either end.
    #[must_use]
    pub fn border(&self) -> usize {
        self.border
    }

    /// One sample in so many is kept.
    #[must_use]
    pub fn stride(&self) -> usize {
        self.stride
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn kept_samples_are_those_of_the_filtered_column() {
        let rate = 500.0;
        let bands = Bands::for_rate(rate);
        let shared = SharedFilter::new(&bands, rate).expect("a band below half the rate");
        let column: Vec<f64> = (0..1234)
            .map(|k| (0.01 * f64::from(k * k % 613)).sin())
            .collect();
        let (mut whole, mut kept) = (Vec::new(), Vec::new());
        LowPass::butterworth(4, 10.0, rate)
            .expect("a band below half the rate")
            .apply(&column, &mut whole);
        shared.apply(&column, &mut kept);
        let expected: Vec<f64> = shared.kept(column.len()).map(|k| whole[k]).collect();
        assert_eq!(kept, expected);
        assert_eq!((shared.border(), shared.stride()), (50, 12));
        assert_eq!(
            (shared.kept(1234).next(), shared.kept(1234).last()),
            (Some(50), Some(1178))
        );
    }

    #[test]
    fn a_column_shorter_than_its_borders_keeps_nothing() {
        let shared =
            SharedFilter::new(&Bands::for_rate(500.0), 500.0).expect("a band below half the rate");
        let mut out = vec![1.0];
        for count in [0, 1, 49, 50, 99, 100] {
            shared.apply(&vec![1.0; count], &mut out);
            assert!(out.is_empty(), "{count}");
        }
    }
}

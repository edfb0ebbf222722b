//! The one filter that torque and regressor columns share.

use std::ops::Range;

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
    /// Samples of the column that are made up, with those that the filter spreads them over.
    holes: Vec<Range<usize>>,
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
    /// assert_eq!(filtered_torque.len(), filter.kept(1000).count());
    /// assert!((filtered_torque[7] - 2.0 * filtered_column[7]).abs() < 1e-12);
    /// # Ok::<(), robot_model::signal::SignalError>(())
    /// ```
    pub fn new(bands: &Bands, rate_hz: f64) -> Result<Self, SignalError> {
        let low_pass = LowPass::butterworth(ORDER, bands.shared_hz, rate_hz)?;
        Ok(Self {
            low_pass,
            border: border(bands, rate_hz),
            stride: whole_steps(rate_hz / (OVERSAMPLING * bands.shared_hz) + 1e-3).max(1),
            holes: Vec::new(),
        })
    }

    /// The same, which keeps no sample within a border's length of holes, given in samples.
    ///
    /// # Examples
    /// ```
    /// use robot_model::signal::{Bands, SharedFilter};
    /// let filter = SharedFilter::new(&Bands::for_rate(500.0), 500.0)?;
    /// let (stride, border) = (filter.stride(), filter.border());
    /// let all = filter.kept(3000).count();
    /// // Of 200 samples that are made up none is kept, nor of those beside them.
    /// let filter = filter.around([1400..1600]);
    /// let near = 1400 - border..1600 + border;
    /// assert!(filter.kept(3000).all(|k| !near.contains(&k)));
    /// assert!(all - filter.kept(3000).count() <= near.len() / stride + 1);
    /// # Ok::<(), robot_model::signal::SignalError>(())
    /// ```
    #[must_use]
    pub fn around(mut self, holes: impl IntoIterator<Item = Range<usize>>) -> Self {
        let border = self.border;
        let wide = |hole: Range<usize>| hole.start.saturating_sub(border)..hole.end + border;
        self.holes = holes.into_iter().map(wide).collect();
        self
    }

    /// The same with holes that are longer, by so many samples behind each.
    #[must_use]
    pub(crate) fn longer_holes(mut self, samples: usize) -> Self {
        for hole in &mut self.holes {
            hole.end += samples;
        }
        self
    }

    /// Writes the kept samples of the filtered column to `out`, whose memory is used again.
    ///
    /// # Examples
    /// ```
    /// use robot_model::signal::{Bands, SharedFilter};
    /// let bands = Bands { shared_hz: 10.0, ..Bands::for_rate(500.0) };
    /// let filter = SharedFilter::new(&bands, 500.0)?;
    /// let mut out = Vec::new();
    /// filter.apply(&[3.0; 1000], &mut out);
    /// // What is constant passes, and a tenth of a second is cut from either end.
    /// assert!(out.len() == filter.kept(1000).count() && out.iter().all(|x| (x - 3.0).abs() < 1e-9));
    /// # Ok::<(), robot_model::signal::SignalError>(())
    /// ```
    pub fn apply(&self, column: &[f64], out: &mut Vec<f64>) {
        self.low_pass.apply(column, out);
        let mut count = 0;
        for from in self.kept(column.len()) {
            out[count] = out[from];
            count += 1;
        }
        out.truncate(count);
    }

    /// Which samples of a column of `count` are kept; none where both ends or holes take all.
    ///
    /// # Examples
    /// ```
    /// use robot_model::signal::{Bands, SharedFilter};
    /// let bands = Bands { shared_hz: 10.0, ..Bands::for_rate(500.0) };
    /// let filter = SharedFilter::new(&bands, 500.0)?;
    /// // A tenth of a second is cut from either end; of the rest one sample in twelve is kept.
    /// assert_eq!(filter.kept(150).collect::<Vec<usize>>(), [50, 62, 74, 86, 98]);
    /// # Ok::<(), robot_model::signal::SignalError>(())
    /// ```
    pub fn kept(&self, count: usize) -> impl Iterator<Item = usize> + Clone {
        let inner = self.border.min(count)..count.saturating_sub(self.border);
        let is_sound = |k: &usize| !self.holes.iter().any(|hole| hole.contains(k));
        inner.step_by(self.stride).filter(is_sound)
    }

    /// Whether a sample of the column, or one between two, is left out because of a hole.
    pub(crate) fn is_in_hole(&self, sample: f64) -> bool {
        let holes = self.holes.iter();
        let mut spans = holes.map(|hole| hole.start as f64..hole.end as f64);
        spans.any(|span| span.contains(&sample))
    }

    /// Samples cut from either end.
    ///
    /// # Examples
    /// ```
    /// use robot_model::signal::{Bands, SharedFilter};
    /// let bands = Bands { shared_hz: 10.0, ..Bands::for_rate(500.0) };
    /// let filter = SharedFilter::new(&bands, 500.0)?;
    /// assert_eq!(filter.border(), 50); // one period of 10 Hz
    /// # Ok::<(), robot_model::signal::SignalError>(())
    /// ```
    #[must_use]
    pub fn border(&self) -> usize {
        self.border
    }

    /// One sample in so many is kept.
    ///
    /// # Examples
    /// ```
    /// use robot_model::signal::{Bands, SharedFilter};
    /// let bands = Bands { shared_hz: 10.0, ..Bands::for_rate(500.0) };
    /// let filter = SharedFilter::new(&bands, 500.0)?;
    /// assert_eq!(filter.stride(), 12); // of 500 Hz: four samples a period of 10 Hz, and more
    /// # Ok::<(), robot_model::signal::SignalError>(())
    /// ```
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

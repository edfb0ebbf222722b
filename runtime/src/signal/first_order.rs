//! The filter of the momentum form, `L(s) = w / (s + w)`, exactly discretized.

use super::SignalError;

/// A first-order low-pass `L(s) = w / (s + w)`: causal, unit gain at rest.
///
/// Exact for signals that are linear between samples (first-order hold): with `a = w h`, `e = exp(-a)` and
/// `f = (1 - e) / a`,
///
/// ```text
/// x[k + 1] = e x[k] + (f - e) u[k] + (1 - f) u[k + 1]
/// ```
///
/// A signal that bends between samples leaves an error of `(h^2 / 12) L{u''}`: a tone of angular frequency `v` comes out with
/// its amplitude off by `(v h)^2 / 12`.
///
/// # Examples
/// A step comes out as `1 - exp(-w t)`, to rounding.
/// ```
/// use robot_model::signal::FirstOrder;
/// let filter = FirstOrder::new(10.0, 1000.0)?;
/// let mut out = Vec::new();
/// filter.apply(0.0, &[1.0; 200], &mut out);
/// assert!((out[150] - (1.0 - f64::exp(-10.0 * 0.150))).abs() < 1e-13);
/// # Ok::<(), robot_model::signal::SignalError>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FirstOrder {
    corner: f64,
    /// Of the last output, of the last input, of this input.
    weights: [f64; 3],
}

impl FirstOrder {
    /// The filter with its corner at `corner` rad/s, for samples at `rate_hz`.
    ///
    /// # Errors
    /// [`SignalError::Cutoff`] where the corner is not between zero and half the rate.
    pub fn new(corner: f64, rate_hz: f64) -> Result<Self, SignalError> {
        let cutoff_hz = corner / std::f64::consts::TAU;
        if !(cutoff_hz > 0.0 && cutoff_hz < 0.5 * rate_hz && rate_hz.is_finite()) {
            return Err(SignalError::Cutoff { cutoff_hz, rate_hz });
        }
        let a = corner / rate_hz;
        let lost = -f64::exp_m1(-a);
        let mean = lost / a;
        let kept = 1.0 - lost;
        Ok(Self {
            corner,
            weights: [kept, mean - kept, 1.0 - mean],
        })
    }

    /// Corner of the filter, rad/s.
    #[must_use]
    pub fn corner(&self) -> f64 {
        self.corner
    }

    /// Writes `L{signal}`, which is `initial` at the first sample, to `out`, whose memory is used again.
    pub fn apply(&self, initial: f64, signal: &[f64], out: &mut Vec<f64>) {
        out.clear();
        let Some(&first) = signal.first() else {
            return;
        };
        out.reserve(signal.len());
        out.push(initial);
        let [kept, before, here] = self.weights;
        let (mut state, mut last) = (initial, first);
        for &value in &signal[1..] {
            state = kept * state + before * last + here * value;
            last = value;
            out.push(state);
        }
    }

    /// Writes `L{d signal/dt} = w (signal - L{signal})` to `out`, from zero: no derivative is taken.
    ///
    /// # Examples
    /// ```
    /// use robot_model::signal::FirstOrder;
    /// let filter = FirstOrder::new(10.0, 1000.0)?;
    /// let ramp: Vec<f64> = (0..200).map(|k| 7.0 + 3.0 * 0.001 * f64::from(k)).collect();
    /// let mut out = Vec::new();
    /// filter.apply_to_rate(&ramp, &mut out);
    /// assert!((out[150] - 3.0 * (1.0 - f64::exp(-10.0 * 0.150))).abs() < 1e-12);
    /// # Ok::<(), robot_model::signal::SignalError>(())
    /// ```
    pub fn apply_to_rate(&self, signal: &[f64], out: &mut Vec<f64>) {
        let first = signal.first().copied().unwrap_or(0.0);
        self.apply(first, signal, out);
        for (out, value) in out.iter_mut().zip(signal) {
            *out = self.corner * (value - *out);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// `L{u}` of `u = sin(v t)` from zero, solved by hand.
    fn filtered_sine(w: f64, v: f64, t: f64) -> f64 {
        let scale = w / (w * w + v * v);
        scale * (w * (v * t).sin() - v * (v * t).cos() + v * (-w * t).exp())
    }

    fn sines(v: f64, rate: f64) -> Vec<f64> {
        let count = super::super::resample::whole_steps(rate);
        (0..count).map(|k| (v * k as f64 / rate).sin()).collect()
    }

    #[test]
    fn a_tone_is_off_by_what_the_hold_says() {
        let (w, v) = (15.0, 40.0);
        let mut errors = [250.0, 500.0, 1000.0].map(|rate| {
            let mut out = Vec::new();
            FirstOrder::new(w, rate)
                .expect("a corner below half the rate")
                .apply(0.0, &sines(v, rate), &mut out);
            let at = |k: usize| filtered_sine(w, v, k as f64 / rate);
            let error = (0..out.len())
                .map(|k| (out[k] - at(k)).abs())
                .fold(0.0, f64::max);
            error * rate * rate
        });
        let gain = w / w.hypot(v);
        let told = gain * v * v / 12.0;
        for error in &mut errors {
            *error /= told;
        }
        // The transient of the error adds to its tone, hence up to twice.
        assert!(
            errors.iter().all(|ratio| (1.0..2.0).contains(ratio)),
            "{errors:?}"
        );
        assert!((errors[2] / errors[1] - 1.0).abs() < 0.05, "{errors:?}");
    }

    #[test]
    fn the_rate_of_a_signal_passes_without_a_derivative() {
        let (w, v, rate) = (15.0, 4.0, 2000.0);
        let signal: Vec<f64> = sines(v, rate).iter().map(|u| u + 3.0).collect();
        let mut out = Vec::new();
        let filter = FirstOrder::new(w, rate).expect("a corner below half the rate");
        filter.apply_to_rate(&signal, &mut out);
        for (k, found) in out.iter().enumerate() {
            let t = k as f64 / rate;
            let wanted = w * ((v * t).sin() - filtered_sine(w, v, t));
            assert!((found - wanted).abs() < 1e-5, "{k}: {found} and {wanted}");
        }
        assert!(out[0].abs() < f64::MIN_POSITIVE);
    }

    #[test]
    fn corners_that_do_not_fit_are_refused_and_nothing_gives_nothing() {
        for corner in [0.0, -1.0, f64::NAN, 3142.0] {
            assert!(FirstOrder::new(corner, 1000.0).is_err(), "{corner}");
        }
        let filter = FirstOrder::new(10.0, 1000.0).expect("a corner below half the rate");
        let mut out = vec![1.0];
        filter.apply(2.0, &[], &mut out);
        assert!(out.is_empty());
        filter.apply_to_rate(&[], &mut out);
        assert!(out.is_empty());
    }
}

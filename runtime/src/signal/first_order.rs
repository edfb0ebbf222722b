//! The filter of the momentum form, `L(s) = w / (s + w)`, exactly discretized.

use super::SignalError;

/// A first-order low-pass `L(s) = w / (s + w)`: unit gain at rest.
///
/// Exact for signals that between two samples are the cubic through the four nearest ones, at the ends through the last four:
/// with `a = w h`,
///
/// ```text
/// x[k + 1] = exp(-a) x[k] + int_0^1 a exp(-a (1 - s)) u(k + s) ds
/// ```
///
/// A tone of angular frequency `v` comes out with an error of order `(v h)^4 / 50`. A hold that is linear between samples would be
/// off by `(v h)^2 / 12` only, but by a phase of `v w h^2 / 12` where a rate is filtered (see [`Self::apply_to_rate`]), and a phase
/// of the torque of inertia looks like friction.
///
/// # Examples
/// A ramp comes out delayed by `1 / w`, to rounding.
/// ```
/// use robot_model::signal::FirstOrder;
/// let filter = FirstOrder::new(10.0, 1000.0)?;
/// let ramp: Vec<f64> = (0..200).map(|k| 0.001 * f64::from(k)).collect();
/// let mut out = Vec::new();
/// filter.apply(0.0, &ramp, &mut out);
/// let wanted = 0.150 - 0.1 * (1.0 - f64::exp(-10.0 * 0.150));
/// assert!((out[150] - wanted).abs() < 1e-13);
/// # Ok::<(), robot_model::signal::SignalError>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FirstOrder {
    corner: f64,
    /// Of the last output.
    kept: f64,
    /// Of four neighboring samples, for the first, the middle and the last of the intervals between them.
    weights: [[f64; 4]; 3],
    /// Of two samples, for signals of fewer than four.
    linear: [f64; 2],
}

impl FirstOrder {
    /// The filter with its corner at `corner` rad/s, for samples at `rate_hz`.
    ///
    /// # Errors
    /// [`SignalError::Corner`] where the corner is not between zero and half the rate.
    ///
    /// # Examples
    /// ```
    /// use robot_model::signal::FirstOrder;
    /// assert_eq!(FirstOrder::new(20.0, 500.0)?.corner(), 20.0);
    /// assert!(FirstOrder::new(2000.0, 500.0).is_err()); // beyond half the rate, 500 pi rad/s
    /// # Ok::<(), robot_model::signal::SignalError>(())
    /// ```
    pub fn new(corner: f64, rate_hz: f64) -> Result<Self, SignalError> {
        let largest = std::f64::consts::PI * rate_hz;
        if !(corner > 0.0 && corner < largest && rate_hz.is_finite()) {
            return Err(SignalError::Corner {
                corner,
                rate_hz,
                largest,
            });
        }
        let a = corner / rate_hz;
        let weight = |interval: usize, node: usize| {
            integral(|s| a * f64::exp(a * (s - 1.0)) * lagrange(node, s + interval as f64))
        };
        let linear = |node: usize| {
            let value = |s: f64| if node == 0 { 1.0 - s } else { s };
            integral(|s| a * f64::exp(a * (s - 1.0)) * value(s))
        };
        Ok(Self {
            corner,
            kept: f64::exp(-a),
            weights: [0, 1, 2].map(|interval| [0, 1, 2, 3].map(|node| weight(interval, node))),
            linear: [linear(0), linear(1)],
        })
    }

    /// Corner of the filter, rad/s.
    ///
    /// # Examples
    /// ```
    /// assert_eq!(robot_model::signal::FirstOrder::new(20.0, 500.0)?.corner(), 20.0);
    /// # Ok::<(), robot_model::signal::SignalError>(())
    /// ```
    #[must_use]
    pub fn corner(&self) -> f64 {
        self.corner
    }

    /// Writes `L{signal}`, which is `initial` at the first sample, to `out`, whose memory is used again.
    ///
    /// # Examples
    /// ```
    /// use robot_model::signal::FirstOrder;
    /// // A step from 0 to 1: what is left to go falls by exp(-w t), here over 0.1 s.
    /// let mut out = Vec::new();
    /// FirstOrder::new(10.0, 1000.0)?.apply(0.0, &[1.0; 101], &mut out);
    /// assert!((out[100] - (1.0 - (-1.0_f64).exp())).abs() < 1e-12);
    /// # Ok::<(), robot_model::signal::SignalError>(())
    /// ```
    pub fn apply(&self, initial: f64, signal: &[f64], out: &mut Vec<f64>) {
        out.clear();
        if signal.is_empty() {
            return;
        }
        out.reserve(signal.len());
        out.push(initial);
        let mut state = initial;
        for k in 0..signal.len() - 1 {
            let held = match signal.len() {
                0..4 => dot(&self.linear, &signal[k..]),
                count => {
                    // The four samples around the interval, as far as there are some on both sides.
                    let first = k.saturating_sub(1).min(count - 4);
                    dot(&self.weights[k - first], &signal[first..])
                }
            };
            state = self.kept * state + held;
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

/// The polynomial that is 1 at `node` of 0, 1, 2, 3 and 0 at the others.
fn lagrange(node: usize, s: f64) -> f64 {
    let others = (0..4).filter(|&other| other != node);
    others
        .map(|other| (s - other as f64) / (node as f64 - other as f64))
        .product()
}

/// Integral over 0 .. 1 of a cubic times an exponential of at most pi: three points of Gauss and Legendre on each of 64 parts
/// are exact to rounding.
fn integral(f: impl Fn(f64) -> f64) -> f64 {
    const PARTS: i32 = 64;
    let offset = 0.5 * 0.6_f64.sqrt();
    let points = [(0.5 - offset, 5.0), (0.5, 8.0), (0.5 + offset, 5.0)];
    let part = |k: i32| -> f64 {
        let at = |point: f64| (f64::from(k) + point) / f64::from(PARTS);
        points
            .iter()
            .map(|&(point, weight)| weight * f(at(point)))
            .sum()
    };
    (0..PARTS).map(part).sum::<f64>() / (18.0 * f64::from(PARTS))
}

fn dot(weights: &[f64], samples: &[f64]) -> f64 {
    weights.iter().zip(samples).map(|(w, u)| w * u).sum()
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
    fn a_tone_is_off_by_the_fourth_power_of_the_step() {
        let (w, v) = (15.0, 40.0);
        let errors = [250.0, 500.0, 1000.0].map(|rate: f64| {
            let mut out = Vec::new();
            FirstOrder::new(w, rate)
                .expect("a corner below half the rate")
                .apply(0.0, &sines(v, rate), &mut out);
            let at = |k: usize| filtered_sine(w, v, k as f64 / rate);
            let errors = (0..out.len()).map(|k| (out[k] - at(k)).abs());
            errors.fold(0.0, f64::max) / (v / rate).powi(4)
        });
        // The first and last intervals have their four samples on one side.
        assert!(errors.iter().all(|error| *error < 0.02), "{errors:?}");
    }

    #[test]
    fn cubics_are_exact_to_the_ends() {
        let (w, rate) = (300.0, 1000.0);
        let filter = FirstOrder::new(w, rate).expect("a corner below half the rate");
        for count in [4, 5, 30] {
            let time: Vec<f64> = (0..count).map(|k| f64::from(k) / rate).collect();
            let cubic: Vec<f64> = time.iter().map(|t| 1.0 + (40.0 * t).powi(3)).collect();
            let mut out = Vec::new();
            filter.apply(0.0, &cubic, &mut out);
            for (t, found) in time.iter().zip(out) {
                // dx/dt = w (u - x), x(0) = 0, by the polynomial and the exponential that solve it.
                let polynomial = |t: f64| {
                    1.0 + 64e3 * (t.powi(3) - 3.0 * t * t / w + 6.0 * t / (w * w) - 6.0 / w.powi(3))
                };
                let wanted = polynomial(*t) - polynomial(0.0) * (-w * t).exp();
                assert!(
                    (found - wanted).abs() < 1e-13,
                    "{count}: {found} and {wanted}"
                );
            }
        }
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
            assert!((found - wanted).abs() < 1e-10, "{k}: {found} and {wanted}");
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
        filter.apply(0.0, &[1.0; 3], &mut out);
        let step = |k: f64| 1.0 - (-0.01 * k).exp();
        for (k, found) in out.iter().enumerate() {
            assert!((found - step(k as f64)).abs() < 1e-15, "{out:?}");
        }
    }
}

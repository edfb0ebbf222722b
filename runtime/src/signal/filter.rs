//! Butterworth low-pass without phase.

use std::f64::consts::PI;

use super::SignalError;

/// A Butterworth low-pass that runs forward and backward over a signal: no phase, unit gain at rest, and twice the
/// attenuation of one pass: `1 / (1 + (f / cutoff)^(2 order))` of the amplitude, -6 dB at the cutoff (up to the frequency
/// warping of the bilinear transform, which leaves rest and cutoff in place).
///
/// Second-order sections by the bilinear transform; before filtering, the signal is continued at both ends by its reflection
/// through the end point, and the states start at rest on the first value (Gustafsson's problem in its common solution:
/// scipy's `sosfiltfilt`). Linear in the signal: what two signals share before the filter they share after it, ends included.
#[derive(Debug, Clone, PartialEq)]
pub struct LowPass {
    sections: Vec<Section>,
    padding: usize,
}

/// `gain (1 + z^-1)^2 / (1 + a1 z^-1 + a2 z^-2)`, unit gain at rest.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Section {
    gain: f64,
    a1: f64,
    a2: f64,
    /// State of the transposed direct form at rest on input 1.
    rest: [f64; 2],
}

impl LowPass {
    /// A low-pass of even `order` (per direction) with its half-power frequency at `cutoff_hz`, for samples at `rate_hz`.
    ///
    /// # Errors
    /// [`SignalError::Order`] and [`SignalError::Cutoff`], where there is no such filter.
    ///
    /// # Examples
    /// ```
    /// use robot_model::signal::LowPass;
    /// let filter = LowPass::butterworth(4, 10.0, 500.0)?;
    /// let mut filtered = Vec::new();
    /// filter.apply(&[2.5; 300], &mut filtered);
    /// assert!((filtered[0] - 2.5).abs() < 1e-12);
    /// assert!(LowPass::butterworth(4, 300.0, 500.0).is_err());
    /// # Ok::<(), robot_model::signal::SignalError>(())
    /// ```
    pub fn butterworth(order: usize, cutoff_hz: f64, rate_hz: f64) -> Result<Self, SignalError> {
        if order == 0 || !order.is_multiple_of(2) {
            return Err(SignalError::Order { order });
        }
        if !(cutoff_hz > 0.0 && cutoff_hz < 0.5 * rate_hz && rate_hz.is_finite()) {
            return Err(SignalError::Cutoff { cutoff_hz, rate_hz });
        }
        let warped = (PI * cutoff_hz / rate_hz).tan();
        let sections = (0..order / 2).map(|k| {
            // The pole pair at this angle from the negative real axis has damping cos(angle).
            let damping = (PI * (2 * k + 1) as f64 / (2 * order) as f64).cos();
            Section::new(warped, damping)
        });
        Ok(Self {
            sections: sections.collect(),
            padding: padding(order, cutoff_hz, rate_hz),
        })
    }

    /// Samples by which a signal is continued at both ends: two periods of the cutoff, in which the slowest pole decays to
    /// under a hundredth for the orders in use, and never fewer than three per coefficient.
    ///
    /// # Examples
    /// ```
    /// use robot_model::signal::LowPass;
    /// // Two periods of 10 Hz at 500 Hz.
    /// assert_eq!(LowPass::butterworth(4, 10.0, 500.0)?.padding(), 100);
    /// # Ok::<(), robot_model::signal::SignalError>(())
    /// ```
    #[must_use]
    pub fn padding(&self) -> usize {
        self.padding
    }

    /// Writes the filtered signal to `out`, whose memory is used again. Signals shorter than two samples come out as they are.
    ///
    /// # Examples
    /// What a zero-phase filter leaves of a wave at its cutoff is half, the half-power of both directions:
    /// ```
    /// use robot_model::signal::LowPass;
    /// let filter = LowPass::butterworth(4, 10.0, 500.0)?;
    /// let wave: Vec<f64> = (0..2000).map(|k| (std::f64::consts::TAU * 10.0 * 0.002 * f64::from(k)).sin()).collect();
    /// let mut filtered = Vec::new();
    /// filter.apply(&wave, &mut filtered);
    /// assert!((filtered[1000..1050].iter().copied().fold(0.0, f64::max) - 0.5).abs() < 0.01);
    /// # Ok::<(), robot_model::signal::SignalError>(())
    /// ```
    pub fn apply(&self, signal: &[f64], out: &mut Vec<f64>) {
        out.clear();
        let ([first, .., last] | [first @ last]) = signal else {
            return;
        };
        // A reflection cannot be longer than the signal.
        let padding = self.padding.min(signal.len() - 1);
        out.extend(
            signal[1..=padding]
                .iter()
                .rev()
                .map(|value| 2.0 * first - value),
        );
        out.extend_from_slice(signal);
        out.extend(
            signal[signal.len() - 1 - padding..signal.len() - 1]
                .iter()
                .rev()
                .map(|value| 2.0 * last - value),
        );
        self.pass(out);
        out.reverse();
        self.pass(out);
        out.reverse();
        out.copy_within(padding..padding + signal.len(), 0);
        out.truncate(signal.len());
    }

    /// One pass over samples, from rest on the first.
    fn pass(&self, samples: &mut [f64]) {
        let (pairs, rest) = self.sections.as_chunks::<2>();
        for pair in pairs {
            run(pair, samples);
        }
        for section in rest {
            run(&[*section], samples);
        }
    }
}

impl Section {
    /// `warped` is `tan(pi cutoff / rate)`; the analog prototype is `1 / (s^2 + 2 damping s + 1)`.
    fn new(warped: f64, damping: f64) -> Self {
        let square = warped * warped;
        let scale = 1.0 / (1.0 + 2.0 * damping * warped + square);
        let gain = square * scale;
        let a1 = 2.0 * (square - 1.0) * scale;
        let a2 = (1.0 - 2.0 * damping * warped + square) * scale;
        let rest2 = gain - a2;
        Self {
            gain,
            a1,
            a2,
            rest: [2.0 * gain - a1 + rest2, rest2],
        }
    }

    /// The next sample of the output, by the transposed direct form.
    fn step(&self, state: &mut [f64; 2], sample: f64) -> f64 {
        let input = self.gain * sample;
        let output = input + state[0];
        *state = [
            2.0 * input - self.a1 * output + state[1],
            input - self.a2 * output,
        ];
        output
    }
}

/// Sections one behind the other, in one pass. A sample waits for what the one before has left in a section: two sections wait at once.
fn run<const COUNT: usize>(sections: &[Section; COUNT], samples: &mut [f64]) {
    let first = samples[0];
    let mut states = sections.map(|section| section.rest.map(|rest| rest * first));
    for sample in samples {
        for (section, state) in sections.iter().zip(&mut states) {
            *sample = section.step(state, *sample);
        }
    }
}

/// Length of the continuation at either end, in samples.
fn padding(order: usize, cutoff_hz: f64, rate_hz: f64) -> usize {
    super::resample::whole_steps((2.0 * rate_hz / cutoff_hz).ceil()).max(3 * (order + 1))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn filtered(order: usize, cutoff_hz: f64, rate_hz: f64, signal: &[f64]) -> Vec<f64> {
        let mut out = Vec::new();
        LowPass::butterworth(order, cutoff_hz, rate_hz)
            .expect("a filter that exists")
            .apply(signal, &mut out);
        out
    }

    /// `scipy.signal.sosfiltfilt(butter(order, cutoff, fs=100, output='sos'), x, padlen=min(padding, 59))` (scipy 1.17.1)
    /// with `k = arange(60); x = sin(0.2 * k) + 0.3 * (k % 7)`, at the samples of `AT`.
    const GOLDEN: [(usize, f64, usize, [f64; 7]); 3] = [
        (
            4,
            10.0,
            20,
            [
                -0.002_769_842_622_464,
                0.582_447_955_460_754,
                1.106_600_430_329_916,
                0.407_626_815_886_919,
                0.598_003_513_471_762,
                0.072_583_832_127_006,
                0.204_050_342_366_766,
            ],
        ),
        (
            2,
            3.0,
            67,
            [
                8.444_813_075_219_6e-05,
                0.207_942_829_179_655,
                0.409_147_765_592_932,
                0.707_567_341_416_274,
                0.787_462_134_609_341,
                0.240_454_839_562_208,
                0.206_509_023_177_954,
            ],
        ),
        (
            8,
            20.0,
            27,
            [
                0.000_811_182_340_899,
                0.395_461_213_715_345,
                0.907_635_695_768_322,
                -0.238_092_285_031_742,
                0.080_279_072_795_388,
                -0.457_086_929_754_812,
                0.207_918_960_635_682,
            ],
        ),
    ];
    const AT: [usize; 7] = [0, 1, 2, 29, 30, 58, 59];

    #[test]
    fn agrees_with_scipy() {
        let signal: Vec<f64> = (0..60_u32)
            .map(|k| (0.2 * f64::from(k)).sin() + 0.3 * f64::from(k % 7))
            .collect();
        for (order, cutoff_hz, padding, expected) in GOLDEN {
            let filter =
                LowPass::butterworth(order, cutoff_hz, 100.0).expect("a filter that exists");
            assert_eq!(filter.padding(), padding);
            let out = filtered(order, cutoff_hz, 100.0, &signal);
            assert_eq!(out.len(), signal.len());
            for (at, expected) in AT.into_iter().zip(expected) {
                assert!(
                    (out[at] - expected).abs() < 1e-13,
                    "order {order}, sample {at}: {} against {expected}",
                    out[at]
                );
            }
        }
    }

    #[test]
    fn half_the_amplitude_is_left_at_the_cutoff() {
        let amplitude = |order: usize, hz: f64| {
            let w = 2.0 * PI * hz / 1000.0;
            let signal: Vec<f64> = (0..8000).map(|k| (w * f64::from(k)).sin()).collect();
            let out = filtered(order, 20.0, 1000.0, &signal);
            let inside = 2000..6000;
            2.0 * inside.clone().map(|k| out[k] * signal[k]).sum::<f64>() / inside.len() as f64
        };
        for order in [2, 4, 6] {
            assert!((amplitude(order, 20.0) - 0.5).abs() < 1e-6, "order {order}");
            assert!(amplitude(order, 1.0) > 1.0 - 1e-4, "order {order}");
        }
        // (80 / 20)^8, and a little for the warping.
        let stop = amplitude(4, 80.0) * 4.0_f64.powi(8);
        assert!((0.7..1.0).contains(&stop), "{stop}");
    }

    #[test]
    fn a_symmetric_pulse_stays_symmetric() {
        let mut signal = vec![0.0; 801];
        signal[395..=405].fill(1.0);
        let out = filtered(4, 20.0, 500.0, &signal);
        for k in 0..400 {
            assert!((out[k] - out[800 - k]).abs() < 1e-9, "sample {k}");
        }
        assert!(
            (out.iter().sum::<f64>() - 11.0).abs() < 1e-6,
            "the area is the gain at rest"
        );
        assert!(out[400] > out[399]);
    }

    #[test]
    fn lines_pass_untouched() {
        let signal: Vec<f64> = (0..200).map(|k| 4.0 - 0.03 * f64::from(k)).collect();
        for (found, expected) in filtered(4, 5.0, 100.0, &signal).iter().zip(&signal) {
            assert!((found - expected).abs() < 1e-3);
        }
        let constant = filtered(6, 5.0, 100.0, &[7.5; 50]);
        assert!(constant.iter().all(|value| (value - 7.5).abs() < 1e-12));
    }

    #[test]
    fn signals_shorter_than_the_padding_are_filtered_all_the_same() {
        for count in 0..8 {
            let signal: Vec<f64> = (0..count).map(f64::from).collect();
            let out = filtered(4, 1.0, 100.0, &signal);
            assert_eq!(out.len(), signal.len());
            assert!(out.iter().all(|value| value.is_finite()));
        }
        assert!((filtered(4, 1.0, 100.0, &[3.25])[0] - 3.25).abs() < 1e-12);
    }

    #[test]
    fn filters_that_do_not_exist_are_refused() {
        let text = |order, cutoff_hz, rate_hz| {
            LowPass::butterworth(order, cutoff_hz, rate_hz)
                .expect_err("must be refused")
                .to_string()
        };
        assert_eq!(
            text(3, 10.0, 100.0),
            "a Butterworth low-pass of order 3: the order must be even, and at least 2"
        );
        assert_eq!(
            text(0, 10.0, 100.0),
            "a Butterworth low-pass of order 0: the order must be even, and at least 2"
        );
        assert_eq!(
            text(4, 50.0, 100.0),
            "a low-pass at 50 Hz on samples at 100 Hz: the cutoff must lie between 0 and 50 Hz"
        );
        for (cutoff, rate) in [
            (0.0, 100.0),
            (-1.0, 100.0),
            (f64::NAN, 100.0),
            (1.0, f64::NAN),
            (1.0, f64::INFINITY),
        ] {
            assert!(
                LowPass::butterworth(4, cutoff, rate).is_err(),
                "{cutoff} Hz at {rate} Hz"
            );
        }
    }
}

//! A motor that turns while its voltage is logged.

use super::inductance::slopes;
use super::regression::Regression;
use super::statistics::{correlation, stands};
use super::windows::{REACH, check_time};
use super::{CalibrateError, Measured, check};

/// Fewest samples.
const LEAST: usize = 16;

/// Samples between one and its instruments: windows of velocities share no position that far apart.
const AWAY: usize = 2 * REACH + 1;

/// `voltage = resistance * current + back_emf * velocity + offset`, by least squares; where noise of the current or of the velocity makes
/// these too small, by instruments: `resistance` and `back_emf` of means of the samples five before and five after, which do not know of a
/// sample's noise. That it does is seen where both differ by more than three deviations of their difference (Durbin, Wu, Hausman).
///
/// The voltage of the inductance, `L di/dt`, is left out: what it makes of the values is in [`Self::by_time_constant`], and a current
/// [`with_inductance`](super::with_inductance) has it. Deviations are those of errors that are alike from sample to sample: `n` times the spectral density at frequency zero of
/// what each sample moves the estimate by (Newey & West 1987; den Haan & Levin 1997).
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct MotorVoltage {
    /// Of the winding and what lies before it, ohm.
    pub resistance: Measured,
    /// V s/rad, or V s/m: of the velocity that was given, a motor's or a joint's.
    pub back_emf: Measured,
    /// V.
    pub offset: Measured,
    /// By which share resistance and back-EMF are too large for each second of the winding's electric time constant; none where the current
    /// tells nothing of its slopes.
    pub by_time_constant: Option<[f64; 2]>,
    /// Resistance, back-EMF and offset by least squares, where those above are by instruments.
    pub least_squares: Option<[f64; 3]>,
    /// Standard deviation of the voltage that is left, V.
    pub residual_std: f64,
    /// Correlation of current and velocity: near 1 or -1 they are hardly told apart.
    pub alike: f64,
    /// Samples.
    pub samples: usize,
    /// The voltage of the equation, V, one a sample.
    pub fitted: Vec<f64>,
}

impl MotorVoltage {
    /// From time (s), current (A), velocity (rad/s) and voltage (V), `[sample]`; where the velocity is that of
    /// [`Windows`](super::Windows), the others are means over the same.
    ///
    /// # Errors
    /// [`CalibrateError`] for channels of different lengths, values that are not finite, fewer than 16 samples, time that does not rise or has
    /// a gap, a current or a velocity that does not vary, both in proportion.
    ///
    /// # Examples
    /// ```
    /// use robot_model::calibrate::MotorVoltage;
    /// let time: Vec<f64> = (0..100).map(|k| 0.01 * f64::from(k)).collect();
    /// let current: Vec<f64> = (0..100).map(|k| (0.3 * f64::from(k)).sin()).collect();
    /// let velocity: Vec<f64> = (0..100).map(|k| 5.0 * (0.11 * f64::from(k)).cos()).collect();
    /// let pairs = current.iter().zip(&velocity);
    /// let voltage: Vec<f64> = pairs.map(|(i, w)| 2.0 * i + 0.05 * w + 0.1).collect();
    /// let motor = MotorVoltage::fit(&time, &current, &velocity, &voltage)?;
    /// assert!((motor.resistance.value - 2.0).abs() < 1e-12);
    /// assert!((motor.back_emf.value - 0.05).abs() < 1e-12);
    /// # Ok::<(), robot_model::calibrate::CalibrateError>(())
    /// ```
    pub fn fit(
        time: &[f64],
        current: &[f64],
        velocity: &[f64],
        voltage: &[f64],
    ) -> Result<Self, CalibrateError> {
        check(&[time, current, velocity, voltage], LEAST)?;
        check_time(time)?;
        vary(current, velocity)?;
        let ones = vec![1.0; current.len()];
        let columns: [&[f64]; 3] = [current, velocity, &ones];
        let kept = away_from_switches(voltage);
        let some = |channel: &[f64]| -> Vec<f64> { kept.iter().map(|&k| channel[k]).collect() };
        let own = columns.map(some);
        let own = own.each_ref().map(Vec::as_slice);
        let all = Regression::new(&own, &some(voltage)).ok_or(CalibrateError::NotApart)?;
        let slopes = slopes(time, current);
        let [instrumented, by_instruments] = by_neighbors(&columns, [voltage, &slopes], &kept);
        let is_instrumented = instrumented.is_some();
        let (fit, of_slopes) = match instrumented {
            Some(fit) => (fit, by_instruments),
            None => (all.clone(), Regression::new(&own, &some(&slopes))),
        };
        // What is left out by what is not: the error of each value.
        let by_time_constant = of_slopes.map(|slopes| {
            let [resistance, back_emf] = [fit.values[0], fit.values[1]];
            [slopes.values[0], resistance * slopes.values[1] / back_emf]
        });
        let fitted = |k: usize| {
            let terms = columns.iter().zip(&fit.values);
            terms.map(|(column, value)| column[k] * value).sum()
        };
        Ok(Self {
            by_time_constant,
            resistance: fit.of_correlated_errors(0),
            back_emf: fit.of_correlated_errors(1),
            offset: fit.of_correlated_errors(2),
            least_squares: is_instrumented.then(|| [all.values[0], all.values[1], all.values[2]]),
            residual_std: fit.residual_std(),
            alike: correlation(current, velocity),
            samples: fit.residuals.len(),
            fitted: (0..current.len()).map(fitted).collect(),
        })
    }
}

/// A switch of the voltage: a step from one sample to the next of so many middle ones, and of such a share of its range.
const SWITCH: f64 = 10.0;
const WIDE: f64 = 0.05;

/// Samples that are beside no switch of the voltage, nor one behind it: there a current, or its slope, is of either side of it; all where there
/// would be too few.
fn away_from_switches(voltage: &[f64]) -> Vec<usize> {
    let steps: Vec<f64> = voltage
        .windows(2)
        .map(|pair| (pair[1] - pair[0]).abs())
        .collect();
    let mut sorted = steps.clone();
    sorted.sort_unstable_by(f64::total_cmp);
    let (low, high) = voltage
        .iter()
        .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), v| {
            (low.min(*v), high.max(*v))
        });
    let least = (SWITCH * sorted[sorted.len() / 2]).max(WIDE * (high - low));
    let is_beside = |k: usize| {
        let mut beside = [k.checked_sub(2), k.checked_sub(1), Some(k)]
            .into_iter()
            .flatten();
        beside.any(|step| steps.get(step).is_some_and(|step| *step > least))
    };
    let kept: Vec<usize> = (0..voltage.len()).filter(|&k| !is_beside(k)).collect();
    if kept.len() < LEAST {
        return (0..voltage.len()).collect();
    }
    kept
}

/// By instruments, where least squares on the same samples, some of the `kept` ones, finds another resistance or back-EMF; and slopes of the
/// current by the same.
fn by_neighbors(
    columns: &[&[f64]; 3],
    [voltage, slopes]: [&[f64]; 2],
    kept: &[usize],
) -> [Option<Regression>; 2] {
    let inside = AWAY..voltage.len().saturating_sub(AWAY);
    let samples = kept.iter().copied().filter(|k| inside.contains(k));
    let samples: Vec<usize> = samples.collect();
    if samples.len() < LEAST {
        return [None, None];
    }
    let some = |channel: &[f64]| -> Vec<f64> { samples.iter().map(|&k| channel[k]).collect() };
    let mean = |column: &[f64], k: usize| 0.5 * (column[k - AWAY] + column[k + AWAY]);
    let instruments: [Vec<f64>; 3] =
        columns.map(|column| samples.iter().map(|&k| mean(column, k)).collect());
    let instruments = instruments.each_ref().map(Vec::as_slice);
    let columns = columns.map(some);
    let columns = columns.each_ref().map(Vec::as_slice);
    let [voltage, slopes] = [voltage, slopes].map(some);
    let by_instruments =
        |target: &[f64]| Regression::by_instruments(&columns, &instruments, target);
    let least_squares = Regression::new(&columns, &voltage);
    let found = by_instruments(&voltage).filter(|found| {
        let is_another = |own: Regression| own.is_another(0, found) || own.is_another(1, found);
        least_squares.is_some_and(is_another)
    });
    [found, by_instruments(&slopes)]
}

/// Refuses a current or a velocity that does not vary.
pub(super) fn vary(current: &[f64], velocity: &[f64]) -> Result<(), CalibrateError> {
    let refused = |what, mend| Err(CalibrateError::Stands { what, mend });
    if stands(current) {
        return refused("current", "let the motor speed up and slow down");
    }
    if stands(velocity) {
        return refused("velocity", "let the motor turn, and speed up and slow down");
    }
    Ok(())
}

#[cfg(test)]
mod tests;

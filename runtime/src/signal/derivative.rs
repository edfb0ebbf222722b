//! Differentiation of uniform samples.

/// Writes the time derivative of `signal`, sampled at steps of `step` seconds, to `out`.
///
/// Central differences over five points, whose amplitude is right to `(w step)^4 / 30` at angular frequency `w`; over three
/// points beside the ends, and one-sided of second order at the ends. Signals of fewer than three samples have derivative 0.
///
/// # Examples
/// ```
/// let signal: Vec<f64> = (0..50).map(|k| (0.1 * f64::from(k)).sin()).collect();
/// let mut rate = Vec::new();
/// robot_model::signal::derivative(&signal, 0.1, &mut rate);
/// assert!((rate[20] - 2.0_f64.cos()).abs() < 4e-6);
/// ```
pub fn derivative(signal: &[f64], step: f64, out: &mut Vec<f64>) {
    out.clear();
    let count = signal.len();
    let [first, second, third, ..] = *signal else {
        out.resize(count, 0.0);
        return;
    };
    let per_step = 1.0 / step;
    let three = |w: &[f64]| 0.5 * per_step * (w[2] - w[0]);
    let five = |w: &[f64]| per_step / 12.0 * (8.0 * (w[3] - w[1]) - (w[4] - w[0]));
    out.push(0.5 * per_step * (4.0 * second - 3.0 * first - third));
    out.push(three(&signal[..3]));
    out.extend(signal.windows(5).map(five));
    if count > 3 {
        out.push(three(&signal[count - 3..]));
    }
    let [third, second, first] = [signal[count - 3], signal[count - 2], signal[count - 1]];
    out.push(0.5 * per_step * (3.0 * first - 4.0 * second + third));
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of(signal: &[f64], step: f64) -> Vec<f64> {
        let mut out = Vec::new();
        derivative(signal, step, &mut out);
        out
    }

    #[test]
    fn parabolas_are_exact_everywhere() {
        for count in 3..12 {
            let time: Vec<f64> = (0..count).map(|k| 0.3 * f64::from(k)).collect();
            let signal: Vec<f64> = time.iter().map(|t| 2.0 - t + 4.0 * t * t).collect();
            let out = of(&signal, 0.3);
            assert_eq!(out.len(), signal.len());
            for (t, rate) in time.iter().zip(out) {
                assert!(
                    (rate - (8.0 * t - 1.0)).abs() < 1e-11,
                    "{count} samples, t = {t}: {rate}"
                );
            }
        }
    }

    #[test]
    fn the_inside_is_of_fourth_order() {
        let step = 0.01;
        let signal: Vec<f64> = (0..400)
            .map(|k| (12.0 * step * f64::from(k)).sin())
            .collect();
        let out = of(&signal, step);
        let worst = (2..398)
            .map(|k| (out[k] - 12.0 * (12.0 * step * k as f64).cos()).abs())
            .fold(0.0, f64::max);
        let bound = 12.0 * 0.12_f64.powi(4) / 30.0;
        assert!(
            worst <= bound && worst > 0.9 * bound,
            "{worst} against {bound}"
        );
    }

    #[test]
    fn short_signals_stand_still() {
        assert_eq!(of(&[], 1.0), []);
        assert_eq!(of(&[3.0], 1.0), [0.0]);
        assert_eq!(of(&[3.0, 5.0], 1.0), [0.0, 0.0]);
    }
}

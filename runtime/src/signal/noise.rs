//! Noise of positions, and how much of an acceleration it is.

use std::f64::consts::TAU;

use super::{Bands, Prepared};

/// Of the motion's filters, and of the shared one.
const ORDER: i32 = 4;

/// The median size of a normal number of deviation 1.
pub(crate) const MEDIAN_OF_NORMAL: f64 = 0.6745;

/// Which share of the power of each joint's acceleration, within the band that least squares sees, is noise of its position: a parameter of
/// that acceleration alone comes out too small by it. 1 where there is nothing but noise, 0 of a joint that stands still exactly; none where the
/// wide band is no wider than the smooth one, so that nothing tells the noise.
///
/// White noise of density `S` in a position has the density `(2 pi f)^2 S` in its velocity and `(2 pi f)^4 S` in its acceleration. What the
/// velocity has above the smooth band and below the wide one, about `(2 pi)^2 S (wide^3 - smooth^3) / 3` but for the slopes of the filters,
/// says `S`, and that about `(2 pi)^4 S shared^5 / 5` below the shared one. Medians, as a motion may reach beyond the smooth band for moments.
///
/// # Examples
/// A swing by 0.3 rad, with encoders of 12 and of 20 bits a turn:
/// ```
/// use robot_model::{log::Log, signal::{Bands, acceleration_noise, prepare}};
/// let time: Vec<f64> = (0..5000).map(|k| 0.004 * f64::from(k)).collect();
/// let share = |bits: i32| -> Result<f64, Box<dyn std::error::Error>> {
///     let step = std::f64::consts::TAU / 2.0_f64.powi(bits);
///     let q = time.iter().map(|t| (0.3 * (1.3 * t).sin() / step).round() * step);
///     let log = Log::from_samples("a joint", time.clone(), vec![q.collect()], vec![vec![0.0; 5000]])?;
///     let bands = Bands::for_log(&log);
///     Ok(acceleration_noise(&prepare(&log, &bands)?, &bands).expect("two bands")[0])
/// };
/// assert!(share(12)? > 0.1 && share(20)? < 0.001);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[must_use]
pub fn acceleration_noise(prepared: &Prepared, bands: &Bands) -> Option<Vec<f64>> {
    let densities = position_noise(prepared, bands)?;
    let within = power(bands.wide_hz, 4, |hz| {
        passed(hz, bands.smooth_hz) * passed(hz, bands.shared_hz)
    });
    let joints = prepared.motion.smooth.ddq.iter().zip(densities);
    let shares = joints.map(|(ddq, density)| {
        let mut filtered = Vec::new();
        prepared.shared.apply(ddq, &mut filtered);
        share(density * within, &filtered)
    });
    Some(shares.collect())
}

/// The same of each joint's acceleration as it is, within the smooth band.
pub(crate) fn raw_acceleration_noise(prepared: &Prepared, bands: &Bands) -> Option<Vec<f64>> {
    let densities = position_noise(prepared, bands)?;
    let within = power(bands.smooth_hz, 4, |hz| passed(hz, bands.smooth_hz));
    let joints = prepared.motion.smooth.ddq.iter().zip(densities);
    let shares = joints.map(|(ddq, density)| share(density * within, ddq));
    Some(shares.collect())
}

/// The share of a signal's power that is noise of this power; none of a signal of zeros.
fn share(noise: f64, signal: &[f64]) -> f64 {
    let power = signal.iter().map(|x| x * x).sum::<f64>() / signal.len().max(1) as f64;
    if power > 0.0 {
        (noise / power).min(1.0)
    } else {
        0.0
    }
}

/// Density of the noise of each joint's position, `S` of [`acceleration_noise`], rad^2/Hz or m^2/Hz; none where nothing tells it.
pub(crate) fn position_noise(prepared: &Prepared, bands: &Bands) -> Option<Vec<f64>> {
    if bands.wide_hz <= bands.smooth_hz {
        return None;
    }
    let between = power(bands.wide_hz, 2, |hz| {
        passed(hz, bands.wide_hz) - passed(hz, bands.smooth_hz)
    });
    let (wide, smooth) = (&prepared.motion.wide, &prepared.motion.smooth);
    let joints = smooth.dq.iter().zip(&wide.dq);
    let densities = joints.map(|(dq, faster)| {
        let mut rest: Vec<f64> = dq.iter().zip(faster).map(|(x, y)| (x - y).abs()).collect();
        rest.sort_unstable_by(f64::total_cmp);
        let median = rest.get(rest.len() / 2).copied().unwrap_or_default();
        let velocity = (median / MEDIAN_OF_NORMAL).powi(2);
        velocity / between
    });
    Some(densities.collect())
}

/// Deviation of a signal's white noise, from third differences, in which motion is nothing.
pub(crate) fn white_noise(values: &[f64]) -> f64 {
    let third = values.windows(4).map(|x| x[3] - 3.0 * (x[2] - x[1]) - x[0]);
    let count = values.len().saturating_sub(3).max(1) as f64;
    (third.map(|x| x * x).sum::<f64>() / (20.0 * count)).sqrt()
}

/// What the motion's filters, there and back, leave of a wave.
fn passed(hz: f64, cutoff_hz: f64) -> f64 {
    1.0 / (1.0 + (hz / cutoff_hz).powi(2 * ORDER))
}

/// Power of a derivative of white noise of density 1 behind a filter of this gain, whose waves are of about `hz`: the integral of
/// `gain^2 (2 pi f)^order`.
fn power(hz: f64, order: i32, gain: impl Fn(f64) -> f64) -> f64 {
    // Behind four times that frequency a millionth is left.
    let step = hz / 200.0;
    let waves = (0..800).map(|k| (f64::from(k) + 0.5) * step);
    let density = |hz: f64| gain(hz).powi(2) * (TAU * hz).powi(order);
    step * waves.map(density).sum::<f64>()
}

#[cfg(test)]
mod tests {
    use rand::SeedableRng;
    use rand_chacha::ChaCha8Rng;
    use rand_distr::{Distribution, Normal};

    use super::*;
    use crate::log::Log;
    use crate::signal::prepare;

    /// Least squares of a torque `ddq` on a noisy acceleration is small by the share that is told.
    #[test]
    fn an_inertia_is_too_small_by_the_noise_of_accelerations() {
        let time: Vec<f64> = (0..20_000).map(|k| 0.002 * f64::from(k)).collect();
        let mut random = ChaCha8Rng::seed_from_u64(1);
        for deviation in [1e-5, 3e-4, 1e-3] {
            let normal = Normal::new(0.0, deviation).expect("a deviation");
            let swing = |t: f64| 0.2 * (1.7 * t).sin();
            let q = time.iter().map(|&t| swing(t) + normal.sample(&mut random));
            let tau = time.iter().map(|&t| -1.7 * 1.7 * swing(t));
            let log = Log::from_samples(
                "a joint",
                time.clone(),
                vec![q.collect()],
                vec![tau.collect()],
            );
            let log = log.expect("a sound log");
            let bands = Bands::for_log(&log);
            let prepared = prepare(&log, &bands).expect("a long log");
            let told = acceleration_noise(&prepared, &bands).expect("two bands")[0];
            let [mut ddq, mut tau] = [Vec::new(), Vec::new()];
            prepared
                .shared
                .apply(&prepared.motion.smooth.ddq[0], &mut ddq);
            prepared.shared.apply(&prepared.tau[0], &mut tau);
            let both: f64 = ddq.iter().zip(&tau).map(|(x, y)| x * y).sum();
            let own: f64 = ddq.iter().map(|x| x * x).sum();
            let short = 1.0 - both / own;
            assert!(
                told > 0.6 * short - 1e-3 && told < 1.6 * short + 1e-3,
                "{deviation}: {told} told, {short} missing"
            );
        }
    }

    #[test]
    fn without_a_band_beyond_the_smooth_one_noise_is_not_known() {
        let time: Vec<f64> = (0..2000).map(|k| 0.004 * f64::from(k)).collect();
        let q = time.iter().map(|t| (1.3 * t).sin()).collect();
        let log = Log::from_samples("a joint", time, vec![q], vec![vec![0.0; 2000]]);
        let bands = Bands {
            wide_hz: Bands::DEFAULT.smooth_hz,
            ..Bands::DEFAULT
        };
        let prepared = prepare(&log.expect("samples"), &bands).expect("bands below the rate");
        assert_eq!(acceleration_noise(&prepared, &bands), None);
    }
}

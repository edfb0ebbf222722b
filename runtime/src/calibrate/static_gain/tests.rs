use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, StandardNormal};

use super::*;

/// Anscombe 1973: two sets with one line, the second of which is a parabola; by rising `x`.
const X: [f64; 11] = [4.0, 5.0, 6.0, 7.0, 8.0, 9.0, 10.0, 11.0, 12.0, 13.0, 14.0];
const FIRST: [f64; 11] = [
    4.26, 5.68, 7.24, 4.82, 6.95, 8.81, 8.04, 8.33, 10.84, 7.58, 9.96,
];
const SECOND: [f64; 11] = [
    3.10, 4.74, 6.13, 7.26, 8.14, 8.77, 9.14, 9.26, 9.13, 8.74, 8.10,
];

fn close(found: f64, wanted: f64, tolerance: f64) {
    assert!((found - wanted).abs() <= tolerance, "{found} {wanted}");
}

/// The figures that textbooks print of it.
#[test]
fn the_line_of_anscombe() {
    let line = StaticGain::fit(&X, &FIRST).expect("a line");
    close(line.gain.value, 0.5001, 5e-5);
    close(line.gain.std, 0.1179, 5e-5);
    close(line.offset.value, 3.0001, 5e-5);
    close(line.offset.std, 1.1247, 5e-5);
    close(line.r, 0.8164, 5e-5);
    close(line.residual_std, 1.2366, 5e-5);
    // t(0.975, 9) = 2.26216.
    close(line.gain.interval[0], 0.5001 - 2.26216 * 0.1179, 2e-4);
    let bend = line.curvature.expect("eleven currents");
    assert!(!bend.is_told(), "{bend:?}");
    assert_eq!(line.hysteresis, None);
    // The line goes through the mean, where it is known best.
    close(line.torque(9.0).value, 7.5009, 5e-5);
    close(line.torque(9.0).std, 1.2366 / 11.0_f64.sqrt(), 5e-5);
    close(line.torque(0.0).std, line.offset.std, 1e-9);
}

#[test]
fn a_parabola_is_no_line() {
    let line = StaticGain::fit(&X, &SECOND).expect("a line");
    close(line.gain.value, 0.5, 5e-4);
    let bend = line.curvature.expect("eleven currents");
    close(bend.value.value, -0.126_71, 5e-5);
    assert!(bend.is_told() && bend.p < 1e-12, "{bend:?}");
}

/// A line without errors has no bend and no hysteresis, whatever rounding leaves.
#[test]
fn exact_points() {
    let current = [-0.3, 0.1, 0.7, 1.3, 0.9, 0.2, -0.1];
    let torque = current.map(|i| 0.1132 * i + 0.37);
    let line = StaticGain::fit(&current, &torque).expect("a line");
    close(line.gain.value, 0.1132, 1e-14);
    close(line.r, 1.0, 1e-12);
    assert!(!line.curvature.expect("enough").is_told());
    assert!(!line.hysteresis.expect("both ways").difference.is_told());
    let bent = current.map(|i: f64| 0.1132 * i - 0.01 * i * i.abs());
    let line = StaticGain::fit(&current, &bent).expect("a line");
    let bend = line.curvature.expect("enough");
    close(bend.value.value, -0.01, 1e-12);
    assert!(bend.is_told());
    assert!(!line.hysteresis.expect("both ways").difference.is_told());
}

/// Up and down in steps of 0.5 A, with friction of a gear.
fn ramp(gain: f64, friction: f64, noise: f64, seed: u64) -> (Vec<f64>, Vec<f64>) {
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    let up = (0..8).map(|k| 0.5 * f64::from(k));
    // The last level of rising currents is read twice.
    let current: Vec<f64> = up.clone().chain(up.rev()).collect();
    let way = |k: usize| if k < 9 { 1.0 } else { -1.0 };
    let torque = (0..16).map(|k| {
        let error: f64 = StandardNormal.sample(&mut random);
        gain * current[k] - gain.signum() * friction * way(k) + noise * error
    });
    let torque = torque.collect();
    (current, torque)
}

#[test]
fn half_of_hysteresis_is_friction() {
    for gain in [0.8, -0.8] {
        let (current, torque) = ramp(gain, 0.1, 0.02, 1);
        let line = StaticGain::fit(&current, &torque).expect("a line");
        // The way that has more points pulls at the line.
        close(line.gain.value, gain, 0.06);
        close(line.best().value, gain, 4.0 * line.best().std);
        assert!(line.best().std < 0.006 && line.gain.std > 0.02);
        let found = line.hysteresis.expect("both ways");
        assert_eq!((found.rising, found.falling), (9, 7));
        assert!(found.difference.is_told());
        let difference = found.difference.value;
        close(difference.value, 0.2 * gain.signum(), 4.0 * difference.std);
        assert!(difference.std < 0.015, "{difference:?}");
        close(found.friction, 0.1, 2.0 * difference.std);
    }
}

/// Intervals hold what they say, and what is not there is found as often as the tests say.
#[test]
fn intervals_and_tests_are_right_as_often_as_they_say() {
    const DRAWS: u32 = 600;
    let (mut held, mut bent, mut split) = (0, 0, 0);
    for seed in 0..DRAWS {
        let (current, torque) = ramp(0.8, 0.0, 0.05, u64::from(seed));
        let line = StaticGain::fit(&current, &torque).expect("a line");
        let [low, high] = line.gain.interval;
        held += u32::from(low <= 0.8 && 0.8 <= high);
        bent += u32::from(line.curvature.expect("enough").is_told());
        let hysteresis = line.hysteresis.expect("both ways");
        split += u32::from(hysteresis.difference.is_told());
    }
    let share = |count: u32| f64::from(count) / f64::from(DRAWS);
    close(share(held), 0.95, 0.025);
    close(share(bent), 0.05, 0.025);
    close(share(split), 0.05, 0.025);
}

#[test]
fn what_is_no_line_is_refused() {
    let fit = StaticGain::fit;
    let error = fit(&[1.0, 2.0], &[1.0, 2.0]).unwrap_err();
    let (samples, least) = (2, 3);
    assert_eq!(error, CalibrateError::TooFew { samples, least });
    let error = fit(&[1.0, 2.0, 3.0], &[1.0, 2.0]).unwrap_err();
    assert_eq!(error, CalibrateError::Lengths);
    let error = fit(&[0.3; 5], &[1.0, 2.0, 3.0, 4.0, 5.0]).unwrap_err();
    assert!(error.to_string().contains("several currents"), "{error}");
    // Two currents have a line, and no bend.
    let line = fit(&[0.0, 1.0, 0.0, 1.0], &[0.0, 1.1, 0.1, 1.0]).expect("a line");
    assert_eq!(line.curvature, None);
    // A torque that stands has a line, and no correlation.
    let line = fit(&[0.0, 1.0, 2.0], &[3.0; 3]).expect("a line");
    close(line.r, 0.0, 0.0);
    assert!(line.curvature.is_none());
}

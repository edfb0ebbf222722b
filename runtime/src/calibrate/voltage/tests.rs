use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, StandardNormal};

use super::*;
use crate::calibrate::{Commanded, with_inductance};

const TRUTH: [f64; 3] = [1.7, 0.045, 0.2];

/// 15 s at 100 Hz.
fn times() -> Vec<f64> {
    (0..1500).map(|k| 0.01 * f64::from(k)).collect()
}

/// A motor that swings slowly, with noise that stays alike over some ten samples.
fn log(noise: f64, seed: u64) -> [Vec<f64>; 3] {
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    let mut error = 0.0;
    let time = (0..1500).map(|k| 0.01 * f64::from(k));
    let current: Vec<f64> = time
        .clone()
        .map(|t| (2.1 * t).sin() + 0.3 * (5.3 * t).cos())
        .collect();
    let velocity: Vec<f64> = time.map(|t| 30.0 * (1.2 * t).sin()).collect();
    let pairs = current.iter().zip(&velocity);
    let voltage = pairs.map(|(i, w)| {
        let white: f64 = StandardNormal.sample(&mut random);
        error = 0.9 * error + noise * white;
        TRUTH[0] * i + TRUTH[1] * w + TRUTH[2] + error
    });
    let voltage = voltage.collect();
    [current, velocity, voltage]
}

#[test]
fn a_motor_without_noise_is_found() {
    let [current, velocity, voltage] = log(0.0, 1);
    let found = MotorVoltage::fit(&times(), &current, &velocity, &voltage).expect("a motor");
    let values = [found.resistance, found.back_emf, found.offset];
    for (value, truth) in values.into_iter().zip(TRUTH) {
        assert!((value.value - truth).abs() < 1e-12, "{value:?}");
    }
    for (fitted, logged) in found.fitted.iter().zip(&voltage) {
        assert!((fitted - logged).abs() < 1e-12);
    }
}

/// Intervals that took this noise for white would hold the offset in 35 % of the draws.
#[test]
fn intervals_know_noise_that_stays_alike() {
    const DRAWS: u32 = 300;
    let mut held = [0; 3];
    for seed in 0..DRAWS {
        let [current, velocity, voltage] = log(0.05, u64::from(seed));
        let found = MotorVoltage::fit(&times(), &current, &velocity, &voltage).expect("a motor");
        let values = [found.resistance, found.back_emf, found.offset];
        for ((value, truth), held) in values.into_iter().zip(TRUTH).zip(&mut held) {
            let [low, high] = value.interval;
            *held += u32::from(low <= truth && truth <= high);
        }
    }
    for held in held {
        let share = f64::from(held) / f64::from(DRAWS);
        assert!((0.89..=0.99).contains(&share), "{share}");
    }
}

/// Noise as large as half of the current would leave 0.8 of the resistance by least squares; that of the velocity, a tenth of it, 0.98.
#[test]
fn noise_of_the_current_makes_no_resistance_smaller() {
    const DRAWS: u64 = 40;
    let mut held = 0;
    for seed in 0..DRAWS {
        let [current, velocity, voltage] = log(0.02, seed);
        let mut random = ChaCha8Rng::seed_from_u64(1000 + seed);
        let mut noisy = |channel: &[f64], size: f64| -> Vec<f64> {
            let white = |x: &f64| {
                let noise: f64 = StandardNormal.sample(&mut random);
                x + size * noise
            };
            channel.iter().map(white).collect()
        };
        let (current, velocity) = (noisy(&current, 0.37), noisy(&velocity, 2.1));
        let found = MotorVoltage::fit(&times(), &current, &velocity, &voltage).expect("a motor");
        let [least_squares, ..] = found.least_squares.expect("noise that is seen");
        assert!(least_squares < 0.86 * TRUTH[0], "{least_squares}");
        for (value, truth) in [found.resistance, found.back_emf, found.offset]
            .iter()
            .zip(TRUTH)
        {
            let [low, high] = value.interval;
            held += u64::from(low <= truth && truth <= high);
        }
    }
    assert!(held > 3 * DRAWS * 88 / 100, "{held}");
}

/// Noise of the voltage alone is no reason for instruments.
#[test]
fn a_current_without_noise_is_its_own_instrument() {
    const DRAWS: u64 = 100;
    let instrumented = (0..DRAWS).filter(|&seed| {
        let [current, velocity, voltage] = log(0.05, seed);
        let found = MotorVoltage::fit(&times(), &current, &velocity, &voltage).expect("a motor");
        found.least_squares.is_some()
    });
    let instrumented = instrumented.count();
    assert!(instrumented <= 3, "{instrumented}");
}

#[test]
fn what_does_not_vary_is_refused() {
    let [current, velocity, voltage] = log(0.0, 1);
    let stands = vec![2.0; current.len()];
    let error = MotorVoltage::fit(&times(), &stands, &velocity, &voltage).unwrap_err();
    assert!(error.to_string().starts_with("the current is constant"));
    let error = MotorVoltage::fit(&times(), &current, &stands, &voltage).unwrap_err();
    assert!(error.to_string().starts_with("the velocity is constant"));
    let twice: Vec<f64> = current.iter().map(|i| 2.0 * i + 1.0).collect();
    let error = MotorVoltage::fit(&times(), &current, &twice, &voltage).unwrap_err();
    assert_eq!(error, CalibrateError::NotApart);
    let short = [1.0, 2.0, 3.0];
    let error = MotorVoltage::fit(&short, &short, &short, &short).unwrap_err();
    let (samples, least) = (3, 16);
    assert_eq!(error, CalibrateError::TooFew { samples, least });
}

/// What an inductance of 50 ms adds to the voltage is told before it is known, and gone with it.
#[test]
fn what_an_inductance_makes_of_the_values_is_told() {
    const TIME_CONSTANT: f64 = 0.05;
    let [current, velocity, voltage] = log(0.05, 1);
    let time = times();
    let whole = with_inductance(&time, &current, TIME_CONSTANT).expect("a current");
    let more = whole
        .iter()
        .zip(&current)
        .map(|(whole, own)| TRUTH[0] * (whole - own));
    let voltage: Vec<f64> = voltage.iter().zip(more).map(|(v, more)| v + more).collect();
    let plain = MotorVoltage::fit(&time, &current, &velocity, &voltage).expect("a motor");
    let known = MotorVoltage::fit(&time, &whole, &velocity, &voltage).expect("a motor");
    let told = plain.by_time_constant.expect("slopes");
    let [resistance, back_emf] = told.map(|share| share * TIME_CONSTANT);
    assert!(back_emf.abs() > 1e-3, "{back_emf}");
    let expected = [
        known.resistance.value * (1.0 + resistance),
        known.back_emf.value / (1.0 - back_emf),
    ];
    let found = [plain.resistance, plain.back_emf].map(|found| found.value);
    for ((found, expected), within) in found.into_iter().zip(expected).zip([1e-3, 3e-4]) {
        let off = found / expected - 1.0;
        assert!(off.abs() < within, "{found} for {expected}");
    }
}

/// A motor of 2 ohm, 1 mH and 0.08 V s/rad that answers within 60 ms to a square wave, [time, current, velocity, voltage] every 5 ms.
fn switched() -> [Vec<f64>; 4] {
    const STEP: f64 = 1e-5;
    let (mut i, mut w) = (0.0, 0.0);
    let mut log = [const { Vec::new() }; 4];
    for k in 0..1_200_000_u32 {
        let t = STEP * f64::from(k);
        let high = if (0.37 * t) % 1.0 < 0.5 { 2.0 } else { -2.0 };
        let v = high + if (0.5 * t) % 1.0 < 0.5 { 6.0 } else { -6.0 };
        if k % 500 == 0 {
            let row = [t, i, w, v];
            log.iter_mut()
                .zip(row)
                .for_each(|(column, value)| column.push(value));
        }
        let friction = 0.01 * f64::tanh(w / 0.1);
        i += STEP * (v - 2.0 * i - 0.08 * w) / 1e-3;
        w += STEP * (0.08 * i - 1e-4 * w - friction) / 2e-4;
    }
    log
}

#[test]
fn a_voltage_that_is_switched_tells_the_same() {
    const TIME_CONSTANT: f64 = 5e-4;
    let [time, current, velocity, voltage] = switched();
    let plain = MotorVoltage::fit(&time, &current, &velocity, &voltage).expect("a motor");
    let told = plain
        .by_time_constant
        .expect("slopes")
        .map(|share| share * TIME_CONSTANT);
    let off = [plain.resistance.value / 2.0, plain.back_emf.value / 0.08].map(|ratio| ratio - 1.0);
    for (told, off) in told.into_iter().zip(off) {
        assert!(
            (told - off).abs() < 0.15 * off.abs() + 2e-4,
            "{told} for {off}"
        );
    }
    let whole = with_inductance(&time, &current, TIME_CONSTANT).expect("a current");
    let known = MotorVoltage::fit(&time, &whole, &velocity, &voltage).expect("a motor");
    for (value, truth) in [(known.resistance, 2.0), (known.back_emf, 0.08)] {
        assert!((value.value / truth - 1.0).abs() < 1e-3, "{value:?}");
    }
}

/// Its factor has the units of a current where nobody logged the voltage. Noise of 1 % leaves samples beside a switch in their pieces.
#[test]
fn a_voltage_that_nobody_logged_tells_the_same() {
    const TIME_CONSTANT: f64 = 5e-4;
    let [time, current, velocity, _] = switched();
    let mut random = ChaCha8Rng::seed_from_u64(1);
    let noise = || -> f64 { 0.04 * Distribution::<f64>::sample(&StandardNormal, &mut random) };
    let noise: Vec<f64> = std::iter::repeat_with(noise).take(time.len()).collect();
    let find = |u: &[f64]| Commanded::find(&time, u, &velocity).expect("a wave");
    let noisy: Vec<f64> = current.iter().zip(&noise).map(|(i, e)| i + e).collect();
    let plain = find(&noisy);
    let off = find(&current).back_emf.value / 0.04 - 1.0;
    let told = plain.by_time_constant * TIME_CONSTANT;
    assert!(
        off > 2e-3 && (told - off).abs() < 0.4 * off,
        "{told} for {off}"
    );
    let whole = with_inductance(&time, &noisy, TIME_CONSTANT).expect("a current");
    let known = find(&whole).back_emf.value / plain.back_emf.value - 1.0;
    assert!((known + off).abs() < 0.4 * off, "{known} for -{off}");
}

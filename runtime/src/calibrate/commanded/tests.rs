use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, StandardNormal};

use super::*;

mod arm;

use arm::{arm, encoded};

fn noisy(values: &[f64], noise: f64, seed: u64) -> Vec<f64> {
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    let mut error = || -> f64 { noise * Distribution::<f64>::sample(&StandardNormal, &mut random) };
    values.iter().map(|x| x + error()).collect()
}

#[test]
fn exact_velocities_give_the_exact_factor() {
    for volts in [1.5, 2.6, 4.0] {
        let log = arm(volts, 1.5);
        let found = Commanded::find(&log.time, &log.drop, &log.velocity).expect("a square wave");
        assert!((found.back_emf.value - 1.5).abs() < 1e-9, "{found:?}");
        assert!(found.by_jumps > 99.9 && found.explained > 99.9);
        for piece in &found.pieces {
            assert!((piece.level.abs() - volts).abs() < 1e-8, "{piece:?}");
        }
        let switches = found.switches();
        // The last piece may be too short to count.
        assert!(switches.len() + 1 >= log.switches.len() && switches.len() > 3);
        for (found, truth) in switches.iter().zip(&log.switches) {
            assert!((found - truth).abs() < 0.04, "{found} {truth}");
        }
    }
}

/// The published log has positions and currents, and 1.5 was found by trial.
#[test]
fn encoders_give_the_factor() {
    for (bits, noise, tolerance) in [
        (16, 0.0, 0.01),
        (12, 0.0, 0.01),
        (12, 0.05, 0.03),
        (10, 0.05, 0.05),
    ] {
        for (seed, volts) in [(1, 1.5), (2, 2.6), (3, 4.0)] {
            let log = arm(volts, 1.5);
            let windows = Windows::new(&log.time, &encoded(&log.position, bits)).expect("a motion");
            let drop = noisy(&log.drop, noise, seed);
            let found = Commanded::find_in(&windows, &drop).expect("a square wave");
            let off = found.back_emf.value - 1.5;
            assert!(
                off.abs() < tolerance,
                "{bits} bits, {volts} V: {off} {:?}",
                found.back_emf
            );
            for (found, truth) in found.switches().iter().zip(&log.switches) {
                assert!((found - truth).abs() < 0.1, "{found} {truth}");
            }
        }
    }
}

#[test]
fn intervals_hold_the_factor() {
    const DRAWS: u32 = 200;
    let log = arm(2.6, 1.5);
    let mut held = 0;
    for seed in 0..DRAWS {
        let drop = noisy(&log.drop, 0.05, u64::from(seed));
        let found = Commanded::find(&log.time, &drop, &log.velocity).expect("a square wave");
        let [low, high] = found.back_emf.interval;
        held += u32::from(low <= 1.5 && 1.5 <= high);
    }
    let share = f64::from(held) / f64::from(DRAWS);
    assert!((0.9..=0.99).contains(&share), "{share}");
}

/// Noise of a velocity makes a factor too small, and never by more than what is told.
#[test]
fn noise_of_velocities_is_bounded() {
    let log = arm(2.6, 1.5);
    for seed in 0..20 {
        let velocity = noisy(&log.velocity, 0.06, seed);
        let found = Commanded::find(&log.time, &log.drop, &velocity).expect("a square wave");
        let missing = 100.0 * (1.0 - found.back_emf.value / 1.5);
        let [low, high] = found.back_emf.interval;
        let chance = 100.0 * (high - low) / 1.5;
        assert!(missing > 0.0, "{missing}");
        assert!(
            missing < found.attenuation + chance,
            "{missing} {}",
            found.attenuation
        );
    }
}

#[test]
fn what_is_not_switched_is_refused() {
    let log = arm(2.6, 1.5);
    let of = |wave: &dyn Fn(f64) -> f64| -> Vec<f64> {
        let pairs = log.time.iter().zip(&log.velocity);
        pairs.map(|(t, w)| wave(*t) - 1.5 * w).collect()
    };
    for noise in [0.0, 0.02] {
        let find = |drop: &[f64]| Commanded::find(&log.time, &noisy(drop, noise, 1), &log.velocity);
        let error = find(&of(&|t| 2.6 * (1.9 * t).sin())).unwrap_err();
        assert!(
            matches!(error, CalibrateError::NotInPieces { .. }),
            "{error}"
        );
        let error = find(&of(&|_| 2.6)).unwrap_err();
        assert_eq!(error, CalibrateError::NoSwitch);
    }
    let stands = vec![0.5; log.time.len()];
    let error = Commanded::find(&log.time, &log.drop, &stands).unwrap_err();
    assert!(
        error.to_string().starts_with("the velocity is constant"),
        "{error}"
    );
    // The velocity is that of the voltage, at once: `k` and resistance are one.
    let wave: Vec<f64> = log.time.iter().map(|t| (0.9 * t).sin().signum()).collect();
    let drop: Vec<f64> = wave.iter().map(|w| 3.0 * w).collect();
    let error = Commanded::find(&log.time, &drop, &wave).unwrap_err();
    assert_eq!(error, CalibrateError::NoSwitch);
}

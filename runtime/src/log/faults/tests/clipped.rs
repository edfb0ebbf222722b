//! Limits that are measured with noise.

use super::*;

/// A torque of waves and noise of 0.1 N m behind a limit, and the sensor's own noise behind that.
fn limited(limit: f64, noise: f64, seed: u64) -> Log {
    let mut random = ChaCha8Rng::seed_from_u64(100 + seed);
    let mut log = clean(seed);
    log.dq.clear();
    for tau in &mut log.tau[0] {
        let own: f64 = StandardNormal.sample(&mut random);
        *tau = tau.clamp(-limit, limit) + noise * own;
    }
    log
}

#[test]
fn limits_are_told_through_noise() {
    for (limit, noise) in [(7.0, 1e-3), (7.0, 0.01), (8.0, 1e-3), (5.0, 0.005)] {
        let before = clean(21);
        let log = limited(limit, noise, 21);
        let Mended { log: piece, faults } = log.mended();
        let [Fault::Clipped { value, share, .. }] = &faults[..] else {
            panic!("{limit} {noise}: {faults:?}");
        };
        assert!((value.abs() - limit).abs() < noise, "{value}");
        let stands = |k: &usize| before.tau[0][*k].abs() > limit;
        let count = (0..5000).filter(stands).count();
        assert!(
            (share * 5000.0 / count as f64 - 1.0).abs() < 0.05,
            "{share} {count}"
        );
        let at = |k: usize| {
            let time = k as f64 / RATE;
            let mut spans = piece.clipped[0].iter();
            spans.any(|span| (span.start - 1e-9..=span.end + 1e-9).contains(&time))
        };
        let known = (0..5000).filter(stands).filter(|k| at(*k)).count();
        assert!(known * 100 > count * 98, "{known} of {count}");
    }
}

/// Tops of waves, with noise or without; a square wave that is as noisy as all else; a joint that holds its largest torque at rest.
#[test]
fn what_stands_at_its_largest_by_itself_is_no_limit() {
    for noise in [0.0, 1e-3, 0.01, 0.1] {
        let mut random = ChaCha8Rng::seed_from_u64(22);
        let mut normal = move || -> f64 { StandardNormal.sample(&mut random) };
        let clean = clean(22);
        let mut with = |law: &dyn Fn(f64) -> f64| {
            let mut log = clean.clone();
            log.dq.clear();
            for (tau, time) in log.tau[0].iter_mut().zip(&clean.time) {
                *tau = law(*time) + noise * normal();
            }
            log.mended().faults
        };
        assert_eq!(with(&|t| 9.0 * (3.0 * t).sin()), [], "{noise}");
        assert_eq!(
            with(&|t| 9.0 * (0.7 * t).cos() + (2.1 * t).cos()),
            [],
            "{noise}"
        );
        if noise > 0.0 {
            assert_eq!(with(&|t| 5.0 * (3.0 * t).sin().signum()), [], "{noise}");
        }
        let held = |t: f64| {
            if (4.5..5.5).contains(&t) {
                9.5
            } else {
                9.0 * (3.0 * t).sin()
            }
        };
        if noise > 0.0 {
            assert_eq!(with(&held), [], "{noise}");
        }
    }
}

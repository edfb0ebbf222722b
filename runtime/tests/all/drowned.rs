//! Parameters that only the noise of an encoder parts are not told.

use super::pendulum::pendulum;
use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, StandardNormal};
use robot_model::identify::{Estimate, Identify};
use robot_model::log::Log;

const TRUTH: [f64; 3] = [2.0, 9.0, 1.0];

/// rad/s
const RATE: f64 = 3.0;

/// 20 s of one wave of a size, rad, with noise of the encoder.
fn swing(size: f64, noise: f64, seed: u64) -> Log {
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    let mut normal = || -> f64 { StandardNormal.sample(&mut random) };
    let time: Vec<f64> = (0..10_000).map(|k| 0.002 * f64::from(k)).collect();
    let waves: Vec<(f64, f64)> = time.iter().map(|t| (RATE * t).sin_cos()).collect();
    let [izz, mx, fv] = TRUTH;
    let tau = waves.iter().map(|(sin, cos)| {
        let (q, dq, ddq) = (size * sin, size * RATE * cos, -size * RATE * RATE * sin);
        izz * ddq + mx * q.sin() + fv * dq
    });
    let tau = vec![tau.collect()];
    let q = waves.iter().map(|(sin, _)| size * sin + noise * normal());
    let q = vec![q.collect()];
    Log::from_samples("a swing", time, q, tau).expect("finite and uniform")
}

fn fits(log: &Log) -> [Estimate; 2] {
    let (identify, logs) = (Identify::default(), std::slice::from_ref(log));
    let arm = pendulum();
    [
        identify.fit(&arm, logs).expect("it moves"),
        identify.fit_filtered(&arm, logs, None).expect("it moves"),
    ]
}

/// A small swing has `sin(q)` and `-RATE^2 ddq` alike but for `q^3 / 6`, which an encoder's noise covers.
#[test]
fn what_noise_of_positions_alone_parts_is_told_in_sums() {
    for seed in 0..5 {
        for found in fits(&swing(0.02, 2e-5, seed)) {
            let form = found.form;
            assert_eq!((found.rank, found.unexcited.len()), (2, 1), "{form:?}");
            assert!(found.is_separated("joint.viscous_friction.fv"), "{form:?}");
            assert!(found.separated().is_err());
            // `mx - RATE^2 izz`, or that over `-RATE^2`.
            let [sum] = found.combinations.as_slice() else {
                panic!("{form:?}: {:?}", found.combinations);
            };
            let truth: f64 = sum
                .terms
                .iter()
                .map(|(name, factor)| {
                    let place = ["link.izz", "link.mx"].iter().position(|own| own == name);
                    factor * TRUTH[place.expect("one of both")]
                })
                .sum();
            assert!((sum.value - truth).abs() < 0.01 * truth.abs(), "{sum:?}");
        }
    }
}

#[test]
fn a_wide_swing_tells_both() {
    for log in [swing(1.0, 2e-5, 0), swing(1.0, 0.0, 0)] {
        for found in fits(&log) {
            assert_eq!(found.rank, 3);
            for (found, truth) in found.values().iter().zip(TRUTH) {
                assert!((found - truth).abs() < 0.01 * truth, "{found}, {truth}");
            }
        }
    }
}

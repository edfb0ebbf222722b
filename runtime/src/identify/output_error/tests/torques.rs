//! Noise of the torque, which moves the simulated block for the rest of a window.

use super::*;

/// A log whose torque has noise, a share of which is alike from sample to sample.
fn pushed(mut log: Log, sigma: f64, alike: f64, seed: u64) -> Log {
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    let mut state: f64 = StandardNormal.sample(&mut random);
    for tau in &mut log.tau[0] {
        let fresh: f64 = StandardNormal.sample(&mut random);
        state = alike * state + (1.0 - alike * alike).sqrt() * fresh;
        *tau += sigma * state;
    }
    log
}

#[test]
fn deviations_know_of_noise_of_the_torque() {
    const DRAWS: u64 = 40;
    let clean = log(20.0);
    let settings = OutputError {
        window: Some(1.0),
        ..HELD
    };
    for alike in [0.0, 0.8] {
        let mut held = 0.0;
        for seed in 0..DRAWS {
            let found = fit(&settings, &pushed(clean.clone(), 0.1, alike, seed));
            for k in 0..3 {
                let std = found.std[k].expect("identified");
                held += f64::from((found.values[k] - TRUTH[k]).abs() < 1.96 * std);
            }
        }
        let held = held / (3 * DRAWS) as f64;
        assert!((0.88..0.99).contains(&held), "{alike}: {held}");
    }
}

//! A pendulum under a controller whose motor does not deliver all that is commanded.

use std::f64::consts::FRAC_PI_2;

use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, StandardNormal};
use robot_model::log::Log;

use super::SECONDS;
use super::cases::PENDULUM;
use super::plant::{GRAVITY, along, dry, encoder};

/// Largest torque at rest, N m, and speed at which none is left, rad/s.
pub const LIMIT: f64 = 14.0;
pub const NO_LOAD: f64 = 9.0;

/// Dry and viscous friction, and the noise of the torque.
pub const FRICTION: [f64; 2] = [1.0, 0.8];
pub const NOISE: f64 = 0.1;

/// Hanging down, and swinging so fast that the motor gives in a few times a second.
pub const TONES: &[(f64, f64, f64)] = &[
    (-FRAC_PI_2, 0.0, FRAC_PI_2),
    (0.9, 0.31, 0.2),
    (0.4, 0.83, 1.1),
    (0.08, 1.9, 2.3),
];
pub const OTHER_TONES: &[(f64, f64, f64)] = &[
    (-FRAC_PI_2, 0.0, FRAC_PI_2),
    (0.8, 0.27, 1.4),
    (0.4, 0.87, 0.3),
    (0.08, 2.1, 0.9),
];

/// Its log, which holds the command. Mass, weight and friction are integrated forward at 10 kHz, so that the arm falls behind
/// where the motor gives in; the log has every twentieth position and the command's mean around it.
pub fn log(name: &str, tones: &[(f64, f64, f64)], seed: u64) -> Log {
    let (step, izz, mx, my) = (1e-4, PENDULUM[0], PENDULUM[1], PENDULUM[2]);
    let [mut q, mut dq, _] = along(tones, 0.0);
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    let (mut time, mut positions, mut torque) = (vec![], vec![], vec![]);
    let (mut sum, mut count) = (0.0, 0.0);
    for k in 0..SECONDS * 10_000 {
        let now = f64::from(k) * step;
        if k % 20 == 0 {
            time.push(now);
            positions.push(encoder(q));
        }
        if k % 20 == 10 {
            let normal: f64 = StandardNormal.sample(&mut random);
            torque.push(sum / count + NOISE * normal);
            (sum, count) = (0.0, 0.0);
        }
        let [wanted, rate, _] = along(tones, now);
        let command = 120.0 * (wanted - q) + 12.0 * (rate - dq);
        let most = LIMIT * (1.0 - (dq * command.signum()).max(0.0) / NO_LOAD).max(0.0);
        let weight = GRAVITY * (mx * q.cos() - my * q.sin());
        let load = weight + FRICTION[0] * dry(dq) + FRICTION[1] * dq;
        dq += step * (command.clamp(-most, most) - load) / izz;
        q += step * dq;
        sum += command;
        count += 1.0;
    }
    Log::from_samples(name, time, vec![positions], vec![torque]).expect("samples are in order")
}

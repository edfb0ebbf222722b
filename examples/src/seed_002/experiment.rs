//! A log of the simulated arm: a servo loop of 1 kHz, encoders, and torques that are estimated from currents.

use std::array;
use std::f64::consts::TAU;

use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;
use robot_model::log::Log;

use super::plant::{Joints, Moving, rigid_torque};
use super::truth::SAMPLES;
use crate::paper::{Error, normal, rounded};

/// Cycle of the controller, s.
pub const CYCLE: f64 = 1e-3;

/// Steps of the integrator a cycle.
pub const STEPS: u32 = 2;

/// Counts of an encoder a turn of its joint.
const COUNTS: f64 = 1_048_576.0;

/// Noise of the torque, N m.
pub const NOISE: Joints = [0.4, 0.6, 0.3, 0.12, 0.1, 0.08];

/// What the drive of joint 2 takes of its torque: amplitude, N m, and periods a turn. No model knows of it unless it declares it.
///
/// The publication has 15 to 16 N m root mean square on joint 2 by all three methods, and errors on other joints that weights take
/// away. So joint 2 has a torque of that size that no parameter explains, and least squares explains it by what joints share. What
/// it is, the publication does not say: a ripple is one of many.
pub const RIPPLE_2: [f64; 2] = [21.0, 5.0];

/// What moves the joints where this torque is commanded: the drive of joint 2 takes a ripple of this amplitude, N m, from its own.
#[must_use]
pub fn delivered(mut command: Joints, q: &Joints, ripple: f64) -> Joints {
    command[1] -= ripple * (RIPPLE_2[1] * q[1]).cos();
    command
}

/// Gains of the position loop: inertia of each joint, kg m^2, and frequency, rad/s.
const INERTIA: Joints = [4.0, 5.0, 2.0, 0.4, 0.3, 0.13];
const FREQUENCY: f64 = 40.0;

/// Velocities are differences of positions behind a filter of this corner, rad/s.
const CORNER: f64 = TAU * 50.0;

/// A position as an encoder has it, rad.
#[must_use]
pub fn encoded(q: f64) -> f64 {
    rounded(q, TAU / COUNTS)
}

/// What a controller knows of the motion.
#[derive(Debug, Clone, Copy)]
pub struct Sensors {
    /// Positions, rad.
    pub q: Joints,
    /// Velocities, rad/s.
    pub dq: Joints,
}

impl Sensors {
    /// Of an arm that stands.
    #[must_use]
    pub fn new(q: &Joints) -> Self {
        Self {
            q: q.map(encoded),
            dq: [0.0; 6],
        }
    }

    /// One cycle later.
    pub fn read(&mut self, q: &Joints) {
        let part = 1.0 - (-CORNER * CYCLE).exp();
        for (k, q) in q.iter().enumerate() {
            let now = encoded(*q);
            self.dq[k] += part * ((now - self.q[k]) / CYCLE - self.dq[k]);
            self.q[k] = now;
        }
    }
}

/// Position, velocity and acceleration of every joint, `[joint][order]`.
pub type Wanted = [[f64; 3]; 6];

/// The arm along a motion that begins at rest: one sample a cycle. The ripple of joint 2 has this amplitude, N m.
///
/// # Errors
/// None are expected of such a log; those of [`Log::from_samples`].
pub fn measure(
    name: &str,
    wanted: &(dyn Fn(f64) -> Wanted + Sync),
    ripple: f64,
    seed: u64,
) -> Result<Log, Error> {
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    let mut arm = Moving {
        q: wanted(0.0).map(|joint| joint[0]),
        dq: [0.0; 6],
    };
    let mut sensors = Sensors::new(&arm.q);
    let (mut time, mut last) = (Vec::new(), None);
    let (mut q, mut tau) = (vec![Vec::new(); 6], vec![Vec::new(); 6]);
    for cycle in 0..SAMPLES {
        let t = cycle as f64 * CYCLE;
        sensors.read(&arm.q);
        let wanted = wanted(t);
        let [at, speed, rise] = array::from_fn(|order| wanted.map(|joint| joint[order]));
        let fed = rigid_torque(&at, &speed, &rise);
        let command: Joints = array::from_fn(|k| {
            let [p, d] = [FREQUENCY * FREQUENCY, 2.0 * FREQUENCY].map(|gain| gain * INERTIA[k]);
            0.9 * fed[k] + p * (at[k] - sensors.q[k]) + d * (speed[k] - sensors.dq[k])
        });
        // A sample is of the instant between two commands.
        let before = last.unwrap_or(command);
        time.push(t);
        for k in 0..6 {
            q[k].push(sensors.q[k]);
            tau[k].push(f64::midpoint(before[k], command[k]) + NOISE[k] * normal(&mut random));
        }
        last = Some(command);
        arm = arm.after(CYCLE, STEPS, &|_, now| delivered(command, &now.q, ripple));
    }
    Ok(Log::from_samples(name, time, q, tau)?)
}

/// Another motion than those that are designed, to test on: each joint swings by two waves that grow from rest.
#[must_use]
pub fn test_motion(t: f64) -> Wanted {
    const SIZE: Joints = [0.9, 0.7, 0.5, 1.0, 0.9, 0.9];
    const MIDDLE: Joints = [0.0, 0.2, -0.3, 0.0, 0.3, 0.0];
    // `1 - exp(-(t / 2)^3)` with its slopes.
    let fall = (-(t / 2.0).powi(3)).exp();
    let u = 0.375 * t * t;
    let rise = [1.0 - fall, u * fall, (0.75 * t - u * u) * fall];
    array::from_fn(|k| {
        let waves = [(0.8, 0.9 + 0.11 * k as f64), (0.2, 2.3 - 0.17 * k as f64)];
        let wave = |order: i32| -> f64 {
            let turn = f64::from(order) * TAU / 4.0 + 0.9 * k as f64;
            let terms = waves.map(|(size, w)| size * w.powi(order) * (w * t + turn).sin());
            SIZE[k] * terms.iter().sum::<f64>()
        };
        let [w, dw, ddw] = [wave(0), wave(1), wave(2)];
        [
            MIDDLE[k] + rise[0] * w,
            rise[1] * w + rise[0] * dw,
            rise[2] * w + 2.0 * rise[1] * dw + rise[0] * ddw,
        ]
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn derivatives_of_the_test_motion_are_its_own() {
        let h = 1e-4;
        for t in [0.5, 1.7, 6.3] {
            let [before, now, after] = [t - h, t, t + h].map(test_motion);
            for k in 0..6 {
                for order in 0..2 {
                    let slope = (after[k][order] - before[k][order]) / (2.0 * h);
                    assert!((slope - now[k][order + 1]).abs() < 1e-5, "{k} {order} {t}");
                }
            }
        }
    }
}

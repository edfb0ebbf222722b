//! The experiment, simulated by hand-written equations and the textbook's integrator: a shoulder with its motor under a switched voltage.

use std::f64::consts::TAU;
use std::ops::Range;

use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;

use super::truth::{ARM, BACK_EMF, RATE, SAMPLES, WINDOW};
use crate::paper::{normal, rk4, rounded};

/// The commanded voltage, V. It is not printed; with it the arm passes 1.67 s at about 0.76 rad/s, the velocity of Figure 10.
pub const VOLTS: f64 = 1.75;

/// Where the voltage is switched, rad: the arm was to turn by about 90 degrees both ways.
pub const TURN: f64 = 1.5;

/// Steps of the integrator per sample; the fastest motion, of 1/36 s, has 33 of them.
const STEPS: u32 = 40;

/// Halvings of a step in which the arm turns round.
const HALVINGS: u32 = 50;

/// Deviation of the noise of the position, rad, before its converter.
pub const POSITION_NOISE: f64 = 1e-3;
/// Steps of its converter a turn: 12 bits.
pub const POSITION_STEPS: f64 = 4096.0;
/// Noise of the voltage across the known resistance, V, and a step of its converter, V.
const VOLTAGE_NOISE: f64 = 0.01;
const VOLTAGE_STEP: f64 = 0.005;

/// What happened, and what was measured of it; `[sample]`.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Experiment {
    /// s
    pub time: Vec<f64>,
    /// The true position, rad.
    pub angle: Vec<f64>,
    /// The true velocity, rad/s.
    pub velocity: Vec<f64>,
    /// The commanded voltage, V, which nobody measured.
    pub command: Vec<f64>,
    /// Measured position, rad: `y`.
    pub y: Vec<f64>,
    /// Measured voltage across the known resistance, V: `u`.
    pub u: Vec<f64>,
}

/// An arm of equation (5.2) with law (6.3): `[alpha, beta, c1, c2]`, and dry friction, which the paper's arm does not have, rad/s^2.
#[derive(Debug, Clone, Copy)]
pub struct Arm {
    /// `[alpha, beta, c1, c2]`
    pub values: [f64; 4],
    /// Dry friction over the inertia, rad/s^2.
    pub dry: f64,
}

impl Arm {
    /// The state a sample later, under a drive that is held. A step in which the arm comes to rest ends there; it stays at rest while dry
    /// friction is more than what moves it.
    #[must_use]
    pub fn sample_later(&self, mut state: [f64; 2], drive: f64) -> [f64; 2] {
        let [alpha, beta, forward, backward] = self.values;
        let moving = |angle: f64| alpha * angle.sin() + beta * drive;
        let h = 1.0 / (RATE * f64::from(STEPS));
        for _ in 0..STEPS {
            let mut left = h;
            while left > 1e-9 * h {
                if state[1] == 0.0 && moving(state[0]).abs() <= self.dry {
                    break;
                }
                let side = if state[1] == 0.0 {
                    moving(state[0]).signum()
                } else {
                    state[1].signum()
                };
                let c = if side > 0.0 { forward } else { backward };
                let rate = |_: f64, x: &[f64; 2]| [x[1], moving(x[0]) - c * x[1] - self.dry * side];
                let after = |length: f64| rk4(rate, 0.0, &state, length);
                if after(left)[1] * side >= 0.0 {
                    state = after(left);
                    break;
                }
                let (mut low, mut high) = (0.0, left);
                for _ in 0..HALVINGS {
                    let middle = 0.5 * (low + high);
                    if after(middle)[1] * side >= 0.0 {
                        low = middle;
                    } else {
                        high = middle;
                    }
                }
                state = [after(high)[0], 0.0];
                left -= high;
            }
        }
        state
    }
}

/// The arm of Table 2.
pub const SHOULDER: Arm = Arm {
    values: ARM,
    dry: 0.0,
};

impl Experiment {
    /// From the upright, at rest, to 90 degrees both ways; the same seed gives the same noise.
    #[must_use]
    pub fn run(seed: u64) -> Self {
        // The first swing goes backward.
        let mut v = -VOLTS;
        Self::under(seed, |_, angle| {
            if angle.abs() > TURN {
                v = -VOLTS * angle.signum();
            }
            v
        })
    }

    /// The same under a voltage of one's own, by time and angle at each sample.
    pub fn under(seed: u64, mut command: impl FnMut(f64, f64) -> f64) -> Self {
        let mut random = ChaCha8Rng::seed_from_u64(seed);
        let mut done = Self::default();
        let mut state = [0.0, 0.0];
        for k in 0..SAMPLES {
            let time = f64::from(k) / RATE;
            let [angle, velocity] = state;
            let v = command(time, angle);
            done.time.push(time);
            done.angle.push(angle);
            done.velocity.push(velocity);
            done.command.push(v);
            let y = angle + POSITION_NOISE * normal(&mut random);
            done.y.push(rounded(y, TAU / POSITION_STEPS));
            let u = v - BACK_EMF * velocity + VOLTAGE_NOISE * normal(&mut random);
            done.u.push(rounded(u, VOLTAGE_STEP));
            state = SHOULDER.sample_later(state, v);
        }
        done
    }

    /// Samples that are fitted: 1.67 s is sample 50, to the digits that are printed.
    #[must_use]
    pub fn window(&self) -> Range<usize> {
        let before = |edge: f64| self.time.iter().filter(|t| **t < edge - 0.5 / RATE).count();
        before(WINDOW[0])..before(WINDOW[1]) + 1
    }
}

/// `(y_k - y_(k-1)) / t_s`, 0 at the first sample: the paper's velocity.
#[must_use]
pub fn differences(y: &[f64]) -> Vec<f64> {
    let steps = y.windows(2).map(|pair| (pair[1] - pair[0]) * RATE);
    std::iter::once(0.0).chain(steps).collect()
}

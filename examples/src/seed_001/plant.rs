//! The arm in motion, from the paper's equations by hand: Runge-Kutta steps between the instants at which a joint stops or breaks away.
//!
//! In: parameters and where the arm is let go. Out: its positions at every sample. A joint whose velocity comes to zero stands where its
//! dry friction can hold it, and starts again where it cannot: nothing is smoothed.

use std::array;

use super::truth::{G, Physical, STEP};
use crate::paper::rk4;

/// Positions of both joints, rad.
pub type Position = [f64; 2];

/// Steps between two samples.
const STEPS: u32 = 5;

/// Halvings of a step in which something happens: to rounding.
const HALVINGS: u32 = 45;

/// Events at one instant, after which a step is taken as it is.
const CROWD: u32 = 8;

/// What a joint does: `sign` of its velocity while it moves.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Mode {
    Stands,
    Moves { sign: f64 },
}

const MODES: [Mode; 3] = [
    Mode::Stands,
    Mode::Moves { sign: 1.0 },
    Mode::Moves { sign: -1.0 },
];

/// An arm that was let go.
#[derive(Debug, Clone)]
pub struct Arm {
    physical: Physical,
    /// Positions, then velocities.
    x: [f64; 4],
    modes: [Mode; 2],
    time: f64,
}

/// Torque of equations (3) and (4), without friction.
#[must_use]
pub fn torque(p: &Physical, q: Position, dq: [f64; 2], ddq: [f64; 2]) -> [f64; 2] {
    let ([[m11, m12], [_, m22]], bias) = rigid(p, q, dq);
    [
        m11 * ddq[0] + m12 * ddq[1] + bias[0],
        m12 * ddq[0] + m22 * ddq[1] + bias[1],
    ]
}

/// What stands before the accelerations in (3) and (4), and all the rest.
fn rigid(p: &Physical, q: Position, dq: [f64; 2]) -> ([[f64; 2]; 2], [f64; 2]) {
    let ([m1, m2], l1, [c1, c2], [i1, i2]) = (p.m, p.l1, p.c, p.inertia);
    let (sin2, cos2) = q[1].sin_cos();
    let (sin1, sin12) = (q[0].sin(), (q[0] + q[1]).sin());
    let m11 = m1 * c1 * c1 + m2 * c2 * c2 + m2 * l1 * l1 + 2.0 * m2 * c2 * l1 * cos2 + i1 + i2;
    let m12 = m2 * c2 * c2 + m2 * c2 * l1 * cos2 + i2;
    let m22 = m2 * c2 * c2 + i2;
    let h = m2 * c2 * l1 * sin2;
    let first = -2.0 * h * dq[0] * dq[1] - h * dq[1] * dq[1]
        + m2 * G * c2 * sin12
        + (m1 * c1 + m2 * l1) * G * sin1;
    let second = h * dq[0] * dq[0] + m2 * G * c2 * sin12;
    ([[m11, m12], [m12, m22]], [first, second])
}

impl Arm {
    /// At rest at `q`, and nobody holds it any more.
    #[must_use]
    pub fn released(physical: Physical, q: Position) -> Self {
        let mut arm = Self {
            physical,
            x: [q[0], q[1], 0.0, 0.0],
            modes: [Mode::Stands; 2],
            time: 0.0,
        };
        arm.decide();
        arm
    }

    /// Accelerations where joints do what they do, and the torques of dry friction that go with them.
    fn accelerations(&self, x: &[f64; 4], modes: [Mode; 2]) -> ([f64; 2], [f64; 2]) {
        let p = &self.physical;
        let dq = [x[2], x[3]];
        let (mass, mut rest) = rigid(p, [x[0], x[1]], dq);
        let mut dry = [0.0; 2];
        for joint in 0..2 {
            if let Mode::Moves { sign } = modes[joint] {
                dry[joint] = sign * p.dry[joint];
                rest[joint] += p.viscous[joint] * dq[joint] + dry[joint];
            }
        }
        let ddq = match modes {
            [Mode::Stands, Mode::Stands] => [0.0; 2],
            [Mode::Stands, Mode::Moves { .. }] => [0.0, -rest[1] / mass[1][1]],
            [Mode::Moves { .. }, Mode::Stands] => [-rest[0] / mass[0][0], 0.0],
            [Mode::Moves { .. }, Mode::Moves { .. }] => {
                let [[a, b], [c, d]] = mass;
                let determinant = a * d - b * c;
                [
                    (b * rest[1] - d * rest[0]) / determinant,
                    (c * rest[0] - a * rest[1]) / determinant,
                ]
            }
        };
        for joint in 0..2 {
            if modes[joint] == Mode::Stands {
                let [a, b] = mass[joint];
                dry[joint] = -(a * ddq[0] + b * ddq[1] + rest[joint]);
            }
        }
        (ddq, dry)
    }

    /// What joints without velocity do from here on.
    fn decide(&mut self) {
        let choices = |joint: usize| {
            let own = self.modes[joint];
            let is_still = self.x[2 + joint] == 0.0;
            MODES
                .into_iter()
                .filter(move |&mode| is_still || mode == own)
        };
        let pairs = choices(0).flat_map(|first| choices(1).map(move |second| [first, second]));
        let found = pairs.into_iter().find(|&modes| {
            let (ddq, dry) = self.accelerations(&self.x, modes);
            (0..2).all(|joint| match modes[joint] {
                Mode::Stands => dry[joint].abs() <= self.physical.dry[joint] * (1.0 + 1e-12),
                Mode::Moves { sign } => self.x[2 + joint] != 0.0 || sign * ddq[joint] > 0.0,
            })
        });
        self.modes = found.unwrap_or(self.modes);
    }

    /// Whether every joint can go on as it does.
    fn holds(&self, x: &[f64; 4]) -> bool {
        let (_, dry) = self.accelerations(x, self.modes);
        (0..2).all(|joint| match self.modes[joint] {
            Mode::Stands => dry[joint].abs() <= self.physical.dry[joint] * (1.0 + 1e-9),
            Mode::Moves { sign } => sign * x[2 + joint] > 0.0,
        })
    }

    fn after(&self, h: f64) -> [f64; 4] {
        let rate = |_: f64, x: &[f64; 4]| {
            let (ddq, _) = self.accelerations(x, self.modes);
            [x[2], x[3], ddq[0], ddq[1]]
        };
        rk4(rate, 0.0, &self.x, h)
    }

    /// Moves on by some seconds.
    pub fn advance(&mut self, seconds: f64) {
        self.time += seconds;
        let mut left = seconds;
        let mut crowd = 0;
        while left > 0.0 {
            if self.modes == [Mode::Stands; 2] {
                return;
            }
            let next = self.after(left);
            if self.holds(&next) || crowd > CROWD {
                self.x = next;
                return;
            }
            let (mut low, mut high) = (0.0, left);
            for _ in 0..HALVINGS {
                let middle = 0.5 * (low + high);
                if self.holds(&self.after(middle)) {
                    low = middle;
                } else {
                    high = middle;
                }
            }
            crowd = if low > 0.0 { 0 } else { crowd + 1 };
            self.x = self.after(high);
            for joint in 0..2 {
                match self.modes[joint] {
                    Mode::Moves { sign } if sign * self.x[2 + joint] > 0.0 => (),
                    _ => self.x[2 + joint] = 0.0,
                }
            }
            left -= high;
            self.decide();
        }
    }

    /// Where it is.
    #[must_use]
    pub fn position(&self) -> Position {
        [self.x[0], self.x[1]]
    }

    /// Seconds since it was let go.
    #[must_use]
    pub fn time(&self) -> f64 {
        self.time
    }

    /// Whether both joints stand.
    #[must_use]
    pub fn is_at_rest(&self) -> bool {
        self.modes == [Mode::Stands; 2]
    }

    /// Kinetic and potential energy, J.
    #[must_use]
    pub fn energy(&self) -> f64 {
        let p = &self.physical;
        let [q1, q2, v1, v2] = self.x;
        let ([[m11, m12], [_, m22]], _) = rigid(p, [q1, q2], [v1, v2]);
        let kinetic = 0.5 * (m11 * v1 * v1 + 2.0 * m12 * v1 * v2 + m22 * v2 * v2);
        let height =
            (p.m[0] * p.c[0] + p.m[1] * p.l1) * q1.cos() + p.m[1] * p.c[1] * (q1 + q2).cos();
        kinetic - G * height
    }
}

/// Positions at every sample of an arm that is let go at `q`, and the arm at the end.
#[must_use]
pub fn release(physical: Physical, q: Position, samples: usize) -> (Vec<Position>, Arm) {
    let mut arm = Arm::released(physical, q);
    let mut positions = Vec::with_capacity(samples);
    for sample in 0..samples {
        if sample > 0 {
            for _ in 0..STEPS {
                arm.advance(STEP / f64::from(STEPS));
            }
        }
        positions.push(arm.position());
    }
    (positions, arm)
}

/// Angles of both joints in degrees, for figures and errors.
#[must_use]
pub fn degrees(positions: &[Position], joint: usize) -> Vec<f64> {
    let angles = positions.iter();
    angles.map(|q| q[joint].to_degrees()).collect()
}

/// The same arm with dry friction times factors.
#[must_use]
pub fn with_dry(physical: Physical, factors: [f64; 2]) -> Physical {
    Physical {
        dry: array::from_fn(|joint| physical.dry[joint] * factors[joint]),
        ..physical
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::seed_001::truth::ESTIMATED;

    #[test]
    fn without_friction_energy_stays() {
        let free = Physical {
            viscous: [0.0; 2],
            dry: [0.0; 2],
            ..ESTIMATED
        };
        let before = Arm::released(free, [0.7, -0.4]).energy();
        let (_, arm) = release(free, [0.7, -0.4], 1000);
        assert!((arm.energy() - before).abs() < 1e-7 * before.abs());
    }

    #[test]
    fn dry_friction_alone_takes_its_own_work() {
        let dry = Physical {
            viscous: [0.0; 2],
            ..ESTIMATED
        };
        let (positions, arm) = release(dry, [0.3, 0.0], 40_000);
        assert!(arm.is_at_rest());
        // Joints turn between samples: the way from sample to sample is a little short.
        let way = |joint: usize| -> f64 {
            let pairs = positions.windows(2);
            pairs
                .map(|pair| (pair[1][joint] - pair[0][joint]).abs())
                .sum()
        };
        let work = dry.dry[0] * way(0) + dry.dry[1] * way(1);
        let lost = Arm::released(dry, [0.3, 0.0]).energy() - arm.energy();
        assert!((work - lost).abs() < 2e-3 * lost, "{work} {lost}");
    }
}

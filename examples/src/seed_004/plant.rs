//! The device as the paper's equations have it, written by hand and integrated by the textbook's method.
//!
//! Dry friction is no curve here: a joint stands, slides one way or slides the other. A step ends where a joint comes to rest,
//! and a joint that stands is let go where its load is more than friction holds.

use super::truth::Pi;
use crate::paper::rk4;

/// Three numbers, one a joint.
pub type Three = [f64; 3];

/// Matrix, `[row][column]`.
pub type Matrix3 = [Three; 3];

/// Longest step, s.
const STEP: f64 = 2.5e-4;

/// Joints that come to rest in one step; more is a mistake of the plant.
const MOST_EVENTS: usize = 40;

/// Friction that falls with speed, beside that of the table: `fs exp(-(v/vs)^2)`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Stribeck {
    /// What is left of it at rest, N m.
    pub fs: f64,
    /// Speed, rad/s.
    pub vs: f64,
}

/// What the inertia is of where it is none.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct NoMotion {
    /// Time, s.
    pub time: f64,
    /// Pose, rad.
    pub q: Three,
}

impl std::fmt::Display for NoMotion {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let [q1, q2, q3] = self.q;
        write!(
            f,
            "at {:.3} s the inertia is not positive definite: q = [{q1:.3}, {q2:.3}, {q3:.3}]",
            self.time
        )
    }
}

impl std::error::Error for NoMotion {}

/// The device in motion.
#[derive(Debug, Clone)]
pub struct Plant {
    pi: Pi,
    stribeck: Option<[Stribeck; 3]>,
    /// Positions, then velocities.
    state: [f64; 6],
    /// Which way a joint slides, 0 where it stands.
    way: Three,
    time: f64,
}

/// `M` of (2).
#[must_use]
pub fn inertia(pi: &Pi, q: &Three) -> Matrix3 {
    let [_, t2, t3] = *q;
    let first =
        pi[0] + pi[1] * (2.0 * t2).cos() + pi[2] * (2.0 * t3).cos() + pi[3] * t2.cos() * t3.sin();
    let across = -0.5 * pi[3] * (t2 - t3).sin();
    [
        [first, 0.0, 0.0],
        [0.0, pi[4], across],
        [0.0, across, pi[5]],
    ]
}

/// `C dq + N` of (2), by Lagrange's equations.
#[must_use]
pub fn bias(pi: &Pi, q: &Three, v: &Three) -> Three {
    let [_, t2, t3] = *q;
    let (s2, c2, s3, c3) = (t2.sin(), t2.cos(), t3.sin(), t3.cos());
    let c23 = (t2 - t3).cos();
    // Slopes of M11.
    let by_2 = -2.0 * pi[1] * (2.0 * t2).sin() - pi[3] * s2 * s3;
    let by_3 = -2.0 * pi[2] * (2.0 * t3).sin() + pi[3] * c2 * c3;
    [
        v[0] * (by_2 * v[1] + by_3 * v[2]),
        -0.5 * v[0] * v[0] * by_2 + 0.5 * pi[3] * c23 * v[2] * v[2] + pi[6] * c2,
        -0.5 * v[0] * v[0] * by_3 - 0.5 * pi[3] * c23 * v[1] * v[1] + pi[7] * s3,
    ]
}

/// Velocities of the end point by those of the joints, `[axis][joint]`, m, with links of these lengths.
#[must_use]
pub fn tip_jacobian([l1, l2]: &[f64; 2], q: &Three) -> Matrix3 {
    let [(s1, c1), (s2, c2), (s3, c3)] = q.map(f64::sin_cos);
    let reach = l1 * c2 + l2 * s3;
    [
        [reach * c1, -l1 * s2 * s1, l2 * c3 * s1],
        [0.0, l1 * c2, l2 * s3],
        [-reach * s1, -l1 * s2 * c1, l2 * c3 * c1],
    ]
}

impl Plant {
    /// At rest at a pose.
    #[must_use]
    pub fn new(pi: Pi, q: Three) -> Self {
        Self {
            pi,
            stribeck: None,
            state: [q[0], q[1], q[2], 0.0, 0.0, 0.0],
            way: [0.0; 3],
            time: 0.0,
        }
    }

    /// With friction that falls with speed.
    #[must_use]
    pub fn with_stribeck(self, stribeck: [Stribeck; 3]) -> Self {
        Self {
            stribeck: Some(stribeck),
            ..self
        }
    }

    /// Positions, rad.
    #[must_use]
    pub fn q(&self) -> Three {
        [self.state[0], self.state[1], self.state[2]]
    }

    /// Velocities, rad/s.
    #[must_use]
    pub fn dq(&self) -> Three {
        [self.state[3], self.state[4], self.state[5]]
    }

    /// Friction of a joint that slides one way.
    fn friction(&self, joint: usize, way: f64, v: f64) -> f64 {
        let extra = self.stribeck.map_or(0.0, |all| {
            all[joint].fs * (-(v / all[joint].vs).powi(2)).exp()
        });
        way * (self.pi[11 + joint] + extra) + self.pi[8 + joint] * v
    }

    /// Accelerations, and the friction that each joint that stands needs to go on standing.
    fn accelerations(&self, way: &Three, x: &[f64; 6], tau: &Three) -> (Three, Three) {
        let (q, v) = ([x[0], x[1], x[2]], [x[3], x[4], x[5]]);
        let m = inertia(&self.pi, &q);
        let bias = bias(&self.pi, &q, &v);
        let load: Three = std::array::from_fn(|j| tau[j] - bias[j]);
        let free: Three = std::array::from_fn(|j| load[j] - self.friction(j, way[j], v[j]));
        let mut a = [0.0; 3];
        if way[0] != 0.0 {
            a[0] = free[0] / m[0][0];
        }
        match (way[1] != 0.0, way[2] != 0.0) {
            (true, true) => {
                let determinant = m[1][1] * m[2][2] - m[1][2] * m[1][2];
                a[1] = (m[2][2] * free[1] - m[1][2] * free[2]) / determinant;
                a[2] = (m[1][1] * free[2] - m[1][2] * free[1]) / determinant;
            }
            (true, false) => a[1] = free[1] / m[1][1],
            (false, true) => a[2] = free[2] / m[2][2],
            (false, false) => {}
        }
        let held = std::array::from_fn(|j| {
            let inertial: f64 = (0..3).map(|k| m[j][k] * a[k]).sum();
            load[j] - inertial
        });
        (a, held)
    }

    /// Lets go of joints, one after the other, whose friction does not hold them.
    fn let_go(&mut self, tau: &Three) {
        for _ in 0..3 {
            let (_, held) = self.accelerations(&self.way, &self.state, tau);
            let excess = |j: usize| held[j].abs() - self.friction(j, 1.0, 0.0);
            let standing = (0..3).filter(|&j| self.way[j] == 0.0);
            let Some(j) = standing.max_by(|&i, &j| excess(i).total_cmp(&excess(j))) else {
                return;
            };
            if excess(j) <= 0.0 {
                return;
            }
            self.way[j] = held[j].signum();
        }
    }

    /// Moves on by `seconds` under a constant torque.
    ///
    /// # Errors
    /// [`NoMotion`] where the inertia is not positive definite: from there on no motion follows from a torque.
    pub fn advance(&mut self, tau: &Three, seconds: f64) -> Result<(), NoMotion> {
        let end = self.time + seconds;
        let step = seconds / (seconds / STEP).ceil();
        while self.time < end - 0.5 * step {
            self.step(tau, step)?;
        }
        Ok(())
    }

    fn step(&mut self, tau: &Three, h: f64) -> Result<(), NoMotion> {
        let m = inertia(&self.pi, &self.q());
        if m[0][0] <= 0.0 || m[1][1] * m[2][2] <= m[1][2] * m[1][2] {
            return Err(NoMotion {
                time: self.time,
                q: self.q(),
            });
        }
        let mut left = h;
        for _ in 0..MOST_EVENTS {
            self.let_go(tau);
            let next = self.after(tau, left);
            // Which of the joints comes to rest first, by a straight line of its velocity.
            let rest = (0..3)
                .filter(|&j| self.way[j] * next[3 + j] < 0.0)
                .map(|j| {
                    let (from, to) = (self.state[3 + j], next[3 + j]);
                    (j, (from / (from - to)).clamp(0.0, 1.0))
                })
                .min_by(|x, y| x.1.total_cmp(&y.1));
            let Some((joint, part)) = rest else {
                self.state = next;
                self.time += left;
                return Ok(());
            };
            self.state = self.after(tau, part * left);
            self.state[3 + joint] = 0.0;
            self.way[joint] = 0.0;
            self.time += part * left;
            left *= 1.0 - part;
        }
        self.time += left;
        Ok(())
    }

    /// The state after `h` seconds with all joints going on as they do.
    fn after(&self, tau: &Three, h: f64) -> [f64; 6] {
        let slope = |_: f64, x: &[f64; 6]| {
            let (a, _) = self.accelerations(&self.way, x, tau);
            [x[3], x[4], x[5], a[0], a[1], a[2]]
        };
        rk4(slope, self.time, &self.state, h)
    }
}

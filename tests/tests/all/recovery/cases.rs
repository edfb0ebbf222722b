//! Machines with one effect each, and what their parameters are in the words of the effect's file.

use super::plant::{GRAVITY, Law, Tones, advance, dry};

/// Parameters by the names that the spec gives them, from a machine's body and its constants.
pub type Found = fn(&[f64], &[f64]) -> Vec<(&'static str, f64)>;

/// A machine with an effect, and what identification has to find.
pub struct Case {
    /// Declared effects of the first joint.
    pub effects: &'static str,
    pub body: &'static [f64],
    pub law: Law,
    pub constants: &'static [f64],
    pub found: Found,
    /// Standard deviation of the torque's noise, N m.
    pub noise: f64,
    pub tones: Tones,
    /// Another motion, to judge the model on.
    pub other: Tones,
}

/// Inertia and first moments.
pub const PENDULUM: &[f64] = &[0.6, 1.1, 0.2];

/// Two sums of sines without a common period, fast and wide enough for a rigid body and its friction.
const SWING: Tones = &[&[(0.9, 0.31, 0.2), (0.5, 0.83, 1.1), (0.15, 1.9, 2.3)]];
const OTHER_SWING: Tones = &[&[(0.8, 0.27, 1.4), (0.5, 0.71, 0.3), (0.15, 2.1, 0.9)]];

const TWO_LINKS: &[f64] = &[1.2, 2.1, 0.2, 0.4, 1.3, 0.15];

const TWO_SWINGS: Tones = &[
    &[(0.9, 0.31, 0.2), (0.5, 0.83, 1.1), (0.15, 1.9, 2.3)],
    &[(1.1, 0.37, 1.7), (0.6, 0.97, 0.4), (0.2, 1.7, 0.8)],
];
const OTHER_TWO_SWINGS: Tones = &[
    &[(0.8, 0.27, 1.4), (0.5, 0.71, 0.3), (0.15, 2.1, 0.9)],
    &[(1.2, 0.41, 0.1), (0.5, 0.89, 2.4), (0.2, 1.5, 1.8)],
];

pub const CASES: &[Case] = &[
    Case {
        effects: "coulomb_friction on j; viscous_friction on j; position_dependent_friction on j;",
        body: PENDULUM,
        // `A cos(k q + phi) s(dq)`
        constants: &[1.5, 0.8, 0.7, 3.0, 0.9],
        law: |p, _, now| (p[0] + p[2] * (p[3] * now.q + p[4]).cos()) * dry(now.dq) + p[1] * now.dq,
        found: |_, p| {
            vec![
                ("j.coulomb_friction.fc", p[0]),
                ("j.viscous_friction.fv", p[1]),
                ("j.position_dependent_friction.a", p[2] * p[4].cos()),
                ("j.position_dependent_friction.b", -p[2] * p[4].sin()),
                ("j.position_dependent_friction.k", p[3]),
            ]
        },
        noise: 0.1,
        tones: SWING,
        other: OTHER_SWING,
    },
    Case {
        effects: "coulomb_friction on j; viscous_friction on j; parameter_drift on j;",
        body: PENDULUM,
        // Viscous friction that falls from `fv` by `p[2]` with the time constant `p[3]`.
        constants: &[1.5, 2.5, 1.2, 15.0],
        law: |p, _, now| {
            p[0] * dry(now.dq) + (p[1] - p[2] * (1.0 - (-now.time / p[3]).exp())) * now.dq
        },
        found: |_, p| {
            vec![
                ("j.coulomb_friction.fc", p[0]),
                ("j.viscous_friction.fv", p[1]),
                // What it falls by in the first minute.
                ("j.parameter_drift.fv", p[2] * (-60.0 / p[3]).exp_m1()),
                ("j.parameter_drift.settle", p[3]),
            ]
        },
        noise: 0.1,
        tones: SWING,
        other: OTHER_SWING,
    },
    Case {
        effects: "viscous_friction on j; lugre_presliding on j;",
        body: PENDULUM,
        // Stiffness and damping of the bristles, torques of sliding and of breaking away, Stribeck's speed, viscous friction.
        constants: &[150.0, 3.0, 1.5, 2.4, 0.1, 0.8],
        law: |p, z, now| {
            let g = p[2] + (p[3] - p[2]) * (-(now.dq / p[4]).powi(2)).exp();
            let rate = |z: f64| now.dq - p[0] * now.dq.abs() / g * z;
            advance(z, now.step, rate);
            p[0] * *z + p[1] * rate(*z) + p[5] * now.dq
        },
        found: |_, p| {
            vec![
                ("j.viscous_friction.fv", p[5]),
                ("j.lugre_presliding.fc", p[2]),
                ("j.lugre_presliding.s1", p[1]),
                ("j.lugre_presliding.d", p[2] / p[0]),
                ("j.lugre_presliding.vs", p[4]),
                ("j.lugre_presliding.rise", p[3] / p[2] - 1.0),
            ]
        },
        noise: 0.05,
        tones: &[&[(0.4, 0.11, 0.2), (0.1, 0.43, 1.1), (0.03, 1.3, 2.3)]],
        other: &[&[(0.35, 0.13, 1.2), (0.1, 0.47, 0.1), (0.03, 1.1, 0.3)]],
    },
    Case {
        effects: "viscous_friction on j; dahl on j;",
        body: PENDULUM,
        // `dF/dq = stiffness (1 - F / fc sign(dq))`
        constants: &[60.0, 1.5, 0.8],
        law: |p, z, now| {
            advance(z, now.step, |force| {
                p[0] * (now.dq - force / p[1] * now.dq.abs())
            });
            *z + p[2] * now.dq
        },
        found: |_, p| {
            vec![
                ("j.viscous_friction.fv", p[2]),
                ("j.dahl.fc", p[1]),
                ("j.dahl.d", p[1] / p[0]),
            ]
        },
        noise: 0.1,
        tones: SWING,
        other: OTHER_SWING,
    },
    Case {
        effects: "coulomb_friction on j; viscous_friction on j; cable_hysteresis on j;",
        body: PENDULUM,
        // `dz/dt = dq (1 - abs(z)^n (B sign(dq z) + C))`, torque `D z`
        constants: &[0.8, 0.8, 10.0, 20.0, 10.0, 1.5],
        law: |p, z, now| {
            advance(z, now.step, |z| {
                now.dq * (1.0 - z.abs().powf(p[5]) * (p[3] * (now.dq * z).signum() + p[4]))
            });
            p[2] * *z + p[0] * dry(now.dq) + p[1] * now.dq
        },
        found: |_, p| {
            let width = (p[3] + p[4]).powf(-1.0 / p[5]);
            vec![
                ("j.coulomb_friction.fc", p[0]),
                ("j.viscous_friction.fv", p[1]),
                ("j.cable_hysteresis.f", p[2] * width),
                ("j.cable_hysteresis.width", width),
                ("j.cable_hysteresis.beta", p[3] / (p[3] + p[4])),
                ("j.cable_hysteresis.n", p[5]),
            ]
        },
        noise: 0.1,
        tones: SWING,
        other: OTHER_SWING,
    },
    Case {
        effects: "coulomb_friction on j; viscous_friction on j; gravity_compensation_spring on j;",
        body: PENDULUM,
        // Dry and viscous friction; stiffness, length at rest, both distances, position of the greatest length.
        constants: &[1.5, 0.8, 900.0, 0.25, 0.3, 0.12, 1.4],
        law: |p, _, now| {
            let (a, b, angle) = (p[4], p[5], now.q - p[6]);
            let length = (a * a + b * b + 2.0 * a * b * angle.cos()).sqrt();
            let slope = -a * b * angle.sin() / length;
            p[2] * (length - p[3]) * slope + p[0] * dry(now.dq) + p[1] * now.dq
        },
        found: |body, p| {
            let s = p[2] * p[4] * p[5];
            vec![
                // What the spring has in common with a weight regroups into the link's first moments.
                ("j.mxr", body[1] + s * p[6].sin() / GRAVITY),
                ("j.myr", body[2] + s * p[6].cos() / GRAVITY),
                ("j.coulomb_friction.fc", p[0]),
                ("j.viscous_friction.fv", p[1]),
                (
                    "j.gravity_compensation_spring.p",
                    p[2] * p[3] * (p[4] * p[5]).sqrt(),
                ),
                (
                    "j.gravity_compensation_spring.apart",
                    (p[4] - p[5]).powi(2) / (p[4] * p[5]),
                ),
                ("j.gravity_compensation_spring.q0", p[6]),
            ]
        },
        noise: 0.1,
        tones: SWING,
        other: OTHER_SWING,
    },
    Case {
        effects: "rokae on j;",
        body: PENDULUM,
        // `fc1, fc2, fv1, fv2, fv3, eps`
        constants: &[2.0, 1.4, 1.6, 0.15, -0.08, 0.03],
        law: |p, _, now| {
            let v = now.dq;
            let fc = if v > 0.0 { p[0] } else { p[1] };
            if v.abs() < p[5] {
                (v / p[5]).abs() * fc * v.signum()
            } else {
                fc * v.signum() + p[2] * v + p[3] * v * v + p[4] * v * v * v
            }
        },
        found: |_, p| {
            vec![
                ("j.rokae.fc1", p[0]),
                ("j.rokae.fc2", p[1]),
                ("j.rokae.fv1", p[2]),
                ("j.rokae.fv2", p[3]),
                ("j.rokae.fv3", p[4]),
                ("j.rokae.eps", p[5]),
            ]
        },
        noise: 0.05,
        tones: SWING,
        other: OTHER_SWING,
    },
    Case {
        effects: "coulomb_friction on j; viscous_friction on j; transmission_efficiency on j;",
        body: TWO_LINKS,
        // Efficiency where the motor drives, and where it is driven.
        constants: &[1.0, 0.8, 0.8, 0.7],
        law: |p, _, now| {
            let drives = 0.5 * (1.0 + dry(now.dq) * now.load.signum());
            let loss = drives * (1.0 / p[2] - 1.0) + (1.0 - drives) * (p[3] - 1.0);
            loss * now.load + p[0] * dry(now.dq) + p[1] * now.dq
        },
        found: |_, p| {
            vec![
                ("j.coulomb_friction.fc", p[0]),
                ("j.viscous_friction.fv", p[1]),
                ("j.transmission_efficiency.driving", 1.0 / p[2] - 1.0),
                ("j.transmission_efficiency.driven", 1.0 - p[3]),
            ]
        },
        noise: 0.1,
        tones: TWO_SWINGS,
        other: OTHER_TWO_SWINGS,
    },
    Case {
        effects: "coulomb_friction on j; viscous_friction on j; torque_gain on j;",
        body: TWO_LINKS,
        constants: &[1.0, 0.8, 1.15],
        law: |p, _, now| p[2] * (now.load + p[0] * dry(now.dq) + p[1] * now.dq) - now.load,
        found: |_, p| {
            vec![
                ("j.coulomb_friction.fc", p[2] * p[0]),
                ("j.viscous_friction.fv", p[2] * p[1]),
                ("j.torque_gain.excess", p[2] - 1.0),
            ]
        },
        noise: 0.1,
        tones: TWO_SWINGS,
        other: OTHER_TWO_SWINGS,
    },
];

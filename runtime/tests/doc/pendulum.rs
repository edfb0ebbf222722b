// The arm of the documentation's examples, which include this file: one pendulum, its columns written by hand, a candidate, a log.

use robot_model::columns::{Arm, Candidate, Columns, Entry, MomentumArm, Shape, Unknown};
use robot_model::identify::{PossibleArms, PossibleLink};
use robot_model::log::Log;
use robot_model::motion::{Kinematics, Motion};

/// `tau = izz ddq + mx sin(q) + fv dq`
pub struct Pendulum {
    unknowns: [Unknown; 3],
    joints: [String; 1],
}

/// `tau = fc sign(dq)`
pub struct DryFriction([Unknown; 1]);

fn unknown(name: &str) -> Unknown {
    Unknown {
        name: name.to_owned(),
        nonnegative: true,
    }
}

pub fn pendulum() -> Pendulum {
    Pendulum {
        unknowns: [
            unknown("link.izz"),
            unknown("link.mx"),
            unknown("joint.viscous_friction.fv"),
        ],
        joints: ["joint".to_owned()],
    }
}

pub fn dry_friction() -> DryFriction {
    DryFriction([unknown("joint.coulomb_friction.fc")])
}

/// 20 s at 500 Hz of a pendulum with `izz = 2`, `mx = 9`, `fv = 1`, dry friction `fc`, and a little noise.
pub fn measure(fc: f64) -> Log {
    measure_with([2.0, 9.0, 1.0], fc)
}

/// The same of a pendulum with other parameters.
pub fn measure_with([izz, mx, fv]: [f64; 3], fc: f64) -> Log {
    let time: Vec<f64> = (0..10_000).map(|k| 0.002 * f64::from(k)).collect();
    let wave = |t: f64, power: i32, shift: f64| -> f64 {
        let terms = [(0.1, 0.9), (0.4, 0.4), (0.9, 0.1)].iter();
        terms
            .map(|(hz, size)| (std::f64::consts::TAU * hz, size))
            .map(|(w, size)| size * w.powi(power) * (w * t + w + shift).sin())
            .sum()
    };
    let quarter = 0.25 * std::f64::consts::TAU;
    let mut random = 1_u32;
    let tau = time.iter().map(|&t| {
        let (q, dq, ddq) = (
            wave(t, 0, 0.0),
            wave(t, 1, quarter),
            wave(t, 2, 2.0 * quarter),
        );
        random = random.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        let noise = 0.1 * (f64::from(random) / f64::from(u32::MAX) - 0.5);
        izz * ddq + mx * q.sin() + fv * dq + fc * robot_model::Scalar::sign(dq) + noise
    });
    let tau = vec![tau.collect()];
    let q = vec![time.iter().map(|&t| wave(t, 0, 0.0)).collect()];
    Log::from_samples("pendulum", time, q, tau).expect("the samples are finite and uniform")
}

/// One sample, without accelerations: at 0.5 rad, with 2 rad/s.
pub fn swinging() -> Motion {
    let moving = Kinematics {
        q: vec![vec![0.5]],
        dq: vec![vec![2.0]],
        ddq: Vec::new(),
    };
    Motion {
        time: vec![0.0],
        smooth: moving.clone(),
        wide: moving,
        ..Motion::default()
    }
}

fn entry(column: usize, values: impl Iterator<Item = f64>) -> Entry {
    Entry {
        joint: 0,
        column,
        values: values.collect(),
    }
}

impl Columns for Pendulum {
    fn unknowns(&self) -> &[Unknown] {
        &self.unknowns
    }
    fn shapes(&self) -> &[Shape] {
        &[]
    }
    fn uses_rigid_torque(&self) -> bool {
        false
    }
    fn entries(&self, motion: &Motion, _: &[f64]) -> Vec<Entry> {
        let (smooth, wide) = (&motion.smooth, &motion.wide);
        vec![
            entry(0, smooth.ddq[0].iter().copied()),
            entry(1, smooth.q[0].iter().map(|q| q.sin())),
            entry(2, wide.dq[0].iter().copied()),
        ]
    }
}

impl Arm for Pendulum {
    fn dof(&self) -> usize {
        1
    }
    fn joints(&self) -> &[String] {
        &self.joints
    }
    fn actuator_gain(&self) -> &[f64] {
        &[1.0]
    }
    fn known_torque(&self, motion: &Motion, _: &[f64]) -> Vec<Vec<f64>> {
        vec![vec![0.0; motion.time.len()]]
    }
    fn rigid_torque(&self, motion: &Motion, _: &[f64], estimate: &[f64]) -> Vec<Vec<f64>> {
        let signals = motion.smooth.ddq[0].iter().zip(&motion.smooth.q[0]);
        vec![
            signals
                .map(|(ddq, q)| estimate[0] * ddq + estimate[1] * q.sin())
                .collect(),
        ]
    }
    /// Of a body that is `link`, and friction; where it hangs `g` is 1, so that `mx` is a first moment.
    fn possible_arms(&self) -> Option<PossibleArms> {
        let own = [
            "m", "mx", "my", "mz", "ixx", "ixy", "ixz", "iyy", "iyz", "izz",
        ];
        let mut names: Vec<String> = own.iter().map(|own| format!("link.{own}")).collect();
        names.push(self.unknowns[2].name.clone());
        let mut arms = PossibleArms::default();
        (arms.names, arms.fixed) = (names, vec![None; 11]);
        arms.kept = vec![9, 1, 10];
        arms.combinations = arms.kept.iter().map(|&k| vec![(k, 1.0)]).collect();
        let link = PossibleLink::new("link", std::array::from_fn(|k| k), None);
        arms.links = vec![link];
        arms.nonnegative = vec![10];
        Some(arms)
    }
}

/// `tau = d/dt (izz dq) + mx sin(q) + fv dq`
impl MomentumArm for Pendulum {
    fn momentum(&self, motion: &Motion, _: &[f64]) -> Vec<Entry> {
        vec![entry(0, motion.smooth.dq[0].iter().copied())]
    }
    fn drift(&self, motion: &Motion, _: &[f64]) -> Vec<Entry> {
        vec![
            entry(1, motion.smooth.q[0].iter().map(|q| -q.sin())),
            entry(2, motion.wide.dq[0].iter().map(|dq| -dq)),
        ]
    }
    fn known_momentum(&self, motion: &Motion, _: &[f64]) -> Vec<Vec<f64>> {
        vec![vec![0.0; motion.time.len()]]
    }
    fn known_drift(&self, motion: &Motion, _: &[f64]) -> Vec<Vec<f64>> {
        vec![vec![0.0; motion.time.len()]]
    }
}

impl Columns for DryFriction {
    fn unknowns(&self) -> &[Unknown] {
        &self.0
    }
    fn shapes(&self) -> &[Shape] {
        &[]
    }
    fn uses_rigid_torque(&self) -> bool {
        false
    }
    fn entries(&self, motion: &Motion, _: &[f64]) -> Vec<Entry> {
        vec![entry(
            0,
            motion.wide.dq[0]
                .iter()
                .map(|&dq| robot_model::Scalar::sign(dq)),
        )]
    }
}

impl Candidate for DryFriction {
    fn kind(&self) -> &'static str {
        "coulomb-friction"
    }
    fn joints(&self) -> &[usize] {
        &[0]
    }
}

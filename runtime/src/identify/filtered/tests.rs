//! A wheel with dry friction, which stands at each turn.

use super::*;
use crate::columns::{Arm, Columns, Entry, Shape, Unknown};
use crate::identify::AtTurns;
use crate::motion::Motion;

mod factors;

/// `tau = J ddq + fv dq + fc sign(dq)`
struct Wheel([Unknown; 3], [String; 1]);

const TRUTH: [f64; 3] = [0.02, 0.05, 0.3];
const RATE: f64 = 500.0;
const CORNER: f64 = 5.0;

impl Wheel {
    fn new() -> Self {
        let unknown = |name: &str| Unknown {
            name: name.to_owned(),
            nonnegative: true,
        };
        let names = ["J", "fv", "fc"].map(unknown);
        Self(names, ["wheel".to_owned()])
    }
}

fn column(column: usize, values: Vec<f64>) -> Entry {
    Entry {
        joint: 0,
        column,
        values,
    }
}

fn friction(motion: &Motion, sign: f64) -> [Entry; 2] {
    let dq = &motion.wide.dq[0];
    [
        column(1, dq.iter().map(|dq| sign * dq).collect()),
        column(2, dq.iter().map(|dq| sign * dq.signum()).collect()),
    ]
}

fn nothing(motion: &Motion) -> Vec<Vec<f64>> {
    vec![vec![0.0; motion.time.len()]]
}

impl Columns for Wheel {
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
        let inertia = column(0, motion.smooth.ddq[0].clone());
        [inertia].into_iter().chain(friction(motion, 1.0)).collect()
    }
}

impl Arm for Wheel {
    fn dof(&self) -> usize {
        1
    }

    fn joints(&self) -> &[String] {
        &self.1
    }

    fn actuator_gain(&self) -> &[f64] {
        &[1.0]
    }

    fn known_torque(&self, motion: &Motion, _: &[f64]) -> Vec<Vec<f64>> {
        nothing(motion)
    }

    fn rigid_torque(&self, motion: &Motion, _: &[f64], _: &[f64]) -> Vec<Vec<f64>> {
        nothing(motion)
    }

    fn dry_joints(&self) -> &[usize] {
        &[0]
    }
}

impl MomentumArm for Wheel {
    fn momentum(&self, motion: &Motion, _: &[f64]) -> Vec<Entry> {
        vec![column(0, motion.smooth.dq[0].clone())]
    }

    fn drift(&self, motion: &Motion, _: &[f64]) -> Vec<Entry> {
        friction(motion, -1.0).to_vec()
    }

    fn known_momentum(&self, motion: &Motion, _: &[f64]) -> Vec<Vec<f64>> {
        nothing(motion)
    }

    fn known_drift(&self, motion: &Motion, _: &[f64]) -> Vec<Vec<f64>> {
        nothing(motion)
    }
}

/// The wheel under two tones of torque, from some time on: friction holds it for a while at each turn, with whatever torque there is.
fn log(from: f64) -> Log {
    const STEPS: u32 = 20;
    let [inertia, viscous, dry] = TRUTH;
    let torque = |t: f64| 0.5 * (3.0 * (t + from)).sin() + 0.2 * (7.1 * (t + from) + 1.0).sin();
    let step = 1.0 / (RATE * f64::from(STEPS));
    let (mut q, mut v) = (0.0, 0.0_f64);
    let (mut time, mut positions, mut torques) = (Vec::new(), Vec::new(), Vec::new());
    for k in 0..20_000_u32 {
        let at = |j: u32| f64::from(k) / RATE + step * f64::from(j);
        time.push(at(0));
        positions.push(q);
        torques.push(torque(at(0)));
        for j in 0..STEPS {
            let tau = torque(at(j) + 0.5 * step);
            let way = if v == 0.0 { tau.signum() } else { v.signum() };
            let push = tau - way * dry - viscous * v;
            let next = v + step * push / inertia;
            // It stands where it would turn, and where dry friction holds it.
            let stands = v * next < 0.0 || (v == 0.0 && tau.abs() < dry);
            let next = if stands { 0.0 } else { next };
            q += 0.5 * step * (v + next);
            v = next;
        }
    }
    Log::from_samples("wheel", time, vec![positions], vec![torques]).expect("samples are in order")
}

/// What `L` remembers of stands is in rows long behind them, unless it starts anew there.
#[test]
fn what_holds_a_joint_that_stands_is_not_in_the_rows_behind_it() {
    let wheel = Wheel::new();
    let logs = [log(0.0)];
    let off = |at_turns: AtTurns| {
        let identify = Identify {
            at_turns,
            ..Identify::default()
        };
        let found = identify.fit_filtered(&wheel, &logs, Some(CORNER));
        let found = found.expect("a log that tells all").values();
        let off = found.iter().zip(TRUTH).map(|(x, truth)| x / truth - 1.0);
        off.fold(0.0, |most: f64, off| most.max(off.abs()))
    };
    let [kept, left_out] = [AtTurns::Kept, AtTurns::LeftOut].map(off);
    assert!(kept > 0.02, "{kept}");
    assert!(left_out < 0.002, "{left_out}");
}

/// What is made up in a hole is in `L{tau}` for some time behind it.
#[test]
fn what_is_made_up_in_holes_is_not_in_the_rows_behind_them() {
    let [inertia, viscous, _] = TRUTH;
    let time: Vec<f64> = (0..10_000).map(|k| f64::from(k) / RATE).collect();
    let sum = |w: f64, of: &dyn Fn(f64, f64) -> f64| -> Vec<f64> {
        let tones = |t: &f64| of(3.0, *t) + 0.3 * of(7.1, *t) * w;
        time.iter().map(tones).collect()
    };
    let q = sum(1.0, &|w, t| (w * t).sin());
    let tau = sum(1.0, &|w, t| {
        viscous * w * (w * t).cos() - inertia * w * w * (w * t).sin()
    });
    let mut log = Log::from_samples("wheel", time, vec![q], vec![tau]).expect("samples in order");
    for start in [3.0, 7.0, 11.0, 15.0] {
        log.holes.push(start..start + 0.14);
        let samples = (0..log.time.len())
            .filter(|&k| log.holes.iter().any(|hole| hole.contains(&log.time[k])));
        for k in samples.collect::<Vec<usize>>() {
            log.tau[0][k] = 0.3;
        }
    }
    let found = Identify::default().fit_filtered(&Wheel::new(), &[log], Some(CORNER));
    let found = found.expect("a log that tells all").values();
    for (found, truth) in found.iter().zip([inertia, viscous, 0.0]) {
        assert!(
            (found - truth).abs() < 2e-3 * viscous,
            "{found} for {truth}"
        );
    }
}

use super::super::{Curve, FrictionError, Law, Measured};
use crate::columns::{Arm, Columns, Entry, Shape, Unknown};
use crate::log::Log;
use crate::motion::Motion;

/// A weight on a lever: `tau = a cos q + b sin q`.
struct Lever {
    names: Vec<String>,
    unknowns: Vec<Unknown>,
}

impl Lever {
    fn new() -> Self {
        let unknown = |name: &str| Unknown {
            name: name.to_owned(),
            nonnegative: false,
        };
        Self {
            names: vec!["lever".to_owned()],
            unknowns: vec![unknown("a"), unknown("b")],
        }
    }
}

impl Columns for Lever {
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
        let q = &motion.smooth.q[0];
        let column = |column, of: fn(f64) -> f64| Entry {
            joint: 0,
            column,
            values: q.iter().map(|q| of(*q)).collect(),
        };
        vec![column(0, f64::cos), column(1, f64::sin)]
    }
}

impl Arm for Lever {
    fn dof(&self) -> usize {
        1
    }
    fn joints(&self) -> &[String] {
        &self.names
    }
    fn actuator_gain(&self) -> &[f64] {
        &[1.0]
    }
    fn known_torque(&self, motion: &Motion, _: &[f64]) -> Vec<Vec<f64>> {
        vec![vec![0.0; motion.time.len()]]
    }
    fn rigid_torque(&self, motion: &Motion, _: &[f64], _: &[f64]) -> Vec<Vec<f64>> {
        vec![vec![0.0; motion.time.len()]]
    }
}

const RATE: f64 = 250.0;
const WEIGHT: f64 = 8.0;
const VISCOUS: f64 = 0.6;

/// To and fro between -1 and 1 rad at six speeds, with torques that come `late` seconds after the positions.
fn to_and_fro(late: f64) -> Log {
    let mut legs = Vec::new();
    for k in 1..=6 {
        let speed = 0.3 * f64::from(k);
        legs.extend([speed, -speed, speed, -speed]);
    }
    let place = |t: f64| -> (f64, f64) {
        let mut start = 0.0;
        for &speed in &legs {
            let length = 2.0 / f64::abs(speed);
            if t < start + length {
                return (-speed.signum() + speed * (t - start).max(0.0), speed);
            }
            start += length;
        }
        (-1.0, 0.0)
    };
    let seconds: f64 = legs.iter().map(|speed| 2.0 / speed.abs()).sum();
    let time = (0..100_000_u32).map(|k| f64::from(k) / RATE);
    let time: Vec<f64> = time.take_while(|t| *t < seconds).collect();
    let torque = |(k, t): (usize, &f64)| {
        let (q, speed) = place(t - late);
        let noise = 0.02 * (12.9898 * (k * k % 7919) as f64).sin();
        WEIGHT * q.sin() + 0.5 * speed.signum() + VISCOUS * speed + noise
    };
    let tau = time.iter().enumerate().map(torque).collect();
    let q = time.iter().map(|t| place(*t).0).collect();
    Log::from_samples("to and fro", time, vec![q], vec![tau]).expect("a sound log")
}

fn curve(late: f64, known: Option<Vec<f64>>) -> Result<Curve, FrictionError> {
    let lever = Lever::new();
    let measured = Measured {
        arm: &lever,
        joint: 0,
        shapes: Vec::new(),
        columns: vec![0, 1],
        known,
    };
    measured.curve(&[to_and_fro(late)])
}

/// What is late of a weight that hangs down is `-d WEIGHT cos(q)` times the speed, in the mean over the way `d WEIGHT sin(1)`: of 20 ms a
/// fifth of the viscous friction.
#[test]
fn late_torques_are_seen_and_bend_no_friction() {
    for known in [None, Some(vec![0.0, WEIGHT])] {
        for late in [0.02, -0.012] {
            let curve = curve(late, known.clone()).expect("a curve");
            let found = curve.late.expect("seen");
            let bent = late * WEIGHT * f64::sin(1.0);
            assert!(bent.abs() > 0.13 * VISCOUS, "{bent}");
            assert!((found.value - late).abs() < 1e-3, "{found:?}");
            let law = Law::fit(&curve).expect("a law");
            assert!(
                (law.viscous.value - VISCOUS).abs() < 0.02,
                "{:?}",
                law.viscous
            );
        }
    }
}

#[test]
fn torques_of_the_same_time_are_not_late() {
    for known in [None, Some(vec![0.0, WEIGHT])] {
        let curve = curve(0.0, known).expect("a curve");
        assert_eq!(curve.late, None);
        let law = Law::fit(&curve).expect("a law");
        assert!(
            (law.viscous.value - VISCOUS).abs() < 0.02,
            "{:?}",
            law.viscous
        );
    }
}

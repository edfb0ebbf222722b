//! Laws for tests of the tracer.

use robot_model::columns::{Candidate, Columns, Entry, Shape, Unknown};
use robot_model::motion::{Kinematics, Motion};
use robot_model::trace::Verdict;

use crate::plant::column;

/// One column on one joint, a function of `(q, dq, shape)`.
pub struct Law {
    kind: &'static str,
    joint: [usize; 1],
    unknowns: [Unknown; 1],
    shapes: Vec<Shape>,
    torque: fn(f64, f64, f64) -> f64,
    is_of_position: bool,
}

impl Law {
    pub fn new(
        kind: &'static str,
        joint: usize,
        nonnegative: bool,
        grid: Option<Vec<f64>>,
        torque: fn(f64, f64, f64) -> f64,
    ) -> Self {
        Self {
            kind,
            joint: [joint],
            unknowns: [Unknown {
                name: format!("joint{}.{kind}.c", joint + 1),
                nonnegative,
            }],
            shapes: grid
                .into_iter()
                .map(|grid| Shape {
                    name: format!("joint{}.{kind}.shape", joint + 1),
                    grid,
                })
                .collect(),
            torque,
            is_of_position: false,
        }
    }

    /// The same, known as one of the position alone.
    pub fn of_position(self) -> Self {
        Self {
            is_of_position: true,
            ..self
        }
    }
}

impl Columns for Law {
    fn unknowns(&self) -> &[Unknown] {
        &self.unknowns
    }

    fn shapes(&self) -> &[Shape] {
        &self.shapes
    }

    fn uses_rigid_torque(&self) -> bool {
        false
    }

    fn entries(&self, motion: &Motion, shapes: &[f64]) -> Vec<Entry> {
        let j = self.joint[0];
        let shape = shapes.first().copied().unwrap_or(0.0);
        let Kinematics { q, dq, .. } = &motion.wide;
        vec![column(
            q[j].iter()
                .zip(&dq[j])
                .map(|(q, v)| (self.torque)(*q, *v, shape)),
            j,
            0,
        )]
    }
}

impl Candidate for Law {
    fn kind(&self) -> &str {
        self.kind
    }

    fn joints(&self) -> &[usize] {
        &self.joint
    }

    fn is_of_position(&self) -> bool {
        self.is_of_position
    }
}

pub fn names(verdict: &Verdict) -> Vec<(&str, usize)> {
    verdict
        .findings
        .iter()
        .map(|finding| (finding.kind.as_str(), finding.joints[0] + 1))
        .collect()
}

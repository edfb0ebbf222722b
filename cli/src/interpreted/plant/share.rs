//! What effects share in the torque, run at one instant.

use nalgebra::{DMatrix, DVector};
use robot_model::simulate::Instant;
use robot_model_codegen::Share;
use robot_model_codegen::interpreter::Scratch;

use super::super::runner::{Numbers, Runner, matrix};

/// Programs of a [`Share`] with their constants in place.
#[derive(Debug, Clone)]
pub(super) struct ShareRunner {
    /// How many there are of its own.
    pub switches: usize,
    joints: usize,
    torque: Runner,
    arguments: Runner,
    jumps: Runner,
}

/// A share's torque and its slopes.
pub(super) struct SharedTorque {
    /// `E`, `n`.
    pub torque: DVector<f64>,
    /// `d E / d ddq`, `n` by `n`.
    pub by_acceleration: DMatrix<f64>,
    /// `d E / d R`, `n` by `n`.
    pub by_load: DMatrix<f64>,
}

/// How it jumps, as [`Jumps`](robot_model::simulate::Jumps) have it, for the joints or for their links.
pub(super) struct SharedJumps {
    pub halves: DMatrix<f64>,
    pub directions: DMatrix<f64>,
    pub drifts: DVector<f64>,
}

impl ShareRunner {
    /// Of an arm with so many joints.
    pub fn new(share: Share, joints: usize, numbers: &Numbers) -> Self {
        Self {
            switches: share.switches,
            joints,
            torque: Runner::new(share.torque, numbers),
            arguments: Runner::new(share.arguments, numbers),
            jumps: Runner::new(share.jumps, numbers),
        }
    }

    pub fn runners(&mut self) -> impl Iterator<Item = &mut Runner> {
        [&mut self.torque, &mut self.arguments, &mut self.jumps].into_iter()
    }

    /// `E`, `d E / d ddq` and `d E / d R`, row by row; `load` is what the share sees as the torque of the rigid body.
    pub fn run(&mut self, at: &Instant<'_>, load: &[f64]) -> &Scratch {
        self.torque.run(at, load)
    }

    /// The same as matrices.
    pub fn torque(&mut self, at: &Instant<'_>, load: &[f64]) -> SharedTorque {
        let n = self.joints;
        let found = self.run(at, load);
        SharedTorque {
            torque: DVector::from_fn(n, |joint, _| found.output(joint)),
            by_acceleration: matrix(found, n, n, n),
            by_load: matrix(found, n + n * n, n, n),
        }
    }

    /// What its switches are the signs of.
    pub fn arguments(&mut self, at: &Instant<'_>) -> impl Iterator<Item = f64> {
        let found = self.arguments.run(at, &[]);
        (0..self.switches).map(|k| found.output(k))
    }

    /// Where its switches stand while nothing sticks.
    pub fn signs(&mut self, at: &Instant<'_>) -> impl Iterator<Item = f64> {
        self.arguments(at)
            .map(|x| if x == 0.0 { 0.0 } else { x.signum() })
    }

    pub fn jumps(&mut self, at: &Instant<'_>, load: &[f64]) -> SharedJumps {
        let (n, m) = (self.joints, self.switches);
        let found = self.jumps.run(at, load);
        SharedJumps {
            halves: matrix(found, 0, n, m),
            directions: matrix(found, n * m, m, n),
            drifts: DVector::from_fn(m, |k, _| found.output(2 * n * m + k)),
        }
    }
}

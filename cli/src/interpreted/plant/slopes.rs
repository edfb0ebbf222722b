//! Programs of slopes, made when the first implicit step asks for them.

use nalgebra::DMatrix;
use robot_model_codegen::PlantSlopes;
use robot_model_codegen::interpreter::Scratch;

use super::super::runner::{Numbers, Runner, matrix};

#[derive(Debug, Clone)]
pub(super) struct SlopeRunners {
    pub rigid_by_position: Runner,
    pub coriolis: Runner,
    pub effects: Runner,
    pub forces: Option<Runner>,
    pub rates: Runner,
}

impl SlopeRunners {
    pub fn new(slopes: PlantSlopes, numbers: &Numbers) -> Self {
        let runner = |program| Runner::new(program, numbers);
        Self {
            rigid_by_position: runner(slopes.rigid_by_position),
            coriolis: runner(slopes.coriolis_matrix),
            effects: runner(slopes.effects),
            forces: slopes.forces.map(runner),
            rates: runner(slopes.rates),
        }
    }
}

/// Slopes of a share of the torque, all else held.
pub(super) struct MotionSlopes {
    /// By position and by velocity, `n` by `n`.
    pub by: [DMatrix<f64>; 2],
    /// By internal states, `n` by `p`.
    pub by_state: DMatrix<f64>,
}

impl MotionSlopes {
    pub fn new(found: &Scratch, n: usize, p: usize) -> Self {
        Self {
            by: [0, 1].map(|k| matrix(found, k * n * n, n, n)),
            by_state: matrix(found, 2 * n * n, n, p),
        }
    }
}

//! Energies, momentum, slopes and accelerations of an arm at one state, by the interpreter and by emitted code.

use nalgebra::DMatrix;
use robot_model::{FromParameters, Matrix, Mechanics, Vector};

use robot_model_codegen::interpreter::Program;

use crate::evaluate::Interpreter;
use crate::states::{State, typed};

/// Every form beside the torque at one state.
#[derive(Debug, Clone, PartialEq)]
pub struct MechanicsForms {
    /// `T`
    pub kinetic_energy: f64,
    /// `V`, up to a constant.
    pub potential_energy: f64,
    /// `d tau / dq`
    pub by_position: DMatrix<f64>,
    /// `d tau / d dq`
    pub by_velocity: DMatrix<f64>,
    /// `Y_p` and `Y_h` of the standard parameters.
    pub standard: [DMatrix<f64>; 2],
    /// `Y_p` and `Y_h` of the base parameters.
    pub base: [DMatrix<f64>; 2],
}

/// By the interpreter.
#[must_use]
pub fn interpreted(interpreter: &Interpreter, standard: &[f64], state: &State) -> MechanicsForms {
    let compiled = &interpreter.compiled;
    let dof = compiled.dof();
    let run = |program: &Program| interpreter.run(program, standard, state, &vec![0.0; dof]);
    let square = |program: &Program| DMatrix::from_row_slice(dof, dof, &run(program));
    let dense = |blocks: &[robot_model_codegen::Block], columns: usize| {
        let mut dense = DMatrix::zeros(dof, columns);
        for block in blocks {
            for (&place, value) in block.entries.iter().zip(run(&block.program)) {
                dense[place] = value;
            }
        }
        dense
    };
    let energies = run(&compiled.energies());
    let (all, base) = (compiled.standard.len(), compiled.base.kept.len());
    MechanicsForms {
        kinetic_energy: energies[0],
        potential_energy: energies[1],
        by_position: square(&compiled.by_position()),
        by_velocity: square(&compiled.by_velocity()),
        standard: [
            dense(&[compiled.momentum_regressor()], all),
            dense(&[compiled.drift_regressor()], all),
        ],
        base: [
            dense(&[compiled.base_momentum()], base),
            dense(&[compiled.rigid_drift(), compiled.effect_drift()], base),
        ],
    }
}

/// By emitted code.
#[must_use]
pub fn emitted<
    R,
    const DOF: usize,
    const STANDARD: usize,
    const BASE: usize,
    const SHAPES: usize,
    const STATES: usize,
    const INPUTS: usize,
>(
    standard: &[f64],
    state: &State,
) -> MechanicsForms
where
    R: Mechanics<DOF, STANDARD, BASE, SHAPES, STATES, INPUTS>
        + FromParameters<DOF, STANDARD, BASE, SHAPES, STATES, INPUTS>,
{
    let arm = R::from_standard(&Vector::from_column_slice(standard));
    let (state, shapes) = (typed::<DOF, STATES, INPUTS>(state), arm.shapes());
    MechanicsForms {
        kinetic_energy: arm.kinetic_energy(&state.q, &state.dq),
        potential_energy: arm.potential_energy(&state.q),
        by_position: dense(&arm.inverse_dynamics_by_position_at(&state)),
        by_velocity: dense(&arm.inverse_dynamics_by_velocity_at(&state)),
        standard: [
            dense(&R::momentum_regressor_at(&state, &shapes)),
            dense(&R::drift_regressor_at(&state, &shapes)),
        ],
        base: [
            dense(&R::base_momentum_regressor_at(&state, &shapes)),
            dense(&R::base_drift_regressor_at(&state, &shapes)),
        ],
    }
}

/// Accelerations at a state under a torque, by emitted code.
#[must_use]
pub fn accelerations<
    R,
    const DOF: usize,
    const STANDARD: usize,
    const BASE: usize,
    const SHAPES: usize,
    const STATES: usize,
    const INPUTS: usize,
>(
    standard: &[f64],
    state: &State,
    tau: &[f64],
) -> Option<Vec<f64>>
where
    R: Mechanics<DOF, STANDARD, BASE, SHAPES, STATES, INPUTS>
        + FromParameters<DOF, STANDARD, BASE, SHAPES, STATES, INPUTS>,
{
    let arm = R::from_standard(&Vector::from_column_slice(standard));
    let tau = Vector::from_column_slice(tau);
    let found = arm.forward_dynamics_at(&typed::<DOF, STATES, INPUTS>(state), &tau)?;
    Some(found.as_slice().to_vec())
}

fn dense<const ROWS: usize, const COLUMNS: usize>(matrix: &Matrix<ROWS, COLUMNS>) -> DMatrix<f64> {
    DMatrix::from_column_slice(ROWS, COLUMNS, matrix.as_slice())
}

//! All forms of an arm as numbers at one state, by the interpreter; emitted code gives the same [`Forms`].

use nalgebra::DMatrix;
use robot_model_codegen::expr::Symbol;
use robot_model_codegen::interpreter::Program;
use robot_model_codegen::{Block, Compiled};

use crate::states::State;

/// Every form at one state.
#[derive(Debug, Clone, PartialEq)]
pub struct Forms {
    /// `M`
    pub mass_matrix: DMatrix<f64>,
    /// `C`
    pub coriolis_matrix: DMatrix<f64>,
    /// `G`
    pub gravity: DMatrix<f64>,
    /// `C dq + G`
    pub bias: DMatrix<f64>,
    /// `M ddq + C dq + G`, with the declared effects.
    pub inverse_dynamics: DMatrix<f64>,
    /// `Y`
    pub regressor: DMatrix<f64>,
    /// `Y_b`
    pub base_regressor: DMatrix<f64>,
}

/// The programs of an arm.
#[derive(Debug, Clone)]
pub struct Interpreter {
    /// What is interpreted.
    pub compiled: Compiled,
    /// Values of all shape parameters: as written, else in the middle of their range.
    pub shapes: Vec<f64>,
    mass_matrix: Program,
    coriolis_matrix: Program,
    gravity: Program,
    bias: Program,
    rigid_torque: Program,
    inverse_dynamics: Program,
    known_torque: Program,
    state_rates: Program,
    regressor: Block,
    base_regressor: Block,
}

impl Interpreter {
    /// Schedules all forms.
    #[must_use]
    pub fn new(compiled: Compiled) -> Self {
        Self {
            shapes: robot_model_codegen::base::shape_values(&compiled.model),
            mass_matrix: compiled.mass_matrix(),
            coriolis_matrix: compiled.coriolis_matrix(),
            gravity: compiled.gravity(),
            bias: Program::new(&compiled.dag, &compiled.dynamics.bias),
            rigid_torque: compiled.rigid_torque(),
            inverse_dynamics: compiled.inverse_dynamics(),
            known_torque: compiled.known_torque(),
            state_rates: Program::new(&compiled.dag, &compiled.dynamics.state_rates),
            regressor: compiled.regressor(),
            base_regressor: compiled.base_regressor(),
            compiled,
        }
    }

    /// Runs a program. `rigid` is the load that regressor columns are told; the equations compute it themselves.
    #[must_use]
    pub fn run(
        &self,
        program: &Program,
        standard: &[f64],
        state: &State,
        rigid: &[f64],
    ) -> Vec<f64> {
        let parameters = self
            .compiled
            .parameter_values(&self.compiled.base.beta(standard));
        program.eval(&|symbol| match symbol {
            Symbol::Q(j) => state.q[j],
            Symbol::Dq(j) => state.dq[j],
            Symbol::Ddq(j) => state.ddq[j],
            Symbol::RigidTorque(j) => rigid[j],
            Symbol::MeasuredTorque(j) => state.measured_torque[j],
            Symbol::Input(k) => state.inputs[k],
            Symbol::State(k) => state.states[k],
            Symbol::Switch(_) | Symbol::Weight(_) => {
                unreachable!("in equations of simulation and design alone")
            }
            Symbol::Time => state.time,
            Symbol::Parameter(k) => parameters[k],
            Symbol::Shape(k) => self.shapes[k],
        })
    }

    fn column(&self, program: &Program, standard: &[f64], state: &State) -> DMatrix<f64> {
        let values = self.run(program, standard, state, &[]);
        DMatrix::from_column_slice(values.len(), 1, &values)
    }

    /// `M ddq + C dq + G` at a state, with base parameters from `standard`.
    #[must_use]
    pub fn rigid_torque(&self, standard: &[f64], state: &State) -> DMatrix<f64> {
        self.column(&self.rigid_torque, standard, state)
    }

    /// Torque of what the spec fixes.
    #[must_use]
    pub fn known_torque(&self, standard: &[f64], state: &State) -> DMatrix<f64> {
        self.column(&self.known_torque, standard, state)
    }

    /// Rates of the effects' internal states, with the load that they are told.
    #[must_use]
    pub fn state_rates(&self, standard: &[f64], state: &State, rigid: &[f64]) -> DMatrix<f64> {
        let values = self.run(&self.state_rates, standard, state, rigid);
        DMatrix::from_column_slice(values.len(), 1, &values)
    }

    /// All forms at a state, with base parameters from `standard`.
    #[must_use]
    pub fn forms(&self, standard: &[f64], state: &State) -> Forms {
        let dof = self.compiled.dof();
        let square =
            |program| DMatrix::from_row_slice(dof, dof, &self.run(program, standard, state, &[]));
        let column = |program| self.column(program, standard, state);
        let rigid = self.rigid_torque(standard, state);
        let dense = |block: &Block, columns| {
            let values = self.run(&block.program, standard, state, rigid.as_slice());
            let mut dense = DMatrix::zeros(dof, columns);
            for (&place, value) in block.entries.iter().zip(values) {
                dense[place] = value;
            }
            dense
        };
        Forms {
            mass_matrix: square(&self.mass_matrix),
            coriolis_matrix: square(&self.coriolis_matrix),
            gravity: column(&self.gravity),
            bias: column(&self.bias),
            inverse_dynamics: column(&self.inverse_dynamics),
            regressor: dense(&self.regressor, self.compiled.standard.len()),
            base_regressor: dense(&self.base_regressor, self.compiled.base.kept.len()),
        }
    }
}

/// Largest difference of two matrices, relative to the largest entry of the second.
#[must_use]
pub fn relative_difference(found: &DMatrix<f64>, wanted: &DMatrix<f64>) -> f64 {
    assert_eq!(found.shape(), wanted.shape());
    (found - wanted).amax() / wanted.amax().max(f64::MIN_POSITIVE)
}

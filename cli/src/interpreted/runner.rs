//! Programs that are run one instant at a time.

use nalgebra::DMatrix;
use robot_model::simulate::Instant;
use robot_model_codegen::expr::Symbol;
use robot_model_codegen::interpreter::{Program, Scratch};

/// A program with its constants in place, run one instant at a time.
#[derive(Debug, Clone)]
pub(super) struct Runner {
    program: Program,
    scratch: Scratch,
    values: Vec<f64>,
}

/// Numbers for the parameters of an arm.
#[derive(Debug, Clone)]
pub(super) struct Numbers {
    /// As `Compiled::parameter_values` gives them.
    pub parameters: Vec<f64>,
    pub shapes: Vec<f64>,
}

impl Runner {
    pub fn new(program: Program, numbers: &Numbers) -> Self {
        let mut found = Self {
            scratch: program.scratch(),
            values: vec![0.0; program.symbols().len()],
            program,
        };
        found.set(numbers);
        found
    }

    /// Puts other numbers in.
    pub fn set(&mut self, numbers: &Numbers) {
        for (value, symbol) in self.values.iter_mut().zip(self.program.symbols()) {
            *value = match *symbol {
                Symbol::Parameter(k) => numbers.parameters[k],
                Symbol::Shape(k) => numbers.shapes[k],
                _ => continue,
            };
        }
    }

    /// `load` is the torque of the rigid body, where the program reads it.
    pub fn run(&mut self, at: &Instant<'_>, load: &[f64]) -> &Scratch {
        for (value, symbol) in self.values.iter_mut().zip(self.program.symbols()) {
            *value = match *symbol {
                Symbol::Q(joint) => at.q[joint],
                Symbol::Dq(joint) => at.dq[joint],
                Symbol::Ddq(joint) => at.ddq[joint],
                Symbol::RigidTorque(joint) => load[joint],
                Symbol::MeasuredTorque(joint) => at.torque[joint],
                Symbol::Time => at.time,
                Symbol::Input(k) => at.inputs[k],
                Symbol::State(k) => at.memory[k],
                Symbol::Switch(k) => at.switches[k],
                Symbol::Parameter(_) | Symbol::Shape(_) => continue,
                Symbol::Weight(_) => unreachable!("a plant has no weights"),
            };
        }
        self.program.eval_in(&self.values, &mut self.scratch);
        &self.scratch
    }
}

/// The outputs from `first` on, row by row.
pub(super) fn matrix(scratch: &Scratch, first: usize, rows: usize, columns: usize) -> DMatrix<f64> {
    DMatrix::from_fn(rows, columns, |row, column| {
        scratch.output(first + row * columns + column)
    })
}

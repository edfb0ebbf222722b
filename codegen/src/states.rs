//! Internal states of effects: `dz/dt = f(z, signals)`, and `df/dz` beside it.
//!
//! In: rates. Out: [`StateEquations`] for emission, [`StateProgram`] for the interpreter; both are stepped as the runtime says
//! in its module `memory`.

use crate::expr::{Dag, ExprId, Symbol};
use crate::interpreter::Program;

/// The states of one effect, which depend on each other and on no other's.
#[derive(Debug, Clone)]
#[non_exhaustive]
pub struct StateEquations {
    /// Number of the first state, as in [`Symbol::State`].
    pub first: usize,
    /// One per state.
    pub rates: Vec<ExprId>,
    /// `d rate / d state`, row by row.
    pub jacobian: Vec<ExprId>,
    /// Whether the rates are affine in the states.
    pub is_affine: bool,
}

/// The same as a program.
#[derive(Debug, Clone)]
#[non_exhaustive]
pub struct StateProgram {
    /// Number of the first state.
    pub first: usize,
    /// How many states there are.
    pub count: usize,
    /// The rates, then the Jacobian row by row.
    pub program: Program,
    /// Whether the rates are affine in the states.
    pub is_affine: bool,
}

/// `rates` has one expression per state, in the order of [`Symbol::State`]; `counts` is how many of them belong to each
/// effect. Effects without states have no entry.
pub fn equations(
    dag: &mut Dag,
    rates: &[ExprId],
    counts: impl IntoIterator<Item = usize>,
) -> Vec<StateEquations> {
    let mut first = 0;
    let mut equations = Vec::new();
    for count in counts {
        if count > 0 {
            equations.push(StateEquations::new(
                dag,
                first,
                &rates[first..first + count],
            ));
        }
        first += count;
    }
    equations
}

impl StateEquations {
    fn new(dag: &mut Dag, first: usize, rates: &[ExprId]) -> Self {
        let count = rates.len();
        let mut jacobian = vec![dag.zero(); count * count];
        for column in 0..count {
            let derivatives = dag.derivatives(rates, Symbol::State(first + column));
            for (row, derivative) in derivatives.into_iter().enumerate() {
                jacobian[row * count + column] = derivative;
            }
        }
        let is_affine = dag.is_affine(rates, &|symbol| matches!(symbol, Symbol::State(_)));
        Self {
            first,
            rates: rates.to_vec(),
            jacobian,
            is_affine,
        }
    }

    /// The states, in their order.
    pub fn symbols(&self) -> impl Iterator<Item = Symbol> + use<> {
        (self.first..self.first + self.rates.len()).map(Symbol::State)
    }

    /// The rates, then the Jacobian row by row.
    #[must_use]
    pub fn outputs(&self) -> Vec<ExprId> {
        [&self.rates[..], &self.jacobian].concat()
    }

    /// To run.
    #[must_use]
    pub fn program(&self, dag: &Dag) -> StateProgram {
        let outputs = self.outputs();
        StateProgram {
            first: self.first,
            count: self.rates.len(),
            program: Program::new(dag, &outputs),
            is_affine: self.is_affine,
        }
    }
}

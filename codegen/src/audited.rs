//! Programs of what an arm must not do: have no inertia, gain energy from friction.

use crate::compiled::Compiled;
use crate::expr::{ExprId, Symbol};
use crate::interpreter::Program;

impl Compiled {
    /// `d tau / d ddq` at rest, row by row: `M(q)` and what effects add, as rotors do. Reads base parameters as
    /// [`Compiled::inverse_dynamics`] does, `q`, shapes, and states.
    #[must_use]
    pub fn inertia_at_rest(&self) -> Program {
        let mut dag = self.dag.clone();
        let columns: Vec<Vec<ExprId>> = (0..self.dof())
            .map(|joint| dag.derivatives(&self.dynamics.inverse_dynamics, Symbol::Ddq(joint)))
            .collect();
        let rows = (0..self.dof()).flat_map(|row| columns.iter().map(move |column| column[row]));
        let outputs: Vec<ExprId> = rows.collect();
        let zero = dag.zero();
        let outputs = dag.substitute(&outputs, &|symbol| {
            let is_still = matches!(
                symbol,
                Symbol::Dq(_)
                    | Symbol::Ddq(_)
                    | Symbol::Time
                    | Symbol::Input(_)
                    | Symbol::MeasuredTorque(_)
            );
            is_still.then_some(zero)
        });
        Program::new(&dag, &outputs)
    }

    /// Torque of the declared effects alone, under the arm's own load: one output a joint.
    #[must_use]
    pub fn effect_torque(&self) -> Program {
        Program::new(&self.dag, &self.dynamics.effect_torque)
    }
}

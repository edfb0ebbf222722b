//! Programs of what an arm must not do: have no inertia, gain energy from friction, be too heavy for its motors.

use crate::compiled::Compiled;
use crate::expr::{Dag, ExprId, Symbol};
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
        let outputs = at_rest(&mut dag, &outputs);
        Program::new(&dag, &outputs)
    }

    /// `tau(q, 0, 0)`, what holds the arm where it stands: gravity, and what effects add at rest, as springs do. One output a joint; reads
    /// base parameters as [`Compiled::inverse_dynamics`] does, `q`, shapes, and states.
    #[must_use]
    pub fn torque_at_rest(&self) -> Program {
        let mut dag = self.dag.clone();
        let outputs = at_rest(&mut dag, &self.dynamics.inverse_dynamics);
        Program::new(&dag, &outputs)
    }

    /// Torque of the declared effects alone, under the arm's own load: one output a joint.
    #[must_use]
    pub fn effect_torque(&self) -> Program {
        Program::new(&self.dag, &self.dynamics.effect_torque)
    }
}

/// What stands still is zero, and so is what nobody has measured.
fn at_rest(dag: &mut Dag, outputs: &[ExprId]) -> Vec<ExprId> {
    let zero = dag.zero();
    dag.substitute(outputs, &|symbol| {
        let is_still = matches!(
            symbol,
            Symbol::Dq(_)
                | Symbol::Ddq(_)
                | Symbol::Time
                | Symbol::Input(_)
                | Symbol::MeasuredTorque(_)
        );
        is_still.then_some(zero)
    })
}

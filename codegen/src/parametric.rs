//! Slopes of a simulated motion's equations by what is unknown in them.
//!
//! In: a [`Compiled`]. Out: [`PlantParameters`], slopes of all that a [`Plant`](crate::plant::Plant) and a
//! [`Linkage`](crate::linkage::Linkage) have by base parameters and by shapes that the spec leaves open.

use crate::compiled::Compiled;
use crate::expr::{Dag, ExprId, Symbol};
use crate::interpreter::Program;
use crate::linkage::LinkEquations;
use crate::plant::Equations;

/// Slopes by `u` unknowns: the kept base parameters, then the free shapes, each in its order. Matrices are row by row, a column an unknown.
#[derive(Debug, Clone)]
#[non_exhaustive]
pub struct PlantParameters {
    /// Of the torque of the rigid body, `n u` outputs.
    pub rigid: Program,
    /// Of that of effects, `n u`.
    pub effects: Program,
    /// Of forces of the world, where they are apart.
    pub forces: Option<Program>,
    /// Of the states' rates, `p u`.
    pub rates: Program,
    /// Of what switches are the signs of, `m u`: those of effects.
    pub arguments: Program,
    /// The same of forces.
    pub force_arguments: Option<Program>,
    /// Of the displacements of springs, `s u`.
    pub give: Program,
    /// Of the displacements of links that joints place, and of their first and second rates, `3 k u`.
    pub place: Program,
}

fn jacobian(dag: &mut Dag, roots: &[ExprId], unknowns: &[Symbol]) -> Program {
    let columns: Vec<Vec<ExprId>> = unknowns
        .iter()
        .map(|&unknown| dag.derivatives(roots, unknown))
        .collect();
    let outputs = (0..roots.len()).flat_map(|row| columns.iter().map(move |column| column[row]));
    let outputs: Vec<ExprId> = outputs.collect();
    Program::new(dag, &outputs)
}

impl Compiled {
    /// What a simulation has unknown, as symbols: kept base parameters, then free shapes.
    fn unknown_symbols(&self) -> Vec<Symbol> {
        let base = self.base.kept.iter().map(|&k| Symbol::Parameter(k));
        base.chain(self.free_shapes().into_iter().map(Symbol::Shape))
            .collect()
    }

    /// Slopes of the equations of motion by what is unknown.
    #[must_use]
    pub fn plant_parameters(&self) -> PlantParameters {
        let unknowns = self.unknown_symbols();
        let Equations {
            mut dag,
            effects,
            forces,
        } = self.switched();
        let rates = self.reading_rigid_torque(&mut dag, &self.dynamics.state_rates);
        let mut slopes = |roots: &[ExprId]| jacobian(&mut dag, roots, &unknowns);
        let rigid = slopes(&self.computed.rigid_torque);
        let rates = slopes(&rates);
        let (effects, arguments) = (slopes(&effects.roots), slopes(&effects.arguments));
        let forces = forces.map(|forces| (slopes(&forces.roots), slopes(&forces.arguments)));
        let (forces, force_arguments) = forces.unzip();
        let LinkEquations {
            mut dag,
            gives,
            places,
            ..
        } = self.link_equations();
        PlantParameters {
            rigid,
            effects,
            forces,
            rates,
            arguments,
            force_arguments,
            give: jacobian(&mut dag, &gives, &unknowns),
            place: jacobian(&mut dag, &places.concat(), &unknowns),
        }
    }
}

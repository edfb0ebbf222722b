//! The equations as a simulation wants them: dry friction's sign as an unknown, and the slopes of everything.
//!
//! In: a [`Compiled`]. Out: a [`Plant`], programs whose outputs make up `tau = R(q, dq, ddq) + E(q, dq, ddq, z, s, R)`: the torque `R`
//! of the rigid body is affine in `ddq`, that `E` of effects has its load from it. Where `E` jumps with a position, a velocity or
//! time it has a switch `s` in place of the sign, see [`Dag::switched`](crate::expr::Dag::switched); what else jumps stays.
//!
//! Where links move against their motors, forces of the world are on the links, all else is on the motors' side: `E` is in two
//! parts then, that read the motion of either.

use crate::compiled::{Compiled, base_values};
use crate::dynamics::{Means, loaded_effect_torque};
use crate::expr::{Dag, ExprId, Switched, Symbol};
use crate::interpreter::Program;

/// Programs of the motion. All read base parameters as [`Compiled::inverse_dynamics`] does; matrices are row by row.
#[derive(Debug, Clone)]
#[non_exhaustive]
pub struct Plant {
    /// Degrees of freedom, `n`.
    pub dof: usize,
    /// Internal states of effects, `p`.
    pub states: usize,
    /// `R`, `n` outputs.
    pub rigid_torque: Program,
    /// `d R / d ddq = M`, `n n` outputs.
    pub mass_matrix: Program,
    /// Effects, without those of `forces`.
    pub effects: Share,
    /// Forces of the world where links move against their motors: `q`, `dq`, `ddq` and `R` are those of the links.
    pub forces: Option<Share>,
    /// Rates of the states, `p` outputs; the load of those that depend on it is outside.
    pub rates: Program,
    /// Whether `tau` is affine in `ddq`.
    pub is_affine: bool,
    /// Whether anything depends on time or on channels.
    pub is_timed: bool,
}

/// What effects share in the torque, `E`.
#[derive(Debug, Clone)]
#[non_exhaustive]
pub struct Share {
    /// Its own switches, `m`. Those of forces have their symbols behind those of other effects.
    pub switches: usize,
    /// `E`, `d E / d ddq` and `d E / d R`: `n`, `n n` and `n n` outputs.
    pub torque: Program,
    /// What switches are the signs of, `m` outputs.
    pub arguments: Program,
    /// Half of what `E` jumps by, `n m` outputs; slopes of the arguments by `dq`, `m n`; their rates beside that, by `q` and time,
    /// `m` outputs.
    pub jumps: Program,
}

/// Programs of slopes, for implicit steps.
#[derive(Debug, Clone)]
#[non_exhaustive]
pub struct PlantSlopes {
    /// `d R / dq`, `n n` outputs.
    pub rigid_by_position: Program,
    /// `C`: `d R / d dq` is twice that.
    pub coriolis_matrix: Program,
    /// `d E / dq`, `d E / d dq`, `d E / dz`: `n n`, `n n`, `n p` outputs.
    pub effects: Program,
    /// The same of [`Plant::forces`].
    pub forces: Option<Program>,
    /// Of the states' rates by `q`, `dq`, `ddq` and `R`, each `p n` outputs, and by `z`, `p p`.
    pub rates: Program,
}

/// What both are made of.
pub(crate) struct Equations {
    pub dag: Dag,
    pub effects: Switched,
    pub forces: Option<Switched>,
}

impl Compiled {
    pub(crate) fn switched(&self) -> Equations {
        let mut dag = self.dag.clone();
        let values = base_values(&self.standard, &self.base, self.baked.as_deref());
        let is_parted = self.displacements().is_some();
        let means: &[Means] = if is_parted {
            &[Means::Torque]
        } else {
            &[Means::Torque, Means::Force]
        };
        let mut share = |means: &[Means]| {
            let torque = loaded_effect_torque(&mut dag, &self.model, &values, means);
            let torque = self.reading_rigid_torque(&mut dag, &torque);
            dag.switched(&torque)
        };
        let effects = share(means);
        let forces = is_parted.then(|| share(&[Means::Force]));
        let forces = forces.filter(|forces| forces.roots.iter().any(|&root| !dag.is_zero(root)));
        let first = effects.arguments.len();
        let forces = forces.map(|forces| forces.behind(&mut dag, first));
        Equations {
            dag,
            effects,
            forces,
        }
    }

    /// The equations of motion for simulation.
    #[must_use]
    pub fn plant(&self) -> Plant {
        let Equations {
            mut dag,
            effects,
            forces,
        } = self.switched();
        let rates = self.reading_rigid_torque(&mut dag, &self.dynamics.state_rates);
        let torques = [Some(&effects), forces.as_ref()];
        let torques = torques.into_iter().flatten();
        let roots = torques.clone().flat_map(|share| share.roots.clone());
        // A load that is bent, as by `abs`, makes the torque so in the accelerations.
        let is_affine = dag.is_affine(&roots.collect::<Vec<_>>(), &|symbol| {
            matches!(symbol, Symbol::Ddq(_) | Symbol::RigidTorque(_))
        });
        let everything = torques.flat_map(|share| [&share.roots[..], &share.arguments].concat());
        let everything: Vec<ExprId> = everything.chain(rates.iter().copied()).collect();
        let is_timed = dag
            .symbols(&everything)
            .iter()
            .any(|symbol| matches!(symbol, Symbol::Time | Symbol::Input(_)));
        Plant {
            dof: self.dof(),
            states: rates.len(),
            rigid_torque: self.rigid_torque(),
            mass_matrix: self.mass_matrix(),
            rates: Program::new(&dag, &rates),
            effects: Share::new(&mut dag, effects, self.dof()),
            forces: forces.map(|forces| Share::new(&mut dag, forces, self.dof())),
            is_affine,
            is_timed,
        }
    }

    /// Slopes of the equations for simulation; for arms of many joints this takes a while.
    #[must_use]
    pub fn plant_slopes(&self) -> PlantSlopes {
        let Equations {
            mut dag,
            effects,
            forces,
        } = self.switched();
        let dof = self.dof();
        let rates = self.reading_rigid_torque(&mut dag, &self.dynamics.state_rates);
        let states = rates.len();
        let mut slopes = |roots: &[ExprId], by: &[fn(usize) -> Symbol]| {
            let outputs = by.iter().flat_map(|&symbol| {
                let count = match symbol(0) {
                    Symbol::State(_) => states,
                    _ => dof,
                };
                jacobian(&mut dag, roots, count, symbol)
            });
            let outputs: Vec<ExprId> = outputs.collect();
            Program::new(&dag, &outputs)
        };
        let motion = [Symbol::Q, Symbol::Dq, Symbol::State];
        PlantSlopes {
            rigid_by_position: slopes(&self.computed.rigid_torque, &[Symbol::Q]),
            coriolis_matrix: self.coriolis_matrix(),
            effects: slopes(&effects.roots, &motion),
            forces: forces.map(|forces| slopes(&forces.roots, &motion)),
            rates: slopes(
                &rates,
                &[
                    Symbol::Q,
                    Symbol::Dq,
                    Symbol::Ddq,
                    Symbol::RigidTorque,
                    Symbol::State,
                ],
            ),
        }
    }
}

impl Share {
    fn new(dag: &mut Dag, switched: Switched, dof: usize) -> Self {
        let Switched {
            roots,
            halves,
            arguments,
        } = switched;
        let by_acceleration = jacobian(dag, &roots, dof, Symbol::Ddq);
        let by_load = jacobian(dag, &roots, dof, Symbol::RigidTorque);
        let along = |dag: &mut Dag, argument: ExprId| {
            let mut terms = vec![dag.derivative(argument, Symbol::Time)];
            for joint in 0..dof {
                let slope = dag.derivative(argument, Symbol::Q(joint));
                let speed = dag.symbol(Symbol::Dq(joint));
                terms.push(dag.mul(slope, speed));
            }
            dag.sum(terms)
        };
        let drifts: Vec<ExprId> = arguments.iter().map(|&x| along(dag, x)).collect();
        let directions = jacobian(dag, &arguments, dof, Symbol::Dq);
        Self {
            switches: arguments.len(),
            torque: Program::new(dag, &[roots, by_acceleration, by_load].concat()),
            arguments: Program::new(dag, &arguments),
            jumps: Program::new(dag, &[halves.concat(), directions, drifts].concat()),
        }
    }
}

/// Slopes by the first `count` symbols, row by row.
pub(crate) fn jacobian(
    dag: &mut Dag,
    roots: &[ExprId],
    count: usize,
    symbol: fn(usize) -> Symbol,
) -> Vec<ExprId> {
    let columns: Vec<Vec<ExprId>> = (0..count)
        .map(|k| dag.derivatives(roots, symbol(k)))
        .collect();
    (0..roots.len())
        .flat_map(|row| columns.iter().map(move |column| column[row]))
        .collect()
}

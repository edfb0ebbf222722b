//! Where columns are looked at: those of the rigid body where its links are, those of effects where the motors are.

use robot_model_spec::model::Model;
use robot_model_spec::parameter::StandardParameter;

use super::{State, value};
use crate::expr::{Dag, ExprId, Symbol};
use crate::rounded::Rounded;

/// Entries that are evaluated at one state.
struct Side {
    /// Places among all entries.
    places: Vec<usize>,
    roots: Vec<ExprId>,
    order: Vec<ExprId>,
}

/// The entries of all columns by the state that they are looked at: one side, or links and motors.
pub(super) struct Sides {
    sides: Vec<Side>,
    /// Joints whose links are not where their motors are.
    parted: Vec<usize>,
    /// Of all expressions, as they were found last.
    values: Vec<Rounded>,
    /// Entries of both sides.
    count: usize,
}

impl Sides {
    /// Of entries `(joint, standard parameter, expression)`.
    pub fn new(
        dag: &Dag,
        model: &Model,
        parameters: &[StandardParameter],
        entries: &[(usize, usize, ExprId)],
    ) -> Self {
        let parted: Vec<usize> = model
            .effects
            .iter()
            .flat_map(|effect| {
                let places = effect.definition.moved_links();
                places.map(|place| effect.joints[place])
            })
            .collect();
        let all = 0..entries.len();
        let is_of_links =
            |&k: &usize| parted.is_empty() || model.is_rigid(&parameters[entries[k].1]);
        let (links, motors): (Vec<usize>, Vec<usize>) = all.partition(is_of_links);
        let side = |places: Vec<usize>| {
            let roots: Vec<ExprId> = places.iter().map(|&k| entries[k].2).collect();
            Side {
                order: dag.reachable(&roots),
                places,
                roots,
            }
        };
        Self {
            sides: vec![side(links), side(motors)],
            parted,
            values: vec![Rounded::ZERO; dag.len()],
            count: entries.len(),
        }
    }

    /// Whether motors have a state of their own.
    pub fn are_two(&self) -> bool {
        !self.parted.is_empty()
    }

    /// The state of motors whose links are at one, where those that are parted from theirs are at another.
    pub fn motors(&self, links: &State, other: State) -> State {
        let mut motors = State {
            q: links.q.clone(),
            dq: links.dq.clone(),
            ddq: links.ddq.clone(),
            ..other
        };
        for &joint in &self.parted {
            motors.q[joint] = other.q[joint];
            motors.dq[joint] = other.dq[joint];
            motors.ddq[joint] = other.ddq[joint];
        }
        motors
    }

    /// Values of all entries, at the states of links and of motors.
    pub fn evaluate(&mut self, dag: &Dag, states: [&State; 2], shapes: &[f64]) -> Vec<Rounded> {
        let mut found = vec![Rounded::ZERO; self.count];
        for (side, state) in self.sides.iter().zip(states) {
            let bind = |symbol: Symbol| value(symbol, state, shapes);
            dag.evaluate_rounded(&side.order, &bind, &mut self.values);
            for (&place, root) in side.places.iter().zip(&side.roots) {
                found[place] = self.values[root.index()];
            }
        }
        found
    }
}

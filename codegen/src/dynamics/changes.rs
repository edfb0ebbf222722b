//! What declared effects change about the rigid body: where its joints stand, what its links carry, where gravity comes from.
//!
//! In: the acts of a model's effects. Out: [`Changes`], which the derivations of chains and of energies start from, so that every
//! form of the equations has them.

use robot_model_spec::model::{Act, Chain, Effect, Model};

use super::effect::{self, Scope};
use super::frame::rotation_about;
use super::inertia::LinkParameters;
use super::vector::{self, Vector};
use crate::expr::{Dag, ExprId, Function, Symbol};

/// Changes of a rigid body; without effects that act on it there are none.
#[derive(Debug, Clone)]
pub struct Changes {
    /// Position of every joint: `q`, or `q` and a constant more.
    pub positions: Vec<ExprId>,
    /// What changes along a motion is added to a position: `(joint, rad or m)`.
    pub displacements: Vec<(usize, ExprId)>,
    /// Bodies on links.
    bodies: Vec<(usize, LinkParameters)>,
    /// Angles by which the base is turned.
    tilts: Vec<[ExprId; 2]>,
    /// Seconds by which logged torques are late.
    pub delays: Vec<ExprId>,
}

impl Changes {
    /// `parameters` has one expression per standard parameter of the model.
    pub fn new(dag: &mut Dag, model: &Model, parameters: &[ExprId]) -> Self {
        let dof = model.joints.len();
        let mut changes = Self {
            positions: (0..dof).map(|joint| dag.symbol(Symbol::Q(joint))).collect(),
            displacements: Vec::new(),
            bodies: Vec::new(),
            tilts: Vec::new(),
            delays: Vec::new(),
        };
        let rigid_torque = effect::outside_rigid_torque(dag, dof);
        effect::each_declared(
            dag,
            model,
            parameters,
            &rigid_torque,
            &[],
            |dag, declared, scope| {
                changes.take(dag, declared, scope);
            },
        );
        changes
    }

    /// Those that need no parameters: without the bodies.
    pub fn of(dag: &mut Dag, model: &Model) -> Self {
        let nothing = vec![dag.zero(); model.standard_parameters().len()];
        Self::new(dag, model, &nothing)
    }

    fn take(&mut self, dag: &mut Dag, declared: &Effect, scope: &Scope<'_>) {
        let acts = effect::acts(dag, &declared.definition, scope);
        for (act, values) in declared.definition.acts.iter().zip(acts) {
            let joint = act.joint().map(|joint| declared.joints[joint]);
            match (act, joint) {
                (Act::Body { .. }, Some(joint)) => {
                    self.bodies
                        .push((joint, std::array::from_fn(|k| values[k])));
                }
                (Act::Tilt { .. }, _) => self.tilts.push([values[0], values[1]]),
                (Act::Delay { .. }, _) => self.delays.push(values[0]),
                (Act::Position { value, .. }, Some(joint)) => {
                    if declared.definition.is_constant(value) {
                        self.positions[joint] = dag.add(self.positions[joint], values[0]);
                    } else {
                        self.displacements.push((joint, values[0]));
                    }
                }
                // Acts are tilts, delays, or of a joint.
                _ => {}
            }
        }
    }

    /// The links with what they carry.
    pub fn load(&self, dag: &mut Dag, links: &mut [LinkParameters]) {
        for (joint, body) in &self.bodies {
            for (own, more) in links[*joint].iter_mut().zip(body) {
                *own = dag.add(*own, *more);
            }
        }
    }

    /// Gravity in the frame of the base as it stands.
    pub fn gravity(&self, dag: &mut Dag, chain: &Chain) -> Vector {
        let mut gravity = vector::constant(dag, chain.gravity);
        let axes = tilted_axes(chain.gravity);
        for angles in &self.tilts {
            for (axis, &angle) in axes.iter().zip(angles) {
                let (sin, cos) = (
                    dag.call(Function::Sin, angle),
                    dag.call(Function::Cos, angle),
                );
                let turn = rotation_about(dag, *axis, sin, cos);
                gravity = vector::apply_transposed(dag, &turn, gravity);
            }
        }
        gravity
    }
}

/// The axes of the base frame that are left without the one nearest to gravity, in the order x, y, z; without gravity x and y.
fn tilted_axes(gravity: [f64; 3]) -> [[f64; 3]; 2] {
    let size = |k: usize| gravity[k].abs();
    // The later of equals, so that no gravity leaves x and y.
    let along = (0..3)
        .max_by(|&i, &j| size(i).total_cmp(&size(j)))
        .unwrap_or(2);
    let axis = |k: usize| std::array::from_fn(|i| if i == k { 1.0 } else { 0.0 });
    match along {
        0 => [axis(1), axis(2)],
        1 => [axis(0), axis(2)],
        _ => [axis(0), axis(1)],
    }
}

#[cfg(test)]
mod tests {
    use super::tilted_axes;

    #[test]
    fn the_axis_nearest_to_gravity_is_left_out() {
        let (x, y, z) = ([1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]);
        assert_eq!(tilted_axes([0.0, 0.0, -9.81]), [x, y]);
        assert_eq!(tilted_axes([0.0, -9.81, 0.3]), [x, z]);
        assert_eq!(tilted_axes([9.81, 0.0, 0.0]), [y, z]);
        assert_eq!(tilted_axes([0.0; 3]), [x, y]);
    }
}

//! What effects change about the rigid body, in numbers: where joints stand, what links carry, where gravity comes from.

use nalgebra::{Rotation3, Vector3};
use robot_model_spec::model::Act;

use super::Twin;
use crate::expression;
use crate::states::State;

impl Twin<'_> {
    /// The state with joints where the links stand. Only for what does not change along a motion.
    pub(super) fn placed(&self, state: &State) -> State {
        let mut placed = state.clone();
        self.each_act(&self.nothing(), state, |act, joint, values| {
            if let (Act::Position { .. }, Some(joint)) = (act, joint) {
                placed.q[joint] += values[0];
            }
        });
        placed
    }

    /// Standard parameters, bodies added to those of their links.
    pub(super) fn loaded(&self, standard: &[f64], state: &State) -> Vec<f64> {
        let mut loaded = standard.to_vec();
        self.each_act(standard, state, |act, joint, values| {
            if let (Act::Body { .. }, Some(joint)) = (act, joint) {
                for (sum, more) in loaded[10 * joint..].iter_mut().zip(values) {
                    *sum += more;
                }
            }
        });
        loaded
    }

    /// Gravity in the frame of the base as it stands: turned about the first, then about the second of its level axes.
    pub(super) fn gravity(&self, state: &State) -> Vector3<f64> {
        let written = Vector3::from(self.model.chain().expect("the twin is of a chain").gravity);
        let mut axes = vec![Vector3::x_axis(), Vector3::y_axis(), Vector3::z_axis()];
        axes.remove(written.iamax());
        let mut base = Rotation3::identity();
        self.each_act(&self.nothing(), state, |act, _, values| {
            if let Act::Tilt { .. } = act {
                base *= Rotation3::from_axis_angle(&axes[0], values[0])
                    * Rotation3::from_axis_angle(&axes[1], values[1]);
            }
        });
        base.inverse() * written
    }

    /// What changes neither a place nor gravity is no matter here.
    fn nothing(&self) -> Vec<f64> {
        vec![0.0; self.model.standard_parameters().len()]
    }

    fn each_act(
        &self,
        standard: &[f64],
        state: &State,
        mut visit: impl FnMut(&Act, Option<usize>, &[f64]),
    ) {
        let no_load = vec![0.0; self.model.joints.len()];
        self.each_effect(standard, state, &no_load, |effect, scope| {
            for act in &effect.definition.acts {
                let values = act.values();
                let values: Vec<f64> = values
                    .map(|value| expression::value(value, scope))
                    .collect();
                visit(act, act.joint().map(|joint| effect.joints[joint]), &values);
            }
        });
    }
}

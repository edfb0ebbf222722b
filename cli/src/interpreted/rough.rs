//! Which columns of an effect jump or have a kink.

use robot_model_spec::Model;
use robot_model_spec::model::{
    BinaryOp, EffectDefinition, EffectExpr, EffectLeaf, Expr, Function, Signal,
};

/// Whether the column of a linear parameter is not smooth in the signals. States count as rough: they turn with the
/// reversals of what drives them.
pub(super) fn is_rough(definition: &EffectDefinition, parameter: usize) -> bool {
    let mut known = Known {
        parameter,
        bindings: Vec::new(),
    };
    for binding in &definition.bindings {
        let facts = Facts {
            rough: known.is_rough(&binding.value),
            has_parameter: known.has_parameter(&binding.value),
            has_rough_term: known.has_rough_term(&binding.value),
        };
        known.bindings.push(facts);
    }
    let mut torques = definition.torque_equations();
    torques.any(|value| known.has_rough_term(value))
}

/// Joints with friction that jumps with the sign of their velocity, and none that remembers.
pub(super) fn dry_joints(model: &Model) -> Vec<usize> {
    let with = |is_of: &dyn Fn(&EffectDefinition) -> bool| -> Vec<usize> {
        let effects = model.effects.iter();
        let effects = effects.filter(|effect| is_of(&effect.definition));
        effects.flat_map(|effect| effect.joints.clone()).collect()
    };
    let dry = with(&|definition| definition.joints.len() == 1 && jumps_at_turns(definition));
    let remembers = with(&|definition| !definition.states.is_empty());
    let joints = 0..model.joints.len();
    let is_dry = |joint: &usize| dry.contains(joint) && !remembers.contains(joint);
    joints.filter(is_dry).collect()
}

/// Whether a torque has the sign of a velocity in it.
fn jumps_at_turns(definition: &EffectDefinition) -> bool {
    let bindings = definition.bindings.iter().map(|binding| &binding.value);
    let mut all = bindings.chain(definition.torque_equations());
    all.any(|value| {
        value.contains(&|part| {
            let Expr::Call(Function::Sign, of) = part else {
                return false;
            };
            of.contains(&|part| matches!(part, Expr::Leaf(EffectLeaf::Signal(Signal::Velocity, _))))
        })
    })
}

/// What is known of a binding.
struct Facts {
    rough: bool,
    has_parameter: bool,
    has_rough_term: bool,
}

/// What is known of the bindings so far, with regard to one linear parameter.
struct Known {
    parameter: usize,
    bindings: Vec<Facts>,
}

impl Known {
    fn is_rough(&self, expr: &EffectExpr) -> bool {
        expr.contains(&|part| match part {
            Expr::Call(Function::Sign | Function::Tanh | Function::Abs, _)
            | Expr::Min(..)
            | Expr::Max(..)
            | Expr::Choice(_)
            | Expr::Leaf(EffectLeaf::State(_)) => true,
            Expr::Leaf(EffectLeaf::Binding(k)) => self.bindings[*k].rough,
            _ => false,
        })
    }

    fn has_parameter(&self, expr: &EffectExpr) -> bool {
        expr.contains(&|part| match part {
            Expr::Leaf(EffectLeaf::Linear(k)) => *k == self.parameter,
            Expr::Leaf(EffectLeaf::Binding(k)) => self.bindings[*k].has_parameter,
            _ => false,
        })
    }

    /// Looks at the terms of a sum in which the parameter occurs.
    fn has_rough_term(&self, sum: &EffectExpr) -> bool {
        match sum {
            Expr::Binary(BinaryOp::Add | BinaryOp::Sub, left, right) => {
                self.has_rough_term(left) || self.has_rough_term(right)
            }
            Expr::Neg(term) => self.has_rough_term(term),
            Expr::Leaf(EffectLeaf::Binding(k)) => self.bindings[*k].has_rough_term,
            term => self.has_parameter(term) && self.is_rough(term),
        }
    }
}

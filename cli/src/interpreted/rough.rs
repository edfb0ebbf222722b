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

/// Which of some shapes, by their names, are of friction that jumps on joints that are [`dry_joints`]. A law that has its own branch for
/// slow joints is told by rows at turns, so its shapes are not among them.
pub(super) fn dry_shapes<'a>(model: &Model, shapes: impl Iterator<Item = &'a str>) -> Vec<usize> {
    let dry = dry_joints(model);
    let effects = model.effects.iter().enumerate();
    let effects = effects.filter(|(_, effect)| {
        let joints = &effect.joints;
        let definition = &effect.definition;
        jumps_at_turns(definition)
            && !has_branch_of_slow(definition)
            && joints.iter().all(|joint| dry.contains(joint))
    });
    let prefixes: Vec<String> = effects
        .map(|(number, _)| format!("{}.", model.effect_name(number)))
        .collect();
    let is_dry = |name: &str| prefixes.iter().any(|prefix| name.starts_with(prefix));
    let shapes = shapes.enumerate().filter(|(_, name)| is_dry(name));
    shapes.map(|(number, _)| number).collect()
}

/// Whether a torque has the sign of a velocity in it.
fn jumps_at_turns(definition: &EffectDefinition) -> bool {
    has_part(
        definition,
        &|part, moving| matches!(part, Expr::Call(Function::Sign, of) if has_velocity(of, moving)),
    )
}

/// Whether a torque has another law below a speed that is a shape.
fn has_branch_of_slow(definition: &EffectDefinition) -> bool {
    let is_shape = |part: &EffectExpr| matches!(part, Expr::Leaf(EffectLeaf::Shape(_)));
    has_part(definition, &|part, moving| {
        let Expr::Choice(choice) = part else {
            return false;
        };
        let sides = [&choice.greater, &choice.smaller];
        sides.iter().any(|side| has_velocity(side, moving))
            && sides.iter().any(|side| side.contains(&is_shape))
    })
}

/// Whether a binding or a torque has a part that is so; the test is told which bindings read a velocity.
fn has_part(definition: &EffectDefinition, is_so: &dyn Fn(&EffectExpr, &[bool]) -> bool) -> bool {
    // Bindings use earlier ones alone.
    let mut moving: Vec<bool> = Vec::new();
    for binding in &definition.bindings {
        let is_moving = has_velocity(&binding.value, &moving);
        moving.push(is_moving);
    }
    let bindings = definition.bindings.iter().map(|binding| &binding.value);
    let mut all = bindings.chain(definition.torque_equations());
    all.any(|value| value.contains(&|part| is_so(part, &moving)))
}

/// Whether an expression reads a velocity; `moving` tells it of the bindings so far.
fn has_velocity(expr: &EffectExpr, moving: &[bool]) -> bool {
    expr.contains(&|part| match part {
        Expr::Leaf(EffectLeaf::Signal(Signal::Velocity, _)) => true,
        Expr::Leaf(EffectLeaf::Binding(k)) => moving[*k],
        _ => false,
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

#[cfg(test)]
mod tests {
    use super::*;

    fn model(effects: &str) -> Model {
        let text = format!(
            "robot A {{
                gravity = [0, 0, -9.81];
                convention = standard_dh;
                joint a: revolute {{ a = 0.5; alpha = 0; d = 0; }}
                joint b: revolute {{ a = 0.4; alpha = 0; d = 0; }}
                effects {{ {effects} }}
            }}"
        );
        let model = robot_model_spec::load("a.robot", &text);
        model.unwrap_or_else(|errors| panic!("{errors}"))
    }

    #[test]
    fn a_law_with_a_branch_of_its_own_for_slow_joints_is_told_at_turns() {
        let dry = |effects: &str, shape| dry_shapes(&model(effects), [shape].into_iter());
        let stribeck = "coulomb_friction on all; stribeck on a;";
        assert_eq!(dry(stribeck, "a.stribeck.vs"), [0]);
        assert_eq!(dry("rokae on a;", "a.rokae.eps"), [0; 0]);
    }

    #[test]
    fn dry_friction_is_seen_through_names_and_not_where_something_remembers() {
        let dry = |effects: &str| dry_joints(&model(effects));
        assert_eq!(dry("viscous_friction on all;"), [0; 0]);
        assert_eq!(dry("coulomb_friction on b;"), [1]);
        assert_eq!(dry("rokae on all;"), [0, 1]);
        assert_eq!(
            dry("asymmetric_viscous on all; cubic_viscous on all;"),
            [0; 0]
        );
        assert_eq!(dry("coulomb_friction on all; dahl on a;"), [1]);
    }
}

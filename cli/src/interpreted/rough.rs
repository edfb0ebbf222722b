//! Which columns of an effect jump or have a kink.

use robot_model_spec::model::{BinaryOp, EffectDefinition, EffectExpr, EffectLeaf, Expr, Function};

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

//! The table of identities: one rule a row, tried in order whenever a node is made.
//!
//! A rule changes no value by more than rounding, as long as nothing on the way to it is beyond what a number holds.

mod products;

#[cfg(test)]
mod tests;

use super::{Dag, ExprId, Function, Node};
use products::{collect_reordered, cosine_of_sum, differ, pythagoras, sine_of_sum};

/// An identity of a node with two operands.
pub struct Rule {
    /// The identity, for people and for the test table.
    pub name: &'static str,
    /// The simpler expression, where the rule applies. Operands come in canonical order.
    pub apply: fn(&mut Dag, ExprId, ExprId) -> Option<ExprId>,
}

/// An identity of a function call.
pub struct CallRule {
    /// The identity.
    pub name: &'static str,
    /// The simpler expression, where the rule applies.
    pub apply: fn(&mut Dag, Function, ExprId) -> Option<ExprId>,
}

/// An identity of a choice.
pub struct SelectRule {
    /// The identity.
    pub name: &'static str,
    /// The simpler expression of condition and values, where the rule applies.
    pub apply: fn(&mut Dag, ExprId, ExprId, ExprId) -> Option<ExprId>,
}

/// Identities of `x + y`.
pub const SUM: &[Rule] = &[
    Rule {
        name: "2 + 3 = 5",
        apply: fold_sum,
    },
    Rule {
        name: "x + 0 = x",
        apply: add_zero,
    },
    Rule {
        name: "c x + d x = (c + d) x",
        apply: collect,
    },
    Rule {
        name: "(y + c x) + d x = y + (c + d) x",
        apply: collect_nested,
    },
    Rule {
        name: "c x (y z) + d (x y) z = (c + d) x y z",
        apply: collect_reordered,
    },
    Rule {
        name: "k cos^2 x + k sin^2 x = k",
        apply: pythagoras,
    },
    Rule {
        name: "k cos x cos y - k sin x sin y = k cos(x + y)",
        apply: cosine_of_sum,
    },
    Rule {
        name: "k sin x cos y + k cos x sin y = k sin(x + y)",
        apply: sine_of_sum,
    },
    Rule {
        name: "c x + c y = c (x + y)",
        apply: common_coefficient,
    },
];

/// Identities of `x * y`.
pub const PRODUCT: &[Rule] = &[
    Rule {
        name: "2 * 3 = 6",
        apply: fold_product,
    },
    Rule {
        name: "0 x = 0",
        apply: mul_zero,
    },
    Rule {
        name: "1 x = x",
        apply: mul_one,
    },
    Rule {
        name: "c (d x) = (c d) x",
        apply: coefficients_meet,
    },
    Rule {
        name: "(c x) (d y) = (c d) (x y)",
        apply: coefficient_outside,
    },
    Rule {
        name: "x / x = 1",
        apply: cancel_quotient,
    },
    Rule {
        name: "abs(x) sign(x) = x",
        apply: modulus_times_sign,
    },
    Rule {
        name: "sqrt(x) sqrt(x) = x",
        apply: square_of_root,
    },
];

/// Identities of `f(x)`.
pub const CALL: &[CallRule] = &[
    CallRule {
        name: "exp(0) = 1",
        apply: fold_call,
    },
    CallRule {
        name: "cos(-x) = cos(x)",
        apply: even,
    },
    CallRule {
        name: "sin(-x) = -sin(x)",
        apply: odd,
    },
    CallRule {
        name: "abs(c x) = |c| abs(x)",
        apply: modulus_of_multiple,
    },
    CallRule {
        name: "1 / (c x) = (1 / c) (1 / x)",
        apply: recip_of_multiple,
    },
    CallRule {
        name: "1 / (1 / x) = x",
        apply: recip_twice,
    },
    CallRule {
        name: "abs(abs(x)) = abs(x)",
        apply: modulus_twice,
    },
];

/// Identities of `if c { x } else { y }`, where `c` holds when it is positive.
pub const SELECT: &[SelectRule] = &[
    SelectRule {
        name: "if 2 { x } else { y } = x",
        apply: known_choice,
    },
    SelectRule {
        name: "if c { x } else { x } = x",
        apply: equal_choices,
    },
    SelectRule {
        name: "if 2 c { x } else { y } = if c { x } else { y }",
        apply: scaled_condition,
    },
    SelectRule {
        name: "if c { k x } else { k y } = k if c { x } else { y }",
        apply: common_factor_of_choices,
    },
];

fn finite(dag: &mut Dag, value: f64) -> Option<ExprId> {
    value.is_finite().then(|| dag.folded(value))
}

/// `c d`, where that is a number with all its digits: in `1e-200 (1e-200 x)` it is not.
fn coefficient(dag: &mut Dag, c: f64, d: f64) -> Option<f64> {
    let is_sign = equal(c.abs(), 1.0) || equal(d.abs(), 1.0);
    (is_sign || (c * d).is_normal()).then(|| dag.product_of_numbers(c, d))
}

/// `(c + d) x`, where the sum is finite.
fn collected(dag: &mut Dag, c: f64, d: f64, x: ExprId) -> Option<ExprId> {
    let sum = dag.sum_of_numbers(c, d);
    sum.is_finite().then(|| dag.multiple(sum, x))
}

/// Bit-equal: a rule holds for identical numbers only.
const fn equal(c: f64, d: f64) -> bool {
    c.to_bits() == d.to_bits()
}

fn fold_sum(dag: &mut Dag, x: ExprId, y: ExprId) -> Option<ExprId> {
    let (c, d) = (dag.as_constant(x)?, dag.as_constant(y)?);
    let value = dag.sum_of_numbers(c, d);
    finite(dag, value)
}

fn add_zero(dag: &mut Dag, x: ExprId, y: ExprId) -> Option<ExprId> {
    match (dag.is_zero(x), dag.is_zero(y)) {
        (true, _) => Some(y),
        (_, true) => Some(x),
        _ => None,
    }
}

fn collect(dag: &mut Dag, x: ExprId, y: ExprId) -> Option<ExprId> {
    let ((c, p), (d, q)) = (dag.coefficient(x), dag.coefficient(y));
    let (p, q) = (p?, q?);
    if p != q {
        return None;
    }
    collected(dag, c, d, p)
}

fn collect_nested(dag: &mut Dag, x: ExprId, y: ExprId) -> Option<ExprId> {
    collect_into(dag, x, y).or_else(|| collect_into(dag, y, x))
}

/// `sum + term` where `sum` has a term that is a multiple of `term`.
fn collect_into(dag: &mut Dag, sum: ExprId, term: ExprId) -> Option<ExprId> {
    let (outer, inner) = dag.coefficient(sum);
    let Node::Add(p, q) = dag.node(inner?) else {
        return None;
    };
    let (d, t) = dag.coefficient(term);
    for (here, other) in [(p, q), (q, p)] {
        let (c, s) = dag.coefficient(here);
        if s == t {
            let product = coefficient(dag, outer, c)?;
            let collected = if let Some(t) = t {
                collected(dag, product, d, t)?
            } else {
                let sum = dag.sum_of_numbers(product, d);
                finite(dag, sum)?
            };
            let other = dag.multiple(outer, other);
            return Some(dag.add(other, collected));
        }
    }
    None
}

fn common_coefficient(dag: &mut Dag, x: ExprId, y: ExprId) -> Option<ExprId> {
    let ((c, p), (d, q)) = (dag.coefficient(x), dag.coefficient(y));
    let (p, q) = (p?, q?);
    if !equal(c.abs(), d.abs()) || equal(c, 1.0) || equal(d, 1.0) {
        return None;
    }
    let q = if differ(c, d) { dag.neg(q) } else { q };
    let sum = dag.add(p, q);
    Some(dag.multiple(c, sum))
}

fn fold_product(dag: &mut Dag, x: ExprId, y: ExprId) -> Option<ExprId> {
    let (c, d) = (dag.as_constant(x)?, dag.as_constant(y)?);
    let value = dag.product_of_numbers(c, d);
    finite(dag, value)
}

fn mul_zero(dag: &mut Dag, x: ExprId, _: ExprId) -> Option<ExprId> {
    dag.is_zero(x).then_some(x)
}

fn mul_one(dag: &mut Dag, x: ExprId, y: ExprId) -> Option<ExprId> {
    (dag.as_constant(x) == Some(1.0)).then_some(y)
}

fn coefficients_meet(dag: &mut Dag, x: ExprId, y: ExprId) -> Option<ExprId> {
    let c = dag.as_constant(x)?;
    let Node::Mul(factor, rest) = dag.node(y) else {
        return None;
    };
    let d = dag.as_constant(factor)?;
    let product = coefficient(dag, c, d)?;
    Some(dag.multiple(product, rest))
}

fn coefficient_outside(dag: &mut Dag, x: ExprId, y: ExprId) -> Option<ExprId> {
    let ((c, p), (d, q)) = (dag.coefficient(x), dag.coefficient(y));
    let (p, q) = (p?, q?);
    if p == x && q == y {
        return None;
    }
    let coefficient = coefficient(dag, c, d)?;
    let coefficient = dag.folded(coefficient);
    let product = dag.mul(p, q);
    Some(dag.mul(coefficient, product))
}

fn cancel_quotient(dag: &mut Dag, x: ExprId, y: ExprId) -> Option<ExprId> {
    let inverse = |p, q| matches!(dag.node(p), Node::Call(Function::Recip, p) if p == q);
    (inverse(x, y) || inverse(y, x)).then(|| dag.constant(1.0))
}

fn modulus_times_sign(dag: &mut Dag, x: ExprId, y: ExprId) -> Option<ExprId> {
    match (dag.node(x), dag.node(y)) {
        (Node::Call(Function::Abs, p), Node::Call(Function::Sign, q))
        | (Node::Call(Function::Sign, p), Node::Call(Function::Abs, q))
            if p == q =>
        {
            Some(p)
        }
        _ => None,
    }
}

fn known_choice(dag: &mut Dag, condition: ExprId, x: ExprId, y: ExprId) -> Option<ExprId> {
    let condition = dag.as_constant(condition)?;
    Some(if condition > 0.0 { x } else { y })
}

fn equal_choices(_: &mut Dag, _: ExprId, x: ExprId, y: ExprId) -> Option<ExprId> {
    (x == y).then_some(x)
}

fn scaled_condition(dag: &mut Dag, condition: ExprId, x: ExprId, y: ExprId) -> Option<ExprId> {
    let (factor, rest) = dag.coefficient(condition);
    let rest = rest?;
    (factor > 0.0 && !equal(factor, 1.0)).then(|| dag.select(rest, x, y))
}

/// One factor outside, so that `min` and `max` of multiples are multiples.
fn common_factor_of_choices(
    dag: &mut Dag,
    condition: ExprId,
    x: ExprId,
    y: ExprId,
) -> Option<ExprId> {
    let ((c, p), (d, q)) = (dag.coefficient(x), dag.coefficient(y));
    let (p, q) = (p?, q?);
    if !equal(c, d) || equal(c, 1.0) {
        return None;
    }
    let choice = dag.select(condition, p, q);
    Some(dag.multiple(c, choice))
}

fn square_of_root(dag: &mut Dag, x: ExprId, y: ExprId) -> Option<ExprId> {
    match dag.node(x) {
        Node::Call(Function::Sqrt, inside) if x == y => Some(inside),
        _ => None,
    }
}

fn fold_call(dag: &mut Dag, function: Function, x: ExprId) -> Option<ExprId> {
    let value = function.apply(dag.as_constant(x)?);
    finite(dag, value)
}

fn even(dag: &mut Dag, function: Function, x: ExprId) -> Option<ExprId> {
    let (c, rest) = dag.coefficient(x);
    if !matches!(function, Function::Cos | Function::Abs) || c >= 0.0 {
        return None;
    }
    let positive = dag.multiple(-c, rest?);
    Some(dag.call(function, positive))
}

fn odd(dag: &mut Dag, function: Function, x: ExprId) -> Option<ExprId> {
    let (c, rest) = dag.coefficient(x);
    if !matches!(function, Function::Sin | Function::Tanh | Function::Sign) || c >= 0.0 {
        return None;
    }
    let positive = dag.multiple(-c, rest?);
    let value = dag.call(function, positive);
    Some(dag.neg(value))
}

fn modulus_of_multiple(dag: &mut Dag, function: Function, x: ExprId) -> Option<ExprId> {
    let (c, rest) = dag.coefficient(x);
    if function != Function::Abs || equal(c, 1.0) {
        return None;
    }
    let modulus = dag.call(function, rest?);
    Some(dag.multiple(c.abs(), modulus))
}

fn recip_of_multiple(dag: &mut Dag, function: Function, x: ExprId) -> Option<ExprId> {
    let (c, rest) = dag.coefficient(x);
    if function != Function::Recip || equal(c, 1.0) || !c.recip().is_normal() {
        return None;
    }
    let factor = dag.folded(c.recip());
    let recip = dag.call(function, rest?);
    Some(dag.mul(factor, recip))
}

fn recip_twice(dag: &mut Dag, function: Function, x: ExprId) -> Option<ExprId> {
    match dag.node(x) {
        Node::Call(Function::Recip, inside) if function == Function::Recip => Some(inside),
        _ => None,
    }
}

fn modulus_twice(dag: &mut Dag, function: Function, x: ExprId) -> Option<ExprId> {
    matches!(
        (function, dag.node(x)),
        (Function::Abs, Node::Call(Function::Abs, _))
    )
    .then_some(x)
}

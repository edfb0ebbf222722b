//! What a function costs.

use super::Optimized;
use crate::expr::{Dag, ExprId, Function, Node};

/// Operations of a function, as emitted.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Cost {
    /// Multiplications.
    pub mul: usize,
    /// Additions and subtractions.
    pub add: usize,
    /// Divisions.
    pub div: usize,
    /// Sines and cosines.
    pub trig: usize,
    /// Other function calls, and choices.
    pub call: usize,
}

impl std::fmt::Display for Cost {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{} mul, {} add, {} trig", self.mul, self.add, self.trig)?;
        for (count, name) in [(self.div, "div"), (self.call, "other")] {
            if count > 0 {
                write!(f, ", {count} {name}")?;
            }
        }
        Ok(())
    }
}

impl Optimized {
    /// Operations of all outputs together. A sign costs nothing, and a product with a reciprocal is a division.
    #[must_use]
    pub fn cost(&self) -> Cost {
        operations(&self.dag, &self.outputs)
    }
}

/// Operations of expressions as they are.
pub(crate) fn operations(dag: &Dag, outputs: &[ExprId]) -> Cost {
    let mut cost = Cost::default();
    let is_quotient = |x: ExprId| matches!(dag.node(x), Node::Call(Function::Recip, _));
    for x in dag.reachable(outputs) {
        match dag.node(x) {
            Node::Constant(_) | Node::Symbol(_) => {}
            Node::Add(..) => cost.add += 1,
            Node::Mul(..) if dag.coefficient(x).0.to_bits() == (-1.0f64).to_bits() => {}
            Node::Mul(p, q) if is_quotient(p) || is_quotient(q) => {}
            Node::Mul(..) => cost.mul += 1,
            Node::Call(Function::Sin | Function::Cos, _) => cost.trig += 1,
            Node::Call(Function::Recip, _) => cost.div += 1,
            Node::Call(..) | Node::Power(..) | Node::Select(..) => cost.call += 1,
        }
    }
    cost
}

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
    /// Operations of all outputs together. A sign costs nothing, and a product with a reciprocal that nothing else uses is a
    /// division.
    #[must_use]
    pub fn cost(&self) -> Cost {
        operations(&self.dag, &self.outputs)
    }
}

/// Operations of expressions as they are.
pub(crate) fn operations(dag: &Dag, outputs: &[ExprId]) -> Cost {
    let mut cost = Cost::default();
    let order = dag.reachable(outputs);
    let uses = dag.uses(&order, outputs);
    let divides =
        |x: ExprId| matches!(dag.node(x), Node::Call(Function::Recip, _)) && uses[x.index()] == 1;
    for x in order {
        match dag.node(x) {
            Node::Constant(_) | Node::Symbol(_) => {}
            Node::Add(..) => cost.add += 1,
            Node::Mul(..) if dag.is_negation(x) => {}
            Node::Mul(p, q) if divides(p) || divides(q) => {}
            Node::Mul(..) => cost.mul += 1,
            Node::Call(Function::Sin | Function::Cos, _) => cost.trig += 1,
            Node::Call(Function::Recip, _) => cost.div += 1,
            Node::Call(..) | Node::Power(..) | Node::Select(..) => cost.call += 1,
        }
    }
    cost
}

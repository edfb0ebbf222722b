//! How often expressions are used. A sign is no expression of its own here: who uses `-x` uses `x`.

use super::{Dag, ExprId};

impl Dag {
    /// `-x` as a sign and `x`.
    pub(crate) fn unsigned(&self, x: ExprId) -> (bool, ExprId) {
        match self.coefficient(x) {
            (c, Some(rest)) if c.to_bits() == (-1.0f64).to_bits() => (true, rest),
            _ => (false, x),
        }
    }

    /// Whether it is `-x` of an expression `x`, which costs nothing where it is added or multiplied.
    pub(crate) fn is_negation(&self, x: ExprId) -> bool {
        self.unsigned(x).0
    }

    /// Per expression how often outputs and the expressions in `order`, which are all that these are made of, use it; none for
    /// `-x`.
    pub(crate) fn uses(&self, order: &[ExprId], outputs: &[ExprId]) -> Vec<usize> {
        let mut uses = vec![0; self.len()];
        for &output in outputs {
            uses[self.unsigned(output).1.index()] += 1;
        }
        for &x in order.iter().filter(|&&x| !self.is_negation(x)) {
            for operand in self.node(x).operands() {
                uses[self.unsigned(operand).1.index()] += 1;
            }
        }
        uses
    }
}

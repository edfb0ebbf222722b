//! Expressions with some of their symbols replaced.

use super::{Dag, ExprId, Node, Symbol};

impl Dag {
    /// `roots` with every symbol for which `replacement` gives an expression replaced by it. All rules apply again, so terms
    /// that the replacement makes vanish are gone.
    pub fn substitute(
        &mut self,
        roots: &[ExprId],
        replacement: &dyn Fn(Symbol) -> Option<ExprId>,
    ) -> Vec<ExprId> {
        let mut new: Vec<Option<ExprId>> = vec![None; self.len()];
        for x in self.reachable(roots) {
            let of = |operand: ExprId| new[operand.index()].expect("operands come before users");
            let replaced = match self.node(x) {
                Node::Constant(_) => x,
                Node::Symbol(symbol) => replacement(symbol).unwrap_or(x),
                Node::Add(p, q) => self.add(of(p), of(q)),
                Node::Mul(p, q) => self.mul(of(p), of(q)),
                Node::Power(p, q) => self.power(of(p), of(q)),
                Node::Call(function, p) => self.call(function, of(p)),
                Node::Select(condition, p, q) => self.select(of(condition), of(p), of(q)),
            };
            new[x.index()] = Some(replaced);
        }
        roots
            .iter()
            .map(|root| new[root.index()].expect("roots are reachable"))
            .collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::expr::Function;

    #[test]
    fn replaced_symbols_are_gone_and_what_they_made_vanish_too() {
        let mut dag = Dag::new();
        let (x, y) = (dag.symbol(Symbol::Dq(0)), dag.symbol(Symbol::Ddq(0)));
        let sin = dag.call(Function::Sin, x);
        let product = dag.mul(sin, y);
        let sum = dag.add(product, x);
        let zero = dag.zero();
        let at_rest = |symbol| matches!(symbol, Symbol::Ddq(_)).then_some(zero);
        assert_eq!(dag.substitute(&[sum, sin], &at_rest), [x, sin]);
        let renamed = dag.substitute(&[sum], &|symbol| (symbol == Symbol::Dq(0)).then_some(y))[0];
        let value = dag.evaluate(renamed, &|symbol| {
            if symbol == Symbol::Ddq(0) {
                0.7
            } else {
                f64::NAN
            }
        });
        assert!(
            (value - (0.7_f64.sin() * 0.7 + 0.7)).abs() < 1e-15,
            "{value}"
        );
    }
}

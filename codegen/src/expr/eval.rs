//! Direct evaluation: the meaning of an expression, without schedule or registers. The interpreter is tested against it.

use super::{Dag, ExprId, Node, Symbol};

impl Dag {
    /// The value of one expression, with every symbol bound by `bind`.
    #[must_use]
    pub fn evaluate(&self, x: ExprId, bind: &dyn Fn(Symbol) -> f64) -> f64 {
        self.evaluate_all(&[x], bind)[0]
    }

    /// The values of several expressions; shared parts are evaluated once.
    #[must_use]
    pub fn evaluate_all(&self, roots: &[ExprId], bind: &dyn Fn(Symbol) -> f64) -> Vec<f64> {
        let mut value = vec![0.0; self.len()];
        for x in self.reachable(roots) {
            value[x.index()] = match self.node(x) {
                Node::Constant(c) => c.get(),
                Node::Symbol(symbol) => bind(symbol),
                Node::Add(p, q) => value[p.index()] + value[q.index()],
                Node::Mul(p, q) => value[p.index()] * value[q.index()],
                Node::Power(p, q) => f64::powf(value[p.index()], value[q.index()]),
                Node::Call(function, p) => function.apply(value[p.index()]),
                Node::Select(condition, p, _) if value[condition.index()] > 0.0 => value[p.index()],
                Node::Select(_, _, q) => value[q.index()],
            };
        }
        roots.iter().map(|root| value[root.index()]).collect()
    }
}

//! Dry friction that turns round within a small velocity, for a search that follows slopes.

use std::collections::HashMap;

use crate::expr::{Dag, ExprId, Function, Node, Symbol};

/// `tanh(g / turn)` for each `sign(g)` of a velocity.
pub(super) fn smoothed(dag: &mut Dag, expressions: &[ExprId], turn: &[f64]) -> Vec<ExprId> {
    let mut known: HashMap<ExprId, ExprId> = HashMap::new();
    for x in dag.reachable(expressions) {
        let of = |operand: ExprId| known[&operand];
        let new = match dag.node(x) {
            Node::Constant(_) | Node::Symbol(_) => x,
            Node::Add(p, q) => dag.add(of(p), of(q)),
            Node::Mul(p, q) => dag.mul(of(p), of(q)),
            Node::Power(p, q) => dag.power(of(p), of(q)),
            Node::Select(condition, p, q) => dag.select(of(condition), of(p), of(q)),
            Node::Call(Function::Sign, p) => {
                let inside = of(p);
                let symbols = dag.symbols(&[inside]);
                let turns = symbols.iter().filter_map(|symbol| match symbol {
                    Symbol::Dq(joint) => turn.get(*joint).copied(),
                    _ => None,
                });
                match turns.reduce(f64::min) {
                    Some(turn) => {
                        let scaled = dag.scale(1.0 / turn, inside);
                        dag.call(Function::Tanh, scaled)
                    }
                    None => dag.call(Function::Sign, inside),
                }
            }
            Node::Call(function, p) => dag.call(function, of(p)),
        };
        known.insert(x, new);
    }
    expressions.iter().map(|x| known[x]).collect()
}

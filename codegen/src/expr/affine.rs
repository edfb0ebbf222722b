//! Whether expressions are affine in symbols, and whether they jump: by structure, since a jump has no derivative to tell of it.

use super::{Dag, ExprId, Function, Node, Symbol};

/// How a part of an expression depends on the symbols in question.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Degree {
    Free,
    Affine,
    Other,
}

impl Dag {
    /// Whether every root is a sum of the symbols that `wanted` picks, each with a factor that is free of them, and of a rest
    /// that is, too. What is so only after canceling counts as not so.
    #[must_use]
    pub fn is_affine(&self, roots: &[ExprId], wanted: &dyn Fn(Symbol) -> bool) -> bool {
        let degrees = self.degrees(roots, wanted);
        roots
            .iter()
            .all(|root| degrees[root.index()] != Degree::Other)
    }

    fn degrees(&self, roots: &[ExprId], wanted: &dyn Fn(Symbol) -> bool) -> Vec<Degree> {
        let mut degrees = vec![Degree::Free; self.len()];
        for x in self.reachable(roots) {
            let of = |operand: ExprId| degrees[operand.index()];
            degrees[x.index()] = match self.node(x) {
                Node::Symbol(symbol) if wanted(symbol) => Degree::Affine,
                Node::Constant(_) | Node::Symbol(_) => Degree::Free,
                Node::Add(p, q) => of(p).max(of(q)),
                Node::Mul(p, q) => match (of(p), of(q)) {
                    (Degree::Free, other) | (other, Degree::Free) => other,
                    _ => Degree::Other,
                },
                Node::Select(condition, p, q) if of(condition) == Degree::Free => of(p).max(of(q)),
                node if node.operands().all(|operand| of(operand) == Degree::Free) => Degree::Free,
                Node::Power(..) | Node::Call(..) | Node::Select(..) => Degree::Other,
            };
        }
        degrees
    }

    /// Whether an expression may jump where symbols that `wanted` picks change: it has a `sign` of them, or a choice by them whose
    /// values do not meet where the choice changes, as those of `min` and `max` do.
    #[must_use]
    pub fn may_jump(&mut self, x: ExprId, wanted: &dyn Fn(Symbol) -> bool) -> bool {
        let degrees = self.degrees(&[x], wanted);
        let changes = |operand: ExprId| degrees[operand.index()] != Degree::Free;
        self.reachable(&[x])
            .into_iter()
            .any(|x| match self.node(x) {
                Node::Call(Function::Sign, inside) => changes(inside),
                Node::Select(condition, p, q) if changes(condition) => {
                    self.sub(p, q) != condition && self.sub(q, p) != condition
                }
                _ => false,
            })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_jump_is_not_affine_though_its_derivative_is_free() {
        let mut dag = Dag::new();
        let (x, y) = (dag.symbol(Symbol::Ddq(0)), dag.symbol(Symbol::Q(0)));
        let of_x = |symbol| symbol == Symbol::Ddq(0);
        let (sign, one) = (dag.call(Function::Sign, x), dag.constant(1.0));
        let sine = dag.call(Function::Sin, y);
        let product = dag.mul(sine, x);
        let affine = dag.add(product, y);
        let by_x = dag.select(x, one, y);
        let by_y = dag.select(y, x, affine);
        let square = dag.mul(product, x);
        assert!(dag.is_affine(&[x, y, affine, by_y, sine], &of_x));
        for other in [sign, by_x, square] {
            assert!(!dag.is_affine(&[affine, other], &of_x), "{other:?}");
        }
    }

    #[test]
    fn values_that_meet_do_not_jump() {
        let mut dag = Dag::new();
        let (x, y) = (dag.symbol(Symbol::Q(0)), dag.symbol(Symbol::Q(1)));
        let of_x = |symbol| symbol == Symbol::Q(0);
        let (least, most) = (dag.min(x, y), dag.max(x, y));
        let size = dag.call(Function::Abs, x);
        for continuous in [least, most, size, y] {
            assert!(!dag.may_jump(continuous, &of_x), "{continuous:?}");
        }
        let (zero, one) = (dag.zero(), dag.constant(1.0));
        let step = dag.select(x, one, zero);
        let sign = dag.call(Function::Sign, x);
        let of_y = dag.call(Function::Sign, y);
        assert!(dag.may_jump(step, &of_x) && dag.may_jump(sign, &of_x));
        assert!(!dag.may_jump(of_y, &of_x));
    }
}

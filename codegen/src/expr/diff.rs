//! Derivatives with respect to a symbol.

use super::{Dag, ExprId, Function, Node, Symbol};

impl Dag {
    /// `d roots / d symbol`, one a root. Shared parts are differentiated once.
    ///
    /// `abs` has the derivative `sign`, `sign` has the derivative 0, a choice that of what is chosen: right everywhere but at
    /// the kink.
    pub fn derivatives(&mut self, roots: &[ExprId], symbol: Symbol) -> Vec<ExprId> {
        let reachable = self.reachable(roots);
        let mut derivative = vec![self.zero(); self.nodes.len()];
        for x in reachable {
            derivative[x.index()] = self.derivative_of_node(x, symbol, &derivative);
        }
        roots.iter().map(|root| derivative[root.index()]).collect()
    }

    /// `d x / d symbol`
    pub fn derivative(&mut self, x: ExprId, symbol: Symbol) -> ExprId {
        self.derivatives(&[x], symbol)[0]
    }

    /// The chain rule for one node, given its operands' derivatives.
    fn derivative_of_node(&mut self, x: ExprId, symbol: Symbol, of: &[ExprId]) -> ExprId {
        match self.node(x) {
            Node::Constant(_) => self.zero(),
            Node::Symbol(other) => self.constant(if other == symbol { 1.0 } else { 0.0 }),
            Node::Add(p, q) => self.add(of[p.index()], of[q.index()]),
            Node::Mul(p, q) => {
                let left = self.mul(of[p.index()], q);
                let right = self.mul(p, of[q.index()]);
                self.add(left, right)
            }
            Node::Power(base, exponent) => {
                let slope = self.power_by_base(base, exponent);
                let from_base = self.mul(slope, of[base.index()]);
                if self.is_zero(of[exponent.index()]) {
                    return from_base;
                }
                let growth = self.power_by_exponent(x, base);
                let from_exponent = self.mul(growth, of[exponent.index()]);
                self.add(from_base, from_exponent)
            }
            Node::Select(condition, p, q) => self.select(condition, of[p.index()], of[q.index()]),
            Node::Call(_, inside) if self.is_zero(of[inside.index()]) => self.zero(),
            Node::Call(function, inside) => {
                let outer = self.derivative_of_call(function, inside, x);
                self.mul(outer, of[inside.index()])
            }
        }
    }

    /// `d (b^e) / db = e b^(e-1)`. Not `b^e e / b`, which is no number at `b = 0`.
    pub(super) fn power_by_base(&mut self, base: ExprId, exponent: ExprId) -> ExprId {
        let one = self.constant(1.0);
        let lower = self.sub(exponent, one);
        let lower = self.power(base, lower);
        self.mul(exponent, lower)
    }

    /// `d (b^e) / de = b^e ln(b)`, where `power` is `b^e`.
    pub(super) fn power_by_exponent(&mut self, power: ExprId, base: ExprId) -> ExprId {
        let ln = self.call(Function::Ln, base);
        self.mul(power, ln)
    }

    /// `f'(inside)`, where `value` is `f(inside)`.
    pub(super) fn derivative_of_call(
        &mut self,
        function: Function,
        inside: ExprId,
        value: ExprId,
    ) -> ExprId {
        match function {
            Function::Sin => self.call(Function::Cos, inside),
            Function::Cos => {
                let sin = self.call(Function::Sin, inside);
                self.neg(sin)
            }
            Function::Exp => value,
            Function::Ln => self.call(Function::Recip, inside),
            Function::Sqrt => {
                let recip = self.call(Function::Recip, value);
                self.scale(0.5, recip)
            }
            Function::Abs => self.call(Function::Sign, inside),
            Function::Sign => self.zero(),
            Function::Tanh => {
                let one = self.constant(1.0);
                let square = self.mul(value, value);
                self.sub(one, square)
            }
            Function::Recip => {
                let square = self.mul(value, value);
                self.neg(square)
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// `abs(x)^1.5 sign(x)`, a friction law, is level at rest.
    #[test]
    fn powers_above_one_are_level_where_their_base_is_zero() {
        let mut dag = Dag::new();
        let x = dag.symbol(Symbol::Q(0));
        let (size, sign) = (dag.call(Function::Abs, x), dag.call(Function::Sign, x));
        for exponent in [1.5, 2.0, 3.0, 2.5] {
            let exponent = dag.constant(exponent);
            let power = dag.power(size, exponent);
            let law = dag.mul(power, sign);
            let slope = dag.derivative(law, Symbol::Q(0));
            let at_rest = dag.evaluate(slope, &|_| 0.0);
            assert!(at_rest == 0.0, "{exponent:?}: {at_rest}");
        }
        // An exponent that is a parameter.
        let symbolic = dag.symbol(Symbol::Q(1));
        let power = dag.power(size, symbolic);
        let slope = dag.derivative(power, Symbol::Q(0));
        let at_rest = dag.evaluate(slope, &|s| if s == Symbol::Q(1) { 1.5 } else { 0.0 });
        assert!(at_rest == 0.0, "{at_rest}");
    }

    #[test]
    fn derivatives_agree_with_finite_differences() {
        let mut dag = Dag::new();
        let (x, y) = (dag.symbol(Symbol::Q(0)), dag.symbol(Symbol::Q(1)));
        let sum = dag.add(x, y);
        let product = dag.mul(x, sum);
        let functions = [
            Function::Sin,
            Function::Cos,
            Function::Exp,
            Function::Ln,
            Function::Sqrt,
            Function::Abs,
            Function::Sign,
            Function::Tanh,
            Function::Recip,
        ];
        let mut cases: Vec<ExprId> = functions.iter().map(|&f| dag.call(f, product)).collect();
        cases.push(dag.power(sum, y));
        cases.push(dag.power(product, x));
        cases.push(dag.min(product, sum));
        cases.push(dag.max(product, sum));
        for case in cases {
            let derivative = dag.derivative(case, Symbol::Q(0));
            let at = |dag: &Dag, expr, x| {
                dag.evaluate(expr, &|s| if s == Symbol::Q(0) { x } else { 0.7 })
            };
            let h = 1e-5;
            let numeric = (at(&dag, case, 0.4 + h) - at(&dag, case, 0.4 - h)) / (2.0 * h);
            let exact = at(&dag, derivative, 0.4);
            assert!(
                (numeric - exact).abs() < 1e-8 * (1.0 + exact.abs()),
                "{case:?}: {numeric} {exact}"
            );
        }
    }
}

//! Slopes of a weighted sum of many expressions by many symbols, in one backward sweep.

use super::{Dag, ExprId, Function, Node, Symbol};

impl Dag {
    /// `sum_k weights[k] * d roots[k] / d symbol`, one a symbol. It takes a few times the operations of `roots`, however many
    /// symbols there are.
    ///
    /// Slopes of what jumps or has a kink are those beside it, as in [`Self::derivatives`].
    pub fn pullback(
        &mut self,
        roots: &[ExprId],
        weights: &[ExprId],
        symbols: &[Symbol],
    ) -> Vec<ExprId> {
        let reachable = self.reachable(roots);
        // What the sum changes by with each expression. Users come behind their operands, so a backward sweep meets an
        // expression when all of its users have had their say.
        let mut terms: Vec<Vec<ExprId>> = vec![Vec::new(); self.len()];
        for (root, &weight) in roots.iter().zip(weights) {
            terms[root.index()].push(weight);
        }
        let mut slopes = vec![self.zero(); symbols.len()];
        for x in reachable.into_iter().rev() {
            let change = self.sum(std::mem::take(&mut terms[x.index()]));
            if self.is_zero(change) {
                continue;
            }
            let mut hand_on = |operand: ExprId, share: ExprId| terms[operand.index()].push(share);
            match self.node(x) {
                Node::Constant(_) | Node::Call(Function::Sign, _) => {}
                Node::Symbol(symbol) => {
                    if let Some(place) = symbols.iter().position(|&wanted| wanted == symbol) {
                        slopes[place] = change;
                    }
                }
                Node::Add(p, q) => {
                    hand_on(p, change);
                    hand_on(q, change);
                }
                Node::Mul(p, q) => {
                    hand_on(p, self.mul(change, q));
                    hand_on(q, self.mul(change, p));
                }
                Node::Power(base, exponent) => {
                    let by_base = self.power_by_base(base, exponent);
                    hand_on(base, self.mul(change, by_base));
                    if self.as_constant(exponent).is_none() {
                        let by_exponent = self.power_by_exponent(x, base);
                        hand_on(exponent, self.mul(change, by_exponent));
                    }
                }
                Node::Select(condition, p, q) => {
                    let zero = self.zero();
                    hand_on(p, self.select(condition, change, zero));
                    hand_on(q, self.select(condition, zero, change));
                }
                Node::Call(function, inside) => {
                    let slope = self.derivative_of_call(function, inside, x);
                    hand_on(inside, self.mul(change, slope));
                }
            }
        }
        slopes
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The forward derivatives are the law.
    #[test]
    fn a_backward_sweep_gives_what_forward_ones_give() {
        let mut dag = Dag::new();
        let symbols = [Symbol::Q(0), Symbol::Q(1), Symbol::Dq(0)];
        let [x, y, v] = symbols.map(|symbol| dag.symbol(symbol));
        let product = dag.mul(x, y);
        let sum = dag.add(product, v);
        let sin = dag.call(Function::Sin, sum);
        let wave = dag.mul(sin, sum);
        let half = dag.constant(1.5);
        let fraction = dag.power(sum, half);
        let tower = dag.power(sum, y);
        let size = dag.call(Function::Abs, v);
        let sign = dag.call(Function::Sign, v);
        let choice = dag.select(v, wave, tower);
        let recip = dag.call(Function::Recip, sum);
        let root = dag.call(Function::Sqrt, wave);
        let roots = [wave, fraction, tower, size, sign, choice, recip, root, x];
        let weights: Vec<ExprId> = (0..roots.len())
            .map(|k| dag.symbol(Symbol::Weight(k)))
            .collect();
        let slopes = dag.pullback(&roots, &weights, &symbols);
        let weight = |k: usize| 1.0 + 0.3 * k as f64;
        for v in [0.6, -0.2] {
            let at = |symbol| match symbol {
                Symbol::Q(0) => 0.7,
                Symbol::Q(_) => 1.3,
                Symbol::Weight(k) => weight(k),
                _ => v,
            };
            for (&symbol, &slope) in symbols.iter().zip(&slopes) {
                let forward = dag.derivatives(&roots, symbol);
                let values = dag.evaluate_all(&forward, &at);
                let law: f64 = values.iter().enumerate().map(|(k, d)| weight(k) * d).sum();
                let swept = dag.evaluate(slope, &at);
                assert!(
                    (swept - law).abs() < 1e-12 * law.abs().max(1.0),
                    "{symbol:?}: {swept} {law}"
                );
            }
        }
    }

    #[test]
    fn what_does_not_depend_on_a_symbol_has_no_slope() {
        let mut dag = Dag::new();
        let (x, weight) = (dag.symbol(Symbol::Q(0)), dag.symbol(Symbol::Weight(0)));
        let slopes = dag.pullback(&[x], &[weight], &[Symbol::Q(0), Symbol::Q(1)]);
        assert_eq!(slopes, [weight, dag.zero()]);
    }
}

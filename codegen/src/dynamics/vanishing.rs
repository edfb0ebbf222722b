//! Outputs that are zero whatever the state, which a derivation by recursion does not see: gravity about a vertical axis is a sum
//! of turned forces that cancel.

use std::collections::HashMap;

use crate::expr::{Dag, ExprId, Symbol};
use crate::random::Generator;
use crate::rounded::Rounded;

/// The outputs, with the number zero for each that is nothing but rounding at every state that is tried.
///
/// The outputs are analytic, so one that is not zero everywhere is zero almost nowhere, and no drawn state finds it there.
pub fn without_vanishing(dag: &mut Dag, mut outputs: Vec<ExprId>) -> Vec<ExprId> {
    /// One would do, were states drawn without rounding.
    const STATES: usize = 4;
    /// Any fixed number: same spec, same states.
    const SEED: u64 = 0x7a65_726f;
    let order = dag.reachable(&outputs);
    let mut generator = Generator::new(SEED);
    let mut values = vec![Rounded::ZERO; dag.len()];
    let mut vanish = vec![true; outputs.len()];
    for _ in 0..STATES {
        let mut state: HashMap<Symbol, f64> = HashMap::new();
        for symbol in dag.symbols(&outputs) {
            state.insert(symbol, 2.0 * generator.symmetric());
        }
        dag.evaluate_rounded(&order, &|symbol| state[&symbol], &mut values);
        for (vanishes, x) in vanish.iter_mut().zip(&outputs) {
            *vanishes &= values[x.index()].is_noise();
        }
    }
    let zero = dag.zero();
    for (x, vanishes) in outputs.iter_mut().zip(vanish) {
        if vanishes {
            *x = zero;
        }
    }
    outputs
}

#[cfg(test)]
mod tests {
    use super::without_vanishing;
    use crate::expr::{Dag, Function, Symbol};

    #[test]
    fn what_cancels_is_zero_and_what_is_small_is_not() {
        let mut dag = Dag::new();
        let [a, b] = [0, 1].map(|joint| {
            let q = dag.symbol(Symbol::Q(joint));
            dag.call(Function::Sin, q)
        });
        // (a + b) (a - b) - (a^2 - b^2), which no rule of the dag knows.
        let (sum, difference) = (dag.add(a, b), dag.sub(a, b));
        let whole = dag.mul(sum, difference);
        let squares = [a, b].map(|x| dag.mul(x, x));
        let parts = dag.sub(squares[0], squares[1]);
        let nothing = dag.sub(whole, parts);
        assert!(dag.as_constant(nothing).is_none());
        let small = dag.scale(1e-30, a);
        let outputs = without_vanishing(&mut dag, vec![nothing, small, whole]);
        assert!(dag.is_zero(outputs[0]));
        assert_eq!(outputs[1..], [small, whole]);
    }
}

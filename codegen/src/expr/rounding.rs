//! Values with bounds of their rounding errors, and numbers that are nothing but rounding.

use super::{Dag, ExprId, Function, Node, Symbol};
use crate::rounded::{Rounded, UNIT};

impl Dag {
    /// A number of this dag with its error: that of a number that was given, or what the sums that made it have lost.
    pub(super) fn rounded(&self, value: f64) -> Rounded {
        let magnitude = value.abs().to_bits();
        match self.lost.get(&magnitude) {
            Some(&error) if !self.given.contains(&magnitude) => Rounded { value, error },
            _ => Rounded::constant(value),
        }
    }

    /// A named rounding step: the sum of two numbers, 0 where nothing but rounding is left of them.
    pub(super) fn sum_of_numbers(&mut self, c: f64, d: f64) -> f64 {
        let sum = (self.rounded(c) + self.rounded(d)).cleaned();
        self.remember(sum)
    }

    /// The product of two numbers.
    pub(super) fn product_of_numbers(&mut self, c: f64, d: f64) -> f64 {
        if self.lost.is_empty() {
            return c * d;
        }
        let product = self.rounded(c) * self.rounded(d);
        self.remember(product)
    }

    /// Sums that canceled have lost more digits than other numbers have.
    fn remember(&mut self, number: Rounded) -> f64 {
        /// Products and sums of numbers of one sign stay below.
        const MUCH: f64 = 64.0 * UNIT;
        if number.error > MUCH * number.value.abs() && number.value.is_finite() {
            // The smallest bound of those that are known: each way back to a number, such as `2 x - x`, has a larger one.
            let error = self.lost.entry(number.value.abs().to_bits());
            let error = error.or_insert(number.error);
            *error = error.min(number.error);
        }
        number.value
    }

    /// The values of the expressions in `order`, which are all that some roots are made of, at their places in `values`.
    /// Symbols are exact. Where rounding decides a choice, the error is the difference of both.
    pub(crate) fn evaluate_rounded(
        &self,
        order: &[ExprId],
        bind: &dyn Fn(Symbol) -> f64,
        values: &mut [Rounded],
    ) {
        for &x in order {
            let of = |x: ExprId| values[x.index()];
            let value = match self.node(x) {
                Node::Constant(c) => self.rounded(c.get()),
                Node::Symbol(symbol) => Rounded::relative(bind(symbol), 0.0),
                Node::Add(p, q) => of(p) + of(q),
                Node::Mul(p, q) => of(p) * of(q),
                Node::Power(p, q) => power(of(p), of(q)),
                Node::Call(function, p) => call(function, of(p)),
                Node::Select(condition, p, q) => {
                    let (condition, p, q) = (of(condition), of(p), of(q));
                    let chosen = if condition.value > 0.0 { p } else { q };
                    // An exact zero is on its side; the difference to a value that is no number says nothing.
                    let gap = (p.value - q.value).abs();
                    if condition.value.abs() < condition.error && gap.is_finite() {
                        Rounded::after(chosen.value, chosen.error + gap)
                    } else {
                        chosen
                    }
                }
            };
            values[x.index()] = value;
        }
    }
}

fn power(x: Rounded, y: Rounded) -> Rounded {
    let power = x.power(y.value);
    let of_exponent = power.value.abs() * x.value.abs().ln().abs() * y.error;
    if power.value == 0.0 {
        return power;
    }
    Rounded::after(power.value, power.error + of_exponent)
}

fn call(function: Function, x: Rounded) -> Rounded {
    let value = function.apply(x.value);
    let slope = match function {
        Function::Sin => x.value.cos().abs(),
        Function::Cos => x.value.sin().abs(),
        Function::Exp => value.abs(),
        Function::Ln => x.value.recip().abs(),
        Function::Sqrt if value > 0.0 => 0.5 / value,
        // The root of nothing but rounding.
        Function::Sqrt => return Rounded::after(value, x.error.sqrt()),
        Function::Abs => 1.0,
        Function::Sign if x.value.abs() < x.error => return Rounded { value, error: 2.0 },
        Function::Sign => return Rounded { value, error: 0.0 },
        Function::Tanh => 1.0 - value * value,
        Function::Recip => value * value,
    };
    Rounded::after(value, slope * x.error + UNIT * value.abs())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_that_cancel_are_zero_whatever_their_unit() {
        for unit in [1.0, 1e-30, 1e30] {
            let mut dag = Dag::new();
            let numbers = [0.1, 0.2, -0.3, 7e3, -7e3].map(|x| dag.constant(x * unit));
            let sum = dag.sum(numbers);
            assert!(dag.is_zero(sum), "{:?}", dag.as_constant(sum));
            // What is left over of large numbers is known to few digits.
            let numbers = [1e9, -1e9 + 0.01, -0.01].map(|x| dag.constant(x * unit));
            let sum = dag.sum(numbers);
            assert!(dag.is_zero(sum), "{:?}", dag.as_constant(sum));
            let numbers = [1.0, 1e-12, -1.0].map(|x| dag.constant(x * unit));
            let sum = dag.sum(numbers);
            assert!(!dag.is_zero(sum));
        }
    }

    /// A bound that grew with every way back to a number would make it nothing in the end.
    #[test]
    fn a_number_that_comes_back_has_no_larger_error() {
        let mut dag = Dag::new();
        let x = dag.sum_of_numbers(100.0175, -100.0);
        let error = dag.rounded(x).error;
        assert!(error > 0.0 && error < 1e-12);
        for _ in 0..100 {
            let twice = dag.sum_of_numbers(x, x);
            let back = dag.sum_of_numbers(twice, -x);
            assert!((back - x).abs() < f64::EPSILON, "{back}");
        }
        assert!(dag.rounded(x).error <= error);
    }

    /// The rounding of one number is not that of another which happens to be equal.
    #[test]
    fn a_given_number_keeps_its_digits_whatever_sum_comes_out_as_it() {
        let mut dag = Dag::new();
        let large = [1e13 + 1.0, -1e13].map(|x| dag.constant(x));
        let one = dag.sum(large);
        assert_eq!(dag.as_constant(one), Some(1.0));
        assert!(dag.rounded(1.0).error > 1e-4);
        let given = [1.0, 1e-6 - 1.0].map(|x| dag.constant(x));
        let small = dag.sum(given);
        assert!(!dag.is_zero(small));
    }

    #[test]
    fn errors_of_a_sum_are_those_of_its_largest_term() {
        let mut dag = Dag::new();
        let q = dag.symbol(Symbol::Q(0));
        let (sin, cos) = (dag.call(Function::Sin, q), dag.call(Function::Cos, q));
        let (sin, cos) = (dag.mul(sin, sin), dag.mul(cos, cos));
        let third = dag.constant(1.0 / 3.0);
        let shifted = dag.add(sin, third);
        let back = dag.add(shifted, cos);
        let nothing = dag.constant(-4.0 / 3.0);
        let nothing = dag.add(back, nothing);
        let order = dag.reachable(&[nothing, sin]);
        let mut values = vec![Rounded::ZERO; dag.len()];
        for q in [1e-3, 0.3, 2.0, 50.0] {
            dag.evaluate_rounded(&order, &|_| q, &mut values);
            assert!(values[nothing.index()].is_noise(), "{q}");
            assert!(!values[sin.index()].is_noise(), "{q}");
        }
    }
}

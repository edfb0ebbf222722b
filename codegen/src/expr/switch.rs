//! Jumps as unknowns: what `sign` and choices jump by gets a symbol of its own, so that a simulation decides where it stands.
//!
//! In: expressions that jump where a position, a velocity or time passes a mark. Out: the same expressions with
//! [`Symbol::Switch`] in place of each such sign, and what each is the sign of. Invariants gained: no jump by positions, velocities
//! and time is left, and every expression is affine in each switch between -1 and 1, with its own values at both ends.

use super::{Dag, ExprId, Function, Node, Symbol};

/// Expressions without jumps by the motion.
#[derive(Debug, Clone)]
pub struct Switched {
    /// The expressions.
    pub roots: Vec<ExprId>,
    /// Half of what each jumps by, `[root][switch]`.
    pub halves: Vec<Vec<ExprId>>,
    /// What each switch is the sign of: continuous in positions, velocities and time, and free of all other signals.
    pub arguments: Vec<ExprId>,
}

impl Switched {
    /// With the symbols of the switches from `first` on in place of those from 0.
    #[must_use]
    pub fn behind(self, dag: &mut Dag, first: usize) -> Self {
        let count = self.arguments.len();
        let later = (first..first + count).map(|k| dag.symbol(Symbol::Switch(k)));
        let later: Vec<ExprId> = later.collect();
        let mut moved = |roots: &[ExprId]| {
            dag.substitute(roots, &|symbol| match symbol {
                Symbol::Switch(k) => Some(later[k]),
                _ => None,
            })
        };
        Self {
            roots: moved(&self.roots),
            halves: self.halves.iter().map(|row| moved(row)).collect(),
            arguments: self.arguments,
        }
    }
}

impl Dag {
    /// Finds the jumps by positions, velocities and time. `sign(x y)` is `sign(x) sign(y)`, so that a jump by a velocity is found
    /// beside factors of any kind.
    pub fn switched(&mut self, roots: &[ExprId]) -> Switched {
        let mut arguments = Vec::new();
        let mut new: Vec<Option<ExprId>> = vec![None; self.len()];
        for x in self.reachable(roots) {
            let of = |operand: ExprId| new[operand.index()].expect("operands come before users");
            let replaced = match self.node(x) {
                Node::Constant(_) | Node::Symbol(_) => x,
                Node::Add(p, q) => self.add(of(p), of(q)),
                Node::Mul(p, q) => self.mul(of(p), of(q)),
                Node::Power(p, q) => self.power(of(p), of(q)),
                Node::Call(Function::Sign, p) => match self.split(p, &mut arguments) {
                    Some((rest, switches)) => rest.into_iter().fold(switches, |product, factor| {
                        let sign = match self.as_constant(factor) {
                            Some(value) => self.constant(Function::Sign.apply(value)),
                            None => self.call(Function::Sign, of(factor)),
                        };
                        self.mul(product, sign)
                    }),
                    None => self.call(Function::Sign, of(p)),
                },
                Node::Call(function, p) => self.call(function, of(p)),
                Node::Select(condition, p, q) => {
                    let meets = self.sub(p, q) == condition || self.sub(q, p) == condition;
                    let split = if meets {
                        None
                    } else {
                        self.split(condition, &mut arguments)
                    };
                    let condition = match split {
                        Some((rest, switches)) => rest
                            .into_iter()
                            .fold(switches, |product, factor| self.mul(product, of(factor))),
                        None => of(condition),
                    };
                    self.select(condition, of(p), of(q))
                }
            };
            new[x.index()] = Some(replaced);
        }
        let mut roots: Vec<ExprId> = roots
            .iter()
            .map(|root| new[root.index()].expect("roots are reachable"))
            .collect();
        let mut halves = vec![Vec::new(); roots.len()];
        for k in 0..arguments.len() {
            for (root, halves) in roots.iter_mut().zip(&mut halves) {
                halves.push(self.straighten(root, Symbol::Switch(k)));
            }
        }
        // Later switches have changed nothing but their own ends.
        Switched {
            roots,
            halves,
            arguments,
        }
    }

    /// Makes an expression affine in a switch between its ends; half of its way from one end to the other.
    fn straighten(&mut self, root: &mut ExprId, switch: Symbol) -> ExprId {
        let (one, less) = (self.constant(1.0), self.constant(-1.0));
        let at = |dag: &mut Self, end: ExprId| {
            dag.substitute(&[*root], &|symbol| (symbol == switch).then_some(end))[0]
        };
        let (plus, minus) = (at(self, one), at(self, less));
        let difference = self.sub(plus, minus);
        let half = self.scale(0.5, difference);
        if !self.is_affine(&[*root], &|symbol| symbol == switch) {
            let sum = self.add(plus, minus);
            let mean = self.scale(0.5, sum);
            let switch = self.symbol(switch);
            let way = self.mul(switch, half);
            let between = self.add(mean, way);
            // At an end only the value of that end counts: the other may be no number.
            let (to_plus, to_minus) = (self.sub(one, switch), self.add(one, switch));
            let lower = self.select(to_minus, between, minus);
            *root = self.select(to_plus, lower, plus);
        }
        half
    }

    /// The factors of a product without those that are switches, and the product of these; `None` where there are none.
    fn split(&mut self, x: ExprId, arguments: &mut Vec<ExprId>) -> Option<(Vec<ExprId>, ExprId)> {
        let (mut rest, mut switches) = (Vec::new(), None);
        let mut stack = vec![x];
        while let Some(factor) = stack.pop() {
            match self.node(factor) {
                Node::Mul(p, q) => stack.extend([q, p]),
                Node::Call(Function::Recip, p) if self.is_switch(p) => stack.push(p),
                _ if self.is_switch(factor) => {
                    let known = arguments.iter().position(|&other| other == factor);
                    let k = known.unwrap_or_else(|| {
                        arguments.push(factor);
                        arguments.len() - 1
                    });
                    let symbol = self.symbol(Symbol::Switch(k));
                    let before = switches.unwrap_or_else(|| self.constant(1.0));
                    switches = Some(self.mul(before, symbol));
                }
                _ => rest.push(factor),
            }
        }
        Some((rest, switches?))
    }

    /// Whether an expression changes with the motion alone, and without jumps.
    fn is_switch(&mut self, x: ExprId) -> bool {
        let symbols = self.symbols(&[x]);
        let moves = |symbol: &Symbol| matches!(symbol, Symbol::Q(_) | Symbol::Dq(_) | Symbol::Time);
        let stays = |symbol: &Symbol| matches!(symbol, Symbol::Parameter(_) | Symbol::Shape(_));
        symbols.iter().any(moves)
            && symbols.iter().all(|symbol| moves(symbol) || stays(symbol))
            && !self.may_jump(x, &|_| true)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn value(dag: &Dag, x: ExprId, velocity: f64, load: f64, switch: f64) -> f64 {
        dag.evaluate(x, &|symbol| match symbol {
            Symbol::Dq(_) => velocity,
            Symbol::Switch(_) => switch,
            _ => load,
        })
    }

    #[test]
    fn friction_is_affine_in_where_its_sign_stands() {
        let mut dag = Dag::new();
        let v = dag.symbol(Symbol::Dq(0));
        let load = dag.symbol(Symbol::RigidTorque(0));
        let product = dag.mul(load, v);
        let (gain, loss) = (dag.scale(0.3, load), dag.scale(-0.2, load));
        // Of a gear: more where it drives than where it is driven.
        let gear = dag.select(product, gain, loss);
        let sign = dag.call(Function::Sign, v);
        let size = dag.call(Function::Abs, sign);
        let switched = dag.switched(&[gear, sign, size]);
        assert_eq!(switched.arguments, [v]);
        for load in [2.0, -2.0] {
            for side in [1.0, -1.0] {
                let plain = value(&dag, gear, side, load, f64::NAN);
                let found = value(&dag, switched.roots[0], f64::NAN, load, side);
                assert!((plain - found).abs() < 1e-15, "{plain} {found}");
            }
            let half = value(&dag, switched.halves[0][0], f64::NAN, load, f64::NAN);
            let middle = value(&dag, switched.roots[0], f64::NAN, load, 0.0);
            let quarter = value(&dag, switched.roots[0], f64::NAN, load, 0.5);
            assert!((quarter - middle - 0.5 * half).abs() < 1e-15);
            assert!((half - 0.25 * load.abs()).abs() < 1e-15, "{half}");
        }
        assert_eq!(dag.as_constant(switched.halves[1][0]), Some(1.0));
        // What has one value on both sides does not jump.
        assert_eq!(dag.as_constant(switched.halves[2][0]), Some(0.0));
        assert_eq!(
            value(&dag, switched.roots[2], 0.0, 0.0, 0.0).to_bits(),
            1.0_f64.to_bits()
        );
    }

    #[test]
    fn values_that_meet_and_signs_of_other_signals_stay() {
        let mut dag = Dag::new();
        let v = dag.symbol(Symbol::Dq(0));
        let state = dag.symbol(Symbol::State(0));
        let one = dag.constant(1.0);
        let bounded = dag.min(v, one);
        let of_state = dag.call(Function::Sign, state);
        let switched = dag.switched(&[bounded, of_state]);
        assert_eq!(switched.roots, [bounded, of_state]);
        assert!(switched.arguments.is_empty());
    }
}

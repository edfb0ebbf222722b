//! From a network back to expressions of two operands.

use super::Optimized;
use super::network::{Cell, Id, Network, Term};
use crate::expr::{Dag, ExprId, Function, Node};

/// The network as a dag of its own; meanings go with what they were said of.
pub fn rebuild(source: &Dag, network: &Network) -> Optimized {
    let mut rebuilder = Rebuilder {
        network,
        dag: Dag::new(),
        made: vec![None; network.cells.len()],
    };
    for id in rebuilder.order() {
        let (negative, x) = rebuilder.make(id);
        rebuilder.made[id] = Some((negative, x));
        match network.origins[id].and_then(|origin| source.label(origin)) {
            Some(label) if !negative => rebuilder.dag.set_label(x, label),
            _ => {}
        }
    }
    let outputs = network.outputs.iter();
    let outputs = outputs
        .map(|&(negative, id)| {
            let (sign, x) = rebuilder.of(id);
            rebuilder.signed(negative != sign, x)
        })
        .collect();
    Optimized {
        dag: rebuilder.dag,
        outputs,
    }
}

struct Rebuilder<'a> {
    network: &'a Network,
    dag: Dag,
    /// Signs go outward, to where a subtraction takes them.
    made: Vec<Option<(bool, ExprId)>>,
}

impl Rebuilder<'_> {
    /// Cells that outputs need, operands before their users. What needs most values at a time is computed first, so that
    /// few are alive at once (Sethi and Ullman 1970, as if the network were a tree).
    fn order(&self) -> Vec<Id> {
        let mut alive = vec![0; self.network.cells.len()];
        for id in self.walk(&alive) {
            let mut operands: Vec<usize> = self.operands(id).iter().map(|&x| alive[x]).collect();
            operands.sort_unstable_by(|x, y| y.cmp(x));
            let waiting = operands.into_iter().enumerate();
            alive[id] = waiting.map(|(k, alive)| k + alive).max().unwrap_or(1);
        }
        self.walk(&alive)
    }

    /// Operands before their users; of several operands those with the larger weight first.
    fn walk(&self, weight: &[usize]) -> Vec<Id> {
        let mut order = Vec::new();
        let mut seen = vec![false; self.network.cells.len()];
        // A cell is entered, then its operands, then it is left.
        let mut stack: Vec<(Id, bool)> = Vec::new();
        // Sines and cosines first, in the order in which they were made.
        let is_angle = |cell: &Cell| {
            let Cell::Atom(node, _) = cell else {
                return false;
            };
            matches!(node, Node::Call(Function::Sin | Function::Cos, _))
        };
        let cells = self.network.cells.iter().enumerate();
        let angles = cells.filter(|(_, cell)| is_angle(cell)).map(|(id, _)| id);
        let outputs = self.network.outputs.iter().map(|output| output.1);
        for root in angles.chain(outputs) {
            stack.push((root, false));
            while let Some((id, left)) = stack.pop() {
                if left {
                    order.push(id);
                } else if !std::mem::replace(&mut seen[id], true) {
                    stack.push((id, true));
                    let mut operands = self.operands(id);
                    // The last one is taken first.
                    operands.reverse();
                    operands.sort_by_key(|&operand| weight[operand]);
                    stack.extend(operands.into_iter().map(|operand| (operand, false)));
                }
            }
        }
        order
    }

    fn operands(&self, id: Id) -> Vec<Id> {
        match &self.network.cells[id] {
            Cell::Number(_) => Vec::new(),
            Cell::Atom(_, operands) => operands.clone(),
            Cell::Product(factors) => factors.clone(),
            Cell::Sum(terms) => {
                let factors = terms.iter().flat_map(|term| &term.factors);
                factors.copied().collect()
            }
        }
    }

    fn of(&self, id: Id) -> (bool, ExprId) {
        self.made[id].expect("operands come before their users")
    }

    /// Sign and size of a cell.
    fn make(&mut self, id: Id) -> (bool, ExprId) {
        let network = self.network;
        match &network.cells[id] {
            Cell::Number(value) => (false, self.dag.constant(*value)),
            Cell::Atom(node, operands) => {
                let operands: Vec<ExprId> = operands
                    .iter()
                    .map(|&operand| {
                        let (negative, x) = self.of(operand);
                        self.signed(negative, x)
                    })
                    .collect();
                let node = match (*node, operands.as_slice()) {
                    (Node::Call(function, _), &[x]) => Node::Call(function, x),
                    (Node::Power(..), &[x, y]) => Node::Power(x, y),
                    (Node::Select(..), &[condition, x, y]) => Node::Select(condition, x, y),
                    (node, _) => node,
                };
                (false, self.dag.as_it_is(node))
            }
            Cell::Product(factors) => self.product(factors),
            Cell::Sum(terms) => self.sum(terms),
        }
    }

    fn product(&mut self, factors: &[Id]) -> (bool, ExprId) {
        let factors: Vec<(bool, ExprId)> = factors.iter().map(|&x| self.of(x)).collect();
        if factors.iter().any(|factor| self.dag.is_zero(factor.1)) {
            return (false, self.dag.zero());
        }
        let negative = factors.iter().filter(|factor| factor.0).count() % 2 == 1;
        let is_number = |dag: &Dag, x: ExprId| dag.as_constant(x).is_some();
        let (numbers, rest): (Vec<ExprId>, Vec<ExprId>) = factors
            .into_iter()
            .map(|factor| factor.1)
            .partition(|&x| is_number(&self.dag, x));
        // Numbers come last, and so stand in front.
        let product = rest.into_iter().chain(numbers).reduce(|x, y| {
            let swap = is_number(&self.dag, y) || (x > y && !is_number(&self.dag, x));
            let (x, y) = if swap { (y, x) } else { (x, y) };
            self.dag.as_it_is(Node::Mul(x, y))
        });
        (negative, product.expect("a product has factors"))
    }

    /// Positive terms first; a sum without any is the negative of one that has no others.
    fn sum(&mut self, terms: &[Term]) -> (bool, ExprId) {
        let mut terms: Vec<(bool, ExprId)> = terms
            .iter()
            .map(|term| {
                let (negative, x) = self.product(&term.factors);
                (negative != term.negative, x)
            })
            .collect();
        terms.retain(|term| !self.dag.is_zero(term.1));
        if terms.is_empty() {
            return (false, self.dag.zero());
        }
        let all_negative = terms.iter().all(|term| term.0);
        let (positive, negative): (Vec<_>, Vec<_>) =
            terms.into_iter().partition(|term| term.0 == all_negative);
        let negative: Vec<ExprId> = negative
            .into_iter()
            .map(|(_, x)| self.signed(true, x))
            .collect();
        let positive = positive.into_iter().map(|(_, x)| x);
        let sum = positive
            .chain(negative)
            .reduce(|x, y| self.dag.as_it_is(Node::Add(x.min(y), x.max(y))));
        (all_negative, sum.expect("a sum has terms"))
    }

    fn signed(&mut self, negative: bool, x: ExprId) -> ExprId {
        if !negative {
            return x;
        }
        if let Some(value) = self.dag.as_constant(x) {
            return self.dag.constant(-value);
        }
        let minus = self.dag.constant(-1.0);
        self.dag.as_it_is(Node::Mul(minus, x))
    }
}

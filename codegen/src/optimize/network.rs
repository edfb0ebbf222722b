//! Sums of products of many operands: the form that rewriting works on.
//!
//! In: expressions of a [`Dag`], whose sums and products have two operands each. Out: a [`Network`]. What is used once is
//! part of the sum or product that uses it, so neither order nor parentheses hide what sums have in common.

use std::collections::BTreeMap;

use rustc_hash::FxHashMap as HashMap;

use super::terms;
use crate::expr::{Dag, ExprId, Node};

/// A cell of a [`Network`].
pub type Id = usize;

/// A signed product.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Term {
    /// Whether it is subtracted.
    pub negative: bool,
    /// Ascending; one that comes twice is squared.
    pub factors: Vec<Id>,
}

/// What a cell is computed from.
#[derive(Debug, Clone)]
pub enum Cell {
    /// A number that is not negative.
    Number(f64),
    /// A symbol, a call, a power or a choice, of other cells.
    Atom(Node, Vec<Id>),
    /// A sum of products.
    Sum(Vec<Term>),
    /// A product that is used more than once.
    Product(Vec<Id>),
}

/// Sums of products with shared parts.
#[derive(Debug, Clone, Default)]
pub struct Network {
    /// Ids are places in here. Operands need not come before their users.
    pub cells: Vec<Cell>,
    /// The expression that a cell was made from, which may have a meaning.
    pub origins: Vec<Option<ExprId>>,
    /// Signed cells.
    pub outputs: Vec<(bool, Id)>,
}

impl Network {
    /// The network of the outputs.
    pub fn new(dag: &Dag, outputs: &[ExprId]) -> Self {
        let order = dag.reachable(outputs);
        let uses = Uses::new(dag, &order, outputs);
        let mut builder = Builder {
            dag,
            uses: &uses,
            cell_of: HashMap::default(),
            numbers: BTreeMap::new(),
            network: Self::default(),
        };
        for &x in &order {
            if uses.count[x.index()] > 0 && !uses.inside[x.index()] {
                builder.add(x);
            }
        }
        let outputs = outputs.iter().map(|&x| builder.reference(x)).collect();
        let mut network = Self {
            outputs,
            ..builder.network
        };
        terms::collect(&mut network);
        network
    }

    /// A new cell.
    pub fn push(&mut self, cell: Cell) -> Id {
        self.cells.push(cell);
        self.origins.push(None);
        self.cells.len() - 1
    }

    /// The cell of a number.
    pub fn number(&mut self, size: f64) -> Id {
        let known = self.cells.iter().position(
            |cell| matches!(cell, Cell::Number(value) if value.to_bits() == size.to_bits()),
        );
        known.unwrap_or_else(|| self.push(Cell::Number(size)))
    }

    /// Multiplications and additions.
    pub fn operations(&self) -> usize {
        let product = |factors: &[Id]| factors.len().saturating_sub(1);
        let cells = self.cells.iter();
        cells
            .map(|cell| match cell {
                Cell::Number(_) | Cell::Atom(..) => 0,
                Cell::Product(factors) => product(factors),
                Cell::Sum(terms) => {
                    let products: usize = terms.iter().map(|term| product(&term.factors)).sum();
                    products + terms.len() - 1
                }
            })
            .sum()
    }
}

/// How often expressions are used, with signs looked through.
struct Uses {
    count: Vec<usize>,
    /// Those that are written out in the sum or product that uses them.
    inside: Vec<bool>,
}

impl Uses {
    fn new(dag: &Dag, order: &[ExprId], outputs: &[ExprId]) -> Self {
        // A result that one sum uses besides is used twice.
        let count = dag.uses(order, outputs);
        let mut inside = vec![false; dag.len()];
        for &x in order {
            if count[x.index()] == 0 {
                continue;
            }
            for operand in dag.node(x).operands() {
                let operand = dag.unsigned(operand).1;
                let fits = matches!(
                    (dag.node(x), dag.node(operand)),
                    (Node::Add(..), Node::Add(..) | Node::Mul(..)) | (Node::Mul(..), Node::Mul(..))
                );
                if fits && count[operand.index()] == 1 {
                    inside[operand.index()] = true;
                }
            }
        }
        Self { count, inside }
    }
}

struct Builder<'a> {
    dag: &'a Dag,
    uses: &'a Uses,
    // Looked up only.
    cell_of: HashMap<ExprId, Id>,
    numbers: BTreeMap<u64, Id>,
    network: Network,
}

impl Builder<'_> {
    fn add(&mut self, x: ExprId) {
        let node = self.dag.node(x);
        let cell = match node {
            Node::Constant(_) => return,
            Node::Add(..) => Cell::Sum(self.terms(x)),
            Node::Mul(..) => {
                let Term { negative, factors } = self.product(x);
                if negative {
                    Cell::Sum(vec![Term { negative, factors }])
                } else {
                    Cell::Product(factors)
                }
            }
            _ => {
                let operands: Vec<Id> = node.operands().map(|x| self.positive(x)).collect();
                Cell::Atom(node, operands)
            }
        };
        let id = self.network.push(cell);
        self.network.origins[id] = Some(x);
        self.cell_of.insert(x, id);
    }

    /// The terms of a sum, sums inside of it written out.
    fn terms(&mut self, x: ExprId) -> Vec<Term> {
        let mut terms = Vec::new();
        let mut stack = vec![(false, x)];
        let mut first = true;
        while let Some((negative, x)) = stack.pop() {
            let (sign, x) = self.dag.unsigned(x);
            let negative = negative != sign;
            let open = std::mem::take(&mut first) || self.uses.inside[x.index()];
            match self.dag.node(x) {
                Node::Add(p, q) if open => stack.extend([(negative, q), (negative, p)]),
                Node::Mul(..) if open => {
                    let mut term = self.product(x);
                    term.negative ^= negative;
                    terms.push(term);
                }
                _ => {
                    let (sign, id) = self.reference(x);
                    terms.push(Term {
                        negative: negative != sign,
                        factors: vec![id],
                    });
                }
            }
        }
        terms
    }

    /// The factors of a product, products inside of it written out.
    fn product(&mut self, x: ExprId) -> Term {
        let (mut negative, mut factors) = (false, Vec::new());
        let mut stack = vec![x];
        let mut first = true;
        while let Some(x) = stack.pop() {
            let (sign, x) = self.dag.unsigned(x);
            negative ^= sign;
            let open = std::mem::take(&mut first) || self.uses.inside[x.index()];
            match self.dag.node(x) {
                Node::Mul(p, q) if open => stack.extend([q, p]),
                _ => {
                    let (sign, id) = self.reference(x);
                    negative ^= sign;
                    factors.push(id);
                }
            }
        }
        factors.sort_unstable();
        Term { negative, factors }
    }

    /// Sign and cell of an expression that has a cell.
    fn reference(&mut self, x: ExprId) -> (bool, Id) {
        let (negative, x) = self.dag.unsigned(x);
        match self.dag.as_constant(x) {
            Some(value) => {
                let size = value.abs();
                let network = &mut self.network;
                let id = *self
                    .numbers
                    .entry(size.to_bits())
                    .or_insert_with(|| network.push(Cell::Number(size)));
                (negative != (value < 0.0), id)
            }
            None => (negative, self.cell_of[&x]),
        }
    }

    /// The cell of an operand that has no place for a sign.
    fn positive(&mut self, x: ExprId) -> Id {
        let (negative, id) = self.reference(x);
        if !negative {
            return id;
        }
        let factors = vec![id];
        self.network
            .push(Cell::Sum(vec![Term { negative, factors }]))
    }
}

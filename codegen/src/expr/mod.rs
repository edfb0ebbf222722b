//! Hash-consed expressions: equal subexpressions are one node, shared by construction.
//!
//! In: numbers and [`Symbol`]s. Out: [`ExprId`]s into a [`Dag`]. Invariants gained: operands have smaller ids than the
//! expression that uses them (so ascending ids are a topological order), the operands of a commutative node are in a
//! canonical order, and no rule of [`rules`] applies to any node. The same calls build the same ids.
//!
//! There is no negation and no subtraction: `-x` is `-1 * x`, and a numeric factor always stands in front of a product.
//! Integer powers are products; a quotient is a product with [`Function::Recip`].

mod affine;
mod diff;
mod display;
mod eval;
mod node;
mod pullback;
mod rounding;
pub mod rules;
mod substitute;
mod switch;
mod uses;

use rustc_hash::{FxHashMap as HashMap, FxHashSet as HashSet};

pub(crate) use display::number;
pub use display::{Names, Style};
pub use node::{Function, Node, Real, Symbol};
pub use switch::Switched;

/// An expression of one [`Dag`].
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct ExprId(u32);

impl ExprId {
    /// Position in the dag.
    #[must_use]
    pub const fn index(self) -> usize {
        self.0 as usize
    }
}

/// What an expression means to people, where it has a meaning of its own. Indices count from 0.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Label {
    /// A component of a vector that belongs to a link: `w` of link 3 along x.
    Component {
        /// The vector.
        stem: &'static str,
        /// The link.
        link: usize,
        /// 0 to 2 for x to z.
        axis: usize,
    },
    /// An entry of a link's acceleration gradient `U = [dw]x + [w]x [w]x`.
    Gradient {
        /// The link.
        link: usize,
        /// 0 to 2 for x to z.
        row: usize,
        /// 0 to 2 for x to z.
        column: usize,
    },
    /// An entry of a matrix: `m` in row 1, column 2.
    Entry {
        /// The matrix.
        stem: &'static str,
        /// Its row.
        row: usize,
        /// Its column.
        column: usize,
    },
}

/// The arena of expressions.
#[derive(Debug, Clone, Default)]
pub struct Dag {
    nodes: Vec<Node>,
    // Looked up only; its iteration order never matters.
    index: HashMap<Node, ExprId>,
    // Looked up only.
    labels: HashMap<ExprId, Label>,
    // Looked up only: absolute errors of numbers, by the bits of their magnitude, that sums have left with few digits.
    lost: HashMap<u64, f64>,
    // Looked up only: magnitudes that were given. A sum that comes out as one of them has lost digits, they have not.
    given: HashSet<u64>,
}

impl Dag {
    /// An empty dag.
    #[must_use]
    pub fn new() -> Self {
        Self::default()
    }

    /// The node of an expression.
    #[must_use]
    pub fn node(&self, x: ExprId) -> Node {
        self.nodes[x.index()]
    }

    /// Says what a sum, product or call means; the first label stays.
    pub fn set_label(&mut self, x: ExprId, label: Label) {
        if matches!(self.node(x), Node::Add(..) | Node::Mul(..)) {
            self.labels.entry(x).or_insert(label);
        }
    }

    /// What an expression means, if that was said.
    #[must_use]
    pub fn label(&self, x: ExprId) -> Option<Label> {
        self.labels.get(&x).copied()
    }

    /// Number of nodes.
    #[must_use]
    pub fn len(&self) -> usize {
        self.nodes.len()
    }

    /// Whether nothing has been built yet.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.nodes.is_empty()
    }

    fn intern(&mut self, node: Node) -> ExprId {
        if let Some(&id) = self.index.get(&node) {
            return id;
        }
        let id = ExprId(u32::try_from(self.nodes.len()).expect("fewer than 2^32 expressions"));
        self.nodes.push(node);
        self.index.insert(node, id);
        id
    }

    /// A node without a look at the rules, for passes that have decided its form. Operands are in canonical order.
    pub(crate) fn as_it_is(&mut self, node: Node) -> ExprId {
        self.intern(node)
    }

    /// A number that is given: by a spec, or by a derivation.
    pub fn constant(&mut self, value: f64) -> ExprId {
        self.given.insert(value.abs().to_bits());
        self.folded(value)
    }

    /// A number that other numbers have been folded into.
    fn folded(&mut self, value: f64) -> ExprId {
        self.intern(Node::Constant(Real::new(value)))
    }

    /// `0`
    pub fn zero(&mut self) -> ExprId {
        self.constant(0.0)
    }

    /// A symbol.
    pub fn symbol(&mut self, symbol: Symbol) -> ExprId {
        self.intern(Node::Symbol(symbol))
    }

    /// `x + y`
    pub fn add(&mut self, x: ExprId, y: ExprId) -> ExprId {
        let (x, y) = (x.min(y), x.max(y));
        rules::SUM
            .iter()
            .find_map(|rule| (rule.apply)(self, x, y))
            .unwrap_or_else(|| self.intern(Node::Add(x, y)))
    }

    /// `x * y`
    pub fn mul(&mut self, x: ExprId, y: ExprId) -> ExprId {
        let constant_last = self.as_constant(y).is_some() && self.as_constant(x).is_none();
        let swap = constant_last || (x > y && self.as_constant(x).is_none());
        let (x, y) = if swap { (y, x) } else { (x, y) };
        rules::PRODUCT
            .iter()
            .find_map(|rule| (rule.apply)(self, x, y))
            .unwrap_or_else(|| self.intern(Node::Mul(x, y)))
    }

    /// `x` where `condition > 0`, else `y`.
    pub fn select(&mut self, condition: ExprId, x: ExprId, y: ExprId) -> ExprId {
        rules::SELECT
            .iter()
            .find_map(|rule| (rule.apply)(self, condition, x, y))
            .unwrap_or_else(|| self.intern(Node::Select(condition, x, y)))
    }

    /// The smaller of two.
    pub fn min(&mut self, x: ExprId, y: ExprId) -> ExprId {
        let x_is_larger = self.sub(x, y);
        self.select(x_is_larger, y, x)
    }

    /// The larger of two.
    pub fn max(&mut self, x: ExprId, y: ExprId) -> ExprId {
        let x_is_larger = self.sub(x, y);
        self.select(x_is_larger, x, y)
    }

    /// `f(x)`
    pub fn call(&mut self, function: Function, x: ExprId) -> ExprId {
        rules::CALL
            .iter()
            .find_map(|rule| (rule.apply)(self, function, x))
            .unwrap_or_else(|| self.intern(Node::Call(function, x)))
    }

    /// `x ^ y`; integer constants become products, halves become roots.
    pub fn power(&mut self, x: ExprId, y: ExprId) -> ExprId {
        /// Beyond this a product is slower than `pow`.
        const LONGEST_PRODUCT: f64 = 16.0;
        match (self.as_constant(x), self.as_constant(y)) {
            (Some(base), Some(exponent)) if base.powf(exponent).is_finite() => {
                self.constant(base.powf(exponent))
            }
            (_, Some(exponent)) if exponent.fract() == 0.0 && exponent.abs() <= LONGEST_PRODUCT => {
                let product = self.repeated_product(x, exponent.abs());
                if exponent < 0.0 {
                    self.call(Function::Recip, product)
                } else {
                    product
                }
            }
            (_, Some(0.5)) => self.call(Function::Sqrt, x),
            _ => self.intern(Node::Power(x, y)),
        }
    }

    /// `x * x * ..`, by squaring.
    fn repeated_product(&mut self, x: ExprId, count: f64) -> ExprId {
        let mut product = self.constant(1.0);
        let (mut square, mut count) = (x, count);
        while count >= 1.0 {
            if count % 2.0 >= 1.0 {
                product = self.mul(product, square);
            }
            count = (count / 2.0).floor();
            if count >= 1.0 {
                square = self.mul(square, square);
            }
        }
        product
    }

    /// `factor * x`
    pub fn scale(&mut self, factor: f64, x: ExprId) -> ExprId {
        let factor = self.constant(factor);
        self.mul(factor, x)
    }

    /// `factor * x` with a factor that other numbers have been folded into.
    fn multiple(&mut self, factor: f64, x: ExprId) -> ExprId {
        let factor = self.folded(factor);
        self.mul(factor, x)
    }

    /// `-x`
    pub fn neg(&mut self, x: ExprId) -> ExprId {
        self.scale(-1.0, x)
    }

    /// `x - y`
    pub fn sub(&mut self, x: ExprId, y: ExprId) -> ExprId {
        let minus_y = self.neg(y);
        self.add(x, minus_y)
    }

    /// `x / y`
    pub fn div(&mut self, x: ExprId, y: ExprId) -> ExprId {
        let recip = self.call(Function::Recip, y);
        self.mul(x, recip)
    }

    /// `sum of terms`, from the left.
    pub fn sum(&mut self, terms: impl IntoIterator<Item = ExprId>) -> ExprId {
        let zero = self.zero();
        terms
            .into_iter()
            .fold(zero, |sum, term| self.add(sum, term))
    }

    /// The number, if the expression is one.
    #[must_use]
    pub fn as_constant(&self, x: ExprId) -> Option<f64> {
        match self.node(x) {
            Node::Constant(value) => Some(value.get()),
            _ => None,
        }
    }

    /// Whether the expression is the number zero.
    #[must_use]
    pub fn is_zero(&self, x: ExprId) -> bool {
        self.as_constant(x) == Some(0.0)
    }

    /// `(c, y)` with `x = c * y` and no numeric factor in `y`; a number `x` is `(x, 1)` with `y = None`.
    #[must_use]
    pub fn coefficient(&self, x: ExprId) -> (f64, Option<ExprId>) {
        match self.node(x) {
            Node::Constant(value) => (value.get(), None),
            Node::Mul(factor, rest) => match self.as_constant(factor) {
                Some(c) => (c, Some(rest)),
                None => (1.0, Some(x)),
            },
            _ => (1.0, Some(x)),
        }
    }

    /// All expressions that `roots` are made of, ascending: operands come before their users.
    #[must_use]
    pub fn reachable(&self, roots: &[ExprId]) -> Vec<ExprId> {
        let mut seen = vec![false; self.nodes.len()];
        let mut stack = roots.to_vec();
        while let Some(x) = stack.pop() {
            if !std::mem::replace(&mut seen[x.index()], true) {
                stack.extend(self.node(x).operands());
            }
        }
        (0..)
            .zip(seen)
            .filter(|&(_, seen)| seen)
            .map(|(k, _)| ExprId(k))
            .collect()
    }

    /// The symbols in `roots`, in the order of [`Symbol`].
    #[must_use]
    pub fn symbols(&self, roots: &[ExprId]) -> Vec<Symbol> {
        let mut symbols: Vec<Symbol> = self
            .reachable(roots)
            .into_iter()
            .filter_map(|x| match self.node(x) {
                Node::Symbol(symbol) => Some(symbol),
                _ => None,
            })
            .collect();
        symbols.sort_unstable();
        symbols
    }
}

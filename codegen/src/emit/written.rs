//! Expressions as they are written down: infix operators, with as few parentheses as the reader needs.
//!
//! In: expressions of a [`Dag`]. Out: [`Written`], which a language only has to spell. What is decided here holds wherever
//! products bind before sums and both are read from the left.

use std::collections::HashMap;

use crate::expr::{Dag, ExprId, Function, Node, Symbol};

/// An expression, ready to be spelled.
#[derive(Debug, Clone, PartialEq)]
pub enum Written {
    /// A number.
    Number(f64),
    /// What a symbol is in the arguments of the function.
    Place(Place),
    /// A temporary.
    Name(String),
    /// `(x)`
    Parentheses(Box<Written>),
    /// `-x`
    Negative(Box<Written>),
    /// `x + y`, `x - y`, `x * y` or `x / y`
    Binary(Operator, Box<[Written; 2]>),
    /// `f(x)`
    Call(Function, Box<Written>),
    /// `x ^ y`
    Power(Box<[Written; 2]>),
    /// The second where the first is positive, else the third.
    Choice(Box<[Written; 3]>),
}

/// Where a function finds a value.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Place {
    /// An argument that is a number.
    Argument(&'static str),
    /// An entry of an argument, from 0.
    Entry(&'static str, usize),
}

impl Place {
    /// The argument that it is in.
    pub fn argument(self) -> &'static str {
        match self {
            Self::Argument(name) | Self::Entry(name, _) => name,
        }
    }
}

/// Operators between two operands.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Operator {
    /// `+`
    Plus,
    /// `-`
    Minus,
    /// `*`
    Times,
    /// `/`
    Over,
}

impl Written {
    fn binary(operator: Operator, left: Self, right: Self) -> Self {
        Self::Binary(operator, Box::new([left, right]))
    }

    /// `c1 x1 + c2 x2 + ..`, term by term; nothing is 0.
    pub fn combination(terms: impl IntoIterator<Item = (f64, Self)>) -> Self {
        let mut sum: Option<Self> = None;
        for (coefficient, x) in terms {
            let size = coefficient.abs();
            let term = if size.to_bits() == 1.0f64.to_bits() {
                x
            } else {
                Self::binary(Operator::Times, Self::Number(size), x)
            };
            sum = Some(match (sum, coefficient < 0.0) {
                (None, false) => term,
                (None, true) => Self::Negative(Box::new(term)),
                (Some(sum), false) => Self::binary(Operator::Plus, sum, term),
                (Some(sum), true) => Self::binary(Operator::Minus, sum, term),
            });
        }
        sum.unwrap_or(Self::Number(0.0))
    }
}

/// How loosely an expression holds together.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Strength {
    Sum,
    Product,
    Atom,
}

/// Where the symbols of a function are.
pub type Binding<'a> = dyn Fn(Symbol) -> Place + 'a;

/// Writes expressions.
pub struct Writer<'a> {
    dag: &'a Dag,
    binding: &'a Binding<'a>,
    // Looked up only.
    names: HashMap<ExprId, String>,
}

impl<'a> Writer<'a> {
    /// A writer without temporaries.
    pub fn new(dag: &'a Dag, binding: &'a Binding<'a>) -> Self {
        Self {
            dag,
            binding,
            names: HashMap::new(),
        }
    }

    /// From now on the expression is its temporary.
    pub fn set_name(&mut self, x: ExprId, name: String) {
        self.names.insert(x, name);
    }

    /// The expression, by its temporary if it has one.
    pub fn value(&self, x: ExprId) -> Written {
        self.write(x).0
    }

    /// The right-hand side of the expression's temporary.
    pub fn definition(&self, x: ExprId) -> Written {
        self.write_node(x).0
    }

    fn write(&self, x: ExprId) -> (Written, Strength) {
        match self.names.get(&x) {
            Some(name) => (Written::Name(name.clone()), Strength::Atom),
            None => self.write_node(x),
        }
    }

    fn at_least(&self, x: ExprId, strength: Strength) -> Written {
        let (written, own) = self.write(x);
        if own < strength {
            Written::Parentheses(Box::new(written))
        } else {
            written
        }
    }

    fn write_node(&self, x: ExprId) -> (Written, Strength) {
        match self.dag.node(x) {
            Node::Constant(value) => (Written::Number(value.get()), Strength::Atom),
            Node::Symbol(symbol) => (Written::Place((self.binding)(symbol)), Strength::Atom),
            Node::Add(p, q) => (self.write_sum(p, q), Strength::Sum),
            Node::Mul(p, q) => (self.write_product(p, q), Strength::Product),
            Node::Power(p, q) => {
                let both = [self.value(p), self.value(q)];
                (Written::Power(Box::new(both)), Strength::Atom)
            }
            Node::Select(condition, p, q) => {
                let all = [self.value(condition), self.value(p), self.value(q)];
                (Written::Choice(Box::new(all)), Strength::Atom)
            }
            Node::Call(Function::Recip, p) => {
                let p = self.at_least(p, Strength::Atom);
                let quotient = Written::binary(Operator::Over, Written::Number(1.0), p);
                (quotient, Strength::Product)
            }
            Node::Call(function, p) => {
                let p = self.value(p);
                (Written::Call(function, Box::new(p)), Strength::Atom)
            }
        }
    }

    /// Whether the written form starts with a minus that a subtraction can take.
    fn is_negative(&self, x: ExprId) -> bool {
        !self.names.contains_key(&x) && self.dag.coefficient(x).0 < 0.0
    }

    /// What a product with this reciprocal divides by, where nothing else uses it.
    fn divisor(&self, x: ExprId) -> Option<ExprId> {
        match self.dag.node(x) {
            Node::Call(Function::Recip, divisor) if !self.names.contains_key(&x) => Some(divisor),
            _ => None,
        }
    }

    fn write_sum(&self, p: ExprId, q: ExprId) -> Written {
        let (p, q) = match (self.is_negative(p), self.is_negative(q)) {
            (true, false) => (q, p),
            // A number reads better behind what it is added to.
            (false, false) if self.dag.as_constant(p).is_some() => (q, p),
            _ => (p, q),
        };
        let left = self.at_least(p, Strength::Sum);
        if !self.is_negative(q) {
            let right = self.at_least(q, Strength::Sum);
            return Written::binary(Operator::Plus, left, right);
        }
        let right = match self.dag.coefficient(q) {
            (c, None) => Written::Number(-c),
            (c, Some(rest)) => self.scaled(-c, rest),
        };
        Written::binary(Operator::Minus, left, right)
    }

    /// `c x` with positive `c`, as an operand of a subtraction.
    fn scaled(&self, c: f64, x: ExprId) -> Written {
        if c.to_bits() == 1.0f64.to_bits() {
            return self.at_least(x, Strength::Product);
        }
        if let Some(divisor) = self.divisor(x) {
            let divisor = self.at_least(divisor, Strength::Atom);
            return Written::binary(Operator::Over, Written::Number(c), divisor);
        }
        let rest = self.at_least(x, Strength::Product);
        Written::binary(Operator::Times, Written::Number(c), rest)
    }

    fn write_product(&self, p: ExprId, q: ExprId) -> Written {
        if self.dag.as_constant(p) == Some(-1.0) {
            let rest = self.at_least(q, Strength::Product);
            return Written::Negative(Box::new(rest));
        }
        for (x, over) in [(p, q), (q, p)] {
            if let Some(divisor) = self.divisor(over) {
                let left = self.at_least(x, Strength::Product);
                let right = self.at_least(divisor, Strength::Atom);
                return Written::binary(Operator::Over, left, right);
            }
        }
        let left = self.at_least(p, Strength::Product);
        let right = self.at_least(q, Strength::Product);
        Written::binary(Operator::Times, left, right)
    }
}

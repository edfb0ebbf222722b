//! Expressions as Rust tokens, with as few parentheses as the reader needs.

use std::collections::HashMap;

use proc_macro2::{Ident, Literal, Span, TokenStream};
use quote::quote;

use super::body::Cost;
use crate::expr::{Dag, ExprId, Function, Node, Symbol};

/// What symbols are in the function's arguments.
pub struct Binding<'a> {
    /// Tokens of a standard parameter.
    pub parameter: &'a dyn Fn(usize) -> TokenStream,
    /// Tokens of a shape parameter.
    pub shape: &'a dyn Fn(usize) -> TokenStream,
}

impl Binding<'_> {
    fn symbol(&self, symbol: Symbol) -> TokenStream {
        let indexed = |name: &str, k: usize| {
            let (name, k) = (
                Ident::new(name, Span::call_site()),
                Literal::usize_unsuffixed(k),
            );
            quote!(#name[#k])
        };
        match symbol {
            Symbol::Q(j) => indexed("q", j),
            Symbol::Dq(j) => indexed("dq", j),
            Symbol::Ddq(j) => indexed("ddq", j),
            Symbol::RigidTorque(j) => indexed("rigid_torque", j),
            Symbol::MeasuredTorque(j) => indexed("measured_torque", j),
            Symbol::Input(k) => indexed("inputs", k),
            Symbol::State(k) => indexed("states", k),
            Symbol::Time => quote!(time),
            Symbol::Parameter(k) => (self.parameter)(k),
            Symbol::Shape(k) => (self.shape)(k),
        }
    }
}

/// How loosely an expression holds together.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Strength {
    Sum,
    Product,
    Atom,
}

/// Writes expressions and counts their operations.
pub struct Renderer<'a> {
    dag: &'a Dag,
    binding: &'a Binding<'a>,
    // Looked up only.
    names: HashMap<ExprId, Ident>,
    cost: Cost,
    has_famous_numbers: bool,
}

impl<'a> Renderer<'a> {
    /// A renderer without temporaries.
    pub fn new(dag: &'a Dag, binding: &'a Binding<'a>) -> Self {
        Self {
            dag,
            binding,
            names: HashMap::new(),
            cost: Cost::default(),
            has_famous_numbers: false,
        }
    }

    /// From now on the expression is its temporary.
    pub fn set_name(&mut self, x: ExprId, name: Ident) {
        self.names.insert(x, name);
    }

    /// Operations written so far.
    pub fn cost(&self) -> Cost {
        self.cost
    }

    /// Whether a number was written that clippy takes for an approximation of pi, of a root of 2 or the like.
    pub fn has_famous_numbers(&self) -> bool {
        self.has_famous_numbers
    }

    /// The expression, by its temporary if it has one.
    pub fn value(&mut self, x: ExprId) -> TokenStream {
        self.write(x).0
    }

    /// The right-hand side of the expression's temporary.
    pub fn definition(&mut self, x: ExprId) -> TokenStream {
        self.write_node(x).0
    }

    fn write(&mut self, x: ExprId) -> (TokenStream, Strength) {
        match self.names.get(&x) {
            Some(name) => (quote!(#name), Strength::Atom),
            None => self.write_node(x),
        }
    }

    fn at_least(&mut self, x: ExprId, strength: Strength) -> TokenStream {
        let (tokens, own) = self.write(x);
        if own < strength {
            quote!((#tokens))
        } else {
            tokens
        }
    }

    fn write_node(&mut self, x: ExprId) -> (TokenStream, Strength) {
        match self.dag.node(x) {
            Node::Constant(value) => (self.constant(value.get()), Strength::Atom),
            Node::Symbol(symbol) => (self.binding.symbol(symbol), Strength::Atom),
            Node::Add(p, q) => self.write_sum(p, q),
            Node::Mul(p, q) => self.write_product(p, q),
            Node::Power(p, q) => {
                self.cost.call += 1;
                let (p, q) = (self.value(p), self.value(q));
                (quote!(S::pow(#p, #q)), Strength::Atom)
            }
            Node::Select(condition, p, q) => self.write_choice(condition, p, q),
            Node::Call(Function::Recip, p) => {
                self.cost.div += 1;
                let p = self.at_least(p, Strength::Atom);
                (quote!(S::of(1.0) / #p), Strength::Product)
            }
            Node::Call(function, p) => {
                if matches!(function, Function::Sin | Function::Cos) {
                    self.cost.trig += 1;
                } else {
                    self.cost.call += 1;
                }
                let name = Ident::new(function.name(), Span::call_site());
                let p = self.value(p);
                (quote!(S::#name(#p)), Strength::Atom)
            }
        }
    }

    /// `x` where the condition is positive, else `y`.
    fn write_choice(&mut self, condition: ExprId, x: ExprId, y: ExprId) -> (TokenStream, Strength) {
        self.cost.call += 1;
        let condition = self.value(condition);
        let (x, y) = (self.value(x), self.value(y));
        (quote!(S::choose(#condition, #x, #y)), Strength::Atom)
    }

    /// A number in the scalar of the function.
    fn constant(&mut self, value: f64) -> TokenStream {
        self.has_famous_numbers |= is_famous(value.abs());
        let number = number(value);
        quote!(S::of(#number))
    }

    /// Whether the written form starts with a minus that a subtraction can take.
    fn is_negative(&self, x: ExprId) -> bool {
        !self.names.contains_key(&x) && self.dag.coefficient(x).0 < 0.0
    }

    fn write_sum(&mut self, p: ExprId, q: ExprId) -> (TokenStream, Strength) {
        self.cost.add += 1;
        let (p, q) = match (self.is_negative(p), self.is_negative(q)) {
            (true, false) => (q, p),
            // A number reads better behind what it is added to.
            (false, false) if self.dag.as_constant(p).is_some() => (q, p),
            _ => (p, q),
        };
        let left = self.at_least(p, Strength::Sum);
        if !self.is_negative(q) {
            let right = self.at_least(q, Strength::Sum);
            return (quote!(#left + #right), Strength::Sum);
        }
        let right = match self.dag.coefficient(q) {
            (c, None) => self.constant(-c),
            (c, Some(rest)) => self.scaled(-c, rest),
        };
        (quote!(#left - #right), Strength::Sum)
    }

    /// `c x` with positive `c`, as an operand of a subtraction.
    fn scaled(&mut self, c: f64, x: ExprId) -> TokenStream {
        let rest = self.at_least(x, Strength::Product);
        if c.to_bits() == 1.0f64.to_bits() {
            return rest;
        }
        self.cost.mul += 1;
        let c = self.constant(c);
        quote!(#c * #rest)
    }

    fn write_product(&mut self, p: ExprId, q: ExprId) -> (TokenStream, Strength) {
        if self
            .dag
            .as_constant(p)
            .is_some_and(|c| c.to_bits() == (-1.0f64).to_bits())
        {
            let rest = self.at_least(q, Strength::Product);
            return (quote!(-#rest), Strength::Product);
        }
        if let (Node::Call(Function::Recip, q), false) =
            (self.dag.node(q), self.names.contains_key(&q))
        {
            self.cost.div += 1;
            let left = self.at_least(p, Strength::Product);
            let right = self.at_least(q, Strength::Atom);
            return (quote!(#left / #right), Strength::Product);
        }
        self.cost.mul += 1;
        let left = self.at_least(p, Strength::Product);
        let right = self.at_least(q, Strength::Product);
        (quote!(#left * #right), Strength::Product)
    }
}

/// A number as a literal that reads back to the same bits.
#[must_use]
pub fn number(value: f64) -> TokenStream {
    let literal = Literal::f64_unsuffixed(value.abs());
    if value < 0.0 {
        quote!(-#literal)
    } else {
        quote!(#literal)
    }
}

/// Near a constant of the standard library. Clippy compares as many digits as there are, three at least.
fn is_famous(value: f64) -> bool {
    use std::f64::consts as c;
    let famous = [
        c::E,
        c::FRAC_1_PI,
        c::FRAC_1_SQRT_2,
        c::FRAC_2_PI,
        c::FRAC_2_SQRT_PI,
        c::FRAC_PI_2,
        c::FRAC_PI_3,
        c::FRAC_PI_4,
        c::FRAC_PI_6,
        c::FRAC_PI_8,
        c::LN_2,
        c::LN_10,
        c::LOG10_2,
        c::LOG10_E,
        c::LOG2_10,
        c::LOG2_E,
        c::PI,
        c::SQRT_2,
        c::TAU,
    ];
    famous
        .iter()
        .any(|constant| (value / constant - 1.0).abs() < 1e-2)
}

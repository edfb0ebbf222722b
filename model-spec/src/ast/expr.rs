//! Expressions as they were written.

use proc_macro2::Span;
use syn::Ident;

use crate::model::BinaryOp;

/// An expression with its place in the text.
#[derive(Debug, Clone)]
pub struct Expr {
    /// What it is.
    pub kind: ExprKind,
    /// All of it.
    pub span: Span,
}

/// The forms of an expression.
#[derive(Debug, Clone)]
pub enum ExprKind {
    /// `90 deg`, `3 m^2`, `0.3`
    Number(f64, Option<Unit>),
    /// A parameter, `pi`, `time`, a unit, a word.
    Name(Ident),
    /// `f(x)`
    Call(Ident, Vec<Expr>),
    /// `-x`
    Neg(Box<Expr>),
    /// `x op y`
    Binary(BinaryOp, Box<Expr>, Box<Expr>),
    /// `if c { x } else { y }`
    Choice(Box<Condition>, Box<Expr>, Box<Expr>),
}

/// `deg`, `m^2`: behind a number, and part of it.
#[derive(Debug, Clone)]
pub struct Unit {
    /// Its name.
    pub name: Ident,
    /// Its power.
    pub exponent: i32,
}

/// `greater > smaller`, or `greater >= smaller`; `x < y` is `y > x`.
#[derive(Debug, Clone)]
pub struct Condition {
    /// `>=` or `<=`.
    pub or_equal: bool,
    /// What has to be larger.
    pub greater: Expr,
    /// Than this.
    pub smaller: Expr,
}

impl Expr {
    /// The part of the expression that a path of operands leads to, the whole where the path is empty.
    #[must_use]
    pub(crate) fn at(&self, path: &[usize]) -> &Self {
        let [first, rest @ ..] = path else {
            return self;
        };
        let operand = match (&self.kind, first) {
            (ExprKind::Neg(x) | ExprKind::Binary(_, x, _), 0) => Some(&**x),
            (ExprKind::Binary(_, _, y), 1) => Some(&**y),
            (ExprKind::Call(_, arguments), k) => arguments.get(*k),
            _ => None,
        };
        operand.map_or(self, |operand| operand.at(rest))
    }
}

//! The structural rule of effects: every term of a torque has exactly one linear parameter as a factor.
//!
//! Then the torque is linear and homogeneous in the linear parameters, and least squares can solve for them. The rule looks
//! at the equation as written; it does no algebra. States and what decides a choice are free of linear parameters, so that
//! the columns are.

use std::collections::BTreeMap;

use super::Errors;
use super::binding::rate_name;
use crate::ast::{BinaryOp, Equation, Expr, ExprKind, Let, Linear};
use crate::diagnostic::Diagnostic;

/// How a part of an equation depends on the linear parameters.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Degree {
    /// The number 0: fits where either of the others does.
    Zero,
    /// Free of them.
    Free,
    /// Linear and homogeneous in them.
    Linear,
}

/// The degree of every name that is known so far; other names are free.
pub(super) struct Degrees(BTreeMap<String, Degree>);

impl Degrees {
    /// Knows the linear parameters.
    pub(super) fn new(linear: &[Linear]) -> Self {
        let names = linear.iter().map(|linear| linear.name.to_string());
        Self(names.map(|name| (name, Degree::Linear)).collect())
    }

    /// Reports what keeps a torque from being linear.
    pub(super) fn check_torque(&self, torque: &Expr, errors: &mut Errors) {
        match self.degree(torque) {
            Ok(Degree::Linear) => {}
            Ok(_) => errors.push(constant_term(torque, TERM)),
            Err(error) => errors.push(error),
        }
    }

    /// Reports what keeps an entry of a list from being zero or linear; `list` is its name.
    pub(super) fn check_entry(&self, entry: &Expr, list: &str, errors: &mut Errors) {
        match self.degree(entry) {
            Ok(Degree::Zero | Degree::Linear) => {}
            Ok(Degree::Free) => errors.push(constant_term(entry, &format!("an entry of `{list}`"))),
            Err(error) => errors.push(error),
        }
    }

    /// Whether an expression depends on linear parameters, or is a mistake.
    pub(super) fn is_free(&self, value: &Expr) -> bool {
        matches!(self.degree(value), Ok(Degree::Zero | Degree::Free))
    }

    /// Learns the degree of a binding whose parts are known.
    pub(super) fn check_let(&mut self, binding: &Let, errors: &mut Errors) {
        match self.degree(&binding.value) {
            Ok(Degree::Linear) => {
                self.0.insert(binding.name.to_string(), Degree::Linear);
            }
            Ok(_) => {}
            Err(error) => errors.push(error),
        }
    }

    /// Reports a rate that depends on linear parameters.
    pub(super) fn check_rate(&self, rate: &Equation, errors: &mut Errors) {
        if self.is_free(&rate.value) {
            return;
        }
        errors.push(
            Diagnostic::new(
                rate.value.span,
                format!("`{}` depends on a linear parameter", rate_name(&rate.of)),
                "the state would depend on an identified parameter",
            )
            .help("scale the state so that the linear parameter is in the torque, or make it a shape parameter"),
        );
    }

    fn degree(&self, expr: &Expr) -> Result<Degree, Diagnostic> {
        match &expr.kind {
            ExprKind::Number(value, _) if *value == 0.0 => Ok(Degree::Zero),
            ExprKind::Number(..) => Ok(Degree::Free),
            ExprKind::Name(name) => {
                let known = self.0.get(&name.to_string());
                Ok(known.copied().unwrap_or(Degree::Free))
            }
            ExprKind::Neg(inner) => self.degree(inner),
            ExprKind::Call(name, arguments) => {
                for argument in arguments {
                    if self.degree(argument)? == Degree::Linear {
                        return Err(not_linear(argument, &format!("inside `{name}`")));
                    }
                }
                Ok(Degree::Free)
            }
            ExprKind::Binary(op, left, right) => self.binary(*op, left, right, expr),
            ExprKind::Choice(condition, then, otherwise) => {
                for side in [&condition.greater, &condition.smaller] {
                    if self.degree(side)? == Degree::Linear {
                        return Err(not_linear(side, "in a condition"));
                    }
                }
                either(
                    then,
                    otherwise,
                    (self.degree(then)?, self.degree(otherwise)?),
                )
            }
        }
    }

    fn binary(
        &self,
        op: BinaryOp,
        left: &Expr,
        right: &Expr,
        whole: &Expr,
    ) -> Result<Degree, Diagnostic> {
        use Degree::{Free, Linear, Zero};
        let degrees = (self.degree(left)?, self.degree(right)?);
        match (op, degrees) {
            (BinaryOp::Add | BinaryOp::Sub, _) => either(left, right, degrees),
            (BinaryOp::Mul, (Linear, Linear)) => {
                Err(not_linear(whole, "a product of linear parameters"))
            }
            (BinaryOp::Mul, (Zero, _) | (_, Zero)) => Ok(Zero),
            (BinaryOp::Mul, (Linear, _) | (_, Linear)) => Ok(Linear),
            (BinaryOp::Div, (_, Linear)) => Err(not_linear(right, "in a denominator")),
            (BinaryOp::Div, (left, _)) => Ok(left),
            (BinaryOp::Pow, (Linear, _) | (_, Linear)) => Err(not_linear(whole, "under a power")),
            (BinaryOp::Mul | BinaryOp::Pow, _) => Ok(Free),
        }
    }
}

/// The degree that two terms of a sum, or two values of a choice, have in common.
fn either(left: &Expr, right: &Expr, degrees: (Degree, Degree)) -> Result<Degree, Diagnostic> {
    match degrees {
        (Degree::Free, Degree::Linear) => Err(constant_term(left, TERM)),
        (Degree::Linear, Degree::Free) => Err(constant_term(right, TERM)),
        (Degree::Zero, degree) | (degree, _) => Ok(degree),
    }
}

/// What most often has no linear parameter.
const TERM: &str = "a term of the torque";

fn constant_term(term: &Expr, what: &str) -> Diagnostic {
    Diagnostic::new(
        term.span,
        format!("{what} has no linear parameter"),
        "nothing to identify here",
    )
    .help("multiply the term by a linear parameter, or move it into the terms that have one")
}

fn not_linear(place: &Expr, label: &str) -> Diagnostic {
    Diagnostic::new(
        place.span,
        "the torque is not linear in a linear parameter",
        label,
    )
    .help("make it a shape parameter: `shape name in low .. high;`")
}

//! The structural rule of effects: every term has exactly one linear parameter as a factor.
//!
//! Then the torque is linear and homogeneous in the linear parameters, and least squares can solve for them. The rule looks
//! at the equation as written; it does no algebra.

use super::Errors;
use crate::ast::{BinaryOp, Expr, ExprKind};
use crate::diagnostic::Diagnostic;

/// Reports what keeps `torque` from being linear in the parameters that `is_linear` knows.
pub(super) fn check_linear(torque: &Expr, is_linear: &dyn Fn(&str) -> bool, errors: &mut Errors) {
    match degree(torque, is_linear) {
        Ok(1) => {}
        Ok(_) => errors.push(constant_term(torque)),
        Err(error) => errors.push(error),
    }
}

fn constant_term(term: &Expr) -> Diagnostic {
    Diagnostic::new(
        term.span,
        "a term of the torque has no linear parameter",
        "nothing to solve for here",
    )
    .help("multiply the term by a linear parameter, or move it into the terms that have one")
}

/// 0: free of linear parameters. 1: linear and homogeneous in them.
fn degree(expr: &Expr, is_linear: &dyn Fn(&str) -> bool) -> Result<u8, Diagnostic> {
    match &expr.kind {
        ExprKind::Number(..) => Ok(0),
        ExprKind::Name(name) => Ok(u8::from(is_linear(&name.to_string()))),
        ExprKind::Neg(inner) => degree(inner, is_linear),
        ExprKind::Call(name, arguments) => {
            for argument in arguments {
                if degree(argument, is_linear)? > 0 {
                    return Err(not_linear(argument, &format!("inside `{name}`")));
                }
            }
            Ok(0)
        }
        ExprKind::Binary(op, left, right) => {
            let (l, r) = (degree(left, is_linear)?, degree(right, is_linear)?);
            match op {
                BinaryOp::Add | BinaryOp::Sub if l == r => Ok(l),
                BinaryOp::Add | BinaryOp::Sub => {
                    Err(constant_term(if l == 0 { left } else { right }))
                }
                BinaryOp::Mul if l + r <= 1 => Ok(l + r),
                BinaryOp::Mul => Err(not_linear(expr, "a product of linear parameters")),
                BinaryOp::Div if r == 0 => Ok(l),
                BinaryOp::Div => Err(not_linear(right, "in a denominator")),
                BinaryOp::Pow if l + r == 0 => Ok(0),
                BinaryOp::Pow => Err(not_linear(expr, "under a power")),
            }
        }
    }
}

fn not_linear(place: &Expr, label: &str) -> Diagnostic {
    Diagnostic::new(
        place.span,
        "the torque is not linear in a linear parameter",
        label,
    )
    .help("make it a shape parameter: `shape name in low .. high;`")
}

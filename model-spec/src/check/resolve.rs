//! Names of an effect's equation to indices: parameters, signals, functions.

use proc_macro2::Span;
use syn::Ident;

use super::Errors;
use crate::ast::{self, ExprKind};
use crate::diagnostic::Diagnostic;
use crate::model::{EffectExpr, EffectLeaf, Expr, Function, Signal};
use crate::suggest;

/// Names of the functions.
const FUNCTIONS: [(&str, Function); 7] = [
    ("sin", Function::Sin),
    ("cos", Function::Cos),
    ("exp", Function::Exp),
    ("sqrt", Function::Sqrt),
    ("abs", Function::Abs),
    ("sign", Function::Sign),
    ("tanh", Function::Tanh),
];

/// Names of the signals.
const SIGNALS: [(&str, Signal); 4] = [
    ("q", Signal::Position),
    ("dq", Signal::Velocity),
    ("ddq", Signal::Acceleration),
    ("rigid_torque", Signal::RigidTorque),
];

/// Words that parameters and formal joints may not take.
pub(super) fn is_reserved(name: &str) -> bool {
    matches!(
        name,
        "pi" | "time" | "torque" | "linear" | "shape" | "step" | "in" | "on"
    ) || SIGNALS.iter().any(|(signal, _)| *signal == name)
        || FUNCTIONS.iter().any(|(function, _)| *function == name)
}

/// The function of that name.
pub(super) fn function(name: &Ident) -> Result<Function, Diagnostic> {
    let text = name.to_string();
    FUNCTIONS
        .iter()
        .find(|(function, _)| *function == text)
        .map(|(_, function)| *function)
        .ok_or_else(|| {
            Diagnostic::new(name.span(), format!("unknown function `{text}`"), "").help(
                suggest::help(&text, FUNCTIONS.iter().map(|(function, _)| *function)),
            )
        })
}

/// A function with none or several arguments.
pub(super) fn one_argument(name: &Ident, count: usize, span: Span) -> Diagnostic {
    Diagnostic::new(
        span,
        format!("`{name}` takes one argument, found {count}"),
        "",
    )
    .help(format!("write `{name}(x)`"))
}

/// The names that an effect's equations may use.
pub(super) struct Scope {
    pub(super) joints: Vec<String>,
    pub(super) linear: Vec<String>,
    pub(super) shapes: Vec<String>,
}

impl Scope {
    /// The equation over indices; `None` behind an error.
    pub(super) fn resolve(&self, expr: &ast::Expr, errors: &mut Errors) -> Option<EffectExpr> {
        match &expr.kind {
            ExprKind::Number(value, None) => Some(Expr::Number(*value)),
            ExprKind::Number(..) => super::value::constant(expr)
                .map(|q| Expr::Number(q.value))
                .map_err(|error| errors.push(error))
                .ok(),
            ExprKind::Name(name) => self.name(name, errors),
            ExprKind::Call(name, arguments) => self.call(name, arguments, expr.span, errors),
            ExprKind::Neg(inner) => Some(Expr::Neg(Box::new(self.resolve(inner, errors)?))),
            ExprKind::Binary(op, left, right) => {
                let (left, right) = (self.resolve(left, errors), self.resolve(right, errors));
                Some(Expr::Binary(*op, Box::new(left?), Box::new(right?)))
            }
        }
    }

    fn name(&self, name: &Ident, errors: &mut Errors) -> Option<EffectExpr> {
        let text = name.to_string();
        if let Some(k) = self.linear.iter().position(|linear| *linear == text) {
            return Some(Expr::Leaf(EffectLeaf::Linear(k)));
        }
        if let Some(k) = self.shapes.iter().position(|shape| *shape == text) {
            return Some(Expr::Leaf(EffectLeaf::Shape(k)));
        }
        match text.as_str() {
            "time" => return Some(Expr::Leaf(EffectLeaf::Time)),
            "pi" => return Some(Expr::Number(std::f64::consts::PI)),
            _ => {}
        }
        let joint = self.joints.first().map_or("j", String::as_str);
        let error = Diagnostic::new(
            name.span(),
            format!("unknown name `{text}`"),
            "not a parameter of this effect",
        );
        errors.push(if SIGNALS.iter().any(|(signal, _)| *signal == text) {
            error.help(format!("write `{text}({joint})`"))
        } else if self.joints.contains(&text) {
            error.help(format!(
                "`{text}` is a joint; write a signal of it, such as `dq({text})`"
            ))
        } else {
            let known = self.linear.iter().chain(&self.shapes).map(String::as_str);
            match suggest::nearest(&text, known) {
                Some(near) => error.help(format!("write `{near}`")),
                None => error.help(format!(
                    "declare `linear {text};` or `shape {text} in low .. high;`"
                )),
            }
        });
        None
    }

    fn call(
        &self,
        name: &Ident,
        arguments: &[ast::Expr],
        span: Span,
        errors: &mut Errors,
    ) -> Option<EffectExpr> {
        let text = name.to_string();
        if let Some((_, signal)) = SIGNALS.iter().find(|(signal, _)| *signal == text) {
            return self.signal(name, *signal, arguments, span, errors);
        }
        let Ok(function) = function(name) else {
            let functions = FUNCTIONS.iter().map(|(name, _)| *name);
            let known = functions.chain(SIGNALS.iter().map(|(name, _)| *name));
            errors.push(
                Diagnostic::new(
                    name.span(),
                    format!("unknown function or signal `{text}`"),
                    "",
                )
                .help(suggest::help(&text, known)),
            );
            return None;
        };
        let [argument] = arguments else {
            errors.push(one_argument(name, arguments.len(), span));
            return None;
        };
        Some(Expr::Call(
            function,
            Box::new(self.resolve(argument, errors)?),
        ))
    }

    fn signal(
        &self,
        name: &Ident,
        signal: Signal,
        arguments: &[ast::Expr],
        span: Span,
        errors: &mut Errors,
    ) -> Option<EffectExpr> {
        let joint = match arguments {
            [
                ast::Expr {
                    kind: ExprKind::Name(joint),
                    ..
                },
            ] => Some(joint.to_string()),
            _ => None,
        };
        let index = joint.and_then(|joint| self.joints.iter().position(|formal| *formal == joint));
        if index.is_none() {
            errors.push(
                Diagnostic::new(
                    span,
                    format!("`{name}` is a signal of one of the effect's joints"),
                    "of which joint?",
                )
                .help(format!(
                    "write {}",
                    self.joints
                        .iter()
                        .map(|j| format!("`{name}({j})`"))
                        .collect::<Vec<_>>()
                        .join(" or ")
                )),
            );
        }
        index.map(|index| Expr::Leaf(EffectLeaf::Signal(signal, index)))
    }
}

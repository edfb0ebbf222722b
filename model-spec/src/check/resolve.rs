//! Names of an effect's equation to indices: parameters, signals, functions.

use proc_macro2::Span;
use syn::Ident;

use super::Errors;
use super::binding::rate_name;
use super::words::{FUNCTIONS, SIGNALS, function, one_argument, two_arguments};
use crate::ast::{self, ExprKind};
use crate::diagnostic::Diagnostic;
use crate::model::{BinaryOp, Choice, EffectExpr, EffectLeaf, Expr, Signal};
use crate::suggest;
use crate::transform::{LARGEST, LARGEST_EXPONENT};

/// What to do about a value that cannot be computed with.
pub(super) const NOT_COMPUTABLE: &str = "do not divide by zero or take roots of negative numbers, stay below 1e30, and write exponents up to 60";

/// Whether what is known of the value without any leaf can be computed with.
fn is_computable(value: &EffectExpr) -> bool {
    let number = |part: &EffectExpr| part.number(&|_| None);
    let is_so = match value {
        Expr::Binary(BinaryOp::Div, _, y) => number(y) != Some(0.0),
        Expr::Binary(BinaryOp::Pow, _, y) => number(y).is_none_or(|y| y.abs() <= LARGEST_EXPONENT),
        _ => true,
    };
    is_so && number(value).is_none_or(|x| x.abs() <= LARGEST)
}

/// The names that an effect's equations may use.
pub(super) struct Scope {
    pub(super) joints: Vec<String>,
    pub(super) linear: Vec<String>,
    pub(super) shapes: Vec<String>,
    /// With the formal joint whose column it is.
    pub(super) inputs: Vec<(String, Option<usize>)>,
    pub(super) states: Vec<String>,
    /// `let` bindings, and rates as `dot(z)`.
    pub(super) bindings: Vec<String>,
}

impl Scope {
    /// The equation over indices; `None` behind an error.
    pub(super) fn resolve(&self, expr: &ast::Expr, errors: &mut Errors) -> Option<EffectExpr> {
        let value = self.resolve_part(expr, errors)?;
        if is_computable(&value) {
            return Some(value);
        }
        errors.push(
            Diagnostic::new(
                expr.span,
                "this is not a finite number, or too large to compute with",
                "for every motion",
            )
            .help(NOT_COMPUTABLE),
        );
        None
    }

    fn resolve_part(&self, expr: &ast::Expr, errors: &mut Errors) -> Option<EffectExpr> {
        match &expr.kind {
            ExprKind::Number(value, None) => Some(Expr::Number(*value)),
            ExprKind::Number(value, Some(unit)) if let Some(kind) = self.kind_of(&unit.name) => {
                errors.push(super::value::unit_or_name(
                    expr,
                    *value,
                    unit,
                    kind,
                    "for a quantity write its value in SI units, without a unit",
                ));
                None
            }
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
            ExprKind::Choice(condition, then, otherwise) => {
                self.choice(condition, then, otherwise, errors)
            }
        }
    }

    /// `x >= y` is no `y > x`: the values change places.
    fn choice(
        &self,
        condition: &ast::Condition,
        then: &ast::Expr,
        otherwise: &ast::Expr,
        errors: &mut Errors,
    ) -> Option<EffectExpr> {
        let greater = self.resolve(&condition.greater, errors);
        let smaller = self.resolve(&condition.smaller, errors);
        let then = self.resolve(then, errors);
        let otherwise = self.resolve(otherwise, errors);
        let choice = Choice {
            greater: greater?,
            smaller: smaller?,
            then: then?,
            otherwise: otherwise?,
        };
        Some(Expr::Choice(Box::new(if condition.or_equal {
            Choice {
                greater: choice.smaller,
                smaller: choice.greater,
                then: choice.otherwise,
                otherwise: choice.then,
            }
        } else {
            choice
        })))
    }

    /// What a name stands for, in words.
    fn kind_of(&self, name: &Ident) -> Option<&'static str> {
        let among = |names: &[String]| names.iter().any(|known| name == known);
        if among(&self.linear) || among(&self.shapes) {
            Some("parameter")
        } else if among(&self.states) {
            Some("state")
        } else if among(&self.bindings) {
            Some("`let`")
        } else if self.inputs.iter().any(|(input, _)| name == input) {
            Some("input")
        } else {
            None
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
        if let Some(k) = self.states.iter().position(|state| *state == text) {
            return Some(Expr::Leaf(EffectLeaf::State(k)));
        }
        if let Some(k) = self.bindings.iter().position(|binding| *binding == text) {
            return Some(Expr::Leaf(EffectLeaf::Binding(k)));
        }
        if let Some(k) = self.inputs.iter().position(|(input, _)| *input == text) {
            if self.inputs[k].1.is_some() {
                return self.joint_is_missing(name, errors);
            }
            return Some(Expr::Leaf(EffectLeaf::Input(k)));
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
            let known = self.linear.iter().chain(&self.shapes).chain(&self.states);
            let known = known.chain(&self.bindings).map(String::as_str);
            match suggest::nearest(&text, known) {
                Some(near) => error.help(format!("write `{near}`")),
                None => error.help(format!(
                    "declare `linear {text};`, `shape {text} in low .. high;`, `input {text};`, `state {text};` or `let {text} = ..;`"
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
        if self.inputs.iter().any(|(input, _)| *input == text) {
            return self.input(name, arguments, span, errors);
        }
        match text.as_str() {
            "dot" => return self.rate(arguments, span, errors),
            "min" | "max" => return self.extreme(name, arguments, span, errors),
            _ => {}
        }
        let Ok(function) = function(name) else {
            let functions = FUNCTIONS
                .iter()
                .map(|(name, _)| *name)
                .chain(["min", "max"]);
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

    /// `min(x, y)`, `max(x, y)`
    fn extreme(
        &self,
        name: &Ident,
        arguments: &[ast::Expr],
        span: Span,
        errors: &mut Errors,
    ) -> Option<EffectExpr> {
        let [x, y] = arguments else {
            errors.push(two_arguments(name, arguments.len(), span));
            return None;
        };
        let (x, y) = (self.resolve(x, errors), self.resolve(y, errors));
        let (x, y) = (Box::new(x?), Box::new(y?));
        Some(if name == "min" {
            Expr::Min(x, y)
        } else {
            Expr::Max(x, y)
        })
    }

    /// `dot(z)`
    fn rate(&self, arguments: &[ast::Expr], span: Span, errors: &mut Errors) -> Option<EffectExpr> {
        let state = argument_name(arguments);
        let rate = state.as_ref().and_then(|state| {
            let known = self.states.contains(&state.to_string());
            let name = rate_name(state);
            let found = self.bindings.iter().position(|binding| *binding == name);
            // A state without a rate is reported at the state.
            found.or(known.then_some(0))
        });
        if rate.is_none() {
            errors.push(
                Diagnostic::new(span, "`dot` is the rate of a state", "of which state?").help(
                    match self.states.as_slice() {
                        [] => "declare `state z;` and write `dot(z)`; of a joint write `dq(j)`"
                            .to_owned(),
                        states => format!("write {}", one_of("dot", states)),
                    },
                ),
            );
        }
        rate.map(|rate| Expr::Leaf(EffectLeaf::Binding(rate)))
    }

    /// `current(j)`
    fn input(
        &self,
        name: &Ident,
        arguments: &[ast::Expr],
        span: Span,
        errors: &mut Errors,
    ) -> Option<EffectExpr> {
        let joint = argument_name(arguments).map(Ident::to_string);
        let joint = joint.and_then(|joint| self.joints.iter().position(|formal| *formal == joint));
        let same_name = |(input, _): &&(String, Option<usize>)| name == input;
        if self
            .inputs
            .iter()
            .filter(same_name)
            .all(|(_, joint)| joint.is_none())
        {
            errors.push(
                Diagnostic::new(
                    span,
                    format!("input `{name}` is one column for all joints"),
                    "declared without a joint",
                )
                .help(format!("write `{name}`, or declare `input {name}(j);`")),
            );
            return None;
        }
        let found = self
            .inputs
            .iter()
            .position(|(input, of)| name == input && of.is_some() && *of == joint);
        if found.is_none() {
            return self.joint_is_missing(name, errors);
        }
        found.map(|k| Expr::Leaf(EffectLeaf::Input(k)))
    }

    /// An input that is declared for certain joints, read without one of these.
    fn joint_is_missing(&self, name: &Ident, errors: &mut Errors) -> Option<EffectExpr> {
        let declared = self.inputs.iter().filter(|(input, _)| name == input);
        let joints: Vec<String> = declared
            .filter_map(|(_, joint)| joint.map(|joint| self.joints[joint].clone()))
            .collect();
        errors.push(
            Diagnostic::new(
                name.span(),
                format!("input `{name}` is a column of one joint"),
                "of which joint?",
            )
            .help(format!("write {}", one_of(&name.to_string(), &joints))),
        );
        None
    }

    fn signal(
        &self,
        name: &Ident,
        signal: Signal,
        arguments: &[ast::Expr],
        span: Span,
        errors: &mut Errors,
    ) -> Option<EffectExpr> {
        let joint = argument_name(arguments).map(Ident::to_string);
        let index = joint.and_then(|joint| self.joints.iter().position(|formal| *formal == joint));
        if index.is_none() {
            errors.push(
                Diagnostic::new(
                    span,
                    format!("`{name}` is a signal of one of the effect's joints"),
                    "of which joint?",
                )
                .help(format!("write {}", one_of(&name.to_string(), &self.joints))),
            );
        }
        index.map(|index| Expr::Leaf(EffectLeaf::Signal(signal, index)))
    }
}

/// The name that is the only argument.
fn argument_name(arguments: &[ast::Expr]) -> Option<&Ident> {
    match arguments {
        [
            ast::Expr {
                kind: ExprKind::Name(name),
                ..
            },
        ] => Some(name),
        _ => None,
    }
}

/// "`dq(j)` or `dq(k)`"
fn one_of(function: &str, arguments: &[String]) -> String {
    let calls = arguments
        .iter()
        .map(|argument| format!("`{function}({argument})`"));
    calls.collect::<Vec<_>>().join(" or ")
}

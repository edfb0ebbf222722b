//! Names of an energy's expression to coordinates, parameters, constants and bindings.

use syn::Ident;

use super::dimension::{Constants, Dimensions};
use crate::ast::{self, ExprKind};
use crate::check::{Errors, unit, value, words};
use crate::diagnostic::Diagnostic;
use crate::model::{EnergyExpr, EnergyLeaf, Expr};
use crate::suggest;

/// A constant of the spec: a number with a dimension, which may be unknown.
#[derive(Debug, Clone)]
pub(super) struct Constant {
    pub(super) name: String,
    pub(super) value: f64,
    pub(super) dimensions: Dimensions,
}

/// The names that an expression may use.
#[derive(Debug, Default)]
pub(super) struct Scope {
    pub(super) coordinates: Vec<String>,
    pub(super) parameters: Vec<String>,
    pub(super) constants: Vec<Constant>,
    pub(super) bindings: Vec<String>,
    /// Bindings that come later in the text.
    pub(super) later: Vec<String>,
}

/// An expression over indices, with the dimensions of its constants.
pub(super) struct Resolved {
    pub(super) value: EnergyExpr,
    pub(super) constants: Constants,
}

impl Scope {
    /// `None` behind an error.
    pub(super) fn resolve(&self, expr: &ast::Expr, errors: &mut Errors) -> Option<Resolved> {
        let mut resolution = Resolution {
            scope: self,
            constants: Constants::new(),
            path: Vec::new(),
            errors,
        };
        let value = resolution.resolve(expr)?;
        Some(Resolved {
            value,
            constants: resolution.constants,
        })
    }

    /// What a name stands for, in words.
    fn kind_of(&self, name: &Ident) -> Option<&'static str> {
        let among = |names: &[String]| names.iter().any(|known| name == known);
        if among(&self.coordinates) {
            Some("coordinate")
        } else if among(&self.parameters) {
            Some("parameter")
        } else if self.constants.iter().any(|c| *name == c.name) {
            Some("constant")
        } else if among(&self.bindings) || among(&self.later) {
            Some("`let`")
        } else {
            None
        }
    }

    fn all_names(&self) -> impl Iterator<Item = &str> {
        let constants = self.constants.iter().map(|constant| &constant.name);
        self.coordinates
            .iter()
            .chain(&self.parameters)
            .chain(constants)
            .chain(&self.bindings)
            .map(String::as_str)
    }
}

struct Resolution<'a> {
    scope: &'a Scope,
    constants: Constants,
    path: Vec<usize>,
    errors: &'a mut Errors,
}

impl Resolution<'_> {
    fn resolve(&mut self, expr: &ast::Expr) -> Option<EnergyExpr> {
        match &expr.kind {
            ExprKind::Number(value, None) => Some(Expr::Number(*value)),
            ExprKind::Number(value, Some(unit)) => {
                if let Some(kind) = self.scope.kind_of(&unit.name) {
                    let quantity = format!(
                        "for a quantity write `constants c = {value} {};` and its name",
                        unit.name
                    );
                    self.errors
                        .push(value::unit_or_name(expr, *value, unit, kind, &quantity));
                    return None;
                }
                let quantity = value::constant(expr)
                    .map_err(|error| self.errors.push(error))
                    .ok()?;
                let dimensions = quantity.dimension.map(Dimensions::of).unwrap_or_default();
                self.constants.insert(self.path.clone(), dimensions);
                Some(Expr::Number(quantity.value))
            }
            ExprKind::Name(name) => self.name(name),
            ExprKind::Call(name, arguments) if name == "dot" => self.rate(name, arguments),
            ExprKind::Call(name, arguments) => {
                let function = words::function(name)
                    .map_err(|error| self.errors.push(error))
                    .ok()?;
                let [argument] = arguments.as_slice() else {
                    self.errors
                        .push(words::one_argument(name, arguments.len(), expr.span));
                    return None;
                };
                let argument = self.operand(0, argument)?;
                Some(Expr::Call(function, Box::new(argument)))
            }
            ExprKind::Neg(x) => Some(Expr::Neg(Box::new(self.operand(0, x)?))),
            ExprKind::Binary(op, x, y) => {
                let (x, y) = (self.operand(0, x), self.operand(1, y));
                Some(Expr::Binary(*op, Box::new(x?), Box::new(y?)))
            }
            ExprKind::Choice(..) => {
                self.errors.push(
                    Diagnostic::new(expr.span, "an energy has no choices", "jumps or bends here")
                        .help("write one expression that holds everywhere"),
                );
                None
            }
        }
    }

    fn operand(&mut self, index: usize, expr: &ast::Expr) -> Option<EnergyExpr> {
        self.path.push(index);
        let operand = self.resolve(expr);
        self.path.pop();
        operand
    }

    fn name(&mut self, name: &Ident) -> Option<EnergyExpr> {
        let text = name.to_string();
        let find = |names: &[String]| names.iter().position(|known| *known == text);
        let leaf = find(&self.scope.coordinates)
            .map(EnergyLeaf::Coordinate)
            .or_else(|| find(&self.scope.parameters).map(EnergyLeaf::Parameter))
            .or_else(|| find(&self.scope.bindings).map(EnergyLeaf::Binding));
        if let Some(leaf) = leaf {
            return Some(Expr::Leaf(leaf));
        }
        if let Some(constant) = self.scope.constants.iter().find(|c| c.name == text) {
            self.constants
                .insert(self.path.clone(), constant.dimensions.clone());
            return Some(Expr::Number(constant.value));
        }
        if text == "pi" {
            return Some(Expr::Number(std::f64::consts::PI));
        }
        let error = Diagnostic::new(
            name.span(),
            format!("unknown name `{text}`"),
            "declared nowhere",
        );
        self.errors.push(if self.scope.later.contains(&text) {
            error.help(format!(
                "`{text}` is bound further down; move its `let` up here"
            ))
        } else {
            match suggest::nearest(&text, self.scope.all_names()) {
                _ if unit::find(&text).is_some() => error.help(format!(
                    "`{text}` is a unit: of `1 m/s` only the first belongs to the number in an expression, so write `constants v = 1 m/s;` \
                     and the name of that; otherwise declare it: `parameters {text};` or `constants {text} = ..;`"
                )),
                Some(near) => error.help(format!("write `{near}`")),
                None => error.help(format!(
                    "declare it: `parameters {text};` if it is unknown, `constants {text} = ..;` if it is known, or `let {text} = ..;`"
                )),
            }
        });
        None
    }

    /// `dot(x)` of a coordinate or a binding.
    fn rate(&mut self, dot: &Ident, arguments: &[ast::Expr]) -> Option<EnergyExpr> {
        if let [
            ast::Expr {
                kind: ExprKind::Name(name),
                ..
            },
        ] = arguments
        {
            let text = name.to_string();
            let find = |names: &[String]| names.iter().position(|known| *known == text);
            if let Some(k) = find(&self.scope.coordinates) {
                return Some(Expr::Leaf(EnergyLeaf::Rate(k)));
            }
            if let Some(k) = find(&self.scope.bindings) {
                return Some(Expr::Leaf(EnergyLeaf::BindingRate(k)));
            }
        }
        let place = arguments.first().map_or(dot.span(), |x| x.span);
        self.errors.push(
            Diagnostic::new(
                place,
                "`dot` takes the name of a coordinate or of a `let`",
                "no such name",
            )
            .help("bind the expression first: `let x = ..;`, then write `dot(x)`"),
        );
        None
    }
}

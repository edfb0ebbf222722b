//! `let` bindings and rates of states in the order in which they depend on each other.

use std::collections::BTreeMap;

use syn::Ident;

use super::{Errors, check_unique};
use crate::ast::{Effect, Equation, Expr, ExprKind, Let};
use crate::diagnostic::Diagnostic;
use crate::suggest;

/// Something that equations name.
#[derive(Clone, Copy)]
pub(super) enum Part<'a> {
    /// `let name = ..;`
    Let(&'a Let),
    /// `dot(z) = ..;`
    Rate(&'a Equation),
}

impl<'a> Part<'a> {
    /// `name`, or `dot(z)`.
    pub(super) fn name(&self) -> String {
        match self {
            Self::Let(binding) => binding.name.to_string(),
            Self::Rate(rate) => rate_name(&rate.of),
        }
    }

    pub(super) fn value(&self) -> &'a Expr {
        match self {
            Self::Let(binding) => &binding.value,
            Self::Rate(rate) => &rate.value,
        }
    }

    /// Where it is named.
    pub(super) fn ident(&self) -> &'a Ident {
        match self {
            Self::Let(binding) => &binding.name,
            Self::Rate(rate) => &rate.of,
        }
    }
}

/// How a rate is called among the bindings.
pub(super) fn rate_name(state: &Ident) -> String {
    format!("dot({state})")
}

/// Bindings and rates, each behind those that it uses. What depends on itself is reported, and comes last.
pub(super) fn in_order<'a>(effect: &'a Effect, errors: &mut Errors) -> Vec<Part<'a>> {
    check_rates(effect, errors);
    let lets = effect.lets.iter().map(Part::Let);
    let parts: Vec<Part> = lets.chain(effect.rates.iter().map(Part::Rate)).collect();
    let place: BTreeMap<String, usize> = (0..).zip(&parts).map(|(k, p)| (p.name(), k)).collect();
    let mut waits_for: Vec<Vec<usize>> = parts
        .iter()
        .map(|part| {
            let mut used = Vec::new();
            each_name(part.value(), &mut |name| used.extend(place.get(name)));
            used
        })
        .collect();

    let mut order = Vec::new();
    let mut done = vec![false; parts.len()];
    while order.len() < parts.len() {
        let ready = (0..parts.len()).find(|&k| !done[k] && waits_for[k].is_empty());
        let Some(ready) = ready else {
            errors.push(cycle(&parts, &waits_for, &done));
            // Their names stay known, so that no equation is told that they are not.
            order.extend((0..parts.len()).filter(|&k| !done[k]).map(|k| parts[k]));
            break;
        };
        done[ready] = true;
        order.push(parts[ready]);
        for waiting in &mut waits_for {
            waiting.retain(|&other| other != ready);
        }
    }
    order
}

/// Rates are those of states, one each.
fn check_rates(effect: &Effect, errors: &mut Errors) {
    check_unique(effect.rates.iter().map(|rate| &rate.of), "rate of", errors);
    for rate in &effect.rates {
        let name = rate.of.to_string();
        if effect.states.iter().any(|state| state.name == rate.of) {
            continue;
        }
        let known: Vec<String> = effect.states.iter().map(|s| s.name.to_string()).collect();
        let near = suggest::nearest(&name, known.iter().map(String::as_str));
        errors.push(
            Diagnostic::new(
                rate.of.span(),
                format!("the effect has no state `{name}`"),
                "not a state",
            )
            .help(near.map_or_else(
                || format!("declare `state {name};`"),
                |near| format!("write `{near}`"),
            )),
        );
    }
}

/// Follows what waits for what until something comes again.
fn cycle(parts: &[Part<'_>], waits_for: &[Vec<usize>], done: &[bool]) -> Diagnostic {
    let first = done.iter().position(|done| !done).unwrap_or_default();
    let mut path = vec![first];
    let start = loop {
        let next = waits_for[path[path.len() - 1]][0];
        if let Some(start) = path.iter().position(|&k| k == next) {
            break start;
        }
        path.push(next);
    };
    let path = &path[start..];
    let names: Vec<String> = path
        .iter()
        .chain(&path[..1])
        .map(|&k| format!("`{}`", parts[k].name()))
        .collect();
    Diagnostic::new(
        parts[path[0]].ident().span(),
        format!("`{}` is defined by itself", parts[path[0]].name()),
        names.join(" needs "),
    )
    .help("write one without the other; use a `state` for a memory of the past")
}

/// Every name in an expression; `dot(z)` is one.
fn each_name(expr: &Expr, f: &mut dyn FnMut(&str)) {
    match &expr.kind {
        ExprKind::Number(..) => {}
        ExprKind::Name(name) => f(&name.to_string()),
        ExprKind::Call(function, arguments) => {
            if let ("dot", Some(ExprKind::Name(state))) = (
                function.to_string().as_str(),
                arguments.first().map(|a| &a.kind),
            ) {
                f(&rate_name(state));
            }
            for argument in arguments {
                each_name(argument, f);
            }
        }
        ExprKind::Neg(x) => each_name(x, f),
        ExprKind::Binary(_, x, y) => {
            each_name(x, f);
            each_name(y, f);
        }
        ExprKind::Choice(condition, x, y) => {
            for part in [&condition.greater, &condition.smaller, x, y] {
                each_name(part, f);
            }
        }
    }
}

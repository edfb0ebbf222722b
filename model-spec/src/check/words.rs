//! The words of equations: functions, signals, and names that are taken.

use proc_macro2::Span;
use syn::Ident;

use crate::diagnostic::Diagnostic;
use crate::model::{Function, Signal};
use crate::suggest;

/// Names of the functions.
pub(super) const FUNCTIONS: [(&str, Function); 7] = [
    ("sin", Function::Sin),
    ("cos", Function::Cos),
    ("exp", Function::Exp),
    ("sqrt", Function::Sqrt),
    ("abs", Function::Abs),
    ("sign", Function::Sign),
    ("tanh", Function::Tanh),
];

/// Names of the signals.
pub(super) const SIGNALS: [(&str, Signal); 5] = [
    ("q", Signal::Position),
    ("dq", Signal::Velocity),
    ("ddq", Signal::Acceleration),
    ("rigid_torque", Signal::RigidTorque),
    ("measured_torque", Signal::MeasuredTorque),
];

/// Words with a meaning of their own, besides functions and signals; words that only begin a statement may be names.
const WORDS: [&str; 17] = [
    "pi", "time", "torque", "tau", "linear", "shape", "input", "state", "let", "dot", "if", "else",
    "min", "max", "step", "in", "on",
];

/// Words that no name of an equation may take.
pub(super) fn reserved() -> impl Iterator<Item = &'static str> {
    let signals = SIGNALS.iter().map(|(name, _)| *name);
    let functions = FUNCTIONS.iter().map(|(name, _)| *name);
    WORDS.into_iter().chain(signals).chain(functions)
}

/// A name that is a word of the language.
pub(super) fn reserved_name(name: &Ident, words: impl Iterator<Item = &'static str>) -> Diagnostic {
    let words: Vec<&str> = words.collect();
    Diagnostic::new(
        name.span(),
        format!("`{name}` has a meaning in the language"),
        "reserved",
    )
    .help(format!(
        "choose another name; taken are {}",
        words.join(", ")
    ))
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

/// `min` or `max` with other than two arguments.
pub(super) fn two_arguments(name: &Ident, count: usize, span: Span) -> Diagnostic {
    Diagnostic::new(
        span,
        format!("`{name}` takes two arguments, found {count}"),
        "",
    )
    .help(format!("write `{name}(x, y)`"))
}

#[cfg(test)]
mod tests {
    use super::reserved;

    #[test]
    fn the_reference_lists_the_reserved_words() {
        let reference = include_str!("../../LANGUAGE.md");
        let words: Vec<String> = reserved().map(|word| format!("`{word}`")).collect();
        assert!(reference.contains(&words.join(" ")), "{}", words.join(" "));
    }
}

//! A word that is to be the unit of a column, and is none.

use super::super::unit::{self, Dimension, UNITS};
use crate::ast::{ExprKind, LogColumn};
use crate::diagnostic::Diagnostic;
use crate::suggest;

/// Parts and multiples in front of a unit.
const PREFIXES: [(&str, &str); 6] = [
    ("k", "1e3"),
    ("c", "1e-2"),
    ("m", "1e-3"),
    ("u", "1e-6"),
    ("\u{b5}", "1e-6"),
    ("\u{3bc}", "1e-6"),
];

/// Units by other words.
const OTHERS: [(&str, &str); 10] = [
    ("grad", "deg"),
    ("degree", "deg"),
    ("degrees", "deg"),
    ("radian", "rad"),
    ("radians", "rad"),
    ("sec", "s"),
    ("msec", "ms"),
    ("turn", "rev"),
    ("turns", "rev"),
    ("RPM", "rpm"),
];

/// Refuses a unit that is a word and none of the units, with the nearest of those that the channel's columns may have.
pub(super) fn check(column: &LogColumn, wanted: &[Dimension]) -> Result<(), Diagnostic> {
    let Some(ExprKind::Name(name)) = column.unit.as_ref().map(|unit| &unit.kind) else {
        return Ok(());
    };
    let word = name.to_string();
    if word == "pi" || unit::find(&word).is_some() {
        return Ok(());
    }
    let is_wanted = |word: &str| {
        UNITS
            .iter()
            .any(|(own, _, of)| *own == word && wanted.contains(of))
    };
    let mut known: Vec<&str> = Vec::new();
    for unit in wanted.iter().flat_map(|kind| kind.unit_words()) {
        if !known.contains(&unit) {
            known.push(unit);
        }
    }
    if known.is_empty() {
        return Ok(());
    }
    let scaled = PREFIXES.iter().find_map(|(prefix, factor)| {
        let rest = word.strip_prefix(prefix)?;
        is_wanted(rest).then(|| format!("{factor} {rest}"))
    });
    let other = OTHERS
        .iter()
        .find(|(own, meant)| *own == word && is_wanted(meant));
    let nearest = || suggest::nearest(&word, known.iter().copied()).map(str::to_owned);
    let meant = scaled.or_else(|| other.map(|(_, meant)| (*meant).to_owned()));
    let list = suggest::list(known.iter().copied());
    let help = match meant.or_else(nearest) {
        Some(meant) => {
            format!("write `{meant}`; allowed units are {list}, and numbers times these")
        }
        None => format!("write one of {list}, or a number times one of these"),
    };
    Err(Diagnostic::new(name.span(), format!("unknown unit `{word}`"), "not a unit").help(help))
}

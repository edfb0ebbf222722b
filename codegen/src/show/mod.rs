//! Equations for people: one entry an equation, the user's names, fixed order of terms, zeros said once.
//!
//! Small expressions are multiplied out into sums of products. Where that gives more than
//! [`MOST_TERMS`](polynomial::MOST_TERMS) terms, intermediate results get names, as in the emitted code.

pub mod polynomial;

use std::collections::HashMap;
use std::fmt::Write as _;

use polynomial::SignedTerm;

use crate::compiled::Compiled;
use crate::emit::rust::{self, body, names::Namer};
use crate::expr::{ExprId, Names, Style};
use crate::regressor::LinearForm;

/// Lines longer than this are broken between terms.
const WIDTH: usize = 110;
/// Room that a single term is broken ahead of the end of a line.
const FOLD_AHEAD: usize = 30;

/// A form of the equations.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum What {
    /// `M(q)`
    MassMatrix,
    /// `C(q, dq)`
    CoriolisMatrix,
    /// `G(q)`
    Gravity,
    /// `tau(q, dq, ddq)`
    InverseDynamics,
    /// `Y`
    Regressor,
    /// `Y_b`
    BaseRegressor,
    /// How base parameters are made of standard ones.
    BaseParameters,
    /// Operations of the emitted functions.
    Cost,
}

impl What {
    /// All forms that a whole description shows, in its order.
    pub const WHOLE: [Self; 6] = [
        Self::MassMatrix,
        Self::CoriolisMatrix,
        Self::Gravity,
        Self::BaseParameters,
        Self::BaseRegressor,
        Self::Cost,
    ];
}

/// The whole description: a headline and the forms of [`What::WHOLE`].
#[must_use]
pub fn whole(compiled: &Compiled, style: Style) -> String {
    let mut text = headline(compiled, style);
    for what in What::WHOLE {
        text.push('\n');
        text.push_str(&form(compiled, what, style));
    }
    text
}

fn headline(compiled: &Compiled, style: Style) -> String {
    let comment = if style == Style::Latex { "% " } else { "" };
    let unseen = compiled.base.unidentifiable.len();
    format!(
        "{comment}robot {}     {} joints; standard {} ({unseen} without influence); base {}\n",
        compiled.model.name,
        compiled.dof(),
        compiled.standard.len(),
        compiled.base.kept.len(),
    )
}

/// One form, a line or more an entry.
#[must_use]
pub fn form(compiled: &Compiled, what: What, style: Style) -> String {
    let dof = compiled.dof();
    let dynamics = &compiled.dynamics;
    let vector = |stem: &str, entries: &[ExprId]| -> Vec<Entry> {
        entries
            .iter()
            .enumerate()
            .map(|(k, &value)| Entry::new(format!("{stem}[{}]", k + 1), value))
            .collect()
    };
    let column = |form: &LinearForm, stem: &str, k: usize, name: &str| -> Vec<Entry> {
        let rows = form.regressor.iter().enumerate();
        rows.map(|(joint, row)| Entry::new(format!("{stem}[{},{name}]", joint + 1), row[k]))
            .collect()
    };
    let entries: Vec<Entry> = match what {
        What::MassMatrix => (0..dof)
            .flat_map(|i| (i..dof).map(move |j| (i, j)))
            .map(|(i, j)| {
                let mut entry = Entry::new(
                    format!("M[{},{}]", i + 1, j + 1),
                    dynamics.mass_matrix[i][j],
                );
                entry.note = (i != j).then(|| format!("(= M[{},{}])", j + 1, i + 1));
                entry
            })
            .collect(),
        What::CoriolisMatrix => (0..dof)
            .flat_map(|i| (0..dof).map(move |j| (i, j)))
            .map(|(i, j)| {
                Entry::new(
                    format!("C[{},{}]", i + 1, j + 1),
                    dynamics.coriolis_matrix[i][j],
                )
            })
            .collect(),
        What::Gravity => vector("G", &dynamics.gravity),
        What::InverseDynamics => vector("tau", &dynamics.inverse_dynamics),
        What::Regressor => compiled
            .standard
            .iter()
            .enumerate()
            .flat_map(|(k, parameter)| column(&compiled.linear, "Y", k, &parameter.name))
            .collect(),
        What::BaseRegressor => {
            let kept = compiled.base.kept.iter().zip(&compiled.base.names);
            kept.flat_map(|(&k, name)| column(&compiled.candidates, "Y_b", k, name))
                .collect()
        }
        What::BaseParameters => return base_parameters(compiled, style),
        What::Cost => return cost(compiled, style),
    };
    equations(compiled, &entries, style)
}

/// The left-hand side of an equation, what it is, and a remark.
struct Entry {
    name: String,
    value: ExprId,
    note: Option<String>,
}

impl Entry {
    fn new(name: String, value: ExprId) -> Self {
        Self {
            name,
            value,
            note: None,
        }
    }
}

fn equations(compiled: &Compiled, entries: &[Entry], style: Style) -> String {
    let names = compiled.names();
    let mut dag = compiled.dag.clone();
    let mut lines: Vec<(String, Vec<SignedTerm>, Option<&String>)> = Vec::new();
    let mut zeros = Vec::new();
    for entry in entries {
        if dag.is_zero(entry.value) {
            zeros.push(entry.name.as_str());
            continue;
        }
        let Some(polynomial) = polynomial::expand(&mut dag, entry.value, &names) else {
            return with_intermediate_names(compiled, entries, &names, style);
        };
        let terms = polynomial::terms(&dag, &polynomial, &names, style);
        if terms.is_empty() {
            zeros.push(entry.name.as_str());
        } else {
            lines.push((left(&entry.name, style), terms, entry.note.as_ref()));
        }
    }
    let width = lines.iter().map(|line| line.0.len()).max().unwrap_or(0);
    let mut text = String::new();
    for (name, terms, note) in lines {
        text.push_str(&equation(&name, &terms, note, width, style));
    }
    text.push_str(&zeros_once(&zeros, style));
    text
}

/// One equation; a line of its own per term where the whole is too long.
fn equation(
    name: &str,
    terms: &[SignedTerm],
    note: Option<&String>,
    width: usize,
    style: Style,
) -> String {
    let signed = |k: usize, (negative, term): &SignedTerm| match (k, negative) {
        (0, false) => term.clone(),
        (0, true) => format!("-{term}"),
        (_, false) => format!("+ {term}"),
        (_, true) => format!("- {term}"),
    };
    let terms: Vec<String> = terms
        .iter()
        .enumerate()
        .map(|(k, term)| signed(k, term))
        .collect();
    let one_line = terms.join(" ");
    let broken = width.max(name.len()) + 3 + one_line.len() > WIDTH;
    let indent = width.max(name.len()) + 3;
    let right = match (style, broken) {
        (_, false) => one_line,
        (Style::Text, true) => terms
            .iter()
            .map(|term| folded(term, indent))
            .collect::<Vec<_>>()
            .join(&format!("\n{:indent$}", "")),
        (Style::Latex, true) => terms.join(" \\\\\n  &\\quad "),
    };
    match style {
        Style::Text => {
            let note = note.map_or(String::new(), |note| format!("    {note}"));
            format!("{name:width$} = {right}{note}\n")
        }
        Style::Latex => format!("{name} &= {right} \\\\\n"),
    }
}

/// One term, broken before an operator where it is too long for a line; further lines are indented below the first.
fn folded(term: &str, indent: usize) -> String {
    let mut text = String::new();
    let mut length = indent;
    for word in term.split_inclusive(' ') {
        let operator = matches!(word, "+ " | "- ");
        if operator && length > WIDTH - FOLD_AHEAD {
            text.truncate(text.trim_end().len());
            let _ = write!(text, "\n{:indent$}    ", "");
            length = indent + 4;
        }
        text.push_str(word);
        length += word.len();
    }
    text
}

fn left(name: &str, style: Style) -> String {
    match style {
        Style::Text => name.to_owned(),
        Style::Latex => match name.trim_end_matches(']').split_once('[') {
            Some((stem, index)) => {
                let stem = if stem == "tau" { "\\tau" } else { stem };
                let stem = stem.replace("Y_b", "Y^{b}");
                let index = match index.split_once(',') {
                    Some((row, column)) if column.contains('.') => {
                        format!("{row},\\mathrm{{{}}}", column.replace('_', "\\_"))
                    }
                    _ => index.to_owned(),
                };
                format!("{stem}_{{{index}}}")
            }
            None => name.to_owned(),
        },
    }
}

fn zeros_once(zeros: &[&str], style: Style) -> String {
    if zeros.is_empty() {
        return String::new();
    }
    let names: Vec<String> = zeros.iter().map(|name| left(name, style)).collect();
    match style {
        Style::Latex => format!("{} &= 0 \\\\\n", names.join(" = ")),
        Style::Text => {
            let mut text = String::from("zero  ");
            let mut length = text.len();
            for name in names {
                if length + name.len() + 1 > WIDTH {
                    text.push_str("\n      ");
                    length = 6;
                }
                let _ = write!(text, " {name}");
                length += name.len() + 1;
            }
            text + "\n"
        }
    }
}

/// Names for shared parts first, then the entries.
fn with_intermediate_names(
    compiled: &Compiled,
    entries: &[Entry],
    names: &Names,
    style: Style,
) -> String {
    let dag = &compiled.dag;
    let outputs: Vec<ExprId> = entries.iter().map(|entry| entry.value).collect();
    let order = dag.reachable(&outputs);
    let named = body::named_expressions(dag, &order, &outputs);
    let mut namer = Namer::new(dag, names);
    let mut given: HashMap<ExprId, String> = HashMap::new();
    let mut text = String::new();
    for x in order.into_iter().filter(|x| named[x.index()]) {
        let name = match style {
            Style::Text => namer.name(x),
            Style::Latex => format!("\\mathrm{{{}}}", namer.name(x).replace('_', "\\_")),
        };
        let terms = dag.terms(x, names, style, &|part| given.get(&part).cloned());
        text.push_str(&equation(&name, &terms, None, 0, style));
        given.insert(x, name);
    }
    let mut zeros = Vec::new();
    for entry in entries {
        if dag.is_zero(entry.value) {
            zeros.push(entry.name.as_str());
            continue;
        }
        let terms = match given.get(&entry.value) {
            Some(name) => vec![(false, name.clone())],
            None => dag.terms(entry.value, names, style, &|part| given.get(&part).cloned()),
        };
        text.push_str(&equation(
            &left(&entry.name, style),
            &terms,
            entry.note.as_ref(),
            0,
            style,
        ));
    }
    text + &zeros_once(&zeros, style)
}

fn base_parameters(compiled: &Compiled, style: Style) -> String {
    let plain = |name: &str| match style {
        Style::Text => name.to_owned(),
        Style::Latex => format!("\\mathrm{{{}}}", name.replace('_', "\\_")),
    };
    let width = compiled
        .base
        .names
        .iter()
        .map(String::len)
        .max()
        .unwrap_or(0);
    let mut text = String::new();
    for (name, combination) in compiled.base.names.iter().zip(&compiled.base.combinations) {
        if style == Style::Text && combination.len() == 1 {
            let _ = writeln!(text, "{name}");
            continue;
        }
        let terms: Vec<SignedTerm> = combination
            .iter()
            .map(|&(k, coefficient)| {
                let number = crate::expr::number(coefficient.abs());
                let number = if number == "1" {
                    String::new()
                } else {
                    number + " "
                };
                (
                    coefficient < 0.0,
                    number + &plain(&compiled.standard[k].name),
                )
            })
            .collect();
        text.push_str(&equation(&plain(name), &terms, None, width, style));
    }
    for (title, indices) in [
        ("no influence", &compiled.base.unidentifiable),
        ("fixed", &compiled.base.fixed),
    ] {
        if style == Style::Text && !indices.is_empty() {
            let names: Vec<&str> = indices
                .iter()
                .map(|&k| compiled.standard[k].name.as_str())
                .collect();
            let _ = writeln!(text, "{title}: {}", names.join(", "));
        }
    }
    text
}

fn cost(compiled: &Compiled, style: Style) -> String {
    let comment = if style == Style::Latex { "% " } else { "" };
    let mut text = String::new();
    for (name, cost) in rust::costs(compiled) {
        let _ = writeln!(text, "{comment}cost   {name}: {cost}");
    }
    text
}

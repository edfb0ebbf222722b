//! Equations for people: one entry an equation, the user's names, fixed order of terms, zeros said once.
//!
//! Small expressions are multiplied out into sums of products. Where that gives more than
//! [`MOST_TERMS`](polynomial::MOST_TERMS) terms, intermediate results get names, as in the emitted code.

mod document;
mod effect;
mod entries;
pub mod polynomial;

use std::collections::HashMap;
use std::fmt::Write as _;

pub use document::document;
pub use effect::{Equation, effect_equations};
use entries::{Entry, left};
use polynomial::SignedTerm;

use crate::compiled::Compiled;
use crate::emit::{self, names::Namer, schedule};
use crate::expr::{Dag, ExprId, Names, Style};

/// Lines longer than this are broken between terms.
const WIDTH: usize = 110;
/// Room that a single term is broken ahead of the end of a line.
const FOLD_AHEAD: usize = 30;

/// So many zeros stand on a line of LaTeX.
const ZEROS_A_LINE: usize = 6;

/// A form of the equations.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum What {
    /// `M(q)`
    MassMatrix,
    /// `C(q, dq)`
    CoriolisMatrix,
    /// `G(q)`
    Gravity,
    /// `C dq + G`
    Bias,
    /// `tau(q, dq, ddq)`
    InverseDynamics,
    /// `A` and `b` of `A(q) ddq = tau - b(q, dq)`
    ForwardDynamics,
    /// `d tau / dq` and `d tau / d dq`
    Slopes,
    /// `Y`
    Regressor,
    /// `Y_b`
    BaseRegressor,
    /// `Y_p` and `Y_h` of `Y_L = w (Y_p - L{Y_p}) - L{Y_h}`, in standard parameters.
    FilteredRegressor,
    /// The same in base parameters.
    BaseFilteredRegressor,
    /// `T` and `V`
    Energies,
    /// Poses of the links, or positions of the points.
    ForwardKinematics,
    /// Slopes of the tip's pose, or of the points' positions.
    Jacobian,
    /// Rates of the effects' internal states; nothing for effects without memory.
    StateRates,
    /// Where links stand that are not at `q`, and by how much torques are late; nothing for most arms.
    Measurement,
    /// How base parameters are made of standard ones.
    BaseParameters,
    /// Operations of the emitted functions.
    Cost,
}

impl What {
    /// Every form.
    pub const ALL: [Self; 18] = [
        Self::MassMatrix,
        Self::CoriolisMatrix,
        Self::Gravity,
        Self::Bias,
        Self::InverseDynamics,
        Self::ForwardDynamics,
        Self::Slopes,
        Self::Regressor,
        Self::BaseRegressor,
        Self::FilteredRegressor,
        Self::BaseFilteredRegressor,
        Self::Energies,
        Self::ForwardKinematics,
        Self::Jacobian,
        Self::StateRates,
        Self::Measurement,
        Self::BaseParameters,
        Self::Cost,
    ];

    /// All forms that a whole description shows, in its order.
    pub const WHOLE: [Self; 9] = [
        Self::Measurement,
        Self::StateRates,
        Self::MassMatrix,
        Self::CoriolisMatrix,
        Self::Gravity,
        Self::Energies,
        Self::BaseParameters,
        Self::BaseRegressor,
        Self::Cost,
    ];
}

/// The whole description as text: a headline and the forms of [`What::WHOLE`]. In LaTeX it is a [`document`].
#[must_use]
pub fn whole(compiled: &Compiled) -> String {
    let unseen = compiled.base.unidentifiable.len();
    let mut text = format!(
        "robot {}     {} joints; standard {} ({unseen} without influence); base {}\n",
        compiled.model.name,
        compiled.dof(),
        compiled.standard.len(),
        compiled.base.kept.len(),
    );
    for what in What::WHOLE {
        let form = form(compiled, what, Style::Text);
        if !form.is_empty() {
            text.push('\n');
            text.push_str(&form);
        }
    }
    text
}

/// One form, a line or more an entry.
#[must_use]
pub fn form(compiled: &Compiled, what: What, style: Style) -> String {
    match what {
        What::BaseParameters => base_parameters(compiled, style),
        What::Cost => cost(compiled, style),
        What::FilteredRegressor | What::BaseFilteredRegressor => {
            equations(compiled, what, style) + &refused(compiled, what, style)
        }
        _ => equations(compiled, what, style),
    }
}

/// Parameters without a momentum form, with the reason.
fn refused(compiled: &Compiled, what: What, style: Style) -> String {
    let comment = if style == Style::Latex { "% " } else { "" };
    let mut text = String::new();
    for refusal in &compiled.momentum.refused {
        let kept = compiled.base.kept.contains(&refusal.parameter);
        if kept || what == What::FilteredRegressor {
            let name = &compiled.standard[refusal.parameter].name;
            let _ = writeln!(
                text,
                "{comment}no filtered form: {name}, as {}",
                refusal.reason
            );
        }
    }
    text
}

fn equations(compiled: &Compiled, what: What, style: Style) -> String {
    let names = compiled.names();
    let mut dag = compiled.dag.clone();
    let entries = &entries::entries(compiled, &mut dag, what);
    let mut lines: Vec<(String, Vec<SignedTerm>, Option<&String>)> = Vec::new();
    let mut zeros = Vec::new();
    for entry in entries {
        if dag.is_zero(entry.value) {
            zeros.push(entry.name.as_str());
            continue;
        }
        let Some(polynomial) = polynomial::expand(&mut dag, entry.value, &names) else {
            return with_intermediate_names(&dag, entries, &names, style);
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

fn zeros_once(zeros: &[&str], style: Style) -> String {
    if zeros.is_empty() {
        return String::new();
    }
    let names: Vec<String> = zeros.iter().map(|name| left(name, style)).collect();
    match style {
        Style::Latex => {
            let mut text = String::new();
            for names in names.chunks(ZEROS_A_LINE) {
                let _ = writeln!(text, "{} &= 0 \\\\", names.join(" = "));
            }
            text
        }
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
fn with_intermediate_names(dag: &Dag, entries: &[Entry], names: &Names, style: Style) -> String {
    let outputs: Vec<ExprId> = entries.iter().map(|entry| entry.value).collect();
    let order = dag.reachable(&outputs);
    let named = schedule::named_expressions(dag, &order, &outputs);
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
    for (name, cost) in emit::costs(compiled) {
        let _ = writeln!(text, "{comment}cost   {name}: {cost}");
    }
    text
}

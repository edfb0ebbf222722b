//! Equations laid out: one entry a line, one term a line where that is too long, zeros said once.

use robot_model_codegen::Compiled;
use robot_model_codegen::expr::{Dag, ExprId, Names, Node, Style};

use super::shared::share;

/// Lines longer than this are broken at their terms.
const LINE: usize = 100;

/// One entry of a matrix or vector.
pub(super) struct Entry {
    pub symbol: &'static str,
    /// Its indices.
    pub place: Vec<String>,
    /// Indices of the entry that is equal to it.
    pub mirrored: Option<Vec<String>>,
    pub value: ExprId,
}

/// The entries of one form.
pub(super) struct Page<'a> {
    pub dag: &'a Dag,
    pub names: Names,
    pub entries: Vec<Entry>,
}

impl Page<'_> {
    /// Shared parts first, then the entries, then what is zero.
    pub(super) fn render(&self, style: Style) -> String {
        let (zero, entries): (Vec<&Entry>, Vec<&Entry>) = self
            .entries
            .iter()
            .partition(|entry| self.dag.is_zero(entry.value));
        let roots: Vec<ExprId> = entries.iter().map(|entry| entry.value).collect();
        let shared = share(self.dag, &self.names, &roots);

        let mut lines = Vec::new();
        for (name, part) in &shared.parts {
            let left = if style == Style::Latex {
                format!("\\mathrm{{{name}}}")
            } else {
                name.clone()
            };
            lines.extend(equation(&left, &shared.dag, *part, &shared.names, style));
        }
        for (entry, &value) in entries.iter().zip(&shared.roots) {
            let mut equation =
                equation(&entry.left(style), &shared.dag, value, &shared.names, style);
            if let (Some(mirrored), Some(last)) = (&entry.mirrored, equation.last_mut()) {
                let mirrored = indexed(entry.symbol, mirrored, style);
                *last = match style {
                    Style::Text => format!("{last}    (= {mirrored})"),
                    Style::Latex => format!("{last} = {mirrored}"),
                };
            }
            lines.extend(equation);
        }
        if !zero.is_empty() {
            let left: Vec<String> = zero.iter().map(|entry| entry.left(style)).collect();
            match style {
                Style::Text => lines.extend(wrapped(&left, " = 0")),
                Style::Latex => lines.push(format!("{} &= 0", left.join(" = "))),
            }
        }
        finish(&lines, style)
    }
}

impl Entry {
    fn left(&self, style: Style) -> String {
        indexed(self.symbol, &self.place, style)
    }
}

/// `M[1,2]`, or `M_{1,2}`.
fn indexed(symbol: &str, place: &[String], style: Style) -> String {
    match style {
        Style::Text => format!("{symbol}[{}]", place.join(",")),
        Style::Latex => {
            let indices: Vec<String> = place.iter().map(|index| latex_name(index)).collect();
            let (symbol, mark) = match symbol {
                "tau" => ("\\tau", ""),
                "Y_b" => ("Y", "\\mathrm{b},"),
                other => (other, ""),
            };
            format!("{symbol}_{{{mark}{}}}", indices.join(","))
        }
    }
}

fn latex_name(name: &str) -> String {
    if name.bytes().all(|byte| byte.is_ascii_digit()) {
        name.to_owned()
    } else {
        format!("\\mathrm{{{}}}", name.replace('_', "\\_"))
    }
}

/// `left = value`, broken at the terms of a long sum.
fn equation(left: &str, dag: &Dag, value: ExprId, names: &Names, style: Style) -> Vec<String> {
    let equals = if style == Style::Latex { " &= " } else { " = " };
    let line = format!("{left}{equals}{}", dag.display(value, names, style));
    if line.chars().count() <= LINE || style == Style::Latex {
        return vec![line];
    }
    let mut terms = Vec::new();
    collect_terms(dag, value, &mut terms);
    let indent = " ".repeat(left.chars().count() + 1);
    let shown = terms.iter().map(|&term| dag.display(term, names, style));
    shown
        .enumerate()
        .map(|(k, term)| match (k, term.strip_prefix('-')) {
            (0, _) => format!("{left}{equals}{term}"),
            (_, Some(positive)) => format!("{indent}- {positive}"),
            (_, None) => format!("{indent}+ {term}"),
        })
        .collect()
}

fn collect_terms(dag: &Dag, x: ExprId, terms: &mut Vec<ExprId>) {
    if let Node::Add(left, right) = dag.node(x) {
        collect_terms(dag, left, terms);
        collect_terms(dag, right, terms);
    } else {
        terms.push(x);
    }
}

/// `a = b = .. = 0` over as many lines as it takes.
fn wrapped(left: &[String], end: &str) -> Vec<String> {
    let mut lines: Vec<String> = Vec::new();
    for name in left {
        match lines.last_mut() {
            Some(line) if line.len() + name.len() + 3 + end.len() <= LINE => {
                line.push_str(" = ");
                line.push_str(name);
            }
            _ => lines.push(name.clone()),
        }
    }
    lines.iter().map(|line| format!("{line}{end}")).collect()
}

fn finish(lines: &[String], style: Style) -> String {
    match style {
        Style::Text => lines.join("\n") + "\n",
        Style::Latex => format!(
            "\\begin{{aligned}}\n{}\n\\end{{aligned}}\n",
            lines.join(" \\\\\n")
        ),
    }
}

/// How base parameters are made of standard ones, and which standard ones have no part in it.
pub(super) fn base_parameters(compiled: &Compiled, style: Style) -> String {
    let base = &compiled.base;
    let name = |k: usize| match style {
        Style::Text => compiled.standard[k].name.clone(),
        Style::Latex => latex_name(&compiled.standard[k].name),
    };
    let mut lines = Vec::new();
    for (base_name, terms) in base.names.iter().zip(&base.combinations) {
        let sum = terms
            .iter()
            .enumerate()
            .map(|(place, &(k, coefficient))| term(place, coefficient, &name(k)));
        let sum: String = sum.collect();
        match style {
            Style::Text if terms.len() == 1 => lines.push(base_name.clone()),
            Style::Text => lines.push(format!("{base_name} = {sum}")),
            Style::Latex => lines.push(format!("{} &= {sum}", latex_name(base_name))),
        }
    }
    if style == Style::Text {
        for (heading, indices) in [
            ("without influence", &base.unidentifiable),
            ("fixed by the spec", &base.fixed),
        ] {
            if !indices.is_empty() {
                let names: Vec<String> = indices.iter().map(|&k| name(k)).collect();
                lines.push(format!("{heading}: {}", names.join(", ")));
            }
        }
    }
    finish(&lines, style)
}

/// One term of a combination: ` + 0.25 elbow.m`.
fn term(place: usize, coefficient: f64, name: &str) -> String {
    let sign = match (place, coefficient < 0.0) {
        (0, false) => "",
        (0, true) => "-",
        (_, false) => " + ",
        (_, true) => " - ",
    };
    // Ten digits: lengths have no more.
    let size: f64 = format!("{:.9e}", coefficient.abs())
        .parse()
        .unwrap_or(coefficient.abs());
    if (size - 1.0).abs() < 1e-9 {
        format!("{sign}{name}")
    } else {
        format!("{sign}{size} {name}")
    }
}

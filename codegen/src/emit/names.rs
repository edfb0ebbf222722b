//! The one owner of identifiers in emitted code: a temporary is named by its meaning where it has a short one.

use std::collections::HashMap;
use std::fmt::Write;

use crate::expr::{Dag, ExprId, Function, Label, Names, Node, Style, Symbol};

/// Longer names say less than a number.
const LONGEST_NAME: usize = 30;
/// Products of more factors are numbered.
const MOST_FACTORS: usize = 3;
/// What a function body names besides its temporaries.
const RESERVED: [&str; 34] = [
    "q",
    "dq",
    "ddq",
    "tau",
    "beta",
    "standard",
    "shapes",
    "time",
    "rigid_torque",
    "measured_torque",
    "inputs",
    "states",
    "seconds",
    // What is made on the way to a result, and results that have names.
    "angles",
    "sines",
    "cosines",
    "slope",
    "slopes",
    "change",
    "step",
    "rates",
    "states_after",
    "positions",
    "poses",
    "out",
    "y",
    // What C calls.
    "sin",
    "cos",
    "exp",
    "log",
    "sqrt",
    "tanh",
    "pow",
    "fabs",
];
/// Words of C and C++ that a name of several words could be.
const WORDS: [&str; 18] = [
    "and_eq",
    "or_eq",
    "not_eq",
    "xor_eq",
    "char8_t",
    "char16_t",
    "char32_t",
    "wchar_t",
    "float_t",
    "double_t",
    "const_cast",
    "static_cast",
    "dynamic_cast",
    "reinterpret_cast",
    "static_assert",
    "thread_local",
    "co_await",
    "co_yield",
];

/// Gives identifiers to the temporaries of one function.
pub struct Namer<'a> {
    dag: &'a Dag,
    names: &'a Names,
    // Looked up only.
    taken: HashMap<String, usize>,
    given: HashMap<ExprId, String>,
    numbered: usize,
}

impl<'a> Namer<'a> {
    /// A namer with nothing but the arguments taken.
    pub fn new(dag: &'a Dag, names: &'a Names) -> Self {
        let taken = RESERVED.iter().chain(&WORDS);
        let taken = taken.map(|name| ((*name).to_owned(), 1)).collect();
        Self {
            dag,
            names,
            taken,
            given: HashMap::new(),
            numbered: 0,
        }
    }

    /// The identifier of a temporary; the same one each time.
    pub fn name(&mut self, x: ExprId) -> String {
        if let Some(name) = self.given.get(&x) {
            return name.clone();
        }
        let name = match self.meaning(x, MOST_FACTORS) {
            Some((name, _)) if name.len() <= LONGEST_NAME => self.unique(snake_case(&name)),
            _ => {
                self.numbered += 1;
                self.unique(format!("t{}", self.numbered - 1))
            }
        };
        self.given.insert(x, name.clone());
        name
    }

    fn unique(&mut self, name: String) -> String {
        let count = self.taken.entry(name.clone()).or_insert(0);
        *count += 1;
        if *count == 1 {
            return name;
        }
        let suffixed = format!("{name}_{count}");
        self.unique(suffixed)
    }

    /// A name made of the expression's meaning and the number of factors in it.
    fn meaning(&self, x: ExprId, most: usize) -> Option<(String, usize)> {
        if let Some(label) = self.dag.label(x) {
            return Some((label_name(label), 1));
        }
        match self.dag.node(x) {
            Node::Symbol(symbol) => Some((identifier(&self.names.symbol(symbol, Style::Text)), 1)),
            Node::Mul(p, q) => {
                let (left, m) = self.meaning(p, most)?;
                let (right, n) = self.meaning(q, most)?;
                (m + n <= most).then(|| (format!("{left}_{right}"), m + n))
            }
            Node::Add(..) if self.is_angle(x) => Some((self.argument(x)?, 1)),
            Node::Call(function, inside) if function != Function::Recip => {
                Some((format!("{}_{}", function.name(), self.argument(inside)?), 1))
            }
            _ => None,
        }
    }

    /// A sum of positions.
    fn is_angle(&self, x: ExprId) -> bool {
        self.dag
            .symbols(&[x])
            .iter()
            .all(|symbol| matches!(symbol, Symbol::Q(_)))
    }

    /// The argument of a call in a name: a symbol, or a short sum of symbols.
    fn argument(&self, x: ExprId) -> Option<String> {
        match self.dag.node(x) {
            Node::Symbol(Symbol::Parameter(_)) => None,
            Node::Symbol(symbol) => Some(identifier(&self.names.symbol(symbol, Style::Text))),
            Node::Add(p, q) => {
                let (left, right) = (self.dag.coefficient(p), self.dag.coefficient(q));
                match (left, right) {
                    ((1.0, Some(p)), (1.0, Some(q))) => {
                        Some(format!("{}_{}", self.argument(p)?, self.argument(q)?))
                    }
                    ((1.0, Some(p)), (-1.0, Some(q))) | ((-1.0, Some(q)), (1.0, Some(p))) => {
                        Some(format!("{}_minus_{}", self.argument(p)?, self.argument(q)?))
                    }
                    // By an offset.
                    ((_, None), (1.0, Some(x))) | ((1.0, Some(x)), (_, None)) => {
                        Some(format!("{}_shifted", self.argument(x)?))
                    }
                    _ => None,
                }
            }
            Node::Mul(p, q) => {
                let multiple = self.dag.as_constant(p)?;
                let whole = (2..10).find(|k| (f64::from(*k) - multiple).abs() < 1e-12)?;
                Some(format!("{whole}_{}", self.argument(q)?))
            }
            _ => None,
        }
    }
}

/// Indices count from 1 in names.
fn label_name(label: Label) -> String {
    const AXES: [&str; 3] = ["x", "y", "z"];
    match label {
        Label::Component { stem, link, axis } => format!("{stem}{}{}", link + 1, AXES[axis]),
        Label::Gradient { link, row, column } => {
            format!("u{}{}{}", link + 1, AXES[row], AXES[column])
        }
        Label::Entry { stem, row, column } if row < 9 && column < 9 => {
            format!("{stem}_{}{}", row + 1, column + 1)
        }
        Label::Entry { stem, row, column } => format!("{stem}_{}_{}", row + 1, column + 1),
    }
}

/// Names put together with one underscore between words, as rustc wants them.
fn snake_case(name: &str) -> String {
    let words = name.split('_').filter(|word| !word.is_empty());
    let name = words.collect::<Vec<_>>().join("_");
    identifier(&name)
}

/// A user's name as an identifier in snake case. Compilers of C need not take letters of other alphabets: these are written as their codes,
/// so that names that differ stay so.
pub fn identifier(name: &str) -> String {
    let mut text = String::new();
    for c in name.chars() {
        match c {
            c if c.is_ascii_alphanumeric() => text.push(c.to_ascii_lowercase()),
            c if c.is_ascii() => text.push('_'),
            c => write!(text, "u{:x}", u32::from(c)).expect("a string takes all"),
        }
    }
    if text.chars().all(|c| c == '_') || text.starts_with(|c: char| c.is_ascii_digit()) {
        text.insert(0, 'x');
    }
    if syn::parse_str::<syn::Ident>(&text).is_err() {
        // A word of Rust.
        text.push('_');
    }
    text
}

#[cfg(test)]
mod tests {
    use super::{identifier, snake_case};

    #[test]
    fn any_name_becomes_an_identifier_of_both_languages() {
        for name in [
            "\u{3b8}1", "\u{6e29}", "_", "", "2nd", "type", "Y-axis", "__a__",
        ] {
            for text in [identifier(name), snake_case(name)] {
                assert!(
                    syn::parse_str::<syn::Ident>(&text).is_ok(),
                    "{name}: {text}"
                );
                assert!(text.is_ascii() && text != "_", "{name}: {text}");
            }
        }
        assert_eq!(identifier("\u{3b8}1"), "u3b81");
        assert_ne!(identifier("\u{3b8}"), identifier("\u{3c6}"));
    }
}

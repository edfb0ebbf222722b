//! Expressions as people write them, in text and LaTeX.

use super::{Dag, ExprId, Function, Node, Symbol};

/// Which notation.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Style {
    /// `cos(q1 + q2) dq1^2`
    Text,
    /// `\cos(q_{1} + q_{2}) \dot q_{1}^{2}`
    Latex,
}

/// The user's names of parameters, shapes and coordinates.
#[derive(Debug, Clone, Default)]
pub struct Names {
    /// One per coordinate, or none: then they are `q1, q2, ..`.
    pub coordinates: Vec<String>,
    /// One per standard parameter.
    pub parameters: Vec<String>,
    /// One per shape parameter.
    pub shapes: Vec<String>,
    /// One per further channel of the log.
    pub inputs: Vec<String>,
    /// One per internal state.
    pub states: Vec<String>,
}

impl Names {
    /// A symbol's name.
    #[must_use]
    pub fn symbol(&self, symbol: Symbol, style: Style) -> String {
        let named = |names: &[String], stem: &str, k: usize| {
            let name = names.get(k).cloned();
            name.unwrap_or_else(|| format!("{stem}{}", k + 1))
        };
        let text = match symbol {
            Symbol::Q(j) => self.coordinate(j),
            Symbol::Dq(j) => format!("d{}", self.coordinate(j)),
            Symbol::Ddq(j) => format!("dd{}", self.coordinate(j)),
            Symbol::RigidTorque(j) => format!("rigid_torque{}", j + 1),
            Symbol::MeasuredTorque(j) => format!("measured_torque{}", j + 1),
            Symbol::Time => "t".to_owned(),
            Symbol::Parameter(k) => named(&self.parameters, "parameter", k),
            Symbol::Shape(k) => named(&self.shapes, "shape", k),
            Symbol::Input(k) => named(&self.inputs, "input", k),
            Symbol::State(k) => named(&self.states, "state", k),
            Symbol::Switch(k) => format!("switch{}", k + 1),
            Symbol::Weight(k) => format!("weight{}", k + 1),
        };
        if style == Style::Text {
            return text;
        }
        match symbol {
            Symbol::Q(j) => latex_name(&self.coordinate(j), ""),
            Symbol::Dq(j) => latex_name(&self.coordinate(j), "\\dot "),
            Symbol::Ddq(j) => latex_name(&self.coordinate(j), "\\ddot "),
            Symbol::RigidTorque(j) => format!("\\tau^{{\\mathrm{{rigid}}}}_{{{}}}", j + 1),
            Symbol::MeasuredTorque(j) => format!("\\tau^{{\\mathrm{{measured}}}}_{{{}}}", j + 1),
            Symbol::Time | Symbol::Weight(_) => text,
            Symbol::Parameter(_)
            | Symbol::Shape(_)
            | Symbol::Input(_)
            | Symbol::State(_)
            | Symbol::Switch(_) => {
                format!("\\mathrm{{{}}}", text.replace('_', "\\_"))
            }
        }
    }
}

impl Names {
    fn coordinate(&self, j: usize) -> String {
        let name = self.coordinates.get(j).cloned();
        name.unwrap_or_else(|| format!("q{}", j + 1))
    }
}

/// `\dot \theta_{2}` of `theta2`: an accent over a name, what follows an underscore or ends in digits below it.
fn latex_name(name: &str, accent: &str) -> String {
    const GREEK: [&str; 10] = [
        "alpha", "beta", "gamma", "delta", "theta", "phi", "psi", "varphi", "chi", "xi",
    ];
    let digits = name.trim_end_matches(|c: char| c.is_ascii_digit()).len();
    let stem_end = name.find('_').unwrap_or(digits);
    let (stem, index) = name.split_at(stem_end);
    let stem = match stem.len() {
        0 | 1 => stem.to_owned(),
        _ if GREEK.contains(&stem) => format!("\\{stem}"),
        _ => format!("\\mathit{{{stem}}}"),
    };
    match index.trim_start_matches('_') {
        "" => format!("{accent}{stem}"),
        index => format!("{accent}{stem}_{{{}}}", index.replace('_', "\\_")),
    }
}

/// How tightly the surroundings bind: what needs no parentheses there.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Binding {
    Sum,
    Product,
    Power,
}

impl Dag {
    /// The expression as built: nested, with the user's names.
    #[must_use]
    pub fn display(&self, x: ExprId, names: &Names, style: Style) -> String {
        self.display_with(x, names, style, &|_| None)
    }

    /// The terms of the definition of `x`, each with whether it is subtracted. As [`Self::display_with`] else.
    pub(crate) fn terms(
        &self,
        x: ExprId,
        names: &Names,
        style: Style,
        given: &dyn Fn(ExprId) -> Option<String>,
    ) -> Vec<(bool, String)> {
        let mut terms = Vec::new();
        let Node::Add(p, q) = self.node(x) else {
            return vec![signed(self.display_with(x, names, style, given))];
        };
        let mut stack = vec![q, p];
        while let Some(x) = stack.pop() {
            match (given(x), self.node(x)) {
                (Some(name), _) => terms.push(name),
                (None, Node::Add(p, q)) => stack.extend([q, p]),
                (None, _) => terms.push(self.display_with(x, names, style, given)),
            }
        }
        terms.into_iter().map(signed).collect()
    }

    /// Whether what is written of `x` ends with an exponent, behind which another one would be read otherwise.
    pub(crate) fn has_exponent(&self, x: ExprId, style: Style) -> bool {
        match self.node(x) {
            Node::Mul(p, q) => p == q,
            Node::Power(..) => true,
            Node::Symbol(Symbol::RigidTorque(_) | Symbol::MeasuredTorque(_)) => {
                style == Style::Latex
            }
            _ => false,
        }
    }

    /// The definition of `x` with other expressions by the names that `given` has for them.
    #[must_use]
    pub fn display_with(
        &self,
        x: ExprId,
        names: &Names,
        style: Style,
        given: &dyn Fn(ExprId) -> Option<String>,
    ) -> String {
        Writer {
            dag: self,
            names,
            style,
            given,
        }
        .node(x, Binding::Sum)
    }
}

/// What stays the same while an expression is written.
struct Writer<'a> {
    dag: &'a Dag,
    names: &'a Names,
    style: Style,
    given: &'a dyn Fn(ExprId) -> Option<String>,
}

impl Writer<'_> {
    fn write(&self, x: ExprId, around: Binding) -> String {
        (self.given)(x).unwrap_or_else(|| self.node(x, around))
    }

    fn node(&self, x: ExprId, around: Binding) -> String {
        let parenthesize = |text: String, own: Binding| {
            if own < around {
                format!("({text})")
            } else {
                text
            }
        };
        match self.dag.node(x) {
            Node::Constant(value) => parenthesize(
                number(value.get()),
                if value.get() < 0.0 {
                    Binding::Sum
                } else {
                    Binding::Power
                },
            ),
            Node::Symbol(symbol) => self.names.symbol(symbol, self.style),
            Node::Add(p, q) => {
                let left = self.write(p, Binding::Sum);
                let right = self.write(q, Binding::Sum);
                let text = match right.strip_prefix('-') {
                    Some(right) => format!("{left} - {right}"),
                    None => format!("{left} + {right}"),
                };
                parenthesize(text, Binding::Sum)
            }
            Node::Mul(p, q) => self.product(p, q, around),
            Node::Power(p, q) => {
                let base = self.base(p);
                let exponent = self.write(q, Binding::Sum);
                match self.style {
                    Style::Text => format!("{base}^({exponent})"),
                    Style::Latex => format!("{{{base}}}^{{{exponent}}}"),
                }
            }
            Node::Call(Function::Recip, p) => parenthesize(
                format!("1 / {}", self.write(p, Binding::Power)),
                Binding::Product,
            ),
            Node::Call(function, p) => call(function, &self.write(p, Binding::Sum), self.style),
            Node::Select(condition, p, q) => {
                let condition = self.condition(condition);
                let (p, q) = (self.write(p, Binding::Sum), self.write(q, Binding::Sum));
                choice(&condition, &p, &q, self.style)
            }
        }
    }

    /// `x > y` where the difference of the two decides, else `x > 0`.
    fn condition(&self, x: ExprId) -> String {
        if let Node::Add(p, q) = self.dag.node(x) {
            for (here, other) in [(p, q), (q, p)] {
                let (c, rest) = self.dag.coefficient(here);
                if let (true, Some(rest)) = (c.to_bits() == (-1.0f64).to_bits(), rest) {
                    let larger = self.write(other, Binding::Sum);
                    return format!("{larger} > {}", self.write(rest, Binding::Sum));
                }
            }
        }
        format!("{} > 0", self.write(x, Binding::Sum))
    }

    /// What an expression is a power of by squares of squares, and which.
    fn squared(&self, x: ExprId) -> (ExprId, u32) {
        match self.dag.node(x) {
            Node::Mul(p, q) if p == q && (self.given)(x).is_none() => {
                let (factor, times) = self.squared(p);
                (factor, 2 * times)
            }
            _ => (x, 1),
        }
    }

    /// What an exponent may stand behind.
    fn base(&self, x: ExprId) -> String {
        (self.given)(x).unwrap_or_else(|| {
            let text = self.node(x, Binding::Power);
            if self.dag.has_exponent(x, self.style) {
                format!("({text})")
            } else {
                text
            }
        })
    }

    fn product(&self, p: ExprId, q: ExprId, around: Binding) -> String {
        if p == q {
            let (factor, times) = self.squared(p);
            let (base, power) = (self.base(factor), 2 * times);
            return match self.style {
                Style::Text => format!("{base}^{power}"),
                Style::Latex => format!("{base}^{{{power}}}"),
            };
        }
        let right = self.write(q, Binding::Product);
        let text = match (self.dag.as_constant(p), self.dag.node(q)) {
            (Some(-1.0), _) => format!("-{right}"),
            (_, Node::Call(Function::Recip, q)) => format!(
                "{} / {}",
                self.write(p, Binding::Product),
                self.write(q, Binding::Power)
            ),
            (Some(c), _) => format!("{} {right}", number(c)),
            _ => format!("{} {right}", self.write(p, Binding::Product)),
        };
        let binding = if text.starts_with('-') {
            Binding::Sum
        } else {
            Binding::Product
        };
        if binding < around {
            format!("({text})")
        } else {
            text
        }
    }
}

/// A term without its minus, and whether it had one.
fn signed(term: String) -> (bool, String) {
    match term.strip_prefix('-') {
        Some(positive) => (true, positive.to_owned()),
        None => (false, term),
    }
}

/// A function call in the given notation.
pub(crate) fn call(function: Function, argument: &str, style: Style) -> String {
    match (style, function) {
        (Style::Text, _) => format!("{}({argument})", function.name()),
        (Style::Latex, Function::Abs) => format!("\\left|{argument}\\right|"),
        (Style::Latex, Function::Sqrt) => format!("\\sqrt{{{argument}}}"),
        (Style::Latex, Function::Sign) => format!("\\operatorname{{sign}}({argument})"),
        (Style::Latex, _) => format!("\\{}({argument})", function.name()),
    }
}

/// A choice in the given notation.
pub(crate) fn choice(condition: &str, x: &str, y: &str, style: Style) -> String {
    match style {
        Style::Text => format!("(if {condition} {{ {x} }} else {{ {y} }})"),
        Style::Latex => format!(
            "\\begin{{cases}} {x} & {condition} \\\\ {y} & \\text{{otherwise}} \\end{{cases}}"
        ),
    }
}

/// A number without float noise: at most twelve significant digits.
pub(crate) fn number(value: f64) -> String {
    if value == 0.0 || !value.is_finite() {
        return value.to_string();
    }
    let rounded: f64 = format!("{value:.11e}").parse().unwrap_or(value);
    if (1e-4..1e7).contains(&rounded.abs()) {
        rounded.to_string()
    } else {
        format!("{rounded:e}")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_exponent_stands_behind_a_base() {
        let mut dag = Dag::new();
        let x = dag.symbol(Symbol::Q(0));
        let mut power = x;
        for exponent in [2, 4, 8] {
            power = dag.mul(power, power);
            let [text, latex] = [Style::Text, Style::Latex]
                .map(|style| dag.display(power, &Names::default(), style));
            assert_eq!(text, format!("q1^{exponent}"));
            assert_eq!(latex, format!("q_{{1}}^{{{exponent}}}"));
        }
        // What has an exponent that is no whole number, or a superscript, is no base by itself.
        let share = dag.constant(0.3);
        let root = dag.power(x, share);
        let square = dag.mul(root, root);
        assert_eq!(
            dag.display(square, &Names::default(), Style::Text),
            "(q1^(0.3))^2"
        );
        let load = dag.symbol(Symbol::MeasuredTorque(0));
        let square = dag.mul(load, load);
        let latex = dag.display(square, &Names::default(), Style::Latex);
        assert_eq!(latex, "(\\tau^{\\mathrm{measured}}_{1})^{2}");
    }
}

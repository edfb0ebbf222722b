//! Expressions multiplied out into sums of products of readable factors, in a fixed order.

use std::collections::BTreeMap;

use crate::expr::{Dag, ExprId, Function, Names, Node, Style, Symbol};

/// Expressions with more terms than this are shown with intermediate names instead.
pub const MOST_TERMS: usize = 24;
/// While multiplying out, terms may be this many: identities then bring them together.
const MOST_TERMS_ON_THE_WAY: usize = 96;
/// Factors of more symbols, numbers and operators than this are shown by intermediate names instead: shared parts are
/// repeated in a factor, so that it may be exponentially longer than the expression is large.
const LONGEST_FACTOR: usize = 64;

/// A factor: parameters first, then functions, then coordinates; each kind in its own order.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord)]
struct Factor {
    kind: u8,
    index: usize,
    /// Distinguishes functions.
    text: String,
    expr: ExprId,
}

/// Factors with their powers, ascending; what stands in a denominator has a negative one.
type Monomial = Vec<(Factor, i32)>;

/// A sum of products; shorter products first.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Polynomial(BTreeMap<(u32, Monomial), f64>);

impl Polynomial {
    fn of(monomial: Monomial, coefficient: f64) -> Self {
        let mut polynomial = Self::default();
        polynomial.add_term(monomial, coefficient);
        polynomial
    }

    fn add_term(&mut self, monomial: Monomial, coefficient: f64) {
        /// Sums of lengths cancel to rounding.
        const CANCELED: f64 = 1e-14;
        let degree = monomial.iter().map(|(_, power)| power.unsigned_abs()).sum();
        let key = (degree, monomial);
        let before = self.0.get(&key).copied().unwrap_or(0.0);
        let sum = before + coefficient;
        if sum.abs() <= CANCELED * before.abs().max(coefficient.abs()) {
            self.0.remove(&key);
        } else {
            self.0.insert(key, sum);
        }
    }

    fn terms(&self) -> impl Iterator<Item = (&Monomial, f64)> {
        self.0
            .iter()
            .map(|((_, monomial), &coefficient)| (monomial, coefficient))
    }
}

/// Multiplies out; `None` if that takes too many terms, or if factors are too long.
pub fn expand(dag: &mut Dag, x: ExprId, names: &Names) -> Option<Polynomial> {
    let mut known: BTreeMap<ExprId, Polynomial> = BTreeMap::new();
    // Nodes of each part written as a tree.
    let mut lengths: BTreeMap<ExprId, usize> = BTreeMap::new();
    for part in dag.reachable(&[x]) {
        let operands = dag.node(part).operands();
        let length = operands.fold(1, |sum: usize, operand| {
            sum.saturating_add(lengths[&operand])
        });
        lengths.insert(part, length);
        let is_factor = !matches!(dag.node(part), Node::Add(..) | Node::Mul(..));
        if is_factor && length > LONGEST_FACTOR {
            return None;
        }
        let polynomial = match dag.node(part) {
            Node::Constant(value) => Polynomial::of(Vec::new(), value.get()),
            Node::Add(p, q) => {
                let mut sum = known[&p].clone();
                for (monomial, coefficient) in known[&q].terms() {
                    sum.add_term(monomial.clone(), coefficient);
                }
                sum
            }
            Node::Mul(p, q) => product(&known[&p], &known[&q]),
            Node::Call(Function::Recip, q) => {
                Polynomial::of(vec![(factor(dag, q, names), -1)], 1.0)
            }
            Node::Symbol(_) | Node::Power(..) | Node::Call(..) | Node::Select(..) => {
                Polynomial::of(vec![(factor(dag, part, names), 1)], 1.0)
            }
        };
        if polynomial.0.len() > MOST_TERMS_ON_THE_WAY {
            return None;
        }
        known.insert(part, polynomial);
    }
    let merged = merge(dag, known.remove(&x)?, names);
    (merged.0.len() <= MOST_TERMS).then_some(merged)
}

fn product(left: &Polynomial, right: &Polynomial) -> Polynomial {
    let mut product = Polynomial::default();
    for (p, c) in left.terms() {
        for (q, d) in right.terms() {
            let mut factors: BTreeMap<Factor, i32> = p.iter().cloned().collect();
            for (factor, power) in q {
                *factors.entry(factor.clone()).or_insert(0) += power;
            }
            factors.retain(|_, power| *power != 0);
            product.add_term(factors.into_iter().collect(), c * d);
        }
    }
    product
}

fn factor(dag: &Dag, x: ExprId, names: &Names) -> Factor {
    let (kind, index) = match dag.node(x) {
        Node::Symbol(Symbol::Parameter(k)) => (0, k),
        Node::Symbol(Symbol::Shape(k)) => (1, k),
        Node::Symbol(Symbol::RigidTorque(j)) => (3, j),
        Node::Symbol(Symbol::Q(j)) => (4, j),
        Node::Symbol(Symbol::Ddq(j)) => (5, j),
        Node::Symbol(Symbol::Dq(j)) => (6, j),
        Node::Symbol(Symbol::State(k)) => (7, k),
        Node::Symbol(Symbol::Input(k)) => (8, k),
        Node::Symbol(Symbol::MeasuredTorque(j)) => (9, j),
        Node::Symbol(Symbol::Time) => (10, 0),
        _ => (2, 0),
    };
    let text = if kind == 2 {
        dag.display(x, names, Style::Text)
    } else {
        String::new()
    };
    Factor {
        kind,
        index,
        text,
        expr: x,
    }
}

/// Brings pairs of terms together where the rule table makes one of them: `cos^2 + sin^2`, sums of angles.
fn merge(dag: &mut Dag, mut polynomial: Polynomial, names: &Names) -> Polynomial {
    'again: loop {
        let terms: Vec<(Monomial, f64)> = polynomial
            .terms()
            .map(|(monomial, c)| (monomial.clone(), c))
            .collect();
        for (k, left) in terms.iter().enumerate() {
            for right in terms[k + 1..].iter().filter(|right| is_pair(left, right)) {
                let (x, y) = (build(dag, left), build(dag, right));
                let sum = dag.add(x, y);
                let (coefficient, rest) = dag.coefficient(sum);
                let Some(one) = one_product(dag, rest, names) else {
                    continue;
                };
                polynomial.add_term(left.0.clone(), -left.1);
                polynomial.add_term(right.0.clone(), -right.1);
                polynomial.add_term(one, coefficient);
                continue 'again;
            }
        }
        return polynomial;
    }
}

/// Rules that bring products together ask for equal coefficients; float noise does not part them.
fn is_pair(left: &(Monomial, f64), right: &(Monomial, f64)) -> bool {
    /// Relative.
    const NOISE: f64 = 1e-12;
    (left.1.abs() - right.1.abs()).abs() <= NOISE * left.1.abs()
        && [left, right]
            .iter()
            .all(|term| term.0.iter().any(|(factor, _)| factor.kind == 2))
}

/// The term as an expression, its coefficient without float noise.
fn build(dag: &mut Dag, (monomial, coefficient): &(Monomial, f64)) -> ExprId {
    let rounded: f64 = format!("{coefficient:.12e}")
        .parse()
        .unwrap_or(*coefficient);
    let mut product = dag.constant(1.0);
    for (factor, power) in monomial {
        let exponent = dag.constant(f64::from(*power));
        let power = dag.power(factor.expr, exponent);
        product = dag.mul(product, power);
    }
    dag.scale(rounded, product)
}

/// The factors of an expression that is a single product.
fn one_product(dag: &Dag, x: Option<ExprId>, names: &Names) -> Option<Monomial> {
    let mut factors: BTreeMap<Factor, i32> = BTreeMap::new();
    let mut stack: Vec<ExprId> = x.into_iter().collect();
    while let Some(x) = stack.pop() {
        match dag.node(x) {
            Node::Add(..) => return None,
            Node::Mul(p, q) => stack.extend([p, q]),
            Node::Constant(_) => {}
            Node::Call(Function::Recip, q) => {
                *factors.entry(factor(dag, q, names)).or_insert(0) -= 1;
            }
            _ => *factors.entry(factor(dag, x, names)).or_insert(0) += 1,
        }
    }
    factors.retain(|_, power| *power != 0);
    Some(factors.into_iter().collect())
}

/// A term's sign (true is negative) and what stands behind it.
pub type SignedTerm = (bool, String);

/// The terms of the sum as text; none if it is zero.
#[must_use]
pub fn terms(dag: &Dag, polynomial: &Polynomial, names: &Names, style: Style) -> Vec<SignedTerm> {
    polynomial
        .terms()
        .map(|(monomial, coefficient)| {
            let (mut above, mut below): (Vec<String>, Vec<String>) = (Vec::new(), Vec::new());
            let number = crate::expr::number(coefficient.abs());
            if number != "1" || monomial.iter().all(|(_, power)| *power < 0) {
                above.push(number);
            }
            for (factor, power) in monomial {
                let side = if *power > 0 { &mut above } else { &mut below };
                side.push(self::power(dag, factor, power.unsigned_abs(), names, style));
            }
            (coefficient < 0.0, quotient(&above, &below, style))
        })
        .collect()
}

/// The terms of the sum without their numbers and parameters, as text and as expressions.
#[must_use]
pub fn functions(dag: &mut Dag, polynomial: &Polynomial, names: &Names) -> Vec<(String, ExprId)> {
    let is_parameter = |factor: &Factor| {
        let node = dag.node(factor.expr);
        matches!(node, Node::Symbol(Symbol::Parameter(_) | Symbol::Shape(_)))
    };
    let free: Vec<Monomial> = polynomial
        .terms()
        .map(|(monomial, _)| {
            let factors = monomial.iter().filter(|(factor, _)| !is_parameter(factor));
            factors.cloned().collect()
        })
        .collect();
    let told = free.into_iter().map(|monomial| {
        let alone = Polynomial::of(monomial.clone(), 1.0);
        let text = terms(dag, &alone, names, Style::Text).remove(0).1;
        (text, build(dag, &(monomial, 1.0)))
    });
    told.collect()
}

fn power(dag: &Dag, factor: &Factor, power: u32, names: &Names, style: Style) -> String {
    let text = dag.display(factor.expr, names, style);
    let text = match dag.node(factor.expr) {
        Node::Add(..) => format!("({text})"),
        _ if power > 1 && dag.has_exponent(factor.expr, style) => format!("({text})"),
        _ => text,
    };
    match style {
        _ if power == 1 => text,
        Style::Text => format!("{text}^{power}"),
        Style::Latex => format!("{text}^{{{power}}}"),
    }
}

fn quotient(above: &[String], below: &[String], style: Style) -> String {
    match style {
        Style::Text => {
            let above = above.join(" ");
            match below {
                [] => above,
                [one] => format!("{above} / {one}"),
                several => format!("{above} / ({})", several.join(" ")),
            }
        }
        Style::Latex if below.is_empty() => above.join(" \\, "),
        Style::Latex => format!(
            "\\frac{{{}}}{{{}}}",
            above.join(" \\, "),
            below.join(" \\, ")
        ),
    }
}

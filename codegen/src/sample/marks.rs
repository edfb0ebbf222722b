//! Marks of a signal: magnitudes at which an equation may change its behavior. Between every two neighbours it is visited.

use std::collections::BTreeMap;

use robot_model_spec::model::Model;

use crate::expr::{Dag, ExprId, Node, Symbol};
use crate::random::Generator;

/// Marks beyond are those of numbers that no signal reaches, such as the inverse of a rounding.
const SMALLEST: f64 = 1e-12;
const LARGEST: f64 = 1e12;

/// Cards of one signal: its intervals, shuffled, so that each is drawn before one is drawn twice.
struct Cards {
    /// Ascending.
    marks: Vec<f64>,
    /// Intervals by their lower mark.
    order: Vec<usize>,
    next: usize,
}

/// Magnitudes for the signals that effects and energies read.
pub struct Deck(BTreeMap<Symbol, Cards>);

impl Deck {
    /// The marks of all signals in `entries`.
    pub fn new(dag: &Dag, model: &Model, entries: &[ExprId], shapes: &[f64]) -> Self {
        let mut marks: BTreeMap<Symbol, Vec<f64>> = BTreeMap::new();
        for &entry in entries {
            let (mut numbers, mut signals) = (Vec::new(), Vec::new());
            for x in dag.reachable(&[entry]) {
                match dag.node(x) {
                    Node::Constant(value) => numbers.push(value.get().abs()),
                    Node::Symbol(Symbol::Shape(k)) => numbers.push(shapes[k].abs()),
                    Node::Symbol(symbol) => signals.push(symbol),
                    _ => {}
                }
            }
            // `k x`, `k / x` and `k x^2` are 1 at these.
            let marked: Vec<f64> = numbers
                .iter()
                .flat_map(|x| [*x, x.recip(), x.sqrt().recip()])
                .filter(|x| (SMALLEST..=LARGEST).contains(x))
                .collect();
            for signal in signals {
                marks
                    .entry(signal)
                    .or_insert_with(|| usual(signal, model))
                    .extend(&marked);
            }
        }
        Self(
            marks
                .into_iter()
                .map(|(signal, marks)| (signal, Cards::new(marks)))
                .collect(),
        )
    }

    /// Most intervals of a signal.
    pub fn intervals(&self) -> usize {
        self.0
            .values()
            .map(|cards| cards.order.len())
            .max()
            .unwrap_or(0)
    }

    /// A value of either sign between two marks; `None` where only a chain reads the signal.
    pub fn draw(&mut self, signal: Symbol, generator: &mut Generator) -> Option<f64> {
        let (part, sign) = (generator.symmetric(), generator.symmetric());
        let cards = self.0.get_mut(&signal)?;
        let k = cards.draw(generator);
        let (low, high) = (cards.marks[k].ln(), cards.marks[k + 1].ln());
        // Not at a mark: rounding would decide.
        let magnitude = (f64::midpoint(low, high) + 0.49 * part * (high - low)).exp();
        Some(magnitude.copysign(sign))
    }
}

/// Powers of ten around what the signals of arms are, large and small, and the limits that the spec gives.
fn usual(signal: Symbol, model: &Model) -> Vec<f64> {
    let (smallest, largest): (i32, i32) = match signal {
        Symbol::Q(_) => (-6, 2),
        Symbol::Dq(_) | Symbol::State(_) => (-8, 2),
        Symbol::Ddq(_) | Symbol::RigidTorque(_) | Symbol::MeasuredTorque(_) => (-4, 4),
        Symbol::Input(_) | Symbol::Time | Symbol::Parameter(_) | Symbol::Shape(_) => (-2, 4),
        Symbol::Switch(_) | Symbol::Weight(_) => {
            unreachable!("in equations of simulation and design alone")
        }
    };
    let mut marks: Vec<f64> = (smallest..=largest)
        .step_by(2)
        .map(|exponent| 10f64.powi(exponent))
        .collect();
    let limits = |joint: usize| &model.joints[joint].limits;
    match signal {
        Symbol::Q(joint) => {
            let (low, high) = limits(joint).position.unwrap_or_default();
            marks.extend([low.abs(), high.abs()]);
        }
        Symbol::Dq(joint) => marks.extend(limits(joint).velocity),
        Symbol::RigidTorque(joint) | Symbol::MeasuredTorque(joint) => {
            marks.extend(limits(joint).torque);
        }
        _ => {}
    }
    marks.retain(|mark| *mark > 0.0);
    marks
}

impl Cards {
    fn new(mut marks: Vec<f64>) -> Self {
        /// Marks nearer than this are one: there is no room for a state between them.
        const ONE: f64 = 1.0 + 1e-6;
        marks.sort_by(f64::total_cmp);
        marks.dedup_by(|x, y| *x < *y * ONE);
        let (first, last) = (marks[0], marks[marks.len() - 1]);
        marks.insert(0, first / 10.0);
        marks.push(last * 10.0);
        Self {
            order: (0..marks.len() - 1).collect(),
            next: marks.len(),
            marks,
        }
    }

    /// An interval, by Fisher and Yates.
    fn draw(&mut self, generator: &mut Generator) -> usize {
        if self.next >= self.order.len() {
            for k in (1..self.order.len()).rev() {
                self.order.swap(k, generator.below(k + 1));
            }
            self.next = 0;
        }
        self.next += 1;
        self.order[self.next - 1]
    }
}

//! Internal states of effects along a motion.
//!
//! In: rates `dz/dt = f(z, signals)`. Out: `z` at every sample, 0 at the first. A step from one sample to the next is one of
//! Rosenbrock and Euler, `z + h phi(h J) f` with `phi(x) = (exp(x) - 1) / x` and `J = df/dz` exact from the dag, signals at
//! the middle of the step: exact for constant signals where `f` is affine in `z` (as in the models of `LuGre` and Dahl), stable
//! however stiff, of second order else (Hochbruck & Ostermann 2010, Exponential integrators). Where a velocity or a load
//! changes sign between two samples the step is cut there. Where a rate is no number the state stays; where only its
//! derivative is none, such as that of `abs(z)^n` at 0, the step is one of Euler.

mod exponential;

use crate::expr::{Dag, ExprId, Symbol};
use crate::interpreter::{Operand, Program};
use exponential::step;

/// The states of one or several effects.
#[derive(Debug, Clone, Default)]
pub struct States {
    parts: Vec<Part>,
}

/// The states of one effect, which depend on each other.
#[derive(Debug, Clone)]
struct Part {
    first: usize,
    count: usize,
    /// The rates, then the Jacobian row by row.
    program: Program,
    /// Whether the rates are affine in the states.
    affine: bool,
}

/// A piece of a sample interval over which signals keep their signs.
#[derive(Debug, Clone, Copy)]
struct Piece {
    /// The sample at which the interval begins.
    sample: usize,
    /// From where to where, as shares of the interval.
    from: f64,
    to: f64,
}

impl Piece {
    /// A signal at the piece's middle, linear between samples.
    fn middle(&self, values: &[f64]) -> f64 {
        let share = 0.5 * (self.from + self.to);
        let (x, y) = (values[self.sample], values[self.sample + 1]);
        x + share * (y - x)
    }
}

impl States {
    /// `rates` has one expression per state, in the order of [`Symbol::State`]; `counts` is how many of them belong to each
    /// effect.
    pub fn new(dag: &mut Dag, rates: &[ExprId], counts: impl IntoIterator<Item = usize>) -> Self {
        let mut first = 0;
        let mut parts = Vec::new();
        for count in counts {
            if count > 0 {
                parts.push(Part::new(dag, first, &rates[first..first + count]));
            }
            first += count;
        }
        Self { parts }
    }

    /// How many there are.
    #[must_use]
    pub fn count(&self) -> usize {
        self.parts.iter().map(|part| part.count).sum()
    }

    /// The symbols that the rates read.
    pub fn symbols(&self) -> impl Iterator<Item = &Symbol> {
        self.parts.iter().flat_map(|part| part.program.symbols())
    }

    /// `[state][sample]` over `samples` samples that are `interval` seconds apart. Every column that `bind` gives has as many
    /// values; it is not asked for states.
    #[must_use]
    pub fn integrate<'a>(
        &self,
        samples: usize,
        interval: f64,
        bind: &dyn Fn(Symbol) -> Operand<'a>,
    ) -> Vec<Vec<f64>> {
        let parts = self.parts.iter();
        parts
            .flat_map(|part| part.integrate(samples, interval, bind))
            .collect()
    }
}

impl Part {
    fn new(dag: &mut Dag, first: usize, rates: &[ExprId]) -> Self {
        let count = rates.len();
        let mut outputs = rates.to_vec();
        let mut jacobian = vec![dag.zero(); count * count];
        for column in 0..count {
            let derivatives = dag.derivatives(rates, Symbol::State(first + column));
            for (row, derivative) in derivatives.into_iter().enumerate() {
                jacobian[row * count + column] = derivative;
            }
        }
        let affine = dag.is_affine(rates, &|symbol| matches!(symbol, Symbol::State(_)));
        outputs.extend(jacobian);
        Self {
            first,
            count,
            program: Program::new(dag, &outputs),
            affine,
        }
    }

    fn integrate<'a>(
        &self,
        samples: usize,
        interval: f64,
        bind: &dyn Fn(Symbol) -> Operand<'a>,
    ) -> Vec<Vec<f64>> {
        let operand = |symbol: Symbol| match symbol {
            Symbol::State(_) => Operand::Constant(0.0),
            other => bind(other),
        };
        let pieces = self.pieces(samples, &operand);
        let signals: Vec<Vec<f64>> = self
            .program
            .symbols()
            .iter()
            .map(|&symbol| match operand(symbol) {
                Operand::Constant(value) => vec![value; pieces.len()],
                Operand::Column(values) => {
                    pieces.iter().map(|piece| piece.middle(values)).collect()
                }
            })
            .collect();
        let mut states = vec![vec![0.0; samples]; self.count];
        let mut z = vec![0.0; self.count];
        let mut record = |piece: &Piece, z: &[f64]| {
            for (column, value) in states.iter_mut().zip(z) {
                column[piece.sample + 1] = *value;
            }
        };
        if self.affine {
            let mut forms = vec![Vec::new(); self.program.outputs()];
            let symbols = self.program.symbols();
            let column = |symbol: Symbol| {
                let place = symbols.iter().position(|&other| other == symbol);
                Operand::Column(&signals[place.expect("the program asks for its own symbols")])
            };
            self.program.eval_batch(pieces.len(), &column, &mut forms);
            let mut rate = vec![0.0; self.count];
            let mut jacobian = vec![0.0; self.count * self.count];
            for (k, piece) in pieces.iter().enumerate() {
                for (entry, form) in jacobian.iter_mut().zip(&forms[self.count..]) {
                    *entry = form[k];
                }
                for (row, rate) in rate.iter_mut().enumerate() {
                    let row = &jacobian[row * self.count..][..self.count];
                    let linear: f64 = row.iter().zip(&z).map(|(j, z)| j * z).sum();
                    *rate = linear;
                }
                for (rate, form) in rate.iter_mut().zip(&forms[..self.count]) {
                    *rate += form[k];
                }
                step(&mut z, interval * (piece.to - piece.from), &rate, &jacobian);
                record(piece, &z);
            }
        } else {
            let mut scratch = self.program.scratch();
            let mut values = vec![0.0; signals.len()];
            for (k, piece) in pieces.iter().enumerate() {
                for ((value, signal), symbol) in
                    values.iter_mut().zip(&signals).zip(self.program.symbols())
                {
                    *value = match symbol {
                        Symbol::State(state) => z[state - self.first],
                        _ => signal[k],
                    };
                }
                self.program.eval_in(&values, &mut scratch);
                let outputs: Vec<f64> = (0..self.program.outputs())
                    .map(|output| scratch.output(output))
                    .collect();
                let (rate, jacobian) = outputs.split_at(self.count);
                step(&mut z, interval * (piece.to - piece.from), rate, jacobian);
                record(piece, &z);
            }
        }
        states
    }

    /// Sample intervals, cut where a velocity or a load changes sign.
    fn pieces<'a>(&self, samples: usize, bind: &dyn Fn(Symbol) -> Operand<'a>) -> Vec<Piece> {
        let jumping: Vec<&[f64]> = self
            .program
            .symbols()
            .iter()
            .filter(|symbol| matches!(symbol, Symbol::Dq(_) | Symbol::RigidTorque(_)))
            .filter_map(|&symbol| match bind(symbol) {
                Operand::Column(values) => Some(values),
                Operand::Constant(_) => None,
            })
            .collect();
        let mut pieces = Vec::with_capacity(samples);
        let mut cuts = Vec::new();
        for sample in 0..samples.saturating_sub(1) {
            cuts.clear();
            for values in &jumping {
                let (x, y) = (values[sample], values[sample + 1]);
                if x * y < 0.0 {
                    cuts.push(x / (x - y));
                }
            }
            cuts.sort_by(f64::total_cmp);
            let mut from = 0.0;
            for to in cuts.iter().copied().chain([1.0]) {
                pieces.push(Piece { sample, from, to });
                from = to;
            }
        }
        pieces
    }
}

#[cfg(test)]
mod tests;

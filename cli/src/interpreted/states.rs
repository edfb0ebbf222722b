//! Internal states of effects along a motion.
//!
//! In: rates and their slopes as programs. Out: the states at every sample, 0 at the first. A step from one sample to the next
//! is [`robot_model::memory::step`] with signals at its middle; where a velocity or a load changes sign between two samples it
//! is cut there.

use nalgebra::{DMatrix, DVector};
use robot_model::memory::step;
use robot_model_codegen::expr::Symbol;
use robot_model_codegen::interpreter::Operand;
use robot_model_codegen::states::StateProgram;

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

/// `[state][sample]` over `samples` samples that are `interval` seconds apart. Every column that `bind` gives has as many
/// values; it is not asked for states.
pub fn states<'a>(
    parts: &[StateProgram],
    samples: usize,
    interval: f64,
    bind: &dyn Fn(Symbol) -> Operand<'a>,
) -> Vec<Vec<f64>> {
    parts
        .iter()
        .flat_map(|part| integrate(part, samples, interval, bind))
        .collect()
}

fn integrate<'a>(
    part: &StateProgram,
    samples: usize,
    interval: f64,
    bind: &dyn Fn(Symbol) -> Operand<'a>,
) -> Vec<Vec<f64>> {
    let operand = |symbol: Symbol| match symbol {
        Symbol::State(_) => Operand::Constant(0.0),
        other => bind(other),
    };
    let (program, count) = (&part.program, part.count);
    let pieces = pieces(part, samples, &operand);
    let symbols = program.symbols();
    let signals: Vec<Vec<f64>> = symbols
        .iter()
        .map(|&symbol| match operand(symbol) {
            Operand::Constant(value) => vec![value; pieces.len()],
            Operand::Column(values) => pieces.iter().map(|piece| piece.middle(values)).collect(),
        })
        .collect();
    let mut states = vec![vec![0.0; samples]; count];
    let mut z = DVector::zeros(count);
    let mut rate = DVector::zeros(count);
    let mut jacobian = DMatrix::zeros(count, count);
    let mut advance =
        |piece: &Piece, rate: &DVector<f64>, jacobian: &DMatrix<f64>, z: &mut DVector<f64>| {
            step(z, interval * (piece.to - piece.from), rate, jacobian);
            for (column, value) in states.iter_mut().zip(z.iter()) {
                column[piece.sample + 1] = *value;
            }
        };
    if part.is_affine {
        // `f(z) = f(0) + J z`, with `f(0)` and `J` of all pieces at once.
        let mut forms = vec![Vec::new(); program.outputs()];
        let column = |symbol: Symbol| {
            let place = symbols.iter().position(|&other| other == symbol);
            Operand::Column(&signals[place.expect("the program asks for its own symbols")])
        };
        program.eval_batch(pieces.len(), &column, &mut forms);
        for (k, piece) in pieces.iter().enumerate() {
            fill(&mut rate, &mut jacobian, |output| forms[output][k]);
            rate.gemv(1.0, &jacobian, &z, 1.0);
            advance(piece, &rate, &jacobian, &mut z);
        }
    } else {
        let mut scratch = program.scratch();
        let mut values = vec![0.0; signals.len()];
        for (k, piece) in pieces.iter().enumerate() {
            for ((value, signal), symbol) in values.iter_mut().zip(&signals).zip(symbols) {
                *value = match symbol {
                    Symbol::State(state) => z[state - part.first],
                    _ => signal[k],
                };
            }
            program.eval_in(&values, &mut scratch);
            fill(&mut rate, &mut jacobian, |output| scratch.output(output));
            advance(piece, &rate, &jacobian, &mut z);
        }
    }
    states
}

/// Outputs of the program: the rates, then the Jacobian row by row.
pub(super) fn fill(
    rate: &mut DVector<f64>,
    jacobian: &mut DMatrix<f64>,
    output: impl Fn(usize) -> f64,
) {
    let count = rate.len();
    for row in 0..count {
        rate[row] = output(row);
        for column in 0..count {
            jacobian[(row, column)] = output(count + row * count + column);
        }
    }
}

/// Sample intervals, cut where a velocity or a load changes sign.
fn pieces<'a>(
    part: &StateProgram,
    samples: usize,
    bind: &dyn Fn(Symbol) -> Operand<'a>,
) -> Vec<Piece> {
    let jumping: Vec<&[f64]> = part
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

#[cfg(test)]
mod tests;

//! Internal states of effects along a motion that repeats, and slopes of what reads them.
//!
//! In: a motion over one period. Out: the states at each sample as they are once the motion has repeated for long, by the steps of
//! [`robot_model::memory::step`] with signals at the middle of two samples; and, by the same steps backward, how a weighted sum
//! of these states changes with the motion.

use nalgebra::{DMatrix, DVector};
use robot_model::memory::step;
use robot_model::scalar::{Dual, Scalar};
use robot_model_codegen::Remembering;
use robot_model_codegen::expr::Symbol;
use robot_model_codegen::interpreter::{Program, Scratch};

/// Rounds after which states that do not come round are taken as they are.
const ROUNDS: usize = 20;

/// Difference from round to round that is none, as a share of the largest state.
const CLOSED: f64 = 1e-10;

/// The states of one effect along one period.
pub(super) struct Orbit<'a> {
    part: &'a Remembering,
    /// Seconds from sample to sample.
    interval: f64,
    /// `q`, `dq` and `ddq` of all joints between each sample and the next, `[signal][sample]`.
    middles: Vec<Vec<f64>>,
    /// `[sample][state]`
    states: Vec<DVector<f64>>,
}

impl<'a> Orbit<'a> {
    /// `signals` are `q`, `dq` and `ddq` of all joints, as samples of a period of `period` seconds.
    pub(super) fn new(part: &'a Remembering, period: f64, signals: &[&[f64]]) -> Self {
        let samples = signals.first().map_or(0, |signal| signal.len());
        let middles = signals.iter().map(|signal| {
            let next = signal.iter().cycle().skip(1);
            signal
                .iter()
                .zip(next)
                .map(|(x, y)| 0.5 * (x + y))
                .collect()
        });
        let mut orbit = Self {
            part,
            interval: period / samples as f64,
            middles: middles.collect(),
            states: vec![DVector::zeros(part.states.count); samples],
        };
        let mut runner = Runner::new(&part.states.program);
        let mut z = DVector::zeros(part.states.count);
        for _ in 0..ROUNDS {
            let before = z.clone();
            for sample in 0..samples {
                orbit.states[sample].copy_from(&z);
                let (rate, jacobian) = orbit.rate(&mut runner, sample);
                step(&mut z, orbit.interval, &rate, &jacobian);
            }
            if is_closed(&before, &z, orbit.states.iter()) {
                break;
            }
        }
        orbit
    }

    /// The states by their numbers, `[sample]` each.
    pub(super) fn columns(&self) -> impl Iterator<Item = (usize, Vec<f64>)> + '_ {
        (0..self.part.states.count).map(|k| {
            let column = self.states.iter().map(|z| z[k]).collect();
            (self.part.states.first + k, column)
        })
    }

    /// Adds to `slopes`, `[signal][sample]`, those of a sum of states, `weights[state][sample]`.
    pub(super) fn pull_back(&self, weights: &[Vec<f64>], slopes: &mut [Vec<f64>]) {
        let (samples, count) = (self.states.len(), self.part.states.count);
        let mut runner = Runner::new(&self.part.states.program);
        let mut backward = Runner::new(&self.part.pullback);
        let mut by_state = DVector::zeros(count);
        let mut by_middle = vec![vec![0.0; samples]; slopes.len()];
        for _ in 0..ROUNDS {
            let before = by_state.clone();
            let mut largest: Vec<DVector<f64>> = Vec::with_capacity(samples);
            for sample in (0..samples).rev() {
                let (rate, jacobian) = self.rate(&mut runner, sample);
                let by_step = pull_back_step(self.interval, &rate, &jacobian, &by_state);
                backward.run(&|symbol| match symbol {
                    Symbol::Weight(output) => by_step[output],
                    other => self.signal(sample, other),
                });
                for (k, slopes) in by_middle.iter_mut().enumerate() {
                    slopes[sample] = backward.finite(k);
                }
                for k in 0..count {
                    by_state[k] += backward.finite(slopes.len() + k) + weights[k][sample];
                }
                largest.push(by_state.clone());
            }
            if is_closed(&before, &by_state, largest.iter()) {
                break;
            }
        }
        for (slopes, by_middle) in slopes.iter_mut().zip(&by_middle) {
            for (sample, slope) in by_middle.iter().enumerate() {
                slopes[sample] += 0.5 * slope;
                slopes[(sample + 1) % samples] += 0.5 * slope;
            }
        }
    }

    /// The rates and their slopes by the states, from a sample to the next.
    fn rate(&self, runner: &mut Runner<'_>, sample: usize) -> (DVector<f64>, DMatrix<f64>) {
        let count = self.part.states.count;
        runner.run(&|symbol| self.signal(sample, symbol));
        let output = |k: usize| runner.scratch.output(k);
        (
            DVector::from_fn(count, |row, _| output(row)),
            DMatrix::from_fn(count, count, |row, column| {
                output(count + row * count + column)
            }),
        )
    }

    fn signal(&self, sample: usize, symbol: Symbol) -> f64 {
        let dof = self.middles.len() / 3;
        match symbol {
            Symbol::Q(joint) => self.middles[joint][sample],
            Symbol::Dq(joint) => self.middles[dof + joint][sample],
            Symbol::Ddq(joint) => self.middles[2 * dof + joint][sample],
            Symbol::State(state) => self.states[sample][state - self.part.states.first],
            _ => unreachable!("the compiler keeps functions of the motion alone"),
        }
    }
}

/// Whether a round came back to where it began, beside the largest of what it came by.
fn is_closed<'z>(
    before: &DVector<f64>,
    after: &DVector<f64>,
    all: impl Iterator<Item = &'z DVector<f64>>,
) -> bool {
    let largest = all.map(DVector::amax).fold(0.0, f64::max);
    (after - before).amax() <= CLOSED * largest
}

/// Slopes of `by_after . z_after` by the rates and by the entries of their Jacobian, row by row: one run of dual numbers each.
fn pull_back_step(
    interval: f64,
    rate: &DVector<f64>,
    jacobian: &DMatrix<f64>,
    by_after: &DVector<f64>,
) -> Vec<f64> {
    let count = rate.len();
    let slope = |varied: usize| {
        let dual = |value: f64, place: usize| Dual {
            value,
            slope: if place == varied { 1.0 } else { 0.0 },
        };
        let rate = DVector::from_fn(count, |row, _| dual(rate[row], row));
        let jacobian = DMatrix::from_fn(count, count, |row, column| {
            dual(jacobian[(row, column)], count + row * count + column)
        });
        let mut after = DVector::from_element(count, Dual::of(0.0));
        step(&mut after, interval, &rate, &jacobian);
        let pairs = after.iter().zip(by_after.iter());
        pairs.map(|(after, by)| after.slope * by).sum()
    };
    (0..count + count * count).map(slope).collect()
}

/// A program that runs one sample at a time.
struct Runner<'a> {
    program: &'a Program,
    values: Vec<f64>,
    scratch: Scratch,
}

impl<'a> Runner<'a> {
    fn new(program: &'a Program) -> Self {
        Self {
            program,
            values: vec![0.0; program.symbols().len()],
            scratch: program.scratch(),
        }
    }

    fn run(&mut self, bind: &dyn Fn(Symbol) -> f64) {
        for (value, &symbol) in self.values.iter_mut().zip(self.program.symbols()) {
            *value = bind(symbol);
        }
        self.program.eval_in(&self.values, &mut self.scratch);
    }

    /// An output; 0 where it is no number, as the slope of a power at 0 is.
    fn finite(&self, output: usize) -> f64 {
        let value = self.scratch.output(output);
        if value.is_finite() { value } else { 0.0 }
    }
}

#[cfg(test)]
mod tests;

//! Internal states of effects along a motion that repeats, and slopes of what reads them.
//!
//! In: a motion over one period. Out: the states at each sample as they are once the motion has repeated for ever, by the steps of
//! [`robot_model::memory::step`] with signals at their middles; and, by the same steps backward, how a weighted sum of these states
//! changes with the motion.
//!
//! Where the period ends as it began is solved for: `z0 += (1 - M)^-1 (z_end - z0)`, with `M` the product of the steps' slopes, which
//! is exact where rates are affine in the states. Backward it is the same with `M^T`.

use nalgebra::{DMatrix, DVector};
use robot_model::memory::step;
use robot_model::scalar::{Dual, Scalar};
use robot_model_codegen::Remembering;
use robot_model_codegen::expr::Symbol;
use robot_model_codegen::interpreter::{Program, Scratch};

use super::states::fill;

/// Steps of a period, at least: between samples there are as many as that takes, so that a search on few samples sees what a
/// verification on many does.
const STEPS: usize = 2000;

/// Rounds after which a period is taken as it is.
const ROUNDS: usize = 20;

/// Difference from end to beginning that is none, as a share of the largest state.
const CLOSED: f64 = 1e-10;

/// Of what was different before a period, the share that is left after it where a state forgets.
const FORGETFUL: f64 = 1.0 - 1e-6;

/// The states of one effect along one period.
pub(super) struct Orbit<'a> {
    part: &'a Remembering,
    /// `q`, `dq` and `ddq` of all joints, `[signal][sample]`.
    signals: &'a [&'a [f64]],
    /// Steps from sample to sample.
    substeps: usize,
    /// Seconds of a step.
    interval: f64,
    /// Before each step, and after the last.
    states: Vec<DVector<f64>>,
    /// `M`
    round: DMatrix<f64>,
}

impl<'a> Orbit<'a> {
    /// `signals` are `q`, `dq` and `ddq` of all joints, as samples of a period of `period` seconds.
    pub(super) fn new(part: &'a Remembering, period: f64, signals: &'a [&'a [f64]]) -> Self {
        let samples = signals.first().map_or(0, |signal| signal.len());
        let substeps = STEPS.div_ceil(samples.max(1));
        let count = part.states.count;
        let steps = samples * substeps;
        let mut orbit = Self {
            part,
            signals,
            substeps,
            interval: period / steps as f64,
            states: vec![DVector::zeros(count); steps + 1],
            round: DMatrix::identity(count, count),
        };
        for _ in 0..ROUNDS {
            orbit.go_round();
            let missing = &orbit.states[steps] - &orbit.states[0];
            let largest = orbit.states.iter().map(DVector::amax).fold(0.0, f64::max);
            if missing.amax() <= CLOSED * largest {
                break;
            }
            let Some(change) = closing(&orbit.round, &missing) else {
                break;
            };
            orbit.states[0] += change;
        }
        orbit
    }

    /// Steps once round from the first state, and multiplies the slopes of the steps.
    fn go_round(&mut self) {
        let count = self.part.states.count;
        let mut runner = Runner::new(&self.part.states.program);
        self.round = DMatrix::identity(count, count);
        for k in 0..self.states.len() - 1 {
            let (rate, jacobian) = self.rate(&mut runner, k);
            let mut z = self.states[k].clone();
            step(&mut z, self.interval, &rate, &jacobian);
            self.states[k + 1] = z;
            // A change moves on as `dz/dt = J z`.
            for mut change in self.round.column_iter_mut() {
                let mut moved = change.clone_owned();
                step(&mut moved, self.interval, &(&jacobian * &change), &jacobian);
                change.copy_from(&moved);
            }
        }
    }

    /// Whether what is different before a round is less so after it.
    pub(super) fn settles(&self) -> bool {
        let values = self.round.complex_eigenvalues();
        values.iter().all(|value| value.norm() < FORGETFUL)
    }

    /// The number of its first state.
    pub(super) fn first_state(&self) -> usize {
        self.part.states.first
    }

    /// The states by their numbers, `[sample]` each.
    pub(super) fn columns(&self) -> impl Iterator<Item = (usize, Vec<f64>)> + '_ {
        (0..self.part.states.count).map(|k| {
            let at_samples = self.states.iter().step_by(self.substeps);
            let samples = self.states.len() / self.substeps;
            let column = at_samples.take(samples).map(|z| z[k]).collect();
            (self.part.states.first + k, column)
        })
    }

    /// Adds to `slopes`, `[signal][sample]`, those of a sum of states, `weights[state][sample]`.
    pub(super) fn pull_back(&self, weights: &[Vec<f64>], slopes: &mut [Vec<f64>]) {
        let mut by_end = DVector::zeros(self.part.states.count);
        let back = self.round.transpose();
        let mut added = self.go_back(weights, by_end.clone());
        for _ in 0..ROUNDS {
            let missing = &added.by_beginning - &by_end;
            if missing.amax() <= CLOSED * added.largest {
                break;
            }
            let Some(change) = closing(&back, &missing) else {
                break;
            };
            by_end += change;
            added = self.go_back(weights, by_end.clone());
        }
        for (slopes, added) in slopes.iter_mut().zip(added.slopes) {
            slopes.iter_mut().zip(added).for_each(|(s, x)| *s += x);
        }
    }

    /// Once round backward, from slopes by the last state.
    fn go_back(&self, weights: &[Vec<f64>], mut by_state: DVector<f64>) -> Round {
        let samples = self.states.len() / self.substeps;
        let mut runner = Runner::new(&self.part.states.program);
        let mut backward = Runner::new(&self.part.pullback);
        let mut slopes = vec![vec![0.0; samples]; self.signals.len()];
        let mut largest = by_state.amax();
        for k in (0..self.states.len() - 1).rev() {
            let (rate, jacobian) = self.rate(&mut runner, k);
            let by_step = pull_back_step(self.interval, &rate, &jacobian, &by_state);
            backward.run(&|symbol| match symbol {
                Symbol::Weight(output) => by_step[output],
                other => self.signal(k, other),
            });
            let (sample, share) = self.middle(k);
            for (number, slopes) in slopes.iter_mut().enumerate() {
                let slope = backward.finite(number);
                slopes[sample] += (1.0 - share) * slope;
                slopes[(sample + 1) % samples] += share * slope;
            }
            for state in 0..by_state.len() {
                by_state[state] += backward.finite(self.signals.len() + state);
                if k % self.substeps == 0 {
                    by_state[state] += weights[state][sample];
                }
            }
            largest = largest.max(by_state.amax());
        }
        Round {
            by_beginning: by_state,
            slopes,
            largest,
        }
    }

    /// The sample before a step's middle, and the share of the way to the next.
    fn middle(&self, k: usize) -> (usize, f64) {
        let share = ((k % self.substeps) as f64 + 0.5) / self.substeps as f64;
        (k / self.substeps, share)
    }

    /// The rates and their slopes by the states, at a step.
    fn rate(&self, runner: &mut Runner<'_>, k: usize) -> (DVector<f64>, DMatrix<f64>) {
        let count = self.part.states.count;
        runner.run(&|symbol| self.signal(k, symbol));
        let (mut rate, mut jacobian) = (DVector::zeros(count), DMatrix::zeros(count, count));
        fill(&mut rate, &mut jacobian, |output| {
            runner.scratch.output(output)
        });
        (rate, jacobian)
    }

    fn signal(&self, k: usize, symbol: Symbol) -> f64 {
        let dof = self.signals.len() / 3;
        let at = |signal: usize| {
            let (sample, share) = self.middle(k);
            let values = self.signals[signal];
            let (x, y) = (values[sample], values[(sample + 1) % values.len()]);
            x + share * (y - x)
        };
        match symbol {
            Symbol::Q(joint) => at(joint),
            Symbol::Dq(joint) => at(dof + joint),
            Symbol::Ddq(joint) => at(2 * dof + joint),
            Symbol::State(state) => self.states[k][state - self.part.states.first],
            _ => unreachable!("the compiler keeps functions of the motion alone"),
        }
    }
}

/// What a round backward found.
struct Round {
    by_beginning: DVector<f64>,
    /// `[signal][sample]`
    slopes: Vec<Vec<f64>>,
    /// Largest slope by a state on the way.
    largest: f64,
}

/// `(1 - M)^-1 missing`; none where a state never forgets, so that any is as good as another.
fn closing(round: &DMatrix<f64>, missing: &DVector<f64>) -> Option<DVector<f64>> {
    let count = missing.len();
    let change = (DMatrix::identity(count, count) - round)
        .lu()
        .solve(missing)?;
    change.iter().all(|x| x.is_finite()).then_some(change)
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

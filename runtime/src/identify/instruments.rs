//! Instrumental variables: equations multiplied with columns that the noise has no part in.
//!
//! Noise of positions is in the columns and, through the controller, in the torque: least squares is biased by what they share. With `Z`
//! the columns along the wanted motion, or along a simulated one, `Z' (tau - W beta) = 0` has no such bias. Durbin, Wu and Hausman
//! ask whether that matters: the difference to least squares has to stand out of its own deviation.
//!
//! Source: Janot, Vandanjon, Gautier 2014, A generic instrumental variable approach for industrial robot identification; Brunot 2017,
//! who has the wanted motion for an instrument; Hausman 1978, Specification tests in econometrics. The deviation of the difference is
//! taken from its own series, which is correlated as it may be, in place of the difference of two variances.

use std::fmt;

use faer::Mat;
use faer::linalg::solvers::Solve;
use statrs::function::erf::erfc;

use super::combination::shared;
use super::estimate::Identified;
use super::hac::{Rows, weighed};
use super::least_squares::{Excited, Factors, Solution, condition};
use super::stack::Stack;
use super::{Identify, IdentifyError, Weights, robust, turns};
use crate::columns::Arm;
use crate::log::Log;
use crate::signal::Prepared;
use crate::simulate::Trajectory;

/// Both estimates are one where they differ by less than this share of their deviation.
const ROUNDING: f64 = 1e-7;

/// Share of a joint's motion within which positions are the same, written with fewer digits.
const SAME: f64 = 1e-6;

/// Mean square of positions, rad^2 or m^2, below which a joint stands.
const STILL: f64 = 1e-18;

/// The comparison with least squares.
///
/// # Examples
/// An encoder with noise, and the wanted motion, which has none:
/// ```
/// # mod pendulum { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/doc/pendulum.rs")); }
/// # use pendulum::{measure, pendulum};
/// use robot_model::{identify::{Identify, Method}, signal::Bands, simulate::Trajectory};
/// let mut log = measure(0.0);
/// let wanted = Trajectory::new(log.time.clone(), log.q.clone(), vec![], vec![], vec![]).expect("rising times");
/// for (k, q) in log.q[0].iter_mut().enumerate() {
///     *q += 2e-3 * (12.9898 * (k * k) as f64).sin();
/// }
/// let bands = Some(Bands::for_log(&log)); // wide ones, that let the noise pass
/// let identify = Identify { method: Method::Instrumental, instruments: vec![wanted], bands, ..Identify::default() };
/// let estimate = identify.fit(&pendulum(), &[log])?;
/// let hausman = estimate.hausman.as_ref().expect("instruments were taken");
/// // Noise makes the inertia of 2 kg m^2 smaller in least squares.
/// assert!(hausman.least_squares[0] < 1.96 && hausman.probability < 0.05);
/// assert!((estimate.values()[0] - 2.0).abs() < 0.02);
/// # Ok::<(), robot_model::identify::IdentifyError>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct Hausman {
    /// What least squares says, one an unknown, in the arm's order; 0 where it has no value.
    pub least_squares: Vec<f64>,
    /// What least squares leaves of each joint's torque, `100 || residual || / || tau ||`. The instrumental estimate leaves the noise of
    /// the columns besides.
    pub least_squares_percent: Vec<f64>,
    /// Difference of both estimates over its standard deviation, one an unknown.
    pub differences: Vec<f64>,
    /// Whether both tell a value of an unknown, and not only a sum with others; the others have no difference.
    pub compared: Vec<bool>,
    /// Probability of a difference like the largest one, anywhere, if least squares has no bias (Bonferroni).
    pub probability: f64,
}

impl Hausman {
    /// A test at 5 %.
    const LEVEL: f64 = 0.05;

    /// A difference below this share of an estimate's own deviation changes nothing that one would say of it.
    const LITTLE: f64 = 0.5;

    pub(super) fn tell(
        &self,
        f: &mut fmt::Formatter<'_>,
        parameters: &[Identified],
    ) -> fmt::Result {
        match self.verdict(parameters) {
            Some(verdict) => writeln!(f, "Durbin, Wu, Hausman: {verdict}"),
            None => Ok(()),
        }
    }

    fn verdict(&self, parameters: &[Identified]) -> Option<String> {
        let differences = self.differences.iter().enumerate();
        let differences = differences.filter(|(k, _)| self.compared[*k]);
        let (most, difference) = differences.max_by(|a, b| a.1.abs().total_cmp(&b.1.abs()))?;
        let of_own = |k: usize| {
            let found = &parameters[k];
            let share = (found.value - self.least_squares[k]).abs() / found.std;
            if self.compared[k] && share.is_finite() {
                share
            } else {
                0.0
            }
        };
        let largest = (0..parameters.len()).map(of_own).fold(0.0, f64::max);
        let verdict = if self.probability >= Self::LEVEL {
            "least squares and instruments agree"
        } else if largest < Self::LITTLE {
            "they differ significantly, but by less than half a standard deviation of any estimate, which is harmless"
        } else {
            "they disagree, so noisy columns bias least squares, or the model lacks an effect"
        };
        Some(format!(
            "{verdict}; {} differs most, by {:.1} standard deviations of the difference (p = {:.2} over all parameters) and {:.2} of its own",
            parameters[most].name,
            difference.abs(),
            self.probability,
            of_own(most)
        ))
    }
}

impl Identify {
    /// The motions of the instruments at the samples of the logs.
    pub(super) fn wanted(&self, logs: &[Log]) -> Result<Vec<Log>, IdentifyError> {
        if self.instruments.len() != logs.len() {
            return Err(IdentifyError::Instruments {
                instruments: self.instruments.len(),
                logs: logs.len(),
            });
        }
        let pairs = logs.iter().zip(&self.instruments);
        pairs
            .map(|(log, reference)| wanted(log, reference))
            .collect()
    }
}

/// The log's motion as a reference has it, at the same samples. What reads the measured torque has no other.
fn wanted(log: &Log, reference: &Trajectory) -> Result<Log, IdentifyError> {
    let source_name = log.source.clone();
    if reference.dof() != log.dof() {
        return Err(IdentifyError::Joints {
            source_name,
            log: reference.dof(),
            arm: log.dof(),
        });
    }
    let start = log.time.first().copied().unwrap_or_default();
    let step = 1.0 / log.rate_hz();
    let lasts = log.time.last().map_or(0.0, |last| last - start);
    if reference.duration() < lasts - 1.5 * step {
        return Err(IdentifyError::ShortReference {
            source_name,
            log: lasts,
            reference: reference.duration(),
        });
    }
    if let Some([from, to]) = reference.hole() {
        return Err(IdentifyError::HoleInReference {
            source_name,
            from,
            to,
        });
    }
    let mut wanted = log.clone();
    for (k, time) in log.time.iter().enumerate() {
        let at = reference.at((time - start).min(reference.duration()));
        for joint in 0..log.dof() {
            wanted.q[joint][k] = at.q[joint];
        }
    }
    if is_same_motion(&log.q, &wanted.q) {
        return Err(IdentifyError::OwnReference { source_name });
    }
    // Velocities are those of the positions, by the same filters as the log's own.
    wanted.dq.clear();
    Ok(wanted)
}

/// Whether all joints that move have the same positions.
fn is_same_motion(one: &[Vec<f64>], other: &[Vec<f64>]) -> bool {
    let mean = |values: &mut dyn Iterator<Item = f64>, count: usize| -> f64 {
        values.sum::<f64>() / count.max(1) as f64
    };
    // Whether a joint that moves has the same positions.
    let is_same = |(one, other): (&Vec<f64>, &Vec<f64>)| {
        let middle = mean(&mut one.iter().copied(), one.len());
        let moves = mean(&mut one.iter().map(|q| (q - middle).powi(2)), one.len());
        let pairs = one.iter().zip(other);
        let apart = mean(&mut pairs.map(|(q, p)| (q - p).powi(2)), one.len());
        (moves > STILL).then_some(apart <= SAME.powi(2) * moves)
    };
    let found: Vec<bool> = one.iter().zip(other).filter_map(is_same).collect();
    !found.is_empty() && found.iter().all(|is_same| *is_same)
}

/// Columns along motions without noise, with the rows at their turns.
pub(super) fn rows(arm: &dyn Arm, wanted: &[Prepared], shapes: &[f64]) -> Stack {
    let mut stack = Stack::new(arm, wanted, shapes);
    turns::find(&mut stack, arm, wanted);
    stack
}

/// Both stacks without the rows that turns of dry joints in either motion reach: there the wanted motion has another direction than the
/// measured one, which is no noise of columns.
pub(super) fn without_turns(stack: &Stack, instruments: &Stack) -> [Stack; 2] {
    let mut turns = stack.turns.clone();
    for (own, wanted) in turns.iter_mut().zip(&instruments.turns) {
        own.extend(wanted);
        own.sort_unstable();
        own.dedup();
    }
    [stack, instruments].map(|stack| {
        let mut rest = stack.clone();
        rest.turns.clone_from(&turns);
        turns::leave_out(&mut rest);
        rest
    })
}

/// Puts the instrumental estimate in the place of least squares', with its deviations.
pub(super) fn make(
    solution: &mut Solution,
    stack: &Stack,
    instruments: &Stack,
    weights: Weights,
) -> Result<Hausman, IdentifyError> {
    let ordinary = solution.clone();
    let (factors, clean_factors) = (Factors::new(stack), Factors::new(instruments));
    let ones = robust::of_all(stack);
    let rounds = weights.rounds();
    let mut influence = None;
    for round in 1..=rounds {
        let scale = &solution.scale;
        let clean = clean_factors.stacked(scale);
        let n = stack.unknowns.len();
        let excited = Excited::new(&clean, n).columns;
        let silent = excited_by_one(&excited, &ordinary.unexcited, n);
        // What instruments tell of these is in sums of them with others.
        let told = (0..n).filter(|c| silent.binary_search(c).is_err());
        let told = Excited::of(&clean, n, told.collect());
        solution.shared = shared(&clean, &told, &silent);
        if silent.len() == n {
            return Err(IdentifyError::NothingExcited { unknowns: n });
        }
        let (z, w) = (
            Rows::new(instruments, &silent, scale),
            Rows::new(stack, &silent, scale),
        );
        let target: Vec<Vec<f64>> = stack
            .joints
            .iter()
            .map(|rows| rows.target.clone())
            .collect();
        let target = weighed(target, scale, &ones);
        let (found, condition) = solve(&z, &w, &target);
        solution.condition = condition;
        solution.estimate.fill(0.0);
        for (k, &c) in w.excited.iter().enumerate() {
            solution.estimate[c] = found[k] / w.length[k];
        }
        solution.unexcited = silent;
        solution.sigma = factors.sigma(&solution.estimate, w.excited.len());
        if round == rounds {
            let residuals = weighed(stack.residuals(&solution.estimate), scale, &ones);
            // In units of the columns' lengths, as the deviations of least squares are.
            let bread = z.product(&w);
            let series = z.influence(&residuals, &bread);
            let steady = z.steady(&w, &residuals, &bread);
            solution.std = w.deviations(&series, Some(&steady));
            influence = Some((series, w));
        }
        if weights == Weights::Residual {
            solution.scale.clone_from(&solution.sigma);
        }
    }
    let (series, rows) = influence.ok_or(IdentifyError::NoLog)?;
    Ok(compare(stack, &ordinary, solution, &series, &rows))
}

/// Unknowns that either set of columns does not excite, ascending.
fn excited_by_one(excited: &[usize], unexcited: &[usize], n: usize) -> Vec<usize> {
    let is_out =
        |c: &usize| excited.binary_search(c).is_err() || unexcited.binary_search(c).is_ok();
    (0..n).filter(is_out).collect()
}

/// `(Z'W)^-1 Z'b` by an orthogonal basis of `Z`, so that no column is squared; how well the instruments tell the columns apart.
fn solve(z: &Rows, w: &Rows, target: &[Vec<f64>]) -> (Vec<f64>, f64) {
    let stacked = |rows: &[Mat<f64>]| -> Mat<f64> {
        let samples = rows.first().map_or(0, Mat::nrows);
        let columns = rows.first().map_or(0, Mat::ncols);
        Mat::from_fn(samples * rows.len(), columns, |row, c| {
            rows[row / samples][(row % samples, c)]
        })
    };
    let basis = stacked(&z.joints).qr().compute_thin_Q();
    let right = Mat::from_fn(basis.nrows(), 1, |row, _| {
        let samples = target[0].len();
        target[row / samples][row % samples]
    });
    let projected = basis.transpose() * stacked(&w.joints);
    let condition = condition(&projected);
    let solved = projected.partial_piv_lu().solve(basis.transpose() * right);
    (solved.col(0).iter().copied().collect(), condition)
}

fn compare(
    stack: &Stack,
    ordinary: &Solution,
    found: &Solution,
    series: &Mat<f64>,
    rows: &Rows,
) -> Hausman {
    let own = Rows::new(stack, &ordinary.unexcited, &ordinary.scale);
    let ones = robust::of_all(stack);
    let residuals = weighed(stack.residuals(&ordinary.estimate), &ordinary.scale, &ones);
    let influence = own.influence(&residuals, &own.product(&own));
    // A value of its own by both, where they are to be compared.
    let is_compared = |c: usize| ordinary.is_told(c) && found.is_told(c);
    // Both in units of the instrumental rows' columns.
    let difference = Mat::from_fn(series.nrows(), series.ncols(), |row, k| {
        match own.excited.binary_search(&rows.excited[k]) {
            Ok(place) => {
                series[(row, k)] - influence[(row, place)] * rows.length[k] / own.length[place]
            }
            Err(_) => 0.0,
        }
    });
    let deviations = rows.deviations(&difference, None);
    let pairs = found.estimate.iter().zip(&ordinary.estimate);
    // What rounding leaves of both is no difference.
    let differences: Vec<f64> = pairs
        .zip(deviations.iter().zip(&found.std))
        .enumerate()
        .map(|(c, ((one, other), (std, own)))| {
            if is_compared(c) && (one - other).abs() > ROUNDING * own {
                (one - other) / std.max(ROUNDING * own)
            } else {
                0.0
            }
        })
        .collect();
    let largest = differences.iter().map(|x| x.abs()).fold(0.0, f64::max);
    let count = (0..differences.len()).filter(|c| is_compared(*c)).count() as f64;
    Hausman {
        least_squares_percent: stack.relative_percent(&ordinary.estimate),
        least_squares: ordinary.estimate.clone(),
        differences,
        probability: (count * erfc(largest / std::f64::consts::SQRT_2)).min(1.0),
        compared: (0..ordinary.estimate.len()).map(is_compared).collect(),
    }
}

#[cfg(test)]
mod tests;

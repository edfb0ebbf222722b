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

use super::estimate::Identified;
use super::hac::{Rows, weighed};
use super::least_squares::{Excited, Factors, Solution};
use super::stack::Stack;
use super::{IdentifyError, Weights, robust, turns};
use crate::log::Log;
use crate::simulate::Trajectory;

/// Rounds of weights, as for least squares.
const REWEIGHTINGS: usize = 5;

/// Both estimates are one where they differ by less than this share of their deviation.
const ROUNDING: f64 = 1e-7;

/// The comparison with least squares.
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
    /// Probability of a difference like the largest one, anywhere, if least squares has no bias (Bonferroni).
    pub probability: f64,
}

impl Hausman {
    /// A test at 5 %.
    const LEVEL: f64 = 0.05;

    pub(super) fn tell(
        &self,
        f: &mut fmt::Formatter<'_>,
        parameters: &[Identified],
    ) -> fmt::Result {
        let pairs = parameters.iter().zip(&self.differences);
        let largest = pairs.max_by(|a, b| a.1.abs().total_cmp(&b.1.abs()));
        let Some((parameter, difference)) = largest else {
            return Ok(());
        };
        let verdict = if self.probability < Self::LEVEL {
            "they disagree, so columns have noise that least squares takes for motion, or the model lacks something"
        } else {
            "least squares and instruments agree"
        };
        writeln!(
            f,
            "Durbin, Wu, Hausman: {verdict}; {} differs most, by {:.1} deviations of the difference (p = {:.2} over all parameters)",
            parameter.name,
            difference.abs(),
            self.probability
        )
    }
}

/// The log's motion as a reference has it, at the same samples. What reads the measured torque has no other.
pub(super) fn wanted(log: &Log, reference: &Trajectory) -> Result<Log, IdentifyError> {
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
    let mut wanted = log.clone();
    for (k, time) in log.time.iter().enumerate() {
        let at = reference.at((time - start).min(reference.duration()));
        for joint in 0..log.dof() {
            wanted.q[joint][k] = at.q[joint];
        }
    }
    // Velocities are those of the positions, by the same filters as the log's own.
    wanted.dq.clear();
    Ok(wanted)
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
    let factors = Factors::new(stack);
    let rounds = match weights {
        Weights::Residual => REWEIGHTINGS,
        Weights::TorqueNorm | Weights::MaxTorque => 1,
    };
    let mut influence = None;
    for _ in 0..rounds {
        let scale = &solution.scale;
        let clean = Factors::new(instruments).stacked(scale);
        let n = stack.unknowns.len();
        let excited = Excited::new(&clean, n).columns;
        let silent = excited_by_one(&excited, &ordinary.unexcited, n);
        if silent.len() == n {
            return Err(IdentifyError::NothingExcited { unknowns: n });
        }
        let (z, w) = (
            Rows::new(instruments, &silent, scale),
            Rows::new(stack, &silent, scale),
        );
        let ones = robust::of_all(stack);
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
        let residuals = weighed(stack.residuals(&solution.estimate), scale, &ones);
        // In units of the columns' lengths, as the deviations of least squares are.
        let bread = z.product(&w);
        let series = z.influence(&residuals, &bread);
        let steady = z.steady(&w, &residuals, &bread);
        solution.std = w.deviations(&series, Some(&steady));
        solution.unexcited = silent;
        solution.sigma = factors.sigma(&solution.estimate, w.excited.len());
        influence = Some((series, w));
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
    let condition = match projected.singular_values() {
        Ok(values) => values
            .first()
            .zip(values.last())
            .map_or(f64::INFINITY, |(most, least)| most / least),
        Err(_) => f64::INFINITY,
    };
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
    let own = Rows::new(stack, &found.unexcited, &ordinary.scale);
    let ones = robust::of_all(stack);
    let residuals = weighed(stack.residuals(&ordinary.estimate), &ordinary.scale, &ones);
    let mut difference = own.influence(&residuals, &own.product(&own));
    // Both in units of the instrumental rows' columns.
    for k in 0..difference.ncols() {
        let unit = rows.length[k] / own.length[k];
        let values = difference.col_mut(k).iter_mut();
        values
            .zip(series.col(k).iter())
            .for_each(|(x, y)| *x = y - *x * unit);
    }
    let deviations = rows.deviations(&difference, None);
    let pairs = found.estimate.iter().zip(&ordinary.estimate);
    // What rounding leaves of both is no difference.
    let differences: Vec<f64> = pairs
        .zip(deviations.iter().zip(&found.std))
        .map(|((one, other), (std, own))| {
            if (one - other).abs() > ROUNDING * own {
                (one - other) / std.max(ROUNDING * own)
            } else {
                0.0
            }
        })
        .collect();
    let largest = differences.iter().map(|x| x.abs()).fold(0.0, f64::max);
    let count = rows.excited.len() as f64;
    Hausman {
        least_squares_percent: stack.relative_percent(&ordinary.estimate),
        least_squares: ordinary.estimate.clone(),
        differences,
        probability: (count * erfc(largest / std::f64::consts::SQRT_2)).min(1.0),
    }
}

#[cfg(test)]
mod tests {
    use rand::SeedableRng;
    use rand_chacha::ChaCha8Rng;
    use rand_distr::{Distribution, StandardNormal};

    use super::*;
    use crate::columns::Unknown;
    use crate::identify::{Identify, JointRows, Segment};

    const TRUTH: f64 = 2.0;

    /// Columns with noise of which the torque has a share, as behind a controller; and the columns without.
    fn stacks(seed: u64, share: f64) -> [Stack; 2] {
        let mut random = ChaCha8Rng::seed_from_u64(seed);
        let mut normal = move || -> f64 { StandardNormal.sample(&mut random) };
        let clean: Vec<f64> = (0..800)
            .map(|k| 1.5 * (0.05 * f64::from(k)).sin())
            .collect();
        let noise: Vec<f64> = clean.iter().map(|_| 0.5 * normal()).collect();
        let target: Vec<f64> = (0..clean.len())
            .map(|k| TRUTH * clean[k] + share * noise[k] + 0.3 * normal())
            .collect();
        let worn = clean.iter().zip(&noise).map(|(x, e)| x + share.abs() * e);
        let worn: Vec<f64> = worn.collect();
        [worn, clean].map(|column| Stack {
            turns: Vec::new(),
            clipped: Vec::new(),
            unknowns: vec![Unknown {
                name: "x".to_owned(),
                nonnegative: false,
            }],
            joints: vec![JointRows {
                tau: target.clone(),
                target: target.clone(),
                columns: vec![(0, column)],
            }],
            segments: vec![Segment {
                start: 0,
                time: Vec::new(),
            }],
        })
    }

    fn fit(seed: u64, share: f64) -> (Solution, Hausman) {
        let [worn, clean] = stacks(seed, share);
        let mut solution = Identify::default().solve_stack(&worn).expect("samples");
        let hausman = make(&mut solution, &worn, &clean, Weights::Residual).expect("excited");
        (solution, hausman)
    }

    #[test]
    fn noise_that_columns_share_with_torque_biases_least_squares_alone() {
        const DRAWS: u32 = 200;
        let (mut mean, mut ordinary, mut errors, mut told) = (0.0, 0.0, 0.0, 0.0);
        for seed in 0..DRAWS {
            let (solution, hausman) = fit(u64::from(seed), -1.0);
            let draws = f64::from(DRAWS);
            mean += solution.estimate[0] / draws;
            ordinary += hausman.least_squares[0] / draws;
            errors += (solution.estimate[0] - TRUTH).powi(2) / draws;
            told += solution.std[0].powi(2) / draws;
            assert!(hausman.probability < 0.05, "{hausman:?}");
        }
        assert!((mean - TRUTH).abs() < 0.01, "{mean}");
        assert!(ordinary < TRUTH - 0.3, "{ordinary}");
        assert!(
            ((told / errors).sqrt() - 1.0).abs() < 0.12,
            "{told} {errors}"
        );
    }

    /// Exact columns, instruments that follow them from afar.
    #[test]
    fn without_noise_in_columns_the_test_is_wrong_in_five_of_a_hundred() {
        let mut wrong = 0;
        for seed in 0..400 {
            let [mut exact, clean] = stacks(seed, 0.0);
            let mut random = ChaCha8Rng::seed_from_u64(1000 + seed);
            let mut instruments = clean.clone();
            for (k, x) in instruments.joints[0].columns[0].1.iter_mut().enumerate() {
                let other: f64 = StandardNormal.sample(&mut random);
                *x += (0.31 * k as f64).sin() + other;
            }
            exact.joints[0].columns.clone_from(&clean.joints[0].columns);
            let mut solution = Identify::default().solve_stack(&exact).expect("samples");
            let hausman = make(&mut solution, &exact, &instruments, Weights::Residual);
            wrong += u32::from(hausman.expect("excited").probability < 0.05);
        }
        assert!((8..36).contains(&wrong), "{wrong}");
    }

    #[test]
    fn columns_that_are_their_own_instruments_agree_with_themselves() {
        for seed in 0..50 {
            let (solution, hausman) = fit(seed, 0.0);
            assert!((solution.estimate[0] - hausman.least_squares[0]).abs() < 1e-12);
            assert!(hausman.probability > 0.999, "{hausman:?}");
        }
    }
}

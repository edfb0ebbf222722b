//! Descent inside the limits: a Newton method in which the curvature of the barrier of position, velocity and acceleration is exact, and
//! that of the rest is learned from its slopes.

use faer::linalg::solvers::Solve;
use faer::{Mat, Side};

use super::problem::{Point, Problem, Stage};

/// Largest part of the way to a limit that a step goes.
const TO_THE_LIMIT: f64 = 0.95;

/// Decrease of a step, relative to what its slope promises, below which it is halved.
const ENOUGH: f64 = 1e-4;

/// Halvings before a step is given up.
const HALVINGS: usize = 30;

/// Promised decrease at which a stage is done: values are logarithms.
const DONE: f64 = 1e-6;

/// Asked now and then whether to go on.
pub(super) type GoOn<'a> = &'a dyn Fn() -> bool;

/// Descends from `z`, which is inside the limits, in at most `steps` steps.
pub(super) fn descend(
    problem: &Problem<'_>,
    z: &mut Vec<f64>,
    stage: Stage,
    steps: usize,
    go_on: GoOn<'_>,
) {
    let Some(mut point) = problem.evaluate(z, stage) else {
        return;
    };
    let n = z.len();
    let mut learned = Mat::<f64>::identity(n, n) * faer::Scale(initial_curvature(problem, &point));
    for _ in 0..steps {
        if !go_on() {
            return;
        }
        let slopes = point.slopes();
        let Some(direction) = newton(problem, &learned, &point, &slopes) else {
            return;
        };
        let promised: f64 = -slopes
            .iter()
            .zip(&direction)
            .map(|(s, d)| s * d)
            .sum::<f64>();
        if promised.is_nan() || promised <= DONE {
            return;
        }
        let Some((next_z, next)) = line_search(problem, z, &direction, &point, promised, stage)
        else {
            return;
        };
        let step: Vec<f64> = next_z.iter().zip(&*z).map(|(x, y)| x - y).collect();
        let change = next.smooth_slopes.iter().zip(&point.smooth_slopes);
        let change: Vec<f64> = change.map(|(x, y)| x - y).collect();
        learn(&mut learned, &step, &change);
        *z = next_z;
        point = next;
    }
}

/// What the criterion's curvature is taken for before anything is known: as large as the barrier's is on average.
fn initial_curvature(problem: &Problem<'_>, point: &Point) -> f64 {
    let traces = point.barrier_curvature.iter();
    let trace: f64 = traces
        .map(|block| (0..block.nrows()).map(|k| block[(k, k)]).sum::<f64>())
        .sum();
    (trace / problem.len() as f64).max(f64::MIN_POSITIVE)
}

/// The solution of `(learned + barrier) direction = -slopes`.
fn newton(
    problem: &Problem<'_>,
    learned: &Mat<f64>,
    point: &Point,
    slopes: &[f64],
) -> Option<Vec<f64>> {
    let mut matrix = learned.clone();
    for ((_, range), block) in problem.parts().zip(&point.barrier_curvature) {
        for (i, row) in range.clone().enumerate() {
            for (k, column) in range.clone().enumerate() {
                matrix[(row, column)] += block[(i, k)];
            }
        }
    }
    let right = Mat::from_fn(slopes.len(), 1, |k, _| -slopes[k]);
    let solution = matrix.llt(Side::Lower).ok()?.solve(&right);
    Some((0..slopes.len()).map(|k| solution[(k, 0)]).collect())
}

fn line_search(
    problem: &Problem<'_>,
    z: &[f64],
    direction: &[f64],
    point: &Point,
    promised: f64,
    stage: Stage,
) -> Option<(Vec<f64>, Point)> {
    let (motion, here) = (problem.motion(z), problem.motion(&vec![0.0; z.len()]));
    let mut step = problem.motion(direction);
    // A direction has no mean that is added.
    for (step, here) in [
        (&mut step.q, &here.q),
        (&mut step.dq, &here.dq),
        (&mut step.ddq, &here.ddq),
    ] {
        for (step, here) in step.iter_mut().zip(here) {
            step.iter_mut().zip(here).for_each(|(s, h)| *s -= h);
        }
    }
    let mut length = (TO_THE_LIMIT * problem.room(&motion, &step)).min(1.0);
    for _ in 0..HALVINGS {
        let trial: Vec<f64> = z
            .iter()
            .zip(direction)
            .map(|(z, d)| z + length * d)
            .collect();
        if let Some(next) = problem.evaluate(&trial, stage)
            && next.value() <= point.value() - ENOUGH * length * promised
        {
            return Some((trial, next));
        }
        length *= 0.5;
    }
    None
}

/// Broyden, Fletcher, Goldfarb and Shanno's update, damped after Powell so that the curvature stays positive.
fn learn(curvature: &mut Mat<f64>, step: &[f64], change: &[f64]) {
    let n = step.len();
    let image: Vec<f64> = (0..n)
        .map(|i| (0..n).map(|k| curvature[(i, k)] * step[k]).sum())
        .collect();
    let bent: f64 = step.iter().zip(&image).map(|(s, b)| s * b).sum();
    let seen: f64 = step.iter().zip(change).map(|(s, y)| s * y).sum();
    if bent.is_nan() || bent <= 0.0 {
        return;
    }
    let keep = if seen < 0.2 * bent {
        0.8 * bent / (bent - seen)
    } else {
        1.0
    };
    let change: Vec<f64> = change
        .iter()
        .zip(&image)
        .map(|(y, b)| keep * y + (1.0 - keep) * b)
        .collect();
    let seen: f64 = step.iter().zip(&change).map(|(s, y)| s * y).sum();
    for i in 0..n {
        for k in 0..n {
            curvature[(i, k)] += change[i] * change[k] / seen - image[i] * image[k] / bent;
        }
    }
}

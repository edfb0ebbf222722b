//! The search for the least cost: Levenberg's and Marquardt's, or within a trust region, both with bounds.
//!
//! In each step starts of windows follow the parameters (their equations are eliminated by orthogonal factors), and the parameters solve
//! `min |z + R d|` with what keeps them near: `lambda |D d|^2`, or `|D d| <= Delta`.
//!
//! Sources: Marquardt 1963; More 1978 for the scales `D`; for the trust region Algorithm 1 of Trojanova, Cakurda, Hosovsky, Krenicky, on
//! gravity tests of a pneumatic arm, with its constants `0, 2, 0.25, 0.25, 0.5`, where the radius shrinks to `0.25 |D d|` of the step (the
//! paper prints the gradient's length).

use nalgebra::{DMatrix, DVector};

use super::equations::{Equations, Reduced, triangle};
use super::identifiable::audible;
use super::problem::{Place, Problem};
use super::run::{Asked, Run};
use crate::simulate::{Adjustable, SimulateError};

/// Iterations at most of a search that is to end.
pub(super) const MOST: usize = 100;

/// Least damping, of columns of length one: directions that outputs do not answer to are left alone.
const LEAST: f64 = 1e-10;

/// Shares of the cost and of the parameters that are no progress.
const STILL: f64 = 1e-10;
const NO_STEP: f64 = 1e-9;

/// Of deviations, as white noise with the size of the errors makes them: shorter steps of the parameters are none, where twice in a row they
/// lower the cost by less than this share. A cost with turns of dry friction in it has edges along which a search creeps for ever.
const WITHIN_NOISE: f64 = 0.01;
const LITTLE: f64 = 1e-5;
const IN_A_ROW: usize = 2;

/// The same of a search from whose end another goes on.
const ROUGH: f64 = 1e-3;

/// How near to the least cost a search has to come.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum End {
    /// As near as the noise lets it.
    Fine,
    /// Into its valley: another search, of other windows or weights, goes on from there.
    Rough,
}

/// Who looks for the least cost.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Search {
    /// Levenberg and Marquardt: damped Gauss-Newton steps.
    #[default]
    LevenbergMarquardt,
    /// Gauss-Newton steps within a radius that follows how well the last step was foretold.
    TrustRegion,
}

/// A place on the way of a search.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct Iterate {
    /// Part of the search, from 0: costs of different parts are of other windows, or of joints that are weighed otherwise.
    pub stage: usize,
    /// `J`
    pub cost: f64,
    /// Parameters.
    pub values: Vec<f64>,
    /// Damping of the next step, or radius of the trust region.
    pub control: f64,
    /// Simulations of all logs so far.
    pub simulations: usize,
}

/// A step of parameters and of the starts of windows.
struct Step {
    parameters: DVector<f64>,
    starts: Vec<DVector<f64>>,
    /// By how much it is foretold to lower the cost, and its length in units of columns.
    predicted: f64,
    length: f64,
}

/// How far parameters may go from where they are.
struct Room<'a> {
    values: &'a [f64],
    bounds: &'a [[f64; 2]],
    /// Lengths of their columns, 0 where they do nothing.
    scale: &'a DVector<f64>,
}

impl Room<'_> {
    /// The step of least `|z + R d|^2 + lambda |D d|^2` that stays within the bounds: parameters that would leave them are set there,
    /// the others again.
    fn parameters(&self, reduced: &Reduced, lambda: f64) -> DVector<f64> {
        let unknowns = self.values.len();
        let mut step = DVector::zeros(unknowns);
        let mut free: Vec<usize> = (0..unknowns)
            .filter(|&k| self.bounds[k][0] < self.bounds[k][1] && self.scale[k] > 0.0)
            .collect();
        while !free.is_empty() {
            let count = free.len();
            let mut rows = DMatrix::zeros(unknowns + count, count + 1);
            let right = &reduced.z + &reduced.r * &step;
            for (place, &k) in free.iter().enumerate() {
                rows.view_mut((0, place), (unknowns, 1))
                    .copy_from(&reduced.r.column(k));
                rows[(unknowns + place, place)] = lambda.sqrt() * self.scale[k];
            }
            rows.view_mut((0, count), (unknowns, 1)).copy_from(&right);
            let rows = triangle(rows);
            let r = rows.view((0, 0), (count, count)).into_owned();
            let z: DVector<f64> = -rows.view((0, count), (count, 1)).column(0);
            let Some(found) = r.solve_upper_triangular(&z) else {
                return step;
            };
            let mut stays = Vec::new();
            for (&k, &change) in free.iter().zip(found.iter()) {
                let [low, high] = self.bounds[k];
                let value = self.values[k] + change;
                if value < low || value > high {
                    step[k] = value.clamp(low, high) - self.values[k];
                } else {
                    stays.push((k, change));
                }
            }
            if stays.len() == count {
                for (k, change) in stays {
                    step[k] = change;
                }
                return step;
            }
            free = stays.into_iter().map(|(k, _)| k).collect();
        }
        step
    }

    /// The same with the starts, damped alike.
    fn damped(&self, equations: &Equations, lambda: f64) -> Step {
        let reduced = equations.reduced(lambda);
        let parameters = self.parameters(&reduced, lambda);
        let starts = reduced.starts.iter();
        let starts: Vec<DVector<f64>> = starts.map(|start| start.step(&parameters)).collect();
        let (predicted, square) = equations.foretold(&parameters, &starts);
        let own = parameters.component_mul(self.scale).norm_squared();
        Step {
            parameters,
            starts,
            predicted,
            length: (own + square).sqrt(),
        }
    }

    /// The longest of them within a radius.
    fn within(&self, equations: &Equations, radius: f64) -> Step {
        let step = self.damped(equations, LEAST);
        if step.length <= radius {
            return step;
        }
        let (mut low, mut high) = (LEAST.ln(), 1e12_f64.ln());
        for _ in 0..40 {
            let middle = 0.5 * (low + high);
            if self.damped(equations, middle.exp()).length > radius {
                low = middle;
            } else {
                high = middle;
            }
        }
        self.damped(equations, high.exp())
    }
}

/// Lengths of columns so far, 0 where all of a parameter is nothing beside the largest of the others.
fn scales(now: &DMatrix<f64>, before: &DVector<f64>, values: &[f64]) -> DVector<f64> {
    let lengths = now.column_iter().map(|column| column.norm());
    let lengths: Vec<f64> = lengths
        .zip(before.iter())
        .map(|(now, before)| now.max(*before))
        .collect();
    DVector::from_vec(audible(&lengths, values))
}

/// How a search ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Ending {
    /// No step lowers the cost any more.
    Converged,
    /// It ran out of iterations: it is on its way.
    OutOfIterations,
}

/// Runs with slopes, and how the search that led there ended.
pub(super) type Found = (Vec<Run>, Ending);

/// Moves a place to where the cost is least, from runs of it without slopes on.
pub(super) fn search<P: Adjustable + Clone + Sync>(
    search: Search,
    problem: &mut Problem<'_, P>,
    place: &mut Place,
    runs: &[Run],
    bounds: &[[f64; 2]],
    iterates: &mut Vec<Iterate>,
    progress: &mut dyn FnMut(&Iterate),
) -> Result<Found, (usize, SimulateError)> {
    let mut cost = problem.cost(runs);
    let last = iterates.last();
    let (mut simulations, stage) =
        last.map_or((1, 0), |iterate| (iterate.simulations, iterate.stage + 1));
    let mut best = problem.run(place, Asked::Slopes)?;
    let mut scale = DVector::zeros(place.values.len());
    let mut control: Option<f64> = None;
    let mut ending = Ending::OutOfIterations;
    let mut quiet = 0;
    let mut note = |place: &Place, cost: f64, control: f64, simulations: usize| {
        let iterate = Iterate {
            stage,
            cost,
            values: place.values.clone(),
            control,
            simulations,
        };
        progress(&iterate);
        iterates.push(iterate);
    };
    for _ in 0..problem.most {
        simulations += 1;
        let equations = Equations::new(&problem.rows(&best));
        let reduced = equations.reduced(0.0);
        scale = scales(&reduced.r, &scale, &place.values);
        let mut now = control.unwrap_or_else(|| first_control(search, place, &scale));
        note(place, cost, now, simulations);
        let mut next = None;
        // Shorter and shorter steps, until one goes down. Most often the first one does, so that its slopes are made at once.
        for attempt in 0..30 {
            let room = Room {
                values: &place.values,
                bounds,
                scale: &scale,
            };
            let step = match search {
                Search::LevenbergMarquardt => room.damped(&equations, now),
                Search::TrustRegion => room.within(&equations, now),
            };
            if step.predicted <= STILL * cost {
                break;
            }
            let trial = place.moved(&step, &equations, bounds);
            simulations += 1;
            let asked = if attempt == 0 {
                Asked::Slopes
            } else {
                Asked::Motion
            };
            let found = problem.run(&trial, asked);
            let after = found
                .as_ref()
                .map_or(f64::INFINITY, |runs| problem.cost(runs));
            let ratio = (cost - after) / step.predicted;
            now = next_control(search, now, ratio, step.length);
            if ratio > 0.0 {
                // Where only its slopes run away nothing tells how to go on from there.
                let runs = match asked {
                    Asked::Motion => problem.run(&trial, Asked::Slopes),
                    _ => found,
                };
                if let Ok(runs) = runs {
                    next = Some((trial, after, step, runs));
                    break;
                }
                now = next_control(search, now, f64::NAN, step.length);
            }
        }
        let Some((trial, after, step, runs)) = next else {
            ending = Ending::Converged;
            break;
        };
        let size = DVector::from_column_slice(&trial.values).component_mul(&scale);
        let noise = (2.0 * cost / problem.samples().max(1) as f64).sqrt();
        let is_quiet = match problem.end {
            End::Rough => cost - after <= ROUGH * cost,
            End::Fine => {
                cost - after <= LITTLE * cost
                    && (&reduced.r * &step.parameters).norm() <= WITHIN_NOISE * noise
            }
        };
        quiet = if is_quiet { quiet + 1 } else { 0 };
        let is_over = cost - after <= STILL * cost
            || step.length <= NO_STEP * size.norm()
            || quiet == IN_A_ROW;
        (*place, cost, best, control) = (trial, after, runs, Some(now));
        if is_over {
            simulations += 1;
            note(place, cost, now, simulations);
            ending = Ending::Converged;
            break;
        }
    }
    if problem.end == End::Fine {
        // Where these run away those of the search have to do.
        best = problem.run(place, Asked::ExactSlopes).unwrap_or(best);
    }
    problem.plant.adjust(&place.values);
    Ok((best, ending))
}

impl Place {
    fn moved(&self, step: &Step, equations: &Equations, bounds: &[[f64; 2]]) -> Self {
        let values = self.values.iter().zip(step.parameters.iter()).zip(bounds);
        let starts = self.starts.iter().zip(&step.starts).zip(&equations.windows);
        Self {
            // A step to a bound may miss it by rounding.
            values: values
                .map(|((value, step), [low, high])| (value + step).clamp(*low, *high))
                .collect(),
            starts: starts
                .map(|((start, step), window)| {
                    let mut start = start.clone();
                    for (&k, step) in window.moving.iter().zip(step.iter()) {
                        start[k] += step;
                    }
                    start
                })
                .collect(),
        }
    }
}

fn first_control(search: Search, place: &Place, scale: &DVector<f64>) -> f64 {
    match search {
        Search::LevenbergMarquardt => 1e-3,
        Search::TrustRegion => {
            let values = DVector::from_column_slice(&place.values);
            f64::max(0.3 * values.component_mul(scale).norm(), 1e-6)
        }
    }
}

/// Damping or radius after a step of a length, that lowered the cost by `ratio` of what was foretold.
fn next_control(search: Search, now: f64, ratio: f64, length: f64) -> f64 {
    // Not a number where the motion ran away.
    let ratio = if ratio.is_nan() { -1.0 } else { ratio };
    match search {
        Search::LevenbergMarquardt if ratio > 0.75 => f64::max(0.1 * now, LEAST),
        Search::LevenbergMarquardt if ratio > 0.25 => now,
        Search::LevenbergMarquardt if ratio > 0.0 => 4.0 * now,
        Search::LevenbergMarquardt => 10.0 * now,
        Search::TrustRegion if ratio < 0.25 && length > 0.0 => f64::min(0.25 * length, 0.5 * now),
        Search::TrustRegion if ratio < 0.25 => 0.5 * now,
        Search::TrustRegion if ratio > 0.75 => 2.0 * now,
        Search::TrustRegion => now,
    }
}

#[cfg(test)]
mod tests;

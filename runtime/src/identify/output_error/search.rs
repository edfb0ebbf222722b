//! The search for the least cost: Levenberg's and Marquardt's, or within a trust region, both with bounds.
//!
//! In each step starts of windows follow the parameters (their equations are eliminated by orthogonal factors), and the parameters solve
//! `min |z + R d|` with what keeps them near: `lambda |D d|^2`, or `|D d| <= Delta`.
//!
//! Sources: Marquardt 1963; More 1978 for the scales `D`; for the trust region Algorithm 1 of Trojanova, Cakurda, Hosovsky, Krenicky, on
//! gravity tests of a pneumatic arm, with its constants `0, 2, 0.25, 0.25, 0.5`, where the radius shrinks to `0.25 |D d|` of the step (the
//! paper prints the gradient's length).

use nalgebra::DVector;

use super::equations::Equations;
use super::problem::{Place, Problem};
use super::run::{Asked, Run};
use crate::simulate::{Adjustable, SimulateError};
use control::{first_control, next_control, scales};
use share::Share;
use step::{LEAST, Room, Step};

mod control;
mod share;
mod step;

/// Iterations at most of a search that is to end.
pub(super) const MOST: usize = 100;

/// Shares of the cost and of the parameters that are no progress.
const STILL: f64 = 1e-10;
const NO_STEP: f64 = 1e-9;

/// Of deviations, as noise with the size of the errors makes them that is alike as these are: shorter steps of the parameters are none, where
/// twice in a row they lower the cost by less than this share times the samples that are worth one, or once where exact slopes foretell no
/// more. A cost with turns of dry friction in it has edges along which a search creeps for ever.
const WITHIN_NOISE: f64 = 0.05;
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
#[non_exhaustive]
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
    /// Share of the search that is behind it, from 0 to 1, which never falls: of its parts that may come those that are done, and within one by
    /// how far the gain of its steps has fallen, in logarithm, toward what ends it, or, where that is more, the steps so far beside as many more
    /// as a part takes at the median. Nobody knows how many come.
    pub done: f64,
}

/// How a search ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum Ending {
    /// No step lowers the cost any more.
    Converged,
    /// It ran out of iterations: it is on its way.
    OutOfIterations,
}

/// Runs with slopes, and how the search that led there ended.
pub(super) type Found = (Vec<Run>, Ending);

/// Moves a place to where the cost is least, weighed as the problem is; which window could not be simulated
/// there, and why.
pub(super) fn search<P: Adjustable + Clone + Sync>(
    search: Search,
    problem: &mut Problem<'_, P>,
    place: &mut Place,
    bounds: &[[f64; 2]],
    iterates: &mut Vec<Iterate>,
    progress: &mut dyn FnMut(&Iterate),
) -> Result<Found, (usize, SimulateError)> {
    let best = problem.run(place, Asked::Slopes)?;
    let last = iterates.last();
    let (simulations, stage) =
        last.map_or((0, 0), |iterate| (iterate.simulations, iterate.stage + 1));
    let mut way = Way {
        search,
        bounds,
        stage,
        // That of the place is one of them.
        simulations: simulations + 1,
        iterations: problem.most,
        cost: problem.cost(&best),
        best,
        scale: DVector::zeros(place.values.len()),
        control: None,
        share: Share::new(problem.part.clone()),
        iterates,
        progress,
    };
    let mut ending = way.down(problem, place, Slopes::COARSE);
    if problem.end == End::Fine {
        way.simulations += 1;
        // Where these run away those of the search have to do.
        if let Ok(best) = problem.run(place, Asked::ExactSlopes) {
            way.best = best;
            if ending == Ending::Converged {
                way.control = None;
                // Enough to be asked once whether there is anything left to do.
                way.iterations = way.iterations.max(1);
                ending = way.down(problem, place, Slopes::EXACT);
            }
        }
    }
    way.note(place);
    problem.plant.adjust(&place.values);
    Ok((way.best, ending))
}

/// By which slopes a search goes on.
#[derive(Debug, Clone, Copy)]
struct Slopes {
    asked: Asked,
    /// How many shorter and shorter steps are tried from a place.
    attempts: usize,
    /// Steps that are foretold to be within the noise are not tried.
    is_content: bool,
}

impl Slopes {
    const COARSE: Self = Self {
        asked: Asked::Slopes,
        attempts: 30,
        is_content: false,
    };
    /// From where coarse ones have led: most often there is nothing left to do, and what they do not go down along is an edge.
    const EXACT: Self = Self {
        asked: Asked::ExactSlopes,
        attempts: 3,
        is_content: true,
    };
}

/// The way of a search: what it has come to know.
struct Way<'a> {
    search: Search,
    bounds: &'a [[f64; 2]],
    stage: usize,
    simulations: usize,
    /// Those that are left.
    iterations: usize,
    cost: f64,
    /// Runs of where it stands, with slopes.
    best: Vec<Run>,
    scale: DVector<f64>,
    control: Option<f64>,
    share: Share,
    iterates: &'a mut Vec<Iterate>,
    progress: &'a mut dyn FnMut(&Iterate),
}

/// A step that lowers the cost, and where it leads.
struct Next {
    step: Step,
    place: Place,
    cost: f64,
    runs: Vec<Run>,
    /// Damping or radius of the step behind it.
    control: f64,
}

impl Way<'_> {
    /// Goes down from where it stands.
    fn down<P: Adjustable + Clone + Sync>(
        &mut self,
        problem: &mut Problem<'_, P>,
        place: &mut Place,
        slopes: Slopes,
    ) -> Ending {
        let mut quiet = 0;
        while self.iterations > 0 {
            self.iterations -= 1;
            let equations = Equations::new(&problem.rows(&self.best));
            let reduced = equations.reduced(0.0);
            self.scale = scales(&reduced.r, &self.scale, &place.values);
            let control = self
                .control
                .unwrap_or_else(|| first_control(self.search, place, &self.scale));
            self.control = Some(control);
            self.note(place);
            let cost = self.cost;
            let noise = (2.0 * cost / problem.samples().max(1) as f64).sqrt();
            let worth = reduced.worth(noise);
            let little = LITTLE * worth * cost;
            let is_little = |gain: f64, step: &Step| {
                gain <= little
                    && (&reduced.r * &step.parameters).norm() <= WITHIN_NOISE * worth.sqrt() * noise
            };
            if slopes.is_content {
                let step = self.room(place).damped(&equations, LEAST);
                if is_little(step.predicted, &step) {
                    return Ending::Converged;
                }
            }
            let Some(next) = self.next(problem, place, &equations, (control, slopes)) else {
                return Ending::Converged;
            };
            let gain = cost - next.cost;
            let (enough, is_quiet) = match problem.end {
                End::Rough => (ROUGH * cost, gain <= ROUGH * cost),
                End::Fine => (little, is_little(gain, &next.step)),
            };
            self.share.after(gain, enough);
            quiet = if is_quiet { quiet + 1 } else { 0 };
            let size = DVector::from_column_slice(&next.place.values).component_mul(&self.scale);
            let is_over = gain <= STILL * cost
                || next.step.length <= NO_STEP * size.norm()
                || quiet == IN_A_ROW;
            (*place, self.cost, self.best) = (next.place, next.cost, next.runs);
            self.control = Some(next.control);
            if is_over {
                return Ending::Converged;
            }
        }
        Ending::OutOfIterations
    }

    /// The first of shorter and shorter steps that goes down. Most often the first one does, so that its
    /// slopes are made at once.
    fn next<P: Adjustable + Clone + Sync>(
        &mut self,
        problem: &mut Problem<'_, P>,
        place: &Place,
        equations: &Equations,
        (mut control, slopes): (f64, Slopes),
    ) -> Option<Next> {
        for attempt in 0..slopes.attempts {
            let step = self.step(equations, place, control);
            if step.predicted <= STILL * self.cost {
                break;
            }
            let trial = place.moved(&step, equations, self.bounds);
            let asked = match attempt {
                0 => slopes.asked,
                _ => Asked::Motion,
            };
            self.simulations += 1;
            let found = problem.run(&trial, asked);
            let cost = found
                .as_ref()
                .map_or(f64::INFINITY, |runs| problem.cost(runs));
            let ratio = (self.cost - cost) / step.predicted;
            control = next_control(self.search, control, ratio, step.length);
            if ratio <= 0.0 || ratio.is_nan() {
                continue;
            }
            let runs = match asked {
                Asked::Motion => {
                    self.simulations += 1;
                    problem.run(&trial, slopes.asked)
                }
                _ => found,
            };
            if let Ok(runs) = runs {
                let next = Next {
                    step,
                    place: trial,
                    cost,
                    runs,
                    control,
                };
                return Some(next);
            }
            // Where only its slopes run away nothing tells how to go on from there.
            control = next_control(self.search, control, f64::NAN, step.length);
        }
        None
    }

    fn room<'a>(&'a self, place: &'a Place) -> Room<'a> {
        Room {
            values: &place.values,
            bounds: self.bounds,
            scale: &self.scale,
        }
    }

    fn step(&self, equations: &Equations, place: &Place, control: f64) -> Step {
        let room = self.room(place);
        match self.search {
            Search::LevenbergMarquardt => room.damped(equations, control),
            Search::TrustRegion => room.within(equations, control),
        }
    }

    /// Tells of a place once.
    fn note(&mut self, place: &Place) {
        let last = self.iterates.last_mut();
        if let Some(last) =
            last.filter(|last| last.stage == self.stage && last.values == place.values)
        {
            // Starts of windows may have moved.
            last.cost = self.cost;
            last.control = self.control.unwrap_or_default();
            last.simulations = self.simulations;
            last.done = self.share.done();
            return;
        }
        let iterate = Iterate {
            stage: self.stage,
            cost: self.cost,
            values: place.values.clone(),
            control: self.control.unwrap_or_default(),
            simulations: self.simulations,
            done: self.share.done(),
        };
        (self.progress)(&iterate);
        self.iterates.push(iterate);
    }
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

#[cfg(test)]
mod tests;

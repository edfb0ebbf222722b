//! The parts of a search: with short windows, with those that are asked for, and with torque that goes the other way between samples.

use super::problem::{Place, Problem};
use super::run::Run;
use super::search::{self, End, Found};
use super::{Iterate, OutputError, OutputErrorError, Recording};
use crate::simulate::Adjustable;
use crate::simulate::SimulateError;

/// Half the change of torque from sample to sample, over the torque, roots of mean squares: below the first it does not matter how torque goes
/// between samples; below the second a rough search has to say first that it does.
const SMOOTH: [f64; 2] = [5e-4, 0.01];

/// Rounds of a part at most, and how many times more than those of another joint errors may be of what they were weighed by for one to be
/// enough.
const ROUNDS: usize = 2;
const SETTLED: f64 = 1.2;

/// What the parts of a search share.
pub(super) struct Parts<'s> {
    search: search::Search,
    pub bounds: Vec<[f64; 2]>,
    /// Cost that the first part has to come below.
    below: Option<f64>,
    /// What joints are weighed by: errors of the part before.
    scale: Vec<f64>,
    pub iterates: Vec<Iterate>,
    /// Parts that may come.
    pub to_come: usize,
    /// Share of the search that is behind it.
    done: f64,
    progress: &'s mut dyn FnMut(&Iterate),
}

/// Where a part has led.
pub(super) struct Part<'a, P> {
    pub problem: Problem<'a, P>,
    pub place: Place,
    pub found: Found,
    /// Seconds of its windows; none of whole logs.
    pub window: Option<f64>,
}

impl<'s> Parts<'s> {
    /// Before the first.
    pub fn new(
        settings: &OutputError,
        parameters: usize,
        joints: usize,
        progress: &'s mut dyn FnMut(&Iterate),
    ) -> Self {
        Self {
            search: settings.search,
            below: settings.below,
            bounds: settings.bounds_of(parameters),
            scale: vec![1.0; joints],
            iterates: Vec::new(),
            to_come: 1,
            done: 0.0,
            progress,
        }
    }

    /// One of them, from given parameters on; a joint counts by what its errors are, once they are known. Windows that begin where one of the
    /// part `before` does start as that was found to.
    pub fn search<'a, P: Adjustable + Clone + Sync>(
        &mut self,
        mut problem: Problem<'a, P>,
        window: Option<f64>,
        values: &[f64],
        before: Option<&Part<'_, P>>,
        end: End,
    ) -> Result<Part<'a, P>, OutputErrorError> {
        let mut place = problem.place(values);
        if let Some(before) = before {
            problem.start_as(&mut place, &before.problem, &before.place);
        }
        let weighed = self.scale.len() > 1;
        let rounds = if weighed { ROUNDS } else { 1 };
        let begin = self.done;
        let length = (1.0 - begin) / self.to_come.max(1) as f64;
        let mut round = 0;
        let found = loop {
            let [from, to] = [round, round + 1].map(|k| begin + length * k as f64 / rounds as f64);
            problem.part = from..to;
            round += 1;
            // Without a part before, a first round tells what joints are weighed by in the second.
            let is_first = weighed && before.is_none() && round == 1;
            problem.end = if is_first { End::Rough } else { end };
            problem.scale.clone_from(&self.scale);
            let found = search::search(
                self.search,
                &mut problem,
                &mut place,
                &self.bounds,
                &mut self.iterates,
                self.progress,
            );
            let found = found.map_err(|error| no_start(&problem, error))?;
            if let (Some(below), Some(Iterate { stage: 0, cost, .. })) =
                (self.below, self.iterates.last())
                && *cost >= below
            {
                return Err(OutputErrorError::NotDeeper { cost: *cost, below });
            }
            if !weighed {
                break found;
            }
            let scale = problem.scales(&found.0);
            let is_settled = before.is_some() && are_near(&scale, &self.scale);
            self.scale = scale;
            if is_settled || round == rounds {
                break found;
            }
        };
        self.done = begin + length;
        self.to_come = self.to_come.saturating_sub(1);
        Ok(Part {
            problem,
            place,
            found,
            window,
        })
    }
}

impl<P: Adjustable + Clone + Sync> Part<'_, P> {
    /// Sum of the logarithms of the joints' errors, which does not depend on their units.
    pub fn error(&self) -> f64 {
        self.problem.error(&self.found.0)
    }
}

impl<P: Adjustable + Clone + Sync> Problem<'_, P> {
    /// Sum of the logarithms of the joints' errors.
    pub fn error(&self, runs: &[Run]) -> f64 {
        let spread = self.spread(runs).into_iter();
        spread.map(|x| x.max(f64::MIN_POSITIVE).ln()).sum()
    }
}

impl OutputError {
    /// How far the other way that torque may go between samples is to be searched for errors to say which it is; not at all where somebody has
    /// said it, or where it does not matter.
    pub(super) fn other_hold(&self, recordings: &[Recording]) -> Option<End> {
        let torques = || recordings.iter().flat_map(|recording| &recording.torque);
        let power = |values: &mut dyn Iterator<Item = f64>| values.map(|x| x * x).sum::<f64>();
        let level: f64 = torques().map(|tau| power(&mut tau.iter().copied())).sum();
        let steps: f64 = torques()
            .map(|tau| power(&mut tau.windows(2).map(|pair| 0.5 * (pair[1] - pair[0]))))
            .sum();
        let is_open = self.hold.is_none() && self.law.is_none();
        let [may_matter, matters] = SMOOTH.map(|share| is_open && steps > share.powi(2) * level);
        match (may_matter, matters) {
            (false, _) => None,
            (true, false) => Some(End::Rough),
            (true, true) => Some(End::Fine),
        }
    }
}

/// Whether errors are in the proportions that joints were weighed by.
fn are_near(errors: &[f64], weighed: &[f64]) -> bool {
    let pairs = errors.iter().zip(weighed);
    let times = pairs.map(|(error, weighed)| error / weighed);
    let (least, most) = times.fold((f64::INFINITY, 0.0), |(least, most): (f64, f64), x| {
        (least.min(x), most.max(x))
    });
    most <= SETTLED * least
}

fn no_start<P>(
    problem: &Problem<'_, P>,
    (window, error): (usize, SimulateError),
) -> OutputErrorError {
    OutputErrorError::Start {
        log: problem.windows[window].source().to_owned(),
        error,
    }
}

//! A torque that steps once, and stays where it is or comes back later: a slipped gear, a cable that is caught, an offset that was set anew.
//!
//! It has next to no power where robots move, so that it looks like a wander of the zero, but a wander goes everywhere and a step is at one
//! place.

mod level;

use std::cell::OnceCell;

use crate::columns::Entry;
use crate::identify::{Segment, Stack};
use crate::signal::resample::whole_steps;

use super::gram::Gram;
use super::residual::evenly;
use super::score::Present;
use super::search::{Search, State};

use level::{Level, level};

/// A step stands out of the differences of means by so many of their deviations: of noise the largest is three to four.
const STANDS_OUT: f64 = 6.0;

/// So many deviations are worth a look with the step beside the model.
const A_HINT: f64 = 2.5;

/// Where a joint's residual steps from one level to another.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct Step {
    /// Which log, from 0.
    pub log: usize,
    /// When, s since the start of that log.
    pub time: f64,
    /// When it comes back, s since the start of that log; none where it stays to the end.
    pub until: Option<f64>,
    /// By how much, N m or N, with the model fitted beside it.
    pub size: f64,
    /// Share of the power of the joint's residual in that log, in the band of the fit, that it takes off.
    pub share: f64,
}

/// A log's part of a joint's residual.
struct Part<'a> {
    joint: usize,
    segment: &'a Segment,
    rate_hz: f64,
    /// Samples at which a column of the model that comes once begins or ends.
    edges: Vec<usize>,
}

impl<'a> Part<'a> {
    fn new(search: &Search, stack: &'a Stack, joint: usize, log: usize) -> Self {
        let segment = &stack.segments[log];
        let rate_hz = search.prepared[log].filtered_hz();
        let first = segment.time.first().copied().unwrap_or_default();
        let sample = |row: usize| whole_steps(((segment.time[row] - first) * rate_hz).round());
        let edges = search.edges_of_columns(stack, joint, log).into_iter();
        Self {
            joint,
            segment,
            rate_hz,
            edges: edges.map(sample).collect(),
        }
    }

    fn level(&self, residual: &[f64], stands_out: f64) -> Option<Level> {
        let even = evenly(self.segment, residual, self.rate_hz);
        level(&even, self.rate_hz, &self.edges, stands_out)
    }

    /// Seconds of the log at which a level begins, and at which it ends.
    fn times(&self, level: Level) -> (f64, Option<f64>) {
        let time = |sample: usize| self.segment.time[0] + sample as f64 / self.rate_hz;
        (time(level.from), level.to.map(time))
    }

    /// The step with the model beside it.
    ///
    /// Parameters take in a part of a step, which follows the motion then and hides the rest: so what is asked is the residual of a model
    /// that has the step, with the step in it.
    fn refitted(&self, present: &Present, hint: Level) -> Option<(Level, Beside)> {
        let mut found = hint;
        for stands_out in [A_HINT, STANDS_OUT] {
            let with_step = self.beside(present, found)?.residual;
            found = self.level(&with_step, stands_out)?;
        }
        Some((found, self.beside(present, found)?))
    }

    /// The model with a step beside it.
    fn beside(&self, present: &Present, level: Level) -> Option<Beside> {
        let rows = self.segment.start..self.segment.start + self.segment.time.len();
        let mean_square = |residual: &[f64]| {
            let squares: f64 = residual[rows.clone()].iter().map(|r| r * r).sum();
            squares / rows.len() as f64
        };
        let (from, to) = self.times(level);
        let is_at = |time: f64| time >= from && to.is_none_or(|to| time < to);
        let mut values = vec![0.0; present.stack.samples()];
        for (value, at) in values[rows.clone()].iter_mut().zip(&self.segment.time) {
            *value = f64::from(is_at(*at));
        }
        let mut column = [Entry {
            joint: self.joint,
            column: 0,
            values,
        }];
        present.stack.clear_left_out(&mut column);
        let projected = present.project(&column, 1)?;
        let mut residual = present.rest(&column, &projected).swap_remove(self.joint);
        let before = mean_square(&present.residuals[self.joint]);
        let taken = (before - mean_square(&residual)).max(0.0);
        let size = projected.gain[0];
        for (rest, value) in residual.iter_mut().zip(&column[0].values) {
            *rest += size * value;
        }
        Some(Beside {
            size,
            taken,
            share: taken / before.max(f64::MIN_POSITIVE),
            residual,
        })
    }
}

/// What a step is with the model beside it.
struct Beside {
    size: f64,
    /// The mean square that it takes off its log's part of the residual, and its share of what was there.
    taken: f64,
    share: f64,
    /// What the model leaves of the part, with the step in it.
    residual: Vec<f64>,
}

/// A step, and the mean square that it takes off its log's part of the residual.
#[derive(Clone, Copy)]
pub(super) struct Stepped {
    pub(super) step: Step,
    pub(super) taken: f64,
}

impl Search<'_> {
    /// The step of each joint's residual in each log, `[joint][log]`.
    pub(super) fn steps<'a>(&self, state: &'a State) -> &'a [Vec<Option<Stepped>>] {
        state.looks.steps.get_or_init(|| self.steps_of(state))
    }

    fn steps_of(&self, state: &State) -> Vec<Vec<Option<Stepped>>> {
        let gram = OnceCell::new();
        let step = |joint: usize, log: usize| {
            let part = Part::new(self, &state.stack, joint, log);
            let hint = part.level(&state.residuals[joint], A_HINT)?;
            let gram = gram.get_or_init(|| Gram::new(&state.stack, &[]));
            let sigma = &state.solution.sigma;
            let present = Present::new(&state.stack, gram, sigma, &state.residuals);
            let (level, found) = part.refitted(&present, hint)?;
            let (time, until) = part.times(level);
            let step = Step {
                log,
                time,
                until,
                size: found.size,
                share: found.share,
            };
            let taken = found.taken;
            Some(Stepped { step, taken })
        };
        let logs = 0..self.prepared.len();
        let joint = |joint: usize| logs.clone().map(|log| step(joint, log)).collect();
        (0..self.arm.dof()).map(joint).collect()
    }
}

/// The step that takes most off its joint's residual.
pub(super) fn largest(steps: &[Option<Stepped>]) -> Option<Step> {
    let steps = steps.iter().flatten();
    let largest = steps.max_by(|one, other| one.taken.total_cmp(&other.taken));
    largest.map(|stepped| stepped.step)
}

//! A candidate at given shapes, its columns filtered like the model's.

use std::convert::Infallible;

use crate::columns::{Candidate, Entry};
use crate::identify::{filtered_columns, golden, neighbors};
use crate::signal::Prepared;

use super::score::{Present, Projected};

/// A shape this close to an end of its range, relative to the range's length, is at the end.
const END_SHARE: f64 = 0.002;

/// A range whose ends are further apart than this factor.
const DECADES: f64 = 100.0;

/// How much less a candidate may explain with a shape that hardly changes anything.
const HARDLY: f64 = 1e-3;

/// A column of the logged torque may be more than this share of its largest value in this share of all rows.
const THERE: f64 = 0.02;
const RARELY: f64 = 0.5;

/// A law that comes and goes is away for at least this share of the samples.
const LEAST_AWAY: f64 = 0.1;

/// How far the second sweep goes, as a share of the way to the neighbors on the grid.
const NEARBY: f64 = 0.1;

/// A candidate with values for its shape parameters.
#[derive(Clone)]
pub(super) struct Trial<'a> {
    pub(super) candidate: &'a dyn Candidate,
    pub(super) shapes: Vec<f64>,
    pub(super) entries: Vec<Entry>,
    /// Which shapes change what it explains; none were asked before it was refined.
    is_felt: Vec<bool>,
    /// Whether it comes and goes, but is there nearly all the time.
    is_ever: bool,
}

/// Every point of a candidate's grid.
pub(super) fn points(candidate: &dyn Candidate) -> Vec<Vec<f64>> {
    let mut points = vec![Vec::new()];
    for shape in candidate.shapes() {
        points = points
            .iter()
            .flat_map(|point: &Vec<f64>| {
                shape.grid.iter().map(move |value| {
                    let mut longer = point.clone();
                    longer.push(*value);
                    longer
                })
            })
            .collect();
    }
    points
}

/// What a candidate's columns explain of the residual beside the model. `None` where they say nothing new, or where they are made of the
/// logged torque nearly all the time: the torque explains itself.
pub(super) fn project(
    candidate: &dyn Candidate,
    entries: &[Entry],
    present: &Present,
) -> Option<Projected> {
    if candidate.follows_torque() && !is_rare(entries) {
        return None;
    }
    present.project(entries, candidate.unknowns().len())
}

/// Whether a law that is nothing at all somewhere, as a contact is before it begins, is that in a small part of the logs only: an end that
/// is next to that of a log is none.
fn is_ever(candidate: &dyn Candidate, shapes: &[f64], logs: &[Prepared]) -> bool {
    let (mut nothing, mut all) = (0, 0);
    for log in logs {
        let entries = candidate.entries(&log.motion, shapes);
        let samples = log.motion.time.len();
        let is_nothing = |k: &usize| entries.iter().all(|entry| entry.values[*k] == 0.0);
        nothing += (0..samples).filter(is_nothing).count();
        all += samples;
    }
    nothing > 0 && (nothing as f64) < LEAST_AWAY * all as f64
}

/// Whether every column is next to nothing in most rows.
fn is_rare(entries: &[Entry]) -> bool {
    entries.iter().all(|entry| {
        let largest = entry
            .values
            .iter()
            .fold(0.0_f64, |most, v| most.max(v.abs()));
        let is_there = |value: &&f64| value.abs() > THERE * largest;
        let there = entry.values.iter().filter(is_there).count();
        there as f64 <= RARELY * entry.values.len() as f64
    })
}

impl<'a> Trial<'a> {
    pub(super) fn new(candidate: &'a dyn Candidate, shapes: Vec<f64>, logs: &[Prepared]) -> Self {
        let entries = filtered_columns(candidate, logs, &shapes);
        Self {
            candidate,
            shapes,
            entries,
            is_felt: Vec::new(),
            is_ever: false,
        }
    }

    /// What a change of the arm adds to first order.
    pub(super) fn first_order(candidate: &'a dyn Candidate, entries: Vec<Entry>) -> Self {
        Self {
            candidate,
            shapes: Vec::new(),
            entries,
            is_felt: Vec::new(),
            is_ever: false,
        }
    }

    /// Number of linear parameters.
    pub(super) fn count(&self) -> usize {
        self.candidate.unknowns().len()
    }

    /// Parameters that the effect adds to the model: what a simpler law has fewer of.
    pub(super) fn complexity(&self) -> usize {
        self.count() + self.shapes.len()
    }

    /// Whether every shape is inside its range, and what comes and goes is away for a while: an optimum at the end of a range is that of
    /// another law. Nothing lies beyond a range
    /// that begins at zero, so that zero is inside.
    pub(super) fn is_inside(&self) -> bool {
        if self.is_ever {
            return false;
        }
        let numbers = 0..self.shapes.len();
        let is_felt = |number: usize| self.is_felt.get(number).copied().unwrap_or(true);
        let is_own = |number: usize| self.is_within(number) && is_felt(number);
        // A law none of whose shapes is felt inside its range is a simpler one: a contact that is there all the time is no contact.
        numbers
            .clone()
            .all(|number| self.is_at_zero(number) || self.is_within(number))
            && (self.shapes.is_empty() || numbers.clone().any(is_own))
    }

    /// Whether a shape stands at zero, where its range begins.
    fn is_at_zero(&self, number: usize) -> bool {
        let grid = &self.candidate.shapes()[number].grid;
        let edge = END_SHARE * (grid[grid.len() - 1] - grid[0]);
        grid[0] == 0.0 && self.shapes[number] < edge
    }

    fn is_within(&self, number: usize) -> bool {
        let grid = &self.candidate.shapes()[number].grid;
        let (low, high, value) = (grid[0], grid[grid.len() - 1], self.shapes[number]);
        if low > 0.0 && high > DECADES * low {
            // Such a range is one of its logarithm.
            let edge = END_SHARE * (high / low).ln();
            return (low.ln() + edge..=high.ln() - edge).contains(&value.ln());
        }
        let edge = END_SHARE * (high - low);
        (low + edge..=high - edge).contains(&value)
    }

    /// Joints whose torque it has a part in: a force on a link is felt by all joints before it.
    pub(super) fn touched(&self) -> Vec<usize> {
        let mut joints = self.candidate.joints().to_vec();
        joints.extend(self.entries.iter().map(|entry| entry.joint));
        joints.sort_unstable();
        joints.dedup();
        joints
    }

    /// What it explains of the residual beside the model.
    pub(super) fn project(&self, present: &Present) -> Option<Projected> {
        project(self.candidate, &self.entries, present)
    }

    /// Moves each shape between its neighbors on the grid to where the candidate explains most; in further sweeps nearby.
    pub(super) fn refined(&self, present: &Present, logs: &[Prepared], sweeps: usize) -> Self {
        let mut best = self.clone();
        let drop = |trial: &Self| {
            let projected = trial.project(present);
            projected.map_or(0.0, |p| p.admissible_drop(trial.candidate))
        };
        for sweep in 0..sweeps {
            for number in 0..self.shapes.len() {
                let grid = &self.candidate.shapes()[number].grid;
                let at = |value: f64| {
                    let mut shapes = best.shapes.clone();
                    shapes[number] = value;
                    Self::new(self.candidate, shapes, logs)
                };
                let value = best.shapes[number];
                let (mut low, mut high) = neighbors(grid, self.shapes[number]);
                if sweep > 0 {
                    low = (value - NEARBY * (value - low).abs()).max(grid[0]);
                    high = (value + NEARBY * (high - value).abs()).min(grid[grid.len() - 1]);
                }
                let Ok(value) = golden(low, high, &mut |value| {
                    Ok::<_, Infallible>(-drop(&at(value)))
                });
                let refined = at(value);
                if drop(&refined) > drop(&best) {
                    best = refined;
                }
            }
        }
        let mut best = best.away_from_ends(&drop, logs);
        if best.shapes.len() > 1 {
            best.is_ever = is_ever(best.candidate, &best.shapes, logs);
            let numbers = 0..best.shapes.len();
            best.is_felt = numbers
                .map(|number| best.feels(number, &drop, logs))
                .collect();
        }
        best
    }

    /// Whether the candidate explains less with a shape that is one step of its grid lower or higher.
    fn feels(&self, number: usize, drop: &dyn Fn(&Self) -> f64, logs: &[Prepared]) -> bool {
        let grid = &self.candidate.shapes()[number].grid;
        let (first, last, value) = (grid[0], grid[grid.len() - 1], self.shapes[number]);
        let (low, high) = neighbors(grid, value);
        let steps = if first > 0.0 && last > DECADES * first {
            [value * low / high, value * high / low]
        } else {
            [value - (high - low), value + (high - low)]
        };
        let least = (1.0 - HARDLY) * drop(self);
        steps.into_iter().all(|step| {
            let mut shapes = self.shapes.clone();
            shapes[number] = step.clamp(first, last);
            drop(&Self::new(self.candidate, shapes, logs)) < least
        })
    }

    /// A shape of which hardly anything changes near the end of its range is at no end: it takes the next value of its grid.
    fn away_from_ends(mut self, drop: &dyn Fn(&Self) -> f64, logs: &[Prepared]) -> Self {
        for number in 0..self.shapes.len() {
            if self.is_within(number) {
                continue;
            }
            let grid = &self.candidate.shapes()[number].grid;
            let inner = if self.shapes[number] > grid[grid.len() / 2] {
                grid[grid.len() - 2]
            } else {
                grid[1]
            };
            let mut shapes = self.shapes.clone();
            shapes[number] = inner;
            let inside = Self::new(self.candidate, shapes, logs);
            if drop(&inside) >= (1.0 - HARDLY) * drop(&self) {
                self = inside;
            }
        }
        self
    }
}

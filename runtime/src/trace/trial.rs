//! A candidate at given shapes, its columns filtered like the model's.

use crate::columns::{Candidate, Entry};
use crate::identify::is_of_decades;
use crate::signal::Prepared;

use super::projected::Projected;
use super::rows::Rows;
use super::score::Present;
use super::search::is_of_phase;

/// A shape this close to an end of its range, relative to the range's length, is at the end.
const END_SHARE: f64 = 0.002;

/// A column of the logged torque may be more than this share of its largest value in this share of all rows.
const THERE: f64 = 0.02;
const RARELY: f64 = 0.5;

/// A law that comes and goes is away for at least this share of the samples.
const LEAST_AWAY: f64 = 0.1;

/// A candidate with values for its shape parameters.
#[derive(Clone)]
pub(super) struct Trial<'a> {
    pub(super) candidate: &'a dyn Candidate,
    pub(super) shapes: Vec<f64>,
    pub(super) entries: Vec<Entry>,
    /// Which shapes change what it explains; none were asked before it was refined.
    pub(super) is_felt: Vec<bool>,
    pub(super) presence: Presence,
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

/// When a law is there at all.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(super) enum Presence {
    /// All the time.
    #[default]
    Always,
    /// It comes and goes, as a contact does.
    ComesAndGoes,
    /// It comes and goes, but is away in a small part of the logs only: an end that is next to that of a log is none.
    Nearly,
}

/// When a law is there. What comes with the motion or with the torque, as a drive's limit does, is no law of time.
pub(super) fn presence(candidate: &dyn Candidate, shapes: &[f64], logs: &[Prepared]) -> Presence {
    let (mut nothing, mut all) = (0, 0);
    for log in logs {
        let entries = candidate.entries(&log.motion, shapes);
        let samples = log.motion.time.len();
        let is_nothing = |k: &usize| entries.iter().all(|entry| entry.values[*k] == 0.0);
        nothing += (0..samples).filter(is_nothing).count();
        all += samples;
    }
    if nothing == 0 {
        Presence::Always
    } else if (nothing as f64) < LEAST_AWAY * all as f64 {
        Presence::Nearly
    } else if candidate.is_of_time() {
        Presence::ComesAndGoes
    } else {
        Presence::Always
    }
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
    pub(super) fn new(candidate: &'a dyn Candidate, shapes: Vec<f64>, rows: Rows) -> Self {
        let entries = rows.columns(candidate, &shapes);
        Self {
            candidate,
            shapes,
            entries,
            is_felt: Vec::new(),
            presence: Presence::default(),
        }
    }

    /// What a change of the arm adds to first order.
    pub(super) fn first_order(candidate: &'a dyn Candidate, entries: Vec<Entry>) -> Self {
        Self {
            candidate,
            shapes: Vec::new(),
            entries,
            is_felt: Vec::new(),
            presence: Presence::default(),
        }
    }

    /// Number of linear parameters.
    pub(super) fn count(&self) -> usize {
        self.candidate.unknowns().len()
    }

    /// Parameters that the effect adds to the model: what a simpler law has fewer of. Beside a shape that stands at zero those that change nothing
    /// do not count either: bristles whose friction does not rise have no Stribeck speed, and are Dahl's.
    pub(super) fn complexity(&self) -> usize {
        let numbers = 0..self.shapes.len();
        let at_zero = numbers.clone().filter(|&number| self.is_at_zero(number));
        let is_simpler = at_zero.count() > 0;
        let is_used = |number: &usize| !self.is_at_zero(*number) && self.is_felt(*number);
        let shapes = if is_simpler {
            numbers.filter(is_used).count()
        } else {
            self.shapes.len()
        };
        self.count() + shapes
    }

    /// Whether a shape changes what it explains, as far as that was asked.
    pub(super) fn is_felt(&self, number: usize) -> bool {
        self.is_felt.get(number).copied().unwrap_or(true)
    }

    /// Whether every shape is inside its range: an optimum at the end of a range is that of another law. Nothing lies beyond a range that
    /// begins at zero, so that zero is inside. What comes and goes is seen to come and to go.
    pub(super) fn is_inside(&self) -> bool {
        let mut numbers = 0..self.shapes.len();
        let is_own = |number: usize| self.is_within(number) && self.is_felt(number);
        match self.presence {
            Presence::Nearly => false,
            // A force that is there from the first sample on, or to the last, is a step, which a wander of the zero makes as well.
            Presence::ComesAndGoes => {
                // Where a period begins is nothing special.
                let recurs = is_of_phase(self.candidate);
                numbers.all(|number| is_own(number) || (recurs && self.is_at_zero(number)))
            }
            // A law none of whose shapes is felt inside its range is a simpler one.
            Presence::Always => {
                let mut own = numbers.clone();
                numbers.all(|number| self.is_at_zero(number) || self.is_within(number))
                    && (self.shapes.is_empty() || own.any(is_own))
            }
        }
    }

    /// Whether a shape stands at zero, where its range begins.
    fn is_at_zero(&self, number: usize) -> bool {
        let grid = &self.candidate.shapes()[number].grid;
        let edge = END_SHARE * (grid[grid.len() - 1] - grid[0]);
        grid[0] == 0.0 && self.shapes[number] < edge
    }

    pub(super) fn is_within(&self, number: usize) -> bool {
        let grid = &self.candidate.shapes()[number].grid;
        let (low, high, value) = (grid[0], grid[grid.len() - 1], self.shapes[number]);
        if is_of_decades(grid) {
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
}

//! A candidate at given shapes, its columns filtered like the model's.

use std::convert::Infallible;

use crate::columns::{Candidate, Entry};
use crate::identify::{filtered_columns, golden, neighbors};
use crate::signal::Prepared;

use super::score::{Present, Projected};

/// A shape this close to an end of its range, relative to the range's length, is at the end.
const END_SHARE: f64 = 0.002;

/// A candidate with values for its shape parameters.
#[derive(Clone)]
pub(super) struct Trial<'a> {
    pub(super) candidate: &'a dyn Candidate,
    pub(super) shapes: Vec<f64>,
    pub(super) entries: Vec<Entry>,
}

impl<'a> Trial<'a> {
    pub(super) fn new(candidate: &'a dyn Candidate, shapes: Vec<f64>, logs: &[Prepared]) -> Self {
        let entries = filtered_columns(candidate, logs, &shapes);
        Self {
            candidate,
            shapes,
            entries,
        }
    }

    /// One trial for every point of the candidate's grid.
    pub(super) fn grid(candidate: &'a dyn Candidate, logs: &[Prepared]) -> Vec<Self> {
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
            .into_iter()
            .map(|shapes| Self::new(candidate, shapes, logs))
            .collect()
    }

    /// Number of linear parameters.
    pub(super) fn count(&self) -> usize {
        self.candidate.unknowns().len()
    }

    /// Parameters that the effect adds to the model: what a simpler law has fewer of.
    pub(super) fn complexity(&self) -> usize {
        self.count() + self.shapes.len()
    }

    /// Whether every shape is inside its range: an optimum at the end of a range is that of another law.
    pub(super) fn is_inside(&self) -> bool {
        let mut ranges = self.candidate.shapes().iter().zip(&self.shapes);
        ranges.all(|(shape, value)| {
            let (low, high) = (shape.grid[0], shape.grid[shape.grid.len() - 1]);
            let edge = END_SHARE * (high - low);
            (low + edge..=high - edge).contains(value)
        })
    }

    pub(super) fn project(&self, present: &Present) -> Option<Projected> {
        present.project(&self.entries, self.count())
    }

    /// Moves each shape between its neighbors on the grid to where the candidate explains most.
    pub(super) fn refined(&self, present: &Present, logs: &[Prepared]) -> Self {
        let mut best = self.clone();
        let drop = |trial: &Self| trial.project(present).map_or(0.0, |p| p.drop);
        for number in 0..self.shapes.len() {
            let grid = &self.candidate.shapes()[number].grid;
            let at = |value: f64| {
                let mut shapes = best.shapes.clone();
                shapes[number] = value;
                Self::new(self.candidate, shapes, logs)
            };
            let (low, high) = neighbors(grid, best.shapes[number]);
            let Ok(value) = golden(low, high, &mut |value| {
                Ok::<_, Infallible>(-drop(&at(value)))
            });
            let refined = at(value);
            if drop(&refined) > drop(&best) {
                best = refined;
            }
        }
        best
    }
}

//! From the best point of a grid to where a candidate explains most.

use std::convert::Infallible;

use crate::columns::Entry;
use crate::identify::{golden, is_of_decades, moved, neighbors};

use super::rows::Rows;
use super::score::Present;
use super::trial::{Presence, Trial, presence};

/// How much less a candidate may explain with a shape that hardly changes anything.
const HARDLY: f64 = 1e-3;

/// A shape with so few values on its grid is begun at each of them.
const COARSE: usize = 3;

/// Steps of all shapes together, shares of a step that are tried, and by what share more has to be explained.
const STEPS: usize = 8;
const HALVES: [f64; 4] = [1.0, 0.5, 0.25, 0.125];
const LEAST_GAIN: f64 = 1e-5;

impl Trial<'_> {
    /// Moves each shape between its neighbors on the grid to where the candidate explains most; `finely` all of them
    /// together from there on, and from other values of shapes with a coarse grid, too.
    pub(super) fn refined(&self, present: &Present, rows: Rows, finely: bool) -> Self {
        let drop = |trial: &Self| {
            let projected = trial.project(present);
            projected.map_or(0.0, |p| p.admissible_drop(trial.candidate))
        };
        let mut best = self.one_by_one(&drop, rows);
        if finely && !best.shapes.is_empty() {
            best = best.together(present, &drop, rows);
            for start in self.other_starts(rows) {
                let start = start.one_by_one(&drop, rows);
                let other = start.together(present, &drop, rows);
                if drop(&other) > drop(&best) {
                    best = other;
                }
            }
        }
        let mut best = best.away_from_ends(&drop, rows);
        let presence = presence(best.candidate, &best.shapes, rows.logs);
        // A law with one shape has one end at most, and may be nothing at the first sample alone, as what drifts from there on is.
        if best.shapes.len() > 1 || presence == Presence::ComesAndGoes {
            best.presence = presence;
        }
        if best.shapes.len() > 1 {
            let numbers = 0..best.shapes.len();
            best.is_felt = numbers
                .map(|number| best.feels(number, &drop, rows))
                .collect();
        }
        best
    }

    /// Moves each shape between its neighbors on the grid, one after the other.
    fn one_by_one(&self, drop: &dyn Fn(&Self) -> f64, rows: Rows) -> Self {
        let mut best = self.clone();
        for number in 0..self.shapes.len() {
            let grid = &self.candidate.shapes()[number].grid;
            let at = |value: f64| {
                let mut shapes = best.shapes.clone();
                shapes[number] = value;
                Self::new(self.candidate, shapes, rows)
            };
            let (low, high) = neighbors(grid, self.shapes[number]);
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

    /// The same point but for the other values of a shape whose grid is coarse beside others: one valley lies between two of them.
    fn other_starts(&self, rows: Rows) -> Vec<Self> {
        let shapes = self.candidate.shapes();
        let coarse =
            (0..shapes.len()).filter(|&k| shapes.len() > 2 && shapes[k].grid.len() <= COARSE);
        let others = coarse.flat_map(|number| {
            let other = move |value: &&f64| (*value - self.shapes[number]).abs() > 0.0;
            let values = shapes[number].grid.iter().filter(other);
            values.map(move |&value| {
                let mut shapes = self.shapes.clone();
                shapes[number] = value;
                Self::new(self.candidate, shapes, rows)
            })
        });
        others.collect()
    }

    /// Moves all shapes along the slopes of the torque (Gauss and Newton) as long as that explains more: width and sharpness of a loop are
    /// not found one after the other.
    fn together(mut self, present: &Present, drop: &dyn Fn(&Self) -> f64, rows: Rows) -> Self {
        let mut explained = drop(&self);
        for _ in 0..STEPS {
            let Some(step) = self.step(present, rows) else {
                break;
            };
            let shares = HALVES.iter().map(|share| {
                let next = self.moved(&step, *share, rows);
                (drop(&next), next)
            });
            let least = (1.0 + LEAST_GAIN) * explained;
            let Some((more, next)) = shares.into_iter().find(|(more, _)| *more > least) else {
                break;
            };
            (explained, self) = (more, next);
        }
        self
    }

    /// Where least squares with slopes for columns moves the shapes.
    fn step(&self, present: &Present, rows: Rows) -> Option<Vec<f64>> {
        let count = self.count();
        let gain = self.project(present)?.gain;
        let slopes = rows.slopes(self.candidate, &self.shapes, &gain);
        let slopes = slopes.into_iter().map(|slope| Entry {
            column: count + slope.column,
            ..slope
        });
        let entries: Vec<Entry> = self.entries.iter().cloned().chain(slopes).collect();
        let beside = present.project(&entries, count + self.shapes.len())?;
        Some(beside.gain[count..].to_vec())
    }

    /// With shapes a share of a step further, inside their ranges.
    fn moved(&self, step: &[f64], share: f64, rows: Rows) -> Self {
        let shapes = self.candidate.shapes().iter().zip(&self.shapes).zip(step);
        let shapes = shapes.map(|((shape, value), step)| moved(&shape.grid, *value, share * step));
        Self::new(self.candidate, shapes.collect(), rows)
    }

    /// Whether the candidate explains less with a shape that is one step of its grid lower or higher.
    fn feels(&self, number: usize, drop: &dyn Fn(&Self) -> f64, rows: Rows) -> bool {
        let grid = &self.candidate.shapes()[number].grid;
        let (first, last, value) = (grid[0], grid[grid.len() - 1], self.shapes[number]);
        let (low, high) = neighbors(grid, value);
        let steps = if is_of_decades(grid) {
            [value * low / high, value * high / low]
        } else {
            [value - (high - low), value + (high - low)]
        };
        let least = (1.0 - HARDLY) * drop(self);
        steps.into_iter().all(|step| {
            let mut shapes = self.shapes.clone();
            shapes[number] = step.clamp(first, last);
            drop(&Self::new(self.candidate, shapes, rows)) < least
        })
    }

    /// A shape of which hardly anything changes near the end of its range is at no end: it takes the next value of its grid.
    fn away_from_ends(mut self, drop: &dyn Fn(&Self) -> f64, rows: Rows) -> Self {
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
            let inside = Self::new(self.candidate, shapes, rows);
            if drop(&inside) >= (1.0 - HARDLY) * drop(&self) {
                self = inside;
            }
        }
        self
    }
}

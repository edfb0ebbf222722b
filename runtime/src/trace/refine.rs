//! From the best point of a grid to where a candidate explains most.

use std::convert::Infallible;

use crate::columns::Entry;
use crate::identify::{golden, is_of_decades, moved, neighbors};

use super::rows::Rows;
use super::score::Present;
use super::trial::{Presence, Trial, presence};

/// How much less a candidate may explain with a shape that hardly changes anything: a share of what it explains, and one of what it leaves. A limit
/// that is far exceeded explains nearly all wherever it is, and what it leaves tells where.
const HARDLY: f64 = 1e-3;
const HARDLY_OF_REST: f64 = 0.05;

/// A shape with so few values on its grid is begun at each of them.
const COARSE: usize = 3;

/// Steps of all shapes together, shares of a step that are tried, and by what share more has to be explained.
const STEPS: usize = 8;
const HALVES: [f64; 4] = [1.0, 0.5, 0.25, 0.125];
const LEAST_GAIN: f64 = 1e-5;

/// How much a candidate explains of the residual beside the model.
struct Explained<'a> {
    present: &'a Present<'a>,
    /// The power of the residual of its joints, in the same units.
    power: f64,
}

impl<'a> Explained<'a> {
    fn new(present: &'a Present<'a>, trial: &Trial) -> Self {
        let joints = trial.touched().into_iter();
        Self {
            present,
            power: joints.map(|joint| present.power(joint)).sum(),
        }
    }

    fn drop(&self, trial: &Trial) -> f64 {
        let projected = trial.project(self.present);
        projected.map_or(0.0, |p| p.admissible_drop(trial.candidate))
    }

    /// What is hardly less than what a candidate explains.
    fn hardly_less(&self, trial: &Trial) -> f64 {
        hardly_less(self.drop(trial), self.power)
    }
}

fn hardly_less(drop: f64, power: f64) -> f64 {
    drop - (HARDLY * drop).min(HARDLY_OF_REST * (power - drop).max(0.0))
}

impl Trial<'_> {
    /// Moves each shape between its neighbors on the grid to where the candidate explains most; `finely` all of them
    /// together from there on, and from other values of shapes with a coarse grid, too.
    pub(super) fn refined(&self, present: &Present, rows: Rows, finely: bool) -> Self {
        let explained = Explained::new(present, self);
        let mut best = self.one_by_one(&explained, rows);
        if finely && !best.shapes.is_empty() {
            best = best.together(&explained, rows);
            for start in self.other_starts(rows) {
                let start = start.one_by_one(&explained, rows);
                let other = start.together(&explained, rows);
                if explained.drop(&other) > explained.drop(&best) {
                    best = other;
                }
            }
        }
        let mut best = best.away_from_ends(&explained, rows);
        let presence = presence(best.candidate, &best.shapes, rows.logs);
        // A law with one shape has one end at most, and may be nothing at the first sample alone, as what drifts from there on is.
        if best.shapes.len() > 1 || presence == Presence::ComesAndGoes {
            best.presence = presence;
        }
        if best.shapes.len() > 1 {
            let numbers = 0..best.shapes.len();
            best.is_felt = numbers
                .map(|number| best.feels(number, &explained, rows))
                .collect();
        }
        best
    }

    /// Moves each shape between its neighbors on the grid, one after the other.
    fn one_by_one(&self, explained: &Explained, rows: Rows) -> Self {
        let mut best = self.clone();
        for number in 0..self.shapes.len() {
            let grid = &self.candidate.shapes()[number].grid;
            let at = |value: f64| best.with(number, value, rows);
            let (low, high) = neighbors(grid, self.shapes[number]);
            let Ok(value) = golden(low, high, &mut |value| {
                Ok::<_, Infallible>(-explained.drop(&at(value)))
            });
            let refined = at(value);
            if explained.drop(&refined) > explained.drop(&best) {
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
            values.map(move |&value| self.with(number, value, rows))
        });
        others.collect()
    }

    /// Moves all shapes along the slopes of the torque (Gauss and Newton) as long as that explains more: width and sharpness of a loop are
    /// not found one after the other.
    fn together(mut self, explained: &Explained, rows: Rows) -> Self {
        let mut most = explained.drop(&self);
        for _ in 0..STEPS {
            let Some(step) = self.step(explained.present, rows) else {
                break;
            };
            let shares = HALVES.iter().map(|share| {
                let next = self.moved(&step, *share, rows);
                (explained.drop(&next), next)
            });
            let least = (1.0 + LEAST_GAIN) * most;
            let Some((more, next)) = shares.into_iter().find(|(more, _)| *more > least) else {
                break;
            };
            (most, self) = (more, next);
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
    fn feels(&self, number: usize, explained: &Explained, rows: Rows) -> bool {
        let grid = &self.candidate.shapes()[number].grid;
        let (first, last, value) = (grid[0], grid[grid.len() - 1], self.shapes[number]);
        let (low, high) = neighbors(grid, value);
        let steps = if is_of_decades(grid) {
            [value * low / high, value * high / low]
        } else {
            [value - (high - low), value + (high - low)]
        };
        let least = explained.hardly_less(self);
        steps.into_iter().all(|step| {
            let stepped = self.with(number, step.clamp(first, last), rows);
            explained.drop(&stepped) < least
        })
    }

    /// With one shape at another value.
    fn with(&self, number: usize, value: f64, rows: Rows) -> Self {
        let mut shapes = self.shapes.clone();
        shapes[number] = value;
        Self::new(self.candidate, shapes, rows)
    }

    /// A shape of which hardly anything changes near the end of its range is at no end: it takes the next value of its grid.
    fn away_from_ends(mut self, explained: &Explained, rows: Rows) -> Self {
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
            let inside = self.with(number, inner, rows);
            // Whatever it is to what is left: a law may be best at the end and no other law.
            if explained.drop(&inside) >= (1.0 - HARDLY) * explained.drop(&self) {
                self = inside;
            }
        }
        self
    }
}

#[cfg(test)]
mod tests {
    use super::hardly_less;

    /// What is a thousandth of what is explained may be most of what is left.
    #[test]
    fn a_shape_is_felt_in_what_is_left_too() {
        let less = |drop: f64| drop - hardly_less(drop, 1000.0);
        assert!((less(500.0) - 0.5).abs() < 1e-9);
        assert!((less(999.9) - 0.005).abs() < 1e-9);
        // All of it: rounding.
        assert!(less(1000.1).abs() < 1e-9);
    }
}

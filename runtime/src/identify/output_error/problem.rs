//! What a search fits: windows of logs, and what drives them.

use std::ops::Range;

use nalgebra::DVector;

use super::law::Law;
use super::recording::Hold;
use super::run::{Asked, Run};
use super::search::End;
use super::window::{Rows, Window};
use crate::simulate::{Adjustable, SimulateError};
use crate::threads;

/// A place of the search: parameters, and where each window starts.
#[derive(Debug, Clone)]
pub(super) struct Place {
    pub values: Vec<f64>,
    pub starts: Vec<DVector<f64>>,
}

/// All windows with what they are fitted by.
pub(super) struct Problem<'a, P> {
    pub plant: P,
    pub windows: Vec<Window<'a>>,
    pub law: Option<&'a Law>,
    pub hold: Hold,
    /// Where windows start, if that is not fitted.
    pub held_starts: Option<&'a [Vec<f64>]>,
    /// One a joint.
    pub scale: Vec<f64>,
    /// Iterations of a search.
    pub most: usize,
    pub end: End,
    /// Which part of the whole a search of it is, from 0 to 1.
    pub part: Range<f64>,
}

impl<P: Adjustable + Clone + Sync> Problem<'_, P> {
    /// Simulates all windows, on all cores; which of them fails first is said with its error.
    pub fn run(&mut self, place: &Place, asked: Asked) -> Result<Vec<Run>, (usize, SimulateError)> {
        self.plant.adjust(&place.values);
        let (plant, law, hold) = (&self.plant, self.law, self.hold);
        let windows: Vec<_> = self.windows.iter().zip(&place.starts).collect();
        let runs = threads::map(&windows, |(window, start)| {
            window.run(plant, start, law, hold, asked)
        });
        let runs = runs.into_iter().enumerate();
        runs.map(|(k, run)| run.map_err(|error| (k, error)))
            .collect()
    }

    /// Whether simulations are looked at at some of the samples only.
    pub fn is_coarse(&self) -> bool {
        self.windows.iter().any(Window::is_coarse)
    }

    /// These parameters, and starts as logs have them.
    pub fn place(&mut self, values: &[f64]) -> Place {
        self.plant.adjust(values);
        let starts = if let Some(held) = self.held_starts {
            let held = held.iter();
            held.map(|start| DVector::from_column_slice(start))
                .collect()
        } else {
            let windows = self.windows.iter();
            windows.map(|window| window.start(&self.plant)).collect()
        };
        Place {
            starts,
            values: values.to_vec(),
        }
    }

    /// Windows that begin where one of another problem does start as that was found to.
    pub fn start_as(&self, place: &mut Place, other: &Self, known: &Place) {
        for (start, window) in place.starts.iter_mut().zip(&self.windows) {
            let same = other
                .windows
                .iter()
                .position(|other| other.begins_as(window));
            if let Some(same) = same {
                start.clone_from(&known.starts[same]);
            }
        }
    }

    pub fn rows(&self, runs: &[Run]) -> Vec<Rows> {
        let runs = self.windows.iter().zip(runs);
        let rows = runs.map(|(window, run)| {
            let mut rows = window.rows(run, &self.scale);
            if self.held_starts.is_some() {
                rows.by_start.fill(0.0);
            }
            rows
        });
        rows.collect()
    }

    pub fn cost(&self, runs: &[Run]) -> f64 {
        let rows = self.windows.iter().zip(runs);
        let squares = rows.map(|(window, run)| window.squares(run, &self.scale));
        0.5 * squares.flatten().sum::<f64>()
    }

    /// Root mean square of the errors of each joint.
    pub fn spread(&self, runs: &[Run]) -> Vec<f64> {
        let ones = vec![1.0; self.scale.len()];
        let mut sums = vec![0.0; ones.len()];
        let mut samples = 0;
        for (window, run) in self.windows.iter().zip(runs) {
            samples += window.counted();
            let squares = window.squares(run, &ones);
            sums.iter_mut().zip(squares).for_each(|(sum, x)| *sum += x);
        }
        let root = |sum: f64| (sum / samples.max(1) as f64).sqrt();
        sums.into_iter().map(root).collect()
    }

    /// Samples of all joints that count.
    pub fn samples(&self) -> usize {
        let counted = self.windows.iter().map(Window::counted);
        self.scale.len() * counted.sum::<usize>()
    }

    /// What joints are weighed by: their errors, but none by less than a share of the largest, so that one that is exact does not drown the
    /// others.
    pub fn scales(&self, runs: &[Run]) -> Vec<f64> {
        let spread = self.spread(runs);
        let largest = spread.iter().copied().fold(f64::MIN_POSITIVE, f64::max);
        let scales = spread.into_iter();
        scales.map(|scale| scale.max(1e-3 * largest)).collect()
    }
}

//! Folds of a model with a column that comes once.
//!
//! A contact of three seconds, declared or named, is in one or two of the blocks of time that are held out together. What they then make of it is
//! an extrapolation, which is as large as the contact, and any law that bends it is right or wrong by chance.

use std::ops::Range;

use crate::identify::{Segment, Stack};

use super::folds::{FINER_S, Fold, fine};
use super::search::{Search, State};

/// A column that comes once is next to nothing, over its largest value, for a run of so large a share of the log, or of its period: filters leave
/// less of a contact behind, and the noise of a joint that stands is more.
const NEXT_TO_NOTHING: f64 = 1e-6;
const LONG: f64 = 0.2;

/// A model is judged on folds whose training has at least this share of the power of each column that comes once which it would have of one that is
/// as large all along. Where some fold has less, as of a contact that was named, what is held out is what the others make of a torque that they
/// hardly know; so intervals are finer until all have the second share, or as much as there can be.
const LEAST_KNOWN_OF_MODEL: f64 = 0.4;
const WELL_KNOWN: f64 = 0.7;

impl Search<'_> {
    /// The folds that a model is judged on, and candidates beside it.
    pub(super) fn folds_of<'a>(&'a self, state: &'a State) -> &'a [Fold] {
        let known = || knowing(&self.folds, &state.stack, &self.periods);
        let own = state.looks.folds.get_or_init(known);
        own.as_deref().unwrap_or(&self.folds)
    }
}

/// Folds of finer intervals where the training of some fold has too little of a column of a model, and of finer ones has more.
pub(super) fn knowing(folds: &[Fold], stack: &Stack, periods: &[Option<f64>]) -> Option<Vec<Fold>> {
    let long = LONG * cycle(&stack.segments, periods);
    let least_known = |folds: &[Fold]| least_known(folds, stack, long);
    let mut most = least_known(folds);
    let mut best = None;
    if most >= LEAST_KNOWN_OF_MODEL {
        return best;
    }
    for interval in FINER_S {
        let folds = fine(&stack.segments, periods, interval);
        let known = least_known(&folds);
        if known > most {
            (most, best) = (known, Some(folds));
        }
        if known >= WELL_KNOWN {
            break;
        }
    }
    best
}

/// Rows of the shortest log, or period of one.
fn cycle(segments: &[Segment], periods: &[Option<f64>]) -> f64 {
    let rows = segments.iter().zip(periods).map(|(segment, period)| {
        let ends = segment.time.first().zip(segment.time.last());
        let length = ends.map_or(0.0, |(first, last)| last - first);
        let share = period.map_or(1.0, |period| period / length.max(period));
        share * segment.time.len() as f64
    });
    rows.fold(f64::INFINITY, f64::min)
}

/// Runs of so many rows in which a column is next to nothing.
fn runs_of_nothing(values: &[f64], long: f64) -> Vec<Range<usize>> {
    let largest = values.iter().fold(0.0_f64, |most, v| most.max(v.abs()));
    let is_there = |value: &f64| value.abs() > NEXT_TO_NOTHING * largest;
    let mut next = 0;
    let runs = values.split(is_there).map(|run| {
        let first = next;
        next = first + run.len() + 1;
        first..first + run.len()
    });
    runs.filter(|run| !run.is_empty() && run.len() as f64 >= long)
        .collect()
}

/// Whether a column is next to nothing for a run of so many rows.
fn comes_once(values: &[f64], long: f64) -> bool {
    !runs_of_nothing(values, long).is_empty()
}

impl Search<'_> {
    /// Rows of a log, of all logs, at which a column of a joint's model that comes once begins or ends.
    pub(super) fn edges_of_columns(&self, stack: &Stack, joint: usize, log: usize) -> Vec<usize> {
        let segment = &stack.segments[log];
        let rows = segment.start..segment.start + segment.time.len();
        let long = LONG * cycle(&stack.segments, &self.periods);
        let columns = stack.joints[joint].columns.iter();
        let edges = columns.flat_map(|(_, values)| {
            let runs = runs_of_nothing(&values[rows.clone()], long).into_iter();
            runs.flat_map(|run| [run.start, run.end])
        });
        let inside = edges.filter(|row| (1..rows.len()).contains(row));
        inside.collect()
    }
}

/// The least share of the power of a column that comes once which the training of a fold has, over its share of rows.
fn least_known(folds: &[Fold], stack: &Stack, long: f64) -> f64 {
    let mut once = vec![true; stack.unknowns.len()];
    for (column, values) in stack.joints.iter().flat_map(|joint| &joint.columns) {
        once[*column] &= comes_once(values, long);
    }
    let all: Vec<usize> = (0..stack.samples()).collect();
    let powers = |rows: &[usize]| {
        let mut powers = vec![0.0; stack.unknowns.len()];
        for (column, values) in stack.joints.iter().flat_map(|joint| &joint.columns) {
            if !once[*column] {
                continue;
            }
            powers[*column] += rows.iter().map(|&row| values[row].powi(2)).sum::<f64>();
        }
        powers
    };
    let all = powers(&all);
    let shares = folds.iter().flat_map(|fold| {
        let known = powers(&fold.train);
        let of_rows = fold.train.len().max(1) as f64 / stack.samples() as f64;
        let shares = known.into_iter().zip(&all).filter(|(_, all)| **all > 0.0);
        let shares = shares.map(move |(known, all)| known / all / of_rows);
        shares.collect::<Vec<_>>()
    });
    shares.fold(1.0, f64::min)
}

#[cfg(test)]
mod tests {
    use super::super::folds::cut;
    use super::*;
    use crate::columns::Unknown;
    use crate::identify::JointRows;

    #[test]
    fn a_column_that_comes_once_has_the_edges_of_its_long_runs_of_nothing() {
        let column = [0.0, 0.0, 0.0, 1.0, 0.0, 2.0, 0.0, 0.0, 0.0, 0.0];
        assert_eq!(runs_of_nothing(&column, 3.0), [0..3, 6..10]);
        assert_eq!(runs_of_nothing(&column, 4.0).first(), Some(&(6..10)));
        assert_eq!(runs_of_nothing(&[1.0; 4], 1.0), []);
        assert!(comes_once(&[0.0; 4], 4.0) && !comes_once(&column, 5.0));
    }

    /// Of a force that is there for three seconds some fold of those of all knows next to nothing, and of the torque of a motion all know enough.
    #[test]
    fn every_fold_knows_the_columns_of_a_model() {
        let time: Vec<f64> = (0..1000).map(|k| f64::from(k) / 40.0).collect();
        let there = |t: &f64| f64::from(u8::from((9.7..12.9).contains(t)));
        let force: Vec<f64> = time.iter().map(there).collect();
        let motion: Vec<f64> = time.iter().map(|t| (1.3 * t).sin()).collect();
        let segments = vec![Segment { start: 0, time }];
        let unknown = |name: &str| Unknown {
            name: name.to_owned(),
            nonnegative: false,
        };
        let stack = |columns: Vec<(usize, Vec<f64>)>| Stack {
            unknowns: vec![unknown("motion"), unknown("force")],
            joints: vec![JointRows {
                tau: motion.clone(),
                target: motion.clone(),
                columns,
            }],
            segments: segments.clone(),
            ..Stack::default()
        };
        let coarse = cut(&segments, &[None]);
        let of_motion = stack(vec![(0, motion.clone())]);
        assert_eq!(knowing(&coarse, &of_motion, &[None]), None);
        let with_force = stack(vec![(0, motion.clone()), (1, force)]);
        assert!(least_known(&coarse, &with_force, 200.0) < 0.3);
        let folds = knowing(&coarse, &with_force, &[None]).expect("finer folds");
        assert!(least_known(&folds, &with_force, 200.0) > WELL_KNOWN);
    }
}

//! How a log is cut for cross-validation, so that no fold is judged by what it was fitted on.
//!
//! A motion that repeats shows every fold the same phase again, so folds of a periodic log are intervals of the phase, the
//! same in every period. Folds of other logs are blocks of time. Training keeps a gap to both sides of what is tested.

use std::ops::Range;

use crate::columns::Entry;
use crate::identify::Segment;
use crate::signal::resample::whole_steps;

use super::once::knowing;
use super::search::{Search, State, is_of_phase};
use super::trial::{Presence, Trial};

/// Number of folds.
pub(super) const FOLDS: usize = 5;

/// Shortest interval of the phase of which a fold has two, s; below it has one.
const INTERVAL_S: f64 = 1.0;

/// Length of a block of a motion without period, s, and the least number of blocks per fold.
const BLOCK_S: f64 = 3.0;
const LEAST_BLOCKS_PER_FOLD: usize = 2;

/// Gap between training and test samples, s: several times the shared filter's memory; and its largest share of a period,
/// so that short periods keep rows to train on.
const GAP_S: f64 = 0.4;
const GAP_SHARE: f64 = 0.08;

/// What comes once is cut into intervals of its own, one a fold, of so many seconds at least; the gap between training and test samples
/// is this share of one at most.
const LEAST_INTERVAL_S: f64 = 0.4;
const GAP_OF_INTERVAL: f64 = 0.2;

/// A fold says something of a law where its training has this share of the law's power, and folds of a drive's limit are cut so finely, s, that
/// they do.
const LEAST_KNOWN: f64 = 0.2;
pub(super) const FINER_S: [f64; 4] = [1.6, 0.8, 0.4, 0.2];

/// A law is there where its column is more than this share of the largest value.
const THERE: f64 = 0.05;

/// One fold: rows to judge on, rows to fit on.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Fold {
    pub(super) test: Vec<usize>,
    pub(super) train: Vec<usize>,
}

impl Search<'_> {
    /// The folds that a candidate is judged on where they are not those of all.
    ///
    /// A law of the part of a period has blocks of time. What is there once, as a contact is, may be in a single block, so that no fold that
    /// leaves it out knows anything of it: blocks are short enough that every fold has some of it. So it is with the limit of a drive, which a
    /// motion may reach at a single place of its period.
    pub(super) fn own_folds(&self, trial: &Trial, state: &State) -> Option<Vec<Fold>> {
        let segments = &state.stack.segments[..];
        if is_of_phase(trial.candidate) {
            let blocks = vec![None; segments.len()];
            let folds = cut(segments, &blocks);
            return Some(knowing(&folds, &state.stack, &blocks).unwrap_or(folds));
        }
        if trial.candidate.follows_torque() && !all_know(&self.folds, &trial.entries) {
            return finer(segments, &self.periods, &trial.entries);
        }
        if trial.presence != Presence::ComesAndGoes || self.periods.iter().all(Option::is_some) {
            return None;
        }
        let interval = shortest(trial, segments)? / FOLDS as f64;
        let cuts = segments.iter().zip(&self.periods);
        let cuts = cuts.map(|(segment, period)| match period {
            Some(_) => Cut::new(segment, *period),
            None => Cut::fine(segment, None, interval.max(LEAST_INTERVAL_S)),
        });
        (interval < BLOCK_S).then(|| by(segments, cuts))
    }
}

/// Folds of intervals that are about so long, s.
pub(super) fn fine(segments: &[Segment], periods: &[Option<f64>], interval: f64) -> Vec<Fold> {
    let cuts = segments.iter().zip(periods);
    let cuts = cuts.map(|(segment, period)| Cut::fine(segment, *period, interval));
    by(segments, cuts)
}

/// The coarsest folds of finer intervals whose training has enough of a law; none where it is too short for all.
fn finer(segments: &[Segment], periods: &[Option<f64>], entries: &[Entry]) -> Option<Vec<Fold>> {
    let mut folds = FINER_S
        .iter()
        .map(|interval| fine(segments, periods, *interval));
    folds.find(|folds| all_know(folds, entries))
}

/// Whether the training of every fold has enough of a law.
fn all_know(folds: &[Fold], entries: &[Entry]) -> bool {
    let entries = || entries.iter().map(|entry| &entry.values);
    let power = |values: &Vec<f64>| values.iter().map(|v| v * v).sum::<f64>();
    let all: f64 = entries().map(power).sum();
    let known = |fold: &Fold| {
        let powers = entries().map(|values| {
            let of_row = fold.train.iter().map(|&row| values[row].powi(2));
            of_row.sum::<f64>()
        });
        powers.sum::<f64>() >= LEAST_KNOWN * all
    };
    folds.iter().all(known)
}

/// How long a law is there from its first sample in a log to its last, s, in the log where that is shortest.
fn shortest(trial: &Trial, segments: &[Segment]) -> Option<f64> {
    let entries = trial.entries.iter().map(|entry| {
        let sizes = entry.values.iter().map(|value| value.abs());
        (entry, THERE * sizes.fold(0.0, f64::max))
    });
    // Filters leave a little of it everywhere.
    let entries: Vec<(&Entry, f64)> = entries.collect();
    let there = |segment: &Segment| -> Option<f64> {
        let rows: Range<usize> = segment.start..segment.start + segment.time.len();
        let is_there = |row: &usize| {
            let mut entries = entries.iter();
            entries.any(|(entry, least)| entry.values[*row].abs() > *least)
        };
        let first = rows.clone().find(is_there)?;
        let last = rows.rev().find(is_there)?;
        Some(segment.time[last - segment.start] - segment.time[first - segment.start])
    };
    segments.iter().filter_map(there).min_by(f64::total_cmp)
}

/// Cuts the rows of all logs into folds. `periods` has one entry a log.
pub(super) fn cut(segments: &[Segment], periods: &[Option<f64>]) -> Vec<Fold> {
    let cuts = segments.iter().zip(periods);
    by(
        segments,
        cuts.map(|(segment, period)| Cut::new(segment, *period)),
    )
}

/// The folds of logs that are cut so.
fn by(segments: &[Segment], cuts: impl Iterator<Item = Cut>) -> Vec<Fold> {
    // For every row the fold that it tests, and those of the instants a gap before and after it.
    let mut places: Vec<[usize; 3]> = Vec::new();
    for (segment, cut) in segments.iter().zip(cuts) {
        places.extend(
            segment
                .time
                .iter()
                .map(|time| [-cut.gap, 0.0, cut.gap].map(|shift| cut.fold(time + shift))),
        );
    }
    (0..FOLDS)
        .map(|fold| Fold {
            test: (0..places.len())
                .filter(|k| places[*k][1] == fold)
                .collect(),
            train: (0..places.len())
                .filter(|k| !places[*k].contains(&fold))
                .collect(),
        })
        .collect()
}

/// How one log is cut.
struct Cut {
    first: f64,
    /// Period of the motion, or length of the log, s.
    cycle: f64,
    intervals: usize,
    gap: f64,
}

impl Cut {
    fn new(segment: &Segment, period: Option<f64>) -> Self {
        let first = segment.time.first().copied().unwrap_or(0.0);
        let length = segment
            .time
            .last()
            .map_or(0.0, |last| last - first)
            .max(f64::MIN_POSITIVE);
        let (cycle, per_fold) = match period {
            Some(period) if period >= 2.0 * FOLDS as f64 * INTERVAL_S => (period, 2),
            Some(period) => (period, 1),
            None => (
                length,
                whole_steps(length / (BLOCK_S * FOLDS as f64)).max(LEAST_BLOCKS_PER_FOLD),
            ),
        };
        Self {
            first,
            cycle,
            intervals: FOLDS * per_fold,
            gap: GAP_S.min(GAP_SHARE * cycle),
        }
    }

    /// One of intervals that are about so long, s.
    fn fine(segment: &Segment, period: Option<f64>, interval: f64) -> Self {
        let whole = Self::new(segment, period);
        let intervals = whole_steps((whole.cycle / interval).round()).max(FOLDS);
        Self {
            intervals,
            gap: GAP_S.min(GAP_OF_INTERVAL * whole.cycle / intervals as f64),
            ..whole
        }
    }

    /// The fold that tests an instant. The ends of a cycle touch; those of a log without period may as well.
    fn fold(&self, time: f64) -> usize {
        // A little more than nothing: a sample on a boundary falls to the same side in every period.
        let phase = ((time - self.first) / self.cycle + 1e-9).rem_euclid(1.0);
        whole_steps(phase * self.intervals as f64) % FOLDS
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// What is there for four seconds is in every fold, wherever it begins.
    #[test]
    fn every_fold_has_some_of_what_comes_once() {
        let time: Vec<f64> = (0..1600).map(|k| f64::from(k) / 40.0).collect();
        let segments = [Segment { start: 0, time }];
        let share = |rows: &[usize], from: usize| {
            let there = rows.iter().filter(|row| (from..from + 160).contains(*row));
            there.count() as f64 / 160.0
        };
        let fine = by(
            &segments,
            segments.iter().map(|one| Cut::fine(one, None, 0.8)),
        );
        let coarse = cut(&segments, &[None]);
        let mut least_of_coarse = 1.0_f64;
        for from in (0..1440).step_by(7) {
            for fold in &fine {
                assert!((share(&fold.test, from) - 0.2).abs() < 0.05, "{from}");
                assert!(share(&fold.train, from) > 0.6, "{from}");
            }
            let known = coarse.iter().map(|fold| share(&fold.train, from));
            least_of_coarse = known.fold(least_of_coarse, f64::min);
        }
        assert!(least_of_coarse < 0.1, "{least_of_coarse}");
    }

    /// A limit that is reached for 0.7 s of a period of 10 s is in one fold of those of all, which then says nothing of it.
    #[test]
    fn every_fold_knows_a_limit_that_is_reached_at_one_place_of_a_period() {
        let time: Vec<f64> = (0..800).map(|k| f64::from(k) / 40.0).collect();
        let excess = |from: f64, to: f64| {
            let there = time.iter().map(|t| {
                let phase = t.rem_euclid(10.0);
                f64::from(u8::from((from..to).contains(&phase)))
            });
            vec![Entry {
                joint: 0,
                column: 0,
                values: there.collect(),
            }]
        };
        let segments = [Segment {
            start: 0,
            time: time.clone(),
        }];
        let periods = [Some(10.0)];
        let limit = excess(6.6, 7.3);
        assert!(!all_know(&cut(&segments, &periods), &limit));
        let folds = finer(&segments, &periods, &limit).expect("folds that know it");
        assert!(all_know(&folds, &limit));
        // Phases of the test are trained on in no period.
        for fold in &folds {
            let row = fold.test[fold.test.len() / 2];
            assert!(!fold.train.contains(&((row + 400) % 800)), "{row}");
        }
        assert_eq!(finer(&segments, &periods, &excess(7.0, 7.05)), None);
    }

    #[test]
    fn folds_of_a_periodic_log_never_share_a_phase() {
        for cycle in [0.8, 2.0, 5.0, 20.0 / 3.0, 10.0] {
            let time: Vec<f64> = (0..1200).map(|k| 0.1 + f64::from(k) / 40.0).collect();
            let phase = |k: usize| ((time[k] - time[0]) / cycle).fract();
            let segment = Segment {
                start: 0,
                time: time.clone(),
            };
            let folds = cut(&[segment], &[Some(cycle)]);
            assert_eq!(folds.iter().map(|f| f.test.len()).sum::<usize>(), 1200);
            for fold in &folds {
                assert!(
                    fold.train.len() > 400,
                    "period {cycle}: {} rows to train on",
                    fold.train.len()
                );
                for &test in &fold.test {
                    let apart = |k: &usize| {
                        let difference = (phase(*k) - phase(test)).abs();
                        difference.min(1.0 - difference)
                    };
                    let nearest = fold.train.iter().map(apart).fold(f64::INFINITY, f64::min);
                    assert!(
                        nearest > 0.02,
                        "period {cycle}: a phase of the test is trained on: {nearest}"
                    );
                }
            }
        }
    }
}

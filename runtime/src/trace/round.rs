//! One round of the search: candidates are judged, and the best that passes is chosen.

use crate::identify::longest_period;
use crate::motion::Motion;
use crate::threads;

use super::choose::choose;
use super::gate::{self, Baseline, Judged, MATERIAL_PERCENT};
use super::gram::Gram;
use super::grid::{self, Grid};
use super::multiplicity;
use super::rows::Rows;
use super::score::Present;
use super::search::{Accepted, Search, State, is_of_phase};
use super::trial::Trial;
use super::verdict::{Refusal, Tried};

/// Candidates that are fitted on every fold in a round, by how much of the residual they explain.
const FINALISTS: usize = 16;

/// Candidates whose shapes are refined together: what a shape is off by stays in the residual, and looks like another effect.
const FINELY: usize = 3;

/// Share of what comes back in every period that a law of the part of a period may leave.
const LEFT_OF_PERIOD: f64 = 0.15;

/// Changes of the arm that are tried as what they are in a round.
const CHANGES: usize = 3;

/// Shares of a round's time in which all candidates are looked at, and after which finalists are judged first; in the rest changes are
/// solved for.
const LOOKED: f64 = 0.4;
const FIRST: f64 = 0.7;

/// A finalist as it is judged first, a change by its first order.
struct First<'a> {
    judged: Judged<'a>,
    /// Its parameters beside the model.
    gain: Vec<f64>,
}

impl Search<'_> {
    /// One round: the best candidate that passes, with its rivals. `done` gets what part of it is behind.
    pub(super) fn round<'a>(
        &self,
        state: &State,
        grids: &[Grid<'a>],
        told: &mut Vec<Tried>,
        done: &mut dyn FnMut(f64),
    ) -> Option<Accepted<'a>> {
        done(0.0);
        let mut judged = self.judged(state, grids, done);
        for judged in &mut judged {
            if judged.passes() && !self.is_told(state, judged) {
                judged.refusals.push(Refusal::Undetermined);
            }
        }
        let round = state.accepted.len();
        told.extend(judged.iter().map(|judged| judged.told(round)));
        judged.retain(Judged::passes);
        judged.sort_by(|a, b| b.merit.total_cmp(&a.merit));
        choose(judged, &|one, other, rivals| {
            self.encompasses(state, one, other, rivals)
        })
    }

    /// The torque that explains most of those that have nothing against them but their size.
    pub(super) fn small<'a>(&self, state: &State, grids: &[Grid<'a>]) -> Option<Accepted<'a>> {
        let mut judged = self.judged(state, grids, &mut |_| ());
        // What makes a raw error worse is mostly noise of its own columns, beside which structure that stays would seem small.
        let is_quiet = |judged: &Judged| {
            let mut percent = judged.evidence.raw_percent.iter();
            percent.all(|percent| *percent > -MATERIAL_PERCENT)
        };
        judged.retain(|judged| {
            judged.refusals == [Refusal::Small] && judged.changed.is_none() && is_quiet(judged)
        });
        let best = judged
            .into_iter()
            .max_by(|a, b| a.merit.total_cmp(&b.merit))?;
        let mut small = choose(vec![best], &|_, _, _| false)?;
        small.is_small = true;
        Some(small)
    }

    /// The candidates that explain most, judged.
    fn judged<'a>(
        &self,
        state: &State,
        grids: &[Grid<'a>],
        done: &mut dyn FnMut(f64),
    ) -> Vec<Judged<'a>> {
        let motions: Vec<Motion> = self.prepared.iter().map(grid::rows).collect();
        let rows = Rows::new(&self.prepared, &state.stack);
        let tests = self.tests.get_or_init(|| {
            let (stack, sigma) = (&state.stack, &state.solution.sigma);
            let present = Present::new(stack, &Gram::new(stack, &[]), sigma, &state.residuals);
            multiplicity::tests(&present, grids, &motions)
        });
        let baseline = self.baseline(state, *tests, self.folds_of(state));
        let part = |done: usize, of: usize| done as f64 / of as f64;
        let mut best: Vec<(f64, Trial)> = Vec::new();
        for (place, grid) in grids.iter().enumerate() {
            best.extend(grid.best(&baseline.present, rows, &motions));
            done(LOOKED * part(place + 1, grids.len()));
        }
        best.sort_by(|a, b| b.0.total_cmp(&a.0));
        best.truncate(FINALISTS);
        let finalists: Vec<(usize, Trial)> = best
            .into_iter()
            .enumerate()
            .map(|(place, (_, trial))| (place, trial))
            .collect();
        let first = threads::map_told(
            &finalists,
            |(place, trial)| self.first_judged(state, &baseline, trial, *place < FINELY),
            &mut |judged| done(LOOKED + (FIRST - LOOKED) * part(judged, finalists.len())),
        );
        let mut first: Vec<First> = first.into_iter().flatten().collect();
        let mut changes = 0;
        first.retain(|first| {
            let is_change = first.judged.trial.candidate.change().is_some();
            let is_tried = !is_change || (changes < CHANGES && gate::is_promising(&first.judged));
            changes += usize::from(is_change && is_tried);
            is_tried
        });
        let whole = threads::map_told(
            &first,
            |first| self.as_what_it_is(state, &baseline, first),
            &mut |judged| done(FIRST + (1.0 - FIRST) * part(judged, first.len())),
        );
        let pairs = first.into_iter().zip(whole);
        pairs
            .map(|(first, whole)| whole.unwrap_or(first.judged))
            .collect()
    }

    /// A finalist with all that is asked of a torque that is added, and of the first order of a change; nothing where the model spans it.
    fn first_judged<'a>(
        &self,
        state: &State,
        baseline: &Baseline,
        trial: &Trial<'a>,
        finely: bool,
    ) -> Option<First<'a>> {
        let rows = Rows::new(&self.prepared, &state.stack);
        let trial = trial.clone().refined(&baseline.present, rows, finely);
        let projected = trial.project(&baseline.present)?;
        let mut judged = match self.own_folds(&trial, state) {
            Some(folds) => Judged {
                // They are compared with those of no other law.
                fold_power: Vec::new(),
                ..baseline.on(&folds).judge(trial, &projected)
            },
            None => baseline.judge(trial, &projected),
        };
        if is_of_phase(judged.trial.candidate) {
            let rest = baseline.present.rest(&judged.trial.entries, &projected);
            if self.comes_back(state, &judged, &rest) {
                judged.refusals.push(Refusal::ComesBack);
            }
        }
        if judged.trial.candidate.change().is_none() {
            if judged.refusals == [Refusal::Small]
                && self.is_large_elsewhere(state, &judged, &projected)
            {
                judged.refusals.clear();
            }
            let follows_torque = judged.trial.candidate.follows_torque();
            if follows_torque && !self.is_of_structure(state, &judged) {
                judged.refusals.push(Refusal::Noise);
            }
            if Self::is_trimming(state, &judged) && !judged.refusals.contains(&Refusal::Small) {
                judged.refusals.push(Refusal::Small);
            }
        }
        Some(First {
            judged,
            gain: projected.gain,
        })
    }

    /// Whether a law is there already on the same joints, and a second instance of it takes off less than matters of the error that there was
    /// without the first: it is what the first one is off by.
    fn is_trimming(state: &State, judged: &Judged) -> bool {
        let same = |first: &&Accepted| {
            let (first, candidate) = (first.trial.candidate, judged.trial.candidate);
            first.kind() == candidate.kind() && first.joints() == candidate.joints()
        };
        state.accepted.iter().find(same).is_some_and(|first| {
            let first = first.evidence.raw_percent.iter();
            let mut both = first.zip(&judged.evidence.raw_percent);
            both.all(|(first, second)| second * (1.0 - first / 100.0) < MATERIAL_PERCENT)
        })
    }

    /// A change whose first order is promising, tried as what it is; nothing of a torque that is added.
    fn as_what_it_is<'t>(
        &self,
        state: &State,
        baseline: &Baseline,
        first: &First<'t>,
    ) -> Option<Judged<'t>> {
        let change = first.judged.trial.candidate.change()?;
        let mut judged = first.judged.clone();
        // What cannot be solved for has no merit.
        let solved = self.solve_change(state, change, &first.gain);
        let Some(changed) = solved.ok().flatten() else {
            judged.refusals.push(Refusal::Unsolved);
            return Some(judged);
        };
        let counts = change.counts(&changed.shapes, longest_period(&self.prepared));
        let follows_torque = changed.follows_torque;
        judged = baseline.judge_changed(judged, changed, self.folds_of(state));
        // What bends and gaps do is at turns, too.
        if judged.passes() && !follows_torque && !self.holds_away_from_turns(state, &judged) {
            judged.refusals.push(Refusal::AtTurns);
        }
        if follows_torque && !self.is_more_than_noise(state, baseline, &judged, change) {
            judged.refusals.push(Refusal::Noise);
        }
        if !counts && !judged.refusals.contains(&Refusal::Small) {
            judged.refusals.push(Refusal::Small);
        }
        Some(judged)
    }

    /// Whether a law of the part of a period leaves too much of what comes back in every period on the joints where it matters, which any
    /// such law could have a share of: a force that is the whole of it is one.
    fn comes_back(&self, state: &State, judged: &Judged, rest: &[Vec<f64>]) -> bool {
        let percent = &judged.evidence.raw_percent;
        let matters = |joint: &usize| percent[*joint] >= MATERIAL_PERCENT;
        if !(0..rest.len()).any(|joint| matters(&joint)) {
            return false;
        }
        let power = |residuals: &[Vec<f64>]| -> f64 {
            let joints = (0..residuals.len()).filter(matters);
            let weighed = joints.map(|joint| {
                let sigma = state.solution.sigma[joint];
                self.repeated_power(state, &residuals[joint]) / (sigma * sigma)
            });
            weighed.sum()
        };
        power(rest) >= LEFT_OF_PERIOD * power(&state.residuals)
    }

    /// What has the logged torque in it lowers the error by what that has of noise, too: it counts where there is structure.
    fn is_of_structure(&self, state: &State, judged: &Judged) -> bool {
        let structure = self.structure_without_steps(state);
        let mut joints = structure.iter().zip(&judged.evidence.raw_percent);
        joints.any(|(structure, percent)| structure.is_material() && *percent >= MATERIAL_PERCENT)
    }
}

//! Forward search: the best effect that passes, then the next, until none does.

use std::collections::BTreeSet;
use std::sync::OnceLock;

use crate::columns::{Arm, Candidate};
use crate::identify::drowned::torque_of_noise;
use crate::identify::{
    Identify, IdentifyError, Method, check_logs, missing_input, prepare_all, slowest_bands,
};
use crate::log::Log;
use crate::signal::{Bands, Prepared, period};

use super::away::Looks;
use super::calm;
use super::conclude::{changed, verdict};
use super::folds;
use super::grid::Grid;
use super::raw::above;
use super::search::{Accepted, MOST_EFFECTS, Search, State};
use super::stage::Stage;
use super::structure::Structure;
use super::verdict::{Tried, Verdict};

/// A trace: candidates against the residual of an arm's declared model.
pub struct Trace<'a> {
    candidates: Vec<&'a dyn Candidate>,
    since: Option<Earlier>,
}

/// A trace of the same logs that ended with a change of the arm.
struct Earlier {
    /// What it had of structure before its first effect.
    before: Vec<Structure>,
    /// Effects that it named.
    named: usize,
}

impl<'a> Trace<'a> {
    /// A trace with these candidates; those that the spec declares are left out by the caller, those that read a channel
    /// that some log does not have by [`Self::run`].
    ///
    /// # Examples
    /// ```
    /// # mod pendulum { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/doc/pendulum.rs")); }
    /// # use pendulum::{dry_friction, measure, pendulum};
    /// use robot_model::trace::Trace;
    /// let (arm, candidate) = (pendulum(), dry_friction());
    /// let verdict = Trace::new(vec![&candidate]).run(&arm, &[measure(0.7)], &mut |_| ())?;
    /// assert!((verdict.findings[0].parameters[0].value - 0.7).abs() < 0.02); // N m
    /// # Ok::<(), robot_model::identify::IdentifyError>(())
    /// ```
    #[must_use]
    pub fn new(candidates: Vec<&'a dyn Candidate>) -> Self {
        Self {
            candidates,
            since: None,
        }
    }

    /// Goes on from a trace of the same logs that ended with a change of the arm: structure is that before its first effect, and its effects
    /// count among the [most](MOST_EFFECTS) that are looked for.
    ///
    /// # Examples
    /// ```
    /// # mod pendulum { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/doc/pendulum.rs")); }
    /// # use pendulum::{dry_friction, measure, pendulum};
    /// use robot_model::trace::Trace;
    /// let (arm, candidate) = (pendulum(), dry_friction());
    /// // The log that a first trace had before it found anything, and the one that is left to trace.
    /// let run = |trace: Trace<'_>, fc| trace.run(&arm, &[measure(fc)], &mut |_| ());
    /// let first = run(Trace::new(vec![&candidate]), 0.7)?;
    /// let later = run(Trace::new(vec![&candidate]).since(&first), 0.0)?;
    /// assert_eq!(later.before, first.before);
    /// # Ok::<(), robot_model::identify::IdentifyError>(())
    /// ```
    #[must_use]
    pub fn since(mut self, earlier: &Verdict) -> Self {
        self.since = Some(Earlier {
            before: earlier.before.clone(),
            named: earlier.findings.len(),
        });
        self
    }

    /// Runs the trace on the identification logs. `progress` is told whenever a stage begins or has come on.
    ///
    /// # Errors
    /// Those of [`Identify::fit`].
    ///
    /// # Examples
    /// ```
    /// # mod pendulum { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/doc/pendulum.rs")); }
    /// # use pendulum::{measure, pendulum};
    /// use robot_model::trace::Trace;
    /// let arm = pendulum();
    /// // With no candidate there is nothing to name what is there.
    /// let mut stages = 0;
    /// let verdict = Trace::new(Vec::new()).run(&arm, &[measure(0.7)], &mut |_| stages += 1)?;
    /// assert_eq!((verdict.outcome.name(), verdict.findings.len()), ("unexplained", 0));
    /// assert!(stages > 0);
    /// # Ok::<(), robot_model::identify::IdentifyError>(())
    /// ```
    pub fn run(
        &self,
        arm: &dyn Arm,
        logs: &[Log],
        progress: &mut dyn FnMut(&Stage<'_>),
    ) -> Result<Verdict, IdentifyError> {
        check_logs(arm, logs)?;
        let bands = slowest_bands(logs);
        let identify = Identify {
            method: Method::Wls,
            bands: Some(bands),
            ..Identify::default()
        };
        if logs.iter().all(|log| !log.turn_speeds.is_empty()) {
            return self.traced(arm, &identify, bands, logs, progress);
        }
        progress(&Stage::whole("fitting speeds at velocity reversals"));
        let speeds = identify.turn_speeds(arm, logs)?;
        let logs = Log::all_with_turn_speeds(logs, &speeds);
        self.traced(arm, &identify, bands, &logs, progress)
    }

    /// Candidates of whose inputs every log has all: what a log does not hold cannot be judged.
    fn judgeable(&self, logs: &[Log]) -> Vec<&'a dyn Candidate> {
        let is_held = |candidate: &&dyn Candidate| {
            let mut logs = logs.iter();
            logs.all(|log| missing_input(candidate.inputs(), log).is_none())
        };
        self.candidates.iter().copied().filter(is_held).collect()
    }

    /// The trace of logs of which it is known how slowly joints turn round.
    fn traced(
        &self,
        arm: &dyn Arm,
        identify: &Identify,
        bands: Bands,
        logs: &[Log],
        progress: &mut dyn FnMut(&Stage<'_>),
    ) -> Result<Verdict, IdentifyError> {
        let mut prepared = prepare_all(logs, &bands)?;
        progress(&Stage::whole("fitting the declared model"));
        let (solution, shapes, mut stack) = identify.solve(arm, &mut prepared, None)?;
        stack.silence(&solution.unexcited);
        let of_log = |log: &Prepared| period(&log.motion.wide.q, log.rate_hz);
        let periods: Vec<Option<f64>> = prepared.iter().map(of_log).collect();
        let estimate = &solution.estimate[..];
        let noise = |motions: &[Prepared], along: &Bands| {
            let (of_logs, along) = ((logs, &prepared[..], &bands), (motions, along));
            torque_of_noise(arm, of_logs, along, (&shapes, estimate))
        };
        let position_noise = noise(&prepared, &bands)?;
        let along = calm::bands(&bands);
        let calm = calm::logs(logs, &prepared, &bands)?;
        let calm_noise = noise(&calm, &along)?;
        let mut search = Search {
            arm,
            position_noise,
            calm,
            calm_noise,
            declared_above: Vec::new(),
            identify,
            shapes,
            shared_hz: bands.shared_hz,
            unexcited: solution.unexcited.clone(),
            prepared,
            folds: folds::cut(&stack.segments, &periods),
            tests: OnceLock::new(),
            periods,
        };
        let residuals = stack.residuals(&solution.estimate);
        let state = State {
            stack,
            solution,
            residuals,
            accepted: Vec::new(),
            looks: Looks::default(),
        };
        search.update_rigid_torque(&state);
        let raw = search.raw_residuals(&state).residuals;
        search.declared_above = above(&raw, &search.beyond_all(&raw), &state.residuals);
        let before = search.structure(&state).to_vec();

        progress(&Stage::whole("forming candidate columns"));
        let candidates = self.judgeable(logs);
        let grown = search.grow(state, &candidates, self.most(), progress)?;
        self.concluded(&mut search, grown, before)
    }

    /// How many effects may still be added: those that an earlier trace named count.
    fn most(&self) -> usize {
        let named = self.since.as_ref().map_or(0, |earlier| earlier.named);
        MOST_EFFECTS.saturating_sub(named)
    }

    /// The verdict on a model that was grown.
    fn concluded(
        &self,
        search: &mut Search<'_>,
        grown: Grown<'a>,
        before: Vec<Structure>,
    ) -> Result<Verdict, IdentifyError> {
        let Grown {
            mut state,
            grids,
            tried,
            end,
        } = grown;
        let of_terms = match end {
            End::Change(found) => {
                // What else is missing is asked of the arm with it, and of that what is told of all.
                let mut told = search.told(&state);
                told.std.push(Vec::new());
                state.accepted.push(*found);
                return Ok(changed(&state, before, &told, tried));
            }
            End::Terms(joints) => joints,
            End::NothingPasses => Vec::new(),
        };
        state = search.prune(state)?;
        state = search.with_small(state, &grids, self.most())?;
        let after = search.structure(&state).to_vec();
        let earlier = self.since.as_ref();
        let before = earlier.map_or(before, |earlier| earlier.before.clone());
        let values = search.told(&state);
        let is_named = earlier.is_some() || state.accepted.iter().any(|effect| !effect.is_small);
        // Of a quiet arm a model without a finding may leave more than noise all the same.
        let is_beyond = |joint: &usize| {
            let floor = &values.floor[*joint];
            !is_named && (floor.exceeded().is_some() || floor.pulsed().is_some())
        };
        let is_told = |joint: &usize| {
            after[*joint].is_material() || of_terms.contains(joint) || is_beyond(joint)
        };
        let left = if of_terms.is_empty() {
            let is_asked = |joint: &usize| !is_named || state.leaves_most(*joint);
            search.unknown_functions(&state, &is_told, &is_asked)
        } else {
            search.whereabouts(&state, (0..after.len()).filter(is_told).collect(), &is_told)
        };
        let any_beyond = (0..after.len()).any(|joint| is_beyond(&joint))
            || left.iter().any(|one| !is_told(&one.joint));
        let mut verdict = verdict(&state, before, after, &values, tried, any_beyond);
        let series = search.with_a_series(&state);
        if !of_terms.is_empty() || !series.is_empty() {
            verdict = verdict.unexplained();
        }
        Ok(Verdict {
            left,
            series,
            ..verdict
        })
    }
}

/// A model with what was accepted.
struct Grown<'a> {
    state: State<'a>,
    grids: Vec<Grid<'a>>,
    tried: Vec<Tried>,
    end: End<'a>,
}

/// A law that passed and told how its joints turn, with what was tried beside it: the round is asked again along these turns.
struct AskedAgain<'a> {
    found: Accepted<'a>,
    tried: Vec<Tried>,
}

/// Why a model grew no further.
enum End<'a> {
    NothingPasses,
    /// A term of the equations of these joints is what is amiss, not an effect.
    Terms(Vec<usize>),
    /// What passes changes the arm, which the model is not of any more.
    Change(Box<Accepted<'a>>),
}

impl Search<'_> {
    /// Accepts the best effect that passes, then the next, until none does or there are so many.
    fn grow<'a>(
        &mut self,
        mut state: State<'a>,
        candidates: &[&'a dyn Candidate],
        most: usize,
        progress: &mut dyn FnMut(&Stage<'_>),
    ) -> Result<Grown<'a>, IdentifyError> {
        let mut grids = self.grids(&state, candidates, |_| true);
        let mut tried = Vec::new();
        let mut end = End::NothingPasses;
        let mut settled = BTreeSet::new();
        let mut asked_again: Option<AskedAgain> = None;
        while state.accepted.len() < most {
            // Effects of an earlier trace were found in rounds, too.
            let round = MOST_EFFECTS - most + state.accepted.len() + 1;
            let words = format!("round {round}: {} candidates", candidates.len());
            let judged = &mut |done| progress(&Stage::part(&words, done));
            let said = tried.len();
            let Some(found) = self.round(&state, &grids, &mut tried, judged) else {
                let Some(first) = asked_again.take() else {
                    break;
                };
                // Nothing passes along turns that are told: the law that told them stands.
                tried.truncate(said);
                tried.extend(first.tried);
                state.accepted.push(first.found);
                state = self.refit(state, true)?;
                continue;
            };
            asked_again = None;
            let kind = found.trial.candidate.kind();
            progress(&Stage::whole(&format!("round {round}: {kind} passes")));
            let of_terms = self.where_a_term_is(&state, &found);
            if !of_terms.is_empty() {
                end = End::Terms(of_terms);
                break;
            }
            if found.changed.is_some() {
                end = End::Change(Box::new(found));
                break;
            }
            let joints = found.trial.candidate.joints().to_vec();
            state.accepted.push(found);
            state = self.refit(state, false)?;
            // How a joint turns round is told once the model has its friction.
            let turned = self.settle_turns(&state, &joints)?;
            let told_first = turned.iter().filter(|&&joint| settled.insert(joint));
            if told_first.count() > 0 {
                // Which law of friction it is has to be asked along turns that are told.
                let found = state.accepted.pop();
                let tried = tried.split_off(said);
                asked_again = found.map(|found| AskedAgain { found, tried });
                progress(&Stage::whole(&format!(
                    "round {round} again: {kind} tells how its joint reverses, so that all candidates are tried with that"
                )));
            }
            if !turned.is_empty() {
                state = self.refit(state, true)?;
            }
            let fresh = self.grids(&state, candidates, |candidate| {
                let turns = || candidate.joints().iter().any(|j| turned.contains(j));
                candidate.uses_rigid_torque() || turns()
            });
            for (grid, fresh) in grids.iter_mut().zip(fresh) {
                if fresh.len() > 0 {
                    *grid = fresh;
                }
            }
        }
        Ok(Grown {
            state,
            grids,
            tried,
            end,
        })
    }
}

//! Forward search: the best effect that passes, then the next, until none does.

use std::sync::OnceLock;

use crate::columns::{Arm, Candidate};
use crate::identify::drowned::{TorqueOfNoise, torque_of_noise};
use crate::identify::{
    Identify, IdentifyError, Method, Solution, Stack, check_logs, load_motion, missing_input,
    prepare_all, slowest_bands,
};
use crate::log::{Log, MOTION_PHASE};
use crate::signal::{Bands, Prepared, period};
use crate::threads;

use super::away::Looks;
use super::conclude::{Told, changed, verdict};
use super::folds::{self, Fold};
use super::grid::Grid;
use super::rows::Rows;
use super::stage::Stage;
use super::structure::Structure;
use super::trial::Trial;
use super::verdict::{Alternative, Evidence, Verdict};

/// No more effects than this are looked for: a model that misses more is another model.
pub const MOST_EFFECTS: usize = 6;

/// A trace: candidates against the residual of an arm's declared model.
pub struct Trace<'a> {
    candidates: Vec<&'a dyn Candidate>,
    since: Option<Vec<Structure>>,
}

/// An effect that was accepted.
pub(super) struct Accepted<'a> {
    pub(super) trial: Trial<'a>,
    pub(super) evidence: Evidence,
    pub(super) rivals: Vec<Alternative>,
    /// Own shapes of an effect that changes the arm; it ends the trace.
    pub(super) changed: Option<OwnShapes>,
    /// Whether it is too small to be named.
    pub(super) is_small: bool,
}

/// Shapes of an effect that changes the arm.
pub(super) struct OwnShapes {
    pub(super) values: Vec<f64>,
    pub(super) std: Vec<Option<f64>>,
}

/// Everything that changes when an effect is accepted.
pub(super) struct State<'a> {
    pub(super) stack: Stack,
    pub(super) solution: Solution,
    pub(super) residuals: Vec<Vec<f64>>,
    pub(super) accepted: Vec<Accepted<'a>>,
    pub(super) looks: Looks,
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

    /// Goes on from a trace of the same logs that ended with a change of the arm: that had this structure before its first effect.
    ///
    /// # Examples
    /// ```
    /// # mod pendulum { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/doc/pendulum.rs")); }
    /// # use pendulum::{dry_friction, measure, pendulum};
    /// use robot_model::trace::Trace;
    /// let (arm, candidate) = (pendulum(), dry_friction());
    /// // The log that a first trace had before it found anything, and the one that is left to trace.
    /// let run = |trace: Trace<'_>, fc| trace.run(&arm, &[measure(fc)], &mut |_| ());
    /// let before = run(Trace::new(vec![&candidate]), 0.7)?.before;
    /// let later = run(Trace::new(vec![&candidate]).since(before.clone()), 0.0)?;
    /// assert_eq!(later.before, before);
    /// # Ok::<(), robot_model::identify::IdentifyError>(())
    /// ```
    #[must_use]
    pub fn since(mut self, before: Vec<Structure>) -> Self {
        self.since = Some(before);
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
        progress(&Stage::whole("finding how slowly joints turn round"));
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
        let position_noise = torque_of_noise(arm, (logs, &prepared, &bands), (&shapes, estimate))?;
        let mut search = Search {
            arm,
            position_noise,
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
        let mut state = State {
            stack,
            solution,
            residuals,
            accepted: Vec::new(),
            looks: Looks::default(),
        };
        search.update_rigid_torque(&state);
        let before = search.structure(&state).to_vec();

        progress(&Stage::whole("forming candidate columns"));
        let candidates = self.judgeable(logs);
        let mut grids = search.grids(&state, &candidates, |_| true);
        let mut tried = Vec::new();
        let mut of_terms = Vec::new();
        while state.accepted.len() < MOST_EFFECTS {
            let round = state.accepted.len() + 1;
            let words = format!("round {round}: {} candidates", candidates.len());
            let judged = &mut |done| progress(&Stage::part(&words, done));
            let Some(found) = search.round(&state, &grids, &mut tried, judged) else {
                break;
            };
            let kind = found.trial.candidate.kind();
            progress(&Stage::whole(&format!("round {round}: {kind} passes")));
            of_terms = search.where_a_term_is(&state, &found);
            if !of_terms.is_empty() {
                break;
            }
            if found.changed.is_some() {
                // What else is missing is asked of the arm with it, and of that what is told of all.
                let mut told = search.told(&state);
                told.std.push(Vec::new());
                state.accepted.push(found);
                return Ok(changed(&state, before, &told, tried));
            }
            let joints = found.trial.candidate.joints().to_vec();
            state.accepted.push(found);
            state = search.refit(state, false)?;
            // How a joint turns round is told once the model has its friction.
            let turned = search.settle_turns(&state, &joints)?;
            if turned {
                state = search.refit(state, true)?;
            }
            let fresh = search.grids(&state, &candidates, |candidate| {
                let turns = || candidate.joints().iter().any(|j| joints.contains(j));
                candidate.uses_rigid_torque() || (turned && turns())
            });
            for (grid, fresh) in grids.iter_mut().zip(fresh) {
                if fresh.len() > 0 {
                    *grid = fresh;
                }
            }
        }
        state = search.prune(state)?;
        state = search.with_small(state, &grids)?;
        let after = search.structure(&state).to_vec();
        let before = self.since.clone().unwrap_or(before);
        let values = search.told(&state);
        let is_named = self.since.is_some() || state.accepted.iter().any(|effect| !effect.is_small);
        // Of a quiet arm a model without a finding may leave more than noise all the same.
        let is_beyond = |joint: &usize| !is_named && values.floor[*joint].exceeded().is_some();
        let is_told = |joint: &usize| {
            after[*joint].is_material() || of_terms.contains(joint) || is_beyond(joint)
        };
        let left = if is_named || !of_terms.is_empty() {
            search.whereabouts(&state, (0..after.len()).filter(is_told).collect())
        } else {
            search.unknown_functions(&state, &is_told)
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

/// Whether a candidate is a law of the part of the motion's period.
pub(super) fn is_of_phase(candidate: &dyn Candidate) -> bool {
    candidate.inputs().iter().any(|name| name == MOTION_PHASE)
}

/// What stays the same through a search, but for the rigid-body torque in the motions.
pub(super) struct Search<'s> {
    pub(super) arm: &'s dyn Arm,
    pub(super) identify: &'s Identify,
    pub(super) shapes: Vec<f64>,
    /// Cutoff of the shared filter, Hz.
    pub(super) shared_hz: f64,
    /// Unknowns that the logs do not excite: held at zero throughout.
    unexcited: Vec<usize>,
    pub(super) prepared: Vec<Prepared>,
    /// What noise of the positions makes of each joint's torque by the declared model.
    pub(super) position_noise: Vec<TorqueOfNoise>,
    pub(super) periods: Vec<Option<f64>>,
    pub(super) folds: Vec<Fold>,
    /// Independent tests that all candidates are worth, found in the first round.
    pub(super) tests: OnceLock<f64>,
}

impl Search<'_> {
    /// Finds the speeds at which joints creep where they turn, and takes what was made of others anew. Whether there was anything to do.
    fn settle_turns(&mut self, state: &State, joints: &[usize]) -> Result<bool, IdentifyError> {
        let found = self
            .identify
            .creeping(&state.stack, &self.prepared, joints)?;
        for &(joint, speed) in &found {
            for log in &mut self.prepared {
                log.motion.turn_speeds[joint] = speed;
            }
        }
        Ok(!found.is_empty())
    }

    /// What is told of a model beside what it is made of.
    fn told(&self, state: &State) -> Told {
        Told {
            std: self.deviations(state),
            floor: self.floor(state),
            turn_speeds: (0..self.arm.dof())
                .map(|joint| {
                    let logs = self.prepared.iter();
                    logs.map(|log| log.motion.turn_speed(joint))
                        .fold(0.0, f64::max)
                })
                .collect(),
        }
    }

    /// Trials of the candidates that are wanted, formed on all cores; an empty list for the others.
    fn grids<'a>(
        &self,
        state: &State,
        candidates: &[&'a dyn Candidate],
        wanted: impl Fn(&dyn Candidate) -> bool,
    ) -> Vec<Grid<'a>> {
        let wanted: Vec<bool> = candidates.iter().map(|&one| wanted(one)).collect();
        let all: Vec<(&'a dyn Candidate, bool)> = candidates.iter().copied().zip(wanted).collect();
        threads::map(&all, |&(candidate, is_wanted)| {
            if is_wanted {
                self.grid(state, candidate)
            } else {
                Grid::Formed(Vec::new())
            }
        })
    }

    /// Trials of one candidate. A change that cannot be solved for at its neutral shapes is no candidate.
    fn grid<'a>(&self, state: &State, candidate: &'a dyn Candidate) -> Grid<'a> {
        let Some(change) = candidate.change() else {
            return Grid::new(candidate, Rows::new(&self.prepared, &state.stack));
        };
        let logs = self.prepared.clone();
        let first = self.first_order(state, change, logs).into_iter();
        let trials = first.map(|entries| Trial::first_order(candidate, entries));
        Grid::Formed(trials.collect())
    }

    /// Effects that depend on the load see the torque of the rigid body at the present estimate.
    fn update_rigid_torque(&mut self, state: &State) {
        let own = self.arm.unknowns().len();
        for log in &mut self.prepared {
            let estimate = &state.solution.estimate[..own];
            load_motion(self.arm, &mut log.motion, &self.shapes, estimate);
        }
    }

    /// Fits the declared model with all accepted effects; `anew` where the motion that columns read is another one.
    pub(super) fn refit<'a>(
        &mut self,
        state: State<'a>,
        anew: bool,
    ) -> Result<State<'a>, IdentifyError> {
        let State {
            mut stack,
            mut accepted,
            ..
        } = state;
        if anew || self.arm.uses_rigid_torque() {
            stack = self.identify.rows(self.arm, &self.prepared, &self.shapes);
            stack.silence(&self.unexcited);
        } else {
            stack.truncate(self.arm.unknowns().len());
        }
        for effect in &mut accepted {
            if anew || effect.trial.candidate.uses_rigid_torque() {
                let rows = Rows::new(&self.prepared, &stack);
                effect.trial.entries = rows.columns(effect.trial.candidate, &effect.trial.shapes);
            }
            stack.append(effect.trial.candidate.unknowns(), &effect.trial.entries);
        }
        let solution = self.identify.solve_stack(&stack)?;
        let residuals = stack.residuals(&solution.estimate);
        let state = State {
            stack,
            solution,
            residuals,
            accepted,
            looks: Looks::default(),
        };
        self.update_rigid_torque(&state);
        Ok(state)
    }
}

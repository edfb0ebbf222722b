//! What a search for missing effects is of, and what changes when one is accepted.

use std::sync::OnceLock;

use crate::columns::{Arm, Candidate};
use crate::identify::drowned::TorqueOfNoise;
use crate::identify::{Identify, IdentifyError, Solution, Stack, load_motion};
use crate::log::MOTION_PHASE;
use crate::signal::Prepared;
use crate::threads;

use super::away::Looks;
use super::conclude::Told;
use super::folds::Fold;
use super::grid::Grid;
use super::rows::Rows;
use super::trial::Trial;
use super::verdict::{Alternative, Evidence};

/// No more effects than this are looked for: a model that misses more is another model.
pub const MOST_EFFECTS: usize = 6;

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
    pub(super) unexcited: Vec<usize>,
    pub(super) prepared: Vec<Prepared>,
    /// The logs with a calm motion; none where their own is calm enough.
    pub(super) calm: Vec<Prepared>,
    /// What noise of the positions makes of each joint's torque by the declared model: of the motion of rows, and of the calm one.
    pub(super) position_noise: Vec<TorqueOfNoise>,
    pub(super) calm_noise: Vec<TorqueOfNoise>,
    /// Mean square of each joint's raw residual beyond that of its rows, by the declared model.
    pub(super) declared_above: Vec<f64>,
    pub(super) periods: Vec<Option<f64>>,
    pub(super) folds: Vec<Fold>,
    /// Independent tests that all candidates are worth, found in the first round.
    pub(super) tests: OnceLock<f64>,
}

impl Search<'_> {
    /// Finds the speeds at which joints creep where they turn; the joints that have other ones now.
    pub(super) fn settle_turns(
        &mut self,
        state: &State,
        joints: &[usize],
    ) -> Result<Vec<usize>, IdentifyError> {
        let found = self
            .identify
            .creeping(&state.stack, &self.prepared, joints)?;
        for &(joint, speed) in &found {
            for log in self.prepared.iter_mut().chain(&mut self.calm) {
                log.motion.turn_speeds[joint] = speed;
            }
        }
        Ok(found.into_iter().map(|(joint, _)| joint).collect())
    }

    /// What is told of a model beside what it is made of.
    pub(super) fn told(&self, state: &State) -> Told {
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
    pub(super) fn grids<'a>(
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
    pub(super) fn update_rigid_torque(&mut self, state: &State) {
        let own = self.arm.unknowns().len();
        for log in self.prepared.iter_mut().chain(&mut self.calm) {
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

//! What becomes of a model's effects once no other passes.

use crate::identify::IdentifyError;

use super::gate::MATERIAL_PERCENT;
use super::grid::Grid;
use super::search::{Search, State};
use super::structure::Structure;
use super::trial::Trial;

impl Search<'_> {
    /// Whether a model without an effect is worse by as much as matters on one of its joints.
    fn is_needed(&self, state: &State, trial: &Trial) -> bool {
        let folds = self.own_folds(trial, state);
        let folds = folds.as_deref().unwrap_or(self.folds_of(state));
        let baseline = self.baseline(state, 1.0, folds);
        trial.project(&baseline.present).is_some_and(|projected| {
            let judged = baseline.judge(trial.clone(), &projected);
            let touched = trial.touched();
            let mut joints = touched.iter();
            joints.any(|j| judged.evidence.raw_percent[*j] >= MATERIAL_PERCENT)
                || self.is_large_elsewhere(state, &judged, &projected)
        })
    }

    /// Takes off what is too small to be named: it may be structure, and is none that is unknown; `most` effects are in the model then.
    pub(super) fn with_small<'a>(
        &mut self,
        mut state: State<'a>,
        grids: &[Grid<'a>],
        most: usize,
    ) -> Result<State<'a>, IdentifyError> {
        let is_left = |search: &Self, state: &State| {
            let structure = search.structure(state).iter().any(Structure::is_material);
            structure && state.accepted.len() < most
        };
        while is_left(self, &state) {
            let Some(small) = self.small(&state, grids) else {
                break;
            };
            state.accepted.push(small);
            state = self.refit(state, false)?;
        }
        Ok(state)
    }

    /// Drops effects that later ones made needless.
    pub(super) fn prune<'a>(&mut self, mut state: State<'a>) -> Result<State<'a>, IdentifyError> {
        let mut number = 0;
        while state.accepted.len() > 1 && number + 1 < state.accepted.len() {
            let effect = state.accepted.remove(number);
            state = self.refit(state, false)?;
            if self.is_needed(&state, &effect.trial) {
                state.accepted.insert(number, effect);
                number += 1;
                state = self.refit(state, false)?;
            }
        }
        Ok(state)
    }
}

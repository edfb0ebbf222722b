//! The present model away from the turns of joints with dry friction.
//!
//! A joint that its friction holds says nothing of the model: the torque there is any between the two that the law has. Such rows come
//! back in every period as structure does, and move the fit of all others. So what is told of structure has to be there without them.

use std::sync::OnceLock;

use crate::columns::Entry;
use crate::identify::{Solution, Stack, leave_out_turns};

use super::folds::Fold;
use super::gate::{Judged, MATERIAL_PERCENT};
use super::gram::{Gram, HeldOut};
use super::search::{Search, State};
use super::step::Stepped;
use super::structure::Structure;

/// Of a joint's rows: where turns reach all but this share, rows away from them are no judges.
pub(super) const LEAST_LEFT: f64 = 0.25;

/// What is worked out of a state when it is asked for.
#[derive(Default)]
pub(super) struct Looks {
    structure: OnceLock<Vec<Structure>>,
    pub(super) without_steps: OnceLock<Vec<Structure>>,
    pub(super) steps: OnceLock<Vec<Vec<Option<Stepped>>>>,
    away: OnceLock<Option<Away>>,
    /// Folds of its own, see [`Search::folds_of`].
    pub(super) folds: OnceLock<Option<Vec<Fold>>>,
}

/// A model fitted to the rows away from turns.
pub(super) struct Away {
    pub(super) stack: Stack,
    pub(super) solution: Solution,
    /// `[joint][row]`; 0 at turns.
    pub(super) residuals: Vec<Vec<f64>>,
}

impl Away {
    /// Mean square of what is left of a joint over the rows away from its turns; none where there are too few of them.
    pub(super) fn mean_square(&self, joint: usize) -> Option<f64> {
        let rows = self.stack.samples();
        let left = rows - self.stack.turns[joint].len();
        let squares = self.residuals[joint].iter().map(|r| r * r).sum::<f64>();
        (left as f64 >= LEAST_LEFT * rows as f64).then(|| squares / left as f64)
    }

    /// Columns without their rows at turns.
    pub(super) fn clear(&self, entries: &mut [Entry]) {
        for entry in entries {
            for &row in &self.stack.turns[entry.joint] {
                entry.values[row] = 0.0;
            }
        }
    }
}

impl Search<'_> {
    /// Whether a change lowers errors that were not fitted away from turns of dry joints, too, by as much as matters: what holds a joint there
    /// no law of the model says, and an arm that is a little later or elsewhere can look like that.
    pub(super) fn holds_away_from_turns(&self, state: &State, judged: &Judged) -> bool {
        let (Some(away), Some(changed)) = (self.away(state), &judged.changed) else {
            return true;
        };
        let held_out = |stack: &Stack| {
            let mut stack = stack.clone();
            stack.turns.clone_from(&away.stack.turns);
            leave_out_turns(&mut stack);
            Gram::new(&stack, self.folds_of(state)).held_out(&state.solution.sigma)
        };
        let [before, after] = [&away.stack, &changed.stack].map(held_out);
        let judges = (0..self.arm.dof()).filter(|joint| away.mean_square(*joint).is_some());
        let mean = |errors: &HeldOut, joint: usize| errors.mean(joint).max(f64::MIN_POSITIVE);
        let falls = judges.map(|joint| 0.5 * (mean(&before, joint) / mean(&after, joint)).ln());
        let falls: Vec<f64> = falls.collect();
        let matters = -(-MATERIAL_PERCENT / 100.0).ln_1p();
        falls.is_empty()
            || (falls.iter().sum::<f64>() > 0.0 && falls.iter().any(|fall| *fall >= matters))
    }

    /// The present model fitted away from turns; none where there are none, or where other rows do not tell the model.
    pub(super) fn away<'a>(&self, state: &'a State) -> Option<&'a Away> {
        let fit = || {
            if state.stack.turns.iter().all(Vec::is_empty) {
                return None;
            }
            let mut stack = state.stack.clone();
            leave_out_turns(&mut stack);
            let solution = self.identify.solve_stack(&stack).ok()?;
            let residuals = stack.residuals(&solution.estimate);
            let is_told = solution.unexcited == state.solution.unexcited;
            is_told.then_some(Away {
                stack,
                solution,
                residuals,
            })
        };
        state.looks.away.get_or_init(fit).as_ref()
    }

    /// Structure per joint.
    pub(super) fn structure<'a>(&self, state: &'a State) -> &'a [Structure] {
        let found = || {
            let mut found = self.structure_of_all_rows(state);
            let is_asked = found.iter().any(Structure::is_material);
            if let Some(away) = is_asked.then(|| self.away(state)).flatten() {
                for (joint, structure) in found.iter_mut().enumerate() {
                    if let Some(most) = away.mean_square(joint) {
                        structure.limit(most);
                    }
                }
            }
            found
        };
        state.looks.structure.get_or_init(found)
    }
}

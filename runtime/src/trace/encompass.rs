//! Of two effects that lower the error alike, does one say all that the other says, and more?
//!
//! With effect `b` among the model's columns `a` is scored on what is left, and the other way round. Where `a` explains more beside `b`, and `b`
//! nothing beside `a`, `a` encompasses `b` (Mizon & Richard 1986): `b` is what `a` looks like in these logs. A simpler law that is the
//! right one is encompassed by none, nor is one by a law whose parameters have the wrong signs, or that leaves a larger error on some joint by
//! more than noise.

use super::chance::SIGNIFICANCE;
use super::gate::{self, Judged};
use super::gram::Gram;
use super::score::Present;
use super::search::{Search, State};

/// From which chance on it counts as nothing; as more it counts up to that up to which an effect is named, of all rivals together. A slow
/// wander of the zero bends any law a little.
const NOTHING: f64 = 1e-2;

/// Held-out errors within this of each other are alike, percent: the error of a joint that neither effect touches is not the same in two
/// fits.
const ALIKE_PERCENT: f64 = 0.2;

impl Search<'_> {
    /// Whether `one`, which is one of some rivals, encompasses `other`.
    pub(super) fn encompasses(
        &self,
        state: &State,
        one: &Judged,
        other: &Judged,
        rivals: usize,
    ) -> bool {
        one.keeps_signs
            && gate::worse_percent(&one.raw_power, &other.raw_power) < ALIKE_PERCENT
            && rivals as f64 * self.beside(state, one, other) < SIGNIFICANCE
            && self.beside(state, other, one) > NOTHING
    }

    /// Probability of the score of `one` in noise, with `other` in the model; 1 where it says nothing new.
    fn beside(&self, state: &State, one: &Judged, other: &Judged) -> f64 {
        let stack = if let Some(changed) = &other.changed {
            changed.stack.clone()
        } else {
            let mut stack = state.stack.clone();
            stack.append(other.trial.candidate.unknowns(), &other.trial.entries);
            stack
        };
        let Ok(solution) = self.identify.solve_stack(&stack) else {
            return 1.0;
        };
        let residuals = stack.residuals(&solution.estimate);
        let gram = Gram::new(&stack, &[]);
        let present = Present::new(&stack, &gram, &solution.sigma, &residuals);
        let trial = &one.trial;
        let projected = trial.project(&present);
        projected.map_or(1.0, |projected| {
            let score = present.score(trial.candidate, &trial.entries, &projected);
            score.p_value
        })
    }
}

//! How sure the values of accepted effects are, shapes among them.

use crate::columns::{Candidate, Unknown};

use super::gate::Judged;
use super::rows::Rows;
use super::search::{Accepted, Search, State};
use super::verdict::Evidence;
use super::wander;

/// Deviations that a parameter is told by.
pub(super) const TOLD: f64 = 2.0;

/// The same of a change of the arm, which moves all of the equations, and their noise with them.
const TOLD_OF_CHANGE: f64 = 3.0;

/// A law that takes so much off a joint's error, held out, that a sixteenth of its power is left is there whatever its parameters trade, as are
/// those of a spring with a lever; so much it takes off the raw error, which has more noise. What fits as any curve does leaves more: of a motor
/// at its limit a spring left a fifth of the power.
const MOST_PERCENT: (f64, f64) = (75.0, 20.0);

/// A law of one column is told where it takes so much off a joint's errors, held out and raw.
const MUCH_PERCENT: (f64, f64) = (20.0, 7.5);

impl Search<'_> {
    /// Standard deviations of the parameters of every accepted effect, linear ones first, then shapes: each beside all other unknowns, the
    /// torque linearized in the shapes, and with what zeros that walk make of it; shapes as far as their profiles reach. None of what another
    /// unknown or a sum of others can stand for, and of changes of the arm.
    pub(super) fn deviations(&self, state: &State) -> Vec<Vec<Option<f64>>> {
        let mut stack = state.stack.clone();
        let rows = Rows::new(&self.prepared, &state.stack);
        let mut places = Vec::new();
        for (effect, place) in state.placed() {
            let gain = &state.solution.estimate[place.clone()];
            let trial = &effect.trial;
            let slopes = rows.slopes(trial.candidate, &trial.shapes, gain);
            let unknowns = unknowns(trial.candidate);
            let shapes = stack.unknowns.len();
            places.push((place, shapes..shapes + unknowns.len()));
            stack.append(&unknowns, &slopes);
        }
        let mut std = self.identify.apart_beside_slopes(&stack, &state.solution);
        let own = places.iter().cloned();
        let own = own.flat_map(|(linear, shapes)| linear.chain(shapes));
        wander::widen(
            &mut std,
            own,
            &stack,
            &state.solution.sigma,
            &state.residuals,
        );
        let mut places = places.into_iter();
        let of_effect = |effect: &Accepted| {
            if effect.changed.is_some() {
                return Vec::new();
            }
            let (linear, shapes) = places.next().expect("one an effect");
            self.widen_by_profiles(state, effect, &linear, &mut std[shapes.clone()]);
            linear.chain(shapes).map(|k| std[k]).collect()
        };
        state.accepted.iter().map(of_effect).collect()
    }
}

impl Search<'_> {
    /// Whether the logs tell any of a law's parameters, or at least that it is not zero, with its shapes open. Where shapes and parameters can
    /// be traded for each other all along, the law fits as anything with so many parameters does, unless it is most of what is missing.
    pub(super) fn is_told(&self, state: &State, judged: &Judged) -> bool {
        let trial = &judged.trial;
        let is_simple = trial.count() == 1 && trial.shapes.len() < 2;
        if judged.changed.is_none() && takes_most(&judged.evidence, is_simple) {
            return true;
        }
        let is_beyond = |times: f64| {
            move |(value, std): (&f64, &Option<f64>)| {
                std.is_some_and(|std| value.abs() > times * std)
            }
        };
        if let Some(changed) = &judged.changed {
            let mut shapes = changed.shapes.iter().zip(&changed.std_of_noise);
            return shapes.any(is_beyond(TOLD_OF_CHANGE));
        }
        let mut stack = state.stack.clone();
        let first = stack.unknowns.len();
        stack.append(trial.candidate.unknowns(), &trial.entries);
        let Ok(solution) = self.identify.solve_stack(&stack) else {
            return true;
        };
        let gain = &solution.estimate[first..];
        let rows = Rows::new(&self.prepared, &state.stack);
        let slopes = rows.slopes(trial.candidate, &trial.shapes, gain);
        stack.append(&unknowns(trial.candidate), &slopes);
        let std = self.identify.beside_slopes(&stack, &solution);
        gain.iter().zip(&std[first..]).any(is_beyond(TOLD))
    }
}

/// Whether a law takes so much off the errors of one of the joints that it is there, whatever its parameters trade.
///
/// One column that takes much off fits next to nothing that is another law's, whatever it trades with its one shape: of `fv exp(-beta T)` beside
/// viscous friction a small `beta` and a large `fv` say the same, and how friction falls with the temperature is told.
pub(super) fn takes_most(evidence: &Evidence, is_simple: bool) -> bool {
    let pairs = || evidence.held_out_percent.iter().zip(&evidence.raw_percent);
    let beyond = |(least_held_out, least_raw): (f64, f64)| {
        pairs().any(|(held_out, raw)| *held_out > least_held_out && *raw > least_raw)
    };
    beyond(MOST_PERCENT) || is_simple && beyond(MUCH_PERCENT)
}

fn unknowns(candidate: &dyn Candidate) -> Vec<Unknown> {
    let shapes = candidate.shapes().iter();
    let unknowns = shapes.map(|shape| Unknown {
        name: shape.name.clone(),
        nonnegative: false,
    });
    unknowns.collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_leaves_next_to_nothing_is_there() {
        let on = |held_out: [f64; 2], raw: [f64; 2]| Evidence::certain(&held_out, &raw);
        // A spring of 3 % of a torque, and one in the place of a motor's limit.
        let (spring, limit) = (on([0.2, 80.0], [0.1, 36.0]), on([0.0, 54.0], [0.0, 50.0]));
        assert!(takes_most(&spring, false) && !takes_most(&limit, false));
        assert!(takes_most(&limit, true));
        // Both of one joint.
        assert!(!takes_most(&on([80.0, 0.0], [0.0, 36.0]), true));
    }
}

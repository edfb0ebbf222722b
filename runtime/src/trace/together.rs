//! Laws that are together what none of them is.

use super::curve::fitted;
use super::search::{Accepted, Search, State};
use super::whereabouts::Quantity;

/// A curve of a joint's position leaves less than this share of the power of a law that is one.
const LEFT: f64 = 0.01;

/// A law has at least this share of its power about its mean, or it is a constant.
const LEAST_CHANGE: f64 = 1e-6;

impl Search<'_> {
    /// Joints on which two findings are smooth curves of the joint's position, each of them nothing else: two springs, or one and a wave of few
    /// periods, are terms of a series, and fit whatever curve the joint has.
    pub(super) fn with_a_series(&self, state: &State) -> Vec<usize> {
        let own = state.stack.unknowns.len()
            - (state.accepted.iter())
                .filter(|effect| effect.changed.is_none())
                .map(|effect| effect.trial.count())
                .sum::<usize>();
        let mut first = own;
        let mut curves = vec![0; self.arm.dof()];
        for effect in &state.accepted {
            if effect.changed.is_some() {
                continue;
            }
            let gain = &state.solution.estimate[first..first + effect.trial.count()];
            first += effect.trial.count();
            if let [joint] = effect.trial.touched()[..]
                && !effect.is_small
                && self.is_of_position(effect, gain, joint)
            {
                curves[joint] += 1;
            }
        }
        let joints = curves.iter().enumerate();
        let several = joints.filter(|(_, count)| **count > 1);
        several.map(|(joint, _)| joint).collect()
    }

    /// Whether the torque of an effect is a smooth curve of a joint's position, and no constant.
    fn is_of_position(&self, effect: &Accepted, gain: &[f64], joint: usize) -> bool {
        let Some(curve) = self.curve(Quantity::Position(joint)) else {
            return false;
        };
        let mut torque = vec![0.0; curve.columns[0].len()];
        for entry in effect.trial.entries.iter().filter(|e| e.joint == joint) {
            for (sum, value) in torque.iter_mut().zip(&entry.values) {
                *sum += gain[entry.column] * value;
            }
        }
        let mean = torque.iter().sum::<f64>() / torque.len().max(1) as f64;
        let power = |values: &[f64]| values.iter().map(|value| value * value).sum::<f64>();
        let all = power(&torque);
        for value in &mut torque {
            *value -= mean;
        }
        let change = power(&torque);
        let rows: Vec<usize> = (0..torque.len()).collect();
        let [follows, ..] = fitted(&curve, &torque, &rows);
        for (knot, column) in follows.iter().zip(&curve.columns) {
            for (rest, value) in torque.iter_mut().zip(column) {
                *rest -= knot * value;
            }
        }
        change > LEAST_CHANGE * all && power(&torque) < LEFT * change
    }
}

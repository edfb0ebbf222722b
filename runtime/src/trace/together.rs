//! Laws that are together what none of them is.

use super::curve::{Curve, fitted};
use super::quantity::Quantity;
use super::raw::mean_square;
use super::search::{Accepted, Search, State};
use crate::columns::Entry;

/// Values between which a curve is straight that a term of a series follows: a wave of more than three periods over the travel of a joint does not,
/// and is told by them.
const KNOTS: usize = 12;

/// A curve leaves less than this share of the power of a law that it follows.
const LEFT: f64 = 0.01;

/// A law has at least this share of its power about its mean, or it is a constant.
const LEAST_CHANGE: f64 = 1e-6;

/// So many smooth curves of a joint's position are a series, or so many laws of it, smooth or not: a wave for every bump.
const CURVES: usize = 2;
const LAWS: usize = 3;

impl Search<'_> {
    /// Joints on which some findings are laws of the joint's position, each of them nothing else: two springs, a spring and a wave of few periods, or
    /// three waves are terms of a series, and fit whatever curve the joint has.
    pub(super) fn with_a_series(&self, state: &State) -> Vec<usize> {
        let (mut curves, mut laws) = (vec![0; self.arm.dof()], vec![0; self.arm.dof()]);
        for (effect, place) in state.placed() {
            let gain = &state.solution.estimate[place];
            if let [joint] = effect.trial.touched()[..]
                && !effect.is_small
            {
                let is_curve = self.is_of_position(state, (effect, gain), joint);
                curves[joint] += usize::from(is_curve);
                laws[joint] += usize::from(is_curve || effect.trial.candidate.is_of_position());
            }
        }
        let is_series = |joint: &usize| curves[*joint] >= CURVES || laws[*joint] >= LAWS;
        (0..curves.len()).filter(is_series).collect()
    }

    /// Whether the torque of an effect is a smooth curve of a joint's position, and no constant. Along a motion of one wave the size of the
    /// velocity is one, too, but it is as much one of the velocity.
    fn is_of_position(&self, state: &State, of: (&Accepted, &[f64]), joint: usize) -> bool {
        let curves = [Quantity::Position(joint), Quantity::Velocity(joint)];
        let [position, velocity] = curves.map(|quantity| self.smooth(quantity, KNOTS));
        let Some(position) = position else {
            return false;
        };
        let (torque, rows) = torque(state, of, joint);
        let power = |values: &[f64]| {
            let values: Vec<f64> = rows.iter().map(|&row| values[row]).collect();
            mean_square(&values)
        };
        let mean = rows.iter().map(|&row| torque[row]).sum::<f64>() / rows.len().max(1) as f64;
        let about: Vec<f64> = torque.iter().map(|value| value - mean).collect();
        let change = power(&about);
        let follows = |curve: &Curve| {
            let [knots, ..] = fitted(curve, &about, &rows);
            let mut rest = about.clone();
            for (knot, column) in knots.iter().zip(&curve.columns) {
                for (rest, value) in rest.iter_mut().zip(column) {
                    *rest -= knot * value;
                }
            }
            power(&rest) < LEFT * change
        };
        change > LEAST_CHANGE * power(&torque)
            && follows(&position)
            && !velocity.is_some_and(|curve| follows(&curve))
    }
}

/// The filtered torque of an effect on a joint, and the rows that the fit does not leave out.
fn torque(
    state: &State,
    (effect, gain): (&Accepted, &[f64]),
    joint: usize,
) -> (Vec<f64>, Vec<usize>) {
    let samples = state.stack.samples();
    let mut torque = vec![0.0; samples];
    for entry in effect.trial.entries.iter().filter(|e| e.joint == joint) {
        for (sum, value) in torque.iter_mut().zip(&entry.values) {
            *sum += gain[entry.column] * value;
        }
    }
    let mut ones = [Entry {
        joint,
        column: 0,
        values: vec![1.0; samples],
    }];
    state.stack.clear_left_out(&mut ones);
    let rows = 0..samples;
    (
        torque,
        rows.filter(|&row| ones[0].values[row] != 0.0).collect(),
    )
}

//! How sure the values of accepted effects are, shapes among them.

use crate::columns::{Candidate, Entry, Unknown};
use crate::identify::filtered_columns;

use super::search::{Accepted, Search, State};

/// Step of a shape's slope, of its value or of a thousandth of its range.
const STEP: f64 = 1e-4;
const SHARE_OF_RANGE: f64 = 1e-3;

impl Search<'_> {
    /// Standard deviations of the parameters of every accepted effect, linear ones first, then shapes: each beside all other unknowns, the
    /// torque linearized in the shapes. None of what another unknown can stand for, and of changes of the arm.
    pub(super) fn deviations(&self, state: &State) -> Vec<Vec<Option<f64>>> {
        let effects = || {
            let effects = state.accepted.iter();
            effects.filter(|effect| effect.changed.is_none())
        };
        let linear = state.stack.unknowns.len();
        let mut first = linear - effects().map(|effect| effect.trial.count()).sum::<usize>();
        let mut stack = state.stack.clone();
        let mut places = Vec::new();
        for effect in effects() {
            let count = effect.trial.count();
            let gain = &state.solution.estimate[first..first + count];
            let (unknowns, slopes) = self.slopes(effect, gain);
            let shapes = stack.unknowns.len();
            places.push((first..first + count, shapes..shapes + unknowns.len()));
            stack.append(&unknowns, &slopes);
            first += count;
        }
        let std = self.identify.beside_slopes(&stack, &state.solution);
        let mut places = places.into_iter();
        let of_effect = |effect: &Accepted| {
            if effect.changed.is_some() {
                return Vec::new();
            }
            let (linear, shapes) = places.next().expect("one an effect");
            linear.chain(shapes).map(|k| std[k]).collect()
        };
        state.accepted.iter().map(of_effect).collect()
    }

    /// Columns of what an effect's torque changes by with each of its shapes.
    fn slopes(&self, effect: &Accepted, gain: &[f64]) -> (Vec<Unknown>, Vec<Entry>) {
        let trial = &effect.trial;
        let candidate = trial.candidate;
        let torque = |shapes: &[f64]| {
            let columns = filtered_columns(candidate, &self.prepared, shapes);
            let mut joints = vec![Vec::new(); self.arm.dof()];
            for Entry {
                joint,
                column,
                values,
            } in columns
            {
                let torque: &mut Vec<f64> = &mut joints[joint];
                torque.resize(values.len(), 0.0);
                let terms = torque.iter_mut().zip(values);
                terms.for_each(|(sum, value)| *sum += gain[column] * value);
            }
            joints
        };
        let slope = |(number, value): (usize, &f64)| {
            let grid = &candidate.shapes()[number].grid;
            let (low, high) = (grid[0], grid[grid.len() - 1]);
            let step = STEP * value.abs().max(SHARE_OF_RANGE * (high - low));
            let ends = [value - step, value + step].map(|end| end.clamp(low, high));
            let [below, above] = ends.map(|end| {
                let mut shapes = trial.shapes.clone();
                shapes[number] = end;
                torque(&shapes)
            });
            let joints = below.into_iter().zip(above).enumerate();
            let joints = joints.filter(|(_, (below, _))| !below.is_empty());
            let entries = joints.map(move |(joint, (below, above))| Entry {
                joint,
                column: number,
                values: below
                    .iter()
                    .zip(&above)
                    .map(|(below, above)| (above - below) / (ends[1] - ends[0]))
                    .collect(),
            });
            entries.collect::<Vec<Entry>>()
        };
        let slopes = trial.shapes.iter().enumerate().flat_map(slope).collect();
        (unknowns(candidate), slopes)
    }
}

fn unknowns(candidate: &dyn Candidate) -> Vec<Unknown> {
    let shapes = candidate.shapes().iter();
    let unknowns = shapes.map(|shape| Unknown {
        name: shape.name.clone(),
        nonnegative: false,
    });
    unknowns.collect()
}

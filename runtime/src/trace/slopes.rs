//! What an effect's torque changes by with its shapes.

use crate::columns::{Candidate, Entry};
use crate::identify::filtered_columns;
use crate::signal::Prepared;

/// Step of a shape's slope, of its value or of a thousandth of its range.
const STEP: f64 = 1e-4;
const SHARE_OF_RANGE: f64 = 1e-3;

/// Filtered columns, one a shape, of what the torque of a candidate with these parameters changes by with it.
pub(super) fn slopes(
    candidate: &dyn Candidate,
    shapes: &[f64],
    gain: &[f64],
    logs: &[Prepared],
) -> Vec<Entry> {
    let of_shape = |number: usize| {
        let value = shapes[number];
        let grid = &candidate.shapes()[number].grid;
        let (low, high) = (grid[0], grid[grid.len() - 1]);
        let step = STEP * value.abs().max(SHARE_OF_RANGE * (high - low));
        let ends = [value - step, value + step].map(|end| end.clamp(low, high));
        let [below, above] = ends.map(|end| {
            let mut shapes = shapes.to_vec();
            shapes[number] = end;
            torque(candidate, &shapes, gain, logs)
        });
        let joints = below.into_iter().zip(above);
        joints.map(move |((joint, below), (_, above))| Entry {
            joint,
            column: number,
            values: below
                .iter()
                .zip(&above)
                .map(|(below, above)| (above - below) / (ends[1] - ends[0]))
                .collect(),
        })
    };
    (0..shapes.len()).flat_map(of_shape).collect()
}

/// Joints on which a candidate acts, and its filtered torque there.
fn torque(
    candidate: &dyn Candidate,
    shapes: &[f64],
    gain: &[f64],
    logs: &[Prepared],
) -> Vec<(usize, Vec<f64>)> {
    let mut joints: Vec<(usize, Vec<f64>)> = Vec::new();
    for entry in filtered_columns(candidate, logs, shapes) {
        let place = joints.iter().position(|(joint, _)| *joint == entry.joint);
        let place = place.unwrap_or_else(|| {
            joints.push((entry.joint, vec![0.0; entry.values.len()]));
            joints.len() - 1
        });
        let terms = joints[place].1.iter_mut().zip(&entry.values);
        terms.for_each(|(sum, value)| *sum += gain[entry.column] * value);
    }
    joints
}

//! What an effect's torque changes by with its shapes.

use crate::columns::{Candidate, Entry};
use crate::identify::{filtered_columns, slope};
use crate::signal::Prepared;

/// Filtered columns, one a shape, of what the torque of a candidate with these parameters changes by with it.
pub(super) fn slopes(
    candidate: &dyn Candidate,
    shapes: &[f64],
    gain: &[f64],
    logs: &[Prepared],
) -> Vec<Entry> {
    let at = |number: usize, value: f64| {
        let mut shapes = shapes.to_vec();
        shapes[number] = value;
        torque(candidate, &shapes, gain, logs)
    };
    let of_shape = |number: usize| {
        let value = shapes[number];
        let joints: Vec<usize> = at(number, value).into_iter().map(|(j, _)| j).collect();
        let torques = |value: f64| -> Vec<Vec<f64>> {
            let torques = at(number, value).into_iter();
            torques.map(|(_, torque)| torque).collect()
        };
        let slopes = slope::across_jumps(value, &candidate.shapes()[number].grid, &torques);
        let joints = joints.into_iter().zip(slopes);
        joints.map(move |(joint, values)| Entry {
            joint,
            column: number,
            values,
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

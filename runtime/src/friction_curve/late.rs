//! Torques that come after the positions of a run.
//!
//! In: the rows of a curve and its first solution. Out: by how much torques come late, and the solution beside it, where that is seen.
//!
//! A torque `d` seconds late is `tau(t - d) = tau(t) - d tau'(t)`. At a constant speed what the rigid body changes with position
//! changes with time, so `-tau'` is one more column.

use super::Value;
use super::rows::Rows;
use super::solution::{Chosen, Solution, norm, within};

/// Deviations from which on it is seen.
const SEEN: f64 = 5.0;

/// The longest that is believed, s: what explains more is another thing.
const LONGEST: f64 = 0.2;

/// The share of the column that constants and the other columns have to leave.
const LEFT: f64 = 1e-2;

/// Adds the column `-tau'`, and solves again; rows and chosen columns stay as they are where nothing is seen.
pub(super) fn beside(
    rows: &mut Rows,
    chosen: &mut Chosen,
    first: &Solution,
    cell: &[usize],
    count: usize,
) -> Option<(Value, Solution)> {
    let column = change(rows, chosen, first);
    let length = norm(&column);
    if length == 0.0 || !is_left(&column, rows, chosen, cell, count) {
        return None;
    }
    let place = rows.columns.len();
    rows.columns.push(column);
    chosen.places.push(place);
    chosen.lengths.push(length);
    let solution = Solution::new(rows, cell, count, chosen);
    let late = Value {
        value: *solution.beta.last()?,
        std: *solution.beta_std.last()?,
    };
    let is_seen = late.value.abs() > SEEN * late.std && late.value.abs() < LONGEST;
    if !is_seen {
        rows.columns.pop();
        chosen.places.pop();
        chosen.lengths.pop();
        return None;
    }
    Some((late, solution))
}

/// `-tau'` of the rigid body at each block, by differences of its neighbors in a stretch.
fn change(rows: &Rows, chosen: &Chosen, first: &Solution) -> Vec<f64> {
    let mut torque = rows.known.clone();
    for (&place, value) in chosen.places.iter().zip(&first.beta) {
        let pairs = torque.iter_mut().zip(&rows.columns[place]);
        pairs.for_each(|(torque, x)| *torque += value * x);
    }
    let blocks = torque.len();
    let slope = |k: usize| {
        let is_here = |other: &usize| rows.stretch[*other] == rows.stretch[k];
        let before = k.checked_sub(1).filter(is_here).unwrap_or(k);
        let behind = Some(k + 1)
            .filter(|k| *k < blocks)
            .filter(is_here)
            .unwrap_or(k);
        if before == behind {
            return 0.0;
        }
        (torque[behind] - torque[before]) / ((behind - before) as f64 * rows.seconds[k])
    };
    (0..blocks).map(|k| -slope(k)).collect()
}

/// Whether the column is none that constants and the chosen columns make: a short way bends no weight.
fn is_left(column: &[f64], rows: &Rows, chosen: &Chosen, cell: &[usize], count: usize) -> bool {
    let length = norm(column);
    let as_torque = Rows {
        torque: column.to_vec(),
        columns: rows.columns.clone(),
        ..Rows::default()
    };
    let solution = Solution::new(&as_torque, cell, count, chosen);
    let mut rest = within(column, cell, count);
    for (&place, value) in chosen.places.iter().zip(&solution.beta) {
        let inside = within(&rows.columns[place], cell, count);
        rest.iter_mut()
            .zip(inside)
            .for_each(|(rest, x)| *rest -= value * x);
    }
    norm(&rest) > LEFT * length
}

#[cfg(test)]
mod tests;

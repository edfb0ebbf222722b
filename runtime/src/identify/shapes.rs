//! Shape parameters without a value: a search over their ranges, the linear unknowns solved for at every point.

mod simplex;
mod together;
mod valleys;

use std::ops::Range;

use crate::columns::{Arm, Entry, Unknown};
use crate::signal::Prepared;

use super::IdentifyError;
use super::slope::Torques;
use super::stack::Stack;
use simplex::simplex;
use valleys::{lowest, starts};

/// Rounds over all effects, one at a time.
const SWEEPS: usize = 2;

/// Steps of the golden section inside the best grid interval: narrows it a hundred times.
const GOLDEN_STEPS: usize = 10;

/// The middle of every shape's grid.
pub(super) fn middle(arm: &dyn Arm) -> Vec<f64> {
    arm.shapes()
        .iter()
        .map(|shape| shape.grid[shape.grid.len() / 2])
        .collect()
}

/// Looks through the whole range of each free shape parameter.
///
/// Those of one effect bend one curve together, so that their optimum lies in a valley that runs across their axes: all
/// combinations of their grids are tried, and a simplex goes on from the lowest of each valley.
///
/// # Errors
/// Those of `cost`.
pub(super) fn search(
    arm: &dyn Arm,
    logs: &[Prepared],
    cost: impl Fn(&[Prepared], &[f64]) -> Result<f64, IdentifyError>,
) -> Result<Vec<f64>, IdentifyError> {
    let mut shapes = middle(arm);
    let groups = groups(arm.shapes().iter().map(|shape| shape.name.as_str()));
    let sweeps = if groups.len() > 1 { SWEEPS } else { 1 };
    for sweep in 0..sweeps {
        for group in &groups {
            let grids: Vec<&[f64]> = arm.shapes()[group.clone()]
                .iter()
                .map(|shape| shape.grid.as_slice())
                .collect();
            let now = shapes[group.clone()].to_vec();
            let mut at = |values: &[f64]| {
                let mut trial = shapes.clone();
                trial[group.clone()].copy_from_slice(values);
                cost(logs, &trial)
            };
            let found = match grids.as_slice() {
                [grid] => vec![minimize(grid, &mut |value| at(&[value]))?],
                // What the other effects explain by now moves the optimum a little, not to another valley.
                _ if sweep > 0 => simplex(&grids, &now, &mut at)?,
                _ => {
                    let starts = starts(&grids, now, &mut at)?;
                    lowest(&grids, &starts, &mut at)?
                }
            };
            shapes[group.clone()].copy_from_slice(&found);
        }
    }
    Ok(shapes)
}

/// A stack with a column for each of some free shape parameters, by which the torque of an estimate changes with it: how far it is known
/// beside the linear unknowns. `rows` are those for given shapes, and `slope` is [`slope::smooth`](super::slope::smooth) or
/// [`slope::across_jumps`](super::slope::across_jumps).
pub(crate) fn with_slopes(
    arm: &dyn Arm,
    rows: &dyn Fn(&[f64]) -> Stack,
    shapes: &[f64],
    numbers: Range<usize>,
    mut stack: Stack,
    estimate: &[f64],
    slope: impl Fn(f64, &[f64], Torques) -> Vec<Vec<f64>>,
) -> Stack {
    let free = numbers.clone().zip(&arm.shapes()[numbers.clone()]);
    let slopes = free.flat_map(|(number, shape)| {
        // What is left falls by what the torque grows by.
        let torques = |value: f64| {
            let mut near = shapes.to_vec();
            near[number] = value;
            let mut left = rows(&near).residuals(estimate);
            left.iter_mut().flatten().for_each(|value| *value = -*value);
            left
        };
        let slopes = slope(shapes[number], &shape.grid, &torques);
        let column = number - numbers.start;
        let entries = slopes.into_iter().enumerate();
        let entries = entries.map(move |(joint, values)| Entry {
            joint,
            column,
            values,
        });
        entries.collect::<Vec<_>>()
    });
    let unknowns = arm.shapes()[numbers.clone()].iter().map(|shape| Unknown {
        name: shape.name.clone(),
        nonnegative: false,
    });
    stack.append(
        &unknowns.collect::<Vec<_>>(),
        &slopes.collect::<Vec<Entry>>(),
    );
    stack
}

/// Neighbors of one effect, by their names `JOINT.EFFECT.SHAPE`.
fn groups<'a>(names: impl Iterator<Item = &'a str>) -> Vec<Range<usize>> {
    let effect = |name: &'a str| name.rsplit_once('.').map_or(name, |(effect, _)| effect);
    let mut groups: Vec<(&str, Range<usize>)> = Vec::new();
    for (k, name) in names.enumerate() {
        match groups.last_mut() {
            Some((last, group)) if *last == effect(name) => group.end = k + 1,
            _ => groups.push((effect(name), k..k + 1)),
        }
    }
    groups.into_iter().map(|(_, group)| group).collect()
}

/// Looks near the present values only: the range between the grid's neighbors.
///
/// # Errors
/// Those of `cost`.
pub(super) fn refine(
    arm: &dyn Arm,
    logs: &[Prepared],
    mut shapes: Vec<f64>,
    cost: impl Fn(&[Prepared], &[f64]) -> Result<f64, IdentifyError>,
) -> Result<Vec<f64>, IdentifyError> {
    for number in 0..shapes.len() {
        let grid = &arm.shapes()[number].grid;
        let (low, high) = neighbors(grid, shapes[number]);
        let mut at = |value: f64| {
            let mut trial = shapes.clone();
            trial[number] = value;
            cost(logs, &trial)
        };
        let value = golden(low, high, &mut at)?;
        if at(value)? < at(shapes[number])? {
            shapes[number] = value;
        }
    }
    Ok(shapes)
}

/// The best grid point, then golden section between its neighbors.
///
/// # Errors
/// Those of `at`.
fn minimize<E>(grid: &[f64], at: &mut impl FnMut(f64) -> Result<f64, E>) -> Result<f64, E> {
    let mut best = (f64::INFINITY, 0);
    for (k, value) in grid.iter().enumerate() {
        let cost = at(*value)?;
        if cost < best.0 {
            best = (cost, k);
        }
    }
    let k = best.1;
    let (low, high) = neighbors(grid, grid[k]);
    let refined = golden(low, high, at)?;
    Ok(if at(refined)? < best.0 {
        refined
    } else {
        grid[k]
    })
}

/// The grid points around a value: the interval in which a search on the grid leaves it.
pub(crate) fn neighbors(grid: &[f64], value: f64) -> (f64, f64) {
    let last = grid.len() - 1;
    let below = grid
        .partition_point(|point| *point < value)
        .saturating_sub(1);
    let above = grid.partition_point(|point| *point <= value).min(last);
    (grid[below], grid[above])
}

/// A range whose ends are this far apart is one of its logarithm.
const DECADES: f64 = 100.0;

/// A shape of several decades goes no further in a step, in its logarithm.
const FACTOR: f64 = 1.0;

/// Whether a grid is one of the logarithm.
pub(crate) fn is_of_decades(grid: &[f64]) -> bool {
    let (low, high) = (grid[0], grid[grid.len() - 1]);
    low > 0.0 && high > DECADES * low
}

/// The value a step further, inside its range.
pub(crate) fn moved(grid: &[f64], value: f64, step: f64) -> f64 {
    let next = if is_of_decades(grid) {
        value * (step / value).clamp(-FACTOR, FACTOR).exp()
    } else {
        value + step
    };
    next.clamp(grid[0], grid[grid.len() - 1])
}

/// Golden section on an interval.
///
/// # Errors
/// Those of `at`.
pub(crate) fn golden<E>(
    mut low: f64,
    mut high: f64,
    at: &mut impl FnMut(f64) -> Result<f64, E>,
) -> Result<f64, E> {
    let ratio = 0.5 * (5.0_f64.sqrt() - 1.0);
    let mut inner = (high - ratio * (high - low), low + ratio * (high - low));
    let mut cost = (at(inner.0)?, at(inner.1)?);
    for _ in 0..GOLDEN_STEPS {
        if cost.0 < cost.1 {
            high = inner.1;
            inner = (high - ratio * (high - low), inner.0);
            cost = (at(inner.0)?, cost.0);
        } else {
            low = inner.0;
            inner = (inner.1, low + ratio * (high - low));
            cost = (cost.1, at(inner.1)?);
        }
    }
    Ok(0.5 * (low + high))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn minimum_between_grid_points() {
        let grid: Vec<f64> = (0..12).map(f64::from).collect();
        let found = minimize(&grid, &mut |x: f64| Ok::<_, ()>((x - 6.37).powi(2)))
            .expect("the cost has no errors");
        assert!((found - 6.37).abs() < 0.02, "{found}");
    }

    #[test]
    fn minimum_at_the_end_of_the_range_stays_inside() {
        let grid = [1.0, 2.0, 3.0];
        let found = minimize(&grid, &mut |x: f64| Ok::<_, ()>(-x)).expect("the cost has no errors");
        assert!((found - 3.0).abs() < 0.02 && found <= 3.0, "{found}");
    }

    #[test]
    fn shapes_of_one_effect_belong_together() {
        let names = ["j.lugre.d", "j.lugre.vs", "j.lugre2.d", "k.lugre.d", "own"];
        assert_eq!(groups(names.into_iter()), [0..2, 2..3, 3..4, 4..5]);
    }

    #[test]
    fn neighbors_of_points_and_of_values_between() {
        let grid = [1.0, 2.0, 4.0];
        assert_eq!(neighbors(&grid, 2.0), (1.0, 4.0));
        assert_eq!(neighbors(&grid, 3.0), (2.0, 4.0));
        assert_eq!(neighbors(&grid, 1.0), (1.0, 2.0));
        assert_eq!(neighbors(&grid, 4.0), (2.0, 4.0));
    }
}

//! Shape parameters of one effect over all of their ranges: which valleys there are, and which of them is the deepest.

use super::simplex::simplex;
use super::{SWEEPS, minimize};

/// Shape parameters of one effect are tried in all combinations of their grids where there are at most so many.
const MOST_COMBINATIONS: usize = 400;

/// Valleys of one effect that are followed to their ground: that of the lowest grid point may be another than the deepest.
const STARTS: usize = 3;

/// Combinations of grid points from which a search goes on, the best first: those from which every step along one axis leads up, [`STARTS`] at
/// most. Of too many combinations, the best along one axis after the other.
///
/// # Errors
/// Those of `at`.
pub(super) fn starts<E>(
    grids: &[&[f64]],
    mut now: Vec<f64>,
    at: &mut impl FnMut(&[f64]) -> Result<f64, E>,
) -> Result<Vec<Vec<f64>>, E> {
    let product = grids.iter().map(|grid| grid.len()).product::<usize>();
    if product > MOST_COMBINATIONS {
        for _ in 0..SWEEPS {
            for (k, grid) in grids.iter().enumerate() {
                now[k] = minimize(grid, &mut |value| {
                    let mut trial = now.clone();
                    trial[k] = value;
                    at(&trial)
                })?;
            }
        }
        return Ok(vec![now]);
    }
    let value = |place: &[usize]| -> Vec<f64> {
        let pairs = grids.iter().zip(place);
        pairs.map(|(grid, &k)| grid[k]).collect()
    };
    let mut heights = Vec::with_capacity(product);
    for number in 0..product {
        let mut rest = number;
        let place = grids.iter().map(|grid| {
            let k = rest % grid.len();
            rest /= grid.len();
            k
        });
        let place: Vec<usize> = place.collect();
        heights.push((at(&value(&place))?, place));
    }
    heights.sort_by(|x, y| x.0.total_cmp(&y.0));
    let is_next = |one: &[usize], other: &[usize]| {
        let steps = one.iter().zip(other).map(|(x, y)| x.abs_diff(*y));
        steps.sum::<usize>() == 1
    };
    let bottoms = heights.iter().enumerate().filter(|(k, (_, place))| {
        let lower = &heights[..*k];
        !lower.iter().any(|(_, other)| is_next(place, other))
    });
    let bottoms = bottoms.map(|(_, (_, place))| value(place));
    Ok(bottoms.take(STARTS).collect())
}

/// The lowest of what searches from several starts find.
///
/// # Errors
/// Those of `at`.
pub(super) fn lowest<E>(
    grids: &[&[f64]],
    starts: &[Vec<f64>],
    at: &mut impl FnMut(&[f64]) -> Result<f64, E>,
) -> Result<Vec<f64>, E> {
    let mut best = (f64::INFINITY, Vec::new());
    for start in starts {
        let mut found = simplex(grids, start, at)?;
        // A simplex that meets an end of a range falls flat there; another one stands up from it.
        let mut axes = grids.iter().zip(&found);
        if axes.any(|(grid, value)| *value <= grid[0] || *value >= grid[grid.len() - 1]) {
            found = simplex(grids, &found, at)?;
        }
        let cost = at(&found)?;
        if best.1.is_empty() || cost < best.0 {
            best = (cost, found);
        }
    }
    Ok(best.1)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn too_many_combinations_are_tried_along_the_axes() {
        let grid: Vec<f64> = (0..40).map(f64::from).collect();
        let mut calls = 0;
        let found = starts(&[&grid, &grid], vec![20.0, 20.0], &mut |x| {
            calls += 1;
            Ok::<_, ()>((x[0] - 6.0).abs() + (x[1] - 31.0).abs())
        });
        let found = &found.expect("the cost has no errors")[0];
        assert!((found[0] - 6.0).abs() < 0.02 && (found[1] - 31.0).abs() < 0.02);
        assert!(calls < 400, "{calls}");
    }

    /// Two valleys: the one with the lowest grid point is flat, the other is deep between grid points.
    #[test]
    fn the_deepest_valley_is_found_though_a_grid_point_of_another_is_lower() {
        let grid: Vec<f64> = (0..9).map(f64::from).collect();
        let grids: [&[f64]; 2] = [&grid, &grid];
        let well = |x: &[f64], at: [f64; 2], width: f64| {
            (-((x[0] - at[0]).powi(2) + (x[1] - at[1]).powi(2)) / width).exp()
        };
        let mut cost =
            |x: &[f64]| Ok::<_, ()>(-well(x, [2.0, 2.0], 8.0) - 3.0 * well(x, [6.5, 6.5], 0.3));
        let starts = starts(&grids, vec![4.0, 4.0], &mut cost).expect("no errors");
        assert_eq!(starts[0], [2.0, 2.0]);
        assert!(starts.len() > 1 && starts.len() <= STARTS);
        let found = lowest(&grids, &starts, &mut cost).expect("no errors");
        assert!((found[0] - 6.5).abs() < 0.02, "{found:?}");
        let alone = lowest(&grids, &starts[..1], &mut cost).expect("no errors");
        assert!((alone[0] - 2.0).abs() < 0.1, "{alone:?}");
    }

    /// The way down first leads to an end of a range, and away from it behind a bend.
    #[test]
    fn a_valley_that_leaves_an_end_of_a_range_is_followed() {
        let grids: [&[f64]; 3] = [&[1e-3, 1e-2, 1e-1], &[0.01, 0.1, 1.0], &[0.0, 1.0, 2.0]];
        let mut cost = |x: &[f64]| {
            let (d, v, r) = (x[0].ln() - 0.02_f64.ln(), x[1].ln(), x[2]);
            Ok::<_, ()>(50.0 * (v + 0.4 * r).powi(2) + d * d + (r - 1.7).powi(2))
        };
        let found = lowest(&grids, &[vec![1e-2, 1.0, 2.0]], &mut cost).expect("no errors");
        assert!(
            (found[2] - 1.7).abs() < 0.05 && (found[0] / 0.02 - 1.0).abs() < 0.05,
            "{found:?}"
        );
    }

    #[test]
    fn a_plain_is_one_start() {
        let grid = [1.0, 2.0, 3.0];
        let found = starts(&[&grid, &grid], vec![1.0, 1.0], &mut |_| Ok::<_, ()>(7.0));
        assert_eq!(found.expect("no errors").len(), 1);
    }
}

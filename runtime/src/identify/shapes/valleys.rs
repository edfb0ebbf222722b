//! Shape parameters of one effect over all of their ranges: which valleys there are, and which of them is the deepest.

use super::simplex::simplex;
use super::{SWEEPS, minimize};

/// Shape parameters of one effect are tried in all combinations of their grids where there are at most so many.
const MOST_COMBINATIONS: usize = 400;

/// Starts of one effect that are followed to their ground: that of the lowest grid point may be another than the deepest.
const STARTS: usize = 3;

/// Further starts, where a valley runs out at an end of a range: a narrow one between grid points has none of them for its ground.
const SPARE: usize = 6;

/// Further starts are so many steps along axes apart.
const APART: usize = 2;

/// Where searches begin, the best first.
pub(super) struct Starts {
    /// Grid points from which every step along one axis leads up, [`STARTS`] at most.
    bottoms: Vec<Vec<f64>>,
    /// Other grid points, [`SPARE`] at most.
    spare: Vec<Vec<f64>>,
}

/// Combinations of grid points from which a search goes on. Of too many combinations, the best along one axis after the other.
///
/// # Errors
/// Those of `at`.
pub(super) fn starts<E>(
    grids: &[&[f64]],
    mut now: Vec<f64>,
    at: &mut impl FnMut(&[f64]) -> Result<f64, E>,
) -> Result<Starts, E> {
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
        return Ok(Starts {
            bottoms: vec![now],
            spare: Vec::new(),
        });
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
    let steps = |one: &[usize], other: &[usize]| -> usize {
        let steps = one.iter().zip(other).map(|(x, y)| x.abs_diff(*y));
        steps.sum()
    };
    let places: Vec<Vec<usize>> = heights.into_iter().map(|(_, place)| place).collect();
    let is_bottom = |k: &usize| {
        let mut lower = places[..*k].iter();
        !lower.any(|other| steps(&places[*k], other) == 1)
    };
    let mut taken: Vec<usize> = (0..product).filter(is_bottom).take(STARTS).collect();
    let bottoms = taken.len();
    for k in 0..product {
        let is_apart = |other: &usize| steps(&places[k], &places[*other]) >= APART;
        if taken.len() < bottoms + SPARE && taken.iter().all(is_apart) {
            taken.push(k);
        }
    }
    let mut values = taken.into_iter().map(|k| value(&places[k]));
    Ok(Starts {
        bottoms: values.by_ref().take(bottoms).collect(),
        spare: values.collect(),
    })
}

/// The lowest of what searches from [`STARTS`] starts find; from all, where that is at an end of a range.
///
/// # Errors
/// Those of `at`.
pub(super) fn lowest<E>(
    grids: &[&[f64]],
    starts: &Starts,
    at: &mut impl FnMut(&[f64]) -> Result<f64, E>,
) -> Result<Vec<f64>, E> {
    let is_at_an_end = |found: &[f64]| {
        let mut axes = grids.iter().zip(found);
        axes.any(|(grid, value)| *value <= grid[0] || *value >= grid[grid.len() - 1])
    };
    let mut best = (f64::INFINITY, Vec::new());
    for (number, start) in starts.bottoms.iter().chain(&starts.spare).enumerate() {
        if number >= STARTS && !is_at_an_end(&best.1) {
            break;
        }
        let mut found = simplex(grids, start, at)?;
        // A simplex that meets an end of a range falls flat there; another one stands up from it.
        if is_at_an_end(&found) {
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

    fn one(start: Vec<f64>) -> Starts {
        Starts {
            bottoms: vec![start],
            spare: Vec::new(),
        }
    }

    /// A plain that falls to a corner, and a narrow valley deep in it: spare starts are for what ends in the corner.
    #[test]
    fn a_narrow_valley_is_found_where_the_wide_one_runs_out_at_an_end() {
        let grid: Vec<f64> = (0..5).map(f64::from).collect();
        let grids: [&[f64]; 2] = [&grid, &grid];
        let mut cost = |x: &[f64]| {
            let away = (x[0] - 1.5).hypot(x[1] - 2.6);
            Ok::<_, ()>(-0.1 * (x[0] + x[1]) - 3.0 * (-away * away / 0.18).exp())
        };
        let mut from = |spare: &[[f64; 2]]| {
            let starts = Starts {
                bottoms: vec![vec![4.0, 4.0]; STARTS],
                spare: spare.iter().map(|start| start.to_vec()).collect(),
            };
            lowest(&grids, &starts, &mut cost).expect("no errors")
        };
        assert_eq!(from(&[]), [4.0, 4.0]);
        let found = from(&[[2.0, 3.0]]);
        assert!(
            (found[0] - 1.5).abs() < 0.05 && (found[1] - 2.6).abs() < 0.05,
            "{found:?}"
        );
    }

    #[test]
    fn spare_starts_are_apart() {
        let grid: Vec<f64> = (0..5).map(f64::from).collect();
        let found = starts(&[&grid, &grid], vec![2.0, 2.0], &mut |x| {
            Ok::<_, ()>(-x[0] - x[1])
        });
        let found = found.expect("no errors");
        assert_eq!(found.bottoms, [[4.0, 4.0]]);
        assert_eq!(found.spare.len(), SPARE);
        let all: Vec<&Vec<f64>> = found.bottoms.iter().chain(&found.spare).collect();
        for (k, one) in all.iter().enumerate() {
            for other in &all[..k] {
                let steps = (one[0] - other[0]).abs() + (one[1] - other[1]).abs();
                assert!(steps >= APART as f64, "{one:?} {other:?}");
            }
        }
    }

    #[test]
    fn too_many_combinations_are_tried_along_the_axes() {
        let grid: Vec<f64> = (0..40).map(f64::from).collect();
        let mut calls = 0;
        let found = starts(&[&grid, &grid], vec![20.0, 20.0], &mut |x| {
            calls += 1;
            Ok::<_, ()>((x[0] - 6.0).abs() + (x[1] - 31.0).abs())
        });
        let found = &found.expect("the cost has no errors").bottoms[0];
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
        assert_eq!(starts.bottoms[0], [2.0, 2.0]);
        assert!(starts.bottoms.len() > 1 && starts.bottoms.len() <= STARTS);
        let found = lowest(&grids, &starts, &mut cost).expect("no errors");
        assert!((found[0] - 6.5).abs() < 0.02, "{found:?}");
        let first = one(starts.bottoms[0].clone());
        let alone = lowest(&grids, &first, &mut cost).expect("no errors");
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
        let found = lowest(&grids, &one(vec![1e-2, 1.0, 2.0]), &mut cost).expect("no errors");
        assert!(
            (found[2] - 1.7).abs() < 0.05 && (found[0] / 0.02 - 1.0).abs() < 0.05,
            "{found:?}"
        );
    }

    #[test]
    fn a_plain_is_one_start() {
        let grid = [1.0, 2.0, 3.0];
        let found = starts(&[&grid, &grid], vec![1.0, 1.0], &mut |_| Ok::<_, ()>(7.0));
        assert_eq!(found.expect("no errors").bottoms.len(), 1);
    }
}

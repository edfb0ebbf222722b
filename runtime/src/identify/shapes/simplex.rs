//! Nelder and Mead's simplex between the ends of grids (Lagarias, Reeds, Wright, Wright 1998, SIAM J. Optim. 9).

use super::neighbors;

/// The simplex begins with this share of the distance between grid points.
const START: f64 = 0.25;

/// It ends where it is smaller than this share of it: a hundredth of an interval, as the golden section does.
const END: f64 = 0.01;

/// Most trials per shape parameter.
const MOST_TRIALS: usize = 60;

/// The lowest point that a simplex finds from `start`; it does not leave the grids.
///
/// # Errors
/// Those of `cost`.
pub(super) fn simplex<E>(
    grids: &[&[f64]],
    start: &[f64],
    cost: &mut impl FnMut(&[f64]) -> Result<f64, E>,
) -> Result<Vec<f64>, E> {
    let count = grids.len();
    let axes: Vec<Axis> = grids
        .iter()
        .zip(start)
        .map(|(grid, value)| Axis::new(grid, *value))
        .collect();
    let place = |point: &[f64]| -> Vec<f64> {
        let values = axes.iter().zip(point);
        values.map(|(axis, share)| axis.value(*share)).collect()
    };
    let mut trials = 0;
    let mut at = |point: Vec<f64>| {
        trials += 1;
        let height = cost(&place(&point))?;
        Ok((height, point, trials))
    };
    let mut corners = Vec::with_capacity(count + 1);
    for corner in 0..=count {
        let mut point = vec![0.0; count];
        if corner > 0 {
            point[corner - 1] = START * axes[corner - 1].inward();
        }
        let (height, point, _) = at(point)?;
        corners.push((height, point));
    }
    loop {
        corners.sort_by(|x, y| x.0.total_cmp(&y.0));
        let (best, worst) = (corners[0].clone(), corners[count].clone());
        let away = |x: &[f64]| {
            let shares = x.iter().zip(&best.1);
            shares.map(|(x, b)| (x - b).abs()).fold(0.0, f64::max)
        };
        let size = corners.iter().map(|(_, x)| away(x)).fold(0.0, f64::max);
        let center: Vec<f64> = (0..count)
            .map(|k| corners[..count].iter().map(|(_, x)| x[k]).sum::<f64>() / count as f64)
            .collect();
        let along = |factor: f64| -> Vec<f64> {
            let pairs = center.iter().zip(&worst.1);
            pairs.map(|(c, w)| c + factor * (c - w)).collect()
        };
        let (reflected, point, trials) = at(along(1.0))?;
        if size < END || trials > MOST_TRIALS * count {
            return Ok(place(&best.1));
        }
        let mut next = (reflected, point);
        if reflected < best.0 {
            let (expanded, point, _) = at(along(2.0))?;
            if expanded < reflected {
                next = (expanded, point);
            }
        } else if reflected >= corners[count - 1].0 {
            let (factor, least) = if reflected < worst.0 {
                (0.5, reflected)
            } else {
                (-0.5, worst.0)
            };
            let (contracted, point, _) = at(along(factor))?;
            if contracted >= least {
                for corner in &mut corners[1..] {
                    let halves = corner.1.iter().zip(&best.1);
                    let half = halves.map(|(x, b)| 0.5 * (x + b)).collect();
                    let (height, point, _) = at(half)?;
                    *corner = (height, point);
                }
                continue;
            }
            next = (contracted, point);
        }
        corners[count] = next;
    }
}

/// A grid seen from a value: shares of the distance to its neighbors, in the logarithm where the grid is positive.
struct Axis {
    from: f64,
    unit: f64,
    ends: (f64, f64),
    logarithmic: bool,
}

impl Axis {
    fn new(grid: &[f64], value: f64) -> Self {
        let logarithmic = grid[0] > 0.0;
        let of = |value: f64| if logarithmic { value.ln() } else { value };
        let (low, high) = neighbors(grid, value);
        Self {
            from: of(value),
            unit: (of(high) - of(value)).max(of(value) - of(low)),
            ends: (grid[0], grid[grid.len() - 1]),
            logarithmic,
        }
    }

    /// The direction in which the grid goes on.
    fn inward(&self) -> f64 {
        if self.value(START) < self.ends.1 {
            1.0
        } else {
            -1.0
        }
    }

    fn value(&self, share: f64) -> f64 {
        let moved = self.from + share * self.unit;
        let value = if self.logarithmic { moved.exp() } else { moved };
        value.clamp(self.ends.0, self.ends.1)
    }
}

#[cfg(test)]
mod tests {
    use super::simplex;

    /// A narrow valley across both axes, as of shape parameters that make up for each other.
    #[test]
    fn a_valley_across_the_axes_is_followed() {
        let grids: [&[f64]; 2] = [&[0.1, 1.0, 10.0], &[0.0, 1.0, 2.0, 3.0]];
        let found = simplex(&grids, &[1.0, 1.0], &mut |x| {
            let (u, v) = (x[0].ln(), x[1]);
            Ok::<_, ()>(100.0 * (v - 1.0 - u).powi(2) + (u - 0.7).powi(2))
        })
        .expect("the cost has no errors");
        assert!((found[0].ln() - 0.7).abs() < 0.02, "{found:?}");
        assert!((found[1] - 1.7).abs() < 0.02, "{found:?}");
    }

    #[test]
    fn an_optimum_at_the_end_of_the_range_stays_inside() {
        let grids: [&[f64]; 2] = [&[0.1, 1.0, 10.0], &[-1.0, 0.0, 1.0]];
        let found = simplex(&grids, &[10.0, 0.0], &mut |x| {
            Ok::<_, ()>(-x[0] + x[1].powi(2))
        })
        .expect("the cost has no errors");
        assert!(
            found[0] <= 10.0 && (found[0] - 10.0).abs() < 0.1,
            "{found:?}"
        );
        assert!(found[1].abs() < 0.02, "{found:?}");
    }
}

//! Independent columns, one by one, and the others as combinations of them.

use crate::base::{DEPENDENT_BELOW, INDEPENDENT_ABOVE, RankStatus, UnclearColumn};

/// Coefficients of a combination below this are noise.
const COEFFICIENT_FLOOR: f64 = 1e-9;

/// Orthogonalization column by column, keeping what is needed to express the dropped columns.
#[derive(Default)]
pub struct Selection {
    /// Independent columns, in the order they were offered.
    pub kept: Vec<usize>,
    /// Orthonormal basis of the kept columns.
    basis: Vec<Vec<f64>>,
    /// Column `j` of the triangular factor: kept column `j` in the basis.
    triangle: Vec<Vec<f64>>,
    /// `(standard parameter, its column in the basis)`
    dropped: Vec<(usize, Vec<f64>)>,
    unclear: Vec<UnclearColumn>,
    smallest_kept: Option<f64>,
    largest_dropped: f64,
}

impl Selection {
    /// Offers a column of length one.
    pub fn take(&mut self, k: usize, mut column: Vec<f64>, name: &str) {
        let mut coordinates = vec![0.0; self.basis.len()];
        // Twice is enough for orthogonality to rounding.
        for _ in 0..2 {
            for (coordinate, direction) in coordinates.iter_mut().zip(&self.basis) {
                let projection = dot(direction, &column);
                *coordinate += projection;
                column
                    .iter_mut()
                    .zip(direction)
                    .for_each(|(x, d)| *x -= projection * d);
            }
        }
        let residual = norm(&column);
        if !residual.is_finite() {
            // An effect that is no number at some state, such as the root of a negative signal.
            self.unclear.push(UnclearColumn {
                name: name.to_owned(),
                residual,
            });
            return;
        }
        if residual <= DEPENDENT_BELOW {
            self.largest_dropped = self.largest_dropped.max(residual);
            self.dropped.push((k, coordinates));
            return;
        }
        if residual < INDEPENDENT_ABOVE {
            self.unclear.push(UnclearColumn {
                name: name.to_owned(),
                residual,
            });
        }
        self.smallest_kept = Some(
            self.smallest_kept
                .map_or(residual, |smallest| smallest.min(residual)),
        );
        for x in &mut column {
            *x /= residual;
        }
        coordinates.push(residual);
        self.kept.push(k);
        self.basis.push(column);
        self.triangle.push(coordinates);
    }

    /// How clear the decisions were.
    pub fn status(&self) -> RankStatus {
        if self.unclear.is_empty() {
            RankStatus::Clear {
                smallest_kept: self.smallest_kept.unwrap_or(1.0),
                largest_dropped: self.largest_dropped,
            }
        } else {
            RankStatus::Unclear(self.unclear.clone())
        }
    }

    /// Per kept column what regroups into it, in the units of the unscaled columns.
    pub fn combinations(&self, scale: &[f64]) -> Vec<Vec<(usize, f64)>> {
        let mut combinations: Vec<Vec<(usize, f64)>> =
            self.kept.iter().map(|&k| vec![(k, 1.0)]).collect();
        for (k, coordinates) in &self.dropped {
            let mut rest = coordinates.clone();
            for j in (0..rest.len()).rev() {
                let weight = rest[j] / self.triangle[j][j];
                for (i, entry) in self.triangle[j][..j].iter().enumerate() {
                    rest[i] -= weight * entry;
                }
                let coefficient = snap(weight * scale[*k] / scale[self.kept[j]]);
                if coefficient != 0.0 {
                    combinations[j].push((*k, coefficient));
                }
            }
        }
        // In the order of the kept parameters; inside a combination the kept one leads.
        let mut order: Vec<usize> = (0..self.kept.len()).collect();
        order.sort_unstable_by_key(|&j| self.kept[j]);
        order
            .into_iter()
            .map(|j| {
                let mut combination = std::mem::take(&mut combinations[j]);
                combination[1..].sort_unstable_by_key(|&(k, _)| k);
                combination
            })
            .collect()
    }
}

/// The named rounding step: a coefficient of a combination is 0 below [`COEFFICIENT_FLOOR`], else the shortest decimal
/// within 1e-12, else twelve decimals. Geometry is written with fewer digits than that.
pub fn snap(coefficient: f64) -> f64 {
    const TOLERANCE: f64 = 1e-12;
    if coefficient.abs() < COEFFICIENT_FLOOR {
        return 0.0;
    }
    let rounded = |digits: i32| {
        let unit = 10f64.powi(digits);
        (coefficient * unit).round() / unit
    };
    (0..=9)
        .map(rounded)
        .find(|value| (value - coefficient).abs() <= TOLERANCE)
        .unwrap_or_else(|| rounded(12))
}

fn dot(x: &[f64], y: &[f64]) -> f64 {
    x.iter().zip(y).map(|(x, y)| x * y).sum()
}

/// Euclidean length.
pub fn norm(x: &[f64]) -> f64 {
    dot(x, x).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    #[expect(clippy::float_cmp, reason = "snapping gives exact decimals")]
    fn snapping_gives_the_shortest_decimal() {
        assert_eq!(snap(0.186_451_240_000_003), 0.186_451_24);
        assert_eq!(snap(-1.000_000_000_000_4), -1.0);
        assert_eq!(snap(3e-10), 0.0);
        assert_eq!(snap(0.123_456_789_123_456), 0.123_456_789_123);
    }
}

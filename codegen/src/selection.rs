//! Independent columns, one by one, and the others as combinations of them.

use crate::rounded::UNIT;

/// A scaled column is independent of those before it when this much of it is left after projecting them out.
pub const INDEPENDENT_ABOVE: f64 = 1e-7;
/// A scaled column is a combination of those before it when no more than this is left.
pub const DEPENDENT_BELOW: f64 = 1e-10;

/// What a column turned out to be.
#[derive(Debug, Clone, PartialEq)]
pub enum Offer {
    /// Independent of those before, with what is left of it; the basis has grown by it.
    Kept(f64),
    /// A combination of those before; nothing has changed.
    Dependent(Dependence),
}

/// A column as a combination of kept ones.
#[derive(Debug, Clone, PartialEq)]
pub struct Dependence {
    /// What the combination leaves of the column.
    pub residual: f64,
    /// Per kept column its weight, with a bound of the weight's error.
    pub weights: Vec<(f64, f64)>,
}

/// Orthogonalization column by column, keeping what is needed to express the dependent columns.
#[derive(Default)]
pub struct Selection {
    /// Orthonormal basis of the kept columns.
    basis: Vec<Vec<f64>>,
    /// Column `j` of the triangular factor: kept column `j` in the basis.
    triangle: Vec<Vec<f64>>,
}

impl Selection {
    /// Offers a column of length one.
    pub fn offer(&mut self, column: &[f64]) -> Offer {
        let mut left = column.to_vec();
        let mut coordinates = vec![0.0; self.basis.len()];
        // Twice is enough for orthogonality to rounding.
        for _ in 0..2 {
            for (coordinate, direction) in coordinates.iter_mut().zip(&self.basis) {
                let projection = dot(direction, &left);
                *coordinate += projection;
                left.iter_mut()
                    .zip(direction)
                    .for_each(|(x, d)| *x -= projection * d);
            }
        }
        let residual = norm(&left);
        if residual <= DEPENDENT_BELOW {
            let weights = self.weights(coordinates);
            return Offer::Dependent(Dependence { residual, weights });
        }
        for x in &mut left {
            *x /= residual;
        }
        coordinates.push(residual);
        self.basis.push(left);
        self.triangle.push(coordinates);
        Offer::Kept(residual)
    }

    /// Solves the triangle, with the errors that rounding makes on the way.
    fn weights(&self, mut rest: Vec<f64>) -> Vec<(f64, f64)> {
        // A projection is a sum over as many products as the column has rows.
        let rows = self.basis.first().map_or(0, Vec::len) as f64;
        let mut errors = vec![4.0 * UNIT * rows.sqrt(); rest.len()];
        let mut weights = vec![(0.0, 0.0); rest.len()];
        for j in (0..rest.len()).rev() {
            let pivot = self.triangle[j][j];
            let weight = rest[j] / pivot;
            let error = errors[j] / pivot + UNIT * weight.abs();
            weights[j] = (weight, error);
            for (i, entry) in self.triangle[j][..j].iter().enumerate() {
                rest[i] -= weight * entry;
                errors[i] += error * entry.abs() + UNIT * (weight * entry).abs();
            }
        }
        weights
    }
}

/// The named rounding step of coefficients: the number with the fewest digits that is not farther away than `tolerance`,
/// which is the rounding of the coefficient itself, not a size that a number of any unit could have.
pub fn shortest(number: f64, tolerance: f64) -> f64 {
    /// More digits than this are all that a double has.
    const DIGITS: usize = 15;
    if number.abs() <= tolerance {
        return 0.0;
    }
    (0..DIGITS)
        .filter_map(|digits| format!("{number:.digits$e}").parse::<f64>().ok())
        .find(|short| (short - number).abs() <= tolerance)
        .unwrap_or(number)
}

pub fn dot(x: &[f64], y: &[f64]) -> f64 {
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
    #[expect(clippy::float_cmp, reason = "rounding gives exact decimals")]
    fn rounding_gives_the_fewest_digits_whatever_the_unit() {
        for (number, short) in [
            (0.186_451_240_000_003, 0.186_451_24),
            (-1.000_000_000_000_4, -1.0),
            (0.123_456_789_123_456, 0.123_456_789_123),
        ] {
            assert_eq!(shortest(number, 1e-12 * number.abs().max(0.5)), short);
        }
        // Squares of micrometers, and moments of area in m^4, are numbers like others.
        for number in [3e-10, 4e-12, 3.14e-12, 7.2e-25] {
            assert_eq!(shortest(number, 1e-12 * number), number);
            let noisy = number * (1.0 + 3e-13);
            assert_eq!(shortest(noisy, 1e-12 * number), number);
        }
        assert_eq!(shortest(3e-17, 1e-15), 0.0);
    }

    #[test]
    fn weights_are_those_of_the_combination() {
        let mut selection = Selection::default();
        let half = 0.5f64.sqrt();
        assert!(matches!(selection.offer(&[1.0, 0.0, 0.0]), Offer::Kept(_)));
        assert!(matches!(
            selection.offer(&[half, half, 0.0]),
            Offer::Kept(_)
        ));
        let Offer::Dependent(found) = selection.offer(&[0.6, 0.8, 0.0]) else {
            panic!("it lies in their plane");
        };
        for ((weight, error), wanted) in found.weights.into_iter().zip([-0.2, 0.8 / half]) {
            assert!(
                (weight - wanted).abs() <= error && error < 1e-14,
                "{weight} {error}"
            );
        }
    }
}

//! Arrays of emitted code as vectors and matrices, and back.

use super::{SMatrix, SVector, Vector};
use crate::scalar::Scalar;

/// A vector's numbers as an array.
///
/// # Examples
/// ```
/// use robot_model::{Vector, model::as_array};
/// assert_eq!(as_array(&Vector::from([1.0, 2.0])), &[1.0, 2.0]);
/// ```
#[must_use]
pub fn as_array<S: Scalar, const N: usize>(vector: &SVector<S, N>) -> &[S; N] {
    &vector.data.0[0]
}

/// An arm's numbers in the scalar of its motion.
///
/// # Examples
/// ```
/// use robot_model::{Vector, model::in_scalar};
/// assert_eq!(in_scalar::<f32, 2>(&Vector::from([1.0, 0.5])), [1.0_f32, 0.5]);
/// ```
#[must_use]
pub fn in_scalar<S: Scalar, const N: usize>(vector: &Vector<N>) -> [S; N] {
    as_array(vector).map(S::of)
}

/// A matrix from `[row][column]`.
///
/// # Examples
/// ```
/// use robot_model::model::from_rows;
/// assert_eq!(from_rows(&[[1.0, 2.0], [3.0, 4.0]])[(1, 0)], 3.0);
/// ```
#[must_use]
pub fn from_rows<S: Scalar, const R: usize, const C: usize>(
    rows: &[[S; C]; R],
) -> SMatrix<S, R, C> {
    SMatrix::from_fn(|row, column| rows[row][column])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rows_stay_rows() {
        let matrix = from_rows(&[[1.0_f64, 2.0, 3.0], [4.0, 5.0, 6.0]]);
        assert_eq!(
            (matrix[(0, 2)].to_bits(), matrix[(1, 0)].to_bits()),
            (3f64.to_bits(), 4f64.to_bits())
        );
        let bits = as_array(&Vector::<2>::new(7.0, 8.0)).map(f64::to_bits);
        assert_eq!(bits, [7.0f64, 8.0].map(f64::to_bits));
    }
}

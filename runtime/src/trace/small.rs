//! Sums over samples, and small symmetric systems.

use nalgebra::{DMatrix, DVector};

/// Sums that are kept side by side: one that waits for the last addition takes several times as long.
const LANES: usize = 8;

pub(super) fn dot(a: &[f64], b: &[f64]) -> f64 {
    debug_assert_eq!(a.len(), b.len());
    let (a, a_rest) = a.as_chunks::<LANES>();
    let (b, b_rest) = b.as_chunks::<LANES>();
    let mut sums = [0.0; LANES];
    for (a, b) in a.iter().zip(b) {
        for ((sum, x), y) in sums.iter_mut().zip(a).zip(b) {
            *sum += x * y;
        }
    }
    let rest = a_rest.iter().zip(b_rest).map(|(x, y)| x * y);
    sums.iter().sum::<f64>() + rest.sum::<f64>()
}

pub(super) fn add(target: &mut [f64], factor: f64, values: &[f64]) {
    if factor != 0.0 {
        for (t, v) in target.iter_mut().zip(values) {
            *t += factor * v;
        }
    }
}

/// Directions of a small symmetric positive matrix, scaled to a diagonal of ones, with less than this are without information.
const LEAST: f64 = 1e-9;

/// The diagonal's roots, and the matrix over them.
fn scaled(matrix: &[Vec<f64>]) -> (Vec<f64>, DMatrix<f64>) {
    let n = matrix.len();
    let scale: Vec<f64> = (0..n).map(|c| matrix[c][c].max(0.0).sqrt()).collect();
    let scaled = DMatrix::from_fn(n, n, |a, b| {
        if scale[a] > 0.0 && scale[b] > 0.0 {
            matrix[a][b] / (scale[a] * scale[b])
        } else {
            0.0
        }
    });
    (scale, scaled)
}

/// Combinations of columns whose products are a small symmetric positive matrix, in which they have more than `least` of what they have
/// together: the first that there is at least.
pub(super) fn directions(matrix: &[Vec<f64>], least: f64) -> Vec<Vec<f64>> {
    let (scale, scaled) = scaled(matrix);
    let eigen = scaled.symmetric_eigen();
    let mut order: Vec<usize> = (0..scale.len()).collect();
    order.sort_by(|&a, &b| eigen.eigenvalues[b].total_cmp(&eigen.eigenvalues[a]));
    let is_told = |&(place, k): &(usize, usize)| place == 0 || eigen.eigenvalues[k] > least;
    let told = order.into_iter().enumerate().filter(is_told);
    let over = |value: f64, scale: f64| if scale > 0.0 { value / scale } else { 0.0 };
    let combination = |(_, k): (usize, usize)| {
        let columns = scale.iter().enumerate();
        columns
            .map(|(c, scale)| over(eigen.eigenvectors[(c, k)], *scale))
            .collect()
    };
    told.map(combination).collect()
}

/// Solves a small symmetric positive system; directions without information get 0.
pub(super) fn solve_symmetric(matrix: &[Vec<f64>], right: &[f64]) -> Vec<f64> {
    let n = right.len();
    let (scale, scaled) = scaled(matrix);
    let eigen = scaled.symmetric_eigen();
    let or_none = |value: f64, over: f64| if over > 0.0 { value / over } else { 0.0 };
    let b = DVector::from_fn(n, |c, _| or_none(right[c], scale[c]));
    let mut along = eigen.eigenvectors.transpose() * b;
    for (value, eigenvalue) in along.iter_mut().zip(eigen.eigenvalues.iter()) {
        *value = if *eigenvalue > LEAST {
            *value / eigenvalue
        } else {
            0.0
        };
    }
    let solved = eigen.eigenvectors * along;
    (0..n).map(|c| or_none(solved[c], scale[c])).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_direction_without_information_is_left_alone() {
        let x = solve_symmetric(&[vec![4.0, 4.0], vec![4.0, 4.0]], &[2.0, 2.0]);
        assert!((4.0 * (x[0] + x[1]) - 2.0).abs() < 1e-9, "{x:?}");
    }

    #[test]
    fn columns_that_are_one_are_one_direction() {
        let count = |matrix: &[Vec<f64>]| directions(matrix, 1e-6).len();
        assert_eq!(count(&[vec![4.0, -2.0], vec![-2.0, 1.0]]), 1);
        assert_eq!(count(&[vec![4.0, -1.0], vec![-1.0, 1.0]]), 2);
        assert_eq!(count(&[vec![0.0]]), 1);
    }

    /// Whole lanes, and what is left behind them.
    #[test]
    fn a_sum_has_all_of_its_terms() {
        let values: Vec<f64> = (1..=19).map(f64::from).collect();
        assert!((dot(&values, &values) - 2470.0).abs() < 1e-9);
    }
}

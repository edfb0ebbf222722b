//! Columns of a law, and their least squares.

use nalgebra::DMatrix;

/// What is left of a column of unit length beside the others, at least.
pub(super) const APART: f64 = 1e-6;

/// One column more.
pub(super) fn with_column(columns: DMatrix<f64>, value: impl Fn(usize) -> f64) -> DMatrix<f64> {
    let count = columns.ncols();
    let mut more = columns.insert_column(count, 0.0);
    for (row, x) in more.column_mut(count).iter_mut().enumerate() {
        *x = value(row);
    }
    more
}

/// Orthonormal columns with the same sums; `None` where one is a sum of those before.
pub(super) fn orthonormal(columns: &DMatrix<f64>) -> Option<DMatrix<f64>> {
    let qr = columns.clone().qr();
    let r = qr.r();
    let is_apart = |k: usize| r[(k, k)].abs() > APART * columns.column(k).norm();
    (0..columns.ncols()).all(is_apart).then(|| qr.q())
}

/// `(A'A)^-1 A'`
pub(super) fn left_inverse(columns: &DMatrix<f64>) -> Option<DMatrix<f64>> {
    let q = orthonormal(columns)?;
    let r = q.transpose() * columns;
    r.solve_upper_triangular(&q.transpose())
}

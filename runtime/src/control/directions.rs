//! Singular values of small matrices: which wrenches the joints feel, and how strongly. No allocation, no panic.

/// Sweeps of rotations. Each squares what is left of the angles between columns, and the first ones get it below a half; the last
/// is to spare.
const SWEEPS: usize = 8;

/// A matrix `B` of `R` columns with `D` entries each, turned: `columns[k] = B v_k` are orthogonal to each other, `v_k` are
/// orthonormal, and the lengths of the columns are the singular values, falling.
pub(super) struct Directions<const D: usize, const R: usize> {
    pub(super) columns: [[f64; D]; R],
    pub(super) vectors: [[f64; R]; R],
    pub(super) lengths: [f64; R],
}

/// One-sided Jacobi rotations: accurate for small singular values too, as nothing is squared.
///
/// Source: Hestenes 1958; Golub & Van Loan, Matrix Computations, section 8.6.
pub(super) fn directions<const D: usize, const R: usize>(
    columns: &[[f64; D]; R],
) -> Directions<D, R> {
    let mut columns = *columns;
    let mut vectors = [[0.0; R]; R];
    for (k, vector) in vectors.iter_mut().enumerate() {
        vector[k] = 1.0;
    }
    for _ in 0..SWEEPS {
        for i in 0..R {
            for j in i + 1..R {
                let between = dot(&columns[i], &columns[j]);
                let [own, other] = [dot(&columns[i], &columns[i]), dot(&columns[j], &columns[j])];
                let turn = tangent(own, other, between);
                (columns[i], columns[j]) = turned(&columns[i], &columns[j], turn);
                (vectors[i], vectors[j]) = turned(&vectors[i], &vectors[j], turn);
            }
        }
    }
    for i in 0..R {
        for j in i + 1..R {
            if dot(&columns[i], &columns[i]) < dot(&columns[j], &columns[j]) {
                columns.swap(i, j);
                vectors.swap(i, j);
            }
        }
    }
    let lengths = columns
        .each_ref()
        .map(|column| crate::math::sqrt(dot(column, column)));
    Directions {
        columns,
        vectors,
        lengths,
    }
}

/// Of the smaller angle by which two columns become orthogonal.
fn tangent(own: f64, other: f64, between: f64) -> f64 {
    if between == 0.0 {
        return 0.0;
    }
    let ratio = (other - own) / (2.0 * between);
    let size = 1.0 / (ratio.abs() + crate::math::sqrt(1.0 + ratio * ratio));
    if ratio < 0.0 { -size } else { size }
}

fn turned<const N: usize>(x: &[f64; N], y: &[f64; N], tangent: f64) -> ([f64; N], [f64; N]) {
    let cos = 1.0 / crate::math::sqrt(1.0 + tangent * tangent);
    let sin = tangent * cos;
    (
        core::array::from_fn(|k| cos * x[k] - sin * y[k]),
        core::array::from_fn(|k| sin * x[k] + cos * y[k]),
    )
}

pub(super) fn dot<const N: usize>(x: &[f64; N], y: &[f64; N]) -> f64 {
    x.iter().zip(y).map(|(x, y)| x * y).sum()
}

#[cfg(test)]
mod tests {
    use super::{directions, dot};

    /// `B = sum s_k u_k v_k^T` comes apart again.
    fn check<const D: usize, const R: usize>(columns: [[f64; D]; R]) -> [f64; R] {
        let found = directions(&columns);
        for i in 0..R {
            for j in 0..R {
                let unit = f64::from(u8::from(i == j));
                assert!((dot(&found.vectors[i], &found.vectors[j]) - unit).abs() < 1e-14);
                let wanted = unit * found.lengths[i] * found.lengths[j];
                assert!((dot(&found.columns[i], &found.columns[j]) - wanted).abs() < 1e-13);
            }
            // B v_i
            let image: [f64; D] =
                core::array::from_fn(|d| (0..R).map(|k| columns[k][d] * found.vectors[i][k]).sum());
            for (x, y) in image.iter().zip(found.columns[i]) {
                assert!((x - y).abs() < 1e-13);
            }
        }
        assert!(found.lengths.is_sorted_by(|x, y| x >= y));
        found.lengths
    }

    fn some<const D: usize, const R: usize>(seed: f64) -> [[f64; D]; R] {
        core::array::from_fn(|r| {
            core::array::from_fn(|d| (seed + 3.7 * r as f64 + 1.3 * (d * d) as f64).sin())
        })
    }

    #[test]
    fn matrices_come_apart_and_together() {
        for seed in 0..50 {
            let seed = 0.7 * f64::from(seed);
            check(some::<7, 6>(seed));
            check(some::<3, 3>(seed));
            // Two joints feel no more than two directions.
            let lengths = check(some::<2, 6>(seed));
            assert!(lengths[2] < 1e-14 && lengths[1] > 0.0);
        }
    }

    #[test]
    fn what_is_nearly_singular_keeps_its_digits() {
        let lengths = check([[1.0, 0.0, 0.0], [1.0, 1e-9, 0.0], [0.0, 0.0, 1e-30]]);
        assert!((lengths[0] - 2f64.sqrt()).abs() < 1e-15);
        assert!((lengths[1] / (1e-9 / 2f64.sqrt()) - 1.0).abs() < 1e-6);
        assert!((lengths[2] / 1e-30 - 1.0).abs() < 1e-12);
        assert!(check([[0.0; 4]; 3]).iter().all(|length| *length == 0.0));
    }
}

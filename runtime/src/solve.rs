//! Small systems of linear equations in fixed memory, for emitted code: no allocation, no panic, `no_std`.
//!
//! Matrices are `[row][column]`. What cannot be solved, in one lane or in all, is `None`, a status that the caller must look at.

use crate::scalar::Scalar;

/// What is left of a pivot, relative to the diagonal entry or column that it came from, below which it counts as zero, in
/// roundings.
const SINGULAR: f64 = 100.0;

/// Most steps of [`newton`]: each ends in another piece of a piecewise linear torque, and joints have few.
const STEPS: usize = 20;

/// Newton's method ends where a step is this small, relative to the largest acceleration, in roundings.
const SETTLED: f64 = 1e4;

/// Solves `a x = b` for a symmetric positive definite `a`, of which the lower triangle is read, by `a = L D L^T`.
///
/// `None` where `a` is not positive definite to rounding, or not finite.
///
/// # Examples
/// ```
/// use robot_model::solve::positive_definite;
/// let x = positive_definite(&[[4.0_f64, 2.0], [2.0, 3.0]], &[10.0, 9.0]).expect("positive definite");
/// assert!((x[0] - 1.5).abs() < 1e-15 && (x[1] - 2.0).abs() < 1e-15);
/// assert_eq!(positive_definite(&[[1.0, 2.0], [2.0, 1.0]], &[1.0, 1.0]), None);
/// ```
#[must_use]
pub fn positive_definite<S: Scalar, const N: usize>(a: &[[S; N]; N], b: &[S; N]) -> Option<[S; N]> {
    let mut lower = [[S::zero(); N]; N];
    let mut diagonal = [S::zero(); N];
    let mut x = *b;
    for i in 0..N {
        for j in 0..i {
            // `lower[i][j] * diagonal[j]` first.
            let mut entry = a[i][j];
            for k in 0..j {
                entry -= lower[i][k] * diagonal[k] * lower[j][k];
            }
            lower[i][j] = entry / diagonal[j];
        }
        let mut pivot = a[i][i];
        for j in 0..i {
            pivot -= lower[i][j] * lower[i][j] * diagonal[j];
            let change = lower[i][j] * x[j];
            x[i] -= change;
        }
        // A comparison with NaN is false too.
        let spare = pivot - S::of(SINGULAR * S::ROUNDING) * a[i][i];
        if !(spare.least() > 0.0 && pivot.most().is_finite()) {
            return None;
        }
        diagonal[i] = pivot;
    }
    for i in (0..N).rev() {
        x[i] /= diagonal[i];
        for j in i + 1..N {
            let change = lower[j][i] * x[j];
            x[i] -= change;
        }
    }
    Some(x)
}

/// Solves `a x = b` for any square `a` by elimination with row pivoting.
///
/// `None` where `a` is singular to rounding, or not finite.
///
/// # Examples
/// ```
/// use robot_model::solve::general;
/// assert_eq!(general(&[[0.0, 2.0], [1.0, 3.0]], &[4.0, 7.0]), Some([1.0, 2.0]));
/// assert_eq!(general(&[[1.0, 2.0], [2.0, 4.0]], &[1.0, 1.0]), None);
/// ```
#[must_use]
pub fn general<S: Scalar, const N: usize>(a: &[[S; N]; N], b: &[S; N]) -> Option<[S; N]> {
    let (mut a, mut x) = (*a, *b);
    let larger = |most: S, entry: &S| S::choose(entry.abs() - most, entry.abs(), most);
    let scale = a.iter().flatten().fold(S::zero(), larger);
    for column in 0..N {
        for row in column + 1..N {
            // The larger of both goes up, in each lane by itself.
            let gain = a[row][column].abs() - a[column][column].abs();
            let exchange =
                |upper: S, lower: S| (S::choose(gain, lower, upper), S::choose(gain, upper, lower));
            for k in column..N {
                (a[column][k], a[row][k]) = exchange(a[column][k], a[row][k]);
            }
            (x[column], x[row]) = exchange(x[column], x[row]);
        }
        let size = a[column][column].abs();
        let spare = size - S::of(SINGULAR * S::ROUNDING) * scale;
        if !(spare.least() > 0.0 && size.most().is_finite()) {
            return None;
        }
        for row in column + 1..N {
            let factor = a[row][column] / a[column][column];
            for k in column..N {
                let change = factor * a[column][k];
                a[row][k] -= change;
            }
            let change = factor * x[column];
            x[row] -= change;
        }
    }
    for row in (0..N).rev() {
        for k in row + 1..N {
            let change = a[row][k] * x[k];
            x[row] -= change;
        }
        x[row] /= a[row][row];
    }
    Some(x)
}

/// Solves `f(x) = 0` from `x = 0` by Newton's method; `step` gives the slope of `f` at `x` and `-f(x)`.
///
/// Where `f` is linear in pieces, as torque with friction that depends on the load is in the accelerations, few steps end at
/// the solution. `None` where a slope is singular or the steps do not settle.
///
/// # Examples
/// ```
/// use robot_model::solve::newton;
/// // x + |x| / 2 = 3
/// let step = |x: &[f64; 1]| ([[1.0 + 0.5 * x[0].signum()]], [3.0 - x[0] - 0.5 * x[0].abs()]);
/// assert_eq!(newton(step), Some([2.0]));
/// ```
#[must_use]
pub fn newton<S: Scalar, const N: usize>(
    step: impl Fn(&[S; N]) -> ([[S; N]; N], [S; N]),
) -> Option<[S; N]> {
    let mut x = [S::zero(); N];
    for _ in 0..STEPS {
        let (slope, rest) = step(&x);
        let change = general(&slope, &rest)?;
        let (mut largest, mut moved) = (0.0_f64, 0.0_f64);
        for (x, change) in x.iter_mut().zip(change) {
            *x += change;
            // In one lane there is no number: there is no solution there, as where none is found.
            if !x.abs().most().is_finite() {
                return None;
            }
            largest = largest.max(x.abs().most());
            moved = moved.max(change.abs().most());
        }
        if moved <= SETTLED * S::ROUNDING * largest {
            return Some(x);
        }
    }
    None
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scalar::Lanes4;

    #[test]
    fn newton_takes_no_lane_without_a_number_for_a_settled_one() {
        let solve = |rest: [f64; 4]| {
            newton(|x: &[Lanes4; 1]| {
                let half = Lanes4::of(0.5);
                let slope = Lanes4::of(1.0) + half * x[0].sign();
                let left = Lanes4::from(rest) - x[0] - half * x[0].abs();
                ([[slope]], [left])
            })
        };
        let [x] = solve([0.3, 3.0, -1.0, 2.0]).expect("each lane has a solution");
        for (x, wanted) in x.to_array().into_iter().zip([0.2, 2.0, -2.0, 4.0 / 3.0]) {
            assert!((x - wanted).abs() < 1e-12, "{x}");
        }
        assert_eq!(solve([f64::NAN, 3.0, -1.0, 2.0]), None);
        assert_eq!(solve([3.0, 3.0, f64::INFINITY, 2.0]), None);
    }

    /// `a = L L^T` of numbers without meaning.
    fn system() -> ([[f64; 4]; 4], [f64; 4]) {
        let lower: [[f64; 4]; 4] = core::array::from_fn(|i| {
            core::array::from_fn(|j| {
                let entry = ((7 * i + 3 * j) as f64).sin();
                match j.cmp(&i) {
                    core::cmp::Ordering::Less => entry,
                    // Far from singular, so that rounding stays rounding.
                    core::cmp::Ordering::Equal => 2.0 + entry,
                    core::cmp::Ordering::Greater => 0.0,
                }
            })
        });
        let a = core::array::from_fn(|i| {
            core::array::from_fn(|j| (0..4).map(|k| lower[i][k] * lower[j][k]).sum())
        });
        (a, [1.0, -2.0, 3.0, 0.5])
    }

    #[test]
    fn solutions_solve() {
        let (a, b) = system();
        for x in [positive_definite(&a, &b), general(&a, &b)] {
            let x = x.expect("positive definite");
            for (row, b) in a.iter().zip(b) {
                let found: f64 = row.iter().zip(x).map(|(a, x)| a * x).sum();
                assert!((found - b).abs() < 1e-12, "{found} and {b}");
            }
        }
    }

    #[test]
    fn what_is_singular_or_no_number_has_no_solution() {
        let (mut a, b) = system();
        a[3] = a[2];
        assert_eq!(general(&a, &b), None);
        for i in 0..4 {
            a[i][3] = a[i][2];
        }
        assert_eq!(positive_definite(&a, &b), None);
        a[0][0] = f64::NAN;
        assert_eq!(positive_definite(&a, &b), None);
        assert_eq!(general(&a, &b), None);
        assert_eq!(general(&[[0.0; 2]; 2], &[1.0; 2]), None);
    }

    /// Each lane has its own pivots and its own scale.
    #[test]
    fn lanes_are_solved_each_by_itself() {
        let crossed = [[0.0, 1.0], [1.0, 0.0]];
        let straight = [[1.0, 0.0], [0.0, 1.0]];
        let steep = [[1e-12, 1.0], [1.0, 1.0]];
        let huge = [[1e20, 0.0], [0.0, 3e20]];
        let systems = [crossed, straight, steep, huge];
        let a = core::array::from_fn(|i| {
            core::array::from_fn(|j| Lanes4::from(systems.map(|system| system[i][j])))
        });
        let b = [Lanes4::of(2.0), Lanes4::of(3.0)];
        let x = general(&a, &b).expect("no lane is singular");
        for (lane, system) in systems.iter().enumerate() {
            let alone = general(system, &[2.0, 3.0]).expect("not singular");
            assert_eq!(
                x.map(|x| x.to_array()[lane].to_bits()),
                alone.map(f64::to_bits)
            );
        }
    }

    /// What is singular to the rounding of a scalar is singular, and what is solved to it is solved.
    #[test]
    fn single_precision_has_its_own_limits() {
        let rows: [[f32; 3]; 2] = [[0.3, 1.7, -0.4], [2.2, 0.1, 0.9]];
        let gram: [[f32; 3]; 3] = core::array::from_fn(|i| {
            core::array::from_fn(|j| rows.iter().map(|row| row[i] * row[j]).sum())
        });
        assert_eq!(positive_definite(&gram, &[1.0, 2.0, 3.0]), None);
        assert_eq!(general(&gram, &[1.0, 2.0, 3.0]), None);
        // x + |x| / 3 = 0.7, and x + y / 7 = 0.1.
        let step = |x: &[f32; 2]| {
            let slope = [[1.0 + x[0].signum() / 3.0, 0.0], [1.0, 1.0 / 7.0]];
            (
                slope,
                [0.7 - x[0] - x[0].abs() / 3.0, 0.1 - x[0] - x[1] / 7.0],
            )
        };
        let [x, y] = newton(step).expect("linear in pieces");
        assert!(
            (x - 0.525).abs() < 1e-6 && (y + 2.975).abs() < 1e-5,
            "{x} {y}"
        );
    }

    #[test]
    fn steps_that_go_around_end() {
        // No root: x^2 + 1.
        assert_eq!(
            newton(|x: &[f64; 1]| ([[2.0 * x[0]]], [-1.0 - x[0] * x[0]])),
            None
        );
        let round = |x: &[f64; 1]| ([[2.0 * x[0] + 0.1]], [-1.0 - x[0] * x[0]]);
        assert_eq!(newton(round), None);
    }
}

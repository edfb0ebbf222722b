//! Which contacts stick, and with what share of their friction.

use nalgebra::{DMatrix, DVector};

/// What counts as on a bound, of shares between -1 and 1.
const ROUNDING: f64 = 1e-12;

/// Most changes of what sticks before the slow way is taken.
const CHANGES: usize = 60;

/// Most sweeps of the slow way, and the change of a share after which it ends.
const SWEEPS: usize = 50_000;
const SETTLED: f64 = 1e-15;

/// Shares `s`, each in -1 to 1, and what is left, `w = r - D s`: zero where `s` is inside, not negative where `s = 1`, not
/// positive where `s = -1`.
///
/// In friction `w` is the acceleration of a contact, and `D` how much of it each share holds back. Principal pivoting finds the
/// solution in few changes where `D` is a P-matrix. Where contacts hold the same thing together, so that `D` is singular,
/// projected Gauss-Seidel finds one of many. Each diagonal entry of `D` is positive.
pub(super) fn solve(d: &DMatrix<f64>, r: &DVector<f64>) -> DVector<f64> {
    pivoted(d, r).unwrap_or_else(|| projected(d, r))
}

fn pivoted(d: &DMatrix<f64>, r: &DVector<f64>) -> Option<DVector<f64>> {
    let count = r.len();
    // 0 where a contact sticks, else its bound.
    let mut bound = vec![0.0; count];
    let (mut fewest, mut patience) = (count + 1, 3);
    for _ in 0..CHANGES {
        let free: Vec<usize> = (0..count).filter(|&k| bound[k] == 0.0).collect();
        let mut s = DVector::from_column_slice(&bound);
        let rest = r - d * &s;
        let square = DMatrix::from_fn(free.len(), free.len(), |i, j| d[(free[i], free[j])]);
        let wanted = DVector::from_fn(free.len(), |i, _| rest[free[i]]);
        if !free.is_empty() {
            let scale = square.diagonal().amax();
            let lu = square.full_piv_lu();
            if lu
                .u()
                .diagonal()
                .iter()
                .any(|pivot| pivot.abs() < 1e-10 * scale)
            {
                return None;
            }
            let held = lu.solve(&wanted)?;
            for (i, &k) in free.iter().enumerate() {
                s[k] = held[i];
            }
        }
        let left = r - d * &s;
        let wrong = |k: usize| {
            let slack = ROUNDING * (r[k].abs() + d[(k, k)]);
            match bound[k] {
                0.0 if s[k].abs() > 1.0 + ROUNDING => Some(s[k].signum()),
                sign if sign * left[k] < -slack => Some(0.0),
                _ => None,
            }
        };
        let changes: Vec<(usize, f64)> = (0..count).filter_map(|k| Some((k, wrong(k)?))).collect();
        if changes.is_empty() {
            return Some(s.map(|share| share.clamp(-1.0, 1.0)));
        }
        // All at once as long as that gets nearer, else one by one, which cannot go round.
        if changes.len() < fewest {
            (fewest, patience) = (changes.len(), 3);
        } else {
            patience -= 1;
        }
        let taken = if patience > 0 {
            &changes[..]
        } else {
            &changes[changes.len() - 1..]
        };
        for &(k, to) in taken {
            bound[k] = to;
        }
        patience = patience.max(0);
    }
    None
}

fn projected(d: &DMatrix<f64>, r: &DVector<f64>) -> DVector<f64> {
    let mut s = DVector::zeros(r.len());
    for _ in 0..SWEEPS {
        let mut moved = 0.0_f64;
        for k in 0..r.len() {
            let left = r[k] - (d.row(k) * &s)[0];
            let share = (s[k] + left / d[(k, k)]).clamp(-1.0, 1.0);
            moved = moved.max((share - s[k]).abs());
            s[k] = share;
        }
        if moved < SETTLED {
            break;
        }
    }
    s
}

#[cfg(test)]
mod tests {
    use super::*;

    fn check(d: &DMatrix<f64>, r: &DVector<f64>, s: &DVector<f64>, tolerance: f64) {
        let left = r - d * s;
        for (s, left) in s.iter().zip(&left) {
            assert!(s.abs() <= 1.0);
            let inside = s.abs() < 1.0 - tolerance;
            assert!(!inside || left.abs() < tolerance, "{s} {left}");
            assert!(left * s > -tolerance, "{s} {left}");
        }
    }

    /// Blocks that push on each other, some of which slide.
    #[test]
    fn both_ways_find_who_sticks() {
        for count in 1..9 {
            for case in 0..40 {
                let noise = |i: usize, j: usize| ((i * 31 + j * 17 + case * 7) as f64).sin();
                let root = DMatrix::from_fn(count, count, noise);
                let d = &root * root.transpose() + DMatrix::identity(count, count) * 0.3;
                let r = DVector::from_fn(count, |k, _| 3.0 * noise(k, 77));
                let fast = pivoted(&d, &r).expect("a P-matrix");
                check(&d, &r, &fast, 1e-9);
                let slow = projected(&d, &r);
                assert!((&fast - &slow).amax() < 1e-9, "{fast} {slow}");
            }
        }
    }

    /// Two brakes on one shaft share a load that either alone would not hold.
    #[test]
    fn brakes_that_hold_together_share_the_load() {
        let d = DMatrix::from_element(2, 2, 1.0);
        for load in [0.4, -1.7, 1.9, 2.5] {
            let r = DVector::from_element(2, load);
            let s = solve(&d, &r);
            check(&d, &r, &s, 1e-9);
            let held = (s[0] + s[1]).abs();
            assert!((held - f64::min(2.0, f64::abs(load))).abs() < 1e-9, "{s}");
        }
    }
}

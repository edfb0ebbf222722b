//! Which inertias a body can have.

use crate::model::Inertial;

/// Of the sum of moments: inertias of plates are at the border, and URDFs give them with two digits.
const ROUNDED: f64 = 0.005;

impl Inertial {
    /// Whether some body has this mass and inertia; true where none is given.
    ///
    /// The second moments about the center of mass, `tr(I)/2 - I`, are those of a mass that is nowhere negative: positive
    /// semidefinite. That is the triangle inequality of the principal moments, and with it none of them is negative. Moments
    /// of two digits are taken for what they round, and one of zero for one that was left out, as that of a planar arm about
    /// an axis in its plane.
    #[must_use]
    pub fn is_possible(&self) -> bool {
        let (Self::Nominal(ten) | Self::Fixed(ten)) = self else {
            return true;
        };
        let [m, mx, my, mz, ixx, ixy, ixz, iyy, iyz, izz] = *ten;
        let first = [mx, my, mz];
        let mut inertia = [[ixx, ixy, ixz], [ixy, iyy, iyz], [ixz, iyz, izz]];
        // What the center of mass takes away leaves the error of the larger number.
        let lost = 1e-12 * (ixx + iyy + izz);
        if m > 0.0 {
            let square: f64 = first.iter().map(|x| x * x).sum();
            for (row, entries) in inertia.iter_mut().enumerate() {
                for (column, entry) in entries.iter_mut().enumerate() {
                    let diagonal = if row == column { square } else { 0.0 };
                    *entry -= (diagonal - first[row] * first[column]) / m;
                }
            }
        }
        has_a_body(&inertia, lost)
    }
}

/// Whether second moments with these inertias about the center of mass are positive, to within rounded digits and `lost`.
pub(crate) fn has_a_body(inertia: &[[f64; 3]; 3], lost: f64) -> bool {
    has_moments(inertia, lost, ROUNDED)
}

/// The same without room for rounded digits.
pub(crate) fn surely_has_a_body(inertia: &[[f64; 3]; 3]) -> bool {
    has_moments(inertia, 0.0, 0.0)
}

/// `rounded` is a share of the sum of moments.
fn has_moments(inertia: &[[f64; 3]; 3], lost: f64, rounded: f64) -> bool {
    let trace: f64 = (0..3).map(|k| inertia[k][k]).sum();
    let zero = |row: usize, column: usize| inertia[row][column].abs() <= lost;
    let is_planar = (0..3).any(|k| zero(k, k)) && zero(0, 1) && zero(0, 2) && zero(1, 2);
    if is_planar && (0..3).all(|k| inertia[k][k] >= -lost) {
        return true;
    }
    let s: [[f64; 3]; 3] = std::array::from_fn(|row| {
        std::array::from_fn(|column| {
            let diagonal = if row == column {
                (0.5 + rounded) * trace + lost
            } else {
                0.0
            };
            diagonal - inertia[row][column]
        })
    });
    let second = s[0][0] * s[1][1] - s[0][1] * s[1][0];
    let third = s[0][2] * (s[1][0] * s[2][1] - s[1][1] * s[2][0])
        - s[1][2] * (s[0][0] * s[2][1] - s[0][1] * s[2][0])
        + s[2][2] * second;
    s[0][0] > 0.0 && second > 0.0 && third > 0.0
}

#[cfg(test)]
mod tests {
    use super::{Inertial, has_a_body};

    fn diagonal([x, y, z]: [f64; 3]) -> [[f64; 3]; 3] {
        [[x, 0.0, 0.0], [0.0, y, 0.0], [0.0, 0.0, z]]
    }

    #[test]
    fn the_longest_moment_is_no_longer_than_the_others_together() {
        for possible in [
            [1.0, 1.0, 1.0],
            [1.0, 2.0, 3.0],
            [1.0, 1.0, 0.0],
            [0.0; 3],
            [0.0, 0.0, 2.0],
        ] {
            assert!(has_a_body(&diagonal(possible), 0.0), "{possible:?}");
        }
        for impossible in [[1.0, 2.0, 3.1], [1.0, 1.0, -0.1], [0.0, -1.0, 1.0]] {
            assert!(!has_a_body(&diagonal(impossible), 0.0), "{impossible:?}");
        }
        let indefinite = [[1.0, 2.0, 0.0], [2.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
        assert!(!has_a_body(&indefinite, 0.0));
    }

    #[test]
    fn the_center_of_mass_is_taken_out() {
        // 2 kg at x = 3 m: a rod, and less than a point.
        let point = |iyy: f64| {
            Inertial::Nominal([2.0, 6.0, 0.0, 0.0, 0.0, 0.0, 0.0, iyy, 0.0, iyy]).is_possible()
        };
        assert!(point(18.0));
        assert!(!point(17.0));
    }
}

//! Rotations and rigid transforms, exact where angles are multiples of a quarter turn; names in camel case.

use std::f64::consts::FRAC_PI_2;

use crate::model::Transform;

/// Angles this close to a multiple of a quarter turn are meant to be one, rad.
///
/// URDF files and DH tables round pi/2 to eight or ten digits. Left as it is, 1.570796325 puts entries of 2e-9 into
/// rotations: physically nothing, but each of them makes terms that should vanish stay in the equations and raises the
/// numerical rank of regressors.
const QUARTER_TOLERANCE: f64 = 1e-8;

/// `angle` as a whole number of quarter turns, if it is one.
pub(crate) fn quarter_turns(angle: f64) -> Option<f64> {
    let turns = (angle / FRAC_PI_2).round();
    ((angle - turns * FRAC_PI_2).abs() <= QUARTER_TOLERANCE).then_some(turns)
}

/// The nearest multiple of a quarter turn where `angle` is close to one, else `angle`.
pub(crate) fn snap(angle: f64) -> f64 {
    quarter_turns(angle).map_or(angle, |turns| turns * FRAC_PI_2 + 0.0)
}

/// Fewest decimals with which a rounded multiple of a quarter turn cannot be an angle of its own.
const FEWEST_DECIMALS: usize = 4;

/// The multiple of a quarter turn that `angle` is the decimal rounding of, to four places or more: 1.5708 is pi/2.
///
/// For files whose numbers are written by programs. The shortest decimal that is read as `angle` stands for what was written.
pub(crate) fn rounded_quarter_turn(angle: f64) -> Option<f64> {
    let written = format!("{}", angle.abs());
    let decimals = written.split_once('.').map_or(0, |(_, tail)| tail.len());
    let turns = (angle / FRAC_PI_2).round();
    let meant = turns * FRAC_PI_2;
    (turns != 0.0
        && decimals >= FEWEST_DECIMALS
        && format!("{:.decimals$}", meant.abs()) == written)
        .then_some(meant)
}

/// Sine and cosine; exactly 0, 1 or -1 at multiples of a quarter turn.
pub(crate) fn sin_cos(angle: f64) -> (f64, f64) {
    let Some(turns) = quarter_turns(angle) else {
        return angle.sin_cos();
    };
    match turns.rem_euclid(4.0) {
        0.0 => (0.0, 1.0),
        1.0 => (1.0, 0.0),
        2.0 => (0.0, -1.0),
        _ => (-1.0, 0.0),
    }
}

/// A rotation matrix, `[row][column]`.
pub(crate) type Rotation = [[f64; 3]; 3];

/// Rotation about x.
pub(crate) fn rotation_x(angle: f64) -> Rotation {
    let (s, c) = sin_cos(angle);
    clean([[1.0, 0.0, 0.0], [0.0, c, -s], [0.0, s, c]])
}

/// Rotation about y.
fn rotation_y(angle: f64) -> Rotation {
    let (s, c) = sin_cos(angle);
    clean([[c, 0.0, s], [0.0, 1.0, 0.0], [-s, 0.0, c]])
}

/// Rotation about z.
pub(crate) fn rotation_z(angle: f64) -> Rotation {
    let (s, c) = sin_cos(angle);
    clean([[c, -s, 0.0], [s, c, 0.0], [0.0, 0.0, 1.0]])
}

/// Rotation by `angle` about a unit vector: `c 1 + s [n]x + (1 - c) n n^T`.
pub(crate) fn rotation_about([x, y, z]: [f64; 3], angle: f64) -> Rotation {
    let (s, c) = sin_cos(angle);
    let v = 1.0 - c;
    clean([
        [x * x * v + c, x * y * v - z * s, x * z * v + y * s],
        [x * y * v + z * s, y * y * v + c, y * z * v - x * s],
        [x * z * v - y * s, y * z * v + x * s, z * z * v + c],
    ])
}

/// Roll, pitch, yaw as in URDF: `Rz(yaw) Ry(pitch) Rx(roll)`.
pub(crate) fn rotation_rpy([roll, pitch, yaw]: [f64; 3]) -> Rotation {
    product(
        &rotation_z(yaw),
        &product(&rotation_y(pitch), &rotation_x(roll)),
    )
}

/// Roll, pitch, yaw of a rotation; at pitch of a quarter turn, where only a sum of the other two is seen, yaw is zero.
pub(crate) fn rpy(x: &Rotation) -> [f64; 3] {
    let pitch = (-x[2][0]).atan2(x[0][0].hypot(x[1][0]));
    let angles = if x[2][0].abs() > 1.0 - 1e-12 {
        [(x[0][1] * pitch.signum()).atan2(x[1][1]), pitch, 0.0]
    } else {
        [x[2][1].atan2(x[2][2]), pitch, x[1][0].atan2(x[0][0])]
    };
    // No zero has a sign.
    angles.map(|angle| angle + 0.0)
}

/// `x * y`
pub(crate) fn product(x: &Rotation, y: &Rotation) -> Rotation {
    clean(std::array::from_fn(|i| {
        std::array::from_fn(|j| (0..3).map(|k| x[i][k] * y[k][j]).sum())
    }))
}

/// `x * v`
pub(crate) fn rotate(x: &Rotation, v: [f64; 3]) -> [f64; 3] {
    std::array::from_fn(|i| (0..3).map(|k| x[i][k] * v[k]).sum::<f64>() + 0.0)
}

/// Negative zeros become zeros.
fn clean(x: Rotation) -> Rotation {
    x.map(|row| row.map(|entry| entry + 0.0))
}

impl Transform {
    /// No motion.
    pub const IDENTITY: Self = Self {
        rotation: [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]],
        translation: [0.0; 3],
    };

    /// `self * next`: `next` is expressed in the frame after `self`.
    #[must_use]
    pub fn then(&self, next: &Self) -> Self {
        Self {
            rotation: product(&self.rotation, &next.rotation),
            translation: self.apply(next.translation),
        }
    }

    /// Coordinates of a point of the inner frame in the outer one.
    #[must_use]
    pub fn apply(&self, point: [f64; 3]) -> [f64; 3] {
        let turned = rotate(&self.rotation, point);
        std::array::from_fn(|i| turned[i] + self.translation[i] + 0.0)
    }
}

/// `ur10_robot` as `Ur10Robot`: a name that Rust accepts for a type.
#[must_use]
pub fn upper_camel(name: &str) -> String {
    let mut camel = String::new();
    for part in name
        .split(|c: char| !c.is_ascii_alphanumeric())
        .filter(|part| !part.is_empty())
    {
        let mut letters = part.chars();
        camel.extend(letters.next().map(|c| c.to_ascii_uppercase()));
        camel.extend(letters);
    }
    if camel.starts_with(|c: char| c.is_ascii_uppercase()) {
        camel
    } else {
        format!("Robot{camel}")
    }
}

/// No quantity of a robot is larger in SI units.
pub(crate) const LARGEST: f64 = 1e30;

/// Of what moves: half a turn to a higher power is larger than [`LARGEST`].
pub(crate) const LARGEST_EXPONENT: f64 = 60.0;

/// Whether products of a few such numbers stay finite: zero, or 1e-30 to 1e30. No quantity of a robot is outside.
pub(crate) fn is_in_range(x: f64) -> bool {
    x == 0.0 || (1e-30..=LARGEST).contains(&x.abs())
}

#[cfg(test)]
mod tests {
    #![expect(clippy::float_cmp, reason = "these numbers are exact")]
    #![expect(clippy::approx_constant, reason = "as files write them")]

    use super::*;

    #[test]
    fn rounded_quarter_turns_give_exact_entries() {
        assert_eq!(
            rotation_x(1.570_796_325),
            [[1.0, 0.0, 0.0], [0.0, 0.0, -1.0], [0.0, 1.0, 0.0]]
        );
        assert_eq!(
            rotation_z(-1.570_796_325),
            [[0.0, 1.0, 0.0], [-1.0, 0.0, 0.0], [0.0, 0.0, 1.0]]
        );
        assert_eq!(sin_cos(-FRAC_PI_2), (-1.0, 0.0));
    }

    #[test]
    fn decimals_of_four_places_and_more_are_rounded_quarter_turns() {
        for (written, meant) in [
            (1.5708, FRAC_PI_2),
            (-1.570_796, -FRAC_PI_2),
            (3.1416, 2.0 * FRAC_PI_2),
            (-3.141_59, -2.0 * FRAC_PI_2),
            (4.7124, 3.0 * FRAC_PI_2),
        ] {
            assert_eq!(rounded_quarter_turn(written), Some(meant), "{written}");
        }
        // Three decimals, cut instead of rounded, another angle, none.
        for angle in [1.571, 1.5707, 1.5709, 0.7854, 0.0] {
            assert_eq!(rounded_quarter_turn(angle), None, "{angle}");
        }
    }

    #[test]
    fn rotations_about_axes_are_those_of_the_axes() {
        assert_eq!(rotation_about([1.0, 0.0, 0.0], 0.3), rotation_x(0.3));
        assert_eq!(rotation_about([0.0, 1.0, 0.0], 0.3), rotation_y(0.3));
        assert_eq!(rotation_about([0.0, 0.0, 1.0], -2.0), rotation_z(-2.0));
    }

    #[test]
    fn other_angles_are_left_alone() {
        assert_ne!(sin_cos(FRAC_PI_2 + 1e-6).1, 0.0);
        assert_eq!(snap(0.3), 0.3);
    }

    #[test]
    fn angles_of_a_rotation_give_it_back() {
        for angles in [
            [0.3, -0.4, 2.0],
            [0.7, FRAC_PI_2, 0.0],
            [0.7, -FRAC_PI_2, 0.5],
            [-3.0, 1.2, -3.1],
            [0.0; 3],
        ] {
            let rotation = rotation_rpy(angles);
            let found = rpy(&rotation);
            let has_signed_zero = |angle: &f64| *angle == 0.0 && angle.is_sign_negative();
            assert!(!found.iter().any(has_signed_zero), "{found:?}");
            let again = rotation_rpy(found);
            let difference = rotation
                .iter()
                .flatten()
                .zip(again.iter().flatten())
                .map(|(x, y)| (x - y).abs());
            assert!(difference.fold(0.0, f64::max) < 1e-14, "{angles:?}");
        }
    }

    #[test]
    fn roll_comes_first() {
        let quarter = rotation_rpy([FRAC_PI_2, 0.0, FRAC_PI_2]);
        assert_eq!(rotate(&quarter, [0.0, 1.0, 0.0]), [0.0, 0.0, 1.0]);
        assert_eq!(rotate(&quarter, [0.0, 0.0, 1.0]), [1.0, 0.0, 0.0]);
    }
}

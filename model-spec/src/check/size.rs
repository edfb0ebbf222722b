//! Sizes that no arm has: most are in another unit than is written.

use proc_macro2::Span;

use super::unit::Dimension;
use super::value::Checked;
use crate::diagnostic::Diagnostic;

/// Two turns. A larger number without a unit was meant in degrees.
const LARGEST_BARE_ANGLE: f64 = 2.0 * std::f64::consts::TAU;

/// In m. Squares of lengths stand beside each other in inertias: a double holds eight digits of both only if they differ by
/// four at most.
const LARGEST_LENGTH: f64 = 1000.0;

/// What a number without a unit may be at most, in SI units, and what a larger one was most likely meant in.
struct Bare {
    dimension: Dimension,
    largest: f64,
    unit: &'static str,
    meant: &'static str,
}

impl Bare {
    const ALL: [Self; 8] = [
        Self::of(Dimension::ANGLE, LARGEST_BARE_ANGLE, "rad", "deg"),
        Self::of(Dimension::LENGTH, 10.0, "m", "mm"),
        Self::of(Dimension::MASS, 2000.0, "kg", "g"),
        Self::of(Dimension::INERTIA, 1e4, "kg*m^2", "kg*mm^2"),
        Self::of(Dimension::ACCELERATION, 200.0, "m/s^2", "mm/s^2"),
        Self::of(Dimension::SPEED, 60.0, "m/s", "mm/s"),
        Self::of(Dimension::ANGULAR_SPEED, 60.0, "rad/s", "deg/s"),
        Self::of(Dimension::TORQUE, 3e4, "Nm", "N*mm"),
    ];

    const fn of(
        dimension: Dimension,
        largest: f64,
        unit: &'static str,
        meant: &'static str,
    ) -> Self {
        Self {
            dimension,
            largest,
            unit,
            meant,
        }
    }

    /// What a number is beyond, if it is.
    fn beyond(value: f64, dimension: Dimension) -> Option<&'static Self> {
        let mut all = Self::ALL.iter();
        all.find(|bare| bare.dimension == dimension && value.abs() > bare.largest)
    }

    fn refuse(&self, span: Span, value: f64) -> Diagnostic {
        let label = if self.dimension == Dimension::ANGLE {
            format!("{:.1} turns", value / std::f64::consts::TAU)
        } else {
            "more than arms have".to_owned()
        };
        let Self { unit, meant, .. } = self;
        Diagnostic::new(
            span,
            format!("{} of {value} {unit}", self.dimension.describe()),
            label,
        )
        .help(format!(
            "a bare number is in {unit}: write `{value} {meant}`, or `{value} {unit}` if it is meant"
        ))
    }
}

/// A number in SI units as a spec takes it: with its unit where a bare one of that size would be asked for it.
pub(crate) fn written(value: f64, dimension: Dimension, number: fn(f64) -> String) -> String {
    match Bare::beyond(value, dimension) {
        Some(bare) => format!("{} {}", number(value), bare.unit),
        None => number(value),
    }
}

/// Whether a number without a unit is larger than those of any usual arm.
pub(crate) fn is_unlikely(value: f64, dimension: Dimension) -> bool {
    Bare::beyond(value, dimension).is_some()
}

fn millimeters_meant(span: Span, value: f64) -> Diagnostic {
    Diagnostic::new(
        span,
        format!("a length of {value} m"),
        "longer than any arm",
    )
    .help(format!(
        "a bare number is in m: write `{value} mm` if that is meant; lengths end at 1000 m"
    ))
}

/// The largest size of a dimension, in SI units. Limits may stand for none at all, so theirs are far off.
const LARGEST: [(Dimension, f64); 9] = [
    (Dimension::ANGLE, 1e9),
    (Dimension::MASS, 1e6),
    (Dimension::INERTIA, 1e9),
    (Dimension::ACCELERATION, 1e9),
    (Dimension::SPEED, 1e9),
    (Dimension::ANGULAR_SPEED, 1e9),
    (Dimension::ANGULAR_ACCELERATION, 1e12),
    (Dimension::FORCE, 1e12),
    (Dimension::TORQUE, 1e12),
];

/// Whether a number in SI units is larger than a spec takes, as limits are that stand for none.
pub(crate) fn is_beyond(value: f64, dimension: Dimension) -> bool {
    let largest = LARGEST.iter().find(|(of, _)| *of == dimension);
    let largest = largest.map_or(LARGEST_LENGTH, |(_, largest)| *largest);
    value.abs() > largest
}

/// Refuses what no arm has; a `bare` number has no unit behind it.
pub(super) fn check(value: f64, dimension: Dimension, is_bare: bool, span: Span) -> Checked<()> {
    let size = value.abs();
    if dimension == Dimension::LENGTH && size > LARGEST_LENGTH {
        return Err(millimeters_meant(span, value));
    }
    if let Some(bare) = Bare::beyond(value, dimension).filter(|_| is_bare) {
        return Err(bare.refuse(span, value));
    }
    let largest = LARGEST.iter().find(|(of, _)| *of == dimension);
    match largest {
        Some((_, largest)) if size > *largest => Err(Diagnostic::new(
            span,
            format!("{} of {value:e} in SI units", dimension.describe()),
            "no arm has that",
        )
        .help(format!(
            "write it in {}; bare numbers are in SI units, in which this ends at {largest:e}",
            dimension.units()
        ))),
        _ => Ok(()),
    }
}

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

fn degrees_meant(span: Span, value: f64) -> Diagnostic {
    Diagnostic::new(
        span,
        format!("an angle of {value} rad"),
        format!("{:.1} turns", value / std::f64::consts::TAU),
    )
    .help(format!(
        "a bare number is in rad: write `{value} deg`, or `{value} rad` if it is meant"
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

/// Refuses what no arm has; a `bare` number has no unit behind it.
pub(super) fn check(value: f64, dimension: Dimension, is_bare: bool, span: Span) -> Checked<()> {
    let size = value.abs();
    if is_bare && dimension == Dimension::ANGLE && size > LARGEST_BARE_ANGLE {
        return Err(degrees_meant(span, value));
    }
    if dimension == Dimension::LENGTH && size > LARGEST_LENGTH {
        return Err(millimeters_meant(span, value));
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

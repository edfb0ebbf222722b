//! What keeps steps near: scales of parameters, damping, radius of the trust region.

use nalgebra::{DMatrix, DVector};

use super::Search;
use super::step::LEAST;
use crate::identify::output_error::identifiable::audible;
use crate::identify::output_error::problem::Place;

/// Lengths of columns so far, 0 where all of a parameter is nothing beside the largest of the others.
pub(super) fn scales(now: &DMatrix<f64>, before: &DVector<f64>, values: &[f64]) -> DVector<f64> {
    let lengths = now.column_iter().map(|column| column.norm());
    let lengths: Vec<f64> = lengths
        .zip(before.iter())
        .map(|(now, before)| now.max(*before))
        .collect();
    DVector::from_vec(audible(&lengths, values))
}

/// Damping or radius of the first step.
pub(super) fn first_control(search: Search, place: &Place, scale: &DVector<f64>) -> f64 {
    match search {
        Search::LevenbergMarquardt => 1e-3,
        Search::TrustRegion => {
            let values = DVector::from_column_slice(&place.values);
            f64::max(0.3 * values.component_mul(scale).norm(), 1e-6)
        }
    }
}

/// Damping or radius after a step of a length, that lowered the cost by `ratio` of what was foretold.
pub(super) fn next_control(search: Search, now: f64, ratio: f64, length: f64) -> f64 {
    // Not a number where the motion ran away.
    let ratio = if ratio.is_nan() { -1.0 } else { ratio };
    match search {
        Search::LevenbergMarquardt if ratio > 0.75 => f64::max(0.1 * now, LEAST),
        Search::LevenbergMarquardt if ratio > 0.25 => now,
        Search::LevenbergMarquardt if ratio > 0.0 => 4.0 * now,
        Search::LevenbergMarquardt => 10.0 * now,
        Search::TrustRegion if ratio < 0.25 && length > 0.0 => f64::min(0.25 * length, 0.5 * now),
        Search::TrustRegion if ratio < 0.25 => 0.5 * now,
        Search::TrustRegion if ratio > 0.75 => 2.0 * now,
        Search::TrustRegion => now,
    }
}

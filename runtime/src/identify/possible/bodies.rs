//! Pseudo-inertias of nominal bodies.

use faer::Mat;

use crate::link::Inertial;

/// Spread of a body that nobody said along each axis, m.
const UNKNOWN_SPREAD: f64 = 0.1;

/// Principal second moments of a nominal body below this share of the largest are this share: a rod has an inside too.
const THINNEST: f64 = 1e-3;

pub(super) fn pseudo_inertia(inertial: &Inertial) -> Mat<f64> {
    let matrix = inertial.pseudo_inertia();
    Mat::from_fn(4, 4, |i, j| matrix[(i, j)])
}

/// What a link has whose spec says no body, about its frame's origin.
pub(super) fn unknown_body(mass: f64) -> Mat<f64> {
    Mat::from_fn(4, 4, |i, j| match (i == j, i) {
        (true, 3) => mass,
        (true, _) => mass * UNKNOWN_SPREAD * UNKNOWN_SPREAD,
        (false, _) => 0.0,
    })
}

/// The nearest body that has an inside, with the same mass and center of mass: CAD values may be those of a rod or a plate. `None` for
/// a point, and where there is no mass.
pub(super) fn thick(nominal: &Inertial) -> Option<Mat<f64>> {
    let eigen = nominal
        .second_moments()
        .filter(|_| nominal.mass > 0.0)?
        .symmetric_eigen();
    let largest = eigen.eigenvalues.max();
    if largest.is_nan() || largest <= 0.0 {
        return None;
    }
    let mut clipped = eigen;
    clipped
        .eigenvalues
        .apply(|value| *value = value.max(THINNEST * largest));
    let about_com = clipped.recompose();
    let first = nominal.first_moments;
    Some(Mat::from_fn(4, 4, |i, j| match (i, j) {
        (3, 3) => nominal.mass,
        (3, k) | (k, 3) => first[k],
        (i, j) => about_com[(i, j)] + first[i] * first[j] / nominal.mass,
    }))
}

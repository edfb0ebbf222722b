//! Which columns are looked at first.

use std::collections::BTreeMap;

use robot_model_spec::parameter::{InertialElement, Owner, StandardParameter};

use crate::sample::Sample;

/// The order in which columns are offered: link by link inertia, first moments, mass; then the effects'. A faint column of a
/// link comes behind its strong ones: were it kept, these would regroup into it with coefficients that leave no digits.
pub fn of_choice(parameters: &[StandardParameter], sample: &Sample) -> Vec<usize> {
    use InertialElement::{M, Mx, My, Mz};
    /// Of the largest of the same link and unit: an angle that is nearly none, or its square, up to that of a few degrees.
    const FAINT: f64 = 0.02;
    let place = |k: usize| match parameters[k].owner {
        Owner::Link { link, element: M } => (link, 2),
        Owner::Link {
            link,
            element: Mx | My | Mz,
        } => (link, 1),
        Owner::Link { link, .. } => (link, 0),
        Owner::Monomial(_) => (0, 0),
        Owner::Effect { .. } => (usize::MAX, 0),
    };
    let scale = |k: usize| {
        sample.columns[k]
            .as_ref()
            .map_or(0.0, |column| column.scale)
    };
    let mut largest: BTreeMap<(usize, u8), f64> = BTreeMap::new();
    for k in 0..parameters.len() {
        let largest = largest.entry(place(k)).or_default();
        *largest = largest.max(scale(k));
    }
    let is_faint = |k: usize| {
        matches!(parameters[k].owner, Owner::Link { .. }) && scale(k) < FAINT * largest[&place(k)]
    };
    let mut order: Vec<usize> = (0..parameters.len()).collect();
    order.sort_by_key(|&k| (place(k), is_faint(k)));
    order
}

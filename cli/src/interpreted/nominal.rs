//! What CAD says of base parameters.

use robot_model::columns::Nominal;
use robot_model_codegen::Compiled;
use robot_model_spec::parameter::{InertialElement, Status};

/// One entry an unknown: the sum of its nominal standard parameters, where all have a value.
pub(super) fn nominal(compiled: &Compiled) -> Vec<Option<Nominal>> {
    let standard: Vec<Option<f64>> = compiled
        .standard
        .iter()
        .map(|parameter| match parameter.status {
            Status::Nominal(value) => Some(value),
            Status::Unknown | Status::Fixed(_) => None,
        })
        .collect();
    let sizes = sizes(compiled, &standard);
    let of = |combination: &Vec<(usize, f64)>| -> Option<Nominal> {
        let terms = combination.iter();
        let value = terms
            .map(|&(k, share)| Some(share * standard[k]?))
            .sum::<Option<f64>>()?;
        let squares = combination
            .iter()
            .map(|&(k, share)| (share * sizes[k]).powi(2));
        let size = squares.sum::<f64>().sqrt();
        (size > 0.0).then_some(Nominal { value, size })
    };
    compiled.base.combinations.iter().map(of).collect()
}

/// How large each standard parameter is: of a link with mass `m` and half trace `t` of its inertia about the frame's origin, `m` for the
/// mass, `sqrt(m t)` for first moments, `t` for inertias; of anything else its own size.
fn sizes(compiled: &Compiled, standard: &[Option<f64>]) -> Vec<f64> {
    let mut sizes: Vec<f64> = standard
        .iter()
        .map(|value| value.unwrap_or(0.0).abs())
        .collect();
    let links = compiled.model.chain().map_or(0, |chain| chain.links.len());
    let count = InertialElement::ALL.len();
    for link in sizes.chunks_mut(count).take(links) {
        let [mass, _, _, _, ixx, _, _, iyy, _, izz] = link else {
            continue;
        };
        let (mass, half_trace) = (*mass, 0.5 * (*ixx + *iyy + *izz));
        let moment = (mass * half_trace).sqrt();
        link[1..4].fill(moment);
        link[4..].fill(half_trace);
    }
    sizes
}

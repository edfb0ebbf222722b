//! Names of base parameters: the one place where they are made, and no two are the same.

use std::collections::BTreeSet;

use robot_model_spec::model::Model;
use robot_model_spec::parameter::StandardParameter;

/// The kept parameter's name where nothing is regrouped into it, else that with `r` behind it; with as many `r` as it takes
/// where something else has that name.
pub(super) fn base_names(
    model: &Model,
    parameters: &[StandardParameter],
    kept: &[usize],
    combinations: &[Vec<(usize, f64)>],
) -> Vec<String> {
    let mut taken: BTreeSet<String> = parameters.iter().map(|p| p.name.clone()).collect();
    for (index, effect) in model.effects.iter().enumerate() {
        let prefix = model.effect_name(index);
        let shapes = effect.definition.shapes.iter();
        taken.extend(shapes.map(|shape| format!("{prefix}.{}", shape.name)));
    }
    let factors: BTreeSet<String> = match model.energies() {
        Some(energies) => energies.parameters.iter().map(|p| p.name.clone()).collect(),
        None => BTreeSet::new(),
    };
    // `m*c1r` would be read as a product where there is a parameter `c1r`.
    let last_factor = |name: &str| name.rsplit('*').next().unwrap_or_default().to_owned();
    kept.iter()
        .zip(combinations)
        .map(|(&k, combination)| {
            let mut name = parameters[k].name.clone();
            if *combination == [(k, 1.0)] {
                return name;
            }
            while taken.contains(&name) || factors.contains(&last_factor(&name)) {
                name.push('r');
            }
            taken.insert(name.clone());
            name
        })
        .collect()
}

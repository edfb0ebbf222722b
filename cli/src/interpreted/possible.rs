//! The arms that can be, of a compiled chain.

use robot_model::identify::{PossibleArms, PossibleLink};
use robot_model_codegen::Compiled;
use robot_model_spec::model::Inertial;
use robot_model_spec::parameter::{InertialElement, Owner, Status};

/// `None` for a robot that says its energies.
pub(crate) fn possible_arms(compiled: &Compiled) -> Option<PossibleArms> {
    let (model, standard) = (&compiled.model, &compiled.standard);
    let chain = model.chain()?;
    let count = InertialElement::ALL.len();
    let links = chain.links.iter().enumerate();
    let links = links.filter_map(|(k, link)| {
        let nominal = match link.inertial {
            Inertial::Unknown => None,
            Inertial::Nominal(nominal) => Some(nominal),
            Inertial::Fixed(_) => return None,
        };
        Some(PossibleLink {
            name: link.name.clone(),
            parameters: std::array::from_fn(|element| count * k + element),
            nominal,
        })
    });
    let fixed = standard.iter().map(|parameter| match parameter.status {
        Status::Fixed(value) => Some(value),
        Status::Unknown | Status::Nominal(_) => None,
    });
    let is_nonnegative = |k: &usize| match standard[*k].owner {
        Owner::Effect { effect, parameter } => {
            model.effects[effect].definition.linear[parameter].nonnegative
        }
        Owner::Link { .. } | Owner::Monomial(_) => false,
    };
    let mut arms = PossibleArms::default();
    arms.names = standard
        .iter()
        .map(|parameter| parameter.name.clone())
        .collect();
    arms.fixed = fixed.collect();
    arms.combinations.clone_from(&compiled.base.combinations);
    arms.kept.clone_from(&compiled.base.kept);
    arms.links = links.collect();
    arms.nonnegative = (0..standard.len()).filter(is_nonnegative).collect();
    Some(arms)
}

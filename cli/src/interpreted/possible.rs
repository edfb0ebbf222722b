//! The arms that can be, of a compiled chain.

use robot_model::identify::{PossibleArms, PossibleLink};
use robot_model_codegen::Compiled;
use robot_model_spec::model::{Act, Effect, EffectExpr, EffectLeaf, Expr, Inertial};
use robot_model_spec::parameter::{InertialElement, Owner, Status};

/// Base parameters without deviations are taken to be known to a share of their size: published ones have three digits or more.
const SHARE: f64 = 1e-3;

/// Of small ones that size is a share of the largest with the same unit.
const LEAST_SHARE: f64 = 1e-3;

/// Deviations that stand for those of base parameters of which nobody says any.
pub(crate) fn share_deviations(compiled: &Compiled, beta: &[f64]) -> Vec<f64> {
    let base = &compiled.base;
    // Masses, first moments, moments of inertia: each beside those of its kind.
    let kind = |column: usize| match compiled.standard[base.kept[column]].owner {
        Owner::Link { element, .. } => Some(element.name().len()),
        Owner::Effect { .. } | Owner::Monomial(_) => None,
    };
    (0..beta.len())
        .map(|column| {
            let alike = (0..beta.len()).filter(|&other| kind(other) == kind(column));
            let largest = alike
                .map(|other| beta[other].abs())
                .fold(f64::MIN_POSITIVE, f64::max);
            SHARE * beta[column].abs().max(LEAST_SHARE * largest)
        })
        .collect()
}

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
        let places = std::array::from_fn(|element| count * k + element);
        Some(PossibleLink::new(link.name.clone(), places, nominal))
    });
    let fixed = standard.iter().map(|parameter| match parameter.status {
        Status::Fixed(value) => Some(value),
        Status::Unknown | Status::Nominal(_) => None,
    });
    // Links, and bodies of effects, are positive by being bodies.
    let is_nonnegative = |k: &usize| {
        let is_of_effect = matches!(standard[*k].owner, Owner::Effect { .. });
        let parameter = &standard[*k];
        is_of_effect && !model.is_rigid(parameter) && model.is_nonnegative(parameter)
    };
    let mut arms = PossibleArms::default();
    arms.names = standard
        .iter()
        .map(|parameter| parameter.name.clone())
        .collect();
    arms.fixed = fixed.collect();
    arms.combinations.clone_from(&compiled.base.combinations);
    arms.kept.clone_from(&compiled.base.kept);
    arms.links = links.chain(payloads(compiled)).collect();
    arms.nonnegative = (0..standard.len()).filter(is_nonnegative).collect();
    Some(arms)
}

/// Bodies that effects add to links and whose ten parameters are their own, of which the mass is not negative; an error of a link's
/// inertial is no body.
pub(crate) fn payloads(compiled: &Compiled) -> Vec<PossibleLink> {
    let effects = compiled.model.effects.iter().enumerate();
    let body = |(index, effect): (usize, &Effect)| {
        let definition = &effect.definition;
        let values = definition.acts.iter().find_map(|act| match act {
            Act::Body { inertial, .. } => Some(inertial),
            _ => None,
        })?;
        let place = |value: &EffectExpr| match value {
            Expr::Leaf(EffectLeaf::Linear(parameter)) => {
                let owner = Owner::Effect {
                    effect: index,
                    parameter: *parameter,
                };
                compiled
                    .standard
                    .iter()
                    .position(|known| known.owner == owner)
            }
            _ => None,
        };
        let places: Vec<usize> = values.iter().map(place).collect::<Option<_>>()?;
        let Expr::Leaf(EffectLeaf::Linear(mass)) = &values[0] else {
            return None;
        };
        definition.linear[*mass].nonnegative.then_some(())?;
        let name = compiled.model.effect_name(index);
        Some(PossibleLink::new(name, places.try_into().ok()?, None))
    };
    effects.filter_map(body).collect()
}

//! Parameters that the logs hardly tell, though they tell them apart.

use robot_model::identify::Estimate;
use robot_model_codegen::Compiled;
use robot_model_spec::parameter::Owner;

use crate::output::{counted, names};

/// A deviation above this share of the largest of its kind that is known leaves a parameter anywhere.
const ANYWHERE: f64 = 0.5;

/// Deviations from zero from where on a value is known.
const KNOWN: f64 = 3.0;

/// One parameter in so many may be untold in any log.
const FEW: usize = 10;

/// What parameters are compared with: first moments with first moments, a friction with those of the same law. An arm's small ones are
/// often within a deviation of zero, which is no fault of the log; only beside others does it show that a motion says nothing.
#[derive(Clone, Copy, PartialEq)]
enum Kind {
    /// By the length of the element's name: masses, first moments, moments of inertia.
    Rigid(usize),
    /// By the effect's definition and the place of the parameter in it.
    Effect(usize, usize),
}

fn kinds(compiled: &Compiled) -> Vec<Option<Kind>> {
    let effects = &compiled.model.effects;
    let kind = |&k: &usize| match compiled.standard[k].owner {
        Owner::Link { element, .. } => Some(Kind::Rigid(element.name().len())),
        Owner::Effect { effect, parameter } => {
            let name = &effects[effect].definition.name;
            let first = effects
                .iter()
                .position(|known| known.definition.name == *name);
            first.map(|first| Kind::Effect(first, parameter))
        }
        Owner::Monomial(_) => None,
    };
    compiled.base.kept.iter().map(kind).collect()
}

/// Where they are more than a few. `resting` are joints that hardly move.
pub(super) fn doubt(estimate: &Estimate, compiled: &Compiled, resting: &[&str]) -> Option<String> {
    let found: Vec<(&str, f64, f64)> = estimate
        .parameters
        .iter()
        .map(|found| (found.name.as_str(), found.value, found.std))
        .collect();
    let untold: Vec<&str> = untold(&found, &kinds(compiled))
        .into_iter()
        .filter(|name| estimate.is_separated(name))
        .collect();
    if untold.is_empty() || FEW * untold.len() < estimate.parameters.len() {
        return None;
    }
    let who = match resting {
        [] => String::new(),
        [one] => format!("; joint `{one}` hardly moves in them"),
        all => format!("; joints {} hardly move in them", names(all)),
    };
    Some(format!(
        "the logs hardly tell {} of {}, whose deviations are of the size of such parameters themselves: {}{who}; move all joints further \
         and faster, `excite` makes a motion that tells them",
        untold.len(),
        counted(estimate.parameters.len(), "parameter"),
        names(&untold)
    ))
}

/// Names, of names, values and deviations.
fn untold<'a>(found: &[(&'a str, f64, f64)], kinds: &[Option<Kind>]) -> Vec<&'a str> {
    let size = |kind: Kind| {
        let alike = found
            .iter()
            .zip(kinds)
            .filter(|(_, other)| **other == Some(kind));
        let known = alike.filter(|((_, value, std), _)| value.abs() > KNOWN * std);
        known
            .map(|((_, value, _), _)| value.abs())
            .fold(0.0, f64::max)
    };
    let untold = found.iter().zip(kinds).filter(|((_, value, std), kind)| {
        let Some(kind) = **kind else {
            return false;
        };
        let size = size(kind);
        // Effects that are not there at all are told to be zero, but beside nothing.
        let has_size = size > 0.0 || matches!(kind, Kind::Rigid(_));
        has_size && value.abs() < KNOWN * std && *std > ANYWHERE * size
    });
    untold.map(|((name, ..), _)| *name).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn small_parameters_are_told_and_deviations_of_their_kind_are_not() {
        let kinds = [2, 2, 3, 3, 3].map(|length| Some(Kind::Rigid(length)));
        let told = [
            ("a.mx", 3.0, 0.01),
            // Within its deviation of zero, and known to be nothing.
            ("a.my", 0.001, 0.01),
            ("a.ixx", 1.2, 0.01),
            ("a.ixy", 0.004, 0.02),
            ("a.izz", -0.4, 0.02),
        ];
        assert!(untold(&told, &kinds).is_empty());
        let mut worse = told;
        worse[3] = ("a.ixy", 0.9, 0.8);
        assert_eq!(untold(&worse, &kinds), ["a.ixy"]);
        // Of inertias none is known.
        let none = told.map(|(name, value, std)| match name {
            "a.mx" | "a.my" => (name, value, std),
            _ => (name, value, 2.0),
        });
        assert_eq!(untold(&none, &kinds), ["a.ixx", "a.ixy", "a.izz"]);
    }

    #[test]
    fn an_effect_that_is_not_there_is_told() {
        let kinds = [Some(Kind::Effect(0, 0)); 2];
        let offsets = [
            ("a.torque_offset.offset", 0.001, 0.002),
            ("b.torque_offset.offset", -0.001, 0.002),
        ];
        assert!(untold(&offsets, &kinds).is_empty());
        let friction = [
            ("a.viscous_friction.fv", 6.0, 0.1),
            ("b.viscous_friction.fv", -58.0, 146.0),
        ];
        assert_eq!(untold(&friction, &kinds), ["b.viscous_friction.fv"]);
    }
}

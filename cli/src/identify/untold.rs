//! Parameters that the logs hardly tell, though they tell them apart: for want of motion, or because the model does not fit.

use robot_model::identify::Estimate;
use robot_model_codegen::Compiled;
use robot_model_spec::parameter::Owner;

use super::doubts::left;
use crate::output::{counted, names};

/// A deviation above this share of the largest of its kind that is known leaves a parameter anywhere.
const ANYWHERE: f64 = 0.5;

/// Deviations from zero from where on a value is known.
const KNOWN: f64 = 3.0;

/// One parameter in so many may be untold in any log.
const FEW: usize = 10;

/// What is left of a joint's torque, percent: where a model fits, and from where on it does not.
const FITS: f64 = 2.0;
const MISFIT: f64 = 10.0;

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

/// Joints in whose torque a parameter shows: that of an effect, and those that carry a link.
fn joints_of(compiled: &Compiled, unknown: usize) -> std::ops::Range<usize> {
    let joints = &compiled.model.joints;
    let standard = &compiled.standard[compiled.base.kept[unknown]];
    match standard.owner {
        Owner::Link { link, .. } => 0..(link + 1).min(joints.len()),
        Owner::Effect { .. } => {
            let owner = standard.name.split('.').next();
            let own = joints
                .iter()
                .position(|joint| Some(joint.name.as_str()) == owner);
            own.map_or(0..joints.len(), |own| own..own + 1)
        }
        Owner::Monomial(_) => 0..joints.len(),
    }
}

/// Where they are more than a few. `resting` are joints that hardly move.
pub(super) fn doubts(estimate: &Estimate, compiled: &Compiled, resting: &[&str]) -> Vec<String> {
    let percents = left(estimate);
    let most = |unknown: usize| {
        let joints = joints_of(compiled, unknown);
        let percents = percents[joints].iter();
        percents.fold(0.0, |most: f64, percent| most.max(*percent))
    };
    let parameters = estimate.parameters.iter().enumerate();
    let (found, fitting): (Vec<_>, Vec<_>) = parameters
        .map(|(k, found)| {
            let percent = most(k);
            let share = if percent > MISFIT {
                FITS / percent
            } else {
                1.0
            };
            let (name, value, std) = (found.name.as_str(), found.value, found.std);
            ((name, value, std), (name, value, share * std))
        })
        .unzip();
    let kinds = kinds(compiled);
    let mut all = untold(&found, &kinds);
    all.retain(|name| estimate.is_separated(name));
    if all.is_empty() || FEW * all.len() < estimate.parameters.len() {
        return Vec::new();
    }
    // Of errors as where a model fits, deviations would be less in proportion.
    let fitting = untold(&fitting, &kinds);
    let (moved, misfit): (Vec<&str>, Vec<&str>) =
        all.iter().partition(|name| fitting.contains(name));
    let hardly = |names_of: &[&str]| {
        format!(
            "the logs hardly determine {} of {}, whose standard deviations are as large as typical values: {}",
            names_of.len(),
            counted(estimate.parameters.len(), "parameter"),
            names(names_of)
        )
    };
    let by_misfit = (!misfit.is_empty()).then(|| {
        let unknowns = (0..found.len()).filter(|k| misfit.contains(&found[*k].0));
        let shown: Vec<usize> = unknowns.flat_map(|k| joints_of(compiled, k)).collect();
        let joints = estimate.joints.iter().zip(percents).enumerate();
        let ill = joints.filter(|(k, (_, percent))| **percent > MISFIT && shown.contains(k));
        let ill = ill.map(|(_, (joint, percent))| format!("`{joint}` {percent:.0} %"));
        format!(
            "{}; the motion would determine them with a residual of {FITS:.0} % of the torque, but the model does not fit: {}; first follow \
             the other notes, check signs, order, units and time of the columns, and run `trace`",
            hardly(&misfit),
            ill.collect::<Vec<_>>().join(", ")
        )
    });
    let by_motion = (!moved.is_empty()).then(|| {
        let who = match resting {
            [] => String::new(),
            [one] => format!("; joint `{one}` hardly moves in them"),
            all => format!("; joints {} hardly move in them", names(all)),
        };
        format!(
            "{}{who}; move all joints further and faster: `excite` designs a motion that determines them",
            hardly(&moved)
        )
    });
    by_misfit.into_iter().chain(by_motion).collect()
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

//! Effects as `excite --separate` takes them.

use robot_model::columns::Arm;
use robot_model::trace::{Alternative, Finding};
use robot_model_spec::model::EffectLeaf;

use super::super::report::effect;
use crate::close_the_loop::Loop;

/// Whether an effect has internal states.
pub(super) fn has_memory(closed: &Loop, effect: &str) -> bool {
    let mut definitions = closed.before.arm.compiled().model.definitions.iter();
    definitions.any(|one| one.name == effect && !one.states.is_empty())
}

/// What is told and what may be instead; none where an effect follows from more than the motion, or is no torque that is added.
pub(super) fn rivals(
    closed: &Loop,
    finding: &Finding,
    place: usize,
    rival: &Alternative,
) -> Option<[String; 2]> {
    let (own, other) = (
        of_motion(closed, &finding.effect)?,
        of_motion(closed, &rival.effect)?,
    );
    let values = effect(finding, closed, place).parameters;
    let found = |names: &[String]| -> Vec<(&str, f64)> {
        let found = names
            .iter()
            .filter_map(|name| values.iter().find(|value| value.name == name));
        found.map(|value| (value.name, value.value)).collect()
    };
    let linear = found(&own.linear).into_iter();
    let linear: Vec<String> = linear.map(|(name, value)| sized(name, value)).collect();
    Some([
        format!(
            "{}{} on {}: {}",
            own.name,
            in_brackets(found(&own.shapes).into_iter()),
            joints(closed, &finding.joints),
            linear.join(", ")
        ),
        format!(
            "{}{} on {}",
            other.name,
            shapes_of(closed, rival, &other.shapes),
            joints(closed, &rival.joints)
        ),
    ])
}

/// The shapes with which an alternative was tried last: `(vs = 1.000e-1)`.
fn shapes_of(closed: &Loop, rival: &Alternative, names: &[String]) -> String {
    let mut tried = closed.verdict.tried.iter().rev();
    let passed = tried.find(|tried| {
        tried.refusals.is_empty()
            && (&tried.effect, &tried.joints) == (&rival.effect, &rival.joints)
    });
    let values = passed.into_iter().flat_map(|tried| &tried.shapes);
    in_brackets(names.iter().map(String::as_str).zip(values.copied()))
}

/// Shapes as a spec has them; nothing of none.
fn in_brackets<'a>(shapes: impl Iterator<Item = (&'a str, f64)>) -> String {
    let shapes: Vec<String> = shapes.map(|(name, value)| sized(name, value)).collect();
    if shapes.is_empty() {
        String::new()
    } else {
        format!("({})", shapes.join(", "))
    }
}

fn sized(name: &str, value: f64) -> String {
    format!("{name} = {value:.3e}")
}

struct OfMotion {
    name: String,
    linear: Vec<String>,
    shapes: Vec<String>,
}

/// An effect of the library or of the spec whose torque is one of the motion.
fn of_motion(closed: &Loop, effect: &str) -> Option<OfMotion> {
    let definitions = &closed.before.arm.compiled().model.definitions;
    let effect = definitions.iter().find(|one| one.name == effect)?;
    let is_more = |leaf: &EffectLeaf| matches!(leaf, EffectLeaf::Time | EffectLeaf::Input(_));
    let rates = effect
        .states
        .iter()
        .map(|state| &effect.bindings[state.rate].value);
    let mut equations = effect.equations().chain(rates);
    let is_of_motion = !equations.any(|value| effect.reads(value, &is_more));
    (is_of_motion && effect.acts.is_empty() && !effect.torques.is_empty()).then(|| OfMotion {
        name: effect.name.clone(),
        linear: effect.linear.iter().map(|p| p.name.clone()).collect(),
        shapes: effect.shapes.iter().map(|p| p.name.clone()).collect(),
    })
}

fn joints(closed: &Loop, joints: &[usize]) -> String {
    let names = closed.before.arm.joints();
    let joints: Vec<&str> = joints.iter().map(|&joint| names[joint].as_str()).collect();
    match joints.as_slice() {
        [joint] => (*joint).to_owned(),
        several => format!("({})", several.join(", ")),
    }
}

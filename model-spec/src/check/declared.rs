//! `effects { .. }`: which effects act on which joints.

mod shapes;
mod targets;

use std::sync::Arc;

use proc_macro2::Span;
use syn::Ident;

use super::energies::says_energies;
use super::setting::meant;
use super::{Definitions, Errors};
use crate::ast::{DeclaredEffect, Robot};
use crate::diagnostic::Diagnostic;
use crate::model::{Act, Effect, EffectDefinition};
use crate::suggest;
use shapes::{check_shapes, check_units};
use targets::check_targets;

/// Every instance, in the order of the spec; `joints` are the names of the joints or coordinates.
pub(super) fn check_effects(
    robot: &Robot,
    joints: &[&Ident],
    definitions: &Definitions,
    errors: &mut Errors,
) -> Vec<Effect> {
    if let [first, second, ..] = robot.effects.as_slice() {
        errors.push(
            Diagnostic::new(
                second.keyword,
                "the robot has two `effects` blocks",
                "second",
            )
            .also(first.keyword, "first")
            .help("write all effects into one block"),
        );
    }
    let mut instances: Vec<(Effect, Span)> = Vec::new();
    for declared in robot.effects.iter().flat_map(|effects| &effects.declared) {
        let Some(definition) = check_known(declared, definitions, errors) else {
            continue;
        };
        check_has_links(robot, declared, definition, errors);
        check_own_name(robot, declared, definition, errors);
        let before = errors.len();
        let shapes = check_shapes(declared, definition, errors);
        if errors.len() == before {
            check_given(declared, definition, &shapes, errors);
        }
        let targets = check_targets(joints, declared, definition, errors);
        check_units(robot, declared, definition, &targets, errors);
        for (joints, span) in targets {
            let effect = Effect {
                definition: Arc::clone(definition),
                instance: 1 + instances
                    .iter()
                    .filter(|(other, _)| shares_name(other, definition, &joints))
                    .count(),
                joints,
                shapes: shapes.clone(),
                line: declared.name.span().start().line,
            };
            check_repeated(&effect, span, &instances, errors);
            instances.push((effect, span));
        }
    }
    instances.into_iter().map(|(effect, _)| effect).collect()
}

/// Parameter names carry the first joint and the effect; instances keep those of one pair apart.
fn shares_name(other: &Effect, definition: &EffectDefinition, joints: &[usize]) -> bool {
    other.definition.name == definition.name && other.joints.first() == joints.first()
}

fn check_known<'a>(
    declared: &DeclaredEffect,
    definitions: &'a Definitions,
    errors: &mut Errors,
) -> Option<&'a Arc<EffectDefinition>> {
    let name = declared.name.to_string();
    let found = definitions
        .sound
        .iter()
        .find(|definition| definition.name == name);
    // What is wrong with a faulty definition is said there.
    if found.is_none() && !definitions.faulty.contains(&name) {
        let known = definitions
            .sound
            .iter()
            .map(|definition| definition.name.as_str())
            .chain(definitions.faulty.iter().map(String::as_str));
        errors.push(
            Diagnostic::new(
                declared.name.span(),
                format!("unknown effect `{name}`"),
                "not defined",
            )
            .help(format!(
                "{}, or define `effect {name}(j) {{ .. }}` beside the robot",
                suggest::help(&name, known)
            )),
        );
    }
    found
}

/// A torque that is made of the measured one explains it whole at some shapes: a search would end there.
fn check_given(
    declared: &DeclaredEffect,
    definition: &EffectDefinition,
    shapes: &[Option<f64>],
    errors: &mut Errors,
) {
    let names: Vec<&str> = definition
        .shapes
        .iter()
        .map(|own| own.name.as_str())
        .collect();
    let meant = meant(&declared.shapes, &names);
    let mut open = definition.shapes.iter().zip(shapes);
    let is_open = |name: &str| !meant.contains(&name);
    let Some((shape, _)) = open.find(|(own, value)| value.is_none() && is_open(&own.name)) else {
        return;
    };
    if !definition.reads_measured_torque() {
        return;
    }
    let name = &declared.name;
    errors.push(
        Diagnostic::new(
            name.span(),
            format!("`{}` of effect `{name}` has no value", shape.name),
            "reads the measured torque",
        )
        .help(format!(
            "write a known value, `{name}({} = ..)`: if it were free, the measured torque would explain itself",
            shape.name
        )),
    );
}

/// Parameters of an effect on the arm as a whole are `EFFECT.PARAMETER`, those of a link `LINK.PARAMETER`.
fn check_own_name(
    robot: &Robot,
    declared: &DeclaredEffect,
    definition: &EffectDefinition,
    errors: &mut Errors,
) {
    let joints = robot.joints.iter().map(|joint| &joint.name);
    let mut names = joints.chain(robot.links.iter().map(|link| &link.name));
    if !definition.joints.is_empty() || names.all(|name| *name != declared.name) {
        return;
    }
    let name = &declared.name;
    let title = format!("effect `{name}` on the arm has the name of a joint or link");
    errors.push(
        Diagnostic::new(name.span(), title, "two parameters could be called alike")
            .help("give the effect another name"),
    );
}

/// Bodies are fixed to links, and the tilt of a base is that of gravity: robots that say their energies have neither.
fn check_has_links(
    robot: &Robot,
    declared: &DeclaredEffect,
    definition: &EffectDefinition,
    errors: &mut Errors,
) {
    let of_links =
        |act: &Act| matches!(act, Act::Force { .. } | Act::Body { .. } | Act::Tilt { .. });
    if !says_energies(robot) || !definition.acts.iter().any(of_links) {
        return;
    }
    let name = &declared.name;
    let title =
        format!("effect `{name}` needs links or gravity, but the robot is defined by its energies");
    errors.push(
        Diagnostic::new(name.span(), title, "for chains only")
            .help("add it to `kinetic` and `potential`, with its own parameters"),
    );
}

/// The same effect on the same joints twice is two equal columns, unless shape parameters tell them apart.
fn check_repeated(effect: &Effect, span: Span, instances: &[(Effect, Span)], errors: &mut Errors) {
    let same = |other: &Effect| {
        let equal_shapes =
            effect.shapes == other.shapes && effect.shapes.iter().all(Option::is_some);
        other.definition.name == effect.definition.name
            && other.joints == effect.joints
            && equal_shapes
    };
    let Some((_, first)) = instances.iter().find(|(other, _)| same(other)) else {
        return;
    };
    let name = &effect.definition.name;
    let help = if effect.shapes.is_empty() {
        "delete one of them: least squares cannot tell two equal effects apart"
    } else {
        "give them different shape parameters, or delete one"
    };
    errors.push(
        Diagnostic::new(
            span,
            format!("effect `{name}` is declared twice on the same joints"),
            "second",
        )
        .also(*first, "first")
        .help(help),
    );
}

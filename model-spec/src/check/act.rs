//! What effects change beside torques: positions, bodies, the base, the time of the torque.

use std::collections::BTreeSet;

use syn::Ident;

use super::Errors;
use super::definition::find_joint;
use super::linear::Degrees;
use super::resolve::Scope;
use crate::ast::{self, ActKind, Effect};
use crate::diagnostic::Diagnostic;
use crate::model::{Act, EffectDefinition, EffectExpr, EffectLeaf};
use crate::parameter::InertialElement;

/// Every act, each at most once for a joint, or for the arm.
pub(super) fn check_acts(
    effect: &Effect,
    scope: &Scope,
    degrees: &Degrees,
    errors: &mut Errors,
) -> Vec<Act> {
    check_once(effect, errors);
    let acts = effect.acts.iter();
    acts.filter_map(|act| check_act(act, &effect.joints, scope, degrees, errors))
        .collect()
}

fn check_once(effect: &Effect, errors: &mut Errors) {
    let mut seen: Vec<&ast::Act> = Vec::new();
    for act in &effect.acts {
        let same = |other: &&&ast::Act| other.kind == act.kind && other.of == act.of;
        if let Some(first) = seen.iter().find(same) {
            let title = format!("`{}` is defined twice", left_hand_side(act));
            errors.push(
                Diagnostic::new(act.keyword.span(), title, "second")
                    .also(first.keyword.span(), "first")
                    .help("write one with the sum of both"),
            );
        }
        seen.push(act);
    }
}

/// `position(j)`, `tilt`
fn left_hand_side(act: &ast::Act) -> String {
    match &act.of {
        Some(joint) => format!("{}({joint})", act.keyword),
        None => act.keyword.to_string(),
    }
}

fn check_act(
    act: &ast::Act,
    joints: &[Ident],
    scope: &Scope,
    degrees: &Degrees,
    errors: &mut Errors,
) -> Option<Act> {
    let joint = match &act.of {
        Some(of) => find_joint(joints, of, errors),
        None => Some(0),
    };
    let fits = check_count(act, errors);
    for value in &act.values {
        if let ActKind::Body | ActKind::Force = act.kind {
            degrees.check_entry(value, &left_hand_side(act), errors);
        } else if !degrees.is_free(value) {
            let title = format!("`{}` depends on a linear parameter", left_hand_side(act));
            errors.push(
                Diagnostic::new(value.span, title, "the torque is not linear in it")
                    .help("make it a shape parameter: `shape name in low .. high;`"),
            );
        }
    }
    let values: Vec<Option<EffectExpr>> = act
        .values
        .iter()
        .map(|value| scope.resolve(value, errors))
        .collect();
    let mut values: Vec<EffectExpr> = values.into_iter().collect::<Option<_>>()?;
    let joint = joint?;
    fits.then_some(())?;
    Some(match act.kind {
        ActKind::Position => Act::Position {
            joint,
            value: values.pop()?,
        },
        ActKind::Force => Act::Force {
            joint,
            components: values,
        },
        ActKind::Body => Act::Body {
            joint,
            inertial: values,
        },
        ActKind::Tilt => Act::Tilt { angles: values },
        ActKind::Delay => Act::Delay {
            seconds: values.pop()?,
        },
    })
}

fn check_count(act: &ast::Act, errors: &mut Errors) -> bool {
    let (count, list) = match act.kind {
        ActKind::Position | ActKind::Delay => (1, "..".to_owned()),
        ActKind::Tilt => (2, "[a, b]".to_owned()),
        ActKind::Force => (3, "[x, y, z]".to_owned()),
        ActKind::Body => {
            let names: Vec<&str> = InertialElement::ALL.map(InertialElement::name).to_vec();
            (names.len(), format!("[{}]", names.join(", ")))
        }
    };
    let found = act.values.len();
    if found != count {
        let values = if count == 1 { "value" } else { "values" };
        let left = left_hand_side(act);
        errors.push(
            Diagnostic::new(
                act.keyword.span(),
                format!("`{left}` takes {count} {values}, found {found}"),
                "",
            )
            .help(format!("write `{left} = {list};`")),
        );
    }
    found == count
}

/// A body, a tilt and a delay stay what they are along a motion.
pub(super) fn check_constant(effect: &Effect, definition: &EffectDefinition, errors: &mut Errors) {
    for (act, checked) in effect.acts.iter().zip(&definition.acts) {
        if let ActKind::Position | ActKind::Force = act.kind {
            continue;
        }
        for (written, value) in act.values.iter().zip(checked.values()) {
            if !definition.is_constant(value) {
                let title = format!("`{}` changes along a motion", left_hand_side(act));
                errors.push(
                    Diagnostic::new(written.span, title, "not constant")
                        .help("write it with parameters and numbers only"),
                );
            }
        }
    }
}

/// A linear parameter is one of torques, whose columns are filtered as effects are, or one of bodies, whose columns are the
/// rigid body's.
pub(super) fn check_one_use(effect: &Effect, definition: &EffectDefinition, errors: &mut Errors) {
    let in_torques: BTreeSet<usize> = (0..definition.linear.len())
        .filter(|&k| {
            let is_it = |leaf: &EffectLeaf| *leaf == EffectLeaf::Linear(k);
            let mut torques = definition.torque_equations();
            torques.any(|value| definition.reads(value, &is_it))
        })
        .collect();
    for (k, linear) in effect.linear.iter().enumerate() {
        if in_torques.contains(&k) && definition.is_of_body(k) {
            let name = &linear.name;
            errors.push(
                Diagnostic::new(
                    name.span(),
                    format!("linear parameter `{name}` is in a torque and in a body"),
                    "one parameter",
                )
                .help("give the torque a parameter of its own"),
            );
        }
    }
}

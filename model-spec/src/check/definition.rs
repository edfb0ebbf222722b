//! Effect definitions: names, ranges, equations.

use syn::Ident;

use super::linear::check_linear;
use super::resolve::{Scope, is_reserved};
use super::{Errors, check_unique, value};
use crate::ast::{self, Effect};
use crate::diagnostic::Diagnostic;
use crate::model::{
    EffectDefinition, EffectLeaf, EffectTorque, Expr, LinearParameter, ShapeParameter,
};
use crate::suggest;

/// One definition; `None` behind an error.
pub(crate) fn check_definition(effect: &Effect, errors: &mut Errors) -> Option<EffectDefinition> {
    let before = errors.len();
    check_names(effect, errors);
    check_effect_name(&effect.name, errors);
    if effect.joints.is_empty() {
        errors.push(
            Diagnostic::new(
                effect.name.span(),
                format!("effect `{}` acts on no joint", effect.name),
                "",
            )
            .help(format!("write `effect {}(j) {{ .. }}`", effect.name)),
        );
    }
    let scope = Scope {
        joints: effect.joints.iter().map(Ident::to_string).collect(),
        linear: effect
            .linear
            .iter()
            .map(|linear| linear.name.to_string())
            .collect(),
        shapes: effect
            .shapes
            .iter()
            .map(|shape| shape.name.to_string())
            .collect(),
    };
    let shapes: Vec<ShapeParameter> = effect
        .shapes
        .iter()
        .filter_map(|shape| check_shape(shape, errors))
        .collect();
    let torques: Vec<EffectTorque> = effect
        .torques
        .iter()
        .filter_map(|torque| check_torque(torque, &scope, errors))
        .collect();
    check_torques(effect, errors);
    if errors.len() == before {
        check_used(effect, &torques, errors);
    }
    (errors.len() == before).then(|| EffectDefinition {
        name: effect.name.to_string(),
        doc: effect.doc.clone(),
        joints: scope.joints,
        linear: effect
            .linear
            .iter()
            .map(|linear| LinearParameter {
                name: linear.name.to_string(),
                doc: linear.doc.clone(),
                nonnegative: linear.nonnegative,
            })
            .collect(),
        shapes,
        torques,
    })
}

/// Joints, linear and shape parameters share one scope.
fn check_names(effect: &Effect, errors: &mut Errors) {
    let names = || {
        let linear = effect.linear.iter().map(|linear| &linear.name);
        effect
            .joints
            .iter()
            .chain(linear)
            .chain(effect.shapes.iter().map(|shape| &shape.name))
    };
    check_unique(names(), "name", errors);
    for name in names().filter(|name| is_reserved(&name.to_string())) {
        errors.push(
            Diagnostic::new(
                name.span(),
                format!("`{name}` has a meaning in the language"),
                "reserved",
            )
            .help("choose another name"),
        );
    }
}

/// `stribeck2` is how the second `stribeck` of a joint is called in parameter names.
fn check_effect_name(name: &Ident, errors: &mut Errors) {
    let text = name.to_string();
    let snake = text
        .chars()
        .all(|c| c.is_ascii_lowercase() || c.is_ascii_digit() || c == '_');
    if snake && !text.ends_with(|c: char| c.is_ascii_digit()) {
        return;
    }
    errors.push(
        Diagnostic::new(name.span(), format!("`{text}` is not a name for an effect"), "")
            .help("write it in snake case and without a digit at its end: the second `stribeck` of a joint is its `stribeck2`"),
    );
}

fn check_shape(shape: &ast::Shape, errors: &mut Errors) -> Option<ShapeParameter> {
    let mut number = |expr| {
        value::constant(expr)
            .map(|q| q.value)
            .map_err(|error| errors.push(error))
            .ok()
    };
    let (low, high) = (number(&shape.low)?, number(&shape.high)?);
    let step = match &shape.step {
        Some(step) => Some((number(step)?, step.span)),
        None => None,
    };
    if let Err(error) = value::check_order(&shape.low, &shape.high, (low, high)) {
        errors.push(error);
        return None;
    }
    match step {
        Some((step, span)) if !(step > 0.0 && step <= high - low && (high - low) / step <= 1e4) => {
            errors.push(
                Diagnostic::new(
                    span,
                    "the step does not fit its range",
                    format!("range {}", high - low),
                )
                .help("write a positive step, and 10000 steps at most"),
            );
            return None;
        }
        None if low <= 0.0 => {
            errors.push(
                Diagnostic::new(
                    shape.low.span,
                    "a range without a step is searched logarithmically",
                    "not positive",
                )
                .help(format!(
                    "write a positive lower end, or a step: `shape {} in {low} .. {high} step ..;`",
                    shape.name
                )),
            );
            return None;
        }
        _ => {}
    }
    Some(ShapeParameter {
        name: shape.name.to_string(),
        doc: shape.doc.clone(),
        low,
        high,
        step: step.map(|s| s.0),
    })
}

fn check_torque(torque: &ast::Torque, scope: &Scope, errors: &mut Errors) -> Option<EffectTorque> {
    let name = torque.joint.to_string();
    let joint = scope.joints.iter().position(|joint| *joint == name);
    if joint.is_none() {
        errors.push(
            Diagnostic::new(
                torque.joint.span(),
                format!("the effect has no joint `{name}`"),
                "unknown joint",
            )
            .help(suggest::help(
                &name,
                scope.joints.iter().map(String::as_str),
            )),
        );
    }
    let value = scope.resolve(&torque.value, errors)?;
    check_linear(
        &torque.value,
        &|name| scope.linear.iter().any(|linear| linear == name),
        errors,
    );
    Some(EffectTorque {
        joint: joint?,
        value,
    })
}

/// At least one equation, and one per joint at most.
fn check_torques(effect: &Effect, errors: &mut Errors) {
    check_unique(
        effect.torques.iter().map(|torque| &torque.joint),
        "torque of joint",
        errors,
    );
    if effect.torques.is_empty() {
        let joint = effect
            .joints
            .first()
            .map_or_else(|| "j".to_owned(), Ident::to_string);
        errors.push(
            Diagnostic::new(
                effect.name.span(),
                format!("effect `{}` has no equation", effect.name),
                "",
            )
            .help(format!("write `torque({joint}) = ..;`")),
        );
    }
}

/// What is declared is used: a column of zeros or a free parameter that changes nothing cannot be identified.
fn check_used(effect: &Effect, torques: &[EffectTorque], errors: &mut Errors) {
    let uses = |wanted: &dyn Fn(&EffectLeaf) -> bool| {
        let wanted = |part: &Expr<EffectLeaf>| matches!(part, Expr::Leaf(leaf) if wanted(leaf));
        torques.iter().any(|torque| torque.value.contains(&wanted))
    };
    let mut unused = |name: &Ident, what: &str| {
        errors.push(
            Diagnostic::new(
                name.span(),
                format!("{what} `{name}` is not used"),
                "in no equation",
            )
            .help("use it in a torque, or delete it"),
        );
    };
    for (k, linear) in effect.linear.iter().enumerate() {
        if !uses(&|leaf| *leaf == EffectLeaf::Linear(k)) {
            unused(&linear.name, "linear parameter");
        }
    }
    for (k, shape) in effect.shapes.iter().enumerate() {
        if !uses(&|leaf| *leaf == EffectLeaf::Shape(k)) {
            unused(&shape.name, "shape parameter");
        }
    }
    for (k, joint) in effect.joints.iter().enumerate() {
        let acts = torques.iter().any(|torque| torque.joint == k);
        if !acts && !uses(&|leaf| matches!(leaf, EffectLeaf::Signal(_, joint) if *joint == k)) {
            unused(joint, "joint");
        }
    }
}

//! Effect definitions: names, ranges, equations.

use syn::Ident;

use super::act::{check_acts, check_constant, check_one_use};
use super::binding::{self, Part};
use super::linear::Degrees;
use super::resolve::Scope;
use super::used::check_used;
use super::words::{reserved, reserved_name};
use super::{Errors, check_unique, value};
use crate::ast::{self, Effect};
use crate::diagnostic::Diagnostic;
use crate::model::{
    EffectBinding, EffectDefinition, EffectInput, EffectState, EffectTorque, LinearParameter,
    ShapeParameter,
};
use crate::suggest;

/// One definition; `None` behind an error.
pub(crate) fn check_definition(effect: &Effect, errors: &mut Errors) -> Option<EffectDefinition> {
    let before = errors.len();
    check_names(effect, errors);
    check_effect_name(&effect.name, errors);
    if let Some(kind) = &effect.kind {
        check_effect_name(kind, errors);
    }
    let parts = binding::in_order(effect, errors);
    let scope = Scope {
        joints: effect.joints.iter().map(Ident::to_string).collect(),
        linear: names(effect.linear.iter().map(|linear| &linear.name)),
        shapes: names(effect.shapes.iter().map(|shape| &shape.name)),
        inputs: check_inputs(effect, errors),
        states: names(effect.states.iter().map(|state| &state.name)),
        bindings: parts.iter().map(Part::name).collect(),
    };
    let shapes: Vec<ShapeParameter> = effect
        .shapes
        .iter()
        .filter_map(|shape| check_shape(shape, errors))
        .collect();
    let mut degrees = Degrees::new(&effect.linear);
    let bindings: Vec<EffectBinding> = parts
        .iter()
        .filter_map(|part| check_binding(part, &scope, &mut degrees, errors))
        .collect();
    let states = check_states(effect, &parts, errors);
    let torques: Vec<EffectTorque> = effect
        .torques
        .iter()
        .filter_map(|torque| check_torque(torque, &effect.joints, &scope, &degrees, errors))
        .collect();
    check_torques(effect, errors);
    let acts = check_acts(effect, &scope, &degrees, errors);
    if errors.len() > before {
        return None;
    }
    let definition = EffectDefinition {
        name: effect.name.to_string(),
        kind: effect.kind.as_ref().unwrap_or(&effect.name).to_string(),
        doc: effect.doc.clone(),
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
        inputs: effect
            .inputs
            .iter()
            .zip(scope.inputs)
            .map(|(input, (name, joint))| EffectInput {
                name,
                doc: input.doc.clone(),
                joint,
            })
            .collect(),
        bindings,
        states,
        torques,
        acts,
        joints: scope.joints,
    };
    check_constant(effect, &definition, errors);
    check_one_use(effect, &definition, errors);
    check_used(effect, &parts, &definition, errors);
    (errors.len() == before).then_some(definition)
}

fn names<'a>(idents: impl Iterator<Item = &'a Ident>) -> Vec<String> {
    idents.map(Ident::to_string).collect()
}

/// Joints, parameters, inputs, states and bindings share one scope.
fn check_names(effect: &Effect, errors: &mut Errors) {
    let names = || {
        let linear = effect.linear.iter().map(|linear| &linear.name);
        let inputs = effect.inputs.iter().enumerate();
        // `input current(j); input current(k);` is one name for two columns.
        let inputs = inputs.filter(|(k, input)| {
            let same = |other: &&ast::Input| other.name == input.name;
            input.joint.is_none() || !effect.inputs[..*k].iter().any(|other| same(&other))
        });
        effect
            .joints
            .iter()
            .chain(linear)
            .chain(effect.shapes.iter().map(|shape| &shape.name))
            .chain(inputs.map(|(_, input)| &input.name))
            .chain(effect.states.iter().map(|state| &state.name))
            .chain(effect.lets.iter().map(|binding| &binding.name))
    };
    check_unique(names(), "name", errors);
    for name in names().filter(|name| reserved().any(|word| *name == word)) {
        errors.push(reserved_name(name, reserved()));
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

/// `(name, formal joint)` of every input.
fn check_inputs(effect: &Effect, errors: &mut Errors) -> Vec<(String, Option<usize>)> {
    let mut inputs: Vec<(String, Option<usize>)> = Vec::new();
    for input in &effect.inputs {
        let joint = match &input.joint {
            None => None,
            // In place of an unknown joint the first, so that the input stays one of a joint.
            Some(joint) => find_joint(&effect.joints, joint, errors)
                .or_else(|| (!effect.joints.is_empty()).then_some(0)),
        };
        let found = (input.name.to_string(), joint);
        if inputs.contains(&found) && joint.is_some() {
            errors.push(
                Diagnostic::new(
                    input.name.span(),
                    format!("input `{}` is declared twice", input.name),
                    "second",
                )
                .help("delete it"),
            );
        }
        inputs.push(found);
    }
    inputs
}

/// Index of a formal joint.
pub(super) fn find_joint(joints: &[Ident], name: &Ident, errors: &mut Errors) -> Option<usize> {
    let found = joints.iter().position(|joint| joint == name);
    if found.is_none() {
        let known = names(joints.iter());
        errors.push(
            Diagnostic::new(
                name.span(),
                format!("the effect has no joint `{name}`"),
                "unknown joint",
            )
            .help(suggest::help(
                &name.to_string(),
                known.iter().map(String::as_str),
            )),
        );
    }
    found
}

fn check_binding(
    part: &Part<'_>,
    scope: &Scope,
    degrees: &mut Degrees,
    errors: &mut Errors,
) -> Option<EffectBinding> {
    match part {
        Part::Let(binding) => degrees.check_let(binding, errors),
        Part::Rate(rate) => degrees.check_rate(rate, errors),
    }
    Some(EffectBinding {
        name: part.name(),
        value: scope.resolve(part.value(), errors)?,
    })
}

/// Every state with its rate.
fn check_states(effect: &Effect, parts: &[Part<'_>], errors: &mut Errors) -> Vec<EffectState> {
    let mut states = Vec::new();
    for state in &effect.states {
        let rate = parts
            .iter()
            .position(|part| matches!(part, Part::Rate(rate) if rate.of == state.name));
        match rate {
            Some(rate) => states.push(EffectState {
                name: state.name.to_string(),
                doc: state.doc.clone(),
                rate,
            }),
            None => errors.push(
                Diagnostic::new(
                    state.name.span(),
                    format!("state `{}` has no rate", state.name),
                    "how does it change?",
                )
                .help(format!("write `dot({}) = ..;`", state.name)),
            ),
        }
    }
    states
}

fn check_torque(
    torque: &ast::Equation,
    joints: &[Ident],
    scope: &Scope,
    degrees: &Degrees,
    errors: &mut Errors,
) -> Option<EffectTorque> {
    let joint = find_joint(joints, &torque.of, errors);
    let value = scope.resolve(&torque.value, errors)?;
    degrees.check_torque(&torque.value, errors);
    Some(EffectTorque {
        joint: joint?,
        value,
    })
}

/// At least one equation, and one torque per joint at most.
fn check_torques(effect: &Effect, errors: &mut Errors) {
    check_unique(
        effect.torques.iter().map(|torque| &torque.of),
        "torque of joint",
        errors,
    );
    if effect.torques.is_empty() && effect.acts.is_empty() {
        let name = &effect.name;
        let help = match effect.joints.first() {
            Some(joint) => format!("write `torque({joint}) = ..;`"),
            None => format!("write `effect {name}(j) {{ .. }}` and `torque(j) = ..;`"),
        };
        let title = format!("effect `{name}` has no equation");
        errors.push(Diagnostic::new(name.span(), title, "").help(help));
    }
}

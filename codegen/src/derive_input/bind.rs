//! Which field holds which parameter of the model.

use robot_model_spec::Model;
use robot_model_spec::model::{Chain, Inertial};
use syn::Ident;
use syn::ext::IdentExt as _;

use super::fields::{Robot, RobotField};
use super::holds::{Effects, Holds, type_name};
use super::mistake::{Errors, mistake};

/// What a field holds.
#[derive(Default)]
pub struct Held {
    /// Index of the link.
    pub link: Option<usize>,
    /// Index of the effect, one per type.
    pub effects: Vec<Option<usize>>,
    /// Index of the unknown constant.
    pub parameter: Option<usize>,
}

/// Per field what it holds; every unknown of the model is held by exactly one.
pub fn bind(robot: &Robot, model: &Model) -> syn::Result<Vec<Held>> {
    let mut errors = Errors::default();
    let mut held: Vec<Held> = Vec::new();
    for field in &robot.fields {
        let mut own = Held {
            effects: field.holds.effects().iter().map(|_| None).collect(),
            ..Held::default()
        };
        match (&field.holds, model.chain()) {
            (Holds::Number, _) => own.parameter = errors.keep(parameter(field, model)),
            (Holds::Link(effects), Some(chain)) => {
                own.link = errors.keep(link(field, model, chain, effects));
            }
            (Holds::Link(effects), None) => {
                errors.mistake(field.span, no_link(field, model, effects));
            }
            (Holds::Effects(_), _) => {}
        }
        held.push(own);
    }
    let not_held_effects = bind_effects(robot, model, &mut held, &mut errors);
    // What a misspelt field does not hold is no second mistake.
    let mut fields = held.iter().zip(&robot.fields);
    if fields.all(|(held, field)| is_known(held, field)) {
        for index in not_held_effects {
            errors.mistake(robot.name.span(), not_held(model, index));
        }
        check_links(robot, model, &held, &mut errors);
        check_parameters(robot, model, &held, &mut errors);
    }
    errors.finish(held)
}

/// Whether the model has what the field is named after.
fn is_known(held: &Held, field: &RobotField) -> bool {
    match field.holds {
        Holds::Number => held.parameter.is_some(),
        Holds::Link(_) => held.link.is_some(),
        Holds::Effects(_) => true,
    }
}

fn is(name: &Ident, wanted: &str) -> bool {
    name.unraw() == wanted
}

fn joint_of(field: &RobotField, model: &Model) -> Option<usize> {
    model
        .joints
        .iter()
        .position(|joint| is(field.name, &joint.name))
}

fn link(field: &RobotField, model: &Model, chain: &Chain, effects: &Effects) -> syn::Result<usize> {
    let Some(joint) = joint_of(field, model) else {
        return Err(mistake(field.name.span(), no_joint(field, model)));
    };
    if matches!(chain.links[joint].inertial, Inertial::Fixed(_)) {
        return Err(mistake(
            field.span,
            format!(
                "the inertial of link `{}` is fixed, so its field holds only effects: write `{}: {}`",
                chain.links[joint].name,
                field.name,
                effect_types(effects)
            ),
        ));
    }
    Ok(joint)
}

fn no_joint(field: &RobotField, model: &Model) -> String {
    let names: Vec<String> = model
        .joints
        .iter()
        .map(|joint| format!("`{}`", joint.name))
        .collect();
    format!(
        "the robot has no joint `{}`: it has {}",
        field.name,
        names.join(", ")
    )
}

/// What to write for a link of a robot that says its energies.
fn no_link(field: &RobotField, model: &Model, effects: &Effects) -> String {
    let name = field.name;
    let instead = if parameter(field, model).is_ok() {
        format!("`{name}` is an unknown constant: write `{name}: f64`")
    } else if effects.types.is_empty() {
        format!("delete `{name}`")
    } else {
        format!("write `{name}: {}`", effect_types(effects))
    };
    format!("a robot defined by energies has no links: {instead}")
}

/// The field that holds an unknown constant is called as it is, or in snake case where that is no other name's: `ia_yy` holds
/// `Ia_yy`.
fn field_name(model: &Model, parameter: &str) -> String {
    let snake = parameter.to_ascii_lowercase();
    let parameters = model.energies().map(|energies| &energies.parameters);
    let mut others = parameters
        .into_iter()
        .flatten()
        .map(|one| one.name.as_str())
        .filter(|other| *other != parameter);
    let is_taken = others.any(|other| other.to_ascii_lowercase() == snake)
        || model.joints.iter().any(|joint| joint.name == snake);
    if is_taken {
        parameter.to_owned()
    } else {
        snake
    }
}

fn holds_parameter(name: &Ident, model: &Model, parameter: &str) -> bool {
    is(name, parameter) || is(name, &field_name(model, parameter))
}

fn parameter(field: &RobotField, model: &Model) -> syn::Result<usize> {
    let parameters = model
        .energies()
        .map_or(&[] as &[_], |energies| &energies.parameters);
    let mut names = parameters.iter().map(|parameter| parameter.name.as_str());
    let found = names.position(|parameter| holds_parameter(field.name, model, parameter));
    found.ok_or_else(|| {
        mistake(
            field.name.span(),
            format!(
                "the robot has no unknown constant `{}`: {}",
                field.name,
                constants(model)
            ),
        )
    })
}

/// What there is instead of a constant that is not there.
fn constants(model: &Model) -> String {
    let parameters = model.energies().map(|energies| &energies.parameters);
    let names = parameters.into_iter().flatten();
    let names: Vec<String> = names.map(|one| format!("`{}`", one.name)).collect();
    match names.as_slice() {
        [] => "it has none, only links and effects".to_owned(),
        names => format!("it has {}", names.join(", ")),
    }
}

/// Joints that the effects of a field act on.
fn joints_of(field: &RobotField, model: &Model) -> Option<Vec<usize>> {
    let Some(on) = &field.on else {
        return joint_of(field, model).map(|joint| vec![joint]);
    };
    on.iter()
        .map(|name| model.joints.iter().position(|joint| is(name, &joint.name)))
        .collect()
}

/// Gives each effect to the field that holds it; those that none holds.
fn bind_effects(
    robot: &Robot,
    model: &Model,
    held: &mut [Held],
    errors: &mut Errors,
) -> Vec<usize> {
    let mut not_held = Vec::new();
    let targets: Vec<Option<Vec<usize>>> = robot
        .fields
        .iter()
        .map(|field| joints_of(field, model))
        .collect();
    for (index, effect) in model.effects.iter().enumerate() {
        let name = &effect.definition.name;
        let free = (0..held.len()).find_map(|k| {
            let types = robot.fields[k].holds.effects();
            let fits = targets[k].as_ref() == Some(&effect.joints);
            let slot = types.iter().enumerate().position(|(slot, one)| {
                fits && is(&one.effect, name) && held[k].effects[slot].is_none()
            });
            slot.map(|slot| (k, slot))
        });
        match free {
            Some((k, slot)) => held[k].effects[slot] = Some(index),
            None => not_held.push(index),
        }
    }
    let fields = robot.fields.iter().zip(held);
    for (field, held) in fields.filter(|(field, held)| is_known(held, field)) {
        for (one, effect) in field.holds.effects().iter().zip(&held.effects) {
            if effect.is_none() {
                errors.mistake(
                    one.effect.span(),
                    format!(
                        "`{}` declares no `{}` on {}: declare it there, or remove the type",
                        model.source,
                        one.effect,
                        on_text(field)
                    ),
                );
            }
        }
    }
    not_held
}

fn on_text(field: &RobotField) -> String {
    let joints = field
        .on
        .as_deref()
        .unwrap_or(std::slice::from_ref(field.name));
    let names: Vec<String> = joints.iter().map(|joint| format!("`{joint}`")).collect();
    match names.as_slice() {
        [] => "the arm as a whole".to_owned(),
        names => names.join(", "),
    }
}

fn not_held(model: &Model, index: usize) -> String {
    let effect = &model.effects[index];
    let joints: Vec<&str> = effect
        .joints
        .iter()
        .map(|&joint| model.joints[joint].name.as_str())
        .collect();
    let name = &effect.definition.name;
    let ty = type_name(name);
    let field = match (joints.as_slice(), model.chain()) {
        ([joint], Some(_)) => {
            format!("write `{ty}` in the type of `{joint}`, as in `{joint}: Link<({ty}, ..)>`")
        }
        ([joint], None) => format!("write `{joint}: {ty}`, or `{joint}: ({ty}, ..)`"),
        _ => format!("write `#[on({})] {name}: {ty}`", joints.join(", ")),
    };
    let on = match joints.as_slice() {
        [] => String::new(),
        joints => format!(" on `{}`", joints.join("`, `")),
    };
    format!("no field holds the parameters of `{name}`{on}: {field}")
}

/// Every link whose inertial is not fixed is held.
fn check_links(robot: &Robot, model: &Model, held: &[Held], errors: &mut Errors) {
    let Some(chain) = model.chain() else {
        return;
    };
    for (k, (link, joint)) in chain.links.iter().zip(&model.joints).enumerate() {
        let is_held = held.iter().any(|held| held.link == Some(k));
        if is_held || matches!(link.inertial, Inertial::Fixed(_)) {
            continue;
        }
        let field = robot
            .fields
            .iter()
            .find(|field| is(field.name, &joint.name));
        match field {
            // A link that is refused has its message already.
            Some(RobotField {
                holds: Holds::Link(_) | Holds::Number,
                ..
            }) => {}
            Some(RobotField {
                holds: Holds::Effects(effects),
                name,
                span,
                ..
            }) => {
                let ty = match effects.types.as_slice() {
                    [] => "Link".to_owned(),
                    _ => format!("Link<{}>", effect_types(effects)),
                };
                errors.mistake(
                    *span,
                    format!(
                        "the inertial of link `{}` is unknown: write `{name}: {ty}`",
                        link.name
                    ),
                );
            }
            None => errors.mistake(
                robot.name.span(),
                format!(
                    "no field holds the inertial of link `{}`: write `{}: Link`",
                    link.name, joint.name
                ),
            ),
        }
    }
}

fn check_parameters(robot: &Robot, model: &Model, held: &[Held], errors: &mut Errors) {
    let parameters = model
        .energies()
        .map_or(&[] as &[_], |energies| &energies.parameters);
    for (k, parameter) in parameters.iter().enumerate() {
        // A field of this name with another type has its message already.
        let mut fields = robot.fields.iter();
        let is_there = fields.any(|field| holds_parameter(field.name, model, &parameter.name));
        if is_there {
            continue;
        }
        if !held.iter().any(|held| held.parameter == Some(k)) {
            errors.mistake(
                robot.name.span(),
                format!(
                    "no field holds `{}`: write `{}: f64`",
                    parameter.name,
                    field_name(model, &parameter.name)
                ),
            );
        }
    }
}

/// `A`, `(A, B)` or `()`, as written.
fn effect_types(effects: &Effects) -> String {
    let names: Vec<String> = effects
        .types
        .iter()
        .map(|one| {
            let last = one.path.segments.last().expect("a path has segments");
            last.ident.to_string()
        })
        .collect();
    match names.as_slice() {
        [only] => only.clone(),
        names => format!("({})", names.join(", ")),
    }
}

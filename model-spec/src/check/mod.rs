//! [`Ast`] to [`Model`]: one `check_*` per rule of the language; all mistakes of a spec at once.
//!
//! In: a tree that follows the grammar. Out: a model downstream need not validate again (see [`crate::model`]).

mod act;
mod binding;
mod chain;
mod declared;
mod definition;
mod energies;
mod frame;
mod linear;
mod link;
mod log;
mod resolve;
mod setting;
mod size;
mod unit;
mod used;
mod value;
mod words;

#[cfg(feature = "log-settings")]
pub(crate) use chain::MOST_JOINTS;
pub(crate) use definition::check_definition;
#[cfg(feature = "log-settings")]
pub(crate) use log::{check_settings, check_unit};
pub(crate) use size::{is_beyond, is_unlikely, written};
pub(crate) use unit::Dimension;

use std::collections::BTreeMap;
use std::sync::Arc;

use proc_macro2::Span;
use syn::Ident;

use crate::ast::{Ast, Robot, Value};
use crate::diagnostic::Diagnostic;
use crate::library::standard_effects;
use crate::model::{Body, Chain, Convention, Effect, EffectDefinition, Joint, Model};
use crate::suggest;
use setting::Settings;

/// Where the checks leave what they find.
pub(crate) type Errors = Vec<Diagnostic>;

/// Checks every rule of the language. `source` is the name of the spec for headers; its folders are cut off.
///
/// # Errors
/// Every broken rule.
pub fn check(ast: &Ast, source: &str) -> Result<Model, Vec<Diagnostic>> {
    let mut errors = Errors::new();
    let definitions = check_definitions(ast, &mut errors);
    let Some(robot) = check_one_robot(ast, &mut errors) else {
        return Err(errors);
    };
    check_robot_name(&robot.name, &mut errors);

    let body = if energies::says_energies(robot) {
        check_energies(robot, &definitions, &mut errors)
    } else {
        check_chain(robot, &definitions, &mut errors)
    };
    let (
        Some(Described {
            joints,
            body,
            effects,
        }),
        true,
    ) = (body, errors.is_empty())
    else {
        return Err(errors);
    };
    let log = log::check_log(robot, &joints, &definitions.sound, &mut errors);
    if !errors.is_empty() {
        return Err(errors);
    }
    let source = source
        .rsplit(['/', '\\'])
        .next()
        .unwrap_or(source)
        .to_owned();
    Ok(Model {
        name: robot.name.to_string(),
        source,
        joints,
        body,
        effects,
        definitions: definitions.sound,
        log,
    })
}

/// What a robot's block says.
struct Described {
    joints: Vec<Joint>,
    body: Body,
    effects: Vec<Effect>,
}

fn check_chain(robot: &Robot, definitions: &Definitions, errors: &mut Errors) -> Option<Described> {
    let settings = Settings::new(
        &robot.settings,
        "the robot",
        &["gravity", "convention", "tip"],
        errors,
    );
    let convention = check_convention(robot, &settings, errors);
    let gravity = check_gravity(robot, &settings, errors);
    let tip = check_tip(&settings, errors);
    let joints = chain::check_joints(robot, convention, errors);
    let inertials = link::check_links(robot, &joints, errors);
    let names: Vec<&Ident> = robot.joints.iter().map(|joint| &joint.name).collect();
    let effects = declared::check_effects(robot, &names, definitions, errors);

    let (joints, links) = joints
        .into_iter()
        .map(|joint| joint.into_model(&inertials))
        .unzip();
    Some(Described {
        joints,
        body: Body::Chain(Chain {
            convention: convention?,
            gravity: gravity?,
            tip: tip?,
            links,
        }),
        effects,
    })
}

fn check_energies(
    robot: &Robot,
    definitions: &Definitions,
    errors: &mut Errors,
) -> Option<Described> {
    let settings = Settings::new(
        &robot.settings,
        "the robot",
        // Those of a chain are reported as a whole.
        &[&energies::SETTINGS[..], &["gravity", "convention"]].concat(),
        errors,
    );
    let described = energies::check_energies(robot, &settings, errors);
    let names: Vec<&Ident> = robot.energies.coordinates.iter().map(|c| &c.name).collect();
    let effects = declared::check_effects(robot, &names, definitions, errors);
    let (joints, energies) = described?;
    // Effects may have inertia: those with mistakes are not among them.
    if errors.is_empty() {
        energies::check_inertia(robot, &energies, &effects, errors);
    }
    Some(Described {
        joints,
        body: Body::Energies(energies),
        effects,
    })
}

/// What a robot may declare.
struct Definitions {
    /// The standard effects and the spec's own, in that order.
    sound: Vec<Arc<EffectDefinition>>,
    /// Names of those with mistakes: known, so that declaring them is no further mistake.
    faulty: Vec<String>,
}

fn check_definitions(ast: &Ast, errors: &mut Errors) -> Definitions {
    let mut definitions = Definitions {
        sound: standard_effects().to_vec(),
        faulty: Vec::new(),
    };
    check_unique(
        ast.effects.iter().map(|effect| &effect.name),
        "effect",
        errors,
    );
    for effect in &ast.effects {
        if standard_effects()
            .iter()
            .any(|known| effect.name == known.name)
        {
            errors.push(
                Diagnostic::new(
                    effect.name.span(),
                    format!(
                        "effect `{}` is in the standard library already",
                        effect.name
                    ),
                    "defined again",
                )
                .help(format!(
                    "give yours another name, such as `my_{}`",
                    effect.name
                )),
            );
        }
        match check_definition(effect, errors) {
            Some(definition) => definitions.sound.push(Arc::new(definition)),
            None => definitions.faulty.push(effect.name.to_string()),
        }
    }
    definitions
}

fn check_one_robot<'a>(ast: &'a Ast, errors: &mut Errors) -> Option<&'a Robot> {
    match ast.robots.as_slice() {
        [] => {
            let place = ast
                .effects
                .first()
                .map_or_else(Span::call_site, |effect| effect.name.span());
            errors.push(
                Diagnostic::new(place, "the spec describes no robot", "")
                    .help("write `robot Name { .. }`"),
            );
            None
        }
        [robot] => Some(robot),
        [robot, second, ..] => {
            errors.push(
                Diagnostic::new(
                    second.name.span(),
                    "the spec describes more than one robot",
                    "second robot",
                )
                .also(robot.name.span(), "first robot")
                .help("write one file for each robot"),
            );
            Some(robot)
        }
    }
}

/// The name becomes a Rust type.
fn check_robot_name(name: &Ident, errors: &mut Errors) {
    let text = name.to_string();
    if text.starts_with(|c: char| c.is_ascii_uppercase())
        && text.chars().all(|c| c.is_ascii_alphanumeric())
    {
        return;
    }
    errors.push(
        Diagnostic::new(
            name.span(),
            format!("robot `{text}` is not named in upper camel case"),
            "becomes a Rust type",
        )
        .help(format!("write `{}`", crate::transform::upper_camel(&text))),
    );
}

const CONVENTIONS: [(&str, Convention); 3] = [
    ("standard_dh", Convention::StandardDh),
    ("modified_dh", Convention::ModifiedDh),
    ("origin", Convention::Origin),
];

fn check_convention(robot: &Robot, settings: &Settings, errors: &mut Errors) -> Option<Convention> {
    let Some(value) = settings.get("convention") else {
        if settings.lacks("convention") {
            errors.push(
                Diagnostic::new(
                    robot.name.span(),
                    "the robot does not define its frame convention",
                    "no `convention`",
                )
                .help(
                    "write `convention = standard_dh;`, `modified_dh` or `origin`; there is no default",
                ),
            );
        }
        return None;
    };
    let word = value::word(value);
    let found = CONVENTIONS
        .into_iter()
        .find(|(name, _)| word.as_deref() == Some(*name));
    if found.is_none() {
        errors.push(
            Diagnostic::new(value.span(), "unknown convention", "").help(suggest::help(
                word.as_deref().unwrap_or_default(),
                CONVENTIONS.iter().map(|(name, _)| *name),
            )),
        );
    }
    found.map(|(_, convention)| convention)
}

fn check_gravity(robot: &Robot, settings: &Settings, errors: &mut Errors) -> Option<[f64; 3]> {
    let Some(value) = settings.get("gravity") else {
        if settings.lacks("gravity") {
            errors.push(
                Diagnostic::new(robot.name.span(), "the robot does not define gravity", "no `gravity`").help(
                    "write `gravity = [0, 0, -9.81];` (m/s^2, in the base frame; zeros for horizontal motion)",
                ),
            );
        }
        return None;
    };
    value::vector(value, Dimension::ACCELERATION)
        .map_err(|error| errors.push(error))
        .ok()
}

/// The origin of the last link's frame where the spec says nothing.
fn check_tip(settings: &Settings, errors: &mut Errors) -> Option<[f64; 3]> {
    let Some(value) = settings.get("tip") else {
        return Some([0.0; 3]);
    };
    value::vector(value, Dimension::LENGTH)
        .map_err(|error| errors.push(error))
        .ok()
}

/// No name twice; both places are shown.
#[track_caller]
fn check_unique<'a>(names: impl IntoIterator<Item = &'a Ident>, what: &str, errors: &mut Errors) {
    let mut seen: BTreeMap<String, Span> = BTreeMap::new();
    for name in names {
        if let Some(first) = seen.get(&name.to_string()) {
            errors.push(
                Diagnostic::new(
                    name.span(),
                    format!("{what} `{name}` is defined twice"),
                    "second",
                )
                .also(*first, "first")
                .help("rename one of them, or delete it"),
            );
        } else {
            seen.insert(name.to_string(), name.span());
        }
    }
}

/// The value of a setting that may be absent.
fn optional<T>(
    value: Option<&Value>,
    read: impl FnOnce(&Value) -> Result<T, Diagnostic>,
    errors: &mut Errors,
) -> Option<T> {
    value.and_then(|value| read(value).map_err(|error| errors.push(error)).ok())
}

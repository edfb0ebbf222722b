//! Frames of joints: the keys of the three conventions, and the one [`Placement`] that they end in.

use super::chain::coordinate_dimension;
use super::setting::{Settings, meant};
use super::unit::Dimension;
use super::{Errors, optional, value};
use crate::ast::{self, Value};
use crate::diagnostic::Diagnostic;
use crate::model::{Convention, JointKind, Placement, Transform};
use crate::suggest;
use crate::transform::{rotation_rpy, rotation_x, rotation_z, snap};

const COMMON_KEYS: [&str; 7] = [
    "offset",
    "position",
    "velocity",
    "acceleration",
    "torque",
    "actuator_gain",
    "link",
];

/// Keys that give the frame: required ones first, then those that default to zero.
fn frame_keys(
    convention: Convention,
    kind: JointKind,
) -> (&'static [&'static str], &'static [&'static str]) {
    match (convention, kind) {
        (Convention::Origin, _) => (&["xyz", "axis"], &["rpy"]),
        (_, JointKind::Revolute) => (&["a", "alpha", "d"], &[]),
        (_, JointKind::Prismatic) => (&["a", "alpha", "theta"], &[]),
    }
}

/// The numbers of a joint's frame as they are written.
pub(super) fn written(joint: &ast::Joint) -> String {
    let settings = joint.settings.iter();
    let numbers = settings.filter_map(|setting| {
        let key = setting.key.to_string();
        if key != "offset" && !FRAME_KEYS.contains(&key.as_str()) {
            return None;
        }
        let value = setting.value.span().source_text()?;
        let value: Vec<&str> = value.split_whitespace().collect();
        Some(format!("{key} = {}", value.join(" ")))
    });
    numbers.collect::<Vec<_>>().join("; ")
}

/// Keys of all conventions.
const FRAME_KEYS: [&str; 7] = ["a", "alpha", "d", "theta", "xyz", "rpy", "axis"];

/// Only the keys of the robot's convention, and all that it needs.
pub(super) fn check_keys(
    joint: &ast::Joint,
    convention: Convention,
    kind: JointKind,
    errors: &mut Errors,
) {
    let (required, defaulted) = frame_keys(convention, kind);
    let frame: Vec<&str> = required.iter().chain(defaulted).copied().collect();
    let known: Vec<&str> = frame.iter().chain(&COMMON_KEYS).copied().collect();
    let is_variable =
        |key: &str| convention != Convention::Origin && (key == "theta" || key == "d");
    let mut foreign = Vec::new();
    for setting in &joint.settings {
        let key = setting.key.to_string();
        if known.contains(&key.as_str()) {
            continue;
        }
        if FRAME_KEYS.contains(&key.as_str()) && !is_variable(&key) {
            foreign.push(setting.key.span());
            continue;
        }
        let (label, help) = if is_variable(&key) {
            ("this joint's variable", variable_help(kind))
        } else {
            (
                "unknown setting",
                suggest::help(&key, known.iter().copied()),
            )
        };
        let message = format!("joint `{}` has no setting `{key}`", joint.name);
        errors.push(Diagnostic::new(setting.key.span(), message, label).help(help));
    }
    if let Some((first, rest)) = foreign.split_first() {
        let name = convention.name();
        let message = format!(
            "joint `{}` is written in another convention than `{name}`",
            joint.name
        );
        let mut error = Diagnostic::new(*first, message, format!("not a setting of `{name}`"));
        for span in rest {
            error = error.also(*span, "nor this");
        }
        errors.push(error.help(format!(
            "write {}, or change the robot's `convention`",
            suggest::list(frame.iter().copied())
        )));
        return;
    }
    let meant = meant(&joint.settings, &known);
    check_complete(joint, required, &meant, errors);
}

fn variable_help(kind: JointKind) -> String {
    match kind {
        JointKind::Revolute => "write `offset` for what is added to `theta`",
        JointKind::Prismatic => {
            "write `offset` for what is added to `d`, and `theta` for the fixed angle"
        }
    }
    .to_owned()
}

fn check_complete(joint: &ast::Joint, required: &[&str], meant: &[&str], errors: &mut Errors) {
    let is_there = |key: &str| joint.settings.iter().any(|setting| setting.key == key);
    let missing: Vec<&str> = required
        .iter()
        .copied()
        .filter(|key| !is_there(key) && !meant.contains(key))
        .collect();
    if !missing.is_empty() {
        let list = suggest::list(missing.iter().copied());
        let message = format!("joint `{}` does not give {list}", joint.name);
        errors.push(
            Diagnostic::new(joint.name.span(), message, "incomplete frame")
                .help(format!("add {}", example(&missing))),
        );
    }
}

/// How to write the missing keys.
fn example(missing: &[&str]) -> String {
    let text = |key: &&str| match *key {
        "xyz" => "`xyz = [0, 0, 0];`".to_owned(),
        "axis" => "`axis = [0, 0, 1];`".to_owned(),
        "alpha" | "theta" => format!("`{key} = 0 deg;`"),
        key => format!("`{key} = 0;`"),
    };
    missing.iter().map(text).collect::<Vec<_>>().join(" and ")
}

/// Axis of DH joints.
pub(super) const Z: [f64; 3] = [0.0, 0.0, 1.0];

/// `before * motion * after`. Rotation and translation along one axis commute, which moves the fixed half of a screw to
/// the side where the convention keeps its constants.
pub(super) fn check_placement(
    joint: &ast::Joint,
    settings: &Settings,
    convention: Convention,
    kind: JointKind,
    errors: &mut Errors,
) -> Option<Placement> {
    let coordinate = coordinate_dimension(kind);
    let offset = optional(
        settings.get("offset"),
        |v| value::scalar(v, coordinate),
        errors,
    )
    .unwrap_or(0.0);
    let offset = if kind == JointKind::Revolute {
        snap(offset)
    } else {
        offset
    };
    let mut number =
        |key, dimension| optional(settings.get(key), |v| value::scalar(v, dimension), errors);
    if convention == Convention::Origin {
        let xyz = optional(
            settings.get("xyz"),
            |v| value::vector(v, Dimension::LENGTH),
            errors,
        );
        let rpy = match settings.get("rpy") {
            None => Some([0.0; 3]),
            Some(rpy) => optional(Some(rpy), |v| value::vector(v, Dimension::ANGLE), errors),
        };
        let axis = optional(settings.get("axis"), |v| check_axis(v, joint), errors);
        let before = Transform {
            rotation: rotation_rpy(rpy?),
            translation: xyz?,
        };
        return Some(Placement {
            before,
            axis: axis?,
            offset,
            after: Transform::IDENTITY,
        });
    }
    let (a, alpha) = (
        number("a", Dimension::LENGTH),
        number("alpha", Dimension::ANGLE),
    );
    let (fixed_key, dimension) = match kind {
        JointKind::Revolute => ("d", Dimension::LENGTH),
        JointKind::Prismatic => ("theta", Dimension::ANGLE),
    };
    let fixed = number(fixed_key, dimension)?;
    let along_x = Transform {
        rotation: rotation_x(alpha?),
        translation: [a?, 0.0, 0.0],
    };
    let along_z = match kind {
        JointKind::Revolute => Transform {
            translation: [0.0, 0.0, fixed],
            ..Transform::IDENTITY
        },
        JointKind::Prismatic => Transform {
            rotation: rotation_z(fixed),
            ..Transform::IDENTITY
        },
    };
    Some(match convention {
        Convention::StandardDh => Placement {
            before: Transform::IDENTITY,
            axis: Z,
            offset,
            after: along_z.then(&along_x),
        },
        _ => Placement {
            before: along_x.then(&along_z),
            axis: Z,
            offset,
            after: Transform::IDENTITY,
        },
    })
}

fn check_axis(value: &Value, joint: &ast::Joint) -> Result<[f64; 3], Diagnostic> {
    let axis: [f64; 3] = value::vector(value, Dimension::NONE)?;
    let length = axis[0].hypot(axis[1]).hypot(axis[2]);
    if length > 0.0 && length.is_finite() {
        return Ok(axis.map(|x| x / length));
    }
    Err(Diagnostic::new(
        value.span(),
        format!("the axis of joint `{}` has no direction", joint.name),
        "length zero",
    )
    .help("write the direction of positive motion, such as `axis = [0, 0, 1];`"))
}

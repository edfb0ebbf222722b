//! Joints: kind, frame, limits; the three frame conventions end here, in one [`Placement`].

use std::collections::BTreeMap;

use proc_macro2::Span;
use syn::Ident;

use super::setting::Settings;
use super::unit::Dimension;
use super::{Errors, check_unique, optional, value};
use crate::ast::{self, Robot, Value};
use crate::diagnostic::Diagnostic;
use crate::model::{Convention, Inertial, Joint, JointKind, Limits, Link, Placement, Transform};
use crate::suggest;
use crate::transform::{rotation_rpy, rotation_x, rotation_z, snap};

/// A joint as far as its own block tells.
pub(super) struct CheckedJoint {
    name: String,
    kind: JointKind,
    placement: Placement,
    limits: Limits,
    actuator_gain: f64,
    pub(super) link: Ident,
    line: usize,
}

impl CheckedJoint {
    pub(super) fn into_model(self, inertials: &BTreeMap<String, Inertial>) -> Joint {
        let name = self.link.to_string();
        let inertial = inertials.get(&name).copied().unwrap_or(Inertial::Unknown);
        Joint {
            name: self.name,
            kind: self.kind,
            placement: self.placement,
            limits: self.limits,
            actuator_gain: self.actuator_gain,
            link: Link { name, inertial },
            line: self.line,
        }
    }
}

/// All joints; without a convention their frames are not looked at.
pub(super) fn check_joints(
    robot: &Robot,
    convention: Option<Convention>,
    errors: &mut Errors,
) -> Vec<CheckedJoint> {
    if robot.joints.is_empty() {
        errors.push(
            Diagnostic::new(robot.name.span(), "the robot has no joints", "").help(
                "write `joint name: revolute { .. }` for each joint, from the base to the tip",
            ),
        );
    }
    check_unique(
        robot.joints.iter().map(|joint| &joint.name),
        "joint",
        errors,
    );
    for joint in robot.joints.iter().filter(|joint| joint.name == "all") {
        errors.push(
            Diagnostic::new(
                joint.name.span(),
                "a joint cannot be called `all`",
                "reserved",
            )
            .help("`all` stands for all joints in `effects { .. on all; }`; choose another name"),
        );
    }
    let joints: Vec<CheckedJoint> = robot
        .joints
        .iter()
        .map(|joint| check_joint(joint, convention, errors))
        .collect();
    check_unique(joints.iter().map(|joint| &joint.link), "link", errors);
    joints
}

/// Falls back to neutral values behind an error, so that links and effects are checked all the same.
fn check_joint(
    joint: &ast::Joint,
    convention: Option<Convention>,
    errors: &mut Errors,
) -> CheckedJoint {
    let kind = check_kind(joint, errors);
    let owner = format!("joint `{}`", joint.name);
    let settings = Settings::unchecked(&joint.settings, &owner, errors);
    if let (Some(convention), Some(kind)) = (convention, kind) {
        check_keys(joint, convention, kind, errors);
    }
    let placement = match (convention, kind) {
        (Some(convention), Some(kind)) => {
            check_placement(joint, &settings, convention, kind, errors)
        }
        _ => None,
    };
    let kind = kind.unwrap_or(JointKind::Revolute);
    CheckedJoint {
        name: joint.name.to_string(),
        kind,
        placement: placement.unwrap_or(Placement {
            before: Transform::IDENTITY,
            axis: Z,
            offset: 0.0,
            after: Transform::IDENTITY,
        }),
        limits: check_limits(&settings, kind, errors),
        actuator_gain: check_gain(&settings, errors),
        link: check_link_name(joint, &settings, errors),
        line: joint.name.span().start().line,
    }
}

fn check_kind(joint: &ast::Joint, errors: &mut Errors) -> Option<JointKind> {
    let kind = joint.kind.to_string();
    match kind.as_str() {
        "revolute" => Some(JointKind::Revolute),
        "prismatic" => Some(JointKind::Prismatic),
        _ => {
            errors.push(
                Diagnostic::new(
                    joint.kind.span(),
                    format!("unknown kind of joint `{kind}`"),
                    "",
                )
                .help(suggest::help(&kind, ["revolute", "prismatic"])),
            );
            None
        }
    }
}

const COMMON_KEYS: [&str; 6] = [
    "offset",
    "position",
    "velocity",
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

/// Only the keys of the robot's convention, and all that it needs.
fn check_keys(joint: &ast::Joint, convention: Convention, kind: JointKind, errors: &mut Errors) {
    let (required, defaulted) = frame_keys(convention, kind);
    let known: Vec<&str> = required
        .iter()
        .chain(defaulted)
        .chain(&COMMON_KEYS)
        .copied()
        .collect();
    for setting in &joint.settings {
        let key = setting.key.to_string();
        if known.contains(&key.as_str()) {
            continue;
        }
        let spelling = convention_name(convention);
        let help = match (key.as_str(), convention, kind) {
            ("theta", Convention::StandardDh | Convention::ModifiedDh, _) => {
                "`theta` is this joint's variable; write `offset` for what is added to it".to_owned()
            }
            ("d", Convention::StandardDh | Convention::ModifiedDh, _) => {
                "`d` is this joint's variable; write `offset` for what is added to it, and `theta` for the fixed angle"
                    .to_owned()
            }
            ("a" | "alpha" | "d" | "theta" | "xyz" | "rpy" | "axis", ..) => {
                format!("with `convention = {spelling}` write {}", suggest::list(known.iter().copied().take(3)))
            }
            _ => suggest::help(&key, known.iter().copied()),
        };
        errors.push(
            Diagnostic::new(
                setting.key.span(),
                format!("joint `{}` has no setting `{key}`", joint.name),
                format!(
                    "not a setting of {} {spelling} joint",
                    if kind == JointKind::Revolute {
                        "a revolute"
                    } else {
                        "a prismatic"
                    }
                ),
            )
            .help(help),
        );
    }
    let missing: Vec<&str> = required
        .iter()
        .copied()
        .filter(|key| !joint.settings.iter().any(|setting| setting.key == key))
        .collect();
    if !missing.is_empty() {
        errors.push(
            Diagnostic::new(
                joint.name.span(),
                format!(
                    "joint `{}` does not give {}",
                    joint.name,
                    suggest::list(missing.iter().copied())
                ),
                "incomplete frame",
            )
            .help(format!("add {}", example(&missing))),
        );
    }
}

fn convention_name(convention: Convention) -> &'static str {
    match convention {
        Convention::StandardDh => "standard_dh",
        Convention::ModifiedDh => "modified_dh",
        Convention::Origin => "origin",
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

const Z: [f64; 3] = [0.0, 0.0, 1.0];

/// `before * motion * after`. Rotation and translation along one axis commute, which moves the fixed half of a screw to
/// the side where the convention keeps its constants.
fn check_placement(
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

fn coordinate_dimension(kind: JointKind) -> Dimension {
    match kind {
        JointKind::Revolute => Dimension::ANGLE,
        JointKind::Prismatic => Dimension::LENGTH,
    }
}

fn check_limits(settings: &Settings, kind: JointKind, errors: &mut Errors) -> Limits {
    let (speed, torque) = match kind {
        JointKind::Revolute => (Dimension::ANGULAR_SPEED, Dimension::TORQUE),
        JointKind::Prismatic => (Dimension::SPEED, Dimension::FORCE),
    };
    Limits {
        position: optional(
            settings.get("position"),
            |v| value::range(v, coordinate_dimension(kind)),
            errors,
        ),
        velocity: optional(settings.get("velocity"), |v| positive(v, speed), errors),
        torque: optional(settings.get("torque"), |v| positive(v, torque), errors),
    }
}

fn positive(value: &Value, dimension: Dimension) -> Result<f64, Diagnostic> {
    let limit = value::scalar(value, dimension)?;
    if limit > 0.0 {
        return Ok(limit);
    }
    Err(
        Diagnostic::new(value.span(), "a limit is positive", format!("is {limit}"))
            .help("write the largest magnitude, or leave the limit away"),
    )
}

fn check_gain(settings: &Settings, errors: &mut Errors) -> f64 {
    let gain = |v: &Value| {
        let gain = value::any_scalar(v)?;
        if gain != 0.0 {
            return Ok(gain);
        }
        Err(Diagnostic::new(
            v.span(),
            "an actuator gain of zero",
            "the log would tell nothing",
        )
        .help(
            "write the joint torque per unit of the logged channel; 1 where the log holds torques",
        ))
    };
    optional(settings.get("actuator_gain"), gain, errors).unwrap_or(1.0)
}

fn check_link_name(joint: &ast::Joint, settings: &Settings, errors: &mut Errors) -> Ident {
    let Some(value) = settings.get("link") else {
        return joint.name.clone();
    };
    if let Some(name) = value::word(value) {
        let span: Span = value.span();
        return Ident::new(&name, span);
    }
    errors.push(
        Diagnostic::new(value.span(), "expected the name of a link", "")
            .help("write `link = forearm;`"),
    );
    joint.name.clone()
}

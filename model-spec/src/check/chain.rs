//! Joints: kind, limits, actuator gain, the link that each moves; frames are in [`super::frame`].

use std::collections::BTreeMap;

use proc_macro2::Span;
use syn::Ident;

use super::frame::{Z, check_keys, check_placement, written};
use super::setting::Settings;
use super::unit::Dimension;
use super::{Errors, check_unique, optional, value};
use crate::ast::{self, Robot, Value};
use crate::diagnostic::Diagnostic;
use crate::model::{
    Convention, GainUnit, Inertial, Joint, JointKind, Limits, Link, Placement, Transform,
};
use crate::suggest;

/// A joint as far as its own block tells.
pub(super) struct CheckedJoint {
    name: String,
    kind: JointKind,
    placement: Placement,
    frame: String,
    limits: Limits,
    gain: Gain,
    pub(super) link: Ident,
    line: usize,
}

impl CheckedJoint {
    pub(super) fn into_model(self, inertials: &BTreeMap<String, Inertial>) -> (Joint, Link) {
        let name = self.link.to_string();
        let inertial = inertials.get(&name).copied().unwrap_or(Inertial::Unknown);
        let joint = Joint {
            name: self.name,
            kind: self.kind,
            limits: self.limits,
            actuator_gain: self.gain.value,
            actuator_gain_unit: self.gain.unit,
            line: self.line,
        };
        let link = Link {
            name,
            placement: self.placement,
            frame: self.frame,
            inertial,
        };
        (joint, link)
    }
}

/// Equations grow with the cube of the number of joints: with this many they take a minute, and no arm has as many.
pub(crate) const MOST_JOINTS: usize = 40;

/// Joints of a chain, or coordinates of energies.
pub(super) fn check_number<'a>(
    mut names: impl Iterator<Item = &'a Ident>,
    most: usize,
    what: &str,
    errors: &mut Errors,
) {
    if let Some(name) = names.nth(most) {
        errors.push(
            Diagnostic::new(
                name.span(),
                format!("the robot has more than {most} {what}"),
                "one too many",
            )
            .help("describe each arm of a machine with several arms separately"),
        );
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
    check_number(
        robot.joints.iter().map(|joint| &joint.name),
        MOST_JOINTS,
        "joints",
        errors,
    );
    let before = errors.len();
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
    if errors.len() == before {
        check_unique(joints.iter().map(|joint| &joint.link), "link", errors);
    }
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
        frame: written(joint),
        limits: check_limits(&settings, kind, errors),
        gain: check_gain(&settings, kind, errors),
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

/// Dimension of the joint's coordinate.
pub(super) fn coordinate_dimension(kind: JointKind) -> Dimension {
    match kind {
        JointKind::Revolute => Dimension::ANGLE,
        JointKind::Prismatic => Dimension::LENGTH,
    }
}

pub(super) fn check_limits(settings: &Settings, kind: JointKind, errors: &mut Errors) -> Limits {
    let acceleration = match kind {
        JointKind::Revolute => Dimension::ANGULAR_ACCELERATION,
        JointKind::Prismatic => Dimension::ACCELERATION,
    };
    let mut magnitude = |key, dimension| {
        let value = settings.get(key);
        optional(value, |v| positive(v, dimension), errors)
    };
    let velocity = magnitude("velocity", speed_dimension(kind));
    let acceleration = magnitude("acceleration", acceleration);
    let torque = magnitude("torque", torque_dimension(kind));
    Limits {
        position: optional(
            settings.get("position"),
            |v| value::range(v, coordinate_dimension(kind)),
            errors,
        ),
        velocity,
        acceleration,
        torque,
    }
}

fn positive(value: &Value, dimension: Dimension) -> Result<f64, Diagnostic> {
    let limit = value::scalar(value, dimension)?;
    if limit > 0.0 {
        return Ok(limit);
    }
    Err(Diagnostic::new(
        value.span(),
        "a limit must be positive",
        format!("is {limit}"),
    )
    .help("write the largest magnitude, or remove the limit"))
}

/// An `actuator_gain`; 1 without a unit where there is none.
#[derive(Clone, Copy)]
pub(super) struct Gain {
    pub(super) value: f64,
    pub(super) unit: Option<GainUnit>,
}

impl Gain {
    pub(super) const NONE: Self = Self {
        value: 1.0,
        unit: None,
    };
}

pub(super) fn check_gain(settings: &Settings, kind: JointKind, errors: &mut Errors) -> Gain {
    let gain = |v: &Value| {
        let gain = value::quantity(v)?;
        if gain.value.abs() == 0.0 {
            return Err(Diagnostic::new(
                v.span(),
                "an actuator gain of zero",
                "torques would be zero",
            )
            .help("write the joint torque per unit of the logged channel; 1 where the log holds torques"));
        }
        let unit = match gain.dimension {
            None => Some(GainUnit::Plain),
            Some(found) => [GainUnit::Torque, GainUnit::TorquePerAmpere]
                .into_iter()
                .find(|unit| gain_dimension(*unit, kind) == Some(found)),
        };
        let found = gain.dimension.unwrap_or(Dimension::NONE);
        match unit {
            None => Err(Diagnostic::new(
                v.span(),
                format!("an actuator gain cannot be {}", found.describe()),
                "joint torque per unit of the logged channel",
            )
            .help(format!(
                "write a plain number, or {} per ampere: `0.1 {}/A`",
                torque_dimension(kind).describe(),
                torque_unit(kind)
            ))),
            unit => Ok(Gain {
                value: gain.value,
                unit,
            }),
        }
    };
    optional(settings.get("actuator_gain"), gain, errors).unwrap_or(Gain::NONE)
}

/// Dimension of a gain; none where it is a plain number.
pub(super) fn gain_dimension(unit: GainUnit, kind: JointKind) -> Option<Dimension> {
    let torque = torque_dimension(kind);
    match unit {
        GainUnit::Plain => None,
        GainUnit::Torque => Some(torque),
        GainUnit::TorquePerAmpere => Some(torque.times(Dimension::CURRENT, -1)),
    }
}

/// Dimension of what drives the joint.
pub(super) fn torque_dimension(kind: JointKind) -> Dimension {
    match kind {
        JointKind::Revolute => Dimension::TORQUE,
        JointKind::Prismatic => Dimension::FORCE,
    }
}

/// Unit of what drives the joint, as it is written.
pub(super) fn torque_unit(kind: JointKind) -> &'static str {
    match kind {
        JointKind::Revolute => "Nm",
        JointKind::Prismatic => "N",
    }
}

/// Dimension of the joint's speed.
pub(super) fn speed_dimension(kind: JointKind) -> Dimension {
    match kind {
        JointKind::Revolute => Dimension::ANGULAR_SPEED,
        JointKind::Prismatic => Dimension::SPEED,
    }
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

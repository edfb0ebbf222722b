//! The text of the imported spec: numbers that read well, names that the language accepts.

use std::fmt::Write as _;

use urdf_rs::{Joint, JointType};

use super::body::Carried;
use super::tree::{Chain, ChainJoint};
use super::{ASSUMED_GRAVITY, ImportOptions, Inertials};
use crate::check::{Dimension, is_beyond, written};
pub(super) use crate::export::number;
use crate::transform::{quarter_turns, rpy, upper_camel};

/// Names in the spec, joint by joint.
pub(super) struct Names {
    pub(super) joints: Vec<String>,
    pub(super) links: Vec<String>,
}

impl Names {
    pub(super) fn new(chain: &Chain) -> Self {
        Self {
            joints: unique(chain.joints.iter().map(|joint| joint.joint.name.as_str())),
            links: unique(
                chain
                    .joints
                    .iter()
                    .map(|joint| joint.joint.child.link.as_str()),
            ),
        }
    }

    /// Names of the URDF that are no words of the language, and those that stand for them.
    pub(super) fn renamed(&self, chain: &Chain) -> Option<String> {
        let joints = chain.joints.iter().map(|joint| &joint.joint.name);
        let links = chain.joints.iter().map(|joint| &joint.joint.child.link);
        let joints = joints
            .zip(&self.joints)
            .map(|(old, new)| ("joint", old, new));
        let links = links.zip(&self.links).map(|(old, new)| ("link", old, new));
        let renamed: Vec<String> = joints
            .chain(links)
            .filter(|(_, old, new)| old != new)
            .map(|(what, old, new)| format!("{what} `{old}` is `{new}`"))
            .collect();
        (!renamed.is_empty()).then(|| {
            format!(
                "names that are no words of the language, or there twice, are changed: {}",
                renamed.join(", ")
            )
        })
    }
}

/// What a URDF leaves open.
pub(super) fn assumed_gravity() -> String {
    format!(
        "Gravity is taken to be {} m/s^2 in the frame of the base: a URDF does not say it",
        list(&ASSUMED_GRAVITY)
    )
}

/// Names as words of the language; what two names have lost is made up by a number.
fn unique<'a>(names: impl Iterator<Item = &'a str>) -> Vec<String> {
    let mut words: Vec<String> = Vec::new();
    for name in names {
        let plain = word(name);
        let mut candidate = plain.clone();
        let mut number = 2;
        while words.contains(&candidate) {
            candidate = format!("{plain}_{number}");
            number += 1;
        }
        words.push(candidate);
    }
    words
}

fn word(name: &str) -> String {
    let mut word: String = name
        .chars()
        .map(|c| if c.is_ascii_alphanumeric() { c } else { '_' })
        .collect();
    if !word.starts_with(|c: char| c.is_ascii_alphabetic()) {
        word.insert(0, 'j');
    }
    if word == "all" || syn::parse_str::<syn::Ident>(&word).is_err() {
        word.push('_');
    }
    word
}

/// The whole spec.
pub(super) fn spec(
    robot: &str,
    chain: &Chain,
    names: &Names,
    carried: &[Carried],
    effects: &[String],
    notes: &[String],
    options: &ImportOptions,
) -> String {
    let mut text = format!(
        "// Imported from a URDF: the chain that stands on link `{}`.\n",
        comment(chain.base)
    );
    let held: Vec<String> = carried
        .iter()
        .flat_map(|one| &one.held)
        .map(|joint| comment(&joint.describe()))
        .collect();
    if !held.is_empty() {
        let _ = writeln!(
            text,
            "// Beside the chain, held (at zero where no place is named) and part of the links that carry them: {}.",
            held.join(", ")
        );
    }
    for note in notes {
        let _ = writeln!(text, "// {}.", comment(note));
    }
    let values = super::effects::values(chain, names);
    if !values.is_empty() {
        let _ = writeln!(
            text,
            "// The URDF's damping (N m s/rad) and friction (N m) are declared as effects, to be identified; it says {}.",
            values.join("; ")
        );
    }
    let name = upper_camel(robot);
    let _ = writeln!(
        text,
        "robot {name} {{\n    gravity = {};\n    convention = origin;",
        list_of(
            &options.gravity.unwrap_or(ASSUMED_GRAVITY),
            Dimension::ACCELERATION
        )
    );
    let tip = chain.tip.map(readable);
    if tip.iter().any(|x| *x != 0.0) {
        let _ = writeln!(text, "    tip = {};", list_of(&tip, Dimension::LENGTH));
    }
    text.push('\n');
    for (k, joint) in chain.joints.iter().enumerate() {
        let _ = writeln!(
            text,
            "    {}",
            joint_line(joint, &names.joints[k], &names.links[k])
        );
    }
    let status = match options.inertials {
        Inertials::Nominal => Some("nominal"),
        Inertials::Fixed => Some("fixed"),
        Inertials::None => None,
    };
    if let Some(status) = status {
        text.push('\n');
        for (name, Carried { body, .. }) in names.links.iter().zip(carried) {
            let i = body.inertia;
            let six = [i[0][0], i[0][1], i[0][2], i[1][1], i[1][2], i[2][2]].map(readable);
            let (mass, com, inertia) = (
                written(readable(body.mass), Dimension::MASS, number),
                list_of(&body.com.map(readable), Dimension::LENGTH),
                list_of(&six, Dimension::INERTIA),
            );
            let _ = writeln!(
                text,
                "    link {name}: {status} {{ mass = {mass}; com = {com}; inertia = {inertia}; }}"
            );
        }
    }
    if !effects.is_empty() {
        let lines = effects.join(";\n        ");
        let _ = writeln!(text, "\n    effects {{\n        {lines};\n    }}");
    }
    text.push_str("}\n");
    text
}

/// Whether a joint's limits are a range to move in, of a size that limits may have.
fn has_range(joint: &Joint) -> bool {
    let (lower, upper) = (joint.limit.lower, joint.limit.upper);
    let of = range_dimension(joint);
    let is_end = |end: f64| end.is_finite() && !is_beyond(end, of);
    lower < upper && is_end(lower) && is_end(upper)
}

fn range_dimension(joint: &Joint) -> Dimension {
    if joint.joint_type == JointType::Prismatic {
        Dimension::LENGTH
    } else {
        Dimension::ANGLE
    }
}

/// Joints whose limits leave no way to move, or are no numbers: the spec has none for them.
pub(super) fn without_range(chain: &Chain) -> Vec<String> {
    let joints = chain.joints.iter().map(|joint| joint.joint);
    joints
        .filter(|joint| joint.joint_type != JointType::Continuous && !has_range(joint))
        .map(|joint| {
            format!(
                "joint `{}` has limits from {} to {}, which are no range to move in: left out",
                joint.name, joint.limit.lower, joint.limit.upper
            )
        })
        .collect()
}

fn joint_line(joint: &ChainJoint, name: &str, link: &str) -> String {
    let source = joint.joint;
    let prismatic = source.joint_type == JointType::Prismatic;
    let (xyz, angles) = joint.written.unwrap_or_else(|| {
        (
            joint.origin.translation.map(readable),
            rpy(&joint.origin.rotation).map(readable),
        )
    });
    let mut line = format!(
        "joint {name}: {} {{ xyz = {};",
        if prismatic { "prismatic" } else { "revolute" },
        list_of(&xyz, Dimension::LENGTH)
    );
    if angles.map(angle) != ["0", "0", "0"] {
        let _ = write!(line, " rpy = [{}];", angles.map(angle).join(", "));
    }
    let _ = write!(line, " axis = {};", list(&source.axis.xyz.0));
    let limit = &source.limit;
    if source.joint_type != JointType::Continuous && has_range(source) {
        let end = |x: f64| written(x, range_dimension(source), number);
        let (low, high) = (end(limit.lower), end(limit.upper));
        let _ = write!(line, " position = {low} .. {high};");
    }
    let (speed, load) = if prismatic {
        (Dimension::SPEED, Dimension::FORCE)
    } else {
        (Dimension::ANGULAR_SPEED, Dimension::TORQUE)
    };
    for (key, value, dimension) in [
        ("velocity", limit.velocity, speed),
        ("torque", limit.effort, load),
    ] {
        if value > 0.0 && value.is_finite() && !is_beyond(value, dimension) {
            let _ = write!(line, " {key} = {};", written(value, dimension, number));
        }
    }
    if link != name {
        let _ = write!(line, " link = {link};");
    }
    line.push_str(" }");
    line
}

/// Text that may stand in a `//` comment.
fn comment(text: &str) -> String {
    text.chars()
        .map(|c| if c.is_control() { ' ' } else { c })
        .collect()
}

fn list(numbers: &[f64]) -> String {
    list_with(numbers, number)
}

fn list_of(numbers: &[f64], dimension: Dimension) -> String {
    list_with(numbers, |x| written(x, dimension, number))
}

fn list_with(numbers: &[f64], written: impl Fn(f64) -> String) -> String {
    let numbers: Vec<String> = numbers.iter().map(|x| written(*x)).collect();
    format!("[{}]", numbers.join(", "))
}

/// Quarter turns in degrees, other angles in rad.
fn angle(x: f64) -> String {
    match quarter_turns(x) {
        Some(0.0) => "0".to_owned(),
        Some(turns) => format!("{} deg", 90.0 * turns),
        None => radians(x),
    }
}

fn radians(x: f64) -> String {
    written(x, Dimension::ANGLE, number)
}

/// A computed number without the noise of its last digits: 13 significant ones, and zero below 1e-15.
pub(super) fn readable(x: f64) -> f64 {
    if x.abs() < 1e-15 {
        0.0
    } else {
        format!("{x:.12e}").parse().unwrap_or(x)
    }
}

//! A URDF from the frames of a spec.

use std::fmt::Write as _;

use super::frames::{Body, frames};
use super::xml::{comment, free_name, inertial_lines, number, numbers};
use super::{ExportError, JointNumbers, Numbers, chain};
use crate::model::{Joint, JointKind, Model, Transform};
use crate::transform::rpy;

/// What stands for a limit of torque or velocity that the spec does not have where a URDF has to have one: N m, N, rad/s, m/s.
pub const NO_LIMIT: f64 = 1e6;

/// And for half a range of a prismatic joint, m: the longest that the language knows.
pub const NO_RANGE: f64 = 1e3;

/// Writes a URDF of the arm: links `base`, those of the spec, and `tip` behind the last of them where it is elsewhere.
///
/// The frame of a URDF's link is that of its joint. So links of DH specs have another frame here than in the spec, with the
/// inertials in that; positions of joints mean the same.
///
/// # Errors
/// [`ExportError::NoChain`] for a robot that says its energies.
pub fn urdf(model: &Model, numbers: &Numbers) -> Result<String, ExportError> {
    let chain = chain(model)?;
    let (frames, tip) = frames(chain, &model.joints);
    let names: Vec<&str> = chain.links.iter().map(|link| link.name.as_str()).collect();
    let base = free_name("base", &names);
    let mut text = format!("<?xml version=\"1.0\"?>\n<robot name=\"{}\">\n", model.name);
    let gravity = super::xml::numbers(&chain.gravity);
    let _ = writeln!(
        text,
        "  <!-- gravity in the frame of `{base}`, which a URDF does not say: {} m/s^2 -->",
        comment(&gravity)
    );
    for note in &numbers.notes {
        let _ = writeln!(text, "  <!-- {} -->", comment(note));
    }
    let _ = writeln!(text, "  <link name=\"{base}\"/>");
    let mut parent = base.as_str();
    let links = chain.links.iter().zip(&numbers.links).zip(&frames);
    let joints = model.joints.iter().zip(&numbers.joints);
    for (((link, own), frame), (joint, losses)) in links.zip(joints) {
        let body = Body::new(own.inertial).seen_from(&frame.link);
        if body.is_nothing() {
            let _ = writeln!(text, "  <link name=\"{}\"/>", link.name);
        } else {
            let _ = writeln!(text, "  <link name=\"{}\">", link.name);
            for line in inertial_lines(&body, &own.remark) {
                let _ = writeln!(text, "    {line}");
            }
            text.push_str("  </link>\n");
        }
        let _ = writeln!(
            text,
            "  <joint name=\"{}\" type=\"{}\">",
            joint.name,
            kind(joint)
        );
        let ends = [("parent", parent), ("child", &link.name)];
        for (what, name) in ends {
            let _ = writeln!(text, "    <{what} link=\"{name}\"/>");
        }
        let _ = writeln!(text, "    {}", origin(&frame.origin));
        let _ = writeln!(
            text,
            "    <axis xyz=\"{}\"/>",
            super::xml::numbers(&frame.axis)
        );
        for line in limit(joint).into_iter().chain(dynamics(losses)) {
            let _ = writeln!(text, "    {line}");
        }
        text.push_str("  </joint>\n");
        parent = &link.name;
    }
    if tip != Transform::IDENTITY {
        let joints = model.joints.iter().map(|joint| joint.name.as_str());
        let joints: Vec<&str> = joints.collect();
        let (end, fixed) = (free_name("tip", &names), free_name("tip", &joints));
        let _ = writeln!(
            text,
            "  <link name=\"{end}\"/>\n  <joint name=\"{fixed}\" type=\"fixed\">\n    <parent link=\"{parent}\"/>\n    \
             <child link=\"{end}\"/>\n    {}\n  </joint>",
            origin(&tip)
        );
    }
    text.push_str("</robot>\n");
    Ok(text)
}

fn kind(joint: &Joint) -> &'static str {
    match (joint.kind, joint.limits.position) {
        (JointKind::Prismatic, _) => "prismatic",
        (JointKind::Revolute, Some(_)) => "revolute",
        (JointKind::Revolute, None) => "continuous",
    }
}

fn origin(place: &Transform) -> String {
    format!(
        "<origin xyz=\"{}\" rpy=\"{}\"/>",
        numbers(&place.translation),
        numbers(&rpy(&place.rotation))
    )
}

/// `<limit ..>`: all of it where one is there, or where the joint's type asks for it.
fn limit(joint: &Joint) -> Option<String> {
    let limits = &joint.limits;
    let is_silent =
        limits.position.is_none() && limits.velocity.is_none() && limits.torque.is_none();
    if is_silent && joint.kind == JointKind::Revolute {
        return None;
    }
    let mut line = "<limit".to_owned();
    if kind(joint) != "continuous" {
        let (low, high) = limits.position.unwrap_or((-NO_RANGE, NO_RANGE));
        let _ = write!(
            line,
            " lower=\"{}\" upper=\"{}\"",
            number(low),
            number(high)
        );
    }
    let _ = write!(
        line,
        " effort=\"{}\" velocity=\"{}\"/>",
        number(limits.torque.unwrap_or(NO_LIMIT)),
        number(limits.velocity.unwrap_or(NO_LIMIT))
    );
    Some(line)
}

fn dynamics(losses: &JointNumbers) -> Option<String> {
    if losses.damping.is_none() && losses.friction.is_none() {
        return None;
    }
    Some(format!(
        "<dynamics damping=\"{}\" friction=\"{}\"/>",
        number(losses.damping.unwrap_or(0.0)),
        number(losses.friction.unwrap_or(0.0))
    ))
}

/// Sentences about limits that the format wants and the spec does not have.
#[must_use]
pub fn made_up_limits(model: &Model) -> Vec<String> {
    let mut made_up = Vec::new();
    for joint in &model.joints {
        if limit(joint).is_none() {
            continue;
        }
        let limits = &joint.limits;
        let range = limits.position.is_none() && joint.kind == JointKind::Prismatic;
        let wanted = [
            ("range", range),
            ("torque", limits.torque.is_none()),
            ("velocity", limits.velocity.is_none()),
        ];
        let wanted = wanted.iter().filter(|(_, is)| *is).map(|(what, _)| *what);
        let wanted: Vec<&str> = wanted.collect();
        if !wanted.is_empty() {
            made_up.push(format!("`{}` ({})", joint.name, wanted.join(", ")));
        }
    }
    made_up
}

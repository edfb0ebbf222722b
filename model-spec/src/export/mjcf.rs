//! An MJCF model from the frames of a spec.

use std::fmt::Write as _;

use super::frames::{Body, Frame, frames};
use super::xml::{comment, free_name, number, numbers, remark_lines};
use super::{ExportError, JointNumbers, LinkNumbers, Numbers, chain};
use crate::model::{Joint, JointKind, Model, Transform};

/// Writes an MJCF model of the arm: nested bodies with their inertials, hinges and slides with their losses, rotors and springs, a motor
/// for each joint, and a site `tip`. It has no geometries.
///
/// The frame of a body is that of its joint. So links of DH specs have another frame here than in the spec, with the inertials in
/// that; positions of joints mean the same. A motor's control is the joint's torque.
///
/// # Errors
/// [`ExportError::NoChain`] for a robot that says its energies.
pub fn mjcf(model: &Model, numbers: &Numbers) -> Result<String, ExportError> {
    let chain = chain(model)?;
    let (frames, tip) = frames(chain, &model.joints);
    let mut text = format!("<mujoco model=\"{}\">\n", model.name);
    for note in &numbers.notes {
        let _ = writeln!(text, "  <!-- {} -->", comment(note));
    }
    let gravity = super::xml::numbers(&chain.gravity);
    let _ = writeln!(
        text,
        "  <compiler angle=\"radian\" autolimits=\"true\"/>\n  <option gravity=\"{gravity}\"/>\n  <worldbody>"
    );
    let links = chain.links.iter().zip(&numbers.links).zip(&frames);
    let joints = model.joints.iter().zip(&numbers.joints);
    let names = chain.links.iter().map(|link| link.name.as_str());
    let names: Vec<&str> = names.collect();
    for (depth, (((link, own), frame), joint)) in links.zip(joints).enumerate() {
        // What all bodies stand on is MuJoCo's.
        let name = match link.name.as_str() {
            "world" => free_name("world", &names),
            name => name.to_owned(),
        };
        body(&mut text, depth + 2, (&name, own), frame, joint);
    }
    let end = 2 + chain.links.len();
    let _ = writeln!(
        text,
        "{}<site name=\"{}\"{}/>",
        indent(end),
        free_name("tip", &names),
        place(&tip)
    );
    for depth in (2..end).rev() {
        let _ = writeln!(text, "{}</body>", indent(depth));
    }
    text.push_str("  </worldbody>\n  <actuator>\n");
    for joint in &model.joints {
        let name = &joint.name;
        let range = joint.limits.torque.map_or_else(String::new, |most| {
            format!(" ctrlrange=\"{} {}\"", number(-most), number(most))
        });
        let _ = writeln!(text, "    <motor name=\"{name}\" joint=\"{name}\"{range}/>");
    }
    text.push_str("  </actuator>\n</mujoco>\n");
    Ok(text)
}

fn indent(depth: usize) -> String {
    "  ".repeat(depth)
}

/// A body without its end.
fn body(
    text: &mut String,
    depth: usize,
    (name, own): (&str, &LinkNumbers),
    frame: &Frame,
    (joint, acts): (&Joint, &JointNumbers),
) {
    let (outer, inner) = (indent(depth), indent(depth + 1));
    let _ = writeln!(
        text,
        "{outer}<body name=\"{name}\"{}>",
        place(&frame.origin)
    );
    let inertial = Body::new(own.inertial).seen_from(&frame.link);
    if !inertial.is_nothing() {
        for line in remark_lines(&own.remark) {
            let _ = writeln!(text, "{inner}{line}");
        }
        let i = inertial.inertia;
        let six = [i[0][0], i[1][1], i[2][2], i[0][1], i[0][2], i[1][2]];
        let _ = writeln!(
            text,
            "{inner}<inertial pos=\"{}\" mass=\"{}\" fullinertia=\"{}\"/>",
            numbers(&inertial.com),
            number(inertial.mass),
            numbers(&six)
        );
    }
    let kind = match joint.kind {
        JointKind::Revolute => "hinge",
        JointKind::Prismatic => "slide",
    };
    let mut line = format!(
        "<joint name=\"{}\" type=\"{kind}\" axis=\"{}\"",
        joint.name,
        numbers(&frame.axis)
    );
    if let Some((low, high)) = joint.limits.position {
        let _ = write!(line, " range=\"{}\"", numbers(&[low, high]));
    }
    let spring = acts.spring;
    let attributes = [
        ("damping", acts.damping),
        ("frictionloss", acts.friction),
        ("armature", acts.armature),
        ("stiffness", spring.map(|spring| spring.stiffness)),
        ("springref", spring.map(|spring| spring.rest)),
    ];
    for (name, value) in attributes {
        if let Some(value) = value {
            let _ = write!(line, " {name}=\"{}\"", number(value));
        }
    }
    let _ = writeln!(text, "{inner}{line}/>");
}

/// ` pos=".." quat=".."`, what is nothing left out.
fn place(place: &Transform) -> String {
    let mut text = String::new();
    if place.translation.iter().any(|x| *x != 0.0) {
        let _ = write!(text, " pos=\"{}\"", numbers(&place.translation));
    }
    if place.rotation != Transform::IDENTITY.rotation {
        let _ = write!(text, " quat=\"{}\"", numbers(&quaternion(&place.rotation)));
    }
    text
}

/// `[w, x, y, z]` of a rotation, from the largest of the four squares, so that nothing cancels.
///
/// Source: Shepperd 1978, Quaternion from rotation matrix.
fn quaternion(r: &[[f64; 3]; 3]) -> [f64; 4] {
    let trace = r[0][0] + r[1][1] + r[2][2];
    // Four times the square of each.
    let squares = [
        1.0 + trace,
        1.0 + 2.0 * r[0][0] - trace,
        1.0 + 2.0 * r[1][1] - trace,
        1.0 + 2.0 * r[2][2] - trace,
    ];
    let differences = [r[2][1] - r[1][2], r[0][2] - r[2][0], r[1][0] - r[0][1]];
    // Four times the product of two of them.
    let product = |i: usize, j: usize| match (i.min(j), i.max(j)) {
        (i, j) if i == j => squares[i],
        (0, j) => differences[j - 1],
        (i, j) => r[i - 1][j - 1] + r[j - 1][i - 1],
    };
    let largest = (0..4).fold(
        0,
        |best, k| if squares[k] > squares[best] { k } else { best },
    );
    let divisor = 2.0 * squares[largest].sqrt();
    let sign = if product(largest, 0) < 0.0 { -1.0 } else { 1.0 };
    std::array::from_fn(|k| sign * product(largest, k) / divisor + 0.0)
}

#[cfg(test)]
mod tests {
    use super::quaternion;
    use crate::transform::rotation_about;

    #[test]
    fn quaternions_are_those_of_the_rotation() {
        let length = 14.0_f64.sqrt();
        let axes = [
            [1.0, 0.0, 0.0],
            [0.0, -1.0, 0.0],
            [1.0 / length, 2.0 / length, -3.0 / length],
        ];
        for axis in axes {
            for angle in [0.0, 0.3, 1.57, 2.0, 3.1] {
                let half = 0.5 * angle;
                let wanted = [
                    f64::cos(half),
                    axis[0] * f64::sin(half),
                    axis[1] * f64::sin(half),
                    axis[2] * f64::sin(half),
                ];
                let found = quaternion(&rotation_about(axis, angle));
                for (found, wanted) in found.iter().zip(wanted) {
                    assert!((found - wanted).abs() < 1e-12, "{axis:?} {angle}");
                }
            }
        }
    }
}

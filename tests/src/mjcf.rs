//! A reader of the part of MJCF that `export` writes: nested bodies as a spec with frames of URDF style.

use std::collections::BTreeMap;
use std::fmt::Write;

use nalgebra::{Quaternion, UnitQuaternion};
use roxmltree::{Document, Node};

/// Numbers of an attribute; zeros, so many, where it is not there.
fn numbers(node: Node, name: &str, otherwise: &[f64]) -> Vec<f64> {
    let text = node.attribute(name);
    text.map_or_else(
        || otherwise.to_vec(),
        |text| {
            let words = text.split_whitespace();
            words.map(|word| word.parse().expect("a number")).collect()
        },
    )
}

fn child<'a, 'input>(node: Node<'a, 'input>, name: &str) -> Option<Node<'a, 'input>> {
    let mut children = node.children().filter(|child| child.has_tag_name(name));
    let first = children.next();
    assert!(children.next().is_none(), "one `{name}`");
    first
}

/// Bodies from the base to the tip.
fn bodies<'a, 'input>(document: &'a Document<'input>) -> Vec<Node<'a, 'input>> {
    let root = document.root_element();
    assert!(root.has_tag_name("mujoco"));
    let compiler = child(root, "compiler").expect("a compiler");
    assert_eq!(compiler.attribute("angle"), Some("radian"));
    let mut bodies = Vec::new();
    let mut at = child(root, "worldbody").and_then(|world| child(world, "body"));
    while let Some(body) = at {
        bodies.push(body);
        at = child(body, "body");
    }
    bodies
}

/// The spec of a chain of bodies, with inertials that are fixed.
///
/// # Panics
/// Where the text is no such model.
#[must_use]
pub fn spec(text: &str) -> String {
    let document = Document::parse(text).expect("well-formed XML");
    let option = child(document.root_element(), "option").expect("options");
    let gravity = numbers(option, "gravity", &[]);
    let (mut joints, mut links) = (String::new(), String::new());
    for body in bodies(&document) {
        let name = body.attribute("name").expect("a name");
        let joint = child(body, "joint").expect("a joint");
        let kind = match joint.attribute("type") {
            Some("hinge") => "revolute",
            Some("slide") => "prismatic",
            other => panic!("{other:?}"),
        };
        let place = numbers(body, "pos", &[0.0; 3]);
        let q = numbers(body, "quat", &[1.0, 0.0, 0.0, 0.0]);
        let rotation = UnitQuaternion::from_quaternion(Quaternion::new(q[0], q[1], q[2], q[3]));
        let (roll, pitch, yaw) = rotation.euler_angles();
        let range = numbers(joint, "range", &[]);
        let range = match range[..] {
            [low, high] => format!(" position = {low} rad .. {high} rad;"),
            _ => String::new(),
        };
        let range = if kind == "prismatic" {
            range.replace(" rad", "")
        } else {
            range
        };
        let axis = numbers(joint, "axis", &[]);
        let joint = joint.attribute("name").expect("a name");
        writeln!(
            joints,
            "joint {joint}: {kind} {{ xyz = {place:?}; rpy = [{roll} rad, {pitch} rad, {yaw} rad]; axis = {axis:?};{range} link = {name}; }}"
        )
        .expect("a string takes all");
        if let Some(inertial) = child(body, "inertial") {
            let com = numbers(inertial, "pos", &[]);
            let [xx, yy, zz, xy, xz, yz] = numbers(inertial, "fullinertia", &[])[..] else {
                panic!("six numbers");
            };
            let mass = numbers(inertial, "mass", &[])[0];
            let six = [xx, xy, xz, yy, yz, zz];
            writeln!(
                links,
                "link {name}: fixed {{ mass = {mass}; com = {com:?}; inertia = {six:?}; }}"
            )
            .expect("a string takes all");
        }
    }
    format!("robot Read {{ gravity = {gravity:?}; convention = origin;\n{joints}{links}}}\n")
}

/// Attributes of the joints, from the base to the tip.
///
/// # Panics
/// Where the text is no such model.
#[must_use]
pub fn joints(text: &str) -> Vec<BTreeMap<String, String>> {
    let document = Document::parse(text).expect("well-formed XML");
    let joints = bodies(&document).into_iter();
    let joints = joints.map(|body| child(body, "joint").expect("a joint"));
    let all = |joint: Node| {
        let attributes = joint.attributes();
        let pair = |own: roxmltree::Attribute| (own.name().to_owned(), own.value().to_owned());
        attributes.map(pair).collect()
    };
    joints.map(all).collect()
}

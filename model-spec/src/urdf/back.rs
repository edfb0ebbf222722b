//! Numbers of an arm back into the URDF that its spec was imported from.
//!
//! Every byte stays but those of `<inertial>` of the links that are identified, of `damping` and `friction` of their joints, and of one
//! comment at the top. What is held against a link keeps its inertial, and the link takes the rest.

use std::ops::Range;

use roxmltree::{Document, Node};
use urdf_rs::JointType;

use super::body::{body, parts, sum};
use super::edit::Edits;
use super::tree::{Chain, ChainJoint, Tree};
use super::write::Names;
use super::{ImportError, place, size};
use crate::export::{Body, ExportError, JointNumbers, Numbers, chain as chain_of, inertial_lines};
use crate::inertia::surely_has_a_body;
use crate::model::{JointKind, Model, Transform};

/// Frames are the same where they differ by less: m, and entries of rotations.
const SAME_FRAME: f64 = 1e-6;

/// Inertials are the same where they differ by less, as a share of the largest.
const SAME_BODY: f64 = 1e-10;

/// A URDF with other numbers.
#[derive(Debug, Clone, PartialEq, Eq)]
#[non_exhaustive]
pub struct WrittenBack {
    /// Its text.
    pub urdf: String,
    /// What is remarkable about it.
    pub notes: Vec<String>,
}

/// Writes numbers into the URDF from which the spec of a robot was imported.
///
/// # Errors
/// [`ExportError`] where the text is no URDF, has other joints than the spec, or has them elsewhere.
pub fn write_back(
    urdf: &str,
    model: &Model,
    numbers: &Numbers,
) -> Result<WrittenBack, ExportError> {
    chain_of(model)?;
    let parse = |said: String| ExportError::Parse(place::explain(urdf, &said));
    let checked = size::check(urdf).and_then(|()| place::check_elements(urdf));
    checked.map_err(|error| match error {
        ImportError::Parse(fault) => ExportError::Parse(fault),
        other => ExportError::Original(other.to_string()),
    })?;
    let robot = urdf_rs::read_from_string(urdf).map_err(|error| parse(error.to_string()))?;
    let document = Document::parse(urdf).map_err(|error| parse(error.to_string()))?;
    let original = |error: ImportError| ExportError::Original(error.to_string());
    let tree = Tree::new(&robot).map_err(original)?;
    let chain = chain_of_spec(&tree, model)?;
    check_frames(&chain, model)?;

    let mut text = Edits::new(urdf);
    let mut notes = Vec::new();
    let root = document.root_element();
    text.note(root, &numbers.notes);
    for (k, joint) in chain.joints.iter().enumerate() {
        let own = &numbers.links[k];
        let whole = Body::new(own.inertial);
        for (link, body) in shares(&tree, &chain, joint, &whole, &mut notes)? {
            let node = named(root, "link", link)?;
            match body {
                Some(body) => text.inertial(node, &inertial_lines(&body, &own.remark)),
                None => text.remove_inertial(node),
            }
        }
        let node = named(root, "joint", &joint.joint.name)?;
        text.dynamics(node, &numbers.joints[k]);
        notes.extend(undeclared(joint, &numbers.joints[k]));
    }
    Ok(WrittenBack {
        urdf: text.done(),
        notes,
    })
}

/// The chain whose joints the spec has, by the names that import gives them.
fn chain_of_spec<'a>(tree: &Tree<'a>, model: &Model) -> Result<Chain<'a>, ExportError> {
    let wanted: Vec<&str> = model
        .joints
        .iter()
        .map(|joint| joint.name.as_str())
        .collect();
    let moving: Vec<_> = tree.moving().filter_map(|name| tree.joint(name)).collect();
    for first in &moving {
        for last in &moving {
            let (base, tip) = (first.parent.link.as_str(), last.child.link.as_str());
            let Ok(chain) = tree.chain(Some(base), Some(tip)) else {
                continue;
            };
            if Names::new(&chain).joints == wanted {
                return Ok(chain);
            }
        }
    }
    Err(ExportError::OtherJoints(
        wanted.into_iter().map(str::to_owned).collect(),
    ))
}

/// Links have the same frames in both. Where the first joint stands is of no link.
fn check_frames(chain: &Chain, model: &Model) -> Result<(), ExportError> {
    let links = model.chain().into_iter().flat_map(|chain| &chain.links);
    let joints = chain.joints.iter().zip(&model.joints).zip(links);
    for (k, ((there, joint), link)) in joints.enumerate() {
        let refuse = |differs: &'static str| {
            Err(ExportError::OtherFrames {
                joint: joint.name.clone(),
                differs,
            })
        };
        let slides = there.joint.joint_type == JointType::Prismatic;
        if slides != (joint.kind == JointKind::Prismatic) {
            return refuse("has another type");
        }
        let placement = &link.placement;
        let axis = there.joint.axis.xyz.0;
        let length = axis.iter().map(|x| x * x).sum::<f64>().sqrt();
        let apart = |(x, y): (&f64, &f64)| (x - y).abs() > SAME_FRAME;
        let unit = axis.map(|x| x / length);
        if unit.iter().zip(&placement.axis).any(apart) {
            return refuse("has another axis");
        }
        let is_elsewhere = |x: &Transform, y: &Transform| {
            let (x, y) = (entries(x), entries(y));
            x.iter().zip(&y).any(apart)
        };
        if is_elsewhere(&placement.after, &Transform::IDENTITY)
            || (k > 0 && is_elsewhere(&placement.before, &there.origin))
        {
            return refuse("stands elsewhere");
        }
    }
    Ok(())
}

fn entries(place: &Transform) -> Vec<f64> {
    let rotation = place.rotation.iter().flatten();
    rotation.chain(&place.translation).copied().collect()
}

/// Links whose inertials change: the one of the chain takes what those that are held against it leave, or all where they leave no body.
/// Nothing stands for an inertial that goes.
fn shares<'a>(
    tree: &Tree<'a>,
    chain: &Chain,
    joint: &ChainJoint<'a>,
    whole: &Body,
    notes: &mut Vec<String>,
) -> Result<Vec<(&'a str, Option<Body>)>, ExportError> {
    let original = |error: ImportError| ExportError::Original(error.to_string());
    let (parts, _) = parts(tree, chain, joint).map_err(original)?;
    let bodies = parts.iter().map(|(link, pose)| body(link, pose));
    let bodies: Vec<Body> = bodies.collect::<Result<_, _>>().map_err(original)?;
    if is_same(&sum(&bodies), whole) {
        return Ok(Vec::new());
    }
    let (Some((link, _)), [_, others @ ..]) = (parts.first(), bodies.as_slice()) else {
        return Ok(Vec::new());
    };
    let held = sum(others).ten();
    let ten = whole.ten();
    let rest = Body::new(std::array::from_fn(|k| ten[k] - held[k]));
    if held.iter().all(|x| *x == 0.0) || is_body(&rest) {
        return Ok(vec![(link.name.as_str(), Some(rest))]);
    }
    let heavy = parts.iter().skip(1).zip(others);
    let heavy = heavy.filter(|(_, body)| !body.is_nothing());
    let gone: Vec<&str> = heavy.map(|((link, _), _)| link.name.as_str()).collect();
    notes.push(format!(
        "link `{}` carries the inertials of {}, which are heavier than the identified sum of all",
        link.name,
        crate::suggest::list(gone.iter().copied())
    ));
    let gone = gone.into_iter().map(|name| (name, None));
    Ok(std::iter::once((link.name.as_str(), Some(*whole)))
        .chain(gone)
        .collect())
}

fn is_body(body: &Body) -> bool {
    body.mass > 0.0 && surely_has_a_body(&body.inertia)
}

fn is_same(x: &Body, y: &Body) -> bool {
    let (x, y) = (x.ten(), y.ten());
    let largest = |range: Range<usize>| range.map(|k| y[k].abs()).fold(0.0, f64::max);
    let size = [largest(0..1), largest(1..4), largest(4..10)];
    (0..10).all(|k| {
        let size = size[match k {
            0 => 0,
            1..4 => 1,
            _ => 2,
        }];
        (x[k] - y[k]).abs() <= SAME_BODY * size
    })
}

/// Losses of the URDF that the spec has not.
fn undeclared(joint: &ChainJoint, numbers: &JointNumbers) -> Vec<String> {
    let Some(dynamics) = &joint.joint.dynamics else {
        return Vec::new();
    };
    let values = [
        ("damping", dynamics.damping, numbers.damping),
        ("friction", dynamics.friction, numbers.friction),
    ];
    let kept = values
        .iter()
        .filter(|(_, old, new)| *old != 0.0 && new.is_none());
    kept.map(|(what, old, _)| {
        format!(
            "joint `{}` keeps its {what} of {old}: the spec declares no such effect",
            joint.joint.name
        )
    })
    .collect()
}

/// A link or joint of the robot by its name.
fn named<'a, 'input>(
    root: Node<'a, 'input>,
    kind: &str,
    name: &str,
) -> Result<Node<'a, 'input>, ExportError> {
    let mut all = root.children();
    let found = all.find(|node| node.has_tag_name(kind) && node.attribute("name") == Some(name));
    // Two readers read it, and blanks around a name are some to the one only.
    found.ok_or_else(|| {
        ExportError::Original(format!(
            "{kind} `{name}` is not written as `<{kind} name=\"{name}\"`: write its name so"
        ))
    })
}

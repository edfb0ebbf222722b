//! What a link of the chain carries: its own inertial and those of everything that is held against it.

use urdf_rs::{JointType, Link};

use super::held::Held;
use super::pose::{origin, origin_of};
use super::tree::{Chain, ChainJoint, Tree};
use super::{ImportError, Inertials, UrdfPart};
use crate::export::Body;
use crate::inertia::has_a_body;
use crate::model::Transform;
use crate::transform::is_in_range;

/// What hangs on a joint of the chain down to the next one, as one body.
pub(super) struct Carried<'a> {
    pub(super) body: Body,
    /// Moving joints of side branches, which stand still.
    pub(super) held: Vec<Held<'a>>,
}

/// Collects what moves together with the link behind `joint`.
pub(super) fn carried<'a>(
    tree: &Tree<'a>,
    chain: &Chain,
    joint: &ChainJoint<'a>,
    inertials: Inertials,
) -> Result<Carried<'a>, ImportError> {
    let (parts, held) = parts(tree, chain, joint)?;
    let mut bodies = Vec::new();
    for (link, pose) in parts {
        if inertials != Inertials::None {
            check(link)?;
        }
        bodies.push(body(link, &pose)?);
    }
    Ok(Carried {
        body: sum(&bodies),
        held,
    })
}

/// Links that move together, with their place in the frame of the first, and moving joints that are held.
pub(super) type Parts<'a> = (Vec<(&'a Link, Transform)>, Vec<Held<'a>>);

/// The link behind `joint` and all that hangs on it down to the next joint of the chain.
pub(super) fn parts<'a>(
    tree: &Tree<'a>,
    chain: &Chain,
    joint: &ChainJoint<'a>,
) -> Result<Parts<'a>, ImportError> {
    let (mut parts, mut held) = (Vec::new(), Vec::new());
    let mut open = vec![(joint.joint.child.link.as_str(), Transform::IDENTITY)];
    while let Some((name, pose)) = open.pop() {
        if let Some(link) = tree.links.get(name) {
            parts.push((*link, pose));
        }
        for next in tree.joints_of(name) {
            if chain.index(next).is_some() {
                continue;
            }
            let here = origin_of(next)?;
            let mut behind = pose.then(&here);
            if next.joint_type != JointType::Fixed {
                let joint = Held::new(tree, chain, next)?;
                behind = behind.then(&joint.motion());
                held.push(joint);
            }
            open.push((next.child.link.as_str(), behind));
        }
    }
    Ok((parts, held))
}

/// Links that the URDF gives no mass, as it does by leaving `<inertial>` out. It means that they weigh nothing.
pub(super) fn massless(links: &[String], carried: &[Carried]) -> Vec<String> {
    let nothing = links.iter().zip(carried).filter(|(_, carried)| {
        let body = &carried.body;
        body.mass == 0.0 && body.inertia.iter().flatten().all(|x| *x == 0.0)
    });
    nothing
        .map(|(link, _)| {
            format!(
                "link `{link}` has no inertial, which in a URDF means that it weighs nothing: delete its block where its mass is \
                 unknown"
            )
        })
        .collect()
}

/// Inertias on the chain that no body has.
pub(super) fn impossible(links: &[String], carried: &[Carried]) -> Vec<String> {
    let wrong = links
        .iter()
        .zip(carried)
        .filter(|(_, carried)| !has_a_body(&carried.body.inertia, 0.0));
    wrong
        .map(|(link, _)| {
            format!(
                "link `{link}` has a physically impossible inertia: about the center of mass each principal moment must be positive and at most \
                 the sum of the other two"
            )
        })
        .collect()
}

/// What the language refuses, in the words of the URDF.
fn check(link: &Link) -> Result<(), ImportError> {
    let refuse = |name: &'static str, reason: String| {
        let part = match name {
            "mass" => UrdfPart::of_link(&link.name, "inertial/mass").attribute("value"),
            name => UrdfPart::of_link(&link.name, "inertial/inertia").attribute(name),
        };
        Err(ImportError::Inertial {
            link: link.name.clone(),
            reason,
            part,
        })
    };
    let (mass, i) = (link.inertial.mass.value, &link.inertial.inertia);
    let named = [
        ("mass", mass),
        ("ixx", i.ixx),
        ("ixy", i.ixy),
        ("ixz", i.ixz),
        ("iyy", i.iyy),
        ("iyz", i.iyz),
        ("izz", i.izz),
    ];
    for (name, value) in named.into_iter().filter(|(_, value)| value.is_finite()) {
        if !is_in_range(value) {
            return refuse(
                name,
                format!(
                    "`{name}` {value:e}, too large or too small to compute with: write zero, or a value between 1e-30 and 1e30"
                ),
            );
        }
        if value < 0.0 && ["mass", "ixx", "iyy", "izz"].contains(&name) {
            return refuse(
                name,
                format!("a negative `{name}`, {value}: write zero or more"),
            );
        }
    }
    Ok(())
}

/// A link's own body, in the frame in which the link is at `pose`.
pub(super) fn body(link: &Link, pose: &Transform) -> Result<Body, ImportError> {
    let inertial = &link.inertial;
    let what = format!("the inertial of link `{}`", link.name);
    let part = UrdfPart::of_link(&link.name, "inertial/origin");
    let frame = pose.then(&origin(&inertial.origin, &what, part)?);
    let i = &inertial.inertia;
    let here = [
        [i.ixx, i.ixy, i.ixz],
        [i.ixy, i.iyy, i.iyz],
        [i.ixz, i.iyz, i.izz],
    ];
    if !here
        .iter()
        .flatten()
        .chain([&inertial.mass.value])
        .all(|x| x.is_finite())
    {
        let part = Some(UrdfPart::of_link(&link.name, "inertial"));
        return Err(ImportError::NotFinite { what, part });
    }
    let own = Body {
        mass: inertial.mass.value,
        com: [0.0; 3],
        inertia: here,
    };
    Ok(own.seen_from(&frame))
}

/// Bodies that are screwed together: masses add, inertias add about the common center of mass (Steiner).
pub(super) fn sum(bodies: &[Body]) -> Body {
    let present: Vec<&Body> = bodies
        .iter()
        .filter(|body| body.mass != 0.0 || body.inertia.iter().flatten().any(|x| *x != 0.0))
        .collect();
    match present.as_slice() {
        [] => {
            return Body {
                mass: 0.0,
                com: [0.0; 3],
                inertia: [[0.0; 3]; 3],
            };
        }
        [only] => return **only,
        _ => {}
    }
    let mass: f64 = present.iter().map(|body| body.mass).sum();
    let com = if mass == 0.0 {
        [0.0; 3]
    } else {
        std::array::from_fn(|k| {
            present
                .iter()
                .map(|body| body.mass * body.com[k])
                .sum::<f64>()
                / mass
        })
    };
    let mut inertia = [[0.0; 3]; 3];
    for body in present {
        let d: [f64; 3] = std::array::from_fn(|k| body.com[k] - com[k]);
        let square = d.iter().map(|x| x * x).sum::<f64>();
        for row in 0..3 {
            for column in 0..3 {
                let diagonal = if row == column { square } else { 0.0 };
                inertia[row][column] +=
                    body.inertia[row][column] + body.mass * (diagonal - d[row] * d[column]);
            }
        }
    }
    Body { mass, com, inertia }
}

#[cfg(test)]
mod tests {
    #![expect(clippy::float_cmp, reason = "these numbers are exact")]

    use super::{Body, sum};

    #[test]
    fn a_dumbbell_has_the_inertia_of_two_points() {
        let point = |x: f64| Body {
            mass: 2.0,
            com: [x, 0.0, 0.0],
            inertia: [[0.0; 3]; 3],
        };
        let dumbbell = sum(&[point(0.0), point(1.0)]);
        assert_eq!(dumbbell.mass, 4.0);
        assert_eq!(dumbbell.com, [0.5, 0.0, 0.0]);
        assert_eq!(
            dumbbell.inertia,
            [[0.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]
        );
    }
}

//! Moving joints beside the chain, which the spec holds where they are.

use urdf_rs::{Joint, JointType};

use super::ImportError;
use super::body::Carried;
use super::mimic::ties;
use super::tree::{Chain, Tree, without_direction};
use super::write::number;
use crate::model::Transform;
use crate::transform::rotation_about;

/// A joint of a side branch, and where it stands.
pub(super) struct Held<'a> {
    joint: &'a Joint,
    /// rad or m.
    position: f64,
    /// The joint of the chain that it follows, if there is one.
    follows: Option<&'a str>,
}

impl<'a> Held<'a> {
    /// A joint that mimics another stands at `multiplier * position + offset` of that one; all others, joints of the chain
    /// among them, at zero.
    pub(super) fn new(
        tree: &Tree<'a>,
        chain: &Chain,
        joint: &'a Joint,
    ) -> Result<Self, ImportError> {
        let ties = ties(tree, joint)?;
        let on_chain = ties.iter().find(|tie| chain.index(tie.leader).is_some());
        let held = Self {
            joint,
            position: on_chain.or(ties.last()).map_or(0.0, |tie| tie.offset),
            follows: on_chain.map(|tie| tie.leader.name.as_str()),
        };
        if held.position != 0.0 && held.direction().is_none() {
            return Err(without_direction(&joint.name));
        }
        Ok(held)
    }

    /// Unit vector of a joint that turns about or slides along one.
    fn direction(&self) -> Option<[f64; 3]> {
        let axis = self.joint.axis.xyz.0;
        let length = axis.iter().map(|x| x * x).sum::<f64>().sqrt();
        (length > 0.0 && length.is_finite()).then(|| axis.map(|x| x / length))
    }

    /// From where the joint is zero to where it stands.
    pub(super) fn motion(&self) -> Transform {
        let Some(axis) = self.direction() else {
            return Transform::IDENTITY;
        };
        match self.joint.joint_type {
            JointType::Revolute | JointType::Continuous => Transform {
                rotation: rotation_about(axis, self.position),
                ..Transform::IDENTITY
            },
            JointType::Prismatic => Transform {
                translation: axis.map(|x| x * self.position),
                ..Transform::IDENTITY
            },
            JointType::Fixed | JointType::Floating | JointType::Planar | JointType::Spherical => {
                Transform::IDENTITY
            }
        }
    }

    /// "finger", "finger at 0.3"
    pub(super) fn describe(&self) -> String {
        let name = &self.joint.name;
        if self.position == 0.0 {
            name.clone()
        } else {
            format!("{name} at {}", number(self.position))
        }
    }
}

/// Followers of the chain's joints whose mass the spec holds still.
pub(super) fn warnings(tree: &Tree, carried: &[Carried]) -> Vec<String> {
    let held = carried.iter().flat_map(|carried| &carried.held);
    held.filter_map(|held| {
        let leader = held.follows?;
        let mass = mass_behind(tree, held.joint);
        let name = &held.joint.name;
        (mass > 0.0).then(|| {
            format!(
                "joint `{name}` follows joint `{leader}` of the chain with {} kg: the spec holds it where `{leader}` is zero, so \
                 its own motion is missing in the equations",
                number(mass)
            )
        })
    })
    .collect()
}

/// Mass of everything that moves with a joint, kg.
fn mass_behind(tree: &Tree, joint: &Joint) -> f64 {
    let mut open = vec![joint.child.link.as_str()];
    let mut mass = 0.0;
    while let Some(link) = open.pop() {
        mass += tree
            .links
            .get(link)
            .map_or(0.0, |link| link.inertial.mass.value);
        open.extend(
            tree.joints_of(link)
                .iter()
                .map(|next| next.child.link.as_str()),
        );
    }
    mass
}

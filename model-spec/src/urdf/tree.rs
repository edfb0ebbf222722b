//! The tree of links, and the one chain of it that is imported.

use std::collections::{BTreeMap, BTreeSet};

use urdf_rs::{Joint, JointType, Link, Robot};

use super::pose::{meant, origin_of};
use super::{ImportError, UrdfPart};
use crate::model::Transform;
use crate::suggest;

/// Links and joints by name; every link has one parent joint at most, and there are no loops.
pub(super) struct Tree<'a> {
    pub(super) links: BTreeMap<&'a str, &'a Link>,
    joints: BTreeMap<&'a str, &'a Joint>,
    parent: BTreeMap<&'a str, &'a Joint>,
    children: BTreeMap<&'a str, Vec<&'a Joint>>,
}

/// Moving joints from base to tip.
pub(super) struct Chain<'a> {
    pub(super) base: &'a str,
    pub(super) joints: Vec<ChainJoint<'a>>,
    /// Where its last link is in the frame of the last one that moves: fixed joints behind that, folded.
    pub(super) tip: [f64; 3],
}

/// A moving joint with the fixed joints before it folded into its frame.
pub(super) struct ChainJoint<'a> {
    pub(super) joint: &'a Joint,
    /// Pose of the joint's frame in the frame of the moving link before it.
    pub(super) origin: Transform,
    /// `xyz` and `rpy` as written, where nothing was folded.
    pub(super) written: Option<([f64; 3], [f64; 3])>,
}

impl Chain<'_> {
    /// Place of a joint on the chain, if it is one of its moving joints.
    pub(super) fn index(&self, joint: &Joint) -> Option<usize> {
        self.joints
            .iter()
            .position(|moving| moving.joint.name == joint.name)
    }
}

impl<'a> Tree<'a> {
    pub(super) fn new(robot: &'a Robot) -> Result<Self, ImportError> {
        let links: BTreeMap<&str, &Link> = robot
            .links
            .iter()
            .map(|link| (link.name.as_str(), link))
            .collect();
        let mut seen = BTreeSet::new();
        let mut names = robot.links.iter().map(|link| link.name.as_str());
        if let Some(twice) = names.find(|name| !seen.insert(*name)) {
            return Err(ImportError::Structure {
                reason: format!("two links have the name `{twice}`: rename one of them"),
                part: Some(UrdfPart::of_link(twice, "").attribute("name")),
            });
        }
        let mut tree = Self {
            links,
            joints: robot
                .joints
                .iter()
                .map(|joint| (joint.name.as_str(), joint))
                .collect(),
            parent: BTreeMap::new(),
            children: BTreeMap::new(),
        };
        for joint in &robot.joints {
            let (parent, child) = (joint.parent.link.as_str(), joint.child.link.as_str());
            let named_by =
                |element| Some(UrdfPart::of_joint(&joint.name, element).attribute("link"));
            tree.link(parent, named_by("parent"))?;
            tree.link(child, named_by("child"))?;
            if let Some(other) = tree.parent.insert(child, joint) {
                return Err(ImportError::Structure {
                    reason: format!(
                        "link `{child}` has two parents, joints `{}` and `{}`: cut the loop, only open chains are supported",
                        other.name, joint.name
                    ),
                    part: named_by("child"),
                });
            }
            tree.children.entry(parent).or_default().push(joint);
        }
        tree.check_no_loops()?;
        Ok(tree)
    }

    fn check_no_loops(&self) -> Result<(), ImportError> {
        for link in self.links.keys() {
            if self.joints_above(link).count() > self.links.len() {
                return Err(ImportError::Structure {
                    reason: format!("link `{link}` is part of a loop of joints: cut the loop"),
                    part: Some(UrdfPart::of_link(link, "").attribute("name")),
                });
            }
        }
        Ok(())
    }

    /// Joints from a link towards the root; stops one joint late in a loop.
    fn joints_above(&self, link: &str) -> impl Iterator<Item = &'a Joint> {
        let mut next = self.parent.get(link).copied();
        let up = std::iter::from_fn(move || {
            let joint = next?;
            next = self.parent.get(joint.parent.link.as_str()).copied();
            Some(joint)
        });
        up.take(self.links.len() + 1)
    }

    /// The link of a name that `part` of the text gives, or an argument.
    fn link(&self, name: &str, part: Option<UrdfPart>) -> Result<&'a str, ImportError> {
        self.links
            .get_key_value(name)
            .map(|(_, link)| link.name.as_str())
            .ok_or_else(|| ImportError::UnknownLink {
                name: name.to_owned(),
                help: suggest::help(name, self.links.keys().copied()),
                part,
            })
    }

    pub(super) fn joint(&self, name: &str) -> Option<&'a Joint> {
        self.joints.get(name).copied()
    }

    /// Names of the joints that move.
    pub(super) fn moving(&self) -> impl Iterator<Item = &'a str> + Clone {
        let moving = |joint: &&&Joint| joint.joint_type != JointType::Fixed;
        self.joints
            .values()
            .filter(moving)
            .map(|joint| joint.name.as_str())
    }

    pub(super) fn joints_of(&self, link: &str) -> &[&'a Joint] {
        self.children.get(link).map_or(&[], Vec::as_slice)
    }

    /// The chain between two links, or the only one there is.
    pub(super) fn chain(
        &self,
        base: Option<&str>,
        tip: Option<&str>,
    ) -> Result<Chain<'a>, ImportError> {
        let base = match base {
            Some(base) => self.link(base, None)?,
            None => self.root()?,
        };
        let is_open = tip.is_none();
        let tip = match tip {
            Some(tip) => self.link(tip, None)?,
            None => self.only_tip(base)?,
        };
        let mut path = Vec::new();
        let mut at = tip;
        for joint in self.joints_above(tip) {
            if at == base {
                break;
            }
            path.push(joint);
            at = joint.parent.link.as_str();
        }
        if at != base {
            return Err(ImportError::structure(format!(
                "link `{tip}` does not hang on link `{base}`: choose another --base or --tip"
            )));
        }
        path.reverse();
        if is_open {
            path.extend(self.fixed_behind(tip));
        }
        let (joints, behind) = fold(&path)?;
        let chain = Chain {
            base,
            joints,
            tip: behind,
        };
        if chain.joints.is_empty() {
            return Err(ImportError::structure(format!(
                "no joint moves on the way from link `{base}` to link `{tip}`"
            )));
        }
        Ok(chain)
    }

    fn root(&self) -> Result<&'a str, ImportError> {
        let roots: Vec<&str> = self
            .links
            .values()
            .map(|link| link.name.as_str())
            .filter(|link| !self.parent.contains_key(link))
            .collect();
        match roots.as_slice() {
            [root] => Ok(root),
            [] => Err(ImportError::structure("the URDF has no links".to_owned())),
            several => Err(ImportError::structure(format!(
                "the links form several trees: choose one with --base, {}",
                suggest::list(several.iter().copied())
            ))),
        }
    }

    /// Fixed joints behind a link while there is one only: they lead to the flange.
    fn fixed_behind(&self, tip: &str) -> Vec<&'a Joint> {
        let mut behind: Vec<&Joint> = Vec::new();
        let mut at = tip;
        while let [joint] = self.joints_of(at) {
            if joint.joint_type != JointType::Fixed {
                break;
            }
            behind.push(joint);
            at = &joint.child.link;
        }
        behind
    }

    /// Follows moving branches while there is one only.
    fn only_tip(&self, base: &'a str) -> Result<&'a str, ImportError> {
        let mut at = base;
        loop {
            let moving: Vec<&&Joint> = self
                .joints_of(at)
                .iter()
                .filter(|joint| !self.tips(joint).is_empty())
                .collect();
            match moving.as_slice() {
                [] => return Ok(at),
                [joint] => at = joint.child.link.as_str(),
                several => {
                    let tips = several.iter().flat_map(|joint| self.tips(joint));
                    return Err(ImportError::Branches {
                        at: at.to_owned(),
                        is_hand: self.is_hand(base, at, several),
                        tips: tips.map(str::to_owned).collect(),
                    });
                }
            }
        }
    }

    /// Whether the branches that a link carries are fingers of a gripper: shorter than the way to them, and all of them but one at most slide or
    /// move with another joint, as neither a camera on a joint of its own nor the rest of an arm does.
    fn is_hand(&self, base: &str, at: &str, branches: &[&&'a Joint]) -> bool {
        let way = self.joints_above(at);
        let way = way.take_while(|joint| joint.child.link != base);
        let moves = |joint: &&Joint| joint.joint_type != JointType::Fixed;
        let behind = way.filter(moves).count();
        let deepest = branches.iter().map(|joint| self.depth(joint)).max();
        let is_finger =
            |joint: &&&&Joint| joint.joint_type == JointType::Prismatic || joint.mimic.is_some();
        let are_fingers = branches.iter().filter(is_finger).count() + 1 >= branches.len();
        are_fingers && behind > deepest.unwrap_or(0)
    }

    /// How many joints move on the longest way that begins with one.
    fn depth(&self, joint: &'a Joint) -> usize {
        let (mut most, mut open) = (0, vec![(joint, 0)]);
        while let Some((joint, above)) = open.pop() {
            let count = above + usize::from(joint.joint_type != JointType::Fixed);
            most = most.max(count);
            let below = self.joints_of(&joint.child.link).iter();
            open.extend(below.map(|joint| (*joint, count)));
        }
        most
    }

    /// Links behind `joint` that a joint moves and that carry no further moving joint; in the order of the text.
    fn tips(&self, joint: &'a Joint) -> Vec<&'a str> {
        let mut tips = Vec::new();
        let mut open = vec![joint];
        while let Some(joint) = open.pop() {
            let below = self.joints_of(&joint.child.link);
            open.extend(below.iter().rev());
            let mut behind: Vec<&Joint> = below.to_vec();
            let mut is_last = joint.joint_type != JointType::Fixed;
            while let (true, Some(next)) = (is_last, behind.pop()) {
                is_last = next.joint_type == JointType::Fixed;
                behind.extend(self.joints_of(&next.child.link));
            }
            if is_last {
                tips.push(joint.child.link.as_str());
            }
        }
        tips
    }
}

/// Fixed joints go into the frame of the moving joint behind them.
fn fold<'a>(path: &[&'a Joint]) -> Result<(Vec<ChainJoint<'a>>, [f64; 3]), ImportError> {
    let mut joints = Vec::new();
    let mut before: Option<Transform> = None;
    for joint in path {
        let here = origin_of(joint)?;
        let folded = before.map_or(here, |before| before.then(&here));
        if joint.joint_type == JointType::Fixed {
            before = Some(folded);
            continue;
        }
        check_kind(joint)?;
        let written = before
            .is_none()
            .then_some((joint.origin.xyz.0, joint.origin.rpy.0.map(meant)));
        joints.push(ChainJoint {
            joint,
            origin: folded,
            written,
        });
        before = None;
    }
    let tip = before.map_or([0.0; 3], |behind| behind.translation);
    Ok((joints, tip))
}

/// What is said of an axis of zeros.
pub(super) fn without_direction(joint: &str) -> ImportError {
    ImportError::Joint {
        joint: joint.to_owned(),
        reason: "has an axis without direction: write its `<axis xyz=..>`".to_owned(),
        part: UrdfPart::of_joint(joint, "axis").attribute("xyz"),
    }
}

fn check_kind(joint: &Joint) -> Result<(), ImportError> {
    let refuse = |part: UrdfPart, reason: String| {
        Err(ImportError::Joint {
            joint: joint.name.clone(),
            reason,
            part,
        })
    };
    let kind = UrdfPart::of_joint(&joint.name, "").attribute("type");
    match joint.joint_type {
        JointType::Revolute | JointType::Continuous | JointType::Prismatic | JointType::Fixed => {}
        JointType::Floating => {
            return refuse(
                kind,
                "is floating: an arm stands on a base, choose --base beyond this joint".to_owned(),
            );
        }
        JointType::Planar => {
            return refuse(
                kind,
                "is planar: write it as two prismatic joints".to_owned(),
            );
        }
        JointType::Spherical => {
            return refuse(
                kind,
                "is spherical: write it as three revolute joints".to_owned(),
            );
        }
    }
    if !joint.axis.xyz.iter().all(|x| x.is_finite()) || joint.axis.xyz.iter().all(|x| *x == 0.0) {
        return Err(without_direction(&joint.name));
    }
    let limit = &joint.limit;
    if joint.joint_type != JointType::Continuous && limit.lower > limit.upper {
        let part = UrdfPart::of_joint(&joint.name, "limit").attribute("lower");
        return refuse(
            part,
            format!(
                "has its lower limit {} above its upper limit {}: swap them",
                limit.lower, limit.upper
            ),
        );
    }
    Ok(())
}

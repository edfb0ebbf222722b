//! How a link moves when a joint before it turns or slides at unit rate.

use robot_model_spec::model::JointKind;

use super::columns::Wrench;
use super::frame::Frame;
use super::vector::{self, Vector};
use crate::expr::{Dag, ExprId};

/// Angular velocity of a link and velocity of the point of its joint, in its coordinates.
#[derive(Clone, Copy)]
pub struct Twist {
    angular: Vector,
    linear: Vector,
}

impl Twist {
    /// Power of a wrench about the same point: what the joint at unit rate takes of it.
    pub fn power(&self, dag: &mut Dag, (force, moment): &Wrench) -> ExprId {
        let turning = vector::dot(dag, self.angular, *moment);
        let moving = vector::dot(dag, self.linear, *force);
        dag.add(turning, moving)
    }

    /// Of the link's origin in place of its joint.
    pub fn at_origin(&self, dag: &mut Dag, to_origin: Vector) -> Self {
        let relative = vector::cross(dag, self.angular, to_origin);
        Self {
            angular: self.angular,
            linear: vector::add(dag, self.linear, relative),
        }
    }

    /// Of the next link, which does not move against this one.
    fn outward(&self, dag: &mut Dag, own: &Frame, next: &Frame) -> Self {
        let origin = self.at_origin(dag, own.to_origin);
        let joint = origin.at_origin(dag, next.joint_point);
        Self {
            angular: vector::apply_transposed(dag, &next.rotation, joint.angular),
            linear: vector::apply_transposed(dag, &next.rotation, joint.linear),
        }
    }

    /// Of the joint's own link.
    fn of_joint(dag: &mut Dag, frame: &Frame) -> Self {
        let still = vector::zero(dag);
        let (angular, linear) = match frame.kind {
            JointKind::Prismatic => (still, frame.axis),
            JointKind::Revolute => (frame.axis, still),
        };
        Self { angular, linear }
    }
}

/// Per link its twists for the joints up to its own.
pub fn of_links(dag: &mut Dag, frames: &[Frame]) -> Vec<Vec<Twist>> {
    let mut links: Vec<Vec<Twist>> = Vec::with_capacity(frames.len());
    for (link, frame) in frames.iter().enumerate() {
        let mut twists: Vec<Twist> = match link.checked_sub(1) {
            Some(parent) => links[parent]
                .iter()
                .map(|twist| twist.outward(dag, &frames[parent], frame))
                .collect(),
            None => Vec::new(),
        };
        twists.push(Twist::of_joint(dag, frame));
        links.push(twists);
    }
    links
}

//! How a link moves when a joint before it turns or slides at unit rate.

use robot_model_spec::model::JointKind;

use super::columns::Wrench;
use super::frame::Frame;
use super::vector::{self, Vector};
use crate::expr::{Dag, ExprId};

/// Angular velocity of a link and velocity of its origin, in its coordinates.
pub struct Twist {
    angular: Vector,
    linear: Vector,
}

impl Twist {
    /// Power of a wrench about the link's origin: what the joint at unit rate takes of it.
    pub fn power(&self, dag: &mut Dag, (force, moment): &Wrench) -> ExprId {
        let turning = vector::dot(dag, self.angular, *moment);
        let moving = vector::dot(dag, self.linear, *force);
        dag.add(turning, moving)
    }

    /// Of a point of the link.
    fn at(&self, dag: &mut Dag, point: Vector) -> Vector {
        let relative = vector::cross(dag, self.angular, point);
        vector::add(dag, self.linear, relative)
    }

    /// Of the next link, which does not move against this one.
    fn outward(&self, dag: &mut Dag, frame: &Frame) -> Self {
        let joint = self.at(dag, frame.joint_point);
        let moved = Self {
            angular: vector::apply_transposed(dag, &frame.rotation, self.angular),
            linear: vector::apply_transposed(dag, &frame.rotation, joint),
        };
        let linear = moved.at(dag, frame.to_origin);
        Self { linear, ..moved }
    }

    /// Of the joint's own link.
    fn of_joint(dag: &mut Dag, frame: &Frame) -> Self {
        let still = vector::zero(dag);
        match frame.kind {
            JointKind::Prismatic => Self {
                angular: still,
                linear: frame.axis,
            },
            JointKind::Revolute => Self {
                angular: frame.axis,
                linear: vector::cross(dag, frame.axis, frame.to_origin),
            },
        }
    }
}

/// Twists of a link for the joints up to the parent's become those of the next link, its own joint among them.
pub fn outward(dag: &mut Dag, frame: &Frame, twists: &mut Vec<Twist>) {
    for twist in twists.iter_mut() {
        *twist = twist.outward(dag, frame);
    }
    twists.push(Twist::of_joint(dag, frame));
}

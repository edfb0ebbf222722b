//! Where the links of a chain are, and how their tip moves.

use robot_model_spec::model::JointKind;

use super::chain::Chain;
use super::frame::multiply;
use super::vector::{self, Matrix, Vector};
use crate::expr::{Dag, ExprId};

/// Poses and velocities of a chain as expressions of `q`.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Kinematics {
    /// Pose of each link's frame in the base frame; the last one is the tip's.
    pub poses: Vec<Pose>,
    /// `[row][joint]` of the geometric Jacobian at the origin of the last link's frame, in base coordinates: three rows of
    /// its velocity, then three of the angular velocity.
    pub jacobian: [Vec<ExprId>; 6],
}

/// A frame in the base frame: `x -> rotation * x + translation`.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Pose {
    /// `[row][column]`
    pub rotation: Matrix,
    /// Of the origin, m.
    pub translation: Vector,
}

impl Pose {
    /// `[[rotation, translation], [0, 1]]`, row by row.
    #[must_use]
    pub fn homogeneous(&self, dag: &mut Dag) -> Vec<ExprId> {
        let (zero, one) = (dag.zero(), dag.constant(1.0));
        let rows = self.rotation.iter().zip(self.translation);
        let mut entries: Vec<ExprId> = rows
            .flat_map(|(row, translation)| row.iter().copied().chain([translation]))
            .collect();
        entries.extend([zero, zero, zero, one]);
        entries
    }
}

/// Velocity of the origin of a link's frame per velocity of each joint up to the link's own, in base coordinates.
pub type Lever = Vec<Vector>;

/// A joint in base coordinates.
#[derive(Clone, Copy)]
struct PlacedJoint {
    kind: JointKind,
    axis: Vector,
    /// From the parent's origin to the joint.
    to_joint: Vector,
    /// From the joint to the link's origin.
    from_joint: Vector,
}

impl Chain {
    /// Poses by products of frames; column `j` of the Jacobian is `[z x (p - o), z]` of a revolute joint and `[z, 0]` of a
    /// prismatic one, with `z` its axis, `o` a point on it and `p` the tip. Source: Siciliano et al. 2009, ch. 3.
    pub fn kinematics(&self, dag: &mut Dag) -> Kinematics {
        let (poses, joints) = self.place(dag);
        let columns = columns(dag, &joints);
        let jacobian = std::array::from_fn(|row| {
            let entry = |(velocity, angular): &(Vector, Vector)| match row {
                0..3 => velocity[row],
                _ => angular[row - 3],
            };
            columns.iter().map(entry).collect()
        });
        Kinematics { poses, jacobian }
    }

    /// One a link, of the origin of its frame; of the last one that of a point in it.
    pub fn levers(&self, dag: &mut Dag, tip: [f64; 3]) -> Vec<Lever> {
        let (poses, mut joints) = self.place(dag);
        if let (Some(pose), Some(last)) = (poses.last(), joints.last_mut()) {
            let tip = vector::constant(dag, tip);
            let from_origin = vector::apply(dag, &pose.rotation, tip);
            last.from_joint = vector::add(dag, last.from_joint, from_origin);
        }
        (1..=joints.len())
            .map(|links| {
                let columns = columns(dag, &joints[..links]);
                columns.into_iter().map(|(velocity, _)| velocity).collect()
            })
            .collect()
    }

    fn place(&self, dag: &mut Dag) -> (Vec<Pose>, Vec<PlacedJoint>) {
        let identity = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
        let mut pose = Pose {
            rotation: identity.map(|row| vector::constant(dag, row)),
            translation: vector::zero(dag),
        };
        let mut poses = Vec::with_capacity(self.frames.len());
        let mut joints = Vec::with_capacity(self.frames.len());
        for frame in &self.frames {
            let to_joint = vector::apply(dag, &pose.rotation, frame.joint_point);
            let axis = vector::apply(dag, &pose.rotation, frame.axis_in_parent);
            let rotation = multiply(dag, &pose.rotation, &frame.rotation);
            let from_joint = vector::apply(dag, &rotation, frame.to_origin);
            joints.push(PlacedJoint {
                kind: frame.kind,
                axis,
                to_joint,
                from_joint,
            });
            let joint_point = vector::add(dag, pose.translation, to_joint);
            pose = Pose {
                rotation,
                translation: vector::add(dag, joint_point, from_joint),
            };
            poses.push(pose);
        }
        (poses, joints)
    }
}

/// Velocity and angular velocity of the last link per velocity of each joint.
fn columns(dag: &mut Dag, joints: &[PlacedJoint]) -> Vec<(Vector, Vector)> {
    // From the tip inward, so that levers are sums and not differences of positions.
    let zero = dag.zero();
    let mut lever = [zero; 3];
    let mut columns = Vec::with_capacity(joints.len());
    for joint in joints.iter().rev() {
        lever = vector::add(dag, joint.from_joint, lever);
        columns.push(match joint.kind {
            JointKind::Revolute => (vector::cross(dag, joint.axis, lever), joint.axis),
            JointKind::Prismatic => (joint.axis, [zero; 3]),
        });
        lever = vector::add(dag, joint.to_joint, lever);
    }
    columns.reverse();
    columns
}

//! The pose of a link in its parent as expressions of `q`: every convention is one [`Placement`] here.

use robot_model_spec::model::{JointKind, Placement};

use super::vector::{self, Matrix, Vector};
use crate::expr::{Dag, ExprId, Function};

/// One joint's kinematics. The joint point is the origin of the frame after [`Placement::before`], fixed in the parent.
#[derive(Clone)]
pub struct Frame {
    /// What the coordinate is.
    pub kind: JointKind,
    /// Rotation from link to parent coordinates.
    pub rotation: Matrix,
    /// The joint point in parent coordinates.
    pub joint_point: Vector,
    /// From the joint point to the link's origin, in link coordinates.
    pub to_origin: Vector,
    /// The joint's axis in link coordinates.
    pub axis: Vector,
    /// The joint's axis in parent coordinates.
    pub axis_in_parent: Vector,
}

/// The axis of a revolute joint, where it is one of the link's frame and one of the parent's.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MainAxis {
    /// Which of the link's.
    pub link: usize,
    /// Which of the parent's.
    pub parent: usize,
    /// Direction in the link by direction in the parent.
    pub turned: f64,
}

impl Frame {
    /// Whether the link has the axes of its parent.
    pub fn is_turned_back(&self, dag: &Dag) -> bool {
        (0..3).all(|k| dag.as_constant(self.rotation[k][k]) == Some(1.0))
    }

    /// The main axis that the joint turns about, if there is one.
    pub fn main_axis(&self, dag: &Dag) -> Option<MainAxis> {
        let unit = |v: Vector| -> Option<(usize, f64)> {
            let k = v.iter().position(|&x| !dag.is_zero(x))?;
            let value = dag.as_constant(v[k])?;
            let alone = (0..3).all(|other| other == k || dag.is_zero(v[other]));
            (alone && value.abs().to_bits() == 1.0f64.to_bits()).then_some((k, value))
        };
        if self.kind != JointKind::Revolute {
            return None;
        }
        let ((link, own), (parent, outer)) = (unit(self.axis)?, unit(self.axis_in_parent)?);
        // The rotation has to leave the axis exactly where it is.
        let turned = own * outer;
        let kept = dag.as_constant(self.rotation[parent][link])?;
        (kept.to_bits() == turned.to_bits()).then_some(MainAxis {
            link,
            parent,
            turned,
        })
    }
}

/// Expressions for the frame of a joint that stands at `q`.
pub fn frame(dag: &mut Dag, q: ExprId, kind: JointKind, placement: &Placement) -> Frame {
    let Placement {
        before,
        axis,
        offset,
        after,
        ..
    } = placement;
    let axis_in_link = vector::rotate_back(&after.rotation, *axis);
    let fixed_to_origin = vector::rotate_back(&after.rotation, after.translation);

    let (motion, to_origin) = match kind {
        JointKind::Revolute => {
            let (sin, cos) = sine_and_cosine(dag, q, *offset);
            (
                rotation_about(dag, *axis, sin, cos),
                vector::constant(dag, fixed_to_origin),
            )
        }
        JointKind::Prismatic => {
            let offset = dag.constant(*offset);
            let travel = dag.add(q, offset);
            let axis = vector::constant(dag, axis_in_link);
            let moved = vector::scale(dag, travel, axis);
            let fixed = vector::constant(dag, fixed_to_origin);
            let identity = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
            (
                identity.map(|row| vector::constant(dag, row)),
                vector::add(dag, moved, fixed),
            )
        }
    };
    let before_rotation = before.rotation.map(|row| vector::constant(dag, row));
    let after_rotation = after.rotation.map(|row| vector::constant(dag, row));
    let rotation = multiply(dag, &before_rotation, &motion);
    Frame {
        kind,
        rotation: multiply(dag, &rotation, &after_rotation),
        joint_point: vector::constant(dag, before.translation),
        to_origin,
        axis: vector::constant(dag, axis_in_link),
        axis_in_parent: vector::constant(dag, vector::rotate(&before.rotation, *axis)),
    }
}

/// `sin(q + offset)` and `cos(q + offset)`; an offset of quarter turns leaves `sin q` and `cos q`.
fn sine_and_cosine(dag: &mut Dag, q: ExprId, offset: f64) -> (ExprId, ExprId) {
    /// Offsets are typed with this many digits at best.
    const QUARTER_TURN_TOLERANCE: f64 = 1e-12;
    let quarters = offset / std::f64::consts::FRAC_PI_2;
    if (quarters - quarters.round()).abs() > QUARTER_TURN_TOLERANCE {
        let offset = dag.constant(offset);
        let angle = dag.add(q, offset);
        return (
            dag.call(Function::Sin, angle),
            dag.call(Function::Cos, angle),
        );
    }
    let (mut sin, mut cos) = (dag.call(Function::Sin, q), dag.call(Function::Cos, q));
    let mut turns = quarters.round().rem_euclid(4.0);
    while turns >= 1.0 {
        // sin(x + pi/2) = cos x, cos(x + pi/2) = -sin x
        (sin, cos) = (cos, dag.neg(sin));
        turns -= 1.0;
    }
    (sin, cos)
}

/// Rodrigues' rotation about a unit axis: `cos + sin [a]x + (1 - cos) a a^T`, with every zero of the axis exact.
pub fn rotation_about(dag: &mut Dag, a: [f64; 3], sin: ExprId, cos: ExprId) -> Matrix {
    std::array::from_fn(|i| {
        std::array::from_fn(|j| {
            let outer = a[i] * a[j];
            let unit = if i == j { 1.0 } else { 0.0 };
            // [a]x[i][j] = -levi_civita(i, j, k) a[k]
            let skew = match (3 + j - i) % 3 {
                0 => 0.0,
                1 => -a[3 - i - j],
                _ => a[3 - i - j],
            };
            let constant = dag.constant(outer);
            let in_cos = dag.scale(unit - outer, cos);
            let in_sin = dag.scale(skew, sin);
            dag.sum([in_cos, in_sin, constant])
        })
    })
}

/// `A B`
pub fn multiply(dag: &mut Dag, a: &Matrix, b: &Matrix) -> Matrix {
    let columns: Matrix = std::array::from_fn(|j| std::array::from_fn(|i| b[i][j]));
    std::array::from_fn(|i| std::array::from_fn(|j| vector::dot(dag, a[i], columns[j])))
}

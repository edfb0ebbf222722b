//! Frames of any convention as those of a tree: a fixed transform, then motion about or along an axis.

use crate::model::{Chain, Joint, JointKind, Transform};
use crate::transform::{product, rotation_about};

/// Where a joint is, and what it moves.
pub(super) struct Frame {
    /// From the frame before to that of the joint at `q = 0`.
    pub origin: Transform,
    /// Unit vector in the frame of the joint, which is that of its link.
    pub axis: [f64; 3],
    /// The spec's frame of the link in this one.
    pub link: Transform,
}

/// Frames from the base to the tip, and the tip in the last of them.
pub(super) fn frames(chain: &Chain, joints: &[Joint]) -> (Vec<Frame>, Transform) {
    let mut behind = Transform::IDENTITY;
    let mut frames = Vec::new();
    for (link, joint) in chain.links.iter().zip(joints) {
        let placement = &link.placement;
        let zero = motion(joint.kind, placement.axis, placement.offset);
        frames.push(Frame {
            origin: behind.then(&placement.before).then(&zero),
            axis: placement.axis,
            link: placement.after,
        });
        behind = placement.after;
    }
    let tip = Transform {
        translation: chain.tip,
        ..Transform::IDENTITY
    };
    (frames, behind.then(&tip))
}

fn motion(kind: JointKind, axis: [f64; 3], q: f64) -> Transform {
    match kind {
        JointKind::Revolute => Transform {
            rotation: rotation_about(axis, q),
            ..Transform::IDENTITY
        },
        JointKind::Prismatic => Transform {
            translation: axis.map(|x| x * q),
            ..Transform::IDENTITY
        },
    }
}

/// Mass, center of mass and inertia about it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Body {
    pub mass: f64,
    pub com: [f64; 3],
    /// Matrix about the center of mass.
    pub inertia: [[f64; 3]; 3],
}

/// What a point of one kilogram adds to the inertia about an origin: `|c|^2 1 - c c^T`.
fn steiner(c: [f64; 3]) -> [[f64; 3]; 3] {
    let square: f64 = c.iter().map(|x| x * x).sum();
    std::array::from_fn(|row| {
        std::array::from_fn(|column| {
            let diagonal = if row == column { square } else { 0.0 };
            diagonal - c[row] * c[column]
        })
    })
}

impl Body {
    /// From the ten inertial parameters.
    pub fn new([m, mx, my, mz, ixx, ixy, ixz, iyy, iyz, izz]: [f64; 10]) -> Self {
        let com = if m == 0.0 {
            [0.0; 3]
        } else {
            [mx / m, my / m, mz / m]
        };
        let about_origin = [[ixx, ixy, ixz], [ixy, iyy, iyz], [ixz, iyz, izz]];
        let shift = steiner(com);
        let inertia = std::array::from_fn(|row| {
            std::array::from_fn(|column| about_origin[row][column] - m * shift[row][column])
        });
        Self {
            mass: m,
            com,
            inertia,
        }
    }

    /// The ten inertial parameters.
    pub fn ten(&self) -> [f64; 10] {
        let (m, [x, y, z]) = (self.mass, self.com);
        let shift = steiner(self.com);
        let i = |row: usize, column: usize| self.inertia[row][column] + m * shift[row][column];
        let first = [m, m * x, m * y, m * z];
        let second = [i(0, 0), i(0, 1), i(0, 2), i(1, 1), i(1, 2), i(2, 2)];
        std::array::from_fn(|k| if k < 4 { first[k] } else { second[k - 4] })
    }

    /// The same in a frame in which its own is `pose`.
    pub fn seen_from(&self, pose: &Transform) -> Self {
        let r = pose.rotation;
        let transposed = std::array::from_fn(|row| std::array::from_fn(|column| r[column][row]));
        Self {
            mass: self.mass,
            com: pose.apply(self.com),
            inertia: product(&r, &product(&self.inertia, &transposed)),
        }
    }

    /// Nothing at all.
    pub fn is_nothing(&self) -> bool {
        self.ten().iter().all(|x| *x == 0.0)
    }
}

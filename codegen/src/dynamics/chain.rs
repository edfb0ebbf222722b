//! Recursive Newton-Euler on a serial chain.
//!
//! In: the chain's frames, ten inertial parameters a link about the origin of the link frame, and expressions for `dq` and
//! `ddq`. Out: the torque of every joint. Source: Luh, Walker and Paul 1980; the linear form in first moments and inertia
//! about the frame's origin as in Khalil & Dombre 2002, ch. 9.

use robot_model_spec::model::{self, Joint, JointKind};

use super::changes::Changes;
use super::frame::{Frame, frame};
use super::inertia::LinkParameters;
use super::rigid::Terms;
use super::vector::{self, Matrix, Vector};
use crate::expr::{Dag, ExprId, Label};

/// The frames of a chain with its parameters.
pub struct Chain {
    pub(super) frames: Vec<Frame>,
    pub(super) links: Vec<LinkParameters>,
    /// Acceleration of gravity in the base frame.
    pub(super) gravity: Vector,
}

/// Motion of a link, in link coordinates.
struct LinkMotion {
    /// Angular velocity.
    w: Vector,
    /// Angular acceleration.
    dw: Vector,
    /// `a(r) = a + U r`: acceleration of the point `r`, with `U = [dw]x + [w]x [w]x`.
    u: Matrix,
    /// Acceleration of the origin, gravity subtracted.
    a: Vector,
}

impl Chain {
    /// Frames of the chain with the given parameters, and what effects change about them.
    pub fn new(
        dag: &mut Dag,
        joints: &[Joint],
        chain: &model::Chain,
        mut links: Vec<LinkParameters>,
        changes: &Changes,
    ) -> Self {
        let placed = joints.iter().zip(&chain.links).zip(&changes.positions);
        let frames = placed
            .map(|((joint, link), &q)| frame(dag, q, joint.kind, &link.placement))
            .collect();
        changes.load(dag, &mut links);
        Self {
            frames,
            links,
            gravity: changes.gravity(dag, chain),
        }
    }

    /// Torque of every joint, N m or N.
    pub fn torque(&self, dag: &mut Dag, terms: Terms, labeled: bool) -> Vec<ExprId> {
        let motions = self.forward(dag, terms, labeled);
        self.backward(dag, &motions)
    }

    /// Base to tip: velocities and accelerations. Gravity is an upward acceleration of the base.
    fn forward(&self, dag: &mut Dag, terms: Terms, labeled: bool) -> Vec<LinkMotion> {
        let still = vector::zero(dag);
        let up = if terms.gravity() {
            self.gravity.map(|g| dag.neg(g))
        } else {
            still
        };
        let (dq, ddq) = terms.rates(dag, self.frames.len());
        let mut motions: Vec<LinkMotion> = Vec::with_capacity(self.frames.len());
        for (index, frame) in self.frames.iter().enumerate() {
            let (w, dw, joint_acceleration) = match motions.last() {
                Some(parent) => (
                    parent.w,
                    parent.dw,
                    parent.acceleration_of(dag, frame.joint_point),
                ),
                None => (still, still, up),
            };
            let motion = frame.advance(dag, w, dw, joint_acceleration, dq[index], ddq[index]);
            if labeled {
                label(dag, "w", index, motion.w);
                label(dag, "dw", index, motion.dw);
                label(dag, "a", index, motion.a);
            }
            motions.push(motion);
        }
        motions
    }

    /// Tip to base: forces and moments, and their part along each joint.
    fn backward(&self, dag: &mut Dag, motions: &[LinkMotion]) -> Vec<ExprId> {
        let mut torque = Vec::with_capacity(motions.len());
        // Force and moment about the origin of link i, that joint i + 1 takes from it.
        let mut carried = (vector::zero(dag), vector::zero(dag));
        for (index, motion) in motions.iter().enumerate().rev() {
            let (own_force, own_moment) = motion.wrench(dag, &self.links[index]);
            let force = vector::add(dag, own_force, carried.0);
            let moment = vector::add(dag, own_moment, carried.1);
            let along_joint;
            (along_joint, carried) = self.frames[index].transmit(dag, (force, moment));
            torque.push(along_joint);
        }
        torque.reverse();
        torque
    }
}

/// Says what the components of a link's vector are.
pub(super) fn label(dag: &mut Dag, stem: &'static str, link: usize, v: Vector) {
    for (axis, x) in v.into_iter().enumerate() {
        dag.set_label(x, Label::Component { stem, link, axis });
    }
}

impl Frame {
    /// What the joint feels of a force on the link and a moment about the link's origin, and both on the parent, the
    /// moment about the parent's origin.
    pub(super) fn transmit(
        &self,
        dag: &mut Dag,
        (force, moment): (Vector, Vector),
    ) -> (ExprId, (Vector, Vector)) {
        let lever = vector::cross(dag, self.to_origin, force);
        let joint_moment = vector::add(dag, moment, lever);
        let along_joint = match self.kind {
            JointKind::Revolute => vector::dot(dag, self.axis, joint_moment),
            JointKind::Prismatic => vector::dot(dag, self.axis, force),
        };
        let force = vector::apply(dag, &self.rotation, force);
        let moment = vector::apply(dag, &self.rotation, joint_moment);
        let lever = vector::cross(dag, self.joint_point, force);
        (along_joint, (force, vector::add(dag, moment, lever)))
    }

    /// Motion of the link, given the parent's angular motion and the joint point's acceleration in parent coordinates.
    fn advance(
        &self,
        dag: &mut Dag,
        w: Vector,
        dw: Vector,
        a: Vector,
        dq: ExprId,
        ddq: ExprId,
    ) -> LinkMotion {
        let mut w = vector::apply_transposed(dag, &self.rotation, w);
        let mut dw = vector::apply_transposed(dag, &self.rotation, dw);
        let mut a = vector::apply_transposed(dag, &self.rotation, a);
        let along_dq = vector::scale(dag, dq, self.axis);
        let along_ddq = vector::scale(dag, ddq, self.axis);
        match self.kind {
            JointKind::Revolute => {
                let turning = vector::cross(dag, w, along_dq);
                let relative = vector::add(dag, turning, along_ddq);
                dw = vector::add(dag, dw, relative);
                w = vector::add(dag, w, along_dq);
            }
            JointKind::Prismatic => {
                let turning = vector::cross(dag, w, along_dq);
                let two = dag.constant(2.0);
                let coriolis = vector::scale(dag, two, turning);
                let relative = vector::add(dag, coriolis, along_ddq);
                a = vector::add(dag, a, relative);
            }
        }
        let u = acceleration_gradient(dag, w, dw);
        let motion = LinkMotion { w, dw, u, a };
        LinkMotion {
            a: motion.acceleration_of(dag, self.to_origin),
            ..motion
        }
    }
}

/// `U = [dw]x + [w]x [w]x`
pub(super) fn acceleration_gradient(dag: &mut Dag, w: Vector, dw: Vector) -> Matrix {
    let square = w.map(|x| dag.mul(x, x));
    let zero = dag.zero();
    let mut u = [[zero; 3]; 3];
    for k in 0..3 {
        let (i, j) = ((k + 1) % 3, (k + 2) % 3);
        let sum = dag.add(square[i], square[j]);
        u[k][k] = dag.neg(sum);
        let product = dag.mul(w[i], w[j]);
        u[i][j] = dag.sub(product, dw[k]);
        u[j][i] = dag.add(product, dw[k]);
    }
    u
}

impl LinkMotion {
    /// Acceleration of the point `r` of the link, gravity subtracted.
    fn acceleration_of(&self, dag: &mut Dag, r: Vector) -> Vector {
        let relative = vector::apply(dag, &self.u, r);
        vector::add(dag, self.a, relative)
    }

    /// Force on the link, and moment about the origin of its frame:
    /// `f = m a + U mc`, `n = I dw + w x (I w) + mc x a`.
    fn wrench(&self, dag: &mut Dag, link: &LinkParameters) -> (Vector, Vector) {
        let &[m, mx, my, mz, xx, xy, xz, yy, yz, zz] = link;
        let moment = [mx, my, mz];
        let inertia = [[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]];

        let translation = vector::scale(dag, m, self.a);
        let rotation = vector::apply(dag, &self.u, moment);
        let force = vector::add(dag, translation, rotation);

        let lever = vector::cross(dag, moment, self.a);
        let spin: Vector = std::array::from_fn(|k| {
            // One row of I dw + w x (I w), written with the entries of U so that products of velocities are shared.
            let (i, j) = ((k + 1) % 3, (k + 2) % 3);
            let products = dag.mul(self.w[i], self.w[j]);
            let own = dag.mul(inertia[k][k], self.dw[k]);
            let difference = dag.sub(inertia[j][j], inertia[i][i]);
            let gyroscopic = dag.mul(difference, products);
            let minus_u = dag.neg(self.u[j][k]);
            let first = dag.mul(inertia[k][i], minus_u);
            let second = dag.mul(inertia[k][j], self.u[i][k]);
            let deviation = dag.sub(self.u[i][i], self.u[j][j]);
            let third = dag.mul(inertia[i][j], deviation);
            dag.sum([own, gyroscopic, first, second, third])
        });
        (force, vector::add(dag, lever, spin))
    }
}

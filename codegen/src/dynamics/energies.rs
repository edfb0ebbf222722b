//! Kinetic and potential energy of the rigid body: what the momentum form is made of, for every kind of robot.
//!
//! In: a chain, or the energies that the spec gives. Out: [`Energies`]. Invariant gained: both are linear in the standard
//! parameters of the rigid body, the kinetic energy is quadratic in `dq` and the potential energy free of it.

use robot_model_spec::model::JointKind;

use super::chain::Chain;
use super::frame::Frame;
use super::inertia::LinkParameters;
use super::vector::{self, Vector};
use crate::expr::{Dag, ExprId, Symbol};

/// Energies of the rigid body as expressions of `q`, `dq` and the parameters, J.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Energies {
    /// `T(q, dq) = 1/2 dq^T M(q) dq`
    pub kinetic: ExprId,
    /// `V(q)`; of a chain with gravity alone, zero where all link origins are in the base's and all first moments vanish.
    pub potential: ExprId,
}

/// Velocity of a link and gravity, in link coordinates.
struct LinkState {
    /// Angular velocity.
    w: Vector,
    /// Velocity of the origin.
    v: Vector,
    /// Acceleration of gravity.
    gravity: Vector,
    /// `g . p` of the origin `p`.
    fall: ExprId,
}

impl Chain {
    /// `T = sum_i 1/2 m v . v + mc . (v x w) + 1/2 w . I w` and `V = -sum_i (m g . p + g . mc)`, with `p` and `v` the position
    /// and velocity of the origin of link `i`, and `mc`, `I` about it. Source: Khalil & Dombre 2002, ch. 9.
    pub fn energies(&self, dag: &mut Dag) -> Energies {
        let still = vector::zero(dag);
        let mut state = LinkState {
            w: still,
            v: still,
            gravity: self.gravity,
            fall: dag.zero(),
        };
        let (mut kinetic, mut potential) = (dag.zero(), dag.zero());
        for (index, (frame, link)) in self.frames.iter().zip(&self.links).enumerate() {
            let dq = dag.symbol(Symbol::Dq(index));
            state = state.outward(dag, frame, dq);
            let own = state.kinetic(dag, link);
            kinetic = dag.add(kinetic, own);
            let own = state.potential(dag, link);
            potential = dag.add(potential, own);
        }
        Energies { kinetic, potential }
    }
}

impl LinkState {
    /// The next link's, from its parent's.
    fn outward(&self, dag: &mut Dag, frame: &Frame, dq: ExprId) -> Self {
        let lever = vector::cross(dag, self.w, frame.joint_point);
        let joint_velocity = vector::add(dag, self.v, lever);
        let height = vector::dot(dag, self.gravity, frame.joint_point);
        let mut w = vector::apply_transposed(dag, &frame.rotation, self.w);
        let mut v = vector::apply_transposed(dag, &frame.rotation, joint_velocity);
        let gravity = vector::apply_transposed(dag, &frame.rotation, self.gravity);
        let own = vector::scale(dag, dq, frame.axis);
        match frame.kind {
            JointKind::Revolute => w = vector::add(dag, w, own),
            JointKind::Prismatic => v = vector::add(dag, v, own),
        }
        let lever = vector::cross(dag, w, frame.to_origin);
        let rise = vector::dot(dag, gravity, frame.to_origin);
        Self {
            w,
            v: vector::add(dag, v, lever),
            gravity,
            fall: dag.sum([self.fall, height, rise]),
        }
    }

    fn kinetic(&self, dag: &mut Dag, link: &LinkParameters) -> ExprId {
        let &[m, mx, my, mz, xx, xy, xz, yy, yz, zz] = link;
        let (w, v) = (self.w, self.v);
        let square = vector::dot(dag, v, v);
        let moved = dag.mul(m, square);
        let crossed = vector::cross(dag, v, w);
        let coupled = vector::dot(dag, [mx, my, mz], crossed);
        let momentum = vector::apply(dag, &[[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]], w);
        let turned = vector::dot(dag, w, momentum);
        let squares = dag.add(moved, turned);
        let half = dag.scale(0.5, squares);
        dag.add(half, coupled)
    }

    fn potential(&self, dag: &mut Dag, link: &LinkParameters) -> ExprId {
        let &[m, mx, my, mz, ..] = link;
        let origin = dag.mul(m, self.fall);
        let moment = vector::dot(dag, self.gravity, [mx, my, mz]);
        let sum = dag.add(origin, moment);
        dag.neg(sum)
    }
}

//! Mass matrix and Coriolis matrix of a chain by composite rigid bodies.
//!
//! In: a [`Chain`]. Out: `M(q)` and the Christoffel form of `C(q, dq)`. All links from joint `k` to the tip move as one body
//! when joint `k` alone accelerates; what the matrices need of that body are its ten inertial parameters and, for `C`, its
//! [`Flow`]. Source of the composite bodies: Walker and Orin 1982.

use robot_model_spec::model::JointKind;

use super::chain::Chain;
use super::frame::Frame;
use super::inertia::{self, LinkParameters};
use super::vector::{self, Matrix, Vector};
use crate::expr::{Dag, ExprId, Symbol};

/// Force and moment about the origin of a frame.
type Wrench = (Vector, Vector);

/// How the mass of a body flows past the axes of a frame, which stand still.
#[derive(Clone, Copy)]
struct Flow {
    /// `int dr/dt dm`, the momentum.
    momentum: Vector,
    /// `N = int (r . dr/dt) 1 - dr/dt r^T dm`, about the origin.
    about: Matrix,
}

/// A field of velocities or accelerations `angular x r + linear`.
#[derive(Clone, Copy)]
struct Twist {
    angular: Vector,
    linear: Vector,
}

impl Chain {
    /// `M(q)`, `[row][column]`: the composite body of joint `j` takes a wrench to accelerate with the joint, which the
    /// joints below carry.
    pub fn mass_matrix(&self, dag: &mut Dag) -> Vec<Vec<ExprId>> {
        let dof = self.frames.len();
        let mut mass_matrix = vec![vec![dag.zero(); dof]; dof];
        let bodies = self.composite_bodies(dag);
        for j in (0..dof).rev() {
            let unit = self.frames[j].unit_motion(dag);
            let mut carried = unit.wrench(dag, &bodies[j]);
            for i in (0..=j).rev() {
                let along_joint;
                (along_joint, carried) = self.frames[i].transmit(dag, carried);
                mass_matrix[i][j] = along_joint;
                mass_matrix[j][i] = along_joint;
            }
        }
        mass_matrix
    }

    /// `C(q, dq)` of Christoffel, `[row][column]`.
    ///
    /// With `e_j(r)` the velocity of a point when joint `j` moves with rate one, Christoffel's symbols of the first kind are
    /// `c_ijk = int e_i . de_j/dq_k dm`, because the kinetic energy is the plain square of the points' velocities. So
    /// `C_ij = int e_i . d(e_j)/dt dm` over the links from `max(i, j)` to the tip. Along a motion a point's `e_j` changes by
    /// `[V_j, e_j](r) + z_j x dr/dt`: the first is a twist that is constant along the chain, the second meets [`Flow`].
    pub fn coriolis_matrix(&self, dag: &mut Dag) -> Vec<Vec<ExprId>> {
        let dof = self.frames.len();
        let mut coriolis_matrix = vec![vec![dag.zero(); dof]; dof];
        let velocities = self.velocities(dag);
        let bodies = self.composite_bodies(dag);
        let flows = self.composite_flows(dag, &velocities);
        let units: Vec<Twist> = self
            .frames
            .iter()
            .map(|frame| frame.unit_motion(dag))
            .collect();
        let rates: Vec<Twist> = velocities
            .iter()
            .zip(&units)
            .map(|(velocity, unit)| velocity.bracket(dag, unit))
            .collect();
        for k in 0..dof {
            // Column k, rows up to k: the wrench that `d(e_k)/dt` takes.
            let own = rates[k].wrench(dag, &bodies[k]);
            let turned = flows[k].turned_by(dag, units[k].angular);
            let mut column = add(dag, own, turned);
            // Row k, columns below k: what `e_k` meets of their twists and of their axes.
            let mut twist = units[k].wrench(dag, &bodies[k]);
            let mut axis = flows[k].met_by(dag, &units[k]);
            for i in (0..=k).rev() {
                let frame = &self.frames[i];
                if i < k {
                    let rate = rates[i].power(dag, twist);
                    let turning = vector::dot(dag, axis, units[i].angular);
                    coriolis_matrix[k][i] = dag.add(rate, turning);
                }
                let along_joint;
                (along_joint, column) = frame.transmit(dag, column);
                coriolis_matrix[i][k] = along_joint;
                (_, twist) = frame.transmit(dag, twist);
                axis = vector::apply(dag, &frame.rotation, axis);
            }
        }
        coriolis_matrix
    }

    /// The links from each joint to the tip as one body, about the origin of the joint's link.
    fn composite_bodies(&self, dag: &mut Dag) -> Vec<LinkParameters> {
        let mut bodies = self.links.clone();
        for k in (1..bodies.len()).rev() {
            let outer = inertia::in_parent(dag, &self.frames[k], &bodies[k]);
            for (own, more) in bodies[k - 1].iter_mut().zip(outer) {
                *own = dag.add(*own, more);
            }
        }
        bodies
    }

    fn composite_flows(&self, dag: &mut Dag, velocities: &[Twist]) -> Vec<Flow> {
        let links = self.links.iter().zip(velocities);
        let mut flows: Vec<Flow> = links
            .map(|(link, velocity)| velocity.flow(dag, link))
            .collect();
        for k in (1..flows.len()).rev() {
            let outer = flows[k].in_parent(dag, &self.frames[k]);
            let own = &mut flows[k - 1];
            own.momentum = vector::add(dag, own.momentum, outer.momentum);
            for (row, more) in own.about.iter_mut().zip(outer.about) {
                *row = vector::add(dag, *row, more);
            }
        }
        flows
    }

    /// Of the links, in their frames.
    fn velocities(&self, dag: &mut Dag) -> Vec<Twist> {
        let still = vector::zero(dag);
        let mut velocity = Twist {
            angular: still,
            linear: still,
        };
        let mut velocities = Vec::with_capacity(self.frames.len());
        for (index, frame) in self.frames.iter().enumerate() {
            let dq = dag.symbol(Symbol::Dq(index));
            velocity = velocity.outward(dag, frame, dq);
            velocities.push(velocity);
        }
        velocities
    }
}

fn add(dag: &mut Dag, a: Wrench, b: Wrench) -> Wrench {
    (vector::add(dag, a.0, b.0), vector::add(dag, a.1, b.1))
}

impl Frame {
    /// `e(r)` of the joint about the link's origin.
    fn unit_motion(&self, dag: &mut Dag) -> Twist {
        match self.kind {
            JointKind::Revolute => Twist {
                angular: self.axis,
                linear: vector::cross(dag, self.axis, self.to_origin),
            },
            JointKind::Prismatic => Twist {
                angular: vector::zero(dag),
                linear: self.axis,
            },
        }
    }
}

impl Twist {
    /// Velocity of the next link from its parent's.
    fn outward(&self, dag: &mut Dag, frame: &Frame, dq: ExprId) -> Self {
        let lever = vector::cross(dag, self.angular, frame.joint_point);
        let joint = vector::add(dag, self.linear, lever);
        let mut angular = vector::apply_transposed(dag, &frame.rotation, self.angular);
        let mut linear = vector::apply_transposed(dag, &frame.rotation, joint);
        let own = vector::scale(dag, dq, frame.axis);
        match frame.kind {
            JointKind::Revolute => angular = vector::add(dag, angular, own),
            JointKind::Prismatic => linear = vector::add(dag, linear, own),
        }
        let lever = vector::cross(dag, angular, frame.to_origin);
        Self {
            angular,
            linear: vector::add(dag, linear, lever),
        }
    }

    /// `[V, e]`: the rate of a twist that moves with `self`.
    fn bracket(&self, dag: &mut Dag, e: &Self) -> Self {
        let first = vector::cross(dag, self.angular, e.linear);
        let second = vector::cross(dag, self.linear, e.angular);
        Self {
            angular: vector::cross(dag, self.angular, e.angular),
            linear: vector::add(dag, first, second),
        }
    }

    /// What accelerates a body by this field, about the origin: `f = m a + alpha x mc`, `n = I alpha + mc x a`.
    fn wrench(&self, dag: &mut Dag, body: &LinkParameters) -> Wrench {
        let &[m, mx, my, mz, xx, xy, xz, yy, yz, zz] = body;
        let moment = [mx, my, mz];
        let inertia = [[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]];
        let translation = vector::scale(dag, m, self.linear);
        let rotation = vector::cross(dag, self.angular, moment);
        let spin = vector::apply(dag, &inertia, self.angular);
        let lever = vector::cross(dag, moment, self.linear);
        (
            vector::add(dag, translation, rotation),
            vector::add(dag, spin, lever),
        )
    }

    /// Of a force and a moment about the origin.
    fn power(&self, dag: &mut Dag, (force, moment): Wrench) -> ExprId {
        let turning = vector::dot(dag, moment, self.angular);
        let moving = vector::dot(dag, force, self.linear);
        dag.add(turning, moving)
    }

    /// Of a link that moves with this velocity.
    ///
    /// With `S = int r r^T dm = tr(I)/2 1 - I`: `N = (mc . v) 1 - v mc^T - [w]x S`.
    fn flow(&self, dag: &mut Dag, link: &LinkParameters) -> Flow {
        let &[m, mx, my, mz, xx, xy, xz, yy, yz, zz] = link;
        let moment = [mx, my, mz];
        let mut second = |own, one, other| {
            let others = dag.add(one, other);
            let difference = dag.sub(others, own);
            dag.scale(0.5, difference)
        };
        let square = [second(xx, yy, zz), second(yy, zz, xx), second(zz, xx, yy)];
        let [minus_xy, minus_xz, minus_yz] = [xy, xz, yz].map(|x| dag.neg(x));
        // Symmetric: rows are columns.
        let second_moments = [
            [square[0], minus_xy, minus_xz],
            [minus_xy, square[1], minus_yz],
            [minus_xz, minus_yz, square[2]],
        ];
        let columns = second_moments.map(|column| vector::cross(dag, column, self.angular));
        let translation = vector::scale(dag, m, self.linear);
        let rotation = vector::cross(dag, self.angular, moment);
        let turning = std::array::from_fn(|a| std::array::from_fn(|b| columns[b][a]));
        Flow {
            momentum: vector::add(dag, translation, rotation),
            about: about(dag, &turning, moment, self.linear),
        }
    }
}

/// `N + (r . v) 1 - v r^T`
fn about(dag: &mut Dag, n: &Matrix, r: Vector, v: Vector) -> Matrix {
    let products: Matrix = std::array::from_fn(|a| std::array::from_fn(|b| dag.mul(v[a], r[b])));
    std::array::from_fn(|a| {
        std::array::from_fn(|b| {
            if a == b {
                let (i, j) = ((a + 1) % 3, (a + 2) % 3);
                let others = dag.add(products[i][i], products[j][j]);
                dag.add(n[a][b], others)
            } else {
                dag.sub(n[a][b], products[a][b])
            }
        })
    })
}

impl Flow {
    /// About the origin of the parent and in its axes; a point at `r` is at `r + t` from a point `-t` away.
    fn in_parent(&self, dag: &mut Dag, frame: &Frame) -> Self {
        let joint = about(dag, &self.about, frame.to_origin, self.momentum);
        let turned = inertia::turned_matrix(dag, &joint, &frame.rotation);
        let momentum = vector::apply(dag, &frame.rotation, self.momentum);
        Self {
            momentum,
            about: about(dag, &turned, frame.joint_point, momentum),
        }
    }

    /// What the field `z x dr/dt` takes: `f = z x h`, `n = N z`.
    fn turned_by(&self, dag: &mut Dag, z: Vector) -> Wrench {
        (
            vector::cross(dag, z, self.momentum),
            vector::apply(dag, &self.about, z),
        )
    }

    /// `int e . (z x dr/dt) dm = z . (N^T e_angular + h x e_linear)`, without `z`.
    fn met_by(&self, dag: &mut Dag, e: &Twist) -> Vector {
        let turning = vector::apply_transposed(dag, &self.about, e.angular);
        let moving = vector::cross(dag, self.momentum, e.linear);
        vector::add(dag, turning, moving)
    }
}

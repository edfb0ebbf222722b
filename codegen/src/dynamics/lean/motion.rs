//! Motion of a link, and what it takes.

use robot_model_spec::model::JointKind;

use super::body::{Body, Form};
use crate::dynamics::chain::{acceleration_gradient, label};
use crate::dynamics::frame::Frame;
use crate::dynamics::vector::{self, Matrix, Vector};
use crate::expr::{Dag, ExprId, Label};

/// Motion of a link, in link coordinates.
pub struct Motion {
    /// Angular velocity.
    w: Vector,
    /// Angular acceleration.
    dw: Vector,
    /// `a(r) = a + U r`: acceleration of the point `r`, with `U = [dw]x + [w]x [w]x`.
    u: Matrix,
    /// Acceleration of the origin, gravity subtracted.
    a: Vector,
}

impl Motion {
    /// A base that does not turn.
    pub fn of_base(dag: &mut Dag, a: Vector) -> Self {
        let still = vector::zero(dag);
        Self {
            w: still,
            dw: still,
            u: [still; 3],
            a,
        }
    }

    /// Motion of the next link. `asked` where its `dw` is wanted for itself and not only in `U`.
    pub fn outward(
        &self,
        dag: &mut Dag,
        frame: &Frame,
        (dq, ddq): (ExprId, ExprId),
        asked: bool,
    ) -> Self {
        let relative = vector::apply(dag, &self.u, frame.joint_point);
        let joint = vector::add(dag, self.a, relative);
        let mut w = vector::apply_transposed(dag, &frame.rotation, self.w);
        let mut dw = vector::apply_transposed(dag, &frame.rotation, self.dw);
        let mut a = vector::apply_transposed(dag, &frame.rotation, joint);
        let along_dq = vector::scale(dag, dq, frame.axis);
        let along_ddq = vector::scale(dag, ddq, frame.axis);
        let turning = vector::cross(dag, w, along_dq);
        let u = match (frame.kind, frame.main_axis(dag)) {
            (JointKind::Prismatic, _) => {
                let two = dag.constant(2.0);
                let coriolis = vector::scale(dag, two, turning);
                let relative = vector::add(dag, coriolis, along_ddq);
                a = vector::add(dag, a, relative);
                acceleration_gradient(dag, w, dw)
            }
            (JointKind::Revolute, None) => {
                let relative = vector::add(dag, turning, along_ddq);
                dw = vector::add(dag, dw, relative);
                w = vector::add(dag, w, along_dq);
                acceleration_gradient(dag, w, dw)
            }
            (JointKind::Revolute, Some(axis)) => {
                w = vector::add(dag, w, along_dq);
                let of_parent = std::array::from_fn(|row| self.u[row][axis.parent]);
                let turned = vector::apply_transposed(dag, &frame.rotation, of_parent);
                let column = turned.map(|x| dag.scale(axis.turned, x));
                let own = dag.scale(axis.turned, self.dw[axis.parent]);
                let along = dag.add(own, along_ddq[axis.link]);
                let mut u;
                (u, dw) = gradient_by_column(dag, w, along, column, axis.link, asked);
                if frame.is_turned_back(dag) {
                    // In the parent's axes `U` differs across the joint's axis by its acceleration.
                    let (i, j) = ((axis.link + 1) % 3, (axis.link + 2) % 3);
                    u[i][j] = dag.sub(self.u[i][j], along_ddq[axis.link]);
                    u[j][i] = dag.add(self.u[j][i], along_ddq[axis.link]);
                }
                u
            }
        };
        let relative = vector::apply(dag, &u, frame.to_origin);
        let a = vector::add(dag, a, relative);
        Self { w, dw, u, a }
    }

    /// Says what the expressions are; accelerations are named in m/s^2.
    pub fn label(&self, dag: &mut Dag, link: usize, is_in_meters: bool) {
        label(dag, "w", link, self.w);
        label(dag, "dw", link, self.dw);
        if is_in_meters {
            label(dag, "a", link, self.a);
        }
        for (row, entries) in self.u.iter().enumerate() {
            for (column, &entry) in entries.iter().enumerate() {
                let label = Label::Gradient { link, row, column };
                dag.set_label(entry, label);
            }
        }
    }

    /// Force on the body, and moment about the origin: `f = m a + U mc`, `n = mc x a + spin`.
    pub fn wrench(&self, dag: &mut Dag, body: &Body) -> (Vector, Vector) {
        let translation = vector::scale(dag, body.mass, self.a);
        let rotation = vector::apply(dag, &self.u, body.first);
        let lever = vector::cross(dag, body.first, self.a);
        let spin = std::array::from_fn(|k| match body.form {
            Form::Inertia => self.spin_of_inertia(dag, &body.second, k),
            Form::SecondMoments => self.spin_of_squares(dag, &body.second, k),
        });
        (
            vector::add(dag, translation, rotation),
            vector::add(dag, lever, spin),
        )
    }

    /// Row `k` of `I dw + w x (I w)`, written with the entries of `U` so that products of velocities are shared.
    fn spin_of_inertia(&self, dag: &mut Dag, inertia: &Matrix, k: usize) -> ExprId {
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
    }

    /// `(U S)_ji - (U S)_ij`, row `k` of the same.
    fn spin_of_squares(&self, dag: &mut Dag, s: &Matrix, k: usize) -> ExprId {
        let (i, j) = ((k + 1) % 3, (k + 2) % 3);
        let u = &self.u;
        let first = dag.mul(u[j][i], s[i][i]);
        let second = dag.mul(u[i][j], s[j][j]);
        let third = dag.mul(u[j][k], s[k][i]);
        let fourth = dag.mul(u[i][k], s[k][j]);
        let deviation = dag.sub(u[j][j], u[i][i]);
        let fifth = dag.mul(deviation, s[i][j]);
        let plus = dag.sum([first, third, fifth]);
        let minus = dag.add(second, fourth);
        dag.sub(plus, minus)
    }
}

/// `U` and `dw`, given column `k` of `U` and the component `along` of `dw`.
///
/// The column is `U z`, the acceleration of the direction `z` of the joint's axis, which is the same for the link and its
/// parent. `asked` where the other components of `dw` are wanted for themselves.
fn gradient_by_column(
    dag: &mut Dag,
    w: Vector,
    along: ExprId,
    column: Vector,
    k: usize,
    asked: bool,
) -> (Matrix, Vector) {
    let (i, j) = ((k + 1) % 3, (k + 2) % 3);
    let mut u = [column; 3];
    for row in 0..3 {
        u[row][k] = column[row];
    }
    // u_ik = w_i w_k + dw_j, u_jk = w_j w_k - dw_i
    let (in_ik, in_jk) = (dag.mul(w[i], w[k]), dag.mul(w[j], w[k]));
    let mut dw = [along; 3];
    dw[j] = dag.sub(column[i], in_ik);
    dw[i] = dag.sub(in_jk, column[j]);
    if asked {
        u[k][i] = dag.sub(in_ik, dw[j]);
        u[k][j] = dag.add(in_jk, dw[i]);
    } else {
        for (x, product) in [(i, in_ik), (j, in_jk)] {
            let twice = dag.scale(2.0, product);
            u[k][x] = dag.sub(twice, column[x]);
        }
    }
    let in_ij = dag.mul(w[i], w[j]);
    u[i][j] = dag.sub(in_ij, along);
    u[j][i] = dag.add(in_ij, along);
    // u_kk = -w_i^2 - w_j^2, so the square of w_j is not needed.
    let (square_i, square_k) = (dag.mul(w[i], w[i]), dag.mul(w[k], w[k]));
    let both = dag.add(square_i, square_k);
    u[j][j] = dag.neg(both);
    let difference = dag.sub(square_i, square_k);
    u[i][i] = dag.add(column[k], difference);
    (u, dw)
}

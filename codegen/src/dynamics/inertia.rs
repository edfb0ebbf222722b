//! Ten inertial parameters of a body, carried from one frame to another.

use super::frame::Frame;
use super::vector::{self, Matrix, Vector};
use crate::expr::{Dag, ExprId};

/// A body's inertial parameters about the origin of a frame, in the order of `InertialElement::ALL`.
pub type LinkParameters = [ExprId; 10];

/// The parameters of a body that moves with the link of `frame`, about the origin of the parent and in its axes.
pub fn in_parent(dag: &mut Dag, frame: &Frame, body: &LinkParameters) -> LinkParameters {
    let about_joint = moved(dag, body, frame.to_origin);
    let turned = turned(dag, &about_joint, &frame.rotation);
    moved(dag, &turned, frame.joint_point)
}

/// About a point `-t` from the old one: every mass moves by `t`.
///
/// With `s = mc + mc'`, the old first moments and the new: `I' = I + (s . t) 1 - (s t^T + t s^T) / 2`.
fn moved(dag: &mut Dag, body: &LinkParameters, t: Vector) -> LinkParameters {
    let &[m, mx, my, mz, xx, xy, xz, yy, yz, zz] = body;
    let before = [mx, my, mz];
    let shift = vector::scale(dag, m, t);
    let after = vector::add(dag, before, shift);
    let s = vector::add(dag, before, after);
    let products: Matrix = std::array::from_fn(|i| std::array::from_fn(|j| dag.mul(s[i], t[j])));
    let mut on_diagonal = |x, i: usize, j: usize| dag.sum([x, products[i][i], products[j][j]]);
    let (xx, yy, zz) = (
        on_diagonal(xx, 1, 2),
        on_diagonal(yy, 2, 0),
        on_diagonal(zz, 0, 1),
    );
    let mut off_diagonal = |x, i: usize, j: usize| {
        let both = dag.add(products[i][j], products[j][i]);
        let half = dag.scale(0.5, both);
        dag.sub(x, half)
    };
    let (xy, xz, yz) = (
        off_diagonal(xy, 0, 1),
        off_diagonal(xz, 0, 2),
        off_diagonal(yz, 1, 2),
    );
    let [mx, my, mz] = after;
    [m, mx, my, mz, xx, xy, xz, yy, yz, zz]
}

/// In other axes: `mc' = R mc`, `I' = R I R^T`.
fn turned(dag: &mut Dag, body: &LinkParameters, rotation: &Matrix) -> LinkParameters {
    let &[m, mx, my, mz, xx, xy, xz, yy, yz, zz] = body;
    let [mx, my, mz] = vector::apply(dag, rotation, [mx, my, mz]);
    let inertia = [[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]];
    // I is symmetric: row i of R I is I applied to row i of R.
    let rows: Matrix = std::array::from_fn(|i| vector::apply(dag, &inertia, rotation[i]));
    let mut entry = |i: usize, j: usize| vector::dot(dag, rows[i], rotation[j]);
    let (xx, xy, xz) = (entry(0, 0), entry(0, 1), entry(0, 2));
    let (yy, yz, zz) = (entry(1, 1), entry(1, 2), entry(2, 2));
    [m, mx, my, mz, xx, xy, xz, yy, yz, zz]
}

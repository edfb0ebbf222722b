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
    let inertia = turned_matrix(dag, &[[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]], rotation);
    let [[xx, xy, xz], [_, yy, yz], [_, _, zz]] = inertia;
    [m, mx, my, mz, xx, xy, xz, yy, yz, zz]
}

/// `R A R^T`; of a symmetric matrix it is symmetric.
pub fn turned_matrix(dag: &mut Dag, a: &Matrix, rotation: &Matrix) -> Matrix {
    if let Some(turn) = Turn::of(dag, rotation) {
        return turn.matrix(dag, a);
    }
    let zero = dag.zero();
    // Row i of R A, then its products with the rows of R.
    let left: Matrix = rotation.map(|row| vector::apply_transposed(dag, a, row));
    let is_symmetric = (0..3).all(|i| (0..i).all(|j| a[i][j] == a[j][i]));
    let mut turned = [[zero; 3]; 3];
    for i in 0..3 {
        for j in 0..3 {
            turned[i][j] = if is_symmetric && j < i {
                turned[j][i]
            } else {
                vector::dot(dag, left[i], rotation[j])
            };
        }
    }
    turned
}

/// A rotation that takes one axis of the link to an axis of the parent, as joints about an axis of their frame have it.
pub struct Turn {
    /// The axis in the link, and the other two.
    from: [usize; 3],
    /// The axis in the parent, and the other two.
    to: [usize; 3],
    /// Whether the axis changes its direction.
    axis_flips: bool,
    /// First of the other rows over the other columns.
    cos: ExprId,
    sin: ExprId,
    /// Whether the second of the other rows is `(sin, -cos)`, not `(-sin, cos)`.
    second_flips: bool,
}

impl Turn {
    /// `None` for other rotations.
    pub fn of(dag: &mut Dag, rotation: &Matrix) -> Option<Self> {
        for (k, m) in (0..9).map(|n| (n / 3, n % 3)) {
            let Some(unit) = dag.as_constant(rotation[m][k]) else {
                continue;
            };
            let (i, j) = ((k + 1) % 3, (k + 2) % 3);
            let (a, b) = ((m + 1) % 3, (m + 2) % 3);
            let across = [
                rotation[m][i],
                rotation[m][j],
                rotation[a][k],
                rotation[b][k],
            ];
            if unit.abs().to_bits() != 1.0f64.to_bits() || !across.iter().all(|&x| dag.is_zero(x)) {
                continue;
            }
            let (cos, sin) = (rotation[a][i], rotation[a][j]);
            let (minus_cos, minus_sin) = (dag.neg(cos), dag.neg(sin));
            let second_flips = match [rotation[b][i], rotation[b][j]] {
                [x, y] if x == minus_sin && y == cos => false,
                [x, y] if x == sin && y == minus_cos => true,
                _ => continue,
            };
            return Some(Self {
                from: [k, i, j],
                to: [m, a, b],
                axis_flips: unit < 0.0,
                cos,
                sin,
                second_flips,
            });
        }
        None
    }

    /// `R A R^T` with the sum of squares `cos^2 + sin^2` taken out: four products for the four entries across the axis.
    pub fn matrix(&self, dag: &mut Dag, m: &Matrix) -> Matrix {
        let ([k, i, j], [to_k, a, b]) = (self.from, self.to);
        let (c, s) = (self.cos, self.sin);
        let mut turned = *m;
        turned[to_k][to_k] = m[k][k];

        let difference = dag.sub(m[i][i], m[j][j]);
        let sum = dag.add(m[i][j], m[j][i]);
        let (left, right) = (dag.mul(c, difference), dag.mul(s, sum));
        let both = dag.add(left, right);
        let (in_cos, in_sin) = (dag.mul(c, both), dag.mul(s, both));
        turned[a][a] = dag.add(m[j][j], in_cos);
        turned[b][b] = dag.sub(m[i][i], in_cos);
        let signed = |dag: &mut Dag, flips: bool, x: ExprId| if flips { dag.neg(x) } else { x };
        let (upper, lower) = (dag.sub(m[i][j], in_sin), dag.sub(m[j][i], in_sin));
        turned[a][b] = signed(dag, self.second_flips, upper);
        turned[b][a] = signed(dag, self.second_flips, lower);

        let rows = |dag: &mut Dag, x: ExprId, y: ExprId| {
            let (cx, sy) = (dag.mul(c, x), dag.mul(s, y));
            let (cy, sx) = (dag.mul(c, y), dag.mul(s, x));
            let first = dag.add(cx, sy);
            let second = dag.sub(cy, sx);
            let first = signed(dag, self.axis_flips, first);
            (
                first,
                signed(dag, self.axis_flips != self.second_flips, second),
            )
        };
        (turned[a][to_k], turned[b][to_k]) = rows(dag, m[i][k], m[j][k]);
        (turned[to_k][a], turned[to_k][b]) = rows(dag, m[k][i], m[k][j]);
        turned
    }
}

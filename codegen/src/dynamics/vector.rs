//! Three-vectors of expressions and products of fixed rotations with them.

use crate::expr::{Dag, ExprId};
use crate::rounded::OF_A_CONSTANT;

/// Coordinates of a vector in some frame.
pub type Vector = [ExprId; 3];

/// A matrix of expressions, `[row][column]`.
pub type Matrix = [[ExprId; 3]; 3];

/// `(0, 0, 0)`
pub fn zero(dag: &mut Dag) -> Vector {
    [dag.zero(); 3]
}

/// Numbers as expressions. A named rounding step: an entry that is no more than rounding of the largest is zero, such as
/// those of an axis or a rotation that was multiplied out.
pub fn constant(dag: &mut Dag, v: [f64; 3]) -> Vector {
    let rounding = v
        .iter()
        .fold(0.0, |size: f64, x| size.max(OF_A_CONSTANT * x.abs()));
    v.map(|x| dag.constant(if x.abs() <= rounding { 0.0 } else { x }))
}

/// `u + v`
pub fn add(dag: &mut Dag, u: Vector, v: Vector) -> Vector {
    std::array::from_fn(|k| dag.add(u[k], v[k]))
}

/// `u - v`
pub fn sub(dag: &mut Dag, u: Vector, v: Vector) -> Vector {
    std::array::from_fn(|k| dag.sub(u[k], v[k]))
}

/// `s v`
pub fn scale(dag: &mut Dag, s: ExprId, v: Vector) -> Vector {
    v.map(|x| dag.mul(s, x))
}

/// `u . v`
pub fn dot(dag: &mut Dag, u: Vector, v: Vector) -> ExprId {
    let [x, y, z] = std::array::from_fn(|k| dag.mul(u[k], v[k]));
    dag.sum([x, y, z])
}

/// `u x v`
pub fn cross(dag: &mut Dag, u: Vector, v: Vector) -> Vector {
    std::array::from_fn(|k| {
        let (i, j) = ((k + 1) % 3, (k + 2) % 3);
        let (left, right) = (dag.mul(u[i], v[j]), dag.mul(u[j], v[i]));
        dag.sub(left, right)
    })
}

/// `A v`
pub fn apply(dag: &mut Dag, a: &Matrix, v: Vector) -> Vector {
    a.map(|row| dot(dag, row, v))
}

/// `A^T v`
pub fn apply_transposed(dag: &mut Dag, a: &Matrix, v: Vector) -> Vector {
    let columns: Matrix = std::array::from_fn(|j| std::array::from_fn(|i| a[i][j]));
    apply(dag, &columns, v)
}

/// `R v` of numbers.
pub fn rotate(r: &[[f64; 3]; 3], v: [f64; 3]) -> [f64; 3] {
    r.map(|row| row.iter().zip(v).map(|(r, v)| r * v).sum())
}

/// `R^T v` of numbers.
pub fn rotate_back(r: &[[f64; 3]; 3], v: [f64; 3]) -> [f64; 3] {
    std::array::from_fn(|j| (0..3).map(|i| r[i][j] * v[i]).sum())
}

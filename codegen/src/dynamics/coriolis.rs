//! The Coriolis matrix whose factorization makes `dM/dt - 2 C` skew.

use crate::expr::{Dag, ExprId, Symbol};

/// `C = 1/2 d v / d dq` of the velocity torque `v(q, dq) = C dq`, `[row][column]`.
///
/// `v_i = sum_jk c_ijk dq_j dq_k` with Christoffel's symbols `c_ijk = c_ikj`, so `d v_i / d dq_j = 2 sum_k c_ijk dq_k`:
/// twice the Christoffel form of `C`, for which `dM/dt - 2 C` is skew.
pub fn coriolis_matrix(dag: &mut Dag, velocity_torque: &[ExprId]) -> Vec<Vec<ExprId>> {
    let dof = velocity_torque.len();
    let columns: Vec<Vec<ExprId>> = (0..dof)
        .map(|j| {
            let column = dag.derivatives(velocity_torque, Symbol::Dq(j));
            column
                .into_iter()
                .map(|entry| dag.scale(0.5, entry))
                .collect()
        })
        .collect();
    (0..dof)
        .map(|i| columns.iter().map(|column| column[i]).collect())
        .collect()
}

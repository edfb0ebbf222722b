//! Partial derivatives of the inverse dynamics, and the inertia that forward dynamics solves with.

use super::Dynamics;
use crate::expr::{Dag, ExprId, Symbol};

/// Slopes of `tau(q, dq, ddq)` at a state, effects included, each `[joint of tau][joint of the coordinate]`.
///
/// `abs` has the slope `sign`, and `sign` the slope 0: at a kink and at a jump that is the mean of both sides, without the
/// jump.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Partials {
    /// `d tau / dq`, N m/rad.
    pub by_position: Vec<Vec<ExprId>>,
    /// `d tau / d dq`, N m s/rad.
    pub by_velocity: Vec<Vec<ExprId>>,
    /// `d tau / d ddq`: the mass matrix with what effects add to it, such as rotors.
    pub by_acceleration: Vec<Vec<ExprId>>,
    /// Whether `tau` is a sum of accelerations with factors and a rest. Load-dependent effects are not: the load of a joint
    /// contains its acceleration, and its sign counts.
    pub is_affine: bool,
}

impl Partials {
    /// Differentiates; the mass matrix is taken as it is, so that its terms are shared.
    pub fn new(dag: &mut Dag, dynamics: &Dynamics) -> Self {
        let tau = &dynamics.inverse_dynamics;
        let effects = jacobian(dag, &dynamics.effect_torque, Symbol::Ddq);
        let by_acceleration = dynamics.mass_matrix.iter().zip(effects);
        Self {
            is_affine: dag.is_affine(tau, &|symbol| matches!(symbol, Symbol::Ddq(_))),
            by_position: jacobian(dag, tau, Symbol::Q),
            by_velocity: jacobian(dag, tau, Symbol::Dq),
            by_acceleration: by_acceleration
                .map(|(row, more)| row.iter().zip(more).map(|(&m, e)| dag.add(m, e)).collect())
                .collect(),
        }
    }

    /// Whether `d tau / d ddq` is symmetric by construction, as a mass matrix is; an effect may act on one joint alone.
    #[must_use]
    pub fn is_symmetric(&self) -> bool {
        let inertia = &self.by_acceleration;
        (0..inertia.len()).all(|i| (0..i).all(|j| inertia[i][j] == inertia[j][i]))
    }
}

/// `[row][joint]`
fn jacobian(dag: &mut Dag, rows: &[ExprId], symbol: fn(usize) -> Symbol) -> Vec<Vec<ExprId>> {
    let columns: Vec<Vec<ExprId>> = (0..rows.len())
        .map(|joint| dag.derivatives(rows, symbol(joint)))
        .collect();
    (0..rows.len())
        .map(|row| columns.iter().map(|column| column[row]).collect())
        .collect()
}

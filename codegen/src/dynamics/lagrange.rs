//! Euler-Lagrange: `tau = d/dt dT/d(dq) - dT/dq + dV/dq`, sorted into `M ddq + C dq + G`.
//!
//! In: an [`EnergyForm`] and an expression for each standard parameter. Out: the torque of every coordinate. Source: any
//! textbook, such as Spong, Hutchinson and Vidyasagar 2006, ch. 7.

use super::energies::Energies;
use super::energy::EnergyForm;
use super::rigid::Terms;
use crate::expr::{Dag, ExprId, Symbol};

/// The equations of motion of a robot that says its energies.
pub struct Lagrangian {
    /// `T` and `V`, as the spec says them.
    pub energies: Energies,
    /// `M(q)`, `[row][column]`: second derivatives of `T` with respect to the rates.
    pub mass_matrix: Vec<Vec<ExprId>>,
    /// `C dq`
    velocity_torque: Vec<ExprId>,
    /// `dV/dq`
    gravity: Vec<ExprId>,
}

impl Lagrangian {
    /// Derives all parts. `positions` are the coordinates' values, `parameters` has one expression per standard parameter.
    pub fn new(
        dag: &mut Dag,
        form: &EnergyForm,
        positions: &[ExprId],
        parameters: &[ExprId],
    ) -> Self {
        let dof = positions.len();
        let (kinetic, potential) = form.energies(dag, parameters);
        let placed = placed(dag, &[kinetic, potential], positions);
        let (kinetic, potential) = (placed[0], placed[1]);
        let momenta: Vec<ExprId> = (0..dof)
            .map(|i| dag.derivative(kinetic, Symbol::Dq(i)))
            .collect();
        let mut mass_matrix = vec![vec![dag.zero(); dof]; dof];
        for i in 0..dof {
            for j in i..dof {
                let entry = dag.derivative(momenta[i], Symbol::Dq(j));
                mass_matrix[i][j] = entry;
                mass_matrix[j][i] = entry;
            }
        }
        Self {
            energies: Energies { kinetic, potential },
            velocity_torque: velocity_torque(dag, &mass_matrix),
            gravity: (0..dof)
                .map(|i| dag.derivative(potential, Symbol::Q(i)))
                .collect(),
            mass_matrix,
        }
    }

    /// Torque of every coordinate, N m or N.
    pub fn torque(&self, dag: &mut Dag, terms: Terms) -> Vec<ExprId> {
        let dof = self.gravity.len();
        let (dq, ddq) = terms.rates(dag, dof);
        let zero = dag.zero();
        (0..dof)
            .map(|i| {
                let mut torque = zero;
                for (entry, ddq) in self.mass_matrix[i].iter().zip(&ddq) {
                    let part = dag.mul(*entry, *ddq);
                    torque = dag.add(torque, part);
                }
                if dag.as_constant(dq[i]).is_none() {
                    torque = dag.add(torque, self.velocity_torque[i]);
                }
                if terms.gravity() {
                    torque = dag.add(torque, self.gravity[i]);
                }
                torque
            })
            .collect()
    }
}

/// Expressions of coordinates where the coordinates have these values.
pub fn placed(dag: &mut Dag, roots: &[ExprId], positions: &[ExprId]) -> Vec<ExprId> {
    dag.substitute(roots, &|symbol| match symbol {
        Symbol::Q(joint) => Some(positions[joint]),
        _ => None,
    })
}

/// `v_i = sum_jk c_ijk dq_j dq_k` with Christoffel's `c_ijk = 1/2 (dM_ij/dq_k + dM_ik/dq_j - dM_jk/dq_i)`.
///
/// Written by symbols, so that slopes that cancel do so before they are multiplied with rates.
fn velocity_torque(dag: &mut Dag, mass_matrix: &[Vec<ExprId>]) -> Vec<ExprId> {
    let dof = mass_matrix.len();
    let dq: Vec<ExprId> = (0..dof).map(|k| dag.symbol(Symbol::Dq(k))).collect();
    let slope = |dag: &mut Dag, i: usize, j: usize, k: usize| {
        dag.derivative(mass_matrix[i][j], Symbol::Q(k))
    };
    (0..dof)
        .map(|i| {
            let mut torque = dag.zero();
            for j in 0..dof {
                for k in j..dof {
                    let (ijk, ikj, jki) = (
                        slope(dag, i, j, k),
                        slope(dag, i, k, j),
                        slope(dag, j, k, i),
                    );
                    let sum = dag.add(ijk, ikj);
                    let twice = dag.sub(sum, jki);
                    // `c_ijk` and `c_ikj` are one.
                    let symbol = dag.scale(if j == k { 0.5 } else { 1.0 }, twice);
                    let rates = dag.mul(dq[j], dq[k]);
                    let part = dag.mul(symbol, rates);
                    torque = dag.add(torque, part);
                }
            }
            torque
        })
        .collect()
}

//! The rigid body, whichever way the spec describes it: `M ddq + C dq + G` and its parts.

use robot_model_spec::model::{Body, Model};

use super::chain::Chain;
use super::changes::Changes;
use super::energies::Energies;
use super::energy::EnergyForm;
use super::lagrange::Lagrangian;
use crate::expr::{Dag, ExprId, Symbol};

/// The rigid body with an expression for each of its standard parameters.
pub enum RigidBody {
    /// Recursion over links.
    Chain(Chain),
    /// Euler-Lagrange from the energies.
    Lagrangian(Lagrangian),
}

/// Which terms of `M ddq + C dq + G` are wanted. The others are left out, not multiplied by zero.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Terms {
    /// `M ddq + C dq + G`
    All,
    /// `C dq + G`
    Bias,
    /// `C dq`
    Velocity,
    /// `G`
    Gravity,
}

impl Terms {
    /// Whether gravity, or the potential energy, counts.
    pub fn gravity(self) -> bool {
        self != Self::Velocity
    }

    /// Velocities and accelerations: symbols where they count, zeros where not.
    pub fn rates(self, dag: &mut Dag, dof: usize) -> (Vec<ExprId>, Vec<ExprId>) {
        let mut rates = |counts: bool, symbol: fn(usize) -> Symbol| -> Vec<ExprId> {
            (0..dof)
                .map(|joint| {
                    if counts {
                        dag.symbol(symbol(joint))
                    } else {
                        dag.zero()
                    }
                })
                .collect()
        };
        (
            rates(self != Self::Gravity, Symbol::Dq),
            rates(self == Self::All, Symbol::Ddq),
        )
    }
}

impl RigidBody {
    /// The body of a model; `parameters` has one expression per standard parameter, those of effects among them.
    pub fn new(
        dag: &mut Dag,
        model: &Model,
        form: Option<&EnergyForm>,
        parameters: &[ExprId],
    ) -> Self {
        let changes = Changes::new(dag, model, parameters);
        match (&model.body, form) {
            (_, Some(form)) => {
                Self::Lagrangian(Lagrangian::new(dag, form, &changes.positions, parameters))
            }
            (Body::Chain(chain), None) => {
                let links = parameters
                    .chunks_exact(10)
                    .take(chain.links.len())
                    .map(|link| std::array::from_fn(|k| link[k]))
                    .collect();
                Self::Chain(Chain::new(dag, &model.joints, chain, links, &changes))
            }
            _ => unreachable!("robots that say their energies come with their form"),
        }
    }

    /// Torque of every joint, N m or N. `labeled` names what the recursion meets on its way.
    pub fn torque(&self, dag: &mut Dag, terms: Terms, labeled: bool) -> Vec<ExprId> {
        match self {
            Self::Chain(chain) => chain.torque(dag, terms, labeled),
            Self::Lagrangian(lagrangian) => lagrangian.torque(dag, terms),
        }
    }

    /// `M(q)`, `[row][column]`.
    pub fn mass_matrix(&self, dag: &mut Dag) -> Vec<Vec<ExprId>> {
        match self {
            Self::Chain(chain) => chain.mass_matrix(dag),
            Self::Lagrangian(lagrangian) => lagrangian.mass_matrix.clone(),
        }
    }

    /// `T` and `V`.
    pub fn energies(&self, dag: &mut Dag) -> Energies {
        match self {
            Self::Chain(chain) => chain.energies(dag),
            Self::Lagrangian(lagrangian) => lagrangian.energies,
        }
    }
}

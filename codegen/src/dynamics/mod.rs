//! From a checked model to its equations of motion: `tau = M ddq + C dq + G + effects`.
//!
//! In: a [`Model`], and for every standard parameter an expression. Out: [`Dynamics`]. Invariants gained: `M` is symmetric
//! by construction, `dM/dt - 2 C` is skew by construction.

mod chain;
mod changes;
mod columns;
mod composite;
mod computed;
mod coriolis;
pub mod effect;
mod energies;
pub mod energy;
pub mod fourier;
mod frame;
mod inertia;
mod kinematics;
mod lagrange;
mod lean;
mod lower;
mod partial;
mod point;
#[cfg(test)]
mod rewrites;
mod rigid;
mod twist;
mod vanishing;
mod vector;

use robot_model_spec::model::{Act, EffectDefinition, Model};

use crate::expr::{Dag, ExprId, Label, Symbol};
use crate::motors;
use chain::Chain;
pub use changes::Changes;
pub use computed::{Computed, cheapest_regressor, compute};
pub(crate) use effect::Means;
pub use energies::Energies;
use energy::EnergyForm;
pub use kinematics::{Kinematics, Lever, Pose};
pub use partial::Partials;
pub use point::{Point, points};
use rigid::{RigidBody, Terms};

/// What stands for each standard parameter in the derivation.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Value {
    /// A symbol of its own.
    Symbol,
    /// A number; zero makes its terms vanish.
    Number(f64),
}

/// The equations of motion as expressions of `q, dq, ddq` and the parameters.
#[derive(Debug, Clone)]
pub struct Dynamics {
    /// Degrees of freedom.
    pub dof: usize,
    /// `M ddq + C dq + G`, N m or N.
    pub rigid_torque: Vec<ExprId>,
    /// What of it is of motors in sums with links, which transmissions do not carry, N m or N; nothing where there are none.
    pub motor_torque: Option<Vec<ExprId>>,
    /// What transmissions carry: `rigid_torque - motor_torque`.
    pub load: Vec<ExprId>,
    /// Torque of the declared effects, load-dependent ones at `load`.
    pub effect_torque: Vec<ExprId>,
    /// `rigid_torque + effect_torque`
    pub inverse_dynamics: Vec<ExprId>,
    /// `M(q)`, `[row][column]`.
    pub mass_matrix: Vec<Vec<ExprId>>,
    /// `C(q, dq)` of Christoffel, `[row][column]`.
    pub coriolis_matrix: Vec<Vec<ExprId>>,
    /// `G(q)`
    pub gravity: Vec<ExprId>,
    /// `C dq + G`
    pub bias: Vec<ExprId>,
    /// `T` and `V` of the rigid body.
    pub energies: Energies,
    /// Rates of the declared effects' states, load-dependent ones at [`Symbol::RigidTorque`].
    pub state_rates: Vec<ExprId>,
}

/// Derives the equations of motion. `values` has one entry per standard parameter of the model; `form` are the energies of
/// a robot that says them; `motor_torque` is that of motors in sums with links.
pub fn derive(
    dag: &mut Dag,
    model: &Model,
    form: Option<&EnergyForm>,
    values: &[Value],
    motor_torque: Option<Vec<ExprId>>,
) -> Dynamics {
    let dof = model.joints.len();
    let parameters = parameter_expressions(dag, values);
    let body = RigidBody::new(dag, model, form, &parameters);

    let rigid_torque = body.torque(dag, Terms::All, true);
    let bias = body.torque(dag, Terms::Bias, false);
    let gravity = body.torque(dag, Terms::Gravity, false);

    let mass_matrix = body.mass_matrix(dag);
    for (row, entries) in mass_matrix.iter().enumerate() {
        for (column, &entry) in entries.iter().enumerate().skip(row) {
            dag.set_label(
                entry,
                Label::Entry {
                    stem: "m",
                    row,
                    column,
                },
            );
        }
    }
    let velocity_torque = body.torque(dag, Terms::Velocity, false);
    let coriolis_matrix = coriolis::coriolis_matrix(dag, &velocity_torque);

    let load = motors::without(dag, &rigid_torque, motor_torque.as_deref());
    let effect_torque = effect_torque(dag, model, &parameters, &load, Means::ALL);
    let inverse_dynamics = (0..dof)
        .map(|joint| dag.add(rigid_torque[joint], effect_torque[joint]))
        .collect();
    let state_rates = state_rates(dag, model);
    Dynamics {
        state_rates,
        dof,
        rigid_torque,
        motor_torque,
        load,
        effect_torque,
        inverse_dynamics,
        mass_matrix,
        coriolis_matrix,
        gravity,
        bias,
        energies: body.energies(dag),
    }
}

/// `M ddq + C dq + G` alone, for uses that need nothing else.
pub fn rigid_torque(
    dag: &mut Dag,
    model: &Model,
    form: Option<&EnergyForm>,
    values: &[Value],
) -> Vec<ExprId> {
    let parameters = parameter_expressions(dag, values);
    RigidBody::new(dag, model, form, &parameters).torque(dag, Terms::All, false)
}

/// Energies of the rigid body alone, for uses that need nothing else.
pub fn energies(
    dag: &mut Dag,
    model: &Model,
    form: Option<&EnergyForm>,
    values: &[Value],
) -> Energies {
    let parameters = parameter_expressions(dag, values);
    RigidBody::new(dag, model, form, &parameters).energies(dag)
}

/// Where the links are; `None` for a robot without links.
pub fn kinematics(dag: &mut Dag, model: &Model) -> Option<Kinematics> {
    Some(massless(dag, model)?.kinematics(dag))
}

/// Definitions of the declared effects.
pub(crate) fn declared(model: &Model) -> impl Iterator<Item = &EffectDefinition> {
    model
        .effects
        .iter()
        .map(|effect| effect.definition.as_ref())
}

/// What forces on links are multiplied with; empty where none of these effects is a force.
pub(crate) fn levers<'a>(
    dag: &mut Dag,
    model: &Model,
    effects: impl IntoIterator<Item = &'a EffectDefinition>,
) -> Vec<Lever> {
    let mut acts = effects.into_iter().flat_map(|effect| &effect.acts);
    if !acts.any(|act| matches!(act, Act::Force { .. })) {
        return Vec::new();
    }
    let tip = model.chain().map_or([0.0; 3], |chain| chain.tip);
    massless(dag, model).map_or_else(Vec::new, |chain| chain.levers(dag, tip))
}

fn massless(dag: &mut Dag, model: &Model) -> Option<Chain> {
    let chain = model.chain()?;
    let links = vec![[dag.zero(); 10]; chain.links.len()];
    let changes = Changes::of(dag, model);
    Some(Chain::new(dag, &model.joints, chain, links, &changes))
}

fn parameter_expressions(dag: &mut Dag, values: &[Value]) -> Vec<ExprId> {
    values
        .iter()
        .enumerate()
        .map(|(k, value)| match value {
            Value::Symbol => dag.symbol(Symbol::Parameter(k)),
            Value::Number(number) => dag.constant(*number),
        })
        .collect()
}

/// Sum of the declared effects' torques by some means, load-dependent ones at [`Symbol::RigidTorque`].
pub(crate) fn loaded_effect_torque(
    dag: &mut Dag,
    model: &Model,
    values: &[Value],
    means: &[Means],
) -> Vec<ExprId> {
    let parameters = parameter_expressions(dag, values);
    let rigid_torque = effect::outside_rigid_torque(dag, model.joints.len());
    effect_torque(dag, model, &parameters, &rigid_torque, means)
}

/// Sum of the declared effects' torques by some means.
fn effect_torque(
    dag: &mut Dag,
    model: &Model,
    parameters: &[ExprId],
    rigid_torque: &[ExprId],
    means: &[Means],
) -> Vec<ExprId> {
    let mut sum = vec![dag.zero(); model.joints.len()];
    let levers = levers(dag, model, declared(model));
    effect::each_declared(
        dag,
        model,
        parameters,
        rigid_torque,
        &levers,
        |dag, declared, scope| {
            for (joint, torque) in effect::torques(dag, &declared.definition, scope, means) {
                sum[joint] = dag.add(sum[joint], torque);
            }
        },
    );
    sum
}

/// Rates of the declared effects' states, in the order of [`Symbol::State`]; the load of those that depend on it is
/// [`Symbol::RigidTorque`].
fn state_rates(dag: &mut Dag, model: &Model) -> Vec<ExprId> {
    let rigid_torque = effect::outside_rigid_torque(dag, model.joints.len());
    // Rates are free of linear parameters, but they stand beside bindings that are not.
    let nothing = vec![dag.zero(); model.standard_parameters().len()];
    let mut rates = Vec::new();
    effect::each_declared(
        dag,
        model,
        &nothing,
        &rigid_torque,
        &[],
        |dag, declared, scope| {
            rates.extend(effect::rates(dag, &declared.definition, scope));
        },
    );
    rates
}

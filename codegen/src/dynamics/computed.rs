//! The equations as they are computed: the same values as those of [`Dynamics`](super::Dynamics) and of the linear form, which are
//! written to be read, from the derivations with the fewest operations.

use robot_model_spec::model::Model;

use super::chain::Chain;
use super::columns::{self, Columns, Way};
use super::coriolis;
use super::energy::EnergyForm;
use super::lean::{Choice, LeanChain, Wanted};
use super::rigid::{RigidBody, Terms};
use super::vanishing::without_vanishing;
use super::{Dynamics, Means, Value, effect_torque, parameter_expressions};
use crate::expr::{Dag, ExprId, Symbol};
use crate::motors;
use crate::optimize::{self, Cost, optimize};

/// Torques and matrices, as of [`Dynamics`](super::Dynamics).
#[derive(Debug, Clone)]
#[non_exhaustive]
pub struct Computed {
    /// `M ddq + C dq + G`
    pub rigid_torque: Vec<ExprId>,
    /// What transmissions carry of it: that without motors in sums with links.
    pub load: Vec<ExprId>,
    /// With the torque of the declared effects.
    pub inverse_dynamics: Vec<ExprId>,
    /// `C dq + G`
    pub bias: Vec<ExprId>,
    /// `G(q)`
    pub gravity: Vec<ExprId>,
    /// `M(q)`, `[row][column]`.
    pub mass_matrix: Vec<Vec<ExprId>>,
    /// `C(q, dq)` of Christoffel, `[row][column]`.
    pub coriolis_matrix: Vec<Vec<ExprId>>,
}

impl Computed {
    /// The equations as they are read.
    #[must_use]
    pub fn as_read(dynamics: &Dynamics) -> Self {
        Self {
            rigid_torque: dynamics.rigid_torque.clone(),
            load: dynamics.load.clone(),
            inverse_dynamics: dynamics.inverse_dynamics.clone(),
            bias: dynamics.bias.clone(),
            gravity: dynamics.gravity.clone(),
            mass_matrix: dynamics.mass_matrix.clone(),
            coriolis_matrix: dynamics.coriolis_matrix.clone(),
        }
    }
}

/// Derives what [`derive`](super::derive) derives, to be computed. With numbers for all parameters that is the arm itself:
/// what its numbers make vanish is gone. `motor_torque` is that of motors in sums with links.
pub fn compute(
    dag: &mut Dag,
    model: &Model,
    form: Option<&EnergyForm>,
    values: &[Value],
    motor_torque: Option<&[ExprId]>,
) -> Computed {
    let parameters = parameter_expressions(dag, values);
    let body = RigidBody::new(dag, model, form, &parameters);
    let torque = |dag: &mut Dag, terms: Terms| {
        let plain = body.torque(dag, terms, terms == Terms::All);
        let RigidBody::Chain(chain) = &body else {
            return plain;
        };
        let choice = choice(model, values, Wanted::Torque(terms));
        let lean = LeanChain::new(dag, chain, &choice).torque(dag, terms);
        let [lean, plain] = [lean, plain].map(|torque| without_vanishing(dag, torque));
        cheaper(dag, lean, plain)
    };
    let rigid_torque = torque(dag, Terms::All);
    let bias = torque(dag, Terms::Bias);
    let gravity = torque(dag, Terms::Gravity);
    let load = motors::without(dag, &rigid_torque, motor_torque);
    let effects = effect_torque(dag, model, &parameters, &load, Means::ALL);
    let velocity_torque = body.torque(dag, Terms::Velocity, false);
    let derived = coriolis::coriolis_matrix(dag, &velocity_torque);
    let (mass_matrix, coriolis_matrix) = match body {
        RigidBody::Chain(chain) => {
            let best = choice(model, values, Wanted::MassMatrix);
            let torques = choice(model, values, Wanted::Torque(Terms::All)).with_inertias();
            let plain = Choice::plain(model.joints.len());
            let coriolis_matrix =
                cheapest_coriolis_matrix(dag, &chain, &derived, &[&best, &torques, &plain]);
            let chain = LeanChain::new(dag, &chain, &best).into_chain();
            let mass_matrix = chain.mass_matrix(dag).concat();
            (rows(&without_vanishing(dag, mass_matrix)), coriolis_matrix)
        }
        RigidBody::Lagrangian(lagrangian) => (lagrangian.mass_matrix, derived),
    };
    Computed {
        inverse_dynamics: rigid_torque
            .iter()
            .zip(effects)
            .map(|(&rigid, effect)| dag.add(rigid, effect))
            .collect(),
        rigid_torque,
        load,
        bias,
        gravity,
        mass_matrix,
        coriolis_matrix,
    }
}

/// How the chain is best written; found on a dag of its own, which is small.
fn choice(model: &Model, values: &[Value], wanted: Wanted) -> Choice {
    let mut dag = Dag::new();
    let parameters = parameter_expressions(&mut dag, values);
    match RigidBody::new(&mut dag, model, None, &parameters) {
        RigidBody::Chain(chain) => Choice::best(&dag, &chain, wanted),
        RigidBody::Lagrangian(_) => Choice::plain(model.joints.len()),
    }
}

/// By derivatives, which few joints and parallel axes simplify, or by composite bodies in one of the ways to write the chain.
fn cheapest_coriolis_matrix(
    dag: &mut Dag,
    chain: &Chain,
    derived: &[Vec<ExprId>],
    choices: &[&Choice],
) -> Vec<Vec<ExprId>> {
    let mut best = without_vanishing(dag, derived.concat());
    for choice in choices {
        let chain = LeanChain::new(dag, chain, choice).into_chain();
        let composite = chain.coriolis_matrix(dag).concat();
        let composite = without_vanishing(dag, composite);
        best = cheaper(dag, best, composite);
    }
    rows(&best)
}

/// The rows of a square matrix.
fn rows(matrix: &[ExprId]) -> Vec<Vec<ExprId>> {
    let dof = matrix.len().isqrt().max(1);
    matrix.chunks(dof).map(<[ExprId]>::to_vec).collect()
}

/// The regressor of the rigid body from the columns of its links, `[joint][parameter]`, where that takes fewer operations in the columns of
/// the `wanted` parameters: the entries of `regressor` are replaced where `is_rigid`, and none that is zero is computed.
pub fn cheapest_regressor(
    dag: &mut Dag,
    model: &Model,
    regressor: &[Vec<ExprId>],
    is_rigid: &dyn Fn(usize) -> bool,
    wanted: &[usize],
) -> Vec<Vec<ExprId>> {
    let count = regressor.first().map_or(0, Vec::len);
    let symbols = vec![Value::Symbol; count];
    let parameters = parameter_expressions(dag, &symbols);
    let body = model
        .chain()
        .is_some()
        .then(|| RigidBody::new(dag, model, None, &parameters));
    let Some(RigidBody::Chain(chain)) = &body else {
        return regressor.to_vec();
    };
    let is_wanted =
        |link: usize, element: usize| wanted.binary_search(&(10 * link + element)).is_ok();
    let way = best_way(model, &symbols, &is_wanted);
    let columns = columns::columns(dag, chain, &way, &is_wanted);
    let computed = by_columns(dag, chain, regressor, is_rigid, &columns);
    let of_wanted = |rows: &[Vec<ExprId>]| -> Vec<ExprId> {
        let entries = rows.iter().flat_map(|row| wanted.iter().map(|&k| row[k]));
        entries.collect()
    };
    if operations(dag, &of_wanted(regressor)) < operations(dag, &of_wanted(&computed)) {
        regressor.to_vec()
    } else {
        computed
    }
}

/// How columns are best found; on a dag of its own, which is small.
fn best_way(model: &Model, symbols: &[Value], wanted: &dyn Fn(usize, usize) -> bool) -> Way {
    let mut dag = Dag::new();
    let parameters = parameter_expressions(&mut dag, symbols);
    match RigidBody::new(&mut dag, model, None, &parameters) {
        RigidBody::Chain(chain) => Way::best(&dag, &chain, wanted),
        RigidBody::Lagrangian(_) => Way::default(),
    }
}

/// The regressor from the columns of the links.
fn by_columns(
    dag: &mut Dag,
    chain: &Chain,
    regressor: &[Vec<ExprId>],
    is_rigid: &dyn Fn(usize) -> bool,
    columns: &[Columns],
) -> Vec<Vec<ExprId>> {
    let mut computed = regressor.to_vec();
    let count = regressor.first().map_or(0, Vec::len);
    for parameter in (0..count).filter(|&k| is_rigid(k)) {
        let shares = shares(dag, chain, parameter);
        for (joint, row) in computed.iter_mut().enumerate() {
            if dag.as_constant(row[parameter]).is_some() {
                continue;
            }
            let terms: Vec<ExprId> = shares
                .iter()
                .map(|&(link, element, share)| dag.mul(share, columns[link][element][joint]))
                .collect();
            row[parameter] = dag.sum(terms);
        }
    }
    computed
}

/// `(link, element, d element / d parameter)` where it is not zero.
fn shares(dag: &mut Dag, chain: &Chain, parameter: usize) -> Vec<(usize, usize, ExprId)> {
    let mut shares = Vec::new();
    for (link, elements) in chain.links.iter().enumerate() {
        let slopes = dag.derivatives(elements, Symbol::Parameter(parameter));
        for (element, slope) in slopes.into_iter().enumerate() {
            if !dag.is_zero(slope) {
                shares.push((link, element, slope));
            }
        }
    }
    shares
}

/// The list with fewer operations; the first of equals.
fn cheaper(dag: &Dag, first: Vec<ExprId>, second: Vec<ExprId>) -> Vec<ExprId> {
    /// What is sharing away is looked at where that takes no time.
    const SMALL: usize = 1_500;
    let lists = [&first, &second];
    let mut costs = lists.map(|list| operations(dag, list));
    if costs.iter().all(|&cost| cost < SMALL) {
        costs = lists.map(|list| price(optimize(dag, list).cost()));
    }
    if costs[1] < costs[0] { second } else { first }
}

/// Multiplications and additions, and what sines and cosines are worth of them.
pub(super) fn operations(dag: &Dag, outputs: &[ExprId]) -> usize {
    price(optimize::operations(dag, outputs))
}

/// An angle more, for its sine and cosine, takes as long as some ten operations where all angles go through one register, and
/// several times that where libm takes them one by one.
fn price(cost: Cost) -> usize {
    const SINE: usize = 5;
    cost.mul + cost.add + SINE * cost.trig
}

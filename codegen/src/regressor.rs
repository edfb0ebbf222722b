//! The exact linear form `tau = Y(q, dq, ddq) * standard`.
//!
//! In: a [`Model`]. Out: [`LinearForm`]. Invariant gained: no entry of `Y` contains a parameter.

use robot_model_spec::model::Model;

use crate::dynamics::energy::EnergyForm;
use crate::dynamics::{self, Value, effect};
use crate::expr::{Dag, ExprId, Symbol};

/// `tau = Y * standard`, with the load of load-dependent effects as [`Symbol::RigidTorque`].
#[derive(Debug, Clone)]
#[non_exhaustive]
pub struct LinearForm {
    /// `Y[joint][parameter]`; zero where a joint's torque does not depend on a parameter.
    pub regressor: Vec<Vec<ExprId>>,
}

impl LinearForm {
    /// The entries of one column that are not zero by structure: `(joint, entry)`.
    pub fn column<'a>(
        &'a self,
        dag: &'a Dag,
        parameter: usize,
    ) -> impl Iterator<Item = (usize, ExprId)> + 'a {
        self.regressor
            .iter()
            .enumerate()
            .map(move |(joint, row)| (joint, row[parameter]))
            .filter(|&(_, entry)| !dag.is_zero(entry))
    }
}

/// `form` are the energies of a robot that says them; columns without a term in it are zero.
///
/// Differentiates the torque with respect to each standard parameter; the torque is linear in them, so that is exact.
pub fn linearize(dag: &mut Dag, model: &Model, form: Option<&EnergyForm>) -> LinearForm {
    let dof = model.joints.len();
    let inertial = model.rigid_parameters();
    let standard = model.standard_parameters();
    let count = standard.len();
    let rigid_torque = dynamics::rigid_torque(dag, model, form, &vec![Value::Symbol; count]);
    let mut regressor = vec![vec![dag.zero(); count]; dof];
    // Bodies that effects add are columns of the rigid body too.
    for parameter in (0..count).filter(|&k| model.is_rigid(&standard[k])) {
        let column = dag.derivatives(&rigid_torque, Symbol::Parameter(parameter));
        for (row, entry) in regressor.iter_mut().zip(column) {
            row[parameter] = entry;
        }
    }
    let outside = effect::outside_rigid_torque(dag, dof);
    let levers = dynamics::levers(dag, model, dynamics::declared(model));
    let mut first = inertial;
    for (index, declared) in model.effects.iter().enumerate() {
        let symbols: Vec<Symbol> = (first..first + declared.definition.linear.len())
            .map(Symbol::Parameter)
            .collect();
        let linear: Vec<ExprId> = symbols.iter().map(|&symbol| dag.symbol(symbol)).collect();
        let names = effect::Symbols::declared(dag, model, index);
        let scope = effect::Scope {
            linear: &linear,
            symbols: &names,
            joints: &declared.joints,
            rigid_torque: &outside,
            levers: &levers,
        };
        for entry in effect::entries(dag, &declared.definition, &scope, &symbols) {
            let cell = &mut regressor[entry.joint][first + entry.parameter];
            *cell = dag.add(*cell, entry.value);
        }
        first += symbols.len();
    }
    let entries: Vec<ExprId> = regressor.iter().flatten().copied().collect();
    let parameter_free = dag
        .symbols(&entries)
        .iter()
        .all(|symbol| !matches!(symbol, Symbol::Parameter(_)));
    assert!(
        parameter_free,
        "checked in model-spec: effects are linear in their linear parameters"
    );
    LinearForm { regressor }
}

/// The same form to be computed, in the columns of the `wanted` parameters; others have values too.
pub fn computed(dag: &mut Dag, model: &Model, form: &LinearForm, wanted: &[usize]) -> LinearForm {
    let standard = model.standard_parameters();
    let is_rigid = |parameter: usize| model.is_rigid(&standard[parameter]);
    LinearForm {
        regressor: dynamics::cheapest_regressor(dag, model, &form.regressor, &is_rigid, wanted),
    }
}

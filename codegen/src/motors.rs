//! What of a base parameter a motor has, where its links have the rest.
//!
//! The inertia of a rotor and that of the links which it turns are told as one sum where no other joint feels the links alone: about the
//! axes of a first and often of a second joint. A transmission carries the links without the rotor. So effects that read the load take of
//! such a sum what the links have nominally, and the rotor has what is more.

use robot_model_spec::model::{EffectExpr, EffectLeaf, Expr, Model, Signal};
use robot_model_spec::parameter::{StandardParameter, Status};

use crate::base::BaseForm;
use crate::compiled::Compiled;
use crate::dynamics::Value;
use crate::expr::{Dag, ExprId, Symbol};
use crate::interpreter::Program;

/// A base parameter of links and of one motor.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Shared {
    /// The standard parameter, of a link, that it stands for.
    kept: usize,
    /// The motor's standard parameter, and its coefficient in the sum.
    motor: usize,
    coefficient: f64,
    /// What the links have of the sum by the spec's nominal values, above 0.
    nominal: f64,
}

/// Those of a chain whose links have nominal values.
fn shared(model: &Model, standard: &[StandardParameter], base: &BaseForm) -> Vec<Shared> {
    if model.chain().is_none() {
        return Vec::new();
    }
    let of_base = |(kept, combination): (&usize, &Vec<(usize, f64)>)| {
        let (links, others): (Vec<_>, Vec<_>) = combination
            .iter()
            .copied()
            .partition(|&(k, _)| model.is_rigid(&standard[k]));
        let &[(motor, coefficient)] = &others[..] else {
            return None;
        };
        let values = links.iter().map(|&(k, share)| match standard[k].status {
            Status::Nominal(value) => Some(share * value),
            Status::Unknown | Status::Fixed(_) => None,
        });
        let nominal = values.sum::<Option<f64>>()?;
        let is_shared = links.iter().any(|(k, _)| k == kept)
            && model.is_nonnegative(&standard[motor])
            && coefficient > 0.0
            && nominal > 0.0;
        is_shared.then_some(Shared {
            kept: *kept,
            motor,
            coefficient,
            nominal,
        })
    };
    base.kept
        .iter()
        .zip(&base.combinations)
        .filter_map(of_base)
        .collect()
}

/// Whether a declared effect reads the load, by its equations.
fn reads_load(model: &Model) -> bool {
    let is_load =
        |part: &EffectExpr| matches!(part, Expr::Leaf(EffectLeaf::Signal(Signal::RigidTorque, _)));
    model.effects.iter().any(|effect| {
        let bindings = effect.definition.bindings.iter();
        let mut all = effect
            .definition
            .equations()
            .chain(bindings.map(|binding| &binding.value));
        all.any(|value| value.contains(&is_load))
    })
}

/// Gives motors their shares among the values of base parameters, where a declared effect reads the load; `beta` are the numbers of an arm.
pub(crate) fn share(
    model: &Model,
    standard: &[StandardParameter],
    base: &BaseForm,
    beta: Option<&[f64]>,
    values: &mut [Value],
) {
    if !reads_load(model) {
        return;
    }
    for Shared {
        kept,
        motor,
        coefficient,
        nominal,
    } in shared(model, standard, base)
    {
        let sum = beta.and_then(|beta| {
            let column = base.kept.iter().position(|&k| k == kept)?;
            Some(beta[column])
        });
        (values[kept], values[motor]) = match sum {
            Some(sum) => (
                Value::Number(sum.min(nominal)),
                Value::Number((sum - nominal).max(0.0) / coefficient),
            ),
            None => (
                Value::UpTo(nominal),
                Value::Above {
                    of: kept,
                    nominal,
                    coefficient,
                },
            ),
        };
    }
}

impl Compiled {
    /// Torque of the motors whose inertia is told as one sum with that of links, one output a joint, `(sum - nominal)` times the sum's
    /// column where the sum is more than what links have nominally; reads base parameters as [`Self::rigid_torque`] does. `None` where
    /// there are none, or where the spec has no nominal values to tell their share.
    #[must_use]
    pub fn motor_torque(&self) -> Option<Program> {
        let shared = shared(&self.model, &self.standard, &self.base);
        let mut dag = self.dag.clone();
        let torque = self.torque_of_motors(&mut dag, &shared)?;
        Some(Program::new(&dag, &torque))
    }

    /// What transmissions carry: [`Self::rigid_torque`] without [`Self::motor_torque`].
    #[must_use]
    pub fn load(&self) -> Program {
        let mut dag = self.dag.clone();
        let mut load = self.computed.rigid_torque.clone();
        // Where a declared effect reads the load it is without the motors already.
        if !reads_load(&self.model) {
            let shared = shared(&self.model, &self.standard, &self.base);
            for (load, motor) in load
                .iter_mut()
                .zip(self.torque_of_motors(&mut dag, &shared).unwrap_or_default())
            {
                *load = dag.sub(*load, motor);
            }
        }
        Program::new(&dag, &load)
    }

    fn torque_of_motors(&self, dag: &mut Dag, shared: &[Shared]) -> Option<Vec<ExprId>> {
        let mut torque = vec![dag.zero(); self.dof()];
        for &Shared { kept, nominal, .. } in shared {
            let sum = self.value(dag, kept);
            let above = above(dag, sum, nominal);
            let column: Vec<(usize, ExprId)> =
                self.computed_candidates.column(&self.dag, kept).collect();
            for (joint, entry) in column {
                let more = dag.mul(above, entry);
                torque[joint] = dag.add(torque[joint], more);
            }
        }
        (!shared.is_empty()).then_some(torque)
    }

    /// A base parameter as a symbol, or its number.
    fn value(&self, dag: &mut Dag, kept: usize) -> ExprId {
        let column = self.base.kept.iter().position(|&k| k == kept);
        match (&self.baked, column) {
            (Some(beta), Some(column)) => dag.constant(beta[column]),
            _ => dag.symbol(Symbol::Parameter(kept)),
        }
    }
}

/// By how much a sum is above what links have of it nominally.
pub(crate) fn above(dag: &mut Dag, sum: ExprId, nominal: f64) -> ExprId {
    let nominal = dag.constant(nominal);
    let more = dag.sub(sum, nominal);
    let zero = dag.zero();
    dag.max(more, zero)
}

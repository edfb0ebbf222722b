//! What of a base parameter a motor has, where its links have the rest.
//!
//! The inertia of a rotor and that of the links which it turns are told as one sum where no other joint feels the links alone: about the
//! axes of a first and often of a second joint. The rigid body has the whole sum. A transmission carries the links without the rotor: of
//! such a sum what the links have by the spec's nominal values, and the rotor has what is more.

use robot_model_spec::model::{EffectExpr, EffectLeaf, Expr, Model, Signal};
use robot_model_spec::parameter::{StandardParameter, Status};

use crate::base::BaseForm;
use crate::compiled::Compiled;
use crate::expr::{Dag, ExprId, Symbol};
use crate::interpreter::Program;
use crate::regressor::LinearForm;

/// A base parameter of links and of one motor.
struct Sum {
    /// Which base parameter.
    base: usize,
    /// What the links have of it nominally; below 0 it may be where a link's frame is not at its joint.
    nominal: f64,
}

/// Those of a chain whose links have nominal values. The motor is in no other sum: then its column is that of the sum, but for a factor.
fn sums(model: &Model, standard: &[StandardParameter], base: &BaseForm) -> Vec<Sum> {
    if model.chain().is_none() {
        return Vec::new();
    }
    let count = |motor: usize| {
        let combinations = base.combinations.iter();
        let has = |combination: &&Vec<(usize, f64)>| combination.iter().any(|&(k, _)| k == motor);
        combinations.filter(has).count()
    };
    let of_base = |(column, combination): (usize, &Vec<(usize, f64)>)| {
        let (links, others): (Vec<_>, Vec<_>) = combination
            .iter()
            .copied()
            .partition(|&(k, _)| model.is_rigid(&standard[k]));
        let &[(motor, factor)] = &others[..] else {
            return None;
        };
        let values = links.iter().map(|&(k, share)| match standard[k].status {
            Status::Nominal(value) => Some(share * value),
            Status::Unknown | Status::Fixed(_) => None,
        });
        let nominal = values.sum::<Option<f64>>()?;
        let is_of_motor = model.is_nonnegative(&standard[motor]) && factor > 0.0;
        let is_shared = !links.is_empty() && count(motor) == 1;
        (is_of_motor && is_shared).then_some(Sum {
            base: column,
            nominal,
        })
    };
    let combinations = base.combinations.iter().enumerate();
    combinations.filter_map(of_base).collect()
}

/// Torque of the motors in sums with links, one a joint: `max(sum - nominal, 0)` times the sum's column; nothing where there are none.
/// `beta` are the numbers of an arm, whose symbols they stand for.
pub(crate) fn torque(
    dag: &mut Dag,
    model: &Model,
    base: &BaseForm,
    columns: &LinearForm,
    beta: Option<&[f64]>,
) -> Option<Vec<ExprId>> {
    let standard = model.standard_parameters();
    let sums = sums(model, &standard, base);
    let mut torque = vec![dag.zero(); model.joints.len()];
    for sum in &sums {
        let kept = base.kept[sum.base];
        let value = match beta {
            Some(beta) => dag.constant(beta[sum.base]),
            None => dag.symbol(Symbol::Parameter(kept)),
        };
        let (nominal, zero) = (dag.constant(sum.nominal), dag.zero());
        let more = dag.sub(value, nominal);
        let more = dag.max(more, zero);
        for (joint, row) in columns.regressor.iter().enumerate() {
            let of_motor = dag.mul(more, row[kept]);
            torque[joint] = dag.add(torque[joint], of_motor);
        }
    }
    (!sums.is_empty()).then_some(torque)
}

/// What transmissions carry of a torque of the rigid body.
pub(crate) fn without(dag: &mut Dag, rigid: &[ExprId], motors: Option<&[ExprId]>) -> Vec<ExprId> {
    let Some(motors) = motors else {
        return rigid.to_vec();
    };
    let pairs = rigid.iter().zip(motors);
    pairs
        .map(|(&rigid, &motor)| dag.sub(rigid, motor))
        .collect()
}

impl Compiled {
    /// Torque of the motors whose inertia is told as one sum with that of links, one output a joint: `max(sum - nominal, 0) c(ddq)`,
    /// `c` being the column of the sum and `nominal` what links have of it by the spec; reads base parameters as [`Self::rigid_torque`]
    /// does. `None` where there are none, or where the spec has no nominal values to tell their share.
    #[must_use]
    pub fn motor_torque(&self) -> Option<Program> {
        let motors = self.dynamics.motor_torque.as_deref()?;
        Some(Program::new(&self.dag, motors))
    }

    /// What transmissions carry, one output a joint: `M ddq + C dq + G`, [`Self::rigid_torque`], without [`Self::motor_torque`]. Effects
    /// read it as `rigid_torque(j)`.
    #[must_use]
    pub fn load(&self) -> Program {
        Program::new(&self.dag, &self.computed.load)
    }

    /// Whether a declared effect reads the load, and numbers of a motor that stand for themselves are more than the sum that they are in.
    #[must_use]
    pub fn parts_motors(&self) -> bool {
        self.reads_load() && !self.mixed().is_empty()
    }

    /// Whether a declared effect reads a load that the mass matrix and the bias alone do not make.
    pub(crate) fn has_motors_in_loads(&self) -> bool {
        self.dynamics.motor_torque.is_some() && self.reads_load()
    }

    /// Whether a declared effect reads the load.
    fn reads_load(&self) -> bool {
        let is_load = |part: &EffectExpr| {
            matches!(part, Expr::Leaf(EffectLeaf::Signal(Signal::RigidTorque, _)))
        };
        self.model.effects.iter().any(|effect| {
            let bindings = effect.definition.bindings.iter();
            let bindings = bindings.map(|binding| &binding.value);
            let mut all = effect.definition.equations().chain(bindings);
            all.any(|value| value.contains(&is_load))
        })
    }

    /// Expressions that read the torque of the rigid body where these read the load.
    pub(crate) fn reading_rigid_torque(&self, dag: &mut Dag, roots: &[ExprId]) -> Vec<ExprId> {
        let Some(motors) = self.dynamics.motor_torque.clone() else {
            return roots.to_vec();
        };
        let loads: Vec<ExprId> = motors
            .into_iter()
            .enumerate()
            .map(|(joint, motor)| {
                let rigid = dag.symbol(Symbol::RigidTorque(joint));
                dag.sub(rigid, motor)
            })
            .collect();
        dag.substitute(roots, &|symbol| match symbol {
            Symbol::RigidTorque(joint) => Some(loads[joint]),
            _ => None,
        })
    }
}

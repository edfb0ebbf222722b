//! Effects as the language defines them, lowered to expressions for given joints.

use robot_model_spec::model::{EffectDefinition, EffectExpr, EffectLeaf, Signal};

use super::lower::lower_with;
use crate::expr::{Dag, ExprId, Symbol};

/// What the names in an effect's definition stand for.
pub struct Scope<'a> {
    /// Linear parameters.
    pub linear: &'a [ExprId],
    /// Shape parameters.
    pub shapes: &'a [ExprId],
    /// Joint indices, one per formal joint.
    pub joints: &'a [usize],
    /// Torque of the rigid body, one per joint of the arm: symbols where it comes from outside, expressions where not.
    pub rigid_torque: &'a [ExprId],
}

/// `RigidTorque(0), RigidTorque(1), ..`
pub fn outside_rigid_torque(dag: &mut Dag, dof: usize) -> Vec<ExprId> {
    (0..dof)
        .map(|joint| dag.symbol(Symbol::RigidTorque(joint)))
        .collect()
}

/// `(joint, torque)` for each joint that the effect acts on.
pub fn torques(
    dag: &mut Dag,
    definition: &EffectDefinition,
    scope: &Scope<'_>,
) -> Vec<(usize, ExprId)> {
    definition
        .torques
        .iter()
        .map(|torque| (scope.joints[torque.joint], lower(dag, &torque.value, scope)))
        .collect()
}

/// One column entry of an effect: what a linear parameter is multiplied with on one joint.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct EffectEntry {
    /// The joint whose torque it is, from 0.
    pub joint: usize,
    /// Index into the definition's linear parameters.
    pub parameter: usize,
    /// The coefficient.
    pub value: ExprId,
}

/// The nonzero coefficients of the linear parameters. `parameters` are the symbols that stand for them in `scope`.
pub fn entries(
    dag: &mut Dag,
    definition: &EffectDefinition,
    scope: &Scope<'_>,
    parameters: &[Symbol],
) -> Vec<EffectEntry> {
    let torques = torques(dag, definition, scope);
    let mut entries = Vec::new();
    for (parameter, &symbol) in parameters.iter().enumerate() {
        for &(joint, torque) in &torques {
            let value = dag.derivative(torque, symbol);
            if !dag.is_zero(value) {
                entries.push(EffectEntry {
                    joint,
                    parameter,
                    value,
                });
            }
        }
    }
    entries
}

fn lower(dag: &mut Dag, expr: &EffectExpr, scope: &Scope<'_>) -> ExprId {
    lower_with(dag, expr, &mut |dag, leaf| match leaf {
        EffectLeaf::Linear(k) => scope.linear[k],
        EffectLeaf::Shape(k) => scope.shapes[k],
        EffectLeaf::Signal(signal, formal) => {
            let joint = scope.joints[formal];
            match signal {
                Signal::Position => dag.symbol(Symbol::Q(joint)),
                Signal::Velocity => dag.symbol(Symbol::Dq(joint)),
                Signal::Acceleration => dag.symbol(Symbol::Ddq(joint)),
                Signal::RigidTorque => scope.rigid_torque[joint],
            }
        }
        EffectLeaf::Time => dag.symbol(Symbol::Time),
    })
}

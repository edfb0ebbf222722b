//! Effects as the language defines them, lowered to expressions for given joints.

use std::collections::BTreeMap;

use robot_model_spec::model::{
    Act, Effect, EffectDefinition, EffectExpr, EffectLeaf, Model, Signal,
};

use super::kinematics::Lever;
use super::lower::lower_with;
use super::vector;
use crate::expr::{Dag, ExprId, Symbol};

/// What the names in an effect's definition stand for.
pub struct Scope<'a> {
    /// Linear parameters.
    pub linear: &'a [ExprId],
    /// Shape parameters, inputs and states.
    pub symbols: &'a Symbols,
    /// Joint indices, one per formal joint.
    pub joints: &'a [usize],
    /// Torque of the rigid body, one per joint of the arm: symbols where it comes from outside, expressions where not.
    pub rigid_torque: &'a [ExprId],
    /// What forces on links have to be multiplied with; empty where no effect is one.
    pub levers: &'a [Lever],
}

/// What the names stand for that have one meaning in all forms.
pub struct Symbols {
    /// Shape parameters: numbers where the spec gives them.
    pub shapes: Vec<ExprId>,
    /// Columns of the log.
    pub inputs: Vec<ExprId>,
    /// Internal states, by [`Symbol::State`].
    pub states: Vec<Symbol>,
}

impl Symbols {
    /// Those of a declared effect, by its index in the model.
    pub fn declared(dag: &mut Dag, model: &Model, effect: usize) -> Self {
        let before = &model.effects[..effect];
        let declared = &model.effects[effect];
        let first_shape: usize = before.iter().map(|effect| effect.shapes.len()).sum();
        let first_state: usize = before.iter().map(|e| e.definition.states.len()).sum();
        let columns = model.inputs();
        let shapes = (first_shape..)
            .zip(&declared.shapes)
            .map(|(k, value)| match value {
                Some(value) => dag.constant(*value),
                None => dag.symbol(Symbol::Shape(k)),
            })
            .collect();
        let inputs = declared.definition.inputs.iter().map(|input| {
            let column = input.column(&declared.joints);
            let k = columns.iter().position(|other| *other == column);
            dag.symbol(Symbol::Input(k.expect("the model lists all inputs")))
        });
        Self {
            shapes,
            inputs: inputs.collect(),
            states: (first_state..)
                .take(declared.definition.states.len())
                .map(Symbol::State)
                .collect(),
        }
    }

    /// Those of an effect that stands alone: everything by its index in the definition.
    pub fn alone(dag: &mut Dag, definition: &EffectDefinition) -> Self {
        let shapes = (0..definition.shapes.len()).map(|k| dag.symbol(Symbol::Shape(k)));
        let shapes = shapes.collect();
        let inputs = (0..definition.inputs.len()).map(|k| dag.symbol(Symbol::Input(k)));
        Self {
            shapes,
            inputs: inputs.collect(),
            states: (0..definition.states.len()).map(Symbol::State).collect(),
        }
    }
}

/// `RigidTorque(0), RigidTorque(1), ..`
pub fn outside_rigid_torque(dag: &mut Dag, dof: usize) -> Vec<ExprId> {
    (0..dof)
        .map(|joint| dag.symbol(Symbol::RigidTorque(joint)))
        .collect()
}

/// Declared effects in order, each with its scope. `parameters` has one expression per standard parameter of the model.
pub fn each_declared(
    dag: &mut Dag,
    model: &Model,
    parameters: &[ExprId],
    rigid_torque: &[ExprId],
    levers: &[Lever],
    mut visit: impl FnMut(&mut Dag, &Effect, &Scope<'_>),
) {
    let mut linear = &parameters[model.rigid_parameters()..];
    for (index, declared) in model.effects.iter().enumerate() {
        let (own, rest) = linear.split_at(declared.definition.linear.len());
        linear = rest;
        let symbols = Symbols::declared(dag, model, index);
        let scope = Scope {
            linear: own,
            symbols: &symbols,
            joints: &declared.joints,
            rigid_torque,
            levers,
        };
        visit(dag, declared, &scope);
    }
}

/// How an effect makes a torque.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Means {
    /// `torque(j) = ..`, at a joint.
    Torque,
    /// `force(j) = [..]`, on a link.
    Force,
}

impl Means {
    /// Both.
    pub const ALL: &[Self] = &[Self::Torque, Self::Force];
}

/// `(joint, torque)` for each joint that the effect acts on by some means; a joint may come twice.
pub fn torques(
    dag: &mut Dag,
    definition: &EffectDefinition,
    scope: &Scope<'_>,
    means: &[Means],
) -> Vec<(usize, ExprId)> {
    let bindings = bindings(dag, definition, scope);
    let mut torques = Vec::new();
    let at_joints = means.contains(&Means::Torque);
    for torque in definition.torques.iter().filter(|_| at_joints) {
        let value = lower(dag, &torque.value, scope, &bindings);
        torques.push((scope.joints[torque.joint], value));
    }
    let on_links = means.contains(&Means::Force);
    for act in definition.acts.iter().filter(|_| on_links) {
        let Act::Force { joint, components } = act else {
            continue;
        };
        // The motors hold against the force: `-J^T F`.
        let lever = &scope.levers[scope.joints[*joint]];
        let force: Vec<ExprId> = components
            .iter()
            .map(|value| lower(dag, value, scope, &bindings))
            .collect();
        for (joint, velocity) in lever.iter().enumerate() {
            let power = vector::dot(dag, *velocity, [force[0], force[1], force[2]]);
            torques.push((joint, dag.neg(power)));
        }
    }
    torques
}

/// What the effect changes beside torques: values of each act, in their order.
pub fn acts(dag: &mut Dag, definition: &EffectDefinition, scope: &Scope<'_>) -> Vec<Vec<ExprId>> {
    let bindings = bindings(dag, definition, scope);
    let acts = definition.acts.iter();
    acts.map(|act| {
        let values = act.values();
        values
            .map(|value| lower(dag, value, scope, &bindings))
            .collect()
    })
    .collect()
}

/// Rates of the effect's states, in their order.
pub fn rates(dag: &mut Dag, definition: &EffectDefinition, scope: &Scope<'_>) -> Vec<ExprId> {
    let bindings = bindings(dag, definition, scope);
    let states = definition.states.iter();
    states.map(|state| bindings[state.rate]).collect()
}

/// Each binding uses those before it.
fn bindings(dag: &mut Dag, definition: &EffectDefinition, scope: &Scope<'_>) -> Vec<ExprId> {
    let mut known = Vec::new();
    for binding in &definition.bindings {
        known.push(lower(dag, &binding.value, scope, &known));
    }
    known
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
    let mut sums: BTreeMap<usize, ExprId> = BTreeMap::new();
    for (joint, torque) in torques(dag, definition, scope, Means::ALL) {
        let sum = sums.entry(joint).or_insert(dag.zero());
        *sum = dag.add(*sum, torque);
    }
    let mut entries = Vec::new();
    for (parameter, &symbol) in parameters.iter().enumerate() {
        for (&joint, &torque) in &sums {
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

fn lower(dag: &mut Dag, expr: &EffectExpr, scope: &Scope<'_>, bindings: &[ExprId]) -> ExprId {
    lower_with(dag, expr, &mut |dag, leaf| match leaf {
        EffectLeaf::Linear(k) => scope.linear[k],
        EffectLeaf::Shape(k) => scope.symbols.shapes[k],
        EffectLeaf::Signal(signal, formal) => {
            let joint = scope.joints[formal];
            match signal {
                Signal::Position => dag.symbol(Symbol::Q(joint)),
                Signal::Velocity => dag.symbol(Symbol::Dq(joint)),
                Signal::Acceleration => dag.symbol(Symbol::Ddq(joint)),
                Signal::RigidTorque => scope.rigid_torque[joint],
                Signal::MeasuredTorque => dag.symbol(Symbol::MeasuredTorque(joint)),
            }
        }
        EffectLeaf::Time => dag.symbol(Symbol::Time),
        EffectLeaf::Input(k) => scope.symbols.inputs[k],
        EffectLeaf::State(k) => dag.symbol(scope.symbols.states[k]),
        EffectLeaf::Binding(k) => bindings[k],
    })
}

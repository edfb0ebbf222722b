//! An effect by itself: what an arm does not declare, tried on given joints.

use robot_model_spec::Model;
use robot_model_spec::model::EffectDefinition;

use crate::block::Block;
use crate::dynamics::{self, effect};
use crate::expr::{Dag, ExprId, Symbol};
use crate::states::{self, StateProgram};

/// The columns of an effect that is not declared, tried on given joints.
#[derive(Debug, Clone)]
#[non_exhaustive]
pub struct EffectColumns {
    /// Its columns: one per linear parameter of the definition. Shapes, inputs and states are symbols by their index in the
    /// definition.
    pub block: Block,
    /// Its states; nothing where it has none.
    pub states: Vec<StateProgram>,
}

/// Columns of `definition` on `joints` of an arm. A force acts on links that stand where their joints say.
#[must_use]
pub fn effect_columns(
    definition: &EffectDefinition,
    joints: &[usize],
    model: &Model,
) -> EffectColumns {
    let mut dag = Dag::new();
    let parameters: Vec<Symbol> = (0..definition.linear.len())
        .map(Symbol::Parameter)
        .collect();
    let linear: Vec<ExprId> = parameters
        .iter()
        .map(|&symbol| dag.symbol(symbol))
        .collect();
    let symbols = effect::Symbols::alone(&mut dag, definition);
    let rigid_torque = effect::outside_rigid_torque(&mut dag, model.joints.len());
    let levers = dynamics::levers(&mut dag, model, [definition]);
    let scope = effect::Scope {
        linear: &linear,
        symbols: &symbols,
        joints,
        rigid_torque: &rigid_torque,
        levers: &levers,
    };
    let entries = effect::entries(&mut dag, definition, &scope, &parameters);
    let block = Block::new(
        &dag,
        entries
            .into_iter()
            .map(|entry| (entry.joint, entry.parameter, entry.value))
            .collect(),
    );
    let rates = effect::rates(&mut dag, definition, &scope);
    let equations = states::equations(&mut dag, &rates, [definition.states.len()]);
    let states = equations.iter().map(|part| part.program(&dag)).collect();
    EffectColumns { block, states }
}

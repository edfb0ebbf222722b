//! Which columns of an arm are friction of a joint, and which are not.

use robot_model::columns::Columns;
use robot_model_codegen::Compiled;
use robot_model_spec::model::{EffectDefinition, EffectLeaf, Signal};
use robot_model_spec::parameter::Owner;

use crate::interpreted::InterpretedArm;

/// Columns that a constant speed does not leave constant: those of bodies, and of effects that follow positions or accelerations, as
/// springs do. The names of such effects that are left out, as the spec leaves shapes of theirs open.
pub(super) fn beside(compiled: &Compiled) -> (Vec<usize>, Vec<String>) {
    let model = &compiled.model;
    let (mut columns, mut left_out) = (Vec::new(), Vec::new());
    for (column, &kept) in compiled.base.kept.iter().enumerate() {
        let Owner::Effect { effect, parameter } = compiled.standard[kept].owner else {
            columns.push(column);
            continue;
        };
        let declared = &model.effects[effect];
        if declared.definition.is_of_body(parameter) {
            columns.push(column);
        } else if follows_positions(&declared.definition) {
            if declared.shapes.iter().all(Option::is_some) {
                columns.push(column);
            } else {
                left_out.push(model.effect_name(effect));
            }
        }
    }
    left_out.dedup();
    (columns, left_out)
}

/// Whether an effect's torque changes with a position or an acceleration, and has no memory.
fn follows_positions(definition: &EffectDefinition) -> bool {
    let follows = |leaf: &EffectLeaf| {
        matches!(
            leaf,
            EffectLeaf::Signal(Signal::Position | Signal::Acceleration, _)
        )
    };
    let mut equations = definition.torque_equations();
    definition.states.is_empty() && equations.any(|value| definition.reads(value, &follows))
}

/// Those of some names that are parameters beside friction.
pub(super) fn rigid<'a>(compiled: &Compiled, missing: &'a [String]) -> Vec<&'a str> {
    let is_friction = |name: &&String| {
        let mut standard = compiled.standard.iter();
        let found = standard.find(|parameter| parameter.name == **name);
        matches!(found.map(|parameter| &parameter.owner), Some(Owner::Effect { effect, parameter })
            if !compiled.model.effects[*effect].definition.is_of_body(*parameter)
                && !follows_positions(&compiled.model.effects[*effect].definition))
    };
    let rigid = missing.iter().filter(|name| !is_friction(name));
    rigid.map(String::as_str).collect()
}

/// The middle of each open shape: those of friction do not matter, and others are left out.
pub(super) fn middle(arm: &InterpretedArm) -> Vec<f64> {
    let shapes = arm.shapes().iter();
    shapes
        .map(|shape| shape.grid[shape.grid.len() / 2])
        .collect()
}

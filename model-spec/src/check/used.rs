//! What is declared is used: a column of zeros or a free parameter that changes nothing cannot be identified.

use syn::Ident;

use super::Errors;
use super::binding::Part;
use crate::ast::Effect;
use crate::diagnostic::Diagnostic;
use crate::model::{Act, EffectDefinition, EffectExpr, EffectLeaf, Expr};

/// Reports what no equation uses. `parts` are the bindings of the definition.
pub(super) fn check_used(
    effect: &Effect,
    parts: &[Part<'_>],
    definition: &EffectDefinition,
    errors: &mut Errors,
) {
    let uses = |wanted: &dyn Fn(&EffectLeaf) -> bool| {
        let wanted = |part: &EffectExpr| matches!(part, Expr::Leaf(leaf) if wanted(leaf));
        let bindings = definition.bindings.iter().map(|binding| &binding.value);
        let mut all = definition.equations().chain(bindings);
        all.any(|value| value.contains(&wanted))
    };
    for (k, linear) in effect.linear.iter().enumerate() {
        if !uses(&|leaf| *leaf == EffectLeaf::Linear(k)) {
            errors.push(unused(&linear.name, "linear parameter"));
        }
    }
    for (k, shape) in effect.shapes.iter().enumerate() {
        if !uses(&|leaf| *leaf == EffectLeaf::Shape(k)) {
            errors.push(unused(&shape.name, "shape parameter"));
        }
    }
    for (k, input) in effect.inputs.iter().enumerate() {
        if !uses(&|leaf| *leaf == EffectLeaf::Input(k)) {
            errors.push(unused(&input.name, "input"));
        }
    }
    for (k, part) in parts.iter().enumerate() {
        if let Part::Let(binding) = part
            && !uses(&|leaf| *leaf == EffectLeaf::Binding(k))
        {
            errors.push(unused(&binding.name, "binding"));
        }
    }
    for (k, state) in effect.states.iter().enumerate() {
        let rate = definition.states[k].rate;
        if !uses_outside(definition, rate, k) {
            errors.push(unused(&state.name, "state"));
        }
    }
    for (k, joint) in effect.joints.iter().enumerate() {
        let torques = definition.torques.iter().map(|torque| torque.joint);
        let others = definition.acts.iter().filter_map(Act::joint);
        let acts = torques.chain(others).any(|joint| joint == k);
        let reads = |leaf: &EffectLeaf| match leaf {
            EffectLeaf::Signal(_, joint) => *joint == k,
            EffectLeaf::Input(input) => definition.inputs[*input].joint == Some(k),
            _ => false,
        };
        if !acts && !uses(&reads) {
            errors.push(unused(joint, "joint"));
        }
    }
}

#[track_caller]
fn unused(name: &Ident, what: &str) -> Diagnostic {
    Diagnostic::new(
        name.span(),
        format!("{what} `{name}` is not used"),
        "in no equation",
    )
    .help("use it in an equation, or delete it")
}

/// Whether a state, or its rate, is read elsewhere than in its own rate.
fn uses_outside(definition: &EffectDefinition, rate: usize, state: usize) -> bool {
    let wanted = |part: &EffectExpr| {
        *part == Expr::Leaf(EffectLeaf::State(state))
            || *part == Expr::Leaf(EffectLeaf::Binding(rate))
    };
    let bindings = definition.bindings.iter().enumerate();
    let others = bindings
        .filter(|(k, _)| *k != rate)
        .map(|(_, binding)| &binding.value);
    let mut all = definition.equations().chain(others);
    all.any(|value| value.contains(&wanted))
}

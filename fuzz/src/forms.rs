//! What stands beside the emitted page: equations for people, and the programs that `eval` and `identify` run.

use robot_model_codegen::Compiled;
use robot_model_codegen::expr::{Style, Symbol};
use robot_model_codegen::interpreter::Program;
use robot_model_codegen::show::{What, document, form};

/// Characters of a form for each expression in it: shared parts have names, so that no form is longer than its equations.
const LONGEST_A_NODE: usize = 1000;

/// Writes every form and runs every program.
///
/// # Panics
/// Where a form is longer than its expressions account for, beside what it calls.
pub(crate) fn exercise(compiled: &Compiled) {
    let longest = LONGEST_A_NODE * compiled.dag.len();
    for what in What::ALL {
        let text = form(compiled, what, Style::Text);
        assert!(
            text.len() < longest,
            "{what:?} has {} characters",
            text.len()
        );
    }
    let text = document(compiled);
    assert!(
        text.len() < longest,
        "the document has {} characters",
        text.len()
    );

    let mut programs = vec![
        compiled.mass_matrix(),
        compiled.coriolis_matrix(),
        compiled.gravity(),
        compiled.rigid_torque(),
        compiled.inverse_dynamics(),
        compiled.energies(),
        compiled.by_position(),
        compiled.by_velocity(),
        compiled.by_acceleration(),
        compiled.known_torque(),
        compiled.known_momentum(),
        compiled.known_drift(),
        compiled.points(),
    ];
    programs.extend(compiled.forward_kinematics());
    programs.extend(compiled.jacobian());
    let blocks = [
        compiled.regressor(),
        compiled.base_regressor(),
        compiled.momentum_regressor(),
        compiled.drift_regressor(),
        compiled.base_momentum(),
        compiled.rigid_drift(),
        compiled.effect_drift(),
    ];
    programs.extend(blocks.into_iter().map(|block| block.program));
    for program in &programs {
        run(program);
    }
}

/// At a state of which no signal is zero. Values may be no numbers: a spec may divide by anything.
fn run(program: &Program) {
    let value = |symbol| match symbol {
        Symbol::Q(joint) => 0.3 + 0.1 * small(joint),
        Symbol::Dq(joint) => -0.7 + 0.2 * small(joint),
        Symbol::Ddq(joint) => 1.1 - 0.3 * small(joint),
        Symbol::Parameter(k) | Symbol::Shape(k) => 0.9 + 0.01 * small(k),
        _ => 0.4,
    };
    let _ = program.eval(&value);
}

/// An index as a number.
fn small(index: usize) -> f64 {
    u32::try_from(index).map_or(0.0, f64::from)
}

//! Programs run on motions.

use robot_model::columns::Entry;
use robot_model::motion::{Kinematics, Motion};
use robot_model_codegen::Block;
use robot_model_codegen::expr::Symbol;
use robot_model_codegen::interpreter::{Operand, Program};

use super::signals::Signals;

pub(super) fn run_block(
    block: &Block,
    signals: &Signals<'_>,
    kinematics: &Kinematics,
) -> Vec<Entry> {
    let values = run(&block.program, signals.motion, &|symbol| {
        signals.bind(kinematics, symbol)
    });
    block
        .entries
        .iter()
        .zip(values)
        .map(|(&(joint, column), values)| Entry {
            joint,
            column,
            values,
        })
        .collect()
}

pub(super) fn run<'a>(
    program: &Program,
    motion: &Motion,
    bind: &dyn Fn(Symbol) -> Operand<'a>,
) -> Vec<Vec<f64>> {
    let mut out = vec![Vec::new(); program.outputs()];
    program.eval_batch(motion.time.len(), bind, &mut out);
    out
}

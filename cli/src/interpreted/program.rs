//! Programs run on motions.

use robot_model::columns::Entry;
use robot_model::motion::{Kinematics, Motion};
use robot_model_codegen::Block;
use robot_model_codegen::expr::Symbol;
use robot_model_codegen::interpreter::{Operand, Program};

pub(super) fn run_block(
    block: &Block,
    motion: &Motion,
    kinematics: &Kinematics,
    shapes: &[f64],
) -> Vec<Entry> {
    let values = run(&block.program, motion, &|symbol| {
        bind(motion, kinematics, shapes, symbol)
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

pub(super) fn bind<'a>(
    motion: &'a Motion,
    kinematics: &'a Kinematics,
    shapes: &[f64],
    symbol: Symbol,
) -> Operand<'a> {
    match symbol {
        Symbol::Q(joint) => Operand::Column(&kinematics.q[joint]),
        Symbol::Dq(joint) => Operand::Column(&kinematics.dq[joint]),
        Symbol::Ddq(joint) => Operand::Column(&kinematics.ddq[joint]),
        Symbol::Time => Operand::Column(&motion.time),
        Symbol::Shape(k) => Operand::Constant(shapes[k]),
        // No load is known before the first estimate.
        Symbol::RigidTorque(joint) => motion
            .rigid_torque
            .get(joint)
            .map_or(Operand::Constant(0.0), |torque| Operand::Column(torque)),
        Symbol::Parameter(_) => unreachable!("columns are free of parameters"),
    }
}

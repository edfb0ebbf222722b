//! Which band of a motion an effect's column reads.

use robot_model::columns::Entry;
use robot_model::motion::{Kinematics, Motion};
use robot_model_codegen::Block;
use robot_model_spec::model::{BinaryOp, EffectDefinition, Expr, Function};

use super::program::run_block;

/// Columns of effects, each with the band that it reads.
#[derive(Debug, Clone)]
pub(super) struct EffectBlock {
    pub(super) block: Block,
    /// Whether an entry reads the wide kinematics.
    wide: Vec<bool>,
}

impl EffectBlock {
    /// `is_rough` tells for a column whether it is rough.
    pub(super) fn new(block: Block, is_rough: impl Fn(usize) -> bool) -> Self {
        let wide = block
            .entries
            .iter()
            .map(|&(_, column)| is_rough(column))
            .collect();
        Self { block, wide }
    }

    pub(super) fn run(&self, motion: &Motion, shapes: &[f64]) -> Vec<Entry> {
        let band = |kinematics: &Kinematics, wide: bool| {
            let wanted = self.wide.contains(&wide);
            if wanted {
                run_block(&self.block, motion, kinematics, shapes)
            } else {
                Vec::new()
            }
        };
        let keep = |entries: Vec<Entry>, wide: bool| {
            entries
                .into_iter()
                .zip(&self.wide)
                .filter(move |(_, of)| **of == wide)
                .map(|(entry, _)| entry)
        };
        let smooth = keep(band(&motion.smooth, false), false);
        smooth.chain(keep(band(&motion.wide, true), true)).collect()
    }
}

/// Whether the column of a linear parameter is not smooth in the signals.
pub(super) fn is_rough(definition: &EffectDefinition, parameter: usize) -> bool {
    definition
        .torques
        .iter()
        .any(|torque| has_rough_term(&torque.value, parameter))
}

/// Looks at the terms of a sum in which the parameter occurs.
fn has_rough_term(sum: &Expr, parameter: usize) -> bool {
    match sum {
        Expr::Binary(BinaryOp::Add | BinaryOp::Sub, left, right) => {
            has_rough_term(left, parameter) || has_rough_term(right, parameter)
        }
        Expr::Neg(term) => has_rough_term(term, parameter),
        term => {
            let of_parameter = |part: &Expr| matches!(part, Expr::Linear(k) if *k == parameter);
            let rough = |part: &Expr| {
                matches!(
                    part,
                    Expr::Call(Function::Sign | Function::Tanh | Function::Abs, _)
                )
            };
            occurs(term, &of_parameter) && occurs(term, &rough)
        }
    }
}

/// Whether some part of an expression is wanted.
fn occurs(expression: &Expr, wanted: &dyn Fn(&Expr) -> bool) -> bool {
    wanted(expression)
        || match expression {
            Expr::Neg(x) | Expr::Call(_, x) => occurs(x, wanted),
            Expr::Binary(_, x, y) => occurs(x, wanted) || occurs(y, wanted),
            _ => false,
        }
}

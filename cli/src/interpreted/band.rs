//! Which band of a motion an effect's column reads.

use robot_model::columns::Entry;
use robot_model::motion::Motion;
use robot_model_codegen::Block;
use robot_model_spec::model::{BinaryOp, EffectDefinition, EffectExpr, EffectLeaf, Expr, Function};

use super::program::run_block;

/// Instants of a sample interval over which columns that jump are averaged.
const INSTANTS: i32 = 4;

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

    /// The columns over a motion; those that jump are averaged over the sample interval (see
    /// [`Motion::within_sample`]).
    pub(super) fn run(&self, motion: &Motion, shapes: &[f64]) -> Vec<Entry> {
        let keep = |entries: Vec<Entry>, wide: bool| {
            entries
                .into_iter()
                .zip(&self.wide)
                .filter(move |(_, of)| **of == wide)
                .map(|(entry, _)| entry)
        };
        let mut columns = Vec::new();
        if self.wide.contains(&false) {
            columns.extend(keep(
                run_block(&self.block, motion, &motion.smooth, shapes),
                false,
            ));
        }
        if self.wide.contains(&true) {
            columns.extend(keep(self.averaged(motion, shapes), true));
        }
        columns
    }

    /// Mean of the columns at a few instants of every sample interval.
    fn averaged(&self, motion: &Motion, shapes: &[f64]) -> Vec<Entry> {
        let mut sum: Vec<Entry> = Vec::new();
        for instant in 0..INSTANTS {
            let part = (f64::from(instant) + 0.5) / f64::from(INSTANTS) - 0.5;
            let motion = motion.within_sample(part);
            let entries = run_block(&self.block, &motion, &motion.wide, shapes);
            if sum.is_empty() {
                sum = entries;
            } else {
                for (sum, entry) in sum.iter_mut().zip(entries) {
                    sum.values
                        .iter_mut()
                        .zip(entry.values)
                        .for_each(|(s, v)| *s += v);
                }
            }
        }
        for entry in &mut sum {
            entry
                .values
                .iter_mut()
                .for_each(|v| *v /= f64::from(INSTANTS));
        }
        sum
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
fn has_rough_term(sum: &EffectExpr, parameter: usize) -> bool {
    match sum {
        Expr::Binary(BinaryOp::Add | BinaryOp::Sub, left, right) => {
            has_rough_term(left, parameter) || has_rough_term(right, parameter)
        }
        Expr::Neg(term) => has_rough_term(term, parameter),
        term => {
            let of_parameter =
                |part: &EffectExpr| *part == Expr::Leaf(EffectLeaf::Linear(parameter));
            let rough = |part: &EffectExpr| {
                matches!(
                    part,
                    Expr::Call(Function::Sign | Function::Tanh | Function::Abs, _)
                )
            };
            term.contains(&of_parameter) && term.contains(&rough)
        }
    }
}

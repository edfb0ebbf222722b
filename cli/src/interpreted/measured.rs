//! Where links stand against a log's positions, and when its torques were.

use std::borrow::Cow;

use robot_model::columns::Entry;
use robot_model::motion::{Kinematics, Motion};
use robot_model_codegen::interpreter::Program;
use robot_model_codegen::{Block, Compiled};

use super::band::EffectBlock;
use super::effect_block;

/// What lies between the equations of an arm and a log of it; as a rule nothing.
#[derive(Debug, Clone)]
pub(super) struct Measured {
    displacements: Option<EffectBlock>,
    delay: Option<Program>,
}

impl Measured {
    pub(super) fn new(compiled: &Compiled) -> Self {
        // A load that changes sign moves links at once: the wide band, where the change stays where it was.
        let block = |block: Block| effect_block(compiled, block, |_| true);
        Self {
            displacements: compiled.displacements().map(block),
            delay: compiled.delay(),
        }
    }

    pub(super) fn uses_rigid_torque(&self) -> bool {
        let mut blocks = self.displacements.iter();
        blocks.any(EffectBlock::uses_rigid_torque)
    }

    /// The motion of the links, in the smooth band; `shapes` are the values of all shape parameters.
    pub(super) fn links<'a>(&self, motion: &'a Motion, shapes: &[f64]) -> Cow<'a, Kinematics> {
        let Some(displacements) = &self.displacements else {
            return Cow::Borrowed(&motion.smooth);
        };
        // What a displacement calls the load is what the transmission carried, not what a model of it says: of that the
        // displacement is a part, and above the resonance of spring and link no series of it converges.
        let loaded = Motion {
            rigid_torque: motion.transmitted_torque.clone(),
            ..motion.clone()
        };
        let entries = displacements.run(&loaded, shapes).into_iter();
        let displacements: Vec<(usize, Vec<f64>)> =
            entries.map(|entry| (entry.joint, entry.values)).collect();
        Cow::Owned(motion.displaced(&displacements))
    }

    /// Columns as the log has them.
    pub(super) fn entries(
        &self,
        motion: &Motion,
        shapes: &[f64],
        mut entries: Vec<Entry>,
    ) -> Vec<Entry> {
        if let Some(seconds) = self.seconds(shapes) {
            for entry in &mut entries {
                entry.values = motion.late(&entry.values, seconds);
            }
        }
        entries
    }

    /// Torques or momenta as the log has them.
    pub(super) fn series(
        &self,
        motion: &Motion,
        shapes: &[f64],
        mut series: Vec<Vec<f64>>,
    ) -> Vec<Vec<f64>> {
        if let Some(seconds) = self.seconds(shapes) {
            for values in &mut series {
                *values = motion.late(values, seconds);
            }
        }
        series
    }

    /// By how much torques are late.
    pub(super) fn seconds(&self, shapes: &[f64]) -> Option<f64> {
        let program = self.delay.as_ref()?;
        Some(
            program.eval(&|symbol| match symbol {
                robot_model_codegen::expr::Symbol::Shape(k) => shapes[k],
                _ => unreachable!("checked in model-spec: a delay is constant"),
            })[0],
        )
    }
}

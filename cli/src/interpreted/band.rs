//! Which band of a motion an effect's column reads.

use std::collections::BTreeMap;

use robot_model::columns::Entry;
use robot_model::motion::{Motion, between};
use robot_model_codegen::Block;
use robot_model_codegen::expr::Symbol;
use robot_model_codegen::interpreter::Operand;
use robot_model_codegen::states::StateProgram;

use super::program::{run, run_block};
use super::signals::{Own, Signals};
use super::states::states;

/// Instants of a sample interval over which columns that jump are averaged.
const INSTANTS: i32 = 4;

/// Columns of effects, each with the band that it reads.
#[derive(Debug, Clone)]
pub(super) struct EffectBlock {
    block: Block,
    states: Vec<StateProgram>,
    /// Channels of the log, by their symbols.
    inputs: Vec<String>,
    /// Joint torque per unit of the logged channel; empty where no column reads the measured torque.
    gain: Vec<f64>,
    /// Whether an entry reads the wide kinematics.
    wide: Vec<bool>,
}

impl EffectBlock {
    /// `is_rough` tells for a column whether it is rough.
    pub(super) fn new(
        block: Block,
        states: Vec<StateProgram>,
        inputs: Vec<String>,
        gain: Vec<f64>,
        is_rough: impl Fn(usize) -> bool,
    ) -> Self {
        let wide = block
            .entries
            .iter()
            .map(|&(_, column)| is_rough(column))
            .collect();
        let mut effects = Self {
            block,
            states,
            inputs,
            gain: Vec::new(),
            wide,
        };
        if effects.reads(|symbol| matches!(symbol, Symbol::MeasuredTorque(_))) {
            effects.gain = gain;
        }
        effects
    }

    /// Channels of the log that the columns read.
    pub(super) fn inputs(&self) -> &[String] {
        &self.inputs
    }

    /// Whether a column reads the torque of the rigid body.
    pub(super) fn uses_rigid_torque(&self) -> bool {
        self.reads(|symbol| matches!(symbol, Symbol::RigidTorque(_)))
    }

    fn reads(&self, wanted: impl Fn(&Symbol) -> bool) -> bool {
        let mut symbols = self
            .block
            .program
            .symbols()
            .iter()
            .chain(self.states.iter().flat_map(|part| part.program.symbols()));
        symbols.any(wanted)
    }

    /// The columns over a motion; those that jump are averaged over the sample interval: a column
    /// that jumps between two samples has power above half the sample rate, which would fold into the band below. States follow the wide band, where reversals stay where they were.
    pub(super) fn run(&self, motion: &Motion, shapes: &[f64]) -> Vec<Entry> {
        let keep = |entries: Vec<Entry>, wide: bool| {
            entries
                .into_iter()
                .zip(&self.wide)
                .filter(move |(_, of)| **of == wide)
                .map(|(entry, _)| entry)
        };
        let own = self.own(motion, shapes);
        let signals = Signals {
            motion,
            shapes,
            own: &own,
        };
        let mut columns = Vec::new();
        if self.wide.contains(&false) {
            columns.extend(keep(
                run_block(&self.block, &signals, &motion.smooth),
                false,
            ));
        }
        if self.wide.contains(&true) {
            columns.extend(keep(self.averaged(&signals), true));
        }
        columns
    }

    /// Signals that are made of those of the motion.
    fn own(&self, motion: &Motion, shapes: &[f64]) -> Own {
        let scaled = |(gain, tau): (&f64, &Vec<f64>)| tau.iter().map(|tau| gain * tau).collect();
        let mut own = Own {
            measured_torque: self.gain.iter().zip(&motion.tau).map(scaled).collect(),
            inputs: self.inputs.clone(),
            states: Vec::new(),
        };
        if let (Some(first), Some(second)) = (motion.time.first(), motion.time.get(1)) {
            let signals = Signals {
                motion,
                shapes,
                own: &own,
            };
            let bind = |symbol| signals.bind(&motion.wide, symbol);
            own.states = states(&self.states, motion.time.len(), second - first, &bind);
        }
        own
    }

    /// Mean of the columns at a few instants of every sample interval. Only what the columns read is moved to the instants:
    /// a candidate reads one joint of an arm.
    fn averaged(&self, signals: &Signals<'_>) -> Vec<Entry> {
        let (program, motion) = (&self.block.program, signals.motion);
        let mut sum = vec![vec![0.0; motion.time.len()]; program.outputs()];
        for instant in 0..INSTANTS {
            let part = (f64::from(instant) + 0.5) / f64::from(INSTANTS) - 0.5;
            let moved = program.symbols().iter().map(|&symbol| {
                let value = match signals.bind(&motion.wide, symbol) {
                    Operand::Column(values) => Moved::Column(between(values, part)),
                    Operand::Constant(value) => Moved::Constant(value),
                };
                (symbol, value)
            });
            let moved: BTreeMap<Symbol, Moved> = moved.collect();
            let values = run(program, motion, &|symbol| match &moved[&symbol] {
                Moved::Column(values) => Operand::Column(values),
                Moved::Constant(value) => Operand::Constant(*value),
            });
            for (sum, values) in sum.iter_mut().zip(values) {
                sum.iter_mut().zip(values).for_each(|(s, v)| *s += v);
            }
        }
        let mean = |mut values: Vec<f64>| {
            for value in &mut values {
                *value /= f64::from(INSTANTS);
            }
            values
        };
        let entries = self.block.entries.iter().zip(sum);
        entries
            .map(|(&(joint, column), values)| Entry {
                joint,
                column,
                values: mean(values),
            })
            .collect()
    }
}

/// A signal a part of a sample later.
enum Moved {
    Column(Vec<f64>),
    Constant(f64),
}

//! Which band of a motion an effect's column reads.

use std::collections::BTreeMap;

use robot_model::columns::Entry;
use robot_model::motion::{Motion, between};
use robot_model_codegen::Block;
use robot_model_codegen::expr::Symbol;
use robot_model_codegen::interpreter::Operand;
use robot_model_codegen::states::StateProgram;

use super::program::run_block;
use super::signals::{Own, Signals};
use super::states::states;

/// Instants of a sample interval over which columns that jump are averaged.
const INSTANTS: u32 = 4;

/// Velocities over which they are averaged where a joint's direction is not known, and up to how many times that speed it is not.
const VELOCITIES: u32 = 16;
const FAR: f64 = 4.0;

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
        if effects.reads_measured_torque() {
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

    /// Whether a column reads the torque as logged.
    pub(super) fn reads_measured_torque(&self) -> bool {
        self.reads(|symbol| matches!(symbol, Symbol::MeasuredTorque(_)))
    }

    /// Whether a column reads the time.
    pub(super) fn reads_time(&self) -> bool {
        self.reads(|symbol| matches!(symbol, Symbol::Time))
    }

    /// Whether columns read positions and shapes, and nothing else.
    pub(super) fn reads_positions_alone(&self) -> bool {
        let is_other = |symbol: &Symbol| !matches!(symbol, Symbol::Q(_) | Symbol::Shape(_));
        self.states.is_empty() && self.inputs.is_empty() && !self.reads(is_other)
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

    /// Mean of the columns at a few instants of every sample interval, and about turns over velocities that the log does not tell
    /// apart.
    fn averaged(&self, signals: &Signals<'_>) -> Vec<Entry> {
        let samples = signals.motion.time.len();
        let everywhere = (0..INSTANTS).map(|k| Moved {
            part: part(k, INSTANTS),
            quantile: 0.5,
        });
        let all: Vec<usize> = (0..samples).collect();
        let mut mean = self.mean(signals, &all, everywhere);
        let turning = self.turning(signals.motion);
        if !turning.is_empty() {
            let about = (0..VELOCITIES).map(|k| Moved {
                part: part(k % INSTANTS, INSTANTS),
                // 7 and 16 have no common factor: every quantile comes once, early and late in the interval alike.
                quantile: 0.5 + part((7 * k) % VELOCITIES, VELOCITIES),
            });
            let exact = self.mean(signals, &turning, about);
            for (mean, exact) in mean.iter_mut().zip(exact) {
                for (&sample, value) in turning.iter().zip(exact) {
                    mean[sample] = value;
                }
            }
        }
        let entries = self.block.entries.iter().zip(mean);
        entries
            .map(|(&(joint, column), values)| Entry {
                joint,
                column,
                values,
            })
            .collect()
    }

    /// Samples at which the direction of a joint whose velocity is read is not known.
    fn turning(&self, motion: &Motion) -> Vec<usize> {
        let read = self.block.program.symbols().iter();
        let joints: Vec<usize> = read
            .filter_map(|symbol| match symbol {
                Symbol::Dq(joint) => Some(*joint),
                _ => None,
            })
            .filter(|joint| motion.turn_speed(*joint) > 0.0)
            .collect();
        let turns = |sample: &usize| {
            joints
                .iter()
                .any(|&joint| motion.wide.dq[joint][*sample].abs() < FAR * motion.turn_speed(joint))
        };
        (0..motion.time.len()).filter(turns).collect()
    }

    /// Mean of the columns over signals that are moved, at some samples. Only what the columns read is moved: a candidate reads
    /// one joint of an arm.
    fn mean(
        &self,
        signals: &Signals<'_>,
        samples: &[usize],
        moves: impl ExactSizeIterator<Item = Moved>,
    ) -> Vec<Vec<f64>> {
        let (program, motion) = (&self.block.program, signals.motion);
        let mut sum = vec![vec![0.0; samples.len()]; program.outputs()];
        let count = moves.len() as f64;
        for to in moves {
            let moved = program.symbols().iter().map(|&symbol| {
                let value = match signals.bind(&motion.wide, symbol) {
                    Operand::Column(values) => {
                        Value::Column(to.apply(motion, symbol, values, samples))
                    }
                    Operand::Constant(value) => Value::Constant(value),
                };
                (symbol, value)
            });
            let moved: BTreeMap<Symbol, Value> = moved.collect();
            let bind = |symbol| match &moved[&symbol] {
                Value::Column(values) => Operand::Column(values),
                Value::Constant(value) => Operand::Constant(*value),
            };
            let mut values = vec![Vec::new(); program.outputs()];
            program.eval_batch(samples.len(), &bind, &mut values);
            for (sum, values) in sum.iter_mut().zip(values) {
                sum.iter_mut().zip(values).for_each(|(s, v)| *s += v);
            }
        }
        for value in sum.iter_mut().flatten() {
            *value /= count;
        }
        sum
    }
}

/// The middle of part `k` of `count` equal ones, `-0.5 .. 0.5`.
fn part(k: u32, count: u32) -> f64 {
    (f64::from(k) + 0.5) / f64::from(count) - 0.5
}

/// Where signals are read instead of at the measured samples.
struct Moved {
    /// A part of a sample interval later.
    part: f64,
    /// At this quantile of the velocities that the log does not tell apart.
    quantile: f64,
}

impl Moved {
    fn apply(&self, motion: &Motion, symbol: Symbol, values: &[f64], at: &[usize]) -> Vec<f64> {
        let mut values = between(values, self.part, at);
        if let Symbol::Dq(joint) = symbol {
            let scale = 0.5 * motion.turn_speed(joint);
            let faster = scale * (self.quantile / (1.0 - self.quantile)).ln();
            for value in &mut values {
                *value += faster;
            }
        }
        values
    }
}

/// A signal's values.
enum Value {
    Column(Vec<f64>),
    Constant(f64),
}

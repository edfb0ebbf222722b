//! The interpreter behind the runtime's traits: any spec, no Rust toolchain.
//!
//! Columns that jump or have a kink where a velocity changes sign read the wide kinematics of a motion (see [`Motion`]), so
//! that the reversal stays where it was. All others read the smooth ones: an acceleration from the wide band is mostly
//! noise.

mod band;
mod body;
mod candidate;
mod change;
mod constants;
mod function;
mod links;
mod measured;
mod momentum;
mod moved;
mod nominal;
mod orbit;
mod plant;
mod possible;
mod program;
mod rough;
mod runner;
mod saturated;
mod shape;
mod signals;
mod springs;
mod states;
mod undeclared;

pub use body::InterpretedBody;
pub use candidate::{InterpretedCandidate, is_tried};
pub use change::InterpretedChange;
pub(crate) use change::is_delaying;
pub use constants::Constants;
pub use function::InterpretedFunction;
pub use momentum::{InterpretedMomentum, NoMomentumForm};
pub(crate) use moved::{Moved, Widths};
pub use plant::InterpretedPlant;
pub(crate) use possible::{payloads, possible_arms};
pub(crate) use states::states;
pub use undeclared::Undeclared;

use robot_model::columns::{Arm, Columns, Entry, Nominal, Shape, Unknown};
use robot_model::identify::PossibleArms;
use robot_model::motion::Motion;
use robot_model_codegen::expr::Symbol;
use robot_model_codegen::interpreter::{Operand, Program};
use robot_model_codegen::{Block, Compiled, Terms};
use robot_model_spec::parameter::Owner;

use band::EffectBlock;
use measured::Measured;
use nominal::nominal;
use program::{run, run_block};
use rough::{dry_joints, dry_shapes, is_rough};
use saturated::saturated_joints;
use shape::grids;
use signals::{Own, Signals};

/// A compiled spec as an [`Arm`]: unknowns are its base parameters, those of declared effects among them.
#[derive(Debug, Clone)]
pub struct InterpretedArm {
    compiled: Compiled,
    unknowns: Vec<Unknown>,
    shapes: Vec<Shape>,
    /// Values of all shape parameters; those that are free stand for themselves in `free`.
    given: Vec<f64>,
    free: Vec<usize>,
    joints: Vec<String>,
    actuator_gain: Vec<f64>,
    rigid: Block,
    effects: EffectBlock,
    load: Program,
    /// Torque of motors whose inertia is told as one sum with that of their links.
    motors: Option<Program>,
    terms: Option<Terms>,
    known_torque: Program,
    measured: Measured,
    dry: Vec<usize>,
    /// Open shapes of their friction.
    dry_shapes: Vec<usize>,
    saturated: Vec<usize>,
}

impl InterpretedArm {
    /// Puts a compiled spec behind the traits.
    #[must_use]
    pub fn new(compiled: Compiled) -> Self {
        let model = &compiled.model;
        let names = compiled.shape_names();
        let grids: Vec<Vec<f64>> = model
            .effects
            .iter()
            .flat_map(|effect| grids(&effect.definition))
            .collect();
        let free = compiled.free_shapes();
        let given = model
            .effects
            .iter()
            .flat_map(|effect| &effect.shapes)
            .map(|value| value.unwrap_or(f64::NAN));
        let open = free.iter().map(|&k| names[k].as_str());
        let dry_shapes = dry_shapes(model, open);
        Self {
            unknowns: unknowns(&compiled),
            shapes: free
                .iter()
                .map(|&k| Shape {
                    name: names[k].clone(),
                    grid: grids[k].clone(),
                })
                .collect(),
            given: given.collect(),
            free,
            joints: model
                .joints
                .iter()
                .map(|joint| joint.name.clone())
                .collect(),
            actuator_gain: model
                .joints
                .iter()
                .map(|joint| joint.actuator_gain)
                .collect(),
            rigid: compiled.rigid_columns(),
            effects: torque_block(&compiled, compiled.effect_columns()),
            load: compiled.load(),
            motors: compiled.motor_torque(),
            terms: written_terms(&compiled),
            known_torque: compiled.known_torque(),
            measured: Measured::new(&compiled),
            dry: dry_joints(&compiled.model),
            dry_shapes,
            saturated: saturated_joints(&compiled.model),
            compiled,
        }
    }

    /// What was compiled.
    #[must_use]
    pub fn compiled(&self) -> &Compiled {
        &self.compiled
    }

    /// Values of all shape parameters: the spec's, and those given for the free ones.
    fn all_shapes(&self, free: &[f64]) -> Vec<f64> {
        let mut values = self.given.clone();
        for (&k, &value) in self.free.iter().zip(free) {
            values[k] = value;
        }
        values
    }
}

impl Columns for InterpretedArm {
    fn unknowns(&self) -> &[Unknown] {
        &self.unknowns
    }

    fn shapes(&self) -> &[Shape] {
        &self.shapes
    }

    fn uses_rigid_torque(&self) -> bool {
        self.effects.uses_rigid_torque() || self.measured.uses_rigid_torque()
    }

    fn inputs(&self) -> &[String] {
        self.effects.inputs()
    }

    fn entries(&self, motion: &Motion, shapes: &[f64]) -> Vec<Entry> {
        let shapes = self.all_shapes(shapes);
        let signals = Signals {
            motion,
            shapes: &shapes,
            own: &Own::default(),
        };
        let links = self.measured.links(motion, &shapes);
        let mut entries = run_block(&self.rigid, &signals, &links);
        entries.extend(self.effects.run(motion, &shapes));
        self.measured.entries(motion, &shapes, entries)
    }
}

impl InterpretedArm {
    /// Outputs of a program that reads base parameters, along a motion of joints.
    fn at_estimate(
        &self,
        program: &Program,
        motion: &Motion,
        shapes: &[f64],
        estimate: &[f64],
    ) -> Vec<Vec<f64>> {
        let parameters = self.compiled.parameter_values(estimate);
        let signals = Signals {
            motion,
            shapes: &self.all_shapes(shapes),
            own: &Own::default(),
        };
        run(program, motion, &|symbol| match symbol {
            Symbol::Parameter(k) => Operand::Constant(parameters[k]),
            other => signals.bind(&motion.smooth, other),
        })
    }
}

impl Arm for InterpretedArm {
    fn dof(&self) -> usize {
        self.joints.len()
    }

    fn joints(&self) -> &[String] {
        &self.joints
    }

    fn actuator_gain(&self) -> &[f64] {
        &self.actuator_gain
    }

    fn known_torque(&self, motion: &Motion, shapes: &[f64]) -> Vec<Vec<f64>> {
        let shapes = self.all_shapes(shapes);
        let signals = Signals {
            motion,
            shapes: &shapes,
            own: &Own::default(),
        };
        let links = self.measured.links(motion, &shapes);
        let torque = run(&self.known_torque, motion, &|symbol| {
            signals.bind(&links, symbol)
        });
        self.measured.series(motion, &shapes, torque)
    }

    fn dry_joints(&self) -> &[usize] {
        &self.dry
    }

    fn dry_shapes(&self) -> &[usize] {
        &self.dry_shapes
    }

    fn follows_load(&self) -> bool {
        self.measured.uses_rigid_torque()
    }

    fn saturated_joints(&self) -> &[usize] {
        &self.saturated
    }

    fn rigid_torque(&self, motion: &Motion, shapes: &[f64], estimate: &[f64]) -> Vec<Vec<f64>> {
        self.at_estimate(&self.load, motion, shapes, estimate)
    }

    fn terms(&self) -> Vec<String> {
        let terms = self.terms.iter();
        terms.flat_map(|terms| terms.names.clone()).collect()
    }

    fn term_values(&self, motion: &Motion) -> Vec<Vec<f64>> {
        let signals = Signals {
            motion,
            shapes: &[],
            own: &Own::default(),
        };
        let Some(terms) = &self.terms else {
            return Vec::new();
        };
        run(&terms.program, motion, &|symbol| {
            signals.bind(&motion.smooth, symbol)
        })
    }

    fn nominal(&self) -> Vec<Option<Nominal>> {
        nominal(&self.compiled)
    }

    fn possible_arms(&self) -> Option<PossibleArms> {
        possible_arms(&self.compiled)
    }

    fn transmitted_torque(
        &self,
        motion: &Motion,
        shapes: &[f64],
        estimate: &[f64],
    ) -> Vec<Vec<f64>> {
        if !self.measured.uses_rigid_torque() {
            return Vec::new();
        }
        let mut torque: Vec<Vec<f64>> = motion
            .tau
            .iter()
            .zip(&self.actuator_gain)
            .map(|(tau, gain)| tau.iter().map(|tau| gain * tau).collect())
            .collect();
        for entry in self.effects.run(motion, &self.all_shapes(shapes)) {
            let value = estimate[entry.column];
            for (torque, column) in torque[entry.joint].iter_mut().zip(entry.values) {
                *torque -= value * column;
            }
        }
        let motors = self.motors.as_ref();
        let motors = motors.map(|motors| self.at_estimate(motors, motion, shapes, estimate));
        for (torque, motor) in torque.iter_mut().zip(motors.unwrap_or_default()) {
            for (torque, motor) in torque.iter_mut().zip(motor) {
                *torque -= motor;
            }
        }
        torque
    }
}

/// Terms of equations that somebody has written: those of a chain follow from its frames, and none of them is wrong by itself.
fn written_terms(compiled: &Compiled) -> Option<Terms> {
    let is_written = compiled.model.energies().is_some();
    is_written.then(|| compiled.terms())
}

/// Base parameters as unknowns; only an effect's parameter that stands alone has a sign.
fn unknowns(compiled: &Compiled) -> Vec<Unknown> {
    let nonnegative = |base: usize| match compiled.standard[compiled.base.kept[base]].owner {
        Owner::Effect { effect, parameter } => {
            compiled.base.combinations[base].len() == 1
                && compiled.model.effects[effect].definition.linear[parameter].nonnegative
        }
        Owner::Link { .. } | Owner::Monomial(_) => false,
    };
    let names = compiled.base.names.iter().enumerate();
    names
        .map(|(base, name)| Unknown {
            name: name.clone(),
            nonnegative: nonnegative(base),
        })
        .collect()
}

/// Columns of the declared effects' torques, each with the band that it reads.
fn torque_block(compiled: &Compiled, block: Block) -> EffectBlock {
    effect_block(compiled, block, |column| {
        match compiled.standard[compiled.base.kept[column]].owner {
            Owner::Effect { effect, parameter } => {
                is_rough(&compiled.model.effects[effect].definition, parameter)
            }
            Owner::Link { .. } | Owner::Monomial(_) => false,
        }
    })
}

/// What declared effects compute along a motion; `is_rough` tells which columns read the wide band.
fn effect_block(
    compiled: &Compiled,
    block: Block,
    is_rough: impl Fn(usize) -> bool,
) -> EffectBlock {
    let gain = compiled
        .model
        .joints
        .iter()
        .map(|joint| joint.actuator_gain);
    let (states, inputs) = (compiled.states(), compiled.model.inputs());
    EffectBlock::new(block, states, inputs, gain.collect(), is_rough)
}

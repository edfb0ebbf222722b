//! The interpreter behind the runtime's traits: any spec, no Rust toolchain.
//!
//! Columns of the rigid body read the smooth kinematics of a motion, columns of effects the wide ones (see
//! [`Motion`]).

use std::collections::BTreeSet;

use robot_model::columns::{Arm, Candidate, Columns, Entry, Shape, Unknown};
use robot_model::motion::{Kinematics, Motion};
use robot_model_codegen::expr::Symbol;
use robot_model_codegen::interpreter::{Operand, Program};
use robot_model_codegen::{Block, Compiled, effect_columns};
use robot_model_spec::model::{EffectDefinition, Model, ShapeParameter};
use robot_model_spec::parameter::Owner;

/// First values to try of a shape parameter whose definition gives no step.
const GRID_POINTS: usize = 12;

/// No definition with more steps than this passes the check.
const MOST_GRID_POINTS: u32 = 10_000;

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
    effects: Block,
    rigid_torque: Program,
    known_torque: Program,
}

impl InterpretedArm {
    /// Puts a compiled spec behind the traits.
    #[must_use]
    pub fn new(compiled: Compiled) -> Self {
        let model = &compiled.model;
        let names = compiled.shape_names();
        let parameters: Vec<&ShapeParameter> = model
            .effects
            .iter()
            .flat_map(|effect| &effect.definition.shapes)
            .collect();
        let free = compiled.free_shapes();
        let given = model
            .effects
            .iter()
            .flat_map(|effect| &effect.shapes)
            .map(|value| value.unwrap_or(f64::NAN));
        Self {
            unknowns: unknowns(&compiled),
            shapes: free
                .iter()
                .map(|&k| Shape {
                    name: names[k].clone(),
                    grid: grid(parameters[k]),
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
            effects: compiled.effect_columns(),
            rigid_torque: compiled.rigid_torque(),
            known_torque: compiled.known_torque(),
            compiled,
        }
    }

    /// What was compiled.
    #[must_use]
    pub fn compiled(&self) -> &Compiled {
        &self.compiled
    }

    /// Every effect that the spec may declare and does not, on every joint or group of joints. A declared effect comes again
    /// where it has shape parameters: a second ripple has another period.
    #[must_use]
    pub fn candidates(&self) -> Vec<InterpretedCandidate> {
        let model = &self.compiled.model;
        let mut candidates = Vec::new();
        for definition in &model.definitions {
            let mut seen: Vec<(BTreeSet<usize>, Vec<Entry>)> = Vec::new();
            for joints in tuples(model.joints.len(), definition.joints.len()) {
                let group: BTreeSet<usize> = joints.iter().copied().collect();
                let candidate = InterpretedCandidate::new(model, definition, &joints);
                let probe = candidate.probe(model.joints.len());
                // A symmetric effect is the same on `(j, k)` and on `(k, j)`.
                if seen
                    .iter()
                    .any(|(other, entries)| *other == group && same(entries, &probe))
                {
                    continue;
                }
                let declared = model.effects.iter().any(|effect| {
                    effect.definition.name == definition.name
                        && same(
                            &InterpretedCandidate::new(model, definition, &effect.joints)
                                .probe(model.joints.len()),
                            &probe,
                        )
                });
                seen.push((group, probe));
                if !declared || !definition.shapes.is_empty() {
                    candidates.push(candidate);
                }
            }
        }
        candidates
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
        reads_rigid_torque(&self.effects.program)
    }

    fn entries(&self, motion: &Motion, shapes: &[f64]) -> Vec<Entry> {
        let mut values = self.given.clone();
        for (&k, &value) in self.free.iter().zip(shapes) {
            values[k] = value;
        }
        let mut entries = run_block(&self.rigid, motion, &motion.smooth, &values);
        entries.extend(run_block(&self.effects, motion, &motion.wide, &values));
        entries
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

    fn known_torque(&self, motion: &Motion) -> Vec<Vec<f64>> {
        run(&self.known_torque, motion, &|symbol| {
            bind(motion, &motion.smooth, &[], symbol)
        })
    }

    fn rigid_torque(&self, motion: &Motion, estimate: &[f64]) -> Vec<Vec<f64>> {
        let parameters = self.compiled.parameter_values(estimate);
        run(&self.rigid_torque, motion, &|symbol| match symbol {
            Symbol::Parameter(k) => Operand::Constant(parameters[k]),
            other => bind(motion, &motion.smooth, &[], other),
        })
    }
}

/// An effect of the spec's library on joints where the spec does not declare it.
#[derive(Debug, Clone)]
pub struct InterpretedCandidate {
    kind: String,
    joints: Vec<usize>,
    unknowns: Vec<Unknown>,
    shapes: Vec<Shape>,
    block: Block,
    uses_rigid_torque: bool,
}

impl InterpretedCandidate {
    /// `definition` on `joints` (from 0) of the arm of `model`.
    #[must_use]
    pub fn new(model: &Model, definition: &EffectDefinition, joints: &[usize]) -> Self {
        let prefix = next_name(model, definition, joints);
        let unknowns = definition.linear.iter().map(|linear| Unknown {
            name: format!("{prefix}.{}", linear.name),
            nonnegative: linear.nonnegative,
        });
        let shapes = definition.shapes.iter().map(|shape| Shape {
            name: format!("{prefix}.{}", shape.name),
            grid: grid(shape),
        });
        let columns = effect_columns(definition, joints, model.joints.len());
        Self {
            kind: definition.name.replace('_', "-"),
            joints: joints.to_vec(),
            unknowns: unknowns.collect(),
            shapes: shapes.collect(),
            block: columns.block,
            uses_rigid_torque: columns.uses_rigid_torque,
        }
    }

    /// Its columns over a few states that have nothing to do with each other, in a canonical order.
    fn probe(&self, dof: usize) -> Vec<Entry> {
        const STATES: usize = 5;
        // Multiples of the golden ratio: no two joints, signals or states alike.
        let value = |signal: usize, joint: usize, state: usize| {
            let place = (signal * dof + joint) * STATES + state + 1;
            2.0 * (0.618_033_988_749_895 * place as f64).fract() - 1.0
        };
        let signal = |signal: usize| -> Vec<Vec<f64>> {
            (0..dof)
                .map(|joint| {
                    (0..STATES)
                        .map(|state| value(signal, joint, state))
                        .collect()
                })
                .collect()
        };
        let wide = Kinematics {
            q: signal(0),
            dq: signal(1),
            ddq: signal(2),
        };
        let motion = Motion {
            time: vec![1.0; STATES],
            smooth: Kinematics::default(),
            wide,
            rigid_torque: signal(3),
        };
        let shapes: Vec<f64> = self
            .shapes
            .iter()
            .map(|shape| shape.grid[shape.grid.len() / 2])
            .collect();
        let mut entries = self.entries(&motion, &shapes);
        entries.sort_by_key(|entry| (entry.column, entry.joint));
        entries
    }
}

impl Columns for InterpretedCandidate {
    fn unknowns(&self) -> &[Unknown] {
        &self.unknowns
    }

    fn shapes(&self) -> &[Shape] {
        &self.shapes
    }

    fn uses_rigid_torque(&self) -> bool {
        self.uses_rigid_torque
    }

    fn entries(&self, motion: &Motion, shapes: &[f64]) -> Vec<Entry> {
        run_block(&self.block, motion, &motion.wide, shapes)
    }
}

impl Candidate for InterpretedCandidate {
    fn kind(&self) -> &str {
        &self.kind
    }

    fn joints(&self) -> &[usize] {
        &self.joints
    }
}

/// Base parameters as unknowns; only an effect's parameter that stands alone has a sign.
fn unknowns(compiled: &Compiled) -> Vec<Unknown> {
    let nonnegative = |base: usize| match compiled.standard[compiled.base.kept[base]].owner {
        Owner::Effect { effect, parameter } => {
            compiled.base.combinations[base].len() == 1
                && compiled.model.effects[effect].definition.linear[parameter].nonnegative
        }
        Owner::Link { .. } => false,
    };
    let names = compiled.base.names.iter().enumerate();
    names
        .map(|(base, name)| Unknown {
            name: name.clone(),
            nonnegative: nonnegative(base),
        })
        .collect()
}

/// The name that the effect would have if it were declared last: `JOINT.EFFECT`, or `JOINT.EFFECT2`.
fn next_name(model: &Model, definition: &EffectDefinition, joints: &[usize]) -> String {
    let same = |effect: &&robot_model_spec::model::Effect| {
        effect.definition.name == definition.name && effect.joints[0] == joints[0]
    };
    let joint = &model.joints[joints[0]].name;
    match model.effects.iter().filter(same).count() {
        0 => format!("{joint}.{}", definition.name),
        declared => format!("{joint}.{}{}", definition.name, declared + 1),
    }
}

/// First values to try: at the definition's step, else evenly spaced in the logarithm, or evenly where the range has none.
fn grid(shape: &ShapeParameter) -> Vec<f64> {
    let (low, high) = (shape.low, shape.high);
    let points: Vec<f64> = match shape.step {
        Some(step) => (0..MOST_GRID_POINTS)
            .map(|k| low + step * f64::from(k))
            .take_while(|value| *value < high - 1e-9 * step)
            .collect(),
        None => (0..GRID_POINTS - 1)
            .map(|k| {
                let share = k as f64 / (GRID_POINTS - 1) as f64;
                if low > 0.0 {
                    low * (high / low).powf(share)
                } else {
                    low + share * (high - low)
                }
            })
            .collect(),
    };
    points.into_iter().chain([high]).collect()
}

/// All ways to draw `count` different joints of `dof`, in order.
fn tuples(dof: usize, count: usize) -> Vec<Vec<usize>> {
    (0..count).fold(vec![Vec::new()], |shorter, _| {
        let longer = |tuple: Vec<usize>| {
            let free: Vec<usize> = (0..dof).filter(|joint| !tuple.contains(joint)).collect();
            free.into_iter()
                .map(move |joint| [tuple.as_slice(), &[joint]].concat())
        };
        shorter.into_iter().flat_map(longer).collect()
    })
}

/// Equal up to rounding.
fn same(left: &[Entry], right: &[Entry]) -> bool {
    let close = |(x, y): (&f64, &f64)| (x - y).abs() <= 1e-12 * (1.0 + x.abs());
    left.len() == right.len()
        && left.iter().zip(right).all(|(left, right)| {
            (left.joint, left.column) == (right.joint, right.column)
                && left.values.iter().zip(&right.values).all(close)
        })
}

fn reads_rigid_torque(program: &Program) -> bool {
    program
        .symbols()
        .iter()
        .any(|symbol| matches!(symbol, Symbol::RigidTorque(_)))
}

fn run_block(
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

fn run<'a>(
    program: &Program,
    motion: &Motion,
    bind: &dyn Fn(Symbol) -> Operand<'a>,
) -> Vec<Vec<f64>> {
    let mut out = vec![Vec::new(); program.outputs()];
    program.eval_batch(motion.time.len(), bind, &mut out);
    out
}

fn bind<'a>(
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

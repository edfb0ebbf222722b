//! Effects that a spec does not declare, as candidates of the tracer.

use std::collections::BTreeSet;

use robot_model::columns::{Candidate, Columns, Entry, Shape, Unknown};
use robot_model::log::{Channel, MOTION_PHASE};
use robot_model::motion::{Kinematics, Motion};
use robot_model_codegen::effect_columns;
use robot_model_spec::model::{Act, EffectDefinition, Model};

use super::InterpretedArm;
use super::band::EffectBlock;
use super::rough::is_rough;
use super::shape::grids;

impl InterpretedArm {
    /// Every effect that the spec may declare and does not, on every joint or group of joints. A declared effect comes again
    /// where it has shape parameters: a second ripple has another period.
    #[must_use]
    pub fn candidates(&self) -> Vec<InterpretedCandidate> {
        let model = &self.compiled.model;
        let mut candidates = Vec::new();
        let definitions = model.definitions.iter();
        let tried: Vec<&EffectDefinition> = definitions
            .map(AsRef::as_ref)
            .filter(|definition| may_be_tried(definition, model))
            .collect();
        let definitions = tried.iter().filter(|definition| {
            !tried
                .iter()
                .any(|other| is_case_of(model, definition, other))
        });
        for definition in definitions {
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
        // Late as the arm's own columns are; one whose delay is open has none yet.
        let delay = self.measured.seconds(&self.given);
        for candidate in &mut candidates {
            candidate.delay = delay.filter(|seconds| seconds.is_finite());
        }
        candidates
    }
}

/// A law with more linear parameters than this is a model of its own, not what another model lacks.
const MOST_UNKNOWNS: usize = 3;

/// Whether an effect is one that other models may lack.
#[must_use]
pub fn is_tried(definition: &EffectDefinition) -> bool {
    let mut acts = definition.acts.iter();
    definition.linear.len() <= MOST_UNKNOWNS || acts.any(|act| matches!(act, Act::Body { .. }))
}

/// Whether a residual may be traced to an effect: where it is a torque that is added, or a force on a link, not where it changes the
/// rigid body or the log, and not to a sum of effects that are tried one by one. Forces are tried where links stand where their joints
/// say: other forces, bodies and a base that is tilted move none.
fn may_be_tried(definition: &EffectDefinition, model: &Model) -> bool {
    let mut acts = definition.acts.iter();
    let is_force = acts.all(|act| matches!(act, Act::Force { .. }));
    let mut declared = model.effects.iter();
    let moves = |act: &Act| matches!(act, Act::Position { .. });
    let stands = declared.all(|effect| !effect.definition.acts.iter().any(moves));
    is_tried(definition)
        && (definition.acts.is_empty() || (is_force && stands && model.chain().is_some()))
}

/// An effect of the spec's library on joints where the spec does not declare it.
#[derive(Debug, Clone)]
pub struct InterpretedCandidate {
    kind: String,
    effect: String,
    joints: Vec<usize>,
    unknowns: Vec<Unknown>,
    shapes: Vec<Shape>,
    columns: EffectBlock,
    /// By how much the log's torques are late, s.
    delay: Option<f64>,
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
        let shapes = definition.shapes.iter().zip(grids(definition));
        let shapes = shapes.map(|(shape, grid)| Shape {
            name: format!("{prefix}.{}", shape.name),
            grid,
        });
        let columns = effect_columns(definition, joints, model);
        Self {
            kind: definition.kind.replace('_', "-"),
            effect: definition.name.clone(),
            joints: joints.to_vec(),
            unknowns: unknowns.collect(),
            shapes: shapes.collect(),
            columns: EffectBlock::new(
                columns.block,
                columns.states,
                definition
                    .inputs
                    .iter()
                    .map(|input| input.column(joints))
                    .collect(),
                model
                    .joints
                    .iter()
                    .map(|joint| joint.actuator_gain)
                    .collect(),
                |parameter| is_rough(definition, parameter),
            ),
            delay: None,
        }
    }

    /// Its columns over a few states that have nothing to do with each other, in a canonical order; shapes in the middle.
    fn probe(&self, dof: usize) -> Vec<Entry> {
        self.probe_at(dof, &self.middle())
    }

    /// The middle of every shape's grid.
    fn middle(&self) -> Vec<f64> {
        let shapes = self.shapes.iter();
        shapes
            .map(|shape| shape.grid[shape.grid.len() / 2])
            .collect()
    }

    fn probe_at(&self, dof: usize, shapes: &[f64]) -> Vec<Entry> {
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
        let kinematics = Kinematics {
            q: signal(0),
            dq: signal(1),
            ddq: signal(2),
        };
        let motion = Motion {
            time: (0..STATES).map(|state| state as f64).collect(),
            smooth: kinematics.clone(),
            wide: kinematics,
            rigid_torque: signal(3),
            tau: signal(4),
            // Channels of joints are as different as the joints.
            extra: self
                .inputs()
                .iter()
                .zip(signal(5).into_iter().cycle())
                .map(|(name, values)| Channel {
                    name: name.clone(),
                    values,
                })
                .collect(),
            ..Motion::default()
        };
        let mut entries = self.entries(&motion, shapes);
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
        self.columns.uses_rigid_torque()
    }

    fn inputs(&self) -> &[String] {
        self.columns.inputs()
    }

    fn entries(&self, motion: &Motion, shapes: &[f64]) -> Vec<Entry> {
        let mut entries = self.columns.run(motion, shapes);
        if let Some(seconds) = self.delay {
            for entry in &mut entries {
                entry.values = motion.late(&entry.values, seconds);
            }
        }
        entries
    }
}

impl Candidate for InterpretedCandidate {
    fn kind(&self) -> &str {
        &self.kind
    }

    fn effect(&self) -> String {
        self.effect.clone()
    }

    fn follows_torque(&self) -> bool {
        self.columns.reads_measured_torque()
    }

    fn is_of_time(&self) -> bool {
        self.columns.reads_time() || self.inputs().iter().any(|input| input == MOTION_PHASE)
    }

    fn is_of_position(&self) -> bool {
        self.columns.reads_positions_alone()
    }

    fn joints(&self) -> &[usize] {
        &self.joints
    }
}

/// Whether a law with shapes is another one with some of its shapes at the ends of their ranges, as Dahl's friction is one
/// of Bouc and Wen's loops: the other law is tried, and finds it.
fn is_case_of(model: &Model, law: &EffectDefinition, other: &EffectDefinition) -> bool {
    let parameters = |law: &EffectDefinition| law.linear.len() + law.shapes.len();
    let (dof, count) = (model.joints.len(), law.joints.len());
    if law.shapes.is_empty() || parameters(other) <= parameters(law) || other.joints.len() != count
    {
        return false;
    }
    let Some(joints) = tuples(dof, count).into_iter().next() else {
        return false;
    };
    let candidate = InterpretedCandidate::new(model, law, &joints);
    let values = candidate.middle();
    let wanted = candidate.probe(dof);
    // A limit that the probe does not reach says nothing of the law.
    if wanted
        .iter()
        .all(|entry| entry.values.iter().all(|value| *value == 0.0))
    {
        return false;
    }
    let other = InterpretedCandidate::new(model, other, &joints);
    let mut points = vec![Vec::new()];
    for shape in &other.shapes {
        let (low, high) = (shape.grid[0], shape.grid[shape.grid.len() - 1]);
        let inside = values.iter().copied().filter(|v| (low..=high).contains(v));
        let options: Vec<f64> = inside.chain([low, high]).collect();
        let longer = |point: &Vec<f64>| {
            let point = point.clone();
            let options = options.clone();
            options
                .into_iter()
                .map(move |value| [point.as_slice(), &[value]].concat())
        };
        points = points.iter().flat_map(longer).collect();
    }
    points.iter().any(|point| {
        let found = other.probe_at(dof, point);
        wanted
            .iter()
            .all(|entry| found.iter().any(|other| same_values(entry, other)))
    })
}

/// Equal up to rounding on the same joint, whatever the columns are.
fn same_values(left: &Entry, right: &Entry) -> bool {
    let columns = |entry: &Entry| {
        vec![Entry {
            column: 0,
            ..entry.clone()
        }]
    };
    same(&columns(left), &columns(right))
}

/// The name that the effect would have if it were declared last: `JOINT.EFFECT`, or `JOINT.EFFECT2`.
fn next_name(model: &Model, definition: &EffectDefinition, joints: &[usize]) -> String {
    let same = |effect: &&robot_model_spec::model::Effect| {
        effect.definition.name == definition.name && effect.joints.first() == joints.first()
    };
    let joint = &model.joints[joints[0]].name;
    match model.effects.iter().filter(same).count() {
        0 => format!("{joint}.{}", definition.name),
        declared => format!("{joint}.{}{}", definition.name, declared + 1),
    }
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

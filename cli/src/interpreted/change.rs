//! Effects that change where links stand or where gravity comes from, as candidates of the tracer.

use std::sync::Arc;

use robot_model::columns::{Arm, Candidate, Change, Columns, Entry, Shape, Unknown};
use robot_model::identify::is_delay;
use robot_model::motion::{Kinematics, Motion};
use robot_model_codegen::compile_for_rows;
use robot_model_spec::model::{Act, EffectDefinition};

use super::InterpretedArm;
use super::shape::grids;
use crate::in_order::each;

/// A shape with an end that changes nothing is probed this part of its first values away from there, where it changes little.
const LITTLE: usize = 4;

/// An effect without torque on joints where the spec does not declare it, as the arm with it.
#[derive(Debug, Clone)]
pub struct InterpretedChange {
    kind: String,
    effect: String,
    joints: Vec<usize>,
    /// The shapes of the effect, as what is unknown of it.
    shapes: Vec<Unknown>,
    arm: InterpretedArm,
    neutral: Vec<f64>,
    probe: Vec<f64>,
    is_delay: bool,
}

impl InterpretedArm {
    /// Every effect of the library that moves a link, tilts the base or makes the log's torques late and is not declared, on every joint.
    /// Bodies have [columns](Self::bodies).
    #[must_use]
    pub fn changes(&self) -> Vec<InterpretedChange> {
        let model = &self.compiled.model;
        let is_change = |definition: &&Arc<EffectDefinition>| {
            let mut acts = definition.acts.iter();
            let moves = acts.all(|act| {
                matches!(
                    act,
                    Act::Position { .. } | Act::Tilt { .. } | Act::Delay { .. }
                )
            });
            moves
                && !definition.acts.is_empty()
                && definition.torques.is_empty()
                && definition.linear.is_empty()
                && !definition.shapes.is_empty()
                && definition.joints.len() <= 1
        };
        let Some(chain) = model.chain() else {
            return Vec::new();
        };
        let has_gravity = chain.gravity.iter().any(|g| *g != 0.0);
        let definitions = model.definitions.iter().filter(is_change);
        let all = definitions.flat_map(|definition| {
            let is_tilt = definition
                .acts
                .iter()
                .any(|act| matches!(act, Act::Tilt { .. }));
            let joints: Vec<Vec<usize>> = if definition.joints.is_empty() {
                vec![Vec::new(); usize::from(has_gravity || !is_tilt)]
            } else {
                (0..model.joints.len()).map(|joint| vec![joint]).collect()
            };
            joints.into_iter().map(move |joints| (definition, joints))
        });
        let is_declared = |name: &str, joints: &[usize]| {
            let mut effects = model.effects.iter();
            effects.any(|effect| effect.definition.name == name && effect.joints == joints)
        };
        // Of delays there is one.
        let mut effects = model.effects.iter();
        let is_late = effects.any(|effect| is_delaying(&effect.definition));
        let is_there = |definition: &EffectDefinition, joints: &[usize]| {
            is_declared(&definition.name, joints) || (is_late && is_delaying(definition))
        };
        let all = all.filter(|(definition, joints)| !is_there(definition, joints));
        let found = each(all, |(definition, joints)| {
            InterpretedChange::new(self, definition, joints)
        });
        found.into_iter().flatten().collect()
    }
}

/// Whether an effect makes the log's torques late.
pub(crate) fn is_delaying(definition: &EffectDefinition) -> bool {
    let mut acts = definition.acts.iter();
    acts.any(|act| matches!(act, Act::Delay { .. }))
}

impl InterpretedChange {
    fn new(
        arm: &InterpretedArm,
        definition: &Arc<EffectDefinition>,
        joints: Vec<usize>,
    ) -> Option<Self> {
        let model = arm.compiled.model.with(definition, &joints);
        let prefix = model.effect_name(model.effects.len() - 1);
        let with = InterpretedArm::new(compile_for_rows(&model));
        if !with.compiled.base.rank.is_clear() {
            return None;
        }
        let mut change = Self {
            kind: definition.kind.replace('_', "-"),
            effect: definition.name.clone(),
            joints,
            shapes: definition
                .shapes
                .iter()
                .map(|shape| Unknown {
                    name: format!("{prefix}.{}", shape.name),
                    nonnegative: false,
                })
                .collect(),
            arm: with,
            neutral: Vec::new(),
            probe: Vec::new(),
            is_delay: is_delaying(definition),
        };
        for grid in grids(definition) {
            let (low, high) = (grid[0], grid[grid.len() - 1]);
            if low < 0.0 && high > 0.0 {
                // The grid's own zero is one to rounding.
                let step = grid.iter().copied().find(|value| *value > 1e-6 * high)?;
                change.neutral.push(0.0);
                change.probe.push(step);
            } else if definition.shapes.len() > 1 {
                // Which end of one changes nothing is not known without the others.
                return None;
            } else {
                let [of_low, of_high] = [low, high].map(|end| change.displacement(end));
                let (little, last) = (grid.len() / LITTLE, grid.len() - 1);
                let (neutral, probe) = if of_low < of_high {
                    (low, grid[little])
                } else {
                    (high, grid[last - little])
                };
                change.neutral.push(neutral);
                change.probe.push(probe);
            }
        }
        Some(change)
    }

    /// How far its only shape moves a link that is loaded, rad or m.
    fn displacement(&self, shape: f64) -> f64 {
        let dof = self.arm.joints.len();
        let signal = || vec![vec![1.0; 3]; dof];
        let kinematics = Kinematics {
            q: signal(),
            dq: signal(),
            ddq: signal(),
        };
        let motion = Motion {
            time: vec![0.0, 1.0, 2.0],
            smooth: kinematics.clone(),
            wide: kinematics,
            rigid_torque: signal(),
            transmitted_torque: signal(),
            tau: signal(),
            ..Motion::default()
        };
        let free = self.arm.shapes.len() - 1;
        let others = self.arm.shapes[..free].iter();
        let mut shapes: Vec<f64> = others
            .map(|shape| shape.grid[shape.grid.len() / 2])
            .collect();
        shapes.push(shape);
        let links = self
            .arm
            .measured
            .links(&motion, &self.arm.all_shapes(&shapes));
        let moved = links.q.iter().flatten().map(|q| (q - 1.0).abs());
        moved.fold(0.0, f64::max)
    }
}

impl Columns for InterpretedChange {
    fn unknowns(&self) -> &[Unknown] {
        &self.shapes
    }

    fn shapes(&self) -> &[Shape] {
        &[]
    }

    fn uses_rigid_torque(&self) -> bool {
        // Its first order is that at the first estimate: it only says what is worth a trial.
        false
    }

    fn inputs(&self) -> &[String] {
        self.arm.inputs()
    }

    fn entries(&self, _: &Motion, _: &[f64]) -> Vec<Entry> {
        Vec::new()
    }
}

impl Candidate for InterpretedChange {
    fn kind(&self) -> &str {
        &self.kind
    }

    fn effect(&self) -> String {
        self.effect.clone()
    }

    fn joints(&self) -> &[usize] {
        &self.joints
    }

    fn change(&self) -> Option<&dyn Change> {
        Some(self)
    }
}

impl Change for InterpretedChange {
    fn arm(&self) -> &dyn Arm {
        &self.arm
    }

    fn neutral(&self) -> &[f64] {
        &self.neutral
    }

    fn probe(&self) -> &[f64] {
        &self.probe
    }

    fn counts(&self, shapes: &[f64], period: f64) -> bool {
        !self.is_delay || shapes.iter().all(|seconds| is_delay(*seconds, period))
    }
}

//! Bodies that a spec does not know of, as candidates of the tracer.

use std::sync::Arc;

use robot_model::columns::{Candidate, Columns, Entry, Shape, Unknown};
use robot_model::motion::Motion;
use robot_model_codegen::compile_for_rows;
use robot_model_spec::model::{Act, EffectDefinition};
use robot_model_spec::parameter::Owner;

use super::InterpretedArm;
use super::program::run_block;
use super::signals::{Own, Signals};
use crate::in_order::each;

/// A body more on a link whose own inertial is known.
#[derive(Debug, Clone)]
pub struct InterpretedBody {
    kind: String,
    effect: String,
    joints: Vec<usize>,
    /// The arm with the body.
    arm: InterpretedArm,
    /// Unknowns of that arm that it does not have without.
    new: Vec<usize>,
    unknowns: Vec<Unknown>,
}

impl InterpretedArm {
    /// Bodies that the arm may carry and its spec does not declare: one effect a link, of several in the library the first that is
    /// not declared, and on the last link the one that may only be heavy. None where a link's own inertial is identified, as its
    /// parameters take in what the body adds.
    #[must_use]
    pub fn bodies(&self) -> Vec<InterpretedBody> {
        let model = &self.compiled.model;
        let is_fixed = model.chain().is_some() && !self.compiled.base.fixed.is_empty();
        // What bodies weigh must not hang on shapes that are looked for.
        let is_open = model
            .effects
            .iter()
            .any(|effect| !effect.definition.acts.is_empty() && effect.shapes.contains(&None));
        if !is_fixed || is_open {
            return Vec::new();
        }
        let definitions = model.definitions.iter().filter(|definition| {
            matches!(definition.acts.as_slice(), [Act::Body { .. }])
                && definition.torques.is_empty()
                && definition.shapes.is_empty()
                && definition.joints.len() == 1
        });
        let definitions: Vec<&Arc<EffectDefinition>> = definitions.collect();
        let last = model.joints.len() - 1;
        let of_link = |joint: usize| {
            let is_heavy = |definition: &&Arc<EffectDefinition>| {
                definition
                    .linear
                    .first()
                    .is_some_and(|mass| mass.nonnegative)
            };
            let declared = |definition: &&Arc<EffectDefinition>| {
                model.effects.iter().any(|effect| {
                    effect.definition.name == definition.name && effect.joints == [joint]
                })
            };
            let mut wanted = definitions
                .iter()
                .copied()
                .filter(|d| is_heavy(d) == (joint == last));
            let definition = wanted.find(|definition| !declared(definition))?;
            InterpretedBody::new(self, definition, joint)
        };
        each(0..=last, of_link).into_iter().flatten().collect()
    }
}

impl InterpretedBody {
    fn new(arm: &InterpretedArm, definition: &Arc<EffectDefinition>, joint: usize) -> Option<Self> {
        let model = arm.compiled.model.with(definition, &[joint]);
        let own = model.effects.len() - 1;
        let with = InterpretedArm::new(compile_for_rows(&model));
        let base = &with.compiled.base;
        let is_new = |column: usize| {
            matches!(
                with.compiled.standard[base.kept[column]].owner,
                Owner::Effect { effect, .. } if effect == own
            )
        };
        let (new, old): (Vec<usize>, Vec<usize>) =
            (0..base.kept.len()).partition(|&column| is_new(column));
        // Ten unknowns are many for an effect, but they are those of one body, and all others stay what they were.
        let is_apart = old
            .iter()
            .map(|&k| base.kept[k])
            .eq(arm.compiled.base.kept.iter().copied());
        if new.is_empty() || !is_apart || !base.rank.is_clear() {
            return None;
        }
        Some(Self {
            kind: definition.kind.replace('_', "-"),
            effect: definition.name.clone(),
            joints: vec![joint],
            unknowns: new.iter().map(|&k| with.unknowns[k].clone()).collect(),
            new,
            arm: with,
        })
    }
}

impl Columns for InterpretedBody {
    fn unknowns(&self) -> &[Unknown] {
        &self.unknowns
    }

    fn shapes(&self) -> &[Shape] {
        &[]
    }

    fn uses_rigid_torque(&self) -> bool {
        self.arm.measured.uses_rigid_torque()
    }

    fn entries(&self, motion: &Motion, _: &[f64]) -> Vec<Entry> {
        let shapes = &self.arm.given;
        let signals = Signals {
            motion,
            shapes,
            own: &Own::default(),
        };
        let links = self.arm.measured.links(motion, shapes);
        let entries = run_block(&self.arm.rigid, &signals, &links).into_iter();
        let own = entries.filter_map(|entry| {
            let column = self.new.iter().position(|&new| new == entry.column)?;
            Some(Entry { column, ..entry })
        });
        self.arm.measured.entries(motion, shapes, own.collect())
    }
}

impl Candidate for InterpretedBody {
    fn kind(&self) -> &str {
        &self.kind
    }

    fn effect(&self) -> String {
        self.effect.clone()
    }

    fn joints(&self) -> &[usize] {
        &self.joints
    }
}

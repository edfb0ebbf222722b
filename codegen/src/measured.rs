//! What stands between the equations and a log: links that are not where their encoders say, torques that come late.
//!
//! Both are no functions of `q, dq, ddq` at one instant, so no equation has them: identification and prediction apply them to
//! whole motions.

use std::collections::BTreeMap;
use std::fmt;

use robot_model_spec::Model;
use robot_model_spec::parameter::Owner;

use crate::block::Block;
use crate::compiled::Compiled;
use crate::dynamics::Changes;
use crate::expr::{Dag, ExprId};
use crate::interpreter::Program;

/// An effect because of which the torque is no function of `q, dq, ddq` at one instant.
#[derive(Debug, Clone, PartialEq, Eq)]
#[non_exhaustive]
pub struct NotInstantaneous {
    /// File and line of the declaration.
    place: String,
    effect: String,
}

impl NotInstantaneous {
    /// Of a declared effect, by its index.
    pub(crate) fn new(model: &Model, effect: usize) -> Self {
        let effect = &model.effects[effect];
        Self {
            place: format!("{}:{}", model.source, effect.line),
            effect: effect.definition.name.clone(),
        }
    }

    /// Without the place.
    pub(crate) fn reason(&self) -> String {
        format!(
            "`{}` displaces a link depending on the motion, so `q`, `dq` and `ddq` of one instant do not determine the torque; identify \
             with it, but remove it for equations or code",
            self.effect
        )
    }
}

impl fmt::Display for NotInstantaneous {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}: {}", self.place, self.reason())
    }
}

impl std::error::Error for NotInstantaneous {}

/// What the log's positions and torques are to those of the equations.
#[derive(Debug, Clone)]
pub(crate) struct Measurement {
    /// Added to the position of a joint, as that of its link, rad or m; one entry a joint at most, ascending.
    pub displacements: Vec<(usize, ExprId)>,
    /// Seconds by which torques are late.
    pub delay: Option<ExprId>,
}

impl Compiled {
    /// As expressions of signals and shapes.
    pub(crate) fn measurement(&self, dag: &mut Dag) -> Measurement {
        let changes = Changes::of(dag, &self.model);
        let mut sums = BTreeMap::new();
        for (joint, value) in changes.displacements {
            let sum = sums.entry(joint).or_insert(dag.zero());
            *sum = dag.add(*sum, value);
        }
        let is_there = !changes.delays.is_empty();
        Measurement {
            displacements: sums.into_iter().collect(),
            delay: is_there.then(|| dag.sum(changes.delays)),
        }
    }

    /// How far links stand from where the log has their joints, along a motion: output `k` is that of joint
    /// `entries[k].0`, rad or m. `None` where all stand where they should, or a constant away, which is in the equations.
    #[must_use]
    pub fn displacements(&self) -> Option<Block> {
        let mut dag = self.dag.clone();
        let displacements = self.measurement(&mut dag).displacements.into_iter();
        let entries = displacements.map(|(joint, value)| (joint, joint, value));
        let block = Block::new(&dag, entries.collect());
        (!block.entries.is_empty()).then_some(block)
    }

    /// Base parameters that are of the rigid body and of effects together, by name: an inertia of a link and that of its
    /// motor, which are two where links move against their motors.
    #[must_use]
    pub fn mixed(&self) -> Vec<&str> {
        self.sums(|_| true).collect()
    }

    /// Those with an effect on one of some joints: a motor's inertia acts on its own joint alone, so that the load of another is known in spite of it.
    #[must_use]
    pub fn mixed_on(&self, joints: &[usize]) -> Vec<&str> {
        let acts = |joint: &usize| joints.contains(joint);
        self.sums(|effect| self.model.effects[effect].joints.iter().any(acts))
            .collect()
    }

    /// Base parameters of the rigid body and of some effect that is wanted.
    fn sums(&self, is_wanted: impl Fn(usize) -> bool) -> impl Iterator<Item = &str> {
        let is_rigid = |k: usize| self.model.is_rigid(&self.standard[k]);
        let is_of_effect = move |k: usize| match self.standard[k].owner {
            Owner::Effect { effect, .. } => !is_rigid(k) && is_wanted(effect),
            Owner::Link { .. } | Owner::Monomial(_) => false,
        };
        let combinations = self.base.names.iter().zip(&self.base.combinations);
        let mixed = combinations.filter(move |(_, sum)| {
            sum.iter().any(|&(k, _)| is_rigid(k)) && sum.iter().any(|&(k, _)| is_of_effect(k))
        });
        mixed.map(|(name, _)| name.as_str())
    }

    /// Seconds by which the log's torques are late, one output; reads shapes. `None` where they are not.
    #[must_use]
    pub fn delay(&self) -> Option<Program> {
        let mut dag = self.dag.clone();
        let delay = self.measurement(&mut dag).delay?;
        Some(Program::new(&dag, &[delay]))
    }

    /// Whether equations say the whole torque.
    ///
    /// # Errors
    /// [`NotInstantaneous`] names the first effect that moves a link along a motion.
    pub fn check_instantaneous(&self) -> Result<(), NotInstantaneous> {
        let mut effects = self.model.effects.iter();
        match effects.position(|effect| effect.definition.moves_links()) {
            None => Ok(()),
            Some(effect) => Err(NotInstantaneous::new(&self.model, effect)),
        }
    }
}

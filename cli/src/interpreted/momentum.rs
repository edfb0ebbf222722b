//! The interpreter behind the momentum form: identification without accelerations.

use std::fmt;

use robot_model::columns::{Arm, Columns, Entry, MomentumArm, Nominal, Shape, Unknown};
use robot_model::identify::PossibleArms;
use robot_model::motion::Motion;
use robot_model_codegen::filtered::Reason;
use robot_model_codegen::interpreter::Program;
use robot_model_codegen::{Block, Compiled};

use super::band::EffectBlock;
use super::program::{run, run_block};
use super::signals::{Own, Signals};
use super::{InterpretedArm, torque_block};

/// An arm whose columns need no accelerations.
#[derive(Debug, Clone)]
pub struct InterpretedMomentum {
    arm: InterpretedArm,
    momentum: Block,
    rigid_drift: Block,
    effect_drift: EffectBlock,
    known_momentum: Program,
    known_drift: Program,
}

/// Why an arm has no momentum form: an unknown whose column no filter frees of the acceleration, or an effect that moves links.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct NoMomentumForm {
    /// Where the effect is declared: file and line.
    place: String,
    parameter: String,
    reason: Reason,
}

impl fmt::Display for NoMomentumForm {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(
            f,
            "{}: `{}` has no filtered form: {}; identify with `--form acceleration`, or take the effect out",
            self.place, self.parameter, self.reason
        )
    }
}

impl std::error::Error for NoMomentumForm {}

impl InterpretedMomentum {
    /// The momentum form of a compiled spec.
    ///
    /// # Errors
    /// [`NoMomentumForm`] names the first unknown whose column reads accelerations in a way that does not go by parts.
    pub fn new(compiled: Compiled) -> Result<Self, NoMomentumForm> {
        if let Some(refusal) = refusal(&compiled) {
            return Err(refusal);
        }
        Ok(Self {
            momentum: compiled.base_momentum(),
            rigid_drift: compiled.rigid_drift(),
            effect_drift: torque_block(&compiled, compiled.effect_drift()),
            known_momentum: compiled.known_momentum(),
            known_drift: compiled.known_drift(),
            arm: InterpretedArm::new(compiled),
        })
    }

    /// What was compiled.
    #[must_use]
    pub fn compiled(&self) -> &Compiled {
        self.arm.compiled()
    }

    fn known(&self, program: &Program, motion: &Motion, shapes: &[f64]) -> Vec<Vec<f64>> {
        let shapes = self.arm.all_shapes(shapes);
        let signals = Signals {
            motion,
            shapes: &shapes,
            own: &Own::default(),
        };
        let series = run(program, motion, &|symbol| {
            signals.bind(&motion.smooth, symbol)
        });
        self.arm.measured.series(motion, &shapes, series)
    }

    /// Columns of the rigid body.
    fn rigid(&self, block: &Block, motion: &Motion, shapes: &[f64]) -> Vec<Entry> {
        let signals = Signals {
            motion,
            shapes: &self.arm.all_shapes(shapes),
            own: &Own::default(),
        };
        run_block(block, &signals, &motion.smooth)
    }
}

fn refusal(compiled: &Compiled) -> Option<NoMomentumForm> {
    let mut effects = compiled.model.effects.iter();
    if let Some(effect) = effects.find(|effect| effect.definition.moves_links()) {
        return Some(NoMomentumForm {
            place: format!("{}:{}", compiled.model.source, effect.line),
            parameter: effect.definition.name.clone(),
            reason: Reason::Displacement,
        });
    }
    let mut refused = compiled.base_momentum.refused.iter();
    // What regroups into other columns needs no column of its own.
    let refusal = refused.find(|refusal| compiled.base.kept.contains(&refusal.parameter))?;
    let parameter = &compiled.standard[refusal.parameter];
    let model = &compiled.model;
    let place = match parameter.owner {
        robot_model_spec::parameter::Owner::Effect { effect, .. } => {
            format!("{}:{}", model.source, model.effects[effect].line)
        }
        _ => model.source.clone(),
    };
    Some(NoMomentumForm {
        place,
        parameter: parameter.name.clone(),
        reason: refusal.reason,
    })
}

impl Columns for InterpretedMomentum {
    fn unknowns(&self) -> &[Unknown] {
        self.arm.unknowns()
    }

    fn shapes(&self) -> &[Shape] {
        self.arm.shapes()
    }

    fn uses_rigid_torque(&self) -> bool {
        self.arm.uses_rigid_torque()
    }

    fn inputs(&self) -> &[String] {
        self.arm.inputs()
    }

    fn entries(&self, motion: &Motion, shapes: &[f64]) -> Vec<Entry> {
        self.arm.entries(motion, shapes)
    }
}

impl Arm for InterpretedMomentum {
    fn dof(&self) -> usize {
        self.arm.dof()
    }

    fn joints(&self) -> &[String] {
        self.arm.joints()
    }

    fn actuator_gain(&self) -> &[f64] {
        self.arm.actuator_gain()
    }

    fn known_torque(&self, motion: &Motion, shapes: &[f64]) -> Vec<Vec<f64>> {
        self.arm.known_torque(motion, shapes)
    }

    fn rigid_torque(&self, motion: &Motion, shapes: &[f64], estimate: &[f64]) -> Vec<Vec<f64>> {
        self.arm.rigid_torque(motion, shapes, estimate)
    }

    fn dry_joints(&self) -> &[usize] {
        self.arm.dry_joints()
    }

    fn dry_shapes(&self) -> &[usize] {
        self.arm.dry_shapes()
    }

    fn follows_load(&self) -> bool {
        self.arm.follows_load()
    }

    fn saturated_joints(&self) -> &[usize] {
        self.arm.saturated_joints()
    }

    fn nominal(&self) -> Vec<Option<Nominal>> {
        self.arm.nominal()
    }

    fn possible_arms(&self) -> Option<PossibleArms> {
        self.arm.possible_arms()
    }
}

impl MomentumArm for InterpretedMomentum {
    fn momentum(&self, motion: &Motion, shapes: &[f64]) -> Vec<Entry> {
        let entries = self.rigid(&self.momentum, motion, shapes);
        let shapes = self.arm.all_shapes(shapes);
        self.arm.measured.entries(motion, &shapes, entries)
    }

    fn drift(&self, motion: &Motion, shapes: &[f64]) -> Vec<Entry> {
        let mut entries = self.rigid(&self.rigid_drift, motion, shapes);
        let shapes = self.arm.all_shapes(shapes);
        entries.extend(self.effect_drift.run(motion, &shapes));
        self.arm.measured.entries(motion, &shapes, entries)
    }

    fn known_momentum(&self, motion: &Motion, shapes: &[f64]) -> Vec<Vec<f64>> {
        self.known(&self.known_momentum, motion, shapes)
    }

    fn known_drift(&self, motion: &Motion, shapes: &[f64]) -> Vec<Vec<f64>> {
        self.known(&self.known_drift, motion, shapes)
    }
}

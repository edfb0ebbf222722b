//! `robot-model check`: is the spec sound, and what does it describe?

use std::fmt::Write;
use std::path::PathBuf;

use clap::Args;
use robot_model_codegen::Compiled;
use robot_model_spec::model::JointKind;

use crate::output::counted;
use crate::spec::compile_to_look_at;
use crate::{Error, output};

/// Check a spec: print every mistake with its line and a fix, or a summary of the arm.
#[derive(Debug, Args)]
#[command(after_help = "Examples:
  robot-model check arm.robot")]
pub(crate) struct Check {
    /// The `.robot` file.
    spec: PathBuf,
}

impl Check {
    pub(crate) fn run(&self) -> Result<(), Error> {
        output::print(&summary(&compile_to_look_at(&self.spec)?))
    }
}

/// Counts, joints and effects in a few lines.
fn summary(compiled: &Compiled) -> String {
    let model = &compiled.model;
    let mut text = format!(
        "{}: {}, {} of {}\n",
        model.name,
        counted(model.joints.len(), "joint"),
        counted(compiled.base.kept.len(), "base parameter"),
        counted(compiled.standard.len(), "standard parameter"),
    );
    let width = model
        .joints
        .iter()
        .map(|joint| joint.name.chars().count())
        .max()
        .unwrap_or(0);
    for (index, joint) in model.joints.iter().enumerate() {
        let kind = match joint.kind {
            JointKind::Revolute => "revolute",
            JointKind::Prismatic => "prismatic",
        };
        let effects: Vec<String> = model
            .effects
            .iter()
            .filter(|effect| effect.joints.contains(&index))
            .map(|effect| effect.definition.name.clone())
            .collect();
        let line = format!(
            "  {:2}  {:width$}  {kind:9}  {}",
            index + 1,
            joint.name,
            effects.join(", ")
        );
        writeln!(text, "{}", line.trim_end()).expect("a string takes all");
    }
    let of_arm = model
        .effects
        .iter()
        .filter(|effect| effect.joints.is_empty());
    let of_arm: Vec<&str> = of_arm
        .map(|effect| effect.definition.name.as_str())
        .collect();
    if !of_arm.is_empty() {
        writeln!(text, "  the arm as a whole: {}", of_arm.join(", ")).expect("a string takes all");
    }
    text
}

//! Rows of motions: of all 96 parameters, as the publication stacks them, or of base parameters.

use robot_model::columns::{Arm, Columns, Entry, Shape, Unknown};
use robot_model::identify::{JointRows, Segment, Stack};
use robot_model::motion::Motion;
use robot_model_cli::interpreted::InterpretedArm;
use robot_model_codegen::Compiled;

/// An arm with a column for each standard parameter, those that move no torque among them: the latter have zeros.
pub struct Standard {
    arm: InterpretedArm,
    unknowns: Vec<Unknown>,
    /// Of each of the arm's columns, its place among all.
    places: Vec<usize>,
}

impl Standard {
    /// Of a compiled arm.
    #[must_use]
    pub fn new(compiled: &Compiled) -> Self {
        let ungrouped = compiled.ungrouped();
        let standard = compiled.standard.iter();
        let unknown = |name: &str| Unknown {
            name: name.to_owned(),
            nonnegative: false,
        };
        Self {
            unknowns: standard.map(|one| unknown(&one.name)).collect(),
            places: ungrouped.base.kept.clone(),
            arm: InterpretedArm::new(ungrouped),
        }
    }
}

impl Columns for Standard {
    fn unknowns(&self) -> &[Unknown] {
        &self.unknowns
    }

    fn shapes(&self) -> &[Shape] {
        self.arm.shapes()
    }

    fn uses_rigid_torque(&self) -> bool {
        self.arm.uses_rigid_torque()
    }

    fn entries(&self, motion: &Motion, shapes: &[f64]) -> Vec<Entry> {
        let mut entries = self.arm.entries(motion, shapes);
        for entry in &mut entries {
            entry.column = self.places[entry.column];
        }
        entries
    }
}

impl Arm for Standard {
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
        let own: Vec<f64> = self.places.iter().map(|&place| estimate[place]).collect();
        self.arm.rigid_torque(motion, shapes, &own)
    }
}

/// Rows along a motion, and the torque of parameters that have these values.
#[must_use]
pub fn stack(arm: &dyn Arm, motion: &Motion, value: &dyn Fn(usize) -> f64) -> Stack {
    let mut joints = vec![JointRows::default(); arm.dof()];
    for entry in arm.entries(motion, &[]) {
        let rows = &mut joints[entry.joint];
        rows.target.resize(entry.values.len(), 0.0);
        for (tau, x) in rows.target.iter_mut().zip(&entry.values) {
            *tau += value(entry.column) * x;
        }
        rows.columns.push((entry.column, entry.values));
    }
    for rows in &mut joints {
        rows.tau.clone_from(&rows.target);
        rows.columns.sort_by_key(|(column, _)| *column);
    }
    Stack {
        unknowns: arm.unknowns().to_vec(),
        joints,
        segments: vec![Segment {
            start: 0,
            time: motion.time.clone(),
        }],
        ..Stack::default()
    }
}

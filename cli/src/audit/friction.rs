//! Whether effects take energy: over there and back at one speed through one pose, the work of the effects' torque is
//! `(f(v) - f(-v)) v`, whatever springs and offsets are in `f`.

use robot_model_codegen::Compiled;
use robot_model_codegen::expr::Symbol;
use robot_model_codegen::interpreter::{Operand, Program};
use robot_model_codegen::states::StateProgram;
use robot_model_spec::model::JointKind;

use super::Check;
use super::inertia::{pose, workspace};
use crate::interpreted::states;
use crate::parameters::Values;

/// Poses and speeds that are looked at.
const POSES: usize = 8;
const SPEEDS: usize = 200;

/// Largest speed of a joint whose spec says none, rad/s or m/s.
const FAST: [f64; 2] = [std::f64::consts::PI, 1.0];

/// Part of the largest torque that is rounding.
const ROUNDING: f64 = 1e-9;

/// States are looked at after so many steps over so many rad or m in all.
const STEPS: usize = 200;
const TRAVEL: f64 = 20.0;

pub(super) fn check(compiled: &Compiled, values: &Values) -> Check {
    let workspace = workspace(compiled);
    let effects = Effects {
        torque: compiled.effect_torque(),
        gravity: compiled.gravity(),
        parts: compiled.states(),
        values,
        dof: compiled.dof(),
    };
    let mut findings = Vec::new();
    let mut scope = Vec::new();
    for (joint, declared) in compiled.model.joints.iter().enumerate() {
        let (unit, usual) = match declared.kind {
            JointKind::Prismatic => ("m/s", FAST[1]),
            JointKind::Revolute => ("rad/s", FAST[0]),
        };
        let fastest = declared.limits.velocity.unwrap_or(usual);
        scope.push(format!("{fastest:.3} {unit}"));
        let worst = (0..POSES)
            .filter_map(|k| effects.gains(joint, &pose(&workspace, k), fastest))
            .min_by(|x, y| x.speed.total_cmp(&y.speed));
        if let Some(Gain { speed, power }) = worst {
            findings.push(format!(
                "joint `{}` is driven by its effects from {speed:.3} {unit} on: up to {power:.3e} W there and back",
                declared.name
            ));
        }
    }
    let scope = format!("speeds up to {}", scope.join(", "));
    Check::new("friction", scope, findings)
}

/// A speed from which on effects give energy, and the largest power that they give.
struct Gain {
    speed: f64,
    power: f64,
}

struct Effects<'a> {
    torque: Program,
    gravity: Program,
    parts: Vec<StateProgram>,
    values: &'a Values,
    dof: usize,
}

impl Effects<'_> {
    /// Where the effects of a joint give energy at a pose.
    fn gains(&self, joint: usize, pose: &[f64], fastest: f64) -> Option<Gain> {
        let lost = |speed: f64| -> (f64, f64) {
            let [there, back] = [speed, -speed].map(|speed| self.torque(joint, pose, speed));
            (0.5 * (there - back), there.abs().max(back.abs()))
        };
        let speeds = (1..=SPEEDS).map(|k| fastest * k as f64 / SPEEDS as f64);
        let found: Vec<(f64, f64, f64)> = speeds
            .map(|speed| {
                let (lost, size) = lost(speed);
                (speed, lost, size)
            })
            .collect();
        let size = found.iter().map(|found| found.2).fold(0.0, f64::max);
        let gives = |found: &&(f64, f64, f64)| found.1 < -ROUNDING * size;
        let first = found.iter().find(gives)?.0;
        let power = found.iter().filter(gives).map(|found| -found.1 * found.0);
        Some(Gain {
            speed: first,
            power: power.fold(0.0, f64::max),
        })
    }

    /// Torque of the effects on a joint that moves alone, at a constant speed.
    fn torque(&self, joint: usize, pose: &[f64], speed: f64) -> f64 {
        let bind = |load: &[f64], memory: &[f64], symbol: Symbol| match symbol {
            Symbol::Q(k) => pose[k],
            Symbol::Dq(k) if k == joint => speed,
            Symbol::Parameter(k) => self.values.parameters[k],
            Symbol::Shape(k) => self.values.shapes[k],
            Symbol::RigidTorque(k) | Symbol::MeasuredTorque(k) => load[k],
            Symbol::State(k) => memory[k],
            _ => 0.0,
        };
        let load = vec![0.0; self.dof];
        let load = self.gravity.eval(&|symbol| bind(&load, &[], symbol));
        let interval = TRAVEL / (STEPS as f64 * speed.abs());
        let operand = |symbol: Symbol| Operand::Constant(bind(&load, &[], symbol));
        let memory = states(&self.parts, STEPS, interval, &operand);
        let memory: Vec<f64> = memory.iter().map(|z| z[STEPS - 1]).collect();
        self.torque.eval(&|symbol| bind(&load, &memory, symbol))[joint]
    }
}

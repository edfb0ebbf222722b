//! Whether effects take energy: over a way there at one speed and back at another, through one pose, the work of the effects'
//! torque is `f(v) - f(-w)` a rad, whatever springs and offsets are in `f`. A term that is even in the velocity, as the square of
//! it, takes part: at one speed both ways it cancels, at two it does not.

use robot_model_codegen::Compiled;
use robot_model_codegen::expr::Symbol;
use robot_model_codegen::interpreter::{Operand, Program};
use robot_model_codegen::states::StateProgram;
use robot_model_spec::model::JointKind;

use super::workspace::{pose, workspace};
use super::{Check, Quantity};
use crate::interpreted::states;
use crate::parameters::Values;
use crate::units::Units;

/// Poses, directions of several joints, and speeds that are looked at.
const POSES: usize = 8;
const DIRECTIONS: usize = 24;
const SPEEDS: usize = 100;

/// Halvings of the interval between two speeds, where effects begin to give energy in it.
const BISECTIONS: usize = 10;

/// Share of the largest speeds that is slower than all thresholds of laws: what friction takes of a joint that creeps.
pub(super) const CREEP: f64 = 1e-6;

/// Largest speed of a joint whose spec says none, rad/s or m/s.
const FAST: [f64; 2] = [std::f64::consts::PI, 1.0];

/// Part of the largest power that is rounding.
const ROUNDING: f64 = 1e-9;

/// States are looked at after so many steps over so many rad or m in all.
const STEPS: usize = 200;
const TRAVEL: f64 = 20.0;

/// Times that are looked at, s: what drifts is where it began and where it ends up.
const TIMES: [f64; 2] = [0.0, 1e6];

pub(super) fn check(compiled: &Compiled, values: &Values) -> Check {
    let workspace = workspace(compiled);
    let effects = Effects::new(compiled, values);
    let joints = &compiled.model.joints;
    let unit = |joint: usize| Units::of(joints[joint].kind).velocity;
    let fastest = fastest(compiled);
    let worst = |direction: &[f64]| {
        let poses = (0..POSES).map(|k| pose(&workspace, k));
        poses
            .flat_map(|pose| TIMES.map(|time| effects.gains(direction, &pose, time)))
            .flatten()
            .min_by(|x, y| x.share.total_cmp(&y.share))
    };
    let mut findings = Vec::new();
    for (joint, declared) in joints.iter().enumerate() {
        let mut alone = vec![0.0; joints.len()];
        alone[joint] = fastest[joint];
        if let Some(Gain { share, power }) = worst(&alone) {
            let (name, from) = (&declared.name, share * fastest[joint]);
            let said = format!(
                "effects of joint `{name}` add energy from {from:.3} {} on: up to {power:.3e} W, both directions together",
                unit(joint)
            );
            let own = [
                Quantity::of("driven_from", name, from, unit(joint)),
                Quantity::of("power", name, power, "W"),
            ];
            findings.push((said, own.to_vec()));
        }
    }
    // Joints that are no trouble alone may drive each other.
    if findings.is_empty() && joints.len() > 1 {
        let ways: Vec<(f64, f64)> = fastest.iter().map(|&speed| (-speed, speed)).collect();
        let together = (0..DIRECTIONS).map(|k| pose(&ways, k));
        let gain = together
            .filter_map(|direction| Some((worst(&direction)?, direction)))
            .max_by(|x, y| x.0.power.total_cmp(&y.0.power));
        if let Some((Gain { share, power }, direction)) = gain {
            let speeds: Vec<String> = direction
                .iter()
                .map(|speed| format!("{:.3}", share * speed))
                .collect();
            let said = format!(
                "effects add energy when joints move together at [{}]: up to {power:.3e} W, both directions together",
                speeds.join(", ")
            );
            let each = direction.iter().enumerate().map(|(joint, speed)| {
                let name = &joints[joint].name;
                Quantity::of("driven_from", name, share * speed, unit(joint))
            });
            let power = Quantity::of_all("power", power, "W");
            findings.push((said, each.chain([power]).collect()));
        }
    }
    let scope: Vec<String> = fastest
        .iter()
        .enumerate()
        .map(|(joint, speed)| format!("{speed:.3} {}", unit(joint)))
        .collect();
    let scope = format!("speeds up to {}", scope.join(", "));
    Check::new("friction", scope, findings)
}

/// Largest speed of each joint.
pub(super) fn fastest(compiled: &Compiled) -> Vec<f64> {
    let joints = compiled.model.joints.iter();
    let largest = joints.map(|joint| {
        let usual = match joint.kind {
            JointKind::Prismatic => FAST[1],
            JointKind::Revolute => FAST[0],
        };
        joint.limits.velocity.unwrap_or(usual)
    });
    largest.collect()
}

/// A share of the largest speeds from which on effects give energy, and the largest power that they give, W.
struct Gain {
    share: f64,
    power: f64,
}

/// Torques of the effects.
pub(super) struct Effects<'a> {
    torque: Program,
    gravity: Program,
    parts: Vec<StateProgram>,
    values: &'a Values,
}

impl<'a> Effects<'a> {
    pub(super) fn new(compiled: &Compiled, values: &'a Values) -> Self {
        Self {
            torque: compiled.effect_torque(),
            gravity: compiled.gravity(),
            parts: compiled.states(),
            values,
        }
    }

    /// By how much effects hold a joint that creeps alone, N m or N: half of what they change by where it turns round.
    pub(super) fn hold(&self, joint: usize, fastest: &[f64]) -> f64 {
        let torque = |way: f64| self.alone(joint, way * CREEP * fastest[joint], fastest.len());
        0.5 * (torque(1.0) - torque(-1.0))
    }

    /// Torque of the effects on a joint that moves alone, of so many.
    pub(super) fn alone(&self, joint: usize, speed: f64, joints: usize) -> f64 {
        let mut speeds = vec![0.0; joints];
        speeds[joint] = speed;
        self.torque(&speeds, &vec![0.0; joints], 0.0)[joint]
    }

    /// Where effects give energy along a direction, at a pose and a time.
    fn gains(&self, direction: &[f64], pose: &[f64], time: f64) -> Option<Gain> {
        let shares = (1..=SPEEDS).map(|k| k as f64 / SPEEDS as f64);
        let shares = std::iter::once(CREEP).chain(shares);
        let ways: Vec<(f64, [f64; 2])> = shares
            .map(|share| (share, self.work(share, direction, pose, time)))
            .collect();
        let work = ways.iter().flat_map(|(_, work)| work.iter());
        let size = work.fold(0.0_f64, |size, work| size.max(work.abs()));
        let gives = |lost: f64| lost < -ROUNDING * size;
        // The cheapest speeds so far.
        let mut cheapest = [f64::INFINITY; 2];
        let cheaper = |than: [f64; 2], work: [f64; 2]| [0, 1].map(|way| than[way].min(work[way]));
        let mut below = 0.0;
        let mut share = None;
        for &(next, work) in &ways {
            let [there, back] = cheaper(cheapest, work);
            if gives(there + back) {
                share = Some(next);
                break;
            }
            (cheapest, below) = ([there, back], next);
        }
        let mut share = share?;
        // Between two of the speeds.
        for _ in 0..BISECTIONS {
            let middle = f64::midpoint(below, share);
            let [there, back] = cheaper(cheapest, self.work(middle, direction, pose, time));
            if gives(there + back) {
                share = middle;
            } else {
                below = middle;
            }
        }
        let pairs = ways
            .iter()
            .flat_map(|there| ways.iter().map(move |back| (there, back)));
        let powers = pairs.map(|((v, there), (w, back))| {
            let lost = there[0] + back[1];
            if gives(lost) {
                -lost / (1.0 / v + 1.0 / w)
            } else {
                0.0
            }
        });
        Some(Gain {
            share,
            power: powers.fold(0.0, f64::max),
        })
    }

    /// Work of the effects there and back at a share of the largest speeds, J, over the way of a second at these.
    fn work(&self, share: f64, direction: &[f64], pose: &[f64], time: f64) -> [f64; 2] {
        [1.0, -1.0].map(|way| {
            let speeds: Vec<f64> = direction.iter().map(|speed| way * share * speed).collect();
            let torques = self.torque(&speeds, pose, time);
            let parts = torques.iter().zip(direction).map(|(f, speed)| f * speed);
            way * parts.sum::<f64>()
        })
    }

    /// Torque of the effects at constant speeds, states settled.
    fn torque(&self, speeds: &[f64], pose: &[f64], time: f64) -> Vec<f64> {
        let bind = |load: &[f64], memory: &[f64], symbol: Symbol| match symbol {
            Symbol::Q(k) => pose[k],
            Symbol::Dq(k) => speeds[k],
            Symbol::Parameter(k) => self.values.parameters[k],
            Symbol::Shape(k) => self.values.shapes[k],
            Symbol::RigidTorque(k) | Symbol::MeasuredTorque(k) => load[k],
            Symbol::State(k) => memory[k],
            Symbol::Time => time,
            _ => 0.0,
        };
        let load = vec![0.0; pose.len()];
        let load = self.gravity.eval(&|symbol| bind(&load, &[], symbol));
        let fastest = speeds
            .iter()
            .fold(f64::MIN_POSITIVE, |most, v| most.max(v.abs()));
        let interval = TRAVEL / (STEPS as f64 * fastest);
        let operand = |symbol: Symbol| Operand::Constant(bind(&load, &[], symbol));
        let memory = states(&self.parts, STEPS, interval, &operand);
        let memory: Vec<f64> = memory.iter().map(|z| z[STEPS - 1]).collect();
        self.torque.eval(&|symbol| bind(&load, &memory, symbol))
    }
}

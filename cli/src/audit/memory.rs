//! Whether friction with a memory takes energy where its states do not settle.
//!
//! Over and over a joint goes a way slowly and then as far fast, in one direction. At the slow speed bristles bend further than a fast one
//! holds them; what they give back on the fast way, times a damping that does not fall with speed, may be more than they took. For the
//! `LuGre` model that is so where `s2 < s1 (F_s - F_c) / F_c` (Barahanov, Ortega 2000), at some speed.

use robot_model_codegen::Compiled;
use robot_model_codegen::expr::Symbol;
use robot_model_codegen::interpreter::{Operand, Program};
use robot_model_codegen::states::StateProgram;

use super::friction::fastest;
use super::{Check, Quantity};
use crate::interpreted::states;
use crate::parameters::Values;
use crate::units::Units;

/// Fast speeds as shares of the largest one, and the slow speed as a share of the fast one: one to so many.
const SHARES: [f64; 6] = [0.05, 0.1, 0.2, 0.4, 0.7, 1.0];
const SLOWER: usize = 100;

/// Ways, rad or m: from the first one on by a factor.
const WAYS: usize = 12;
const FIRST_WAY: f64 = 1e-4;
const FURTHER: f64 = 3.0;

/// Samples of a fast way, and turns until states repeat.
const SAMPLES: usize = 12;
const TURNS: usize = 12;

/// States repeat where they change by less than this share of what they go through in a turn.
const REPEATS: f64 = 1e-3;

/// Part of the work that is the samples' error.
const ROUNDING: f64 = 1e-2;

/// `None` where no effect has a memory.
pub(super) fn check(compiled: &Compiled, values: &Values) -> Option<Check> {
    let joints = &compiled.model.joints;
    let remember = |joint: &usize| {
        let mut effects = compiled.model.effects.iter();
        effects.any(|effect| !effect.definition.states.is_empty() && effect.joints.contains(joint))
    };
    let with_memory: Vec<usize> = (0..joints.len()).filter(remember).collect();
    if with_memory.is_empty() {
        return None;
    }
    let turns = Turns {
        torque: compiled.effect_torque(),
        gravity: compiled.gravity(),
        parts: compiled.states(),
        values,
        dof: joints.len(),
    };
    let fastest = fastest(compiled);
    let findings = with_memory.iter().filter_map(|&joint| {
        let mut trials = SHARES.iter().flat_map(|share| {
            let mut way = FIRST_WAY;
            (0..WAYS).map(move |_| {
                let this = way;
                way *= FURTHER;
                (share, this)
            })
        });
        let (gain, speed, way) = trials.find_map(|(share, way)| {
            let speed = share * fastest[joint];
            Some((turns.gain(joint, speed, way)?, speed, way))
        })?;
        let Units {
            position: length,
            velocity: per,
            ..
        } = Units::of(joints[joint].kind);
        let name = &joints[joint].name;
        let said = format!(
            "effects with memory add energy to joint `{name}`: a cycle of {way:.2e} {length} at {:.3} {per} and back at {speed:.3} {per} \
             gains {gain:.2e} J",
            speed / SLOWER as f64
        );
        Some((said, vec![Quantity::of("work", name, gain, "J")]))
    });
    let findings = findings.collect();
    let scope = format!(
        "cycles of a slow and a fast stroke, up to {FIRST_WAY:.0e} .. {:.0e} rad or m each",
        FIRST_WAY * FURTHER.powi(11)
    );
    Some(Check::new("memory", scope, findings))
}

struct Turns<'a> {
    torque: Program,
    gravity: Program,
    parts: Vec<StateProgram>,
    values: &'a Values,
    dof: usize,
}

impl Turns<'_> {
    /// Energy that a turn gives, J, where its states repeat and it gives any.
    fn gain(&self, joint: usize, speed: f64, way: f64) -> Option<f64> {
        let interval = way / (SAMPLES as f64 * speed);
        let turn = SAMPLES * (SLOWER + 1);
        let samples = TURNS * turn + 1;
        let slow = speed / SLOWER as f64;
        let speeds = (0..samples).map(|k| {
            if k % turn < SAMPLES * SLOWER {
                slow
            } else {
                speed
            }
        });
        let speeds: Vec<f64> = speeds.collect();
        let at = |load: &[f64], symbol: Symbol| match symbol {
            Symbol::Parameter(k) => self.values.parameters[k],
            Symbol::Shape(k) => self.values.shapes[k],
            Symbol::RigidTorque(k) | Symbol::MeasuredTorque(k) => load[k],
            _ => 0.0,
        };
        let load = self
            .gravity
            .eval(&|symbol| at(&vec![0.0; self.dof], symbol));
        let bind = |symbol: Symbol| match symbol {
            Symbol::Dq(k) if k == joint => Operand::Column(&speeds),
            other => Operand::Constant(at(&load, other)),
        };
        let memory = states(&self.parts, samples, interval, &bind);
        let last = samples - 1 - turn..samples;
        let repeats = memory.iter().all(|z| {
            let (low, high) = z[last.clone()]
                .iter()
                .fold((f64::MAX, f64::MIN), |(low, high), z| {
                    (low.min(*z), high.max(*z))
                });
            (z[last.end - 1] - z[last.start]).abs() <= REPEATS * (high - low)
        });
        if !repeats {
            return None;
        }
        let mut torque = vec![Vec::new(); self.torque.outputs()];
        let with_memory = |symbol: Symbol| match symbol {
            Symbol::State(k) => Operand::Column(&memory[k]),
            other => bind(other),
        };
        self.torque.eval_batch(samples, &with_memory, &mut torque);
        let power = |k: usize| torque[joint][k] * speeds[k];
        let (mut work, mut size) = (0.0, 0.0);
        for k in last.start..last.end - 1 {
            work += 0.5 * interval * (power(k) + power(k + 1));
            size += 0.5 * interval * (power(k).abs() + power(k + 1).abs());
        }
        (work < -ROUNDING * size).then_some(-work)
    }
}

//! The friction law: what it says, what is claimed of it, and what it does at high speeds.

use std::f64::consts::TAU;

use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;
use robot_model::columns::Candidate;
use robot_model::log::Log;
use robot_model::trace::{Outcome, Trace};
use robot_model_codegen::Compiled;
use robot_model_codegen::base::shape_values;
use robot_model_codegen::expr::Symbol;

use super::plant::friction;
use super::truth::FRICTION;
use crate::paper::{Audited, Error, compiled, interpreted, normal};

/// One joint with the law as printed.
pub const PRINTED: &str = include_str!("law.robot");
/// One joint with the law that begins at rest.
pub const CONTINUOUS: &str = include_str!("continuous.robot");
/// What stands for the joint's effect in [`PRINTED`].
const DECLARED: &str = "rokae(eps = 0.01) on j;";

/// Standard parameter of a joint of one of these specs with the friction of joint `k` of the arm, whatever its effect is called.
fn value(name: &str, k: usize) -> f64 {
    let end = name.rsplit('.').next().unwrap_or_default();
    let mut rows = FRICTION.by_name().into_iter().chain([("izz", [1.0; 6])]);
    let row = rows.find(|(name, _)| *name == end);
    row.map_or(0.0, |(_, row)| row[k])
}

/// Base parameters of such a joint.
fn values(compiled: &Compiled, k: usize) -> Vec<f64> {
    let standard = compiled.standard.iter();
    let standard: Vec<f64> = standard.map(|p| value(&p.name, k)).collect();
    compiled.base.beta(&standard)
}

/// Friction of joint `k` at a speed, N m, as the compiler has the law of a spec.
///
/// # Errors
/// What the language says of the spec.
pub fn compiled_friction(spec: &str, k: usize) -> Result<impl Fn(f64) -> f64, Error> {
    let compiled = compiled("law.robot", spec)?;
    let (program, shapes) = (compiled.effect_torque(), shape_values(&compiled.model));
    let parameters = compiled.parameter_values(&values(&compiled, k));
    Ok(move |v: f64| {
        program.eval(&|symbol| match symbol {
            Symbol::Dq(_) => v,
            Symbol::Parameter(k) => parameters[k],
            Symbol::Shape(k) => shapes[k],
            _ => 0.0,
        })[0]
    })
}

/// Speeds at which laws are compared, to both sides and at rest, rad/s.
pub fn speeds() -> impl Iterator<Item = f64> + Clone {
    (-5003_i32..=5003).map(|step| 1e-3 * f64::from(step))
}

/// Largest difference of the compiled law from the printed one, N m, over all joints and [`speeds`].
///
/// # Errors
/// Those of [`compiled_friction`].
pub fn difference() -> Result<f64, Error> {
    let mut most: f64 = 0.0;
    for k in 0..6 {
        let law = compiled_friction(PRINTED, k)?;
        for v in speeds() {
            most = most.max((law(v) - friction(k, v)).abs());
        }
    }
    Ok(most)
}

/// Speeds from which on the friction of a joint does otherwise, rad/s, by a scan of the compiled law in steps of 1 mrad/s.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Speeds {
    /// From which it falls, forward and backward.
    pub falls: [f64; 2],
    /// The same of the mean of both directions.
    pub falls_in_mean: f64,
    /// From which it drives, forward and backward.
    pub drives: [f64; 2],
}

/// Those of a joint.
///
/// # Errors
/// Those of [`compiled_friction`].
pub fn scanned(k: usize) -> Result<Speeds, Error> {
    let law = compiled_friction(PRINTED, k)?;
    // Against the motion, forward and backward.
    let braking = |v: f64| [law(v), -law(-v)];
    let speeds = || (20..6000_i32).map(|step| 1e-3 * f64::from(step));
    let peak = |of: &dyn Fn(f64) -> f64| {
        let most = speeds().max_by(|x, y| of(*x).total_cmp(&of(*y)));
        most.unwrap_or_default()
    };
    let drives = |way: usize| speeds().find(|v| braking(*v)[way] < 0.0);
    Ok(Speeds {
        falls: [0, 1].map(|way: usize| peak(&|v| braking(v)[way])),
        falls_in_mean: peak(&|v| braking(v).iter().sum()),
        drives: [0, 1].map(|way| drives(way).unwrap_or(f64::INFINITY)),
    })
}

/// By how much `audit` finds the friction of joint `k` to jump, N m, and at what speed, rad/s; nothing where it finds no jump.
///
/// # Errors
/// What the language says of the spec, or `audit` of the values.
pub fn jump(spec: &str, k: usize) -> Result<Option<[f64; 2]>, Error> {
    let compiled = compiled("law.robot", spec)?;
    let standard = compiled.standard.iter();
    let values = standard.map(|p| (p.name.clone(), value(&p.name, k)));
    let audited = Audited::of(&compiled, &values.collect())?;
    let quantity = |what| audited.check("jumps")?.quantity(what, Some("j"));
    Ok(quantity("jump")
        .zip(quantity("at"))
        .map(|(by, at)| [by, at]))
}

/// Whether the friction of a spec with one joint reads where the joint is.
///
/// # Errors
/// What the language says of the spec.
pub fn reads_position(spec: &str) -> Result<bool, Error> {
    let compiled = compiled("law.robot", spec)?;
    let symbols = compiled.dag.symbols(&compiled.dynamics.effect_torque);
    Ok(symbols.contains(&Symbol::Q(0)))
}

/// The printed law beside other effects.
#[must_use]
pub fn beside(effects: &str) -> String {
    PRINTED.replace(DECLARED, &format!("{DECLARED} {effects}"))
}

/// What a joint's friction has beside the printed law, which is claimed to have it, too.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Besides {
    /// It falls at low speeds.
    Falls,
    /// It depends on the position.
    Position,
}

/// Rise of friction at low speeds, N m, and the speed within which it is gone, rad/s.
const RISE: f64 = 3.0;
const FALL: f64 = 0.1;

/// Size of the friction that depends on the position, N m, and its periods a turn.
const WAVE: f64 = 2.0;
const PERIODS: f64 = 12.0;

impl Besides {
    /// The standard effect of that kind.
    #[must_use]
    pub fn effect(self) -> &'static str {
        match self {
            Self::Falls => "stribeck",
            Self::Position => "position_dependent_friction",
        }
    }

    fn torque(self, q: f64, v: f64) -> f64 {
        match self {
            Self::Falls => RISE * (-(v / FALL).powi(2)).exp() * v.signum(),
            Self::Position => WAVE * (PERIODS * q).cos() * v.signum(),
        }
    }

    /// Names of what the tracer finds on a joint that has this, by the printed law alone and by one with its effect beside; none where
    /// nothing is missing.
    ///
    /// # Errors
    /// Those of the libraries.
    pub fn missing(self) -> Result<[Vec<String>; 2], Error> {
        let log = self.log()?;
        let declared = beside(&format!("{} on j;", self.effect()));
        Ok([missing(PRINTED, &log)?, missing(&declared, &log)?])
    }

    /// Half a minute of joint 3 in slow and fast waves.
    fn log(self) -> Result<Log, Error> {
        const JOINT: usize = 2;
        let mut random = ChaCha8Rng::seed_from_u64(5);
        let waves = [(0.5, 0.07), (0.25, 0.19), (0.08, 0.53)];
        let wave = |t: f64, order: i32| -> f64 {
            let turn = f64::from(order) * TAU / 4.0;
            let terms = waves.map(|(size, hz)| {
                let w = TAU * hz;
                size * w.powi(order) * (w * t + turn).sin()
            });
            terms.iter().sum()
        };
        let time: Vec<f64> = (0..6000).map(|k| 5e-3 * f64::from(k)).collect();
        let q = time.iter().map(|&t| wave(t, 0)).collect();
        let torque = |t: f64, noise: f64| {
            let (q, v, dv) = (wave(t, 0), wave(t, 1), wave(t, 2));
            dv + friction(JOINT, v) + self.torque(q, v) + 0.1 * noise
        };
        let tau = time.iter().map(|&t| torque(t, normal(&mut random)));
        let tau = tau.collect();
        Ok(Log::from_samples("a joint", time, vec![q], vec![tau])?)
    }
}

fn missing(spec: &str, log: &Log) -> Result<Vec<String>, Error> {
    let arm = interpreted("law.robot", spec)?;
    let candidates = arm.candidates();
    let candidates = candidates.iter().map(|one| one as &dyn Candidate).collect();
    let log = std::slice::from_ref(log);
    let verdict = Trace::new(candidates).run(&arm, log, &mut |_| ())?;
    if verdict.outcome == Outcome::Unexplained {
        return Ok(vec!["unexplained".to_owned()]);
    }
    let findings = verdict.findings.into_iter();
    Ok(findings.map(|finding| finding.effect).collect())
}

/// The simulated arm's friction of a joint over its speed, for a figure.
#[must_use]
pub fn curve(k: usize) -> Vec<(f64, f64)> {
    let steps = -190_i32..=190;
    steps
        .map(|step| 0.01 * f64::from(step))
        .map(|v| (v, friction(k, v)))
        .collect()
}

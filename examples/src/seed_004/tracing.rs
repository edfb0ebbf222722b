//! Figures 5 and 7: what is left of the torque with friction and without, as the tracer sees it.

use robot_model::log::Log;
use robot_model::trace::{Outcome, TermShare, Trace, Verdict};

use super::audit::audited;
use super::device::{self, SPEC};
use super::fits::{self, Halves, STIFF};
use super::plant::{Plant, Stribeck, Three};
use super::rig;
use super::sensors::samples;
use super::sines::Sines;
use super::truth::{Pi, table_1};
use crate::paper::{Error, both, in_threads};

/// What the tracer says of the device.
#[derive(Debug, Clone)]
pub struct Traces {
    /// UR by the model without friction.
    pub without_friction: Verdict,
    /// UR by the whole model.
    pub with_friction: Verdict,
    /// A device with friction that falls with speed, by the whole model.
    pub falling: Verdict,
    /// The same where viscous coefficients that came out below zero are held at zero, which is a model without them.
    pub falling_held: Verdict,
    /// Viscous coefficients that the whole model has for it, N m s/rad.
    pub falling_viscous: [f64; 3],
    /// How many of the parameters of that fit `signs` of the audit finds below zero.
    pub falling_signs: usize,
    /// RMS% of (15) on the other half, of a fit without rows at turns as those of the installations.
    pub falling_rms: Three,
    /// The true ones.
    pub true_viscous: [f64; 3],
    /// UR by equation (4) as a spec: as printed, and with the sign put right.
    pub equation_4: [Verdict; 2],
}

/// Equation (4) as it is printed, and the term whose sign is wrong.
const EQUATION_4: &str = include_str!("phantom_printed.robot");
const WRONG: [&str; 2] = ["+ dq(j)^2*c23/2", "- dq(j)^2*c23/2"];

/// How much faster than for identification joints move, so that squares of their velocities count beside friction.
pub(super) const FASTER: f64 = 4.0;

/// Viscous friction, positive.
const VISCOUS: [f64; 3] = [0.4e-3, 0.3e-3, 0.3e-3];

/// What there is at rest beyond dry friction, as a part of that, and the speed beyond which it is gone, rad/s.
pub(super) const FALLING: [f64; 2] = [1.5, 0.3];

/// Traces.
///
/// # Errors
/// Those of the plant and of the tracer.
pub fn all(upright: &Log, motion: &Sines) -> Result<Traces, Error> {
    let [part, speed] = FALLING;
    let (bare, upright) = (device::without_friction(), first(upright)?);
    let pair = || in_threads(&[&*bare, SPEC], |text| trace(text, &upright));
    let others = || both(|| falling(motion, part, speed), || equation_4(motion));
    let (pair, (falling, equation_4)) = both(pair, others)?;
    let [without_friction, with_friction] = two(pair);
    Ok(Traces {
        without_friction,
        with_friction,
        falling_viscous: [8, 9, 10].map(|k| falling.fitted[k]),
        falling_signs: audited(SPEC, &falling.fitted)?.findings("signs").len(),
        falling_rms: falling.rms,
        falling: falling.verdict,
        falling_held: falling.held,
        true_viscous: VISCOUS,
        equation_4,
    })
}

/// Both results of two jobs.
fn two<T>(all: Vec<T>) -> [T; 2] {
    let all: Result<[T; 2], _> = all.try_into();
    all.unwrap_or_else(|_| unreachable!("two jobs have two results"))
}

/// UR with positive viscous friction, as that of table 1 drives.
fn equation_4(motion: &Sines) -> Result<[Verdict; 2], Error> {
    let mut pi = table_1(0);
    pi[8..11].copy_from_slice(&VISCOUS);
    let motion = motion.clone().at_pace(FASTER);
    let plant = Plant::new(pi, motion.at(0.0)[0]);
    let [dropped, ..] = fits::SECONDS;
    let record = rig::run(plant, &motion, &STIFF, dropped + TRACED, 62)?;
    let log = record.log("fast", dropped, dropped + TRACED)?;
    let [wrong, right] = WRONG;
    let mended = EQUATION_4.replace(wrong, right);
    let texts = [EQUATION_4, &mended];
    Ok(two(in_threads(&texts, |text| trace(text, &log))?))
}

/// A device with friction that falls with speed.
#[derive(Debug, Clone)]
pub struct Falling {
    /// What the tracer says of it by the whole model.
    pub verdict: Verdict,
    /// The same where viscous coefficients below zero are held at zero.
    pub held: Verdict,
    /// The whole model's parameters.
    pub fitted: Pi,
    /// RMS% of (15) on the other half, of a fit without rows at turns.
    pub rms: Three,
}

/// UR with positive viscous friction, and with a part of dry friction that is gone beyond a speed.
///
/// # Errors
/// Those of the plant and of the tracer.
pub fn falling(motion: &Sines, part: f64, speed: f64) -> Result<Falling, Error> {
    let mut pi = table_1(0);
    pi[8..11].copy_from_slice(&VISCOUS);
    let stribeck = [0, 1, 2].map(|j| Stribeck {
        fs: part * pi[11 + j],
        vs: speed,
    });
    let plant = Plant::new(pi, motion.at(0.0)[0]).with_stribeck(stribeck);
    let record = rig::run(plant, motion, &STIFF, fits::SECONDS.iter().sum(), 61)?;
    let Halves { train, validate } = Halves::of(&record)?;
    let model = device::momentum(SPEC)?;
    let fit = fits::fit_with_turns(&model, &train)?;
    let fitted = device::values(&fit);
    let held = device::without_viscous([8, 9, 10].map(|k| fitted[k] < 0.0));
    let [verdict, held] = two(in_threads(&[SPEC, &held], |text| trace(text, &train))?);
    Ok(Falling {
        verdict,
        held,
        fitted,
        rms: fits::rms(&fits::fit(&model, &train)?, &model, &validate)?,
    })
}

/// Seconds of a log that are traced where they tell enough; friction that falls with speed takes all of it.
const TRACED: f64 = 20.0;

/// The first of them.
fn first(log: &Log) -> Result<Log, Error> {
    let count = samples(TRACED).min(log.time.len());
    let part = |all: &[Vec<f64>]| all.iter().map(|x| x[..count].to_vec()).collect();
    let time = log.time[..count].to_vec();
    Ok(Log::from_samples(
        "traced",
        time,
        part(&log.q),
        part(&log.tau),
    )?)
}

fn trace(text: &str, log: &Log) -> Result<Verdict, Error> {
    let arm = device::arm(text)?;
    let undeclared = arm.undeclared();
    let trace = Trace::new(undeclared.candidates());
    Ok(trace.run(&arm, std::slice::from_ref(log), &mut |_| ())?)
}

/// The term of the equations that says most of what is left of a joint, from 0, where nothing else is said to be missing.
#[must_use]
pub fn term(verdict: &Verdict) -> Option<(usize, &TermShare)> {
    let [only] = verdict.left.as_slice() else {
        return None;
    };
    let is_alone = verdict.findings.is_empty() && verdict.outcome == Outcome::Unexplained;
    is_alone.then_some((only.joint, only.terms.first()?))
}

/// Findings of a verdict as `effect on 1, 2`, with their largest p-value.
#[must_use]
pub fn said(verdict: &Verdict) -> String {
    let all = verdict.findings.iter().chain(&verdict.leads);
    let names: Vec<String> = all
        .map(|one| {
            let joints: Vec<String> = one.joints.iter().map(|j| (j + 1).to_string()).collect();
            format!("{} on {}", one.kind, joints.join(" and "))
        })
        .collect();
    if names.is_empty() {
        verdict.outcome.to_string()
    } else {
        format!("{}: {}", verdict.outcome, names.join(", "))
    }
}

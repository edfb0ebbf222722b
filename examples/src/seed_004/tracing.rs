//! Figures 5 and 7: what is left of the torque with friction and without, as the tracer sees it.

use robot_model::identify::Identify;
use robot_model::log::Log;
use robot_model::trace::{Trace, Verdict};

use super::device::{self, SPEC};
use super::fits::{self, STIFF};
use super::plant::{Plant, Stribeck};
use super::rig::{self, Sines};
use super::truth::{CORNER, table_1};
use crate::paper::Error;

/// What the tracer says of the device.
#[derive(Debug, Clone)]
pub struct Traces {
    /// UR by the model without friction.
    pub without_friction: Verdict,
    /// UR by the whole model.
    pub with_friction: Verdict,
    /// A device with friction that falls with speed, by the whole model.
    pub falling: Verdict,
    /// Viscous coefficients that the whole model has for it, N m s/rad.
    pub falling_viscous: [f64; 3],
    /// The true ones.
    pub true_viscous: [f64; 3],
}

/// Viscous friction, positive.
const VISCOUS: [f64; 3] = [0.4e-3, 0.3e-3, 0.3e-3];

/// Part of dry friction which is gone beyond a speed, and that speed, rad/s.
const FALLING: [f64; 2] = [1.0, 0.3];

/// Traces.
///
/// # Errors
/// Those of the plant and of the tracer.
pub fn all(upright: &Log, motion: &Sines) -> Result<Traces, Error> {
    let [part, speed] = FALLING;
    let (falling, falling_viscous) = falling(motion, part, speed)?;
    Ok(Traces {
        without_friction: trace(&device::without_friction(), upright)?,
        with_friction: trace(SPEC, upright)?,
        falling,
        falling_viscous,
        true_viscous: VISCOUS,
    })
}

/// The device with friction that falls with speed: what the tracer says, and its viscous coefficients by the whole model.
///
/// # Errors
/// Those of the plant and of the tracer.
pub fn falling(motion: &Sines, part: f64, speed: f64) -> Result<(Verdict, [f64; 3]), Error> {
    let mut pi = table_1(0);
    pi[8..11].copy_from_slice(&VISCOUS);
    let stribeck = [0, 1, 2].map(|j| Stribeck {
        fs: part * pi[11 + j],
        vs: speed,
    });
    let plant = Plant::new(pi, motion.at(0.0)[0]).with_stribeck(stribeck);
    let [dropped, seconds, _] = fits::SECONDS;
    let record = rig::run(plant, motion, &STIFF, dropped + seconds, 61)?;
    let log = record.log("falling", dropped, dropped + seconds)?;
    let model = device::momentum(SPEC)?;
    let logs = std::slice::from_ref(&log);
    let fit = Identify::default().fit_filtered(&model, logs, Some(CORNER))?;
    let values = device::values(&fit);
    Ok((trace(SPEC, &log)?, [values[8], values[9], values[10]]))
}

fn trace(text: &str, log: &Log) -> Result<Verdict, Error> {
    let arm = device::arm(text)?;
    let undeclared = arm.undeclared();
    let trace = Trace::new(undeclared.candidates());
    Ok(trace.run(&arm, std::slice::from_ref(log), &mut |_| ())?)
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

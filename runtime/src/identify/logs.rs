//! Logs before rows are made of them: whether they are of the arm, the bands that they bear, the load along them.

use super::IdentifyError;
use crate::columns::Arm;
use crate::log::Log;
use crate::motion::Motion;
use crate::signal::{Bands, Prepared, prepare};

/// Bands that every one of the logs can bear.
pub(crate) fn slowest_bands(logs: &[Log]) -> Bands {
    Bands::for_rate(logs.iter().map(Log::rate_hz).fold(f64::INFINITY, f64::min))
}

/// The torque of the rigid body at an estimate, for the effects that depend on it.
pub(super) fn update_load(arm: &dyn Arm, logs: &mut [Prepared], shapes: &[f64], estimate: &[f64]) {
    for log in logs {
        load_motion(arm, &mut log.motion, shapes, estimate);
    }
}

/// What effects read of the load along a motion.
pub(crate) fn load_motion(arm: &dyn Arm, motion: &mut Motion, shapes: &[f64], estimate: &[f64]) {
    motion.rigid_torque = arm.rigid_torque(motion, shapes, estimate);
    motion.transmitted_torque = arm.transmitted_torque(motion, shapes, estimate);
}

pub(crate) fn prepare_all(logs: &[Log], bands: &Bands) -> Result<Vec<Prepared>, IdentifyError> {
    logs.iter()
        .map(|log| prepare(log, bands).map_err(IdentifyError::from))
        .collect()
}

pub(crate) fn check_logs(arm: &dyn Arm, logs: &[Log]) -> Result<(), IdentifyError> {
    if logs.is_empty() {
        return Err(IdentifyError::NoLog);
    }
    for log in logs {
        if log.dof() != arm.dof() {
            return Err(IdentifyError::Joints {
                source_name: log.source.clone(),
                log: log.dof(),
                arm: arm.dof(),
            });
        }
        let speeds = log.turn_speeds.len();
        if speeds != 0 && speeds != arm.dof() {
            return Err(IdentifyError::TurnSpeeds {
                source_name: log.source.clone(),
                found: speeds,
                arm: arm.dof(),
            });
        }
        if let Some(channel) = missing_input(arm.inputs(), log) {
            return Err(IdentifyError::NoChannel {
                source_name: log.source.clone(),
                channel: channel.to_owned(),
            });
        }
    }
    Ok(())
}

/// The first channel that columns read and a log does not have.
pub(crate) fn missing_input<'a>(inputs: &'a [String], log: &Log) -> Option<&'a str> {
    let is_there = |name: &String| log.extra.iter().any(|channel| channel.name == *name);
    inputs
        .iter()
        .find(|name| !is_there(name))
        .map(String::as_str)
}

/// A log through filters, or through narrower ones that it can bear.
pub(super) fn prepare_at_own_rate(
    arm: &dyn Arm,
    log: &Log,
    bands: Bands,
) -> Result<Prepared, IdentifyError> {
    check_logs(arm, std::slice::from_ref(log))?;
    Ok(prepare(log, &bands.at_rate(log.rate_hz()))?)
}

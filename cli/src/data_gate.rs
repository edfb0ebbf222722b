//! The data gate: what is wrong with logs, before anything may be wrong with the model.
//!
//! Spikes, bursts, dropouts and held values are not the arm's, and torque that comes late is the recorder's. Logs are mended of both before
//! their residual is traced, and both are told. Logs with the position of one joint late are not traced.

use robot_model::identify::{Delay, Estimate, Identify, IdentifyError};
use robot_model::log::{Fault, LateChannel, Log, Mended};

use crate::interpreted::InterpretedArm;
use crate::output::significant;
use crate::progress::Progress;

/// Bad samples count from this share of a joint's raw error, as effects do.
const LEAST_SHARE: f64 = 0.05;

/// Joints have one delay where they differ by no more deviations, or by no more of it.
const DEVIATIONS: f64 = 4.0;
const APART: f64 = 0.1;

/// A late position is the cause where this share of its joint's error goes with it.
const LEAST_OF_LATE: f64 = 0.5;

/// A fault of the logs that matters.
#[derive(Debug, Clone, PartialEq)]
pub struct DataFault {
    /// Kebab-case name, as effects have.
    pub kind: &'static str,
    /// Joints whose channel has it, from 0; none where that is all of them.
    pub joints: Vec<usize>,
    /// What was found, for people.
    pub told: String,
    /// Seconds by which torque or a joint's position is late and their standard deviation, of a `time-delay`.
    pub delay: Option<(f64, f64)>,
    /// Whether nothing can be asked of logs that have it.
    pub is_last: bool,
}

impl DataFault {
    /// Whether torques went through a filter which positions did not go through.
    pub(crate) fn is_smoothed(&self) -> bool {
        self.is_last && self.delay.is_none()
    }
}

/// Logs without spikes, bursts, dropouts and held values; what was found is said.
pub(crate) fn mend(logs: &[Log], progress: &Progress) -> Vec<Mended> {
    let mended = logs.iter().map(|log| log.clone().mended());
    let mended: Vec<Mended> = mended.collect();
    for one in &mended {
        for fault in one.faults.iter().filter(|fault| !fault.is_in_report()) {
            progress.note(&format!("note: {}: {fault}", one.log.source));
        }
    }
    mended
}

/// Bad samples that change the error of the declared model by as much as an effect that matters.
///
/// # Errors
/// Those of [`Estimate::errors`].
pub(crate) fn corrupt(
    arm: &InterpretedArm,
    estimate: &Estimate,
    logged: &[Log],
    mended: &[Mended],
) -> Result<Option<DataFault>, IdentifyError> {
    let mut told = Vec::new();
    for (log, mended) in logged.iter().zip(mended) {
        let is_sample = |fault: &&Fault| {
            matches!(
                fault,
                Fault::Spikes { .. }
                    | Fault::Held { .. }
                    | Fault::Dropouts { .. }
                    | Fault::Bursts { .. }
                    | Fault::Slips { .. }
            )
        };
        let faults: Vec<&Fault> = mended.faults.iter().filter(is_sample).collect();
        if faults.is_empty() {
            continue;
        }
        // Torques at a limit are out of both.
        let mut logged = log.clone();
        logged.clipped.clone_from(&mended.log.clipped);
        let with = estimate.errors(arm, &logged)?.rmse;
        let without = estimate.errors(arm, &mended.log)?.rmse;
        let mut joints = with.iter().zip(&without);
        if joints.any(|(with, without)| *without < (1.0 - LEAST_SHARE) * with) {
            told.extend(
                faults
                    .iter()
                    .map(|fault| format!("{}: {fault}", log.source)),
            );
        }
    }
    Ok((!told.is_empty()).then(|| DataFault {
        kind: "corrupt-samples",
        joints: Vec::new(),
        told: told.join("; "),
        delay: None,
        is_last: false,
    }))
}

/// Torques of a log that went through a low-pass which its positions did not go through: what they say of turns is the filter's, and no
/// law is told by them.
///
/// # Errors
/// Those of [`Estimate::predict`].
pub(crate) fn smoothed(
    arm: &InterpretedArm,
    estimate: &Estimate,
    logs: &[Log],
) -> Result<Option<DataFault>, IdentifyError> {
    let mut told = Vec::new();
    for log in logs {
        if let Some(filter) = estimate.smoothed(arm, log)? {
            let (hz, percent) = (significant(filter.cutoff_hz, 2), 100.0 * filter.share);
            let phase = if filter.lags {
                "that lags"
            } else {
                "without phase"
            };
            told.push(format!(
                "{}: torques, but not positions, were low-pass filtered at about {hz} Hz {phase}: the same filter on the model's torque \
                 reduces its error by {percent:.0} %; log raw torques, or use a wider filter",
                log.source
            ));
        }
    }
    Ok((!told.is_empty()).then(|| DataFault {
        kind: "corrupt-samples",
        joints: Vec::new(),
        told: told.join("; "),
        delay: None,
        is_last: true,
    }))
}

/// The position of one joint that is late against all else: no spec declares that, and all that moves with it is wrong. Where that leaves
/// most of the joint's error it is something else, as a gap or a spring, which only looks late: then it is noted, and logs are traced.
pub(crate) fn late_position(estimate: &Estimate, progress: &Progress) -> Option<DataFault> {
    let mut delays = estimate.delays.iter();
    let found = delays.find(|delay| delay.channel == LateChannel::Position)?;
    let (ms, std) = (1e3 * found.seconds, 1e3 * found.std);
    let (joint, percent) = (&estimate.joints[found.joint], 100.0 * found.gain);
    if found.gain < LEAST_OF_LATE {
        progress.note(&format!(
            "note: the position of {joint} appears late by {ms:.2} +- {std:.2} ms, but correcting that reduces its error by only \
             {percent:.0} %, so it is not taken for the cause"
        ));
        return None;
    }
    Some(DataFault {
        kind: "time-delay",
        joints: vec![found.joint],
        told: format!(
            "the position of {joint} is late against all other channels by {ms:.2} +- {std:.2} ms; correcting that reduces its error by \
             {percent:.0} %: shift its column in the log by that time",
        ),
        delay: Some((found.seconds, found.std)),
        is_last: true,
    })
}

/// One delay of all torques, where the joints that tell theirs agree and no joint is worse off without it. With it the logs as they
/// would be without. What is left beside a delay that the spec declares is no second one.
pub(crate) fn delay(
    arm: &InterpretedArm,
    estimate: &Estimate,
    logs: &[Log],
) -> Option<(DataFault, Vec<Log>)> {
    if arm.compiled().delay().is_some() {
        return None;
    }
    let is_torque = |delay: &&Delay| delay.channel == LateChannel::Torque;
    let told: Vec<Delay> = estimate.delays.iter().filter(is_torque).copied().collect();
    let weights: f64 = told.iter().map(|joint| joint.std.powi(-2)).sum();
    if told.is_empty() || !weights.is_finite() {
        return None;
    }
    let sum: f64 = told.iter().map(|j| j.seconds * j.std.powi(-2)).sum();
    let (seconds, std) = (sum / weights, weights.powf(-0.5));
    let agrees =
        |own: f64, std: f64| (own - seconds).abs() <= (DEVIATIONS * std).max(APART * seconds.abs());
    if !told.iter().all(|joint| agrees(joint.seconds, joint.std)) {
        return None;
    }
    let on_time: Vec<Log> = logs.iter().map(|log| earlier(log, seconds)).collect();
    let same_band = Identify {
        bands: Some(estimate.bands),
        at_turns: estimate.at_turns(),
        ..Identify::default()
    };
    let after = same_band.fit(arm, &on_time).ok()?;
    let mut errors = after
        .relative_percent
        .iter()
        .zip(&estimate.relative_percent);
    if errors.any(|(after, before)| *after > (1.0 + LEAST_SHARE) * before) {
        return None;
    }
    let joints = told.iter().map(|joint| {
        let (ms, std) = (1e3 * joint.seconds, 1e3 * joint.std);
        format!("{ms:.2} +- {std:.2} ms on {}", estimate.joints[joint.joint])
    });
    let joints: Vec<String> = joints.collect();
    let fault = DataFault {
        kind: "time-delay",
        joints: Vec::new(),
        told: format!("torque is late against position: {}", joints.join(", ")),
        delay: Some((seconds, std)),
        is_last: false,
    };
    Some((fault, on_time))
}

/// A log whose torques are `seconds` earlier; after the last sample they are held.
fn earlier(log: &Log, seconds: f64) -> Log {
    let mut log = log.clone();
    let start = log.time[0];
    let last = log.time[log.time.len() - 1];
    let at: Vec<f64> = log
        .time
        .iter()
        .map(|time| (time + seconds).clamp(start, last))
        .collect();
    for tau in &mut log.tau {
        *tau = robot_model::signal::resample::cubic(&log.time, tau, &at);
    }
    for span in log.clipped.iter_mut().flatten() {
        *span = span.start - seconds..span.end - seconds;
    }
    log
}

//! Faults of logs as JSON has them: what is said, and the numbers in it.

use robot_model::identify::Estimate;
use robot_model::log::{Fault, Stretches};
use serde::Serialize;

use super::IdentifyArguments;
use crate::progress::Progress;

/// What a sensor or a recorder did.
#[derive(Serialize)]
pub(crate) struct FaultReport<'a> {
    log: &'a str,
    kind: &'static str,
    channel: &'a str,
    says: String,
    #[serde(flatten)]
    numbers: Numbers,
}

/// Those that a kind of faults has.
#[derive(Serialize, Default)]
struct Numbers {
    /// How often.
    #[serde(skip_serializing_if = "Option::is_none")]
    times: Option<usize>,
    /// How many samples.
    #[serde(skip_serializing_if = "Option::is_none")]
    samples: Option<usize>,
    /// Time of the first, s.
    #[serde(skip_serializing_if = "Option::is_none")]
    first: Option<f64>,
    /// The longest, s.
    #[serde(skip_serializing_if = "Option::is_none")]
    longest: Option<f64>,
    /// The largest jump of a position, rad or m.
    #[serde(skip_serializing_if = "Option::is_none")]
    largest: Option<f64>,
    /// At which a torque stands, N m or N.
    #[serde(skip_serializing_if = "Option::is_none")]
    value: Option<f64>,
    /// By how much a position that stands still differs from its mean, rad or m.
    #[serde(skip_serializing_if = "Option::is_none")]
    rms: Option<f64>,
    /// Of the samples.
    #[serde(skip_serializing_if = "Option::is_none")]
    share: Option<f64>,
    /// By how much a channel is late, s; below zero where it is early.
    #[serde(skip_serializing_if = "Option::is_none")]
    delay: Option<Measured>,
    /// Logged over computed.
    #[serde(skip_serializing_if = "Option::is_none")]
    factor: Option<f64>,
    /// Median step of time, s, and how far others are from it.
    #[serde(skip_serializing_if = "Option::is_none")]
    step: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    jitter_rms: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    jitter_max: Option<f64>,
}

#[derive(Serialize)]
struct Measured {
    value: f64,
    /// Where it is known.
    #[serde(skip_serializing_if = "Option::is_none")]
    std: Option<f64>,
}

impl Numbers {
    fn of(fault: &Fault) -> Self {
        let none = Self::default();
        match *fault {
            Fault::Spikes { samples, first, .. } | Fault::Coincident { samples, first } => Self {
                samples: Some(samples),
                first: Some(first),
                ..none
            },
            Fault::Held { at, .. }
            | Fault::Dropouts { at, .. }
            | Fault::Bursts { at, .. }
            | Fault::Gaps { at } => Self::of_stretches(at),
            Fault::Wrapped { times, first, .. } => Self {
                times: Some(times),
                first: Some(first),
                ..none
            },
            Fault::Slips {
                times,
                first,
                largest,
                ..
            } => Self {
                times: Some(times),
                first: Some(first),
                largest: Some(largest),
                ..none
            },
            Fault::Clipped { value, share, .. } => Self {
                value: Some(value),
                share: Some(share),
                ..none
            },
            Fault::VelocityLate { delay, .. } => Self {
                delay: Some(Measured {
                    value: delay,
                    std: None,
                }),
                ..none
            },
            Fault::Late { delay, std, .. } => Self {
                delay: Some(Measured {
                    value: delay,
                    std: Some(std),
                }),
                ..none
            },
            Fault::VelocityScale { factor, .. } => Self {
                factor: Some(factor),
                ..none
            },
            Fault::Constant { value, .. } => Self {
                value: Some(value),
                ..none
            },
            Fault::AtRest { rms, .. } => Self {
                rms: Some(rms),
                ..none
            },
            Fault::Jitter { step, rms, largest } => Self {
                step: Some(step),
                jitter_rms: Some(rms),
                jitter_max: Some(largest),
                ..none
            },
            // A joint that stands has no number.
            _ => none,
        }
    }

    fn of_stretches(at: Stretches) -> Self {
        Self {
            times: Some(at.times),
            samples: Some(at.samples),
            first: Some(at.first),
            longest: Some(at.longest),
            ..Self::default()
        }
    }
}

/// Channels that are not of the time of the others.
pub(super) fn late(estimate: &Estimate) -> Vec<Fault> {
    let late = estimate.delays.iter().map(|found| Fault::Late {
        late: found.channel,
        channel: found.channel.column(found.joint),
        joint: estimate.joints[found.joint].clone(),
        delay: found.seconds,
        std: found.std,
        gain: found.gain,
    });
    late.collect()
}

/// Faults with the logs that they are of.
pub(crate) fn fault_reports(faults: &[(String, Fault)]) -> Vec<FaultReport<'_>> {
    let told = faults.iter().map(|(log, fault)| FaultReport {
        log,
        kind: fault.kind(),
        channel: fault.channel(),
        says: fault.to_string(),
        numbers: Numbers::of(fault),
    });
    told.collect()
}
impl IdentifyArguments {
    /// Channels that are not of the time of the others; told of all logs at once.
    pub(super) fn late_channels(
        &self,
        estimate: &Estimate,
        progress: &Progress,
    ) -> Vec<(String, Fault)> {
        let logs: Vec<String> = self
            .logs
            .iter()
            .map(|path| path.display().to_string())
            .collect();
        let logs = logs.join(", ");
        let faults = late(estimate).into_iter();
        let told = faults.map(|fault| {
            progress.note(&format!("note: {logs}: {fault}"));
            (logs.clone(), fault)
        });
        told.collect()
    }
}

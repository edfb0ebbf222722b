//! `identify --payload --payload-mass`: gains of the drives.

use std::fmt::Write as _;

use robot_model::columns::Arm as _;
use robot_model::identify::{Driven, Identify, KnownPayload};
use robot_model::log::Log;
use serde::Serialize;

use super::IdentifyArguments;
use super::fit::ByAcceleration;
use super::page::Evidence;
use super::payload::{Logs, PayloadReport, of_arm};
use super::results::Results;
use crate::Error;
use crate::progress::Progress;

/// What `--json` writes: the keys of `--payload`, and these.
#[derive(Serialize)]
struct GainsReport<'a> {
    #[serde(flatten)]
    payload: PayloadReport<'a>,
    drive_gains: Vec<Gain<'a>>,
}

/// Of a joint's drive; null where the logs do not tell it.
#[derive(Serialize)]
struct Gain<'a> {
    joint: &'a str,
    /// N m or N per unit of the log's channel.
    #[serde(rename = "actuator_gain")]
    value: Option<f64>,
    std: Option<f64>,
    /// What the spec has.
    declared: f64,
}

impl IdentifyArguments {
    /// Gains of the drives from a payload of known mass, and the arm with torques by these gains.
    pub(super) fn drive_gains(
        &self,
        form: &ByAcceleration,
        identify: &Identify,
        logs: Logs,
        known: &KnownPayload,
        results: Results,
        progress: Progress,
    ) -> Result<(), Error> {
        let arm = &form.0;
        let link = self.payload_link.as_deref();
        let found = identify.fit_drive_gains(arm, &logs.unloaded, &logs.loaded, link, known)?;
        let free = KnownPayload {
            center: None,
            ..*known
        };
        let free = known.center.and_then(|center| {
            let free = identify.fit_drive_gains(arm, &logs.unloaded, &logs.loaded, link, &free);
            let free = free.ok()?;
            is_moved(&found, &free)
                .then(|| elsewhere(center, &free, known.mass))
                .flatten()
        });
        progress.notes(free);
        let all = |logs: &[Log]| logs.iter().map(|log| found.rescaled(log)).collect();
        let logs = Logs {
            unloaded: all(&logs.unloaded),
            loaded: all(&logs.loaded),
            validate: logs.validate.map(|log| found.rescaled(&log)),
            ..logs
        };
        let carried = &found.carried;
        let judged = self.judged(form, carried, &logs, &progress)?;
        let gains: Vec<Gain> = gains(&found, arm.joints(), arm.actuator_gain()).collect();
        progress.notes(gains.iter().filter_map(doubt));
        let own = of_arm(carried, &judged.train);
        let mut payload = judged.report(&own, carried);
        let [place, std] = center(&found, known);
        payload.payload.know(known.mass, place, std);
        let printed = format!(
            "{}{}\n{}",
            carried.estimate,
            told(&gains, known, &carried.link),
            judged.table(&carried.estimate)
        );
        let report = GainsReport {
            payload,
            drive_gains: gains,
        };
        let evidence = Evidence {
            notes: progress.noted(),
            printed: &printed,
            ..judged.evidence(&self.spec, form, &own, carried, &logs)
        };
        results.give(&report, &evidence, progress)
    }
}

fn gains<'a>(
    found: &'a Driven,
    joints: &'a [String],
    declared: &'a [f64],
) -> impl Iterator<Item = Gain<'a>> {
    let all = found.gains.iter().zip(joints).zip(declared);
    all.map(|((gain, joint), declared)| Gain {
        joint,
        value: gain.map(|gain| gain.value),
        std: gain.map(|gain| gain.std),
        declared: *declared,
    })
}

/// The payload's center of mass in the link's frame, m, and its deviations, as far as it was given or is told.
fn center(found: &Driven, known: &KnownPayload) -> [[Option<f64>; 3]; 2] {
    if let Some(center) = known.center {
        return [center.map(Some), [None; 3]];
    }
    let moments = found.carried.first_moments();
    [0, 1].map(|which| moments.map(|moment| Some(moment?[which] / known.mass)))
}

/// Share by which a gain has to be another for a center to matter.
const MOVED: f64 = 0.01;

/// Whether gains are others without the center that was given.
fn is_moved(found: &Driven, free: &Driven) -> bool {
    let pairs = found
        .gains
        .iter()
        .flatten()
        .zip(free.gains.iter().flatten());
    let mut shares = pairs.map(|(one, other)| (one.value / other.value - 1.0).abs());
    shares.any(|share| share > MOVED)
}

/// Deviations from which on a center of mass is another than the one that is given.
const ANOTHER: f64 = 5.0;

/// That logs have the payload's center elsewhere where they are asked.
fn elsewhere(given: [f64; 3], free: &Driven, mass: f64) -> Option<String> {
    let axes = ["x", "y", "z"].iter().zip(given);
    let moments = axes.zip(free.carried.first_moments());
    let told = moments.filter_map(|((axis, given), moment)| {
        let [place, std] = moment?.map(|moment| moment / mass);
        ((place - given).abs() > ANOTHER * std)
            .then(|| format!("{axis} = {place:.4} +- {std:.1e} for {given}"))
    });
    let told: Vec<String> = told.collect();
    (!told.is_empty()).then(|| {
        format!(
            "the logs place the payload's center of mass elsewhere, m: {}; check that `--payload-center` is in the frame of the link and \
             that the mass is right; a wrong center biases the gains, without the option gains and center are identified together",
            told.join(", ")
        )
    })
}

/// Gains that are hard to believe.
fn doubt(gain: &Gain) -> Option<String> {
    let (value, std) = gain.value.zip(gain.std)?;
    if value.abs() < 3.0 * std {
        return Some(format!(
            "the gain of {} cannot be distinguished from zero: the payload hardly changes what its drive logs",
            gain.joint
        ));
    }
    (value < 0.0).then(|| {
        format!(
            "the gain of {} is negative: its drive's sign is opposite to that of the spec's joint, or the logs with and without the payload \
             are swapped",
            gain.joint
        )
    })
}

/// One line a joint.
fn told(gains: &[Gain], known: &KnownPayload, link: &str) -> String {
    let width = gains.iter().map(|gain| gain.joint.len()).max().unwrap_or(0);
    let mut text = format!(
        "gains of the drives, N m or N per unit of the log, by {} kg on {link}:\n",
        known.mass
    );
    for gain in gains {
        let Gain {
            joint, declared, ..
        } = gain;
        let line = match gain.value.zip(gain.std) {
            Some((value, std)) => format!(
                "actuator_gain = {value:.5} +- {std:.1e} ({:.2} %), {declared} in the spec",
                100.0 * (std / value).abs()
            ),
            None => format!(
                "not identified: parameters that appear in its torque alone use the spec's {declared}"
            ),
        };
        // A string takes all.
        let _ = writeln!(text, "{joint:width$}  {line}");
    }
    text
}

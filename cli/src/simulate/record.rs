//! What a simulation leaves: its log, and what is said of it.

use std::fmt::Write;
use std::path::Path;

use robot_model::log::JointStates;
use robot_model::simulate::{Desired, Record, Trajectory};
use robot_model_spec::Model;
use robot_model_spec::model::Joint;

use super::Report;
use crate::Error;
use crate::output::rounded;
use crate::output::table::SIMULATION;
use crate::units::Units;

/// Whether a log is to be a bag of ROS 2, by its name.
pub(super) fn is_bag(path: &Path) -> bool {
    ends(path, "mcap")
}

/// Refuses the name of a table that is not written.
pub(super) fn check(path: &Path) -> Result<(), Error> {
    if !ends(path, "parquet") {
        return Ok(());
    }
    Err(Error::Write {
        path: path.to_owned(),
        reason: "a simulation is written as CSV, or as a bag of ROS 2 (`.mcap`)".to_owned(),
    })
}

fn ends(path: &Path, with: &str) -> bool {
    let extension = path.extension();
    extension.is_some_and(|extension| extension.eq_ignore_ascii_case(with))
}

/// The log as a file of the kind that its name says.
pub(super) fn log(path: &Path, record: &Record, model: &Model) -> Result<Vec<u8>, Error> {
    if !is_bag(path) {
        return Ok(csv(record).into_bytes());
    }
    let joints = model.joints.iter().map(|joint| joint.name.clone());
    let joints: Vec<String> = joints.collect();
    let states = JointStates {
        topic: model.log.topic.as_deref().unwrap_or("/joint_states"),
        joints: &joints,
        time: &record.time,
        q: &record.q,
        dq: &record.dq,
        tau: &record.tau,
    };
    states.to_mcap().map_err(|error| Error::Write {
        path: path.to_owned(),
        reason: error.to_string(),
    })
}

/// `time,q1..,dq1..,tau1..[,extra]`
fn csv(record: &Record) -> String {
    let mut text = SIMULATION.header(record.q.len());
    for channel in &record.extra {
        let _ = write!(text, ",{}", channel.name);
    }
    text.push('\n');
    let columns = record.q.iter().chain(&record.dq).chain(&record.tau);
    let columns: Vec<&Vec<f64>> = columns
        .chain(record.extra.iter().map(|channel| &channel.values))
        .collect();
    for (k, time) in record.time.iter().enumerate() {
        SIMULATION.push(&mut text, *time, columns.iter().map(|column| column[k]));
    }
    text
}

pub(super) fn summary(out: &Path, report: &Report, joints: &[Joint]) -> String {
    let mut text = format!(
        "{}: {} samples of {} s\n",
        out.display(),
        report.samples,
        rounded(report.seconds)
    );
    for (joint, error) in joints.iter().zip(&report.tracking_error) {
        let unit = Units::of(joint.kind).position;
        let _ = writeln!(
            text,
            "largest tracking error of {}: {error:.3e} {unit}",
            joint.name
        );
    }
    if let Some(drift) = report.energy_drift {
        let _ = writeln!(text, "relative drift of energy: {drift:.1e}");
    }
    let _ = writeln!(
        text,
        "{} events; {} explicit, {} implicit and {} impulse steps, {} rejected",
        report.events,
        report.explicit_steps,
        report.implicit_steps,
        report.impulse_steps,
        report.rejected_steps
    );
    text
}

/// Joints that are wanted, went or were driven beyond the limits of the spec.
pub(super) fn beyond_limits(
    model: &Model,
    trajectory: &Trajectory,
    record: &Record,
) -> Vec<String> {
    let mut notes = Vec::new();
    for (k, joint) in model.joints.iter().enumerate() {
        let limits = &joint.limits;
        let wanted = |part: fn(&Desired) -> &Vec<f64>| {
            record
                .time
                .iter()
                .map(move |&time| (time, part(&trajectory.at(time))[k]))
        };
        let (low, high) = limits
            .position
            .unwrap_or((f64::NEG_INFINITY, f64::INFINITY));
        let speed = limits.velocity.unwrap_or(f64::INFINITY);
        let most = limits.torque.unwrap_or(f64::INFINITY) / joint.actuator_gain.abs();
        // A design that goes to its limits goes there but for rounding.
        let is_out = |x: f64, low: f64, high: f64| {
            x < low - 1e-6 * low.abs() || x > high + 1e-6 * high.abs()
        };
        let position = wanted(|at| &at.q).find(|(_, q)| is_out(*q, low, high));
        let velocity = wanted(|at| &at.dq).find(|(_, dq)| is_out(*dq, -speed, speed));
        let measured = |values: &[f64], low: f64, high: f64| {
            let mut samples = record.time.iter().copied().zip(values.iter().copied());
            samples.find(|(_, value)| is_out(*value, low, high))
        };
        let torque = measured(&record.tau[k], -most, most);
        // What is wanted there gets there, as a rule.
        let went = match position {
            Some(_) => None,
            None => measured(&record.q[k], low, high),
        };
        for (what, found) in [
            ("has a desired position of", position),
            ("has a desired velocity of", velocity),
            ("reached position", went),
            ("was driven with torque", torque),
        ] {
            if let Some((time, value)) = found {
                notes.push(format!(
                    "note: joint {} {what} {value:.4} at {time} s, beyond its limit",
                    joint.name
                ));
            }
        }
    }
    notes
}

//! The same channels where a file of settings says them beside a spec.

use super::super::Errors;
use super::super::chain::torque_unit;
use super::super::unit::Dimension;
use super::{Arm, Inputs, Other, word, worth};
use crate::ast::{self, LogChannel};
use crate::diagnostic::Diagnostic;
use crate::log_settings::ColumnKind;
use crate::model::{GainUnit, Joint, LogColumns, Model};

/// The columns of a robot's logs where a file beside its spec says some of them, channel by channel in place of the spec's.
pub(crate) fn check_settings(
    channels: &[LogChannel],
    model: &Model,
    errors: &mut Errors,
) -> LogColumns {
    let in_spec =
        |line: usize, what: &str| Other::InSpec(format!("{}:{line}: {what}", model.source));
    let gain = |joint: &Joint| {
        let unit = joint.actuator_gain_unit?;
        let gain = match unit {
            GainUnit::Plain => "a plain number".to_owned(),
            GainUnit::Torque => format!("in `{}`", torque_unit(joint.kind)),
            GainUnit::TorquePerAmpere => format!("in `{}/A`", torque_unit(joint.kind)),
        };
        let what = format!("the gain of `{}` is {gain}", joint.name);
        Some(in_spec(joint.line, &what))
    };
    let arm = Arm {
        joints: &model.joints,
        inputs: Inputs::of(&model.definitions),
        gains: model.joints.iter().map(gain).collect(),
    };
    let mut columns = model.log.clone();
    for channel in channels {
        forget(&mut columns, &channel.key, model.joints.len());
    }
    let line = columns.line.unwrap_or_default();
    let of_spec = columns.all();
    let names = of_spec.map(|(channel, own)| {
        let what = format!("the spec's `log` has it as `{channel}`");
        (own.name.clone(), in_spec(line, &what))
    });
    let names = names.collect();
    arm.check(channels, &mut columns, names, errors);
    columns
}

/// Takes a channel out, and those of an input of joints one by one.
fn forget(columns: &mut LogColumns, key: &str, joints: usize) {
    match key {
        "time" => columns.time = None,
        "q" => columns.q.clear(),
        "dq" => columns.dq.clear(),
        "tau" => columns.tau.clear(),
        "topic" => columns.topic = None,
        _ => columns.inputs.retain(|(name, _)| {
            name != key && (1..=joints).all(|joint| *name != format!("{key}{joint}"))
        }),
    }
}

/// What a one in a column is worth where no robot says of what it is.
pub(crate) fn check_unit(column: &ast::LogColumn, kind: ColumnKind) -> Result<f64, Diagnostic> {
    let dimension = match kind {
        ColumnKind::Time => Dimension::TIME,
        ColumnKind::Angle => Dimension::ANGLE,
        ColumnKind::AngularSpeed => Dimension::ANGULAR_SPEED,
        ColumnKind::Torque => Dimension::TORQUE,
        ColumnKind::Force => Dimension::FORCE,
        ColumnKind::Current => Dimension::CURRENT,
        ColumnKind::Voltage => Dimension::NONE,
    };
    word::check(column, &[dimension])?;
    worth(column, Some(dimension)).map(|own| own.unit)
}

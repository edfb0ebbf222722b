//! `log { .. }`: channels that exist, as many columns as joints, units of the right dimension.

use std::collections::BTreeMap;
use std::sync::Arc;

use proc_macro2::Span;

use super::chain::{coordinate_dimension, speed_dimension, torque_dimension, torque_unit};
use super::unit::Dimension;
use super::{Errors, value};
use crate::ast::{self, LogChannel, Robot, Setting, Value};
use crate::diagnostic::Diagnostic;
use crate::model::{EffectDefinition, Joint, LogColumn, LogColumns};
use crate::suggest;

/// Names of inputs: of the whole arm, and of joints.
struct Inputs {
    of_arm: Vec<String>,
    of_joints: Vec<String>,
}

/// What the columns of a channel are.
enum Channel {
    Time,
    Position,
    Velocity,
    Torque,
    /// One column of that name.
    Input(String),
    /// A column for each joint, of that name with the joint's number.
    InputOfJoints(String),
}

/// Reports what is wrong with the log's columns; standard ones behind an error.
pub(super) fn check_log(
    robot: &Robot,
    joints: &[Joint],
    definitions: &[Arc<EffectDefinition>],
    errors: &mut Errors,
) -> LogColumns {
    let mut columns = LogColumns::default();
    let [block, others @ ..] = robot.logs.as_slice() else {
        return columns;
    };
    for other in others {
        errors.push(
            Diagnostic::new(other.keyword, "the robot has more than one `log`", "second")
                .also(block.keyword, "first")
                .help("write all columns into one"),
        );
    }
    let inputs = Inputs::of(definitions);
    let mut keys = Vec::new();
    let mut names: BTreeMap<String, Span> = BTreeMap::new();
    for channel in &block.channels {
        keys.push(&channel.key);
        if channel.key == "topic" {
            match topic(channel) {
                Ok(name) => columns.topic = Some(name),
                Err(error) => errors.push(error),
            }
            continue;
        }
        for column in &channel.columns {
            check_column_name(column, &mut names, errors);
        }
        let Some(kind) = check_key(channel, &inputs, joints.len(), errors) else {
            continue;
        };
        if !check_count(channel, &kind, joints.len(), errors) {
            continue;
        }
        let mut read = |dimension: &dyn Fn(&Joint) -> Option<Dimension>| -> Vec<LogColumn> {
            let pairs = channel.columns.iter().zip(joints);
            let columns = pairs.map(|(column, joint)| worth(column, dimension(joint)));
            let columns = columns.map(|column| column.map_err(|error| errors.push(error)));
            columns.flatten().collect()
        };
        match kind {
            Channel::Time => columns.time = read(&|_| Some(Dimension::TIME)).pop(),
            Channel::Position => columns.q = read(&|j| Some(coordinate_dimension(j.kind))),
            Channel::Velocity => columns.dq = read(&|j| Some(speed_dimension(j.kind))),
            Channel::Torque => {
                for (column, joint) in channel.columns.iter().zip(joints) {
                    let sound = worth(column, None).and_then(|own| {
                        check_torque(column, joint, gain_of(robot, joint)).map(|()| own)
                    });
                    match sound {
                        Ok(own) => columns.tau.push(own),
                        Err(error) => errors.push(error),
                    }
                }
            }
            Channel::Input(name) => {
                let column = read(&|_| None).pop();
                columns.inputs.extend(column.map(|column| (name, column)));
            }
            Channel::InputOfJoints(name) => {
                let numbered = read(&|_| None).into_iter().enumerate();
                let named = numbered.map(|(j, column)| (format!("{name}{}", j + 1), column));
                columns.inputs.extend(named);
            }
        }
    }
    super::check_unique(keys, "channel", errors);
    columns
}

impl Inputs {
    fn of(definitions: &[Arc<EffectDefinition>]) -> Self {
        let all = || definitions.iter().flat_map(|definition| &definition.inputs);
        let named = |of_joint: bool| {
            let own = all().filter(|input| input.joint.is_some() == of_joint);
            own.map(|input| input.name.clone()).collect()
        };
        Self {
            of_arm: named(false),
            of_joints: named(true),
        }
    }
}

/// The one topic of bags, which is no column and has no unit.
fn topic(channel: &LogChannel) -> Result<String, Diagnostic> {
    const HELP: &str = "write it as the bag has it, such as `topic = \"/joint_states\";`";
    let [column] = channel.columns.as_slice() else {
        let span = channel.key.span();
        return Err(Diagnostic::new(span, "a log has one topic", "several").help(HELP));
    };
    if let Some(unit) = &column.unit {
        return Err(Diagnostic::new(unit.span, "a topic has no unit", "a unit").help(HELP));
    }
    let name = column.name.value().trim().to_owned();
    if name.is_empty() {
        let span = column.name.span();
        return Err(Diagnostic::new(span, "a topic without a name", "empty").help(HELP));
    }
    Ok(name)
}

fn check_column_name(
    column: &ast::LogColumn,
    names: &mut BTreeMap<String, Span>,
    errors: &mut Errors,
) {
    let name = column.name.value().trim().to_owned();
    let span = column.name.span();
    if name.is_empty() {
        errors.push(
            Diagnostic::new(span, "a column without a name", "empty")
                .help("write its name as the log's header has it"),
        );
    } else if let Some(first) = names.get(&name) {
        errors.push(
            Diagnostic::new(span, format!("column `{name}` is two channels"), "second")
                .also(*first, "first")
                .help("give each channel a column of its own"),
        );
    } else {
        names.insert(name, span);
    }
}

fn check_key(
    channel: &LogChannel,
    inputs: &Inputs,
    joints: usize,
    errors: &mut Errors,
) -> Option<Channel> {
    let key = channel.key.to_string();
    match key.as_str() {
        "time" => return Some(Channel::Time),
        "q" => return Some(Channel::Position),
        "dq" => return Some(Channel::Velocity),
        "tau" => return Some(Channel::Torque),
        _ => {}
    }
    if inputs.of_arm.contains(&key) {
        return Some(Channel::Input(key));
    }
    if inputs.of_joints.contains(&key) {
        return Some(Channel::InputOfJoints(key));
    }
    let numbered = |name: &String| (1..=joints).any(|j| key == format!("{name}{j}"));
    if inputs.of_joints.iter().any(numbered) {
        return Some(Channel::Input(key));
    }
    let known = ["time", "q", "dq", "tau", "topic"].into_iter();
    let own = inputs.of_arm.iter().chain(&inputs.of_joints);
    let known = known.chain(own.map(String::as_str));
    errors.push(
        Diagnostic::new(
            channel.key.span(),
            format!("a log has no channel `{key}`"),
            "neither of the arm nor an input of an effect",
        )
        .help(suggest::help(&key, known)),
    );
    None
}

fn check_count(channel: &LogChannel, kind: &Channel, joints: usize, errors: &mut Errors) -> bool {
    let wanted = match kind {
        Channel::Time | Channel::Input(_) => 1,
        _ => joints,
    };
    let found = channel.columns.len();
    if found == wanted {
        return true;
    }
    let text = |count: usize| match count {
        1 => "one column".to_owned(),
        count => format!("{count} columns"),
    };
    errors.push(
        Diagnostic::new(
            channel.key.span(),
            format!(
                "channel `{}` has {}, expected {}",
                channel.key,
                text(found),
                text(wanted)
            ),
            "",
        )
        .help(match kind {
            Channel::Time | Channel::Input(_) => format!("write `{} = \"name\";`", channel.key),
            _ => "write one column a joint, in the order of the joints, with commas between them"
                .to_owned(),
        }),
    );
    false
}

/// What a one in the column is worth, of a dimension or of any.
fn worth(column: &ast::LogColumn, dimension: Option<Dimension>) -> Result<LogColumn, Diagnostic> {
    let unit = match (&column.unit, dimension) {
        (None, _) => 1.0,
        (Some(unit), Some(dimension)) => value::in_dimension(unit, dimension)?,
        (Some(unit), None) => value::constant(unit)?.value,
    };
    match &column.unit {
        Some(written) if unit.abs() == 0.0 => Err(Diagnostic::new(
            written.span,
            "a unit of zero",
            "the column would tell nothing",
        )
        .help("write what a one in the column is worth, such as `deg` or `360 deg/4096`")),
        _ => Ok(LogColumn {
            name: column.name.value().trim().to_owned(),
            unit,
        }),
    }
}

/// A torque, a current with a gain, or a number with a gain of any kind.
fn check_torque(
    column: &ast::LogColumn,
    joint: &Joint,
    gain: Option<&Value>,
) -> Result<(), Diagnostic> {
    let Some(unit) = &column.unit else {
        return Ok(());
    };
    let torque = torque_dimension(joint.kind);
    let dimension = value::constant(unit)?.dimension;
    // Errors of the gain itself are told where joints are checked.
    let of_gain = gain.map(|gain| value::quantity(gain).ok().and_then(|gain| gain.dimension));
    let name = &joint.name;
    let in_torque = torque_unit(joint.kind);
    match (dimension, of_gain) {
        (Some(Dimension::CURRENT), None) => Err(Diagnostic::new(
            unit.span,
            format!("joint `{name}` logs a current and has no `actuator_gain`"),
            "a current",
        )
        .help(format!(
            "write `actuator_gain = 0.1 {in_torque}/A;` into the joint, with the torque per ampere"
        ))),
        (Some(found), _) if found != torque && found != Dimension::CURRENT => Err(Diagnostic::new(
            unit.span,
            format!("expected {}, found {}", torque.describe(), found.describe()),
            format!("this is {}", found.describe()),
        )
        .help(format!(
            "write it in `{in_torque}`, in `A` with an `actuator_gain`, or as a plain number"
        ))),
        (Some(found), Some(Some(of_gain))) if found.times(of_gain, 1) != torque => {
            let mut error = Diagnostic::new(
                unit.span,
                format!(
                    "the unit of joint `{name}`'s log times that of its `actuator_gain` is not {}",
                    torque.describe()
                ),
                format!("{} here", found.describe()),
            );
            if let Some(gain) = gain {
                error = error.also(gain.span(), of_gain.describe());
            }
            Err(error.help(format!(
                "write the gain in `{in_torque}/A` where the log is in `A`, and as a plain number where it is in `{in_torque}`"
            )))
        }
        _ => Ok(()),
    }
}

/// What is written for the joint's `actuator_gain`.
fn gain_of<'a>(robot: &'a Robot, joint: &Joint) -> Option<&'a Value> {
    let of_chain = robot.joints.iter().map(|own| (&own.name, &own.settings));
    let of_energies = robot
        .energies
        .limits
        .iter()
        .map(|own| (&own.name, &own.settings));
    let mut own = of_chain
        .chain(of_energies)
        .filter(|(name, _)| **name == joint.name);
    let settings: &[Setting] = own.next()?.1;
    let gain = settings
        .iter()
        .find(|setting| setting.key == "actuator_gain")?;
    Some(&gain.value)
}

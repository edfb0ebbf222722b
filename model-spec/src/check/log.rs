//! `log { .. }`, and the same of a file of settings: channels that exist, as many columns as joints, units of the right dimension.

#[cfg(feature = "log-settings")]
mod settings;
mod torque;
mod word;

use std::collections::BTreeMap;
use std::sync::Arc;

use proc_macro2::Span;
use syn::Ident;

use super::chain::{coordinate_dimension, speed_dimension, torque_dimension};
use super::unit::Dimension;
use super::{Errors, value};
use crate::ast::{self, LogChannel, Robot};
use crate::diagnostic::Diagnostic;
use crate::model::{EffectDefinition, Joint, LogColumn, LogColumns};
use crate::suggest;
use torque::{check_torque, gain_of};

#[cfg(feature = "log-settings")]
pub(crate) use settings::{check_settings, check_unit};

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

/// Where else a column or a gain is said.
#[derive(Clone)]
enum Other {
    /// In the same text.
    Here(Span),
    /// In the spec, which is another text: in words.
    #[cfg(feature = "log-settings")]
    InSpec(String),
}

/// What channels have to fit to.
struct Arm<'a> {
    joints: &'a [Joint],
    inputs: Inputs,
    /// Where the gains of the joints are, that have one.
    gains: Vec<Option<Other>>,
}

/// Reports what is wrong with the log's columns; standard ones behind an error.
pub(super) fn check_log(
    robot: &Robot,
    joints: &[Joint],
    definitions: &[Arc<EffectDefinition>],
    errors: &mut Errors,
) -> LogColumns {
    let [block, others @ ..] = robot.logs.as_slice() else {
        return LogColumns::default();
    };
    for other in others {
        errors.push(
            Diagnostic::new(other.keyword, "the robot has more than one `log`", "second")
                .also(block.keyword, "first")
                .help("write all columns into one"),
        );
    }
    let arm = Arm {
        joints,
        inputs: Inputs::of(definitions),
        gains: joints.iter().map(|joint| gain_of(robot, joint)).collect(),
    };
    let mut columns = LogColumns {
        line: Some(block.keyword.start().line),
        ..LogColumns::default()
    };
    arm.check(&block.channels, &mut columns, BTreeMap::new(), errors);
    let keys = block.channels.iter();
    let keys: Vec<Ident> = keys.map(|own| Ident::new(&own.key, own.span)).collect();
    super::check_unique(&keys, "channel", errors);
    columns
}

impl Arm<'_> {
    /// Adds what channels say to the columns; `names` are those that are taken.
    fn check(
        &self,
        channels: &[LogChannel],
        columns: &mut LogColumns,
        mut names: BTreeMap<String, Other>,
        errors: &mut Errors,
    ) {
        for channel in channels {
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
            let Some(kind) = check_key(channel, &self.inputs, self.joints.len(), errors) else {
                continue;
            };
            if check_count(channel, &kind, self.joints.len(), errors) {
                self.read(channel, kind, columns, errors);
            }
        }
    }

    /// The columns of a channel that is known and has as many as it should.
    fn read(
        &self,
        channel: &LogChannel,
        kind: Channel,
        columns: &mut LogColumns,
        errors: &mut Errors,
    ) {
        let mut read = |dimension: &dyn Fn(&Joint) -> Option<Dimension>| -> Vec<LogColumn> {
            let kinds: Vec<Dimension> = self.joints.iter().filter_map(dimension).collect();
            let pairs = channel.columns.iter().zip(self.joints);
            let columns = pairs.map(|(column, joint)| {
                word::check(column, &kinds)?;
                worth(column, dimension(joint))
            });
            let columns = columns.map(|column| column.map_err(|error| errors.push(error)));
            columns.flatten().collect()
        };
        match kind {
            Channel::Time => columns.time = read(&|_| Some(Dimension::TIME)).pop(),
            Channel::Position => columns.q = read(&|j| Some(coordinate_dimension(j.kind))),
            Channel::Velocity => columns.dq = read(&|j| Some(speed_dimension(j.kind))),
            Channel::Torque => {
                let joints = self.joints.iter().zip(&self.gains);
                let kinds = self.joints.iter().map(|joint| torque_dimension(joint.kind));
                let kinds: Vec<Dimension> = kinds.chain([Dimension::CURRENT]).collect();
                for (column, (joint, gain)) in channel.columns.iter().zip(joints) {
                    let sound = word::check(column, &kinds)
                        .and_then(|()| worth(column, None))
                        .and_then(|own| check_torque(column, joint, gain.as_ref()).map(|()| own));
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

impl Other {
    /// An error with its second place: a label, or words in front of the help.
    fn beside(&self, error: Diagnostic, label: impl Into<String>, help: &str) -> Diagnostic {
        match self {
            Self::Here(span) => error.also(*span, label).help(help),
            #[cfg(feature = "log-settings")]
            Self::InSpec(said) => error.help(format!("{said}; {help}")),
        }
    }
}

/// The one topic of bags, which is no column and has no unit.
fn topic(channel: &LogChannel) -> Result<String, Diagnostic> {
    const HELP: &str = "write its name in the bag, such as `topic = \"/joint_states\";`";
    let [column] = channel.columns.as_slice() else {
        let span = channel.span;
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
    names: &mut BTreeMap<String, Other>,
    errors: &mut Errors,
) {
    let name = column.name.value().trim().to_owned();
    let span = column.name.span();
    if name.is_empty() {
        errors.push(
            Diagnostic::new(span, "a column without a name", "empty")
                .help("write its name as in the log's header"),
        );
    } else if let Some(first) = names.get(&name) {
        let error = Diagnostic::new(span, format!("column `{name}` is two channels"), "second");
        let help = "give each channel its own column";
        errors.push(first.beside(error, "first", help));
    } else {
        names.insert(name, Other::Here(span));
    }
}

fn check_key(
    channel: &LogChannel,
    inputs: &Inputs,
    joints: usize,
    errors: &mut Errors,
) -> Option<Channel> {
    let key = channel.key.clone();
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
            channel.span,
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
            channel.span,
            format!(
                "channel `{}` has {}, expected {}",
                channel.key,
                text(found),
                text(wanted)
            ),
            "",
        )
        .help(match kind {
            Channel::Time | Channel::Input(_) => {
                format!("write one column, as in `{} = \"name\"`", channel.key)
            }
            _ => "write one column per joint, in the order of the joints, separated by commas"
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
            "the column would be all zeros",
        )
        .help("write the value of 1 in the column, such as `deg` or `360 deg/4096`")),
        _ => Ok(LogColumn {
            name: column.name.value().trim().to_owned(),
            unit,
            is_unit_written: column.unit.is_some(),
        }),
    }
}

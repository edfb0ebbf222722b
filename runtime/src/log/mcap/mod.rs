//! Bags of ROS 2, in MCAP files: `sensor_msgs/msg/JointState` on one topic, a message a row.
//!
//! In: messages in CDR. Out: columns `time` and `JOINT.position`, `JOINT.velocity`, `JOINT.effort` of the arm's joints. Time is
//! that of the messages' headers, since the first of them. Messages without some of the arm's joints, as those of a gripper on
//! the same topic, are passed over.

mod cdr;
mod survey;
mod written;

use std::fs::File;
use std::io::{BufReader, Cursor, Read, Seek};
use std::panic::{self, AssertUnwindSafe};

use mcap::io::MessageReader;
use mcap::sans_io::LinearReaderOptions;
use mcap::{Channel, McapError};

use super::rows::{DAMAGED, Input, Rows, Table, unreadable};
use super::{Column, Columns, LogError};
use cdr::JointState;
use survey::topic;

pub use written::{JointStates, NotABag};

/// The type of messages, and how they are packed.
const SCHEMA: &str = "sensor_msgs/msg/JointState";
const ENCODING: &str = "cdr";

/// Longest record that is taken, bytes: a length that is damaged must not take all memory.
const LONGEST: usize = 1 << 28;

/// Names of other joints that are kept for a message of what is wrong.
const MOST_OTHERS: usize = 1000;

/// What a joint has in a message.
const FIELDS: [&str; 3] = ["position", "velocity", "effort"];

/// Something that can be read from its start twice.
trait Source: Read + Seek {}

impl Source for Cursor<Vec<u8>> {}
impl Source for BufReader<File> {}

/// Rows of a bag.
pub(super) struct McapRows {
    source: String,
    topic: String,
    messages: MessageReader<Box<dyn Source>>,
    /// The arm's joints as the bag calls them, those of which some channel is wanted.
    joints: Vec<String>,
    /// Which of [`FIELDS`] they have.
    fields: [bool; 3],
    names: Vec<String>,
    /// The first message that has all joints, until it is handed on.
    first: Option<JointState>,
    /// Its stamp, ns.
    start: i64,
    /// Messages on the topic so far.
    count: u64,
    /// Where the joints are in a message with names as in the last one.
    places: Vec<usize>,
    last_names: Vec<String>,
}

impl McapRows {
    /// Finds the topic, and the first message on it that has the arm's joints.
    pub fn new(source: &str, input: Input, columns: &Columns) -> Result<Self, LogError> {
        let mut bag: Box<dyn Source> = match input {
            Input::File(file) => Box::new(BufReader::new(file)),
            Input::Memory(bytes) => Box::new(Cursor::new(bytes)),
        };
        let topic = topic(source, &mut bag, columns.topic.as_deref())?;
        let back = bag.rewind();
        back.map_err(|error| unreadable(source, 1, &error))?;
        let joints = wanted_joints(&named(columns));
        if joints.is_empty() {
            return Err(LogError::NoJointNames {
                source_name: source.to_owned(),
            });
        }
        let mut rows = Self {
            source: source.to_owned(),
            topic,
            messages: reader(bag),
            joints,
            fields: [false; 3],
            names: Vec::new(),
            first: None,
            start: 0,
            count: 0,
            places: Vec::new(),
            last_names: Vec::new(),
        };
        rows.find_first()?;
        Ok(rows)
    }

    fn find_first(&mut self) -> Result<(), LogError> {
        let mut present: Vec<String> = Vec::new();
        while let Some(message) = self.next_message()? {
            if !self.has_joints(&message) {
                let room = MOST_OTHERS.saturating_sub(present.len());
                let new = message.names.into_iter().take(room);
                let new: Vec<String> = new.filter(|name| !present.contains(name)).collect();
                present.extend(new);
                continue;
            }
            let lists = [&message.positions, &message.velocities, &message.efforts];
            self.fields = lists.map(|list| list.len() == message.names.len());
            // Drivers without velocities write none, or no numbers in their place; a log may lack them.
            let mut velocities = self
                .places
                .iter()
                .map(|&place| message.velocities.get(place));
            self.fields[1] &= velocities.all(|value| value.is_some_and(|value| value.is_finite()));
            self.names = vec!["time".to_owned()];
            for joint in &self.joints {
                let fields = FIELDS.iter().zip(self.fields).filter(|(_, is)| *is);
                let columns = fields.map(|(field, _)| format!("{joint}.{field}"));
                self.names.extend(columns);
            }
            self.start = nanoseconds(&message);
            self.first = Some(message);
            return Ok(());
        }
        let (source_name, topic) = (self.source.clone(), self.topic.clone());
        let missing = self.joints.iter().filter(|name| !present.contains(name));
        let missing: Vec<String> = missing.cloned().collect();
        Err(if missing.is_empty() {
            LogError::ScatteredJoints {
                source_name,
                topic,
                joints: self.joints.clone(),
            }
        } else {
            LogError::NoSuchJoints {
                source_name,
                topic,
                missing,
                present,
            }
        })
    }

    /// Whether a message has the joints; notes where.
    fn has_joints(&mut self, message: &JointState) -> bool {
        if message.names != self.last_names || self.last_names.is_empty() {
            let mut joints = self.joints.iter();
            let place = |joint: &String| message.names.iter().position(|name| name == joint);
            let places: Option<Vec<usize>> = joints.by_ref().map(place).collect();
            self.places = places.unwrap_or_default();
            self.last_names.clone_from(&message.names);
        }
        !self.places.is_empty()
    }

    /// The next message on the topic.
    fn next_message(&mut self) -> Result<Option<JointState>, LogError> {
        let source = &self.source;
        loop {
            let next = guarded(|| self.messages.next().transpose());
            let Some(message) = next.map_err(|error| damaged(source, self.count + 1, &error))?
            else {
                return Ok(None);
            };
            if !is_joint_states(&message.channel) || message.channel.topic != self.topic {
                continue;
            }
            self.count += 1;
            let read = JointState::read(&message.data).map_err(|fault| LogError::Read {
                source_name: source.clone(),
                line: self.count,
                reason: format!("message {} on `{}`: {fault}", self.count, self.topic),
            });
            return read.map(Some);
        }
    }

    /// The values of a row, by column.
    fn row(&self, message: &JointState) -> Result<Vec<f64>, LogError> {
        let since = (nanoseconds(message) - self.start) as f64 / 1e9;
        let mut row = vec![since];
        let lists = [&message.positions, &message.velocities, &message.efforts];
        let lists = || lists.iter().zip(self.fields).zip(FIELDS);
        for ((list, is_there), field) in lists() {
            if is_there && list.len() != message.names.len() {
                return Err(LogError::NotANumber {
                    source_name: self.source.clone(),
                    line: self.count,
                    column: field.to_owned(),
                    text: format!(
                        "a list of {}, of {} joints",
                        list.len(),
                        message.names.len()
                    ),
                });
            }
        }
        for &place in &self.places {
            row.extend(
                lists()
                    .filter(|((_, is_there), _)| *is_there)
                    .map(|((list, _), _)| list[place]),
            );
        }
        Ok(row)
    }

    /// A row, or what is wrong with it where it counts as missing.
    fn sound_row(&self, message: &JointState, is_needed: &[bool]) -> Result<Vec<f64>, LogError> {
        let row = self.row(message)?;
        let columns = row.iter().zip(&self.names).zip(is_needed);
        let mut bad = columns.filter(|((value, _), needed)| **needed && !value.is_finite());
        match bad.next() {
            None => Ok(row),
            Some(((value, name), _)) => Err(LogError::NotFinite {
                source_name: self.source.clone(),
                line: self.count,
                column: name.clone(),
                text: value.to_string(),
            }),
        }
    }
}

impl Rows for McapRows {
    fn names(&self) -> &[String] {
        &self.names
    }

    fn columns(&self, wanted: &Columns) -> Columns {
        named(wanted)
    }

    fn fill(&mut self, table: &mut Table, most: usize) -> Result<bool, LogError> {
        while table.lines.len() < most {
            let message = match self.first.take() {
                Some(message) => message,
                None => match self.next_message()? {
                    Some(message) => message,
                    None => return Ok(false),
                },
            };
            if !self.has_joints(&message) {
                continue;
            }
            match self.sound_row(&message, &table.is_needed) {
                Ok(row) => {
                    for (column, value) in row.into_iter().enumerate() {
                        table.columns[column].push(value);
                    }
                    table.lines.push(self.count);
                }
                Err(error) => table.lost.push(self.count, error),
            }
        }
        Ok(true)
    }
}

/// The columns as a bag has them: where none is given as `JOINT.position`, `JOINT.velocity` or `JOINT.effort`, by the names of the
/// joints, in SI units.
fn named(wanted: &Columns) -> Columns {
    let mut columns = wanted.clone();
    let is_own = |column: &Column| field_of(&column.name).is_some();
    let has_own = wanted.q.iter().chain(&wanted.tau).any(is_own);
    if !has_own {
        columns = Columns {
            extra: wanted.extra.clone(),
            joints: wanted.joints.clone(),
            topic: wanted.topic.clone(),
            ..Columns::standard(wanted.dof())
        };
    }
    columns.time = Columns::standard(0).time;
    let families = [&mut columns.q, &mut columns.dq, &mut columns.tau];
    for (family, field) in families.into_iter().zip(FIELDS) {
        for (column, joint) in family.iter_mut().zip(&wanted.joints) {
            if field_of(&column.name).is_none() {
                column.name = format!("{joint}.{field}");
            }
        }
    }
    columns
}

/// `("elbow", "effort")` of `elbow.effort`
fn field_of(name: &str) -> Option<(&str, &str)> {
    name.rsplit_once('.')
        .filter(|(joint, field)| !joint.is_empty() && FIELDS.contains(field))
}

/// Joints whose positions and torques are wanted.
fn wanted_joints(columns: &Columns) -> Vec<String> {
    let mut joints: Vec<String> = Vec::new();
    for column in columns.q.iter().chain(&columns.tau) {
        if let Some((joint, _)) = field_of(&column.name)
            && !joints.iter().any(|known| known == joint)
        {
            joints.push(joint.to_owned());
        }
    }
    joints
}

fn is_joint_states(channel: &Channel) -> bool {
    let schema = channel.schema.as_ref();
    schema.is_some_and(|schema| schema.name == SCHEMA) && channel.message_encoding == ENCODING
}

fn nanoseconds(message: &JointState) -> i64 {
    i64::from(message.seconds) * 1_000_000_000 + i64::from(message.nanoseconds)
}

fn reader<R: Read>(bag: R) -> MessageReader<R> {
    let options = LinearReaderOptions::default()
        .with_prevalidate_chunk_crcs(true)
        .with_record_length_limit(LONGEST);
    MessageReader::new_with_options(bag, options)
}

/// Reads from a file that may be damaged: the crate that decodes it panics at some damages, which are errors here.
fn guarded<T>(read: impl FnOnce() -> Result<T, McapError>) -> Result<T, McapError> {
    let read = panic::catch_unwind(AssertUnwindSafe(read));
    read.unwrap_or_else(|_| {
        Err(McapError::DecompressionError(
            "a chunk cannot be unpacked".to_owned(),
        ))
    })
}

/// What is wrong with the file before a message.
fn damaged(source: &str, line: u64, error: &McapError) -> LogError {
    let reason = match error {
        McapError::UnexpectedEof => {
            "the file is truncated, as when a recording was not closed; repair it with `mcap recover`".to_owned()
        }
        McapError::Parse(_) => format!("a record cannot be read; {DAMAGED}"),
        McapError::Io(error) => error.to_string(),
        other => format!("{other}; {DAMAGED}"),
    };
    LogError::Read {
        source_name: source.to_owned(),
        line,
        reason,
    }
}

#[cfg(test)]
mod tests;

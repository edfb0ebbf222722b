//! What can be wrong with a log, and the words for it.

mod place;
mod text;

use thiserror::Error;

pub use place::TextPlace;
pub use text::TextError;

use super::words::{columns, field, fields, hertz, in_unit, joints, list, plural, way_out};

/// Why a log cannot be used. `source_name` is the file, `line` counts from 1, with all that stands above a header.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum LogError {
    /// The file cannot be opened.
    #[error("cannot open log `{source_name}`: {reason}")]
    Open {
        /// The file.
        source_name: String,
        /// What the system says.
        reason: String,
    },
    /// The file breaks off, or is damaged.
    #[error("{source_name}:{line}: cannot read the log: {reason}")]
    Read {
        /// The file.
        source_name: String,
        /// Last line that could be read.
        line: u64,
        /// What the system or the decoder says.
        reason: String,
    },
    /// Nothing in the file.
    #[error(
        "{source_name}: the log is empty; name the file that has the samples, as a header `time,q1,..,tau1,..` and a row for each"
    )]
    Empty {
        /// The file.
        source_name: String,
    },
    /// A text that is no table of numbers.
    #[error(transparent)]
    Text(#[from] TextError),
    /// A file of another kind.
    #[error("{source_name}:1: no log is read from {what}; {way_out}")]
    Foreign {
        /// The file.
        source_name: String,
        /// What it is.
        what: &'static str,
        /// How a log is made of it.
        way_out: &'static str,
    },
    /// A header field is empty.
    #[error(
        "{source_name}:{line}: column {column} has no name; name every column of numbers; only a first column that counts the rows may have none"
    )]
    UnnamedColumn {
        /// The file.
        source_name: String,
        /// Line of the header, or of the row that shows that it is a column.
        line: u64,
        /// Its place, from 1.
        column: usize,
    },
    /// More columns than any arm has channels.
    #[error(
        "{source_name}:{line}: the log has {found} columns, more than {most}; remove those that are not channels of the arm"
    )]
    TooManyColumns {
        /// The file.
        source_name: String,
        /// Line of the header.
        line: u64,
        /// Its columns.
        found: usize,
        /// The most that are taken.
        most: usize,
    },
    /// More numbers than memory is there for.
    #[error(
        "{source_name}: the log has {rows} rows or more, of {columns} column{}: more than 2 GiB of numbers; cut it into several logs, or leave columns out",
        plural(*.columns)
    )]
    TooLarge {
        /// The file.
        source_name: String,
        /// Rows that are there, or are said to be.
        rows: u64,
        /// Its columns.
        columns: usize,
    },
    /// Two columns of one name.
    #[error(
        "{source_name}:{line}: column `{}` appears twice; delete or rename one of them",
        field(name)
    )]
    DuplicateColumn {
        /// The file.
        source_name: String,
        /// Line of the header.
        line: u64,
        /// The name.
        name: String,
    },
    /// One column that is to be two channels.
    #[error(
        "{source_name}: column `{name}` would be two channels; give each its own column; standard names apply where the spec's `log` and \
         its settings give none"
    )]
    TwoChannels {
        /// The file.
        source_name: String,
        /// The column.
        name: String,
    },
    /// A column of a known family for a joint that the arm does not have.
    #[error("{source_name}:{line}: unknown column `{}`: the arm has {dof} joint{}, {}", field(name), plural(*.dof), joints(*.dof))]
    NoSuchJoint {
        /// The file.
        source_name: String,
        /// Line of the header.
        line: u64,
        /// The column.
        name: String,
        /// Joints of the arm.
        dof: usize,
        /// Settings that would name the columns as they are.
        lines: Vec<String>,
    },
    /// Nearly the name of a known column.
    #[error(
        "{source_name}:{line}: unknown column `{}`: write `{suggestion}`, or give the channel a name that cannot be \
         mistaken for it",
        field(name)
    )]
    Misspelled {
        /// The file.
        source_name: String,
        /// Line of the header.
        line: u64,
        /// The column.
        name: String,
        /// What may be meant.
        suggestion: String,
        /// Settings that would name the columns as they are.
        lines: Vec<String>,
    },
    /// Columns that a log of this arm must have.
    #[error("{source_name}:{line}: missing column{} {}; the header has {}", plural(.missing.len()), list(missing), columns(present))]
    MissingColumns {
        /// The file.
        source_name: String,
        /// Line of the header.
        line: u64,
        /// What is not there.
        missing: Vec<String>,
        /// What is there.
        present: Vec<String>,
    },
    /// A bag of ROS 2 without what is read of one.
    #[error(
        "{source_name}: no topic has messages of type `sensor_msgs/msg/JointState` in CDR; {}",
        if present.is_empty() { "it has no messages at all".to_owned() } else { format!("it has {}", list(present)) }
    )]
    NoJointStates {
        /// The file.
        source_name: String,
        /// Topics of other types.
        present: Vec<String>,
    },
    /// A bag of ROS 2 with joint states of several origins.
    #[error(
        "{source_name}: joint states are on several topics, {}; name one in the spec's `log`: `topic = {:?};`",
        list(present), present[0]
    )]
    SeveralTopics {
        /// The file.
        source_name: String,
        /// The topics; two at least.
        present: Vec<String>,
    },
    /// A bag of ROS 2 without the topic that was asked for.
    #[error(
        "{source_name}: topic `{topic}` has no joint states; they are on {}",
        list(present)
    )]
    NoSuchTopic {
        /// The file.
        source_name: String,
        /// The topic.
        topic: String,
        /// Topics that have joint states.
        present: Vec<String>,
    },
    /// A bag of ROS 2 without the arm's joints.
    #[error(
        "{source_name}: no message on `{topic}` has the joint{} {}; joints there are {}; rename the spec's joints accordingly, or name the \
         bag's joints in the spec's `log`: `q = \"NAME.position\", ..; tau = \"NAME.effort\", ..;`",
        plural(missing.len()), list(missing), list(present)
    )]
    NoSuchJoints {
        /// The file.
        source_name: String,
        /// The topic.
        topic: String,
        /// Joints of the arm that are not there.
        missing: Vec<String>,
        /// Joints that are there.
        present: Vec<String>,
    },
    /// A bag of ROS 2 whose messages have some of the arm's joints each.
    #[error(
        "{source_name}: no message on `{topic}` has all of {} at once; record a topic that combines them, as `joint_state_publisher` does",
        list(joints)
    )]
    ScatteredJoints {
        /// The file.
        source_name: String,
        /// The topic.
        topic: String,
        /// The arm's joints.
        joints: Vec<String>,
    },
    /// A bag of ROS 2, read without names of joints.
    #[error(
        "{source_name}: it has joints by name, but no names are given; name them in `Columns::joints`"
    )]
    NoJointNames {
        /// The file.
        source_name: String,
    },
    /// A row that is longer or shorter than the header.
    #[error("{source_name}:{line}: {}", fields(*.found, *.expected, *.is_cut))]
    ColumnCount {
        /// The file.
        source_name: String,
        /// The row's line.
        line: u64,
        /// Fields of the row.
        found: usize,
        /// Fields of the header.
        expected: usize,
        /// Whether it is the last row and too short.
        is_cut: bool,
    },
    /// A field that is no number.
    #[error(
        "{source_name}:{line}: {} in column `{}` is not a number; {}",
        if text.is_empty() { "an empty field".to_owned() } else { format!("`{text}`") },
        field(column),
        way_out(text)
    )]
    NotANumber {
        /// The file.
        source_name: String,
        /// Its line.
        line: u64,
        /// Its column.
        column: String,
        /// The field.
        text: String,
    },
    /// NaN or infinity.
    #[error(
        "{source_name}:{line}: `{text}` in column `{}` is not finite; remove or repair the row",
        field(column)
    )]
    NotFinite {
        /// The file.
        source_name: String,
        /// Its line.
        line: u64,
        /// Its column.
        column: String,
        /// The field.
        text: String,
    },
    /// Many rows that lack a number.
    #[error("{first}; {rows} of {of} rows have such a field, too many to interpolate")]
    ManyLost {
        /// What is wrong with the first.
        first: Box<LogError>,
        /// How many there are.
        rows: usize,
        /// Of how many.
        of: usize,
    },
    /// NaN or infinity in samples that came from memory.
    #[error("{source_name}: sample {sample} is not finite; remove or repair it")]
    NotFiniteSample {
        /// The log.
        source_name: String,
        /// The sample, from 0.
        sample: usize,
    },
    /// Channels of different lengths, or not as many torques as positions.
    #[error(
        "{source_name}: every joint needs a position and a torque channel, all as long as the time"
    )]
    Lengths {
        /// The log.
        source_name: String,
    },
    /// Time repeats or runs back.
    #[error("{place}: time does not increase: {time} s follows {previous} s; {way_out}")]
    TimeOrder {
        /// File and line, or log and sample.
        place: String,
        /// Time stamp there.
        time: f64,
        /// Time stamp before.
        previous: f64,
        /// What may be done about it.
        way_out: &'static str,
    },
    /// Samples are missing.
    #[error(
        "{place}: gap in time from {previous} s to {time} s, {steps:.0} times the median step; split the log here and \
         give both parts"
    )]
    Gap {
        /// File and line, or log and sample.
        place: String,
        /// Time stamp after the gap.
        time: f64,
        /// Time stamp before the gap.
        previous: f64,
        /// Its length in median steps.
        steps: f64,
    },
    /// None of several gaps is too long, and all together are.
    #[error(
        "{source_name}: {times} gaps in time take {seconds:.2} s of {all:.2} s, more than {most:.0} %, the first after {first} s; give the \
         parts between them as separate logs"
    )]
    Gaps {
        /// The log.
        source_name: String,
        /// How many.
        times: usize,
        /// Their length, s.
        seconds: f64,
        /// That of the log, s.
        all: f64,
        /// Time stamp before the first.
        first: f64,
        /// What is borne, percent.
        most: f64,
    },
    /// No arm is sampled like that.
    #[error(
        "{source_name}: the sample rate is {} Hz, outside {slowest} Hz .. {fastest} Hz; is time in seconds?{}", hertz(*.rate_hz), in_unit(*.unit)
    )]
    Rate {
        /// The log.
        source_name: String,
        /// Its rate.
        rate_hz: f64,
        /// The lowest rate that is taken.
        slowest: f64,
        /// The highest rate that is taken.
        fastest: f64,
        /// The unit of time in which it would be one that is taken.
        unit: Option<&'static str>,
    },
    /// A position or torque that no arm has.
    #[error(
        "{place}: `{column}` is {value:e}, beyond {most:e} in magnitude; give positions in rad or m and torques in N m or N, \
         or repair the row"
    )]
    Implausible {
        /// File and line, or log and sample.
        place: String,
        /// Position or torque channel, with the joint's number from 1.
        column: String,
        /// The value.
        value: f64,
        /// The largest magnitude that is taken.
        most: f64,
    },
    /// Too short for anything.
    #[error(
        "{source_name}: the log has {found} sample{}, at least {fewest} are needed; record a longer motion, or check whether the file is truncated",
        plural(*.found)
    )]
    TooFewSamples {
        /// The log.
        source_name: String,
        /// Its samples.
        found: usize,
        /// The fewest that are allowed.
        fewest: usize,
    },
}

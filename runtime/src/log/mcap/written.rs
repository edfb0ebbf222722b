//! Bags of ROS 2 out.

use std::collections::BTreeMap;
use std::io::Cursor;

use mcap::records::MessageHeader;
use mcap::{McapError, WriteOptions};
use thiserror::Error;

use super::cdr::JointState;
use super::{ENCODING, SCHEMA};

/// The type of messages in the words of ROS 2, with the types that it is made of.
const DEFINITION: &str = "std_msgs/Header header
string[] name
float64[] position
float64[] velocity
float64[] effort
================================================================================
MSG: std_msgs/Header
builtin_interfaces/Time stamp
string frame_id
================================================================================
MSG: builtin_interfaces/Time
int32 sec
uint32 nanosec
";

const SECOND: i64 = 1_000_000_000;

/// Joint states of a run: what a bag of ROS 2 with one topic holds.
///
/// # Examples
/// What is written is read.
/// ```
/// use robot_model::log::{Columns, JointStates, Log};
/// let time: Vec<f64> = (0..100).map(|k| 0.01 * f64::from(k)).collect();
/// let (q, tau) = (vec![vec![0.5; 100]], vec![time.clone()]);
/// let joints = ["elbow".to_owned()];
/// let run = JointStates { topic: "/joint_states", joints: &joints, time: &time, q: &q, dq: &[], tau: &tau };
/// let bag = run.to_mcap()?;
/// let columns = Columns { joints: joints.to_vec(), ..Columns::standard(1) };
/// let log = Log::from_reader_as("memory", bag.as_slice(), &columns)?;
/// assert_eq!((log.q, log.tau), (q, tau));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone, Copy)]
pub struct JointStates<'a> {
    /// The topic.
    pub topic: &'a str,
    /// Names of the joints.
    pub joints: &'a [String],
    /// Time stamps, s; nanoseconds of them are kept.
    pub time: &'a [f64],
    /// Positions, rad or m, `[joint][sample]`.
    pub q: &'a [Vec<f64>],
    /// Velocities, rad/s or m/s, `[joint][sample]`; may be empty.
    pub dq: &'a [Vec<f64>],
    /// Torques, N m or N, `[joint][sample]`.
    pub tau: &'a [Vec<f64>],
}

/// Why joint states are no bag.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum NotABag {
    /// Channels are not alike in length, or not one a joint.
    #[error("every joint needs its channels, all as long as the time")]
    Lengths,
    /// A time stamp that ROS 2 has no room for.
    #[error("a time stamp of {0} s: ROS 2 has seconds in 32 bits")]
    Time(f64),
    /// What the container refuses.
    #[error("{0}")]
    Container(String),
}

impl NotABag {
    fn of_container(error: &McapError) -> Self {
        Self::Container(error.to_string())
    }
}

impl JointStates<'_> {
    /// An MCAP file, its chunks packed by zstd; the same run gives the same bytes.
    ///
    /// # Errors
    /// [`NotABag`] where channels are missing or of other lengths, and where time is no time of ROS 2.
    ///
    /// # Examples
    /// ```
    /// use robot_model::log::{JointStates, NotABag};
    /// let (joints, time) = (["elbow".to_owned()], [0.0, 0.01]);
    /// let (q, tau) = ([vec![0.5, 0.6]], [vec![3.0]]);
    /// let mut run = JointStates { topic: "/joint_states", joints: &joints, time: &time, q: &q, dq: &[], tau: &tau };
    /// assert_eq!(run.to_mcap().unwrap_err(), NotABag::Lengths); // one torque, two times
    /// run.tau = &q;
    /// assert!(run.to_mcap()?.starts_with(b"\x89MCAP"));
    /// # Ok::<(), NotABag>(())
    /// ```
    pub fn to_mcap(&self) -> Result<Vec<u8>, NotABag> {
        let (joints, samples) = (self.joints.len(), self.time.len());
        let is_whole = |family: &[Vec<f64>]| {
            family.len() == joints && family.iter().all(|channel| channel.len() == samples)
        };
        let has_dq = self.dq.is_empty() || is_whole(self.dq);
        if !(is_whole(self.q) && is_whole(self.tau) && has_dq) {
            return Err(NotABag::Lengths);
        }
        let refused = |error: McapError| NotABag::of_container(&error);
        let options = WriteOptions::new()
            .profile("ros2")
            .library(concat!("robot-model/", env!("CARGO_PKG_VERSION")))
            // Threads would be as many as the machine has.
            .compression_threads(0);
        let mut writer = options.create(Cursor::new(Vec::new())).map_err(refused)?;
        let schema = writer
            .add_schema(SCHEMA, "ros2msg", DEFINITION.as_bytes())
            .map_err(refused)?;
        let quality = ("offered_qos_profiles".to_owned(), String::new());
        let metadata = BTreeMap::from([quality]);
        let channel_id = writer
            .add_channel(schema, self.topic, ENCODING, &metadata)
            .map_err(refused)?;
        for (k, sequence) in (0..samples).zip(0..) {
            let (seconds, nanoseconds) = stamp(self.time[k])?;
            let sample = |family: &[Vec<f64>]| family.iter().map(|channel| channel[k]).collect();
            let message = JointState {
                seconds,
                nanoseconds,
                frame: String::new(),
                names: self.joints.to_vec(),
                positions: sample(self.q),
                velocities: sample(self.dq),
                efforts: sample(self.tau),
            };
            let time = i64::from(seconds) * SECOND + i64::from(nanoseconds);
            // Times of the container are not below zero.
            let time = u64::try_from(time).unwrap_or(0);
            let header = MessageHeader {
                channel_id,
                sequence,
                log_time: time,
                publish_time: time,
            };
            writer
                .write_to_known_channel(&header, &message.write())
                .map_err(refused)?;
        }
        writer.finish().map_err(refused)?;
        Ok(writer.into_inner().into_inner())
    }
}

/// Seconds and nanoseconds of a time.
fn stamp(time: f64) -> Result<(i32, u32), NotABag> {
    let whole = time.floor();
    let nanoseconds = ((time - whole) * 1e9).round();
    let carried = whole + if nanoseconds >= 1e9 { 1.0 } else { 0.0 };
    if !(f64::from(i32::MIN)..=f64::from(i32::MAX)).contains(&carried) {
        return Err(NotABag::Time(time));
    }
    let nanoseconds = if nanoseconds >= 1e9 { 0.0 } else { nanoseconds };
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "both are whole and in range"
    )]
    Ok((carried as i32, nanoseconds as u32))
}

//! Measured logs.
//!
//! In: CSV text, plain or gzip, Parquet, or bags of ROS 2 (MCAP). Out: [`Log`]. Invariants gained: every number is finite, time is uniform and rises, every
//! channel has one value a sample, and there is one position and one torque channel a joint.

mod close;
mod columns;
mod csv;
mod error;
mod exchanged;
mod faults;
mod foreign;
mod from_table;
mod gaps;
mod header;
mod limits;
mod mapping;
#[cfg(feature = "mcap")]
mod mcap;
mod meant;
mod middle;
mod note;
#[cfg(feature = "parquet")]
mod parquet;
mod phase;
mod pieces;
mod place;
mod rows;
mod sparse;
mod turns;
mod uniform;
mod units;
mod words;

use std::io::Read;
use std::ops::Range;
use std::path::Path;

pub use columns::{Column, Columns, DriveSignal};
pub use error::{LogError, TextError, TextPlace};
pub use faults::{Fault, LateChannel, Mended, Stretches};
#[cfg(feature = "mcap")]
pub use mcap::{JointStates, NotABag};
pub use note::Note;
pub use phase::MOTION_PHASE;
pub use pieces::Pieces;
pub use rows::is_bag;

use header::Header;
pub(crate) use limits::MOST_NUMBERS;
use limits::too_large;
use rows::{Lost, Rows};

/// One measured run of an arm, in SI units, on a uniform time grid.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct Log {
    /// Where it came from, for messages.
    pub source: String,
    /// Time stamps, s; uniform, not necessarily from 0.
    pub time: Vec<f64>,
    /// Positions, rad or m, `[joint][sample]`.
    pub q: Vec<Vec<f64>>,
    /// Velocities as logged by the drive, `[joint][sample]`; no joints where the log has none.
    pub dq: Vec<Vec<f64>>,
    /// Torques (or what the drive logs in their place), N m or N, `[joint][sample]`.
    pub tau: Vec<Vec<f64>>,
    /// All other channels, in the order of the file.
    pub extra: Vec<Channel>,
    /// What was changed or set aside in reading.
    pub report: Vec<Note>,
    /// Where samples are made up, or a position jumps and stays, s since the start of the log: no row around them is fitted, and no error
    /// counts there.
    pub holes: Vec<Range<f64>>,
    /// Where a joint's torque stands at its largest or smallest value, s since the start of the log, `[joint]`: no row of that joint around
    /// them is fitted unless the model says what a limit takes. No joints where none were looked for, see [`Log::mended`].
    pub clipped: Vec<Vec<Range<f64>>>,
    /// Speeds below which dry friction does not act in full, one a joint, rad/s or m/s; none where they were not looked for: then they are
    /// those that an encoder does not tell apart. See [`Log::with_turn_speeds`].
    pub turn_speeds: Vec<f64>,
    /// What a one in the file's column of each torque was worth, by settings or by a line of units in the file; one where it came from
    /// memory.
    pub tau_units: Vec<f64>,
}

/// A named channel beside position, velocity and torque: a temperature, a current, a reference.
#[derive(Debug, Clone, PartialEq)]
pub struct Channel {
    /// Name as in the header.
    pub name: String,
    /// One value a sample.
    pub values: Vec<f64>,
}

impl Log {
    /// Reads a CSV file, plain or gzip, or with feature `parquet` a Parquet file (told by its first bytes, not by its name), of an arm with `dof` joints.
    /// Bags of ROS 2 are read with feature `mcap` by [`Log::read_as`], which knows what the joints are called.
    ///
    /// The header is `time,q1..qn[,dq1..dqn],tau1..taun[,extra..]` in any order; units are SI. Time stamps that jitter are
    /// resampled to the median step by cubic interpolation, short gaps are filled by straight lines, and the mean stands for
    /// samples that nearly coincide, which [`Log::report`] tells.
    ///
    /// # Errors
    /// [`LogError`] names the file and, where there is one, the line: a header that is missing, incomplete or misspelled, a
    /// field that is no number, a twentieth of the rows with fields that are empty or not finite (fewer count as missing), a
    /// row of the wrong length, time that does not rise (but for rows that are there twice), a gap in time of more than half a second or a twentieth of the log,
    /// too few samples, a sample rate outside 10 Hz .. 100 kHz, a position or torque beyond 1e6 in magnitude, more than 10 000 columns, a
    /// row of more than a million bytes, more numbers than 2 GiB hold.
    ///
    /// # Examples
    /// ```
    /// # use robot_model::log::Log;
    /// let error = Log::read("no-such-log.csv", 6).unwrap_err();
    /// assert!(error.to_string().starts_with("cannot open log `no-such-log.csv`"));
    /// ```
    pub fn read(path: impl AsRef<Path>, dof: usize) -> Result<Self, LogError> {
        Self::read_as(path, &Columns::standard(dof))
    }

    /// Reads a log as [`Log::read`] does, from columns of other names and in other units. A file that has none of them but the
    /// standard ones is read by those, which [`Log::report`] tells.
    ///
    /// # Errors
    /// As [`Log::read`].
    ///
    /// # Examples
    /// A log in degrees:
    /// ```
    /// use robot_model::log::{Columns, Log};
    /// let path = std::env::temp_dir().join("robot-model-read-as.csv");
    /// let rows: String = (0..20).map(|k| format!("{},180,{k}\n", 0.01 * f64::from(k))).collect();
    /// std::fs::write(&path, format!("time,q1,tau1\n{rows}"))?;
    /// let mut columns = Columns::standard(1);
    /// columns.q[0].unit = Some(std::f64::consts::PI / 180.0);
    /// assert_eq!(Log::read_as(&path, &columns)?.q[0][7], std::f64::consts::PI);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn read_as(path: impl AsRef<Path>, columns: &Columns) -> Result<Self, LogError> {
        let (source, file) = Self::open(path.as_ref())?;
        let rows = rows::of_file(&source, file, columns)?;
        Self::from_rows(source, rows, columns, MOST_NUMBERS)
    }

    /// Reads a log as [`Log::read`] does; `source` names it in messages.
    ///
    /// # Errors
    /// As [`Log::read`].
    ///
    /// # Examples
    /// ```
    /// # use robot_model::log::Log;
    /// let mut text = String::from("time,q1,tau1\n");
    /// for k in 0..20 {
    ///     text += &format!("{},0.5,{k}\n", 0.0625 * f64::from(k));
    /// }
    /// let log = Log::from_reader("memory", text.as_bytes(), 1)?;
    /// assert_eq!(log.tau[0][3], 3.0);
    /// assert_eq!(log.rate_hz(), 16.0);
    /// # Ok::<(), robot_model::log::LogError>(())
    /// ```
    pub fn from_reader(
        source: impl Into<String>,
        reader: impl Read,
        dof: usize,
    ) -> Result<Self, LogError> {
        Self::from_reader_as(source, reader, &Columns::standard(dof))
    }

    /// Reads a log as [`Log::read_as`] does; `source` names it in messages.
    ///
    /// # Errors
    /// As [`Log::read`].
    ///
    /// # Examples
    /// ```
    /// use robot_model::log::{Columns, Log};
    /// let rows: String = (0..20).map(|k| format!("{},180,{k}\n", 0.01 * f64::from(k))).collect();
    /// let mut degrees = Columns::standard(1);
    /// degrees.q[0].unit = Some(std::f64::consts::PI / 180.0);
    /// let log = Log::from_reader_as("memory", format!("time,q1,tau1\n{rows}").as_bytes(), &degrees)?;
    /// assert_eq!(log.q[0][7], std::f64::consts::PI);
    /// # Ok::<(), robot_model::log::LogError>(())
    /// ```
    pub fn from_reader_as(
        source: impl Into<String>,
        reader: impl Read,
        columns: &Columns,
    ) -> Result<Self, LogError> {
        let source = source.into();
        let rows = rows::of_reader(&source, reader, columns)?;
        Self::from_rows(source, rows, columns, MOST_NUMBERS)
    }

    fn from_rows(
        source: String,
        mut rows: Box<dyn Rows + '_>,
        columns: &Columns,
        most_numbers: usize,
    ) -> Result<Self, LogError> {
        let header = Header::of(&source, &*rows, columns)?;
        let mut table = rows.table(&header.needed());
        let width = table.columns.len();
        let most = most_numbers / width.max(1);
        if rows.fill(&mut table, most)? {
            return Err(too_large(&source, most as u64, width));
        }
        let notes = [header.notes.clone(), rows.take_notes()].concat();
        Self::from_table(source, table, &header, notes)
    }

    /// A log from samples in memory: `q` and `tau` are `[joint][sample]`, as long as `time`.
    ///
    /// # Errors
    /// As [`Log::read`] for values and time stamps; [`LogError::Lengths`] where the channels are not alike in length.
    ///
    /// # Examples
    /// ```
    /// # use robot_model::log::Log;
    /// let time: Vec<f64> = (0..100).map(|k| 0.01 * f64::from(k)).collect();
    /// let q = vec![time.iter().map(|t| t.sin()).collect()];
    /// let tau = vec![vec![0.0; 100]];
    /// let log = Log::from_samples("a plant", time, q, tau)?;
    /// assert_eq!(log.dof(), 1);
    /// assert_eq!(log.tau_units, [1.0]);
    /// # Ok::<(), robot_model::log::LogError>(())
    /// ```
    pub fn from_samples(
        source: impl Into<String>,
        time: Vec<f64>,
        q: Vec<Vec<f64>>,
        tau: Vec<Vec<f64>>,
    ) -> Result<Self, LogError> {
        let source = source.into();
        if q.len() != tau.len()
            || q.iter()
                .chain(&tau)
                .any(|channel| channel.len() != time.len())
        {
            return Err(LogError::Lengths {
                source_name: source,
            });
        }
        let joints = tau.len();
        let bad = |channel: &Vec<f64>| channel.iter().position(|value| !value.is_finite());
        if let Some(sample) = std::iter::once(&time).chain(&q).chain(&tau).find_map(bad) {
            return Err(LogError::NotFiniteSample {
                source_name: source,
                sample,
            });
        }
        Self {
            source,
            time,
            q,
            dq: Vec::new(),
            tau,
            extra: Vec::new(),
            report: Vec::new(),
            holes: Vec::new(),
            clipped: Vec::new(),
            turn_speeds: Vec::new(),
            tau_units: vec![1.0; joints],
        }
        .finish(None, &Lost::default())
    }

    /// Number of joints.
    ///
    /// # Examples
    /// ```
    /// # use robot_model::log::Log;
    /// let time: Vec<f64> = (0..101).map(|k| 0.02 * f64::from(k)).collect();
    /// let two = || vec![vec![0.0; 101]; 2];
    /// assert_eq!(Log::from_samples("a plant", time, two(), two())?.dof(), 2);
    /// # Ok::<(), robot_model::log::LogError>(())
    /// ```
    #[must_use]
    pub fn dof(&self) -> usize {
        self.q.len()
    }

    /// Sample rate, Hz.
    ///
    /// # Examples
    /// ```
    /// # use robot_model::log::Log;
    /// let time: Vec<f64> = (0..101).map(|k| 0.02 * f64::from(k)).collect();
    /// let log = Log::from_samples("a plant", time, vec![vec![0.0; 101]], vec![vec![0.0; 101]])?;
    /// assert!((log.rate_hz() - 50.0).abs() < 1e-9 && (log.seconds() - 2.0).abs() < 1e-12);
    /// # Ok::<(), robot_model::log::LogError>(())
    /// ```
    #[must_use]
    pub fn rate_hz(&self) -> f64 {
        let last = self.time.len() - 1;
        last as f64 / (self.time[last] - self.time[0])
    }

    /// Length of the log, s.
    ///
    /// # Examples
    /// ```
    /// # use robot_model::log::Log;
    /// let time: Vec<f64> = (0..101).map(|k| 0.02 * f64::from(k)).collect();
    /// let log = Log::from_samples("a plant", time, vec![vec![0.0; 101]], vec![vec![0.0; 101]])?;
    /// assert!((log.seconds() - 2.0).abs() < 1e-12); // of 101 samples
    /// # Ok::<(), robot_model::log::LogError>(())
    /// ```
    #[must_use]
    pub fn seconds(&self) -> f64 {
        self.time[self.time.len() - 1] - self.time[0]
    }

    /// All channels but time.
    fn channels_mut(&mut self) -> impl Iterator<Item = &mut Vec<f64>> {
        let extra = self.extra.iter_mut().map(|channel| &mut channel.values);
        self.q
            .iter_mut()
            .chain(&mut self.dq)
            .chain(&mut self.tau)
            .chain(extra)
    }

    /// Checks the time stamps and makes them uniform; `lines` has one line number a sample, and `lost` what is between them.
    fn finish(mut self, lines: Option<&[u64]>, lost: &Lost) -> Result<Self, LogError> {
        self.check_length()?;
        if !self.extra.is_empty() {
            let names = self
                .extra
                .iter()
                .map(|channel| channel.name.clone())
                .collect();
            self.report.push(Note::ExtraChannels { names });
        }
        self.check_plausible(lines)?;
        let exchanged = exchanged::note(&self);
        self.report.extend(exchanged);
        uniform::make_uniform(&mut self, lines, lost)?;
        // Rows that are there twice count once.
        self.check_length()?;
        self.check_rate()?;
        Ok(self)
    }

    /// A sample as messages name it: by its line in the file where it came from one.
    fn place(&self, sample: usize, lines: Option<&[u64]>) -> String {
        match lines {
            Some(lines) => format!("{}:{}", self.source, lines[sample]),
            None => format!("{}: sample {sample}", self.source),
        }
    }
}

#[cfg(test)]
mod tests;

//! Rows of numbers, whatever kind of file they come from.

use std::fs::File;
use std::io::{Cursor, Read, Seek};

use super::csv::CsvRows;
#[cfg(feature = "mcap")]
use super::mcap::McapRows;
use super::note::Note;
#[cfg(feature = "parquet")]
use super::parquet::ParquetRows;
use super::units::Line;
use super::{Columns, LogError};

/// Rows below a header, read as they are asked for. A kind of files is one implementation, and its first bytes in [`Kind`].
pub(super) trait Rows {
    /// Names of the columns.
    fn names(&self) -> &[String];

    /// The line in which the names stand.
    fn header_line(&self) -> u64 {
        1
    }

    /// What the channels that are wanted are called in a file of this kind.
    fn columns(&self, wanted: &Columns) -> Columns {
        wanted.clone()
    }

    /// The units that a line below the names says.
    fn units(&self) -> Option<&Line> {
        None
    }

    /// What was assumed in reading and is not told yet.
    fn take_notes(&mut self) -> Vec<Note> {
        Vec::new()
    }

    /// Adds rows to a table until it has `most`; false where there are no more.
    fn fill(&mut self, table: &mut Table, most: usize) -> Result<bool, LogError>;

    /// Room for rows, of which some columns have to hold numbers, the first of them the time.
    fn table(&self, needed: &[usize]) -> Table {
        let count = self.names().len();
        let mut is_needed = vec![false; count];
        for &column in needed {
            is_needed[column] = true;
        }
        Table {
            columns: vec![Vec::new(); count],
            is_needed,
            is_number: vec![true; count],
            time: needed.first().copied().unwrap_or_default(),
            is_clock: false,
            lines: Vec::new(),
            lost: Lost::default(),
        }
    }
}

/// Kinds of files that are told by their first bytes; what is none of them is text.
#[derive(Clone, Copy)]
enum Kind {
    Parquet,
    Mcap,
}

/// Whether a file that begins like this is a bag of ROS 2, MCAP.
///
/// # Examples
/// ```
/// use robot_model::log::is_bag;
/// assert!(is_bag(b"\x89MCAP0\r\n") && !is_bag(b"time,q1,tau1\n"));
/// ```
#[must_use]
pub fn is_bag(start: &[u8]) -> bool {
    matches!(Kind::of(start), Some(Kind::Mcap))
}

impl Kind {
    const ALL: [(&'static [u8], Self); 2] =
        [(b"PAR1", Self::Parquet), (b"\x89MCAP0\r\n", Self::Mcap)];

    /// As many bytes as tell all kinds.
    const BYTES: u64 = 8;

    fn of(start: &[u8]) -> Option<Self> {
        let mut all = Self::ALL.iter();
        let found = all.find(|(magic, _)| start.starts_with(magic));
        found.map(|(_, kind)| *kind)
    }

    /// Ends of names, and what files with them are.
    const ENDS: [(&'static str, &'static str); 2] =
        [(".parquet", "a Parquet file"), (".mcap", "an MCAP file")];

    /// Refuses a file that is of no kind and no text, by a name that says of which kind it was.
    fn check_text(source: &str, start: &[u8]) -> Result<(), LogError> {
        let is_text = start
            .iter()
            .all(|byte| byte.is_ascii_graphic() || byte.is_ascii_whitespace());
        let ends = Self::ENDS.iter();
        let mut ends = ends.filter(|(end, _)| !is_text && source.to_lowercase().ends_with(end));
        ends.next().map_or(Ok(()), |(_, what)| {
            Err(LogError::Read {
                source_name: source.to_owned(),
                line: 1,
                reason: format!(
                    "it does not begin like {what}, so it is damaged or another kind of file; write it again, or copy it again as binary"
                ),
            })
        })
    }
}

/// Reads the header of a file, of which no more is in memory at a time than is asked for.
pub(super) fn of_file(
    source: &str,
    mut file: File,
    columns: &Columns,
) -> Result<Box<dyn Rows>, LogError> {
    let start = start(source, &mut file)?;
    let Some(kind) = Kind::of(&start) else {
        Kind::check_text(source, &start)?;
        let whole = Cursor::new(start).chain(file);
        return Ok(Box::new(CsvRows::new(source, whole, columns)?));
    };
    let back = file.rewind();
    back.map_err(|error| unreadable(source, 1, &error))?;
    of_kind(source, kind, Input::File(file), columns)
}

/// Reads the header.
pub(super) fn of_reader<'a>(
    source: &str,
    mut reader: impl Read + 'a,
    columns: &Columns,
) -> Result<Box<dyn Rows + 'a>, LogError> {
    let mut start = start(source, &mut reader)?;
    let Some(kind) = Kind::of(&start) else {
        Kind::check_text(source, &start)?;
        let whole = Cursor::new(start).chain(reader);
        return Ok(Box::new(CsvRows::new(source, whole, columns)?));
    };
    let rest = reader.read_to_end(&mut start);
    rest.map_err(|error| unreadable(source, 1, &error))?;
    of_kind(source, kind, Input::Memory(start), columns)
}

/// What a file that is not read from its start to its end is read from.
#[cfg_attr(
    not(any(feature = "parquet", feature = "mcap")),
    allow(dead_code, reason = "without the features files are refused unread")
)]
pub(super) enum Input {
    File(File),
    Memory(Vec<u8>),
}

#[cfg_attr(
    not(feature = "mcap"),
    allow(
        unused_variables,
        clippy::needless_pass_by_value,
        reason = "without the features files are refused unread"
    )
)]
fn of_kind(
    source: &str,
    kind: Kind,
    input: Input,
    columns: &Columns,
) -> Result<Box<dyn Rows>, LogError> {
    match kind {
        #[cfg(feature = "parquet")]
        Kind::Parquet => Ok(Box::new(ParquetRows::new(source, input)?)),
        #[cfg(not(feature = "parquet"))]
        Kind::Parquet => Err(not_built(source, "a Parquet file", "parquet")),
        #[cfg(feature = "mcap")]
        Kind::Mcap => Ok(Box::new(McapRows::new(source, input, columns)?)),
        #[cfg(not(feature = "mcap"))]
        Kind::Mcap => Err(not_built(source, "an MCAP file", "mcap")),
    }
}

#[cfg(not(all(feature = "parquet", feature = "mcap")))]
fn not_built(source: &str, what: &str, feature: &str) -> LogError {
    LogError::Read {
        source_name: source.to_owned(),
        line: 1,
        reason: format!("it is {what}; build with feature `{feature}`, or save it as CSV"),
    }
}

/// Columns of rows that were read.
#[derive(Debug)]
pub(super) struct Table {
    /// `[column][row]`; where a column holds no numbers, NaN.
    pub columns: Vec<Vec<f64>>,
    /// Columns that have to hold numbers.
    pub is_needed: Vec<bool>,
    /// Columns that hold numbers, as far as rows were read.
    pub is_number: Vec<bool>,
    /// The column of the time.
    pub time: usize,
    /// It has times of day, and holds seconds whatever its unit.
    pub is_clock: bool,
    /// Line of each row.
    pub lines: Vec<u64>,
    /// Rows that are left out.
    pub lost: Lost,
}

/// Rows with fields that are empty, NaN or infinite: they count as missing where they are few.
#[derive(Debug, Default)]
pub(super) struct Lost {
    rows: usize,
    /// Line of the last.
    last: u64,
    /// Line of the first of those that follow one another, and what is wrong with it.
    runs: Vec<(u64, LogError)>,
}

/// The share of all rows from which on they are too many.
const MANY: f64 = 0.05;

/// Places at which rows may be missing: of a file with more of them no log is made, however long it is.
const MOST_RUNS: usize = 10_000;

impl Lost {
    /// Adds the row in a line behind all others.
    pub fn push(&mut self, line: u64, error: LogError) {
        let goes_on = self.rows > 0 && line == self.last + 1;
        if !goes_on && self.runs.len() <= MOST_RUNS {
            self.runs.push((line, error));
        }
        self.rows += 1;
        self.last = line;
    }

    /// How many there are and what is wrong with the first, beside so many sound rows.
    ///
    /// # Errors
    /// That, where there are many.
    pub fn few(&self, sound: usize) -> Result<Option<(usize, &LogError)>, LogError> {
        let Some((_, first)) = self.runs.first() else {
            return Ok(None);
        };
        let (rows, of) = (self.rows, sound + self.rows);
        if self.runs.len() <= MOST_RUNS && (rows as f64) < MANY * of as f64 {
            return Ok(Some((rows, first)));
        }
        Err(match rows {
            1 => first.clone(),
            _ => LogError::ManyLost {
                first: Box::new(first.clone()),
                rows,
                of,
            },
        })
    }

    /// What is wrong with the first between two lines of sound rows that follow one another.
    pub fn between(&self, before: u64, behind: u64) -> Option<&LogError> {
        let mut runs = self.runs.iter();
        let inside = runs.find(|(line, _)| (before..behind).contains(line));
        inside.map(|(_, error)| error)
    }
}

/// The first bytes.
fn start(source: &str, reader: &mut impl Read) -> Result<Vec<u8>, LogError> {
    let mut start = Vec::new();
    let read = reader.take(Kind::BYTES).read_to_end(&mut start);
    read.map_err(|error| unreadable(source, 1, &error))?;
    Ok(start)
}

/// What may be done about a file that cannot be decoded.
pub(super) const DAMAGED: &str = "the file is damaged: copy it again, as binary, or write it again";

/// A file that cannot be decoded; `line` is the last one that could.
pub(super) fn damaged(source: &str, line: u64, error: &dyn std::error::Error) -> LogError {
    LogError::Read {
        source_name: source.to_owned(),
        line,
        reason: format!("{error}; {DAMAGED}"),
    }
}

pub(super) fn unreadable(source: &str, line: u64, error: &dyn std::error::Error) -> LogError {
    LogError::Read {
        source_name: source.to_owned(),
        line,
        reason: error.to_string(),
    }
}

impl Table {
    /// The first rows, of which the last `overlap` stay.
    pub fn split(&mut self, count: usize, overlap: usize) -> Self {
        let stays = count.saturating_sub(overlap);
        let mut first = |column: &mut Vec<f64>| {
            let first = column[..count].to_vec();
            column.drain(..stays);
            first
        };
        Self {
            columns: self.columns.iter_mut().map(&mut first).collect(),
            is_needed: self.is_needed.clone(),
            is_number: self.is_number.clone(),
            time: self.time,
            is_clock: self.is_clock,
            lost: std::mem::take(&mut self.lost),
            lines: {
                let lines = self.lines[..count].to_vec();
                self.lines.drain(..stays);
                lines
            },
        }
    }
}

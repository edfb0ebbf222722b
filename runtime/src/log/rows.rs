//! Rows of numbers, whatever kind of file they come from.

use std::fs::File;
use std::io::{Cursor, Read, Seek};

use super::LogError;
use super::csv::CsvRows;
#[cfg(feature = "parquet")]
use super::parquet::ParquetRows;

/// First and last bytes of a Parquet file.
const PARQUET: [u8; 4] = *b"PAR1";

/// Rows below a header, read as they are asked for.
pub(super) enum Rows<'a> {
    Csv(Box<CsvRows<'a>>),
    #[cfg(feature = "parquet")]
    Parquet(Box<ParquetRows>),
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

impl Lost {
    /// Adds the row in a line behind all others.
    pub fn push(&mut self, line: u64, error: LogError) {
        let goes_on = self.rows > 0 && line == self.last + 1;
        if !goes_on {
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
        match self.runs.first() {
            Some((_, first)) if self.rows as f64 >= MANY * (sound + self.rows) as f64 => {
                Err(first.clone())
            }
            first => Ok(first.map(|(_, first)| (self.rows, first))),
        }
    }

    /// What is wrong with the first between two lines of sound rows that follow one another.
    pub fn between(&self, before: u64, behind: u64) -> Option<&LogError> {
        let mut runs = self.runs.iter();
        let inside = runs.find(|(line, _)| (before..behind).contains(line));
        inside.map(|(_, error)| error)
    }
}

impl<'a> Rows<'a> {
    /// Reads the header of a file, of which no more is in memory at a time than is asked for.
    pub fn of_file(source: &str, mut file: File) -> Result<Self, LogError> {
        let start = start(source, &mut file)?;
        if start == PARQUET {
            let back = file.rewind();
            back.map_err(|error| unreadable(source, 1, &error))?;
            return Self::parquet(source, Input::File(file));
        }
        let whole = Cursor::new(start).chain(file);
        Ok(Self::Csv(Box::new(CsvRows::new(source, whole)?)))
    }

    /// Reads the header.
    pub fn new(source: &str, mut reader: impl Read + 'a) -> Result<Self, LogError> {
        let mut start = start(source, &mut reader)?;
        if start == PARQUET {
            let rest = reader.read_to_end(&mut start);
            rest.map_err(|error| unreadable(source, 1, &error))?;
            return Self::parquet(source, Input::Memory(start));
        }
        let whole = Cursor::new(start).chain(reader);
        Ok(Self::Csv(Box::new(CsvRows::new(source, whole)?)))
    }

    #[cfg(feature = "parquet")]
    fn parquet(source: &str, input: Input) -> Result<Self, LogError> {
        let rows = match input {
            Input::File(file) => ParquetRows::of_file(source, file)?,
            Input::Memory(bytes) => ParquetRows::of_memory(source, bytes)?,
        };
        Ok(Self::Parquet(Box::new(rows)))
    }

    #[cfg(not(feature = "parquet"))]
    fn parquet(source: &str, _: Input) -> Result<Self, LogError> {
        Err(LogError::Read {
            source_name: source.to_owned(),
            line: 1,
            reason: "it is a Parquet file; build with feature `parquet`, or save it as CSV"
                .to_owned(),
        })
    }

    /// Names of the columns.
    pub fn names(&self) -> &[String] {
        match self {
            Self::Csv(rows) => &rows.names,
            #[cfg(feature = "parquet")]
            Self::Parquet(rows) => &rows.names,
        }
    }

    /// Room for rows, of which some columns have to hold numbers.
    pub fn table(&self, needed: impl Iterator<Item = usize>) -> Table {
        let count = self.names().len();
        let mut is_needed = vec![false; count];
        needed.for_each(|column| is_needed[column] = true);
        Table {
            columns: vec![Vec::new(); count],
            is_needed,
            is_number: vec![true; count],
            lines: Vec::new(),
            lost: Lost::default(),
        }
    }

    /// Adds rows to a table until it has `most`; false where there are no more.
    pub fn fill(&mut self, table: &mut Table, most: usize) -> Result<bool, LogError> {
        match self {
            Self::Csv(rows) => rows.fill(table, most),
            #[cfg(feature = "parquet")]
            Self::Parquet(rows) => rows.fill(table, most),
        }
    }
}

/// What a Parquet file is read from; without the feature it is refused unread.
#[cfg_attr(not(feature = "parquet"), allow(dead_code))]
enum Input {
    File(File),
    Memory(Vec<u8>),
}

/// The first bytes.
fn start(source: &str, reader: &mut impl Read) -> Result<Vec<u8>, LogError> {
    let mut start = Vec::with_capacity(PARQUET.len());
    let read = reader.take(PARQUET.len() as u64).read_to_end(&mut start);
    read.map_err(|error| unreadable(source, 1, &error))?;
    Ok(start)
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
            lost: std::mem::take(&mut self.lost),
            lines: {
                let lines = self.lines[..count].to_vec();
                self.lines.drain(..stays);
                lines
            },
        }
    }
}

//! CSV text, plain or gzip, to columns of finite numbers.

use std::io::{Cursor, Read};

use csv::{ByteRecord, ReaderBuilder, Trim};
use flate2::read::MultiGzDecoder;

use super::LogError;

/// First bytes of a gzip member.
const GZIP: [u8; 2] = [0x1f, 0x8b];

/// Rows below a header, read as they are asked for; every row has one finite number per column.
pub(super) struct Rows<'a> {
    source: String,
    reader: csv::Reader<Box<dyn Read + 'a>>,
    record: ByteRecord,
    line: u64,
    /// Names of the columns.
    pub names: Vec<String>,
}

/// Columns of rows that were read.
#[derive(Debug)]
pub(super) struct Table {
    /// `[column][row]`.
    pub columns: Vec<Vec<f64>>,
    /// Line of each row.
    pub lines: Vec<u64>,
}

impl<'a> Rows<'a> {
    /// Reads the header.
    pub fn new(source: &str, mut reader: impl Read + 'a) -> Result<Self, LogError> {
        let mut start = Vec::with_capacity(GZIP.len());
        let peeked = reader
            .by_ref()
            .take(GZIP.len() as u64)
            .read_to_end(&mut start);
        peeked.map_err(|error| unreadable(source, 1, &error))?;
        let packed = start == GZIP;
        let whole = Cursor::new(start).chain(reader);
        let text: Box<dyn Read + 'a> = if packed {
            Box::new(MultiGzDecoder::new(whole))
        } else {
            Box::new(whole)
        };
        let mut reader = ReaderBuilder::new()
            .has_headers(false)
            .flexible(true)
            .trim(Trim::All)
            .from_reader(text);
        let mut record = ByteRecord::new();
        let mut line = 1;
        if !next(source, &mut reader, &mut record, &mut line)? {
            return Err(LogError::Empty {
                source_name: source.to_owned(),
            });
        }
        let names = record
            .iter()
            .map(|field| {
                Ok(text_of(source, line, field)?
                    .trim_start_matches('\u{feff}')
                    .to_owned())
            })
            .collect::<Result<Vec<_>, LogError>>()?;
        if names.len() == 1 && names[0].contains([';', '\t', '|', ' ']) {
            return Err(LogError::Separator {
                source_name: source.to_owned(),
            });
        }
        if names.iter().all(|name| name.parse::<f64>().is_ok()) {
            return Err(LogError::NoHeader {
                source_name: source.to_owned(),
            });
        }
        Ok(Self {
            source: source.to_owned(),
            reader,
            record,
            line,
            names,
        })
    }

    /// Room for rows.
    pub fn table(&self) -> Table {
        Table {
            columns: vec![Vec::new(); self.names.len()],
            lines: Vec::new(),
        }
    }

    /// Adds rows to a table until it has `most`; false where there are no more.
    pub fn fill(&mut self, table: &mut Table, most: usize) -> Result<bool, LogError> {
        while table.lines.len() < most {
            let (source, record) = (&self.source, &mut self.record);
            if !next(source, &mut self.reader, record, &mut self.line)? {
                return Ok(false);
            }
            if record.len() != self.names.len() {
                let (found, expected) = (record.len(), self.names.len());
                return Err(LogError::ColumnCount {
                    source_name: source.clone(),
                    line: self.line,
                    found,
                    expected,
                });
            }
            let columns = table.columns.iter_mut().zip(&self.names);
            for (field, (column, name)) in record.iter().zip(columns) {
                column.push(number(source, self.line, name, field)?);
            }
            table.lines.push(self.line);
        }
        Ok(true)
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
            lines: {
                let lines = self.lines[..count].to_vec();
                self.lines.drain(..stays);
                lines
            },
        }
    }
}

/// Moves on to the next record; `line` follows it. False at the end.
fn next(
    source: &str,
    reader: &mut csv::Reader<impl Read>,
    record: &mut ByteRecord,
    line: &mut u64,
) -> Result<bool, LogError> {
    let more = reader
        .read_byte_record(record)
        .map_err(|error| unreadable(source, *line, &error))?;
    if let Some(position) = record.position().filter(|_| more) {
        *line = position.line();
    }
    Ok(more)
}

fn number(source: &str, line: u64, column: &str, field: &[u8]) -> Result<f64, LogError> {
    let text = text_of(source, line, field)?.to_owned();
    match text.parse::<f64>() {
        Ok(value) if value.is_finite() => Ok(value),
        Ok(_) => Err(LogError::NotFinite {
            source_name: source.to_owned(),
            line,
            column: column.to_owned(),
            text,
        }),
        Err(_) => Err(LogError::NotANumber {
            source_name: source.to_owned(),
            line,
            column: column.to_owned(),
            text,
        }),
    }
}

fn text_of<'a>(source: &str, line: u64, field: &'a [u8]) -> Result<&'a str, LogError> {
    std::str::from_utf8(field).map_err(|_| LogError::NotText {
        source_name: source.to_owned(),
        line,
    })
}

fn unreadable(source: &str, line: u64, error: &dyn std::error::Error) -> LogError {
    LogError::Read {
        source_name: source.to_owned(),
        line,
        reason: error.to_string(),
    }
}

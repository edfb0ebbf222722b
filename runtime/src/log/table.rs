//! CSV text, plain or gzip, to columns of finite numbers.

use std::io::{Cursor, Read};

use csv::{ByteRecord, ReaderBuilder, Trim};
use flate2::read::MultiGzDecoder;

use super::LogError;

/// First bytes of a gzip member.
const GZIP: [u8; 2] = [0x1f, 0x8b];

/// A header and the columns below it.
#[derive(Debug)]
pub(super) struct Table {
    /// Names of the columns.
    pub names: Vec<String>,
    /// `[column][row]`.
    pub columns: Vec<Vec<f64>>,
    /// Line of each row.
    pub lines: Vec<u64>,
}

/// Reads a whole table; every row has one finite number per column.
pub(super) fn read(source: &str, mut reader: impl Read) -> Result<Table, LogError> {
    let mut start = Vec::with_capacity(GZIP.len());
    let peeked = reader
        .by_ref()
        .take(GZIP.len() as u64)
        .read_to_end(&mut start);
    peeked.map_err(|error| unreadable(source, 1, &error))?;
    let packed = start == GZIP;
    let whole = Cursor::new(start).chain(reader);
    if packed {
        read_text(source, MultiGzDecoder::new(whole))
    } else {
        read_text(source, whole)
    }
}

fn read_text(source: &str, text: impl Read) -> Result<Table, LogError> {
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
    let mut columns = vec![Vec::new(); names.len()];
    let mut lines = Vec::new();
    while next(source, &mut reader, &mut record, &mut line)? {
        if record.len() != names.len() {
            let (found, expected) = (record.len(), names.len());
            return Err(LogError::ColumnCount {
                source_name: source.to_owned(),
                line,
                found,
                expected,
            });
        }
        for ((field, column), name) in record.iter().zip(&mut columns).zip(&names) {
            column.push(number(source, line, name, field)?);
        }
        lines.push(line);
    }
    Ok(Table {
        names,
        columns,
        lines,
    })
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

//! CSV text, plain or gzip, to columns of finite numbers; rows that lack some are left out.

use std::io::{Cursor, Read};

use csv::{ByteRecord, ReaderBuilder, Trim};
use flate2::read::MultiGzDecoder;

use super::LogError;
use super::rows::{Rows, Table, unreadable};

/// First bytes of a gzip member.
const GZIP: [u8; 2] = [0x1f, 0x8b];

/// Rows of a CSV text, read as they are asked for.
pub(super) struct CsvRows<'a> {
    source: String,
    reader: csv::Reader<Box<dyn Read + 'a>>,
    record: ByteRecord,
    line: u64,
    is_at_first: bool,
    names: Vec<String>,
}

impl<'a> CsvRows<'a> {
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
            is_at_first: true,
            names,
        })
    }
}

impl Rows for CsvRows<'_> {
    fn names(&self) -> &[String] {
        &self.names
    }

    fn fill(&mut self, table: &mut Table, most: usize) -> Result<bool, LogError> {
        let mut row = Vec::with_capacity(self.names.len());
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
            row.clear();
            let mut lost = None;
            for (k, (field, name)) in record.iter().zip(&self.names).enumerate() {
                let value = number(source, self.line, name, field);
                if self.is_at_first && !table.is_needed[k] {
                    table.is_number[k] = value.is_ok();
                }
                row.push(match value {
                    _ if !table.is_number[k] => f64::NAN,
                    Ok(value) => value,
                    Err(error) if is_missing(field, &error) => {
                        lost.get_or_insert(error);
                        f64::NAN
                    }
                    Err(error) => return Err(error),
                });
            }
            self.is_at_first = false;
            if let Some(error) = lost {
                table.lost.push(self.line, error);
                continue;
            }
            for (column, value) in table.columns.iter_mut().zip(&row) {
                column.push(*value);
            }
            table.lines.push(self.line);
        }
        Ok(true)
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

/// Whether a field has no value, which is no slip of whoever wrote it.
fn is_missing(field: &[u8], error: &LogError) -> bool {
    field.is_empty() || matches!(error, LogError::NotFinite { .. })
}

fn text_of<'a>(source: &str, line: u64, field: &'a [u8]) -> Result<&'a str, LogError> {
    std::str::from_utf8(field).map_err(|_| LogError::NotText {
        source_name: source.to_owned(),
        line,
    })
}

//! CSV text, plain or gzip, to columns of finite numbers; rows that lack some are left out.

mod opening;

use std::cell::Cell;
use std::io::{self, Cursor, Read};
use std::rc::Rc;

use csv::{ByteRecord, ReaderBuilder, Trim};
use flate2::read::MultiGzDecoder;

use super::LogError;
use super::limits::LONGEST_ROW;
use super::rows::{Rows, Table, damaged, unreadable};
use super::words;
use opening::Opening;

/// First bytes of a gzip member.
const GZIP: [u8; 2] = [0x1f, 0x8b];

/// Text that ends with an error inside a row that does not: what is unpacked may be of any length, and a row is in memory as a whole.
struct Bounded<'a> {
    text: Box<dyn Read + 'a>,
    /// Bytes since the row before was done, but for those that were read ahead.
    count: Rc<Cell<u64>>,
}

impl Read for Bounded<'_> {
    fn read(&mut self, into: &mut [u8]) -> io::Result<usize> {
        if self.count.get() > LONGEST_ROW {
            return Err(io::ErrorKind::FileTooLarge.into());
        }
        let read = self.text.read(into)?;
        self.count.set(self.count.get() + read as u64);
        Ok(read)
    }
}

/// Records of a text, each of bounded length.
struct Records<'a> {
    source: String,
    reader: csv::Reader<Bounded<'a>>,
    count: Rc<Cell<u64>>,
    record: ByteRecord,
    /// Lines above the header.
    above: u64,
    /// Of the record.
    line: u64,
}

/// Rows of a CSV text, read as they are asked for.
pub(super) struct CsvRows<'a> {
    records: Records<'a>,
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
        let mut records = Records::new(source, Opening::of(source, text)?);
        if !records.next()? {
            return Err(LogError::Empty {
                source_name: source.to_owned(),
            });
        }
        let names = records
            .record
            .iter()
            .map(|field| {
                Ok(text_of(source, records.line, field)?
                    .trim_start_matches('\u{feff}')
                    .to_owned())
            })
            .collect::<Result<Vec<_>, LogError>>()?;
        if names.len() == 1 && names[0].contains(['|', ' ']) {
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
            records,
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
            if !self.records.next()? {
                return Ok(false);
            }
            let (source, record, line) = (
                &self.records.source,
                &self.records.record,
                self.records.line,
            );
            if record.len() != self.names.len() {
                let (found, expected) = (record.len(), self.names.len());
                return Err(LogError::ColumnCount {
                    source_name: source.clone(),
                    line,
                    found,
                    expected,
                });
            }
            row.clear();
            let mut lost = None;
            for (k, (field, name)) in record.iter().zip(&self.names).enumerate() {
                let value = number(source, line, name, field);
                let is_missing = matches!(&value, Err(error) if is_missing(field, error));
                if self.is_at_first && !table.is_needed[k] {
                    table.is_number[k] = value.is_ok() || is_missing;
                }
                row.push(match value {
                    _ if !table.is_number[k] => f64::NAN,
                    Ok(value) => value,
                    // What is logged now and then does not cost the rows between.
                    Err(_) if is_missing && !table.is_needed[k] => f64::NAN,
                    Err(error) if is_missing => {
                        lost.get_or_insert(error);
                        f64::NAN
                    }
                    Err(error) => return Err(error),
                });
            }
            self.is_at_first = false;
            if let Some(error) = lost {
                table.lost.push(line, error);
                continue;
            }
            for (column, value) in table.columns.iter_mut().zip(&row) {
                column.push(*value);
            }
            table.lines.push(line);
        }
        Ok(true)
    }
}

impl<'a> Records<'a> {
    fn new(source: &str, opening: Opening<'a>) -> Self {
        let count = Rc::default();
        let bounded = Bounded {
            text: opening.text,
            count: Rc::clone(&count),
        };
        let mut options = ReaderBuilder::new();
        options.has_headers(false).flexible(true).trim(Trim::All);
        options.delimiter(opening.separator);
        Self {
            source: source.to_owned(),
            reader: options.from_reader(bounded),
            count,
            record: ByteRecord::new(),
            above: opening.above,
            line: opening.above + 1,
        }
    }

    /// Moves on to the next record; `line` follows it. False at the end.
    fn next(&mut self) -> Result<bool, LogError> {
        self.count.set(0);
        let begins = self.above + self.reader.position().line();
        let read = self.reader.read_byte_record(&mut self.record);
        let more = read.map_err(|error| {
            if self.count.get() > LONGEST_ROW {
                return LogError::LongRow {
                    source_name: self.source.clone(),
                    line: begins,
                    most: LONGEST_ROW,
                };
            }
            damaged(&self.source, self.line, &error)
        })?;
        if let Some(position) = self.record.position().filter(|_| more) {
            self.line = self.above + position.line();
        }
        Ok(more)
    }
}

fn number(source: &str, line: u64, column: &str, field: &[u8]) -> Result<f64, LogError> {
    let text = text_of(source, line, field)?;
    let told = || (source.to_owned(), column.to_owned(), words::field(text));
    match text.parse::<f64>() {
        Ok(value) if value.is_finite() => Ok(value),
        Ok(_) => {
            let (source_name, column, text) = told();
            Err(LogError::NotFinite {
                source_name,
                line,
                column,
                text,
            })
        }
        Err(_) => {
            let (source_name, column, text) = told();
            Err(LogError::NotANumber {
                source_name,
                line,
                column,
                text,
            })
        }
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

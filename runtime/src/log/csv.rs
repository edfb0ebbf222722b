//! CSV text, plain or gzip, to columns of finite numbers; rows that lack some are left out.

mod clock;
mod ending;
mod layout;
mod lines;
mod number;
mod opening;
mod separator;
mod two_times;
mod utf16;

use std::cell::Cell;
use std::io::{self, Cursor, Read};
use std::rc::Rc;

use csv::{ByteRecord, ReaderBuilder, Trim};
use flate2::read::MultiGzDecoder;

use super::limits::LONGEST_ROW;
use super::note::Note;
use super::rows::{Rows, Table, damaged, unreadable};
use super::units::Line;
use super::{Columns, LogError, TextError, foreign, words};
use clock::{Clock, Stamp};
use ending::{Bounded, Ending};
use layout::Layout;
use number::Numbers;
use opening::Opening;
use separator::BLANKS;
use two_times::TwoTimes;
use utf16::FromUtf16;

/// First bytes of a gzip member.
const GZIP: [u8; 2] = [0x1f, 0x8b];

/// Records of a text, each of bounded length.
struct Records<'a> {
    source: String,
    reader: csv::Reader<Bounded<'a>>,
    count: Rc<Cell<u64>>,
    record: ByteRecord,
    ending: Ending,
    /// Columns are separated by any number of blanks.
    is_blank: bool,
    /// Lines above the header.
    above: u64,
    /// Of the record.
    line: u64,
}

/// Rows of a CSV text, read as they are asked for.
pub(super) struct CsvRows<'a> {
    records: Records<'a>,
    /// The first record is read already.
    is_ahead: bool,
    is_at_first: bool,
    names: Vec<String>,
    /// In which they stand.
    header_line: u64,
    layout: Layout,
    numbers: Numbers,
    /// The time of day that the first row has in place of a number.
    clock: Option<Clock>,
    /// The last of the columns is their sum.
    two_times: Option<TwoTimes>,
    units: Option<Line>,
    above: Option<Note>,
}

/// A text that may be packed, or in UTF-16.
fn decoded<'a>(source: &str, reader: impl Read + 'a) -> Result<Box<dyn Read + 'a>, LogError> {
    let mut reader = reader;
    let packed = begin(&mut reader, GZIP.len()).map_err(|error| unreadable(source, 1, &error))?;
    let is_packed = packed == GZIP;
    let whole = Cursor::new(packed).chain(reader);
    let mut text: Box<dyn Read + 'a> = if is_packed {
        Box::new(MultiGzDecoder::new(whole))
    } else {
        Box::new(whole)
    };
    let start = begin(&mut text, foreign::BYTES).map_err(|error| damaged(source, 1, &error))?;
    foreign::check(source, &start)?;
    let order = start.first_chunk().copied().and_then(utf16::order);
    Ok(match order {
        Some(order) => {
            let rest = Cursor::new(start[2..].to_vec()).chain(text);
            Box::new(FromUtf16::new(rest, order))
        }
        None => Box::new(Cursor::new(start).chain(text)),
    })
}

impl<'a> CsvRows<'a> {
    /// Reads the header, and units below it.
    pub fn new(source: &str, reader: impl Read + 'a, columns: &Columns) -> Result<Self, LogError> {
        let opening = Opening::of(source, decoded(source, reader)?, columns)?;
        let (separator, above) = (opening.separator, opening.note.clone());
        let mut records = Records::new(source, opening);
        if !records.next()? {
            return Err(LogError::Empty {
                source_name: source.to_owned(),
            });
        }
        let mut names = names(source, &records)?;
        let layout = Layout::of(&mut names);
        let header_line = records.line;
        check_header(source, header_line, &names)?;
        let is_ahead = records.next()?;
        let fields = layout.named(&records.record);
        let is_number =
            |text: &str| number::lenient(text).is_some() || Stamp::parse(text).is_some();
        let units = Line::of(fields, names.len(), records.line, is_number).filter(|_| is_ahead);
        let time = &columns.time;
        let two_times = TwoTimes::of(&names)
            .filter(|_| !names.contains(&time.name) && (time.worth() - 1.0).abs() == 0.0);
        if two_times.is_some() {
            names.push(time.name.clone());
        }
        Ok(Self {
            is_ahead: is_ahead && units.is_none(),
            is_at_first: true,
            records,
            names,
            header_line,
            layout,
            numbers: Numbers::of(separator),
            clock: None,
            two_times,
            units,
            above,
        })
    }

    /// Adds a record to a table.
    fn add(&mut self, table: &mut Table, row: &mut Vec<f64>) -> Result<(), LogError> {
        let (source, line) = (&self.records.source, self.records.line);
        let fields = self.layout.columns(source, line, &self.records.record);
        // Bytes that are no text have separators and line ends among them, and are what is to be mended.
        let fields = fields.map_err(|error| self.records.no_text().unwrap_or(error))?;
        row.clear();
        let mut lost = None;
        for (k, (field, name)) in fields.zip(&self.names).enumerate() {
            let mut value = text_of(source, line, field).and_then(|text| {
                let of_clock = if k == table.time {
                    self.clock.as_mut().map(|clock| clock.seconds(text))
                } else {
                    None
                };
                let value = of_clock.unwrap_or_else(|| self.numbers.value(text));
                match value {
                    Some(value) if value.is_finite() => Ok(value),
                    Some(_) => Err(LogError::NotFinite {
                        source_name: source.clone(),
                        line,
                        column: name.clone(),
                        text: words::field(text),
                    }),
                    None => Err(self.numbers.refusal(source, line, name, text)),
                }
            });
            if self.is_at_first && k == table.time && value.is_err() {
                self.clock = Clock::begin(&String::from_utf8_lossy(field));
                table.is_clock = self.clock.is_some();
                value = if table.is_clock { Ok(0.0) } else { value };
            }
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
            return Ok(());
        }
        if let Some(two) = &mut self.two_times {
            row.push(two.time(row));
        }
        for (column, value) in table.columns.iter_mut().zip(&*row) {
            column.push(*value);
        }
        table.lines.push(line);
        Ok(())
    }
}

impl Rows for CsvRows<'_> {
    fn names(&self) -> &[String] {
        &self.names
    }

    fn header_line(&self) -> u64 {
        self.header_line
    }

    fn units(&self) -> Option<&Line> {
        self.units.as_ref()
    }

    fn take_notes(&mut self) -> Vec<Note> {
        let two = self.two_times.as_mut();
        let notes = [
            self.above.take(),
            self.layout.note(),
            two.and_then(TwoTimes::note),
            self.clock.as_mut().and_then(Clock::note),
            self.numbers.note(),
            self.records.ending.note(),
        ];
        notes.into_iter().flatten().collect()
    }

    fn fill(&mut self, table: &mut Table, most: usize) -> Result<bool, LogError> {
        if let Some(two) = self
            .two_times
            .as_ref()
            .filter(|_| table.is_needed[table.time])
        {
            for column in [two.seconds, two.nanoseconds] {
                table.is_needed[column] = true;
            }
        }
        let mut row = Vec::with_capacity(self.names.len());
        while table.lines.len() < most {
            let is_ahead = std::mem::take(&mut self.is_ahead);
            if !is_ahead && !self.records.next()? {
                return Ok(false);
            }
            self.add(table, &mut row)
                .map_err(|error| self.records.cut(error))?;
        }
        Ok(true)
    }
}

impl<'a> Records<'a> {
    fn new(source: &str, opening: Opening<'a>) -> Self {
        let (count, ending) = (Rc::default(), Ending::default());
        let bounded = Bounded {
            text: opening.text,
            count: Rc::clone(&count),
            last: ending.last_byte(),
        };
        let mut options = ReaderBuilder::new();
        options.has_headers(false).flexible(true).trim(Trim::All);
        options.delimiter(opening.separator);
        Self {
            source: source.to_owned(),
            reader: options.from_reader(bounded),
            count,
            record: ByteRecord::new(),
            ending,
            is_blank: opening.separator == BLANKS,
            above: opening.above,
            line: opening.above + 1,
        }
    }

    /// What is said of the first field of the record that is no text.
    fn no_text(&self) -> Option<LogError> {
        self.record.iter().find_map(|field| {
            let text = text_of(&self.source, self.line, field);
            let byte = field.iter().copied().find(|byte| is_control(*byte));
            let control = byte.map(|byte| not_text(&self.source, self.line, field, byte));
            text.err().or(control)
        })
    }

    /// The same error, which says of a short row whether it is the last one.
    fn cut(&mut self, mut error: LogError) -> LogError {
        if let LogError::ColumnCount {
            found,
            expected,
            is_cut,
            ..
        } = &mut error
        {
            *is_cut = found < expected && matches!(self.next(), Ok(false));
        }
        error
    }

    /// Moves on to the next record; `line` follows it. False at the end.
    fn next(&mut self) -> Result<bool, LogError> {
        self.count.set(0);
        let begins = self.above + self.reader.position().line();
        let read = self.reader.read_byte_record(&mut self.record);
        let more = read.map_err(|error| {
            if self.count.get() > LONGEST_ROW {
                return LogError::from(TextError::LongRow {
                    source_name: self.source.clone(),
                    line: begins,
                    most: LONGEST_ROW,
                });
            }
            damaged(&self.source, self.line, &error)
        })?;
        if let Some(position) = self.record.position().filter(|_| more) {
            self.line = self.above + position.line();
        }
        if self.is_blank {
            let fields = self.record.iter().filter(|field| !field.is_empty());
            self.record = fields.collect();
        }
        if more {
            self.ending.passes(&self.record, self.line);
        }
        Ok(more)
    }
}

/// Names of the columns as the header has them.
fn names(source: &str, records: &Records) -> Result<Vec<String>, LogError> {
    let names = records.record.iter().map(|field| {
        if let Some(byte) = field.iter().copied().find(|byte| is_control(*byte)) {
            return Err(not_text(source, records.line, field, byte));
        }
        let name = text_of(source, records.line, field)?;
        Ok(name.trim_start_matches('\u{feff}').to_owned())
    });
    names.collect()
}

const fn is_control(byte: u8) -> bool {
    byte.is_ascii_control() && !byte.is_ascii_whitespace()
}

/// Refuses what is no header of several columns.
fn check_header(source: &str, line: u64, names: &[String]) -> Result<(), LogError> {
    let is_number = |name: &String| number::lenient(name).is_some() || Stamp::parse(name).is_some();
    if names.iter().all(is_number) {
        return Err(TextError::NoHeader {
            source_name: source.to_owned(),
            line,
        }
        .into());
    }
    if names[0].starts_with(['{', '[']) {
        return Err(TextError::Json {
            source_name: source.to_owned(),
            line,
        }
        .into());
    }
    if let [name] = names {
        return Err(TextError::Separator {
            source_name: source.to_owned(),
            line,
            header: words::field(name),
        }
        .into());
    }
    Ok(())
}

/// Whether a field has no value, which is no slip of whoever wrote it.
fn is_missing(field: &[u8], error: &LogError) -> bool {
    field.is_empty() || matches!(error, LogError::NotFinite { .. })
}

fn text_of<'a>(source: &str, line: u64, field: &'a [u8]) -> Result<&'a str, LogError> {
    std::str::from_utf8(field).map_err(|error| {
        let byte = field.get(error.valid_up_to()).copied();
        not_text(source, line, field, byte.unwrap_or_default())
    })
}

fn not_text(source: &str, line: u64, field: &[u8], byte: u8) -> LogError {
    TextError::NotText {
        source_name: source.to_owned(),
        line,
        byte,
        text: words::field(&String::from_utf8_lossy(field)),
        is_binary: byte >= 0x80 && field.iter().any(|byte| is_control(*byte)),
    }
    .into()
}

/// The first bytes.
fn begin(reader: &mut impl Read, count: usize) -> io::Result<Vec<u8>> {
    let mut start = Vec::with_capacity(count);
    reader.take(count as u64).read_to_end(&mut start)?;
    Ok(start)
}

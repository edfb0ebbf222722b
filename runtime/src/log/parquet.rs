//! Parquet files to columns of finite numbers, some thousand rows at a time: of a group's columns one page each is unpacked, however
//! many rows the group has (many writers make groups of a million).
//!
//! Columns of whole and real numbers are read; time stamps are whole numbers, whose unit the schema has. Lists, texts and decimals hold no numbers here.

mod stamps;
mod typed;

use std::panic::{self, AssertUnwindSafe};

use bytes::Bytes;
use parquet::basic::{Compression, ConvertedType};
use parquet::column::page::{Page, PageMetadata, PageReader};
use parquet::column::reader::{ColumnReader, get_column_reader};
use parquet::errors::ParquetError;
use parquet::file::reader::{FileReader, RowGroupReader, SerializedFileReader};

use super::LogError;
use super::limits;
use super::rows::{Input, Rows, Table, damaged};
use super::units::Line;
use typed::numbers;

/// Rows that are read at a time at most.
const BATCH: usize = 16_384;

/// Rows of a Parquet file.
pub(super) struct ParquetRows {
    source: String,
    reader: Box<dyn FileReader>,
    /// Names of the columns; those of nested ones have points in them.
    names: Vec<String>,
    /// Units of columns that the schema has as times.
    units: Option<Line>,
    next_group: usize,
    /// The group that is being read.
    group: Group,
    /// Rows handed on so far.
    rows: u64,
}

/// A group whose rows are read as they are asked for.
#[derive(Default)]
struct Group {
    rows: usize,
    /// Rows read so far.
    read: usize,
    /// None where they hold no numbers.
    columns: Vec<Option<Box<dyn Numbers>>>,
}

/// Numbers of a column of a group, from the first row to the last.
trait Numbers {
    /// So many that come next, NaN where there is none; fewer at the end.
    fn next(&mut self, count: usize) -> Result<Vec<f64>, ParquetError>;
}

impl Group {
    /// So many rows of each column that come next; nothing where it holds no numbers.
    fn next(&mut self, count: usize) -> Result<Vec<Option<Vec<f64>>>, ParquetError> {
        let Self {
            rows,
            read,
            columns,
        } = self;
        let end = *read + count;
        let next = |column: &mut Option<Box<dyn Numbers>>| {
            let Some(column) = column else {
                return Ok(None);
            };
            let numbers = column.next(count)?;
            if numbers.len() < count {
                let found = *read + numbers.len();
                return Err(ParquetError::General(format!(
                    "a column of {found} rows in a group of {rows}"
                )));
            }
            if end == *rows && !column.next(1)?.is_empty() {
                return Err(ParquetError::General(format!(
                    "a column of more than {rows} rows in a group of {rows}"
                )));
            }
            Ok(Some(numbers))
        };
        let numbers = columns.iter_mut().map(next).collect();
        self.read = end;
        numbers
    }
}

impl ParquetRows {
    /// Reads the schema.
    pub fn new(source: &str, input: Input) -> Result<Self, LogError> {
        match input {
            Input::File(file) => Self::of(source, guarded(|| SerializedFileReader::new(file))),
            Input::Memory(bytes) => {
                let bytes = Bytes::from(bytes);
                Self::of(source, guarded(|| SerializedFileReader::new(bytes)))
            }
        }
    }

    fn of(
        source: &str,
        reader: Result<impl FileReader + 'static, ParquetError>,
    ) -> Result<Self, LogError> {
        let reader = reader.map_err(|error| refused(source, 1, error))?;
        let schema = reader.metadata().file_metadata().schema_descr();
        limits::check_columns(source, 1, schema.num_columns())?;
        let columns = schema.columns().iter();
        Ok(Self {
            source: source.to_owned(),
            names: columns
                .map(|column| column.path().string().trim().to_owned())
                .collect(),
            units: stamps::units(schema),
            reader: Box::new(reader),
            next_group: 0,
            group: Group::default(),
            rows: 0,
        })
    }

    /// So many rows of the group that come next.
    fn hand_on(&mut self, table: &mut Table, count: usize) -> Result<(), LogError> {
        let read = guarded(|| self.group.next(count));
        let group = read.map_err(|error| refused(&self.source, self.rows + 1, error))?;
        // Of each row the first column that has no number in it.
        let mut bad: Vec<Option<usize>> = vec![None; count];
        for (k, column) in group.iter().enumerate() {
            let values = column.as_deref();
            if self.rows == 0 && !table.is_needed[k] {
                table.is_number[k] = values.is_some();
            }
            // What is logged now and then does not cost the rows between.
            if !table.is_number[k] || (!table.is_needed[k] && values.is_some()) {
                continue;
            }
            let Some(values) = values else {
                return Err(LogError::Read {
                    source_name: self.source.clone(),
                    line: 1,
                    reason: format!(
                        "column `{}` is not numeric: write it as a column of doubles",
                        self.names[k]
                    ),
                });
            };
            for (row, _) in values.iter().enumerate().filter(|(_, v)| !v.is_finite()) {
                bad[row].get_or_insert(k);
            }
        }
        for (k, column) in group.iter().enumerate() {
            let sound = (0..count).zip(&bad).filter(|(_, bad)| bad.is_none());
            let value = |(row, _)| match column {
                Some(values) if table.is_number[k] => values[row],
                _ => f64::NAN,
            };
            table.columns[k].extend(sound.map(value));
        }
        for (row, column) in bad.iter().enumerate() {
            let line = self.rows + row as u64 + 1;
            match column {
                Some(k) => {
                    let error = self.no_number(*k, row, "null or NaN");
                    table.lost.push(line, error);
                }
                None => table.lines.push(line),
            }
        }
        self.rows += count as u64;
        Ok(())
    }

    fn no_number(&self, column: usize, row: usize, text: &str) -> LogError {
        LogError::NotANumber {
            source_name: self.source.clone(),
            line: self.rows + row as u64 + 1,
            column: self.names[column].clone(),
            text: text.to_owned(),
        }
    }

    /// Opens the next group that has rows; false at the end.
    fn open_group(&mut self) -> Result<bool, LogError> {
        while self.next_group < self.reader.num_row_groups() {
            let open = guarded(|| {
                let group = self.reader.get_row_group(self.next_group)?;
                let rows = usize::try_from(group.metadata().num_rows()).map_err(|_| {
                    ParquetError::General("a group of less than no rows".to_owned())
                })?;
                let columns = (0..self.names.len()).map(|k| column(&*group, k, rows));
                Ok(Group {
                    rows,
                    read: 0,
                    columns: columns.collect::<Result<_, _>>()?,
                })
            });
            self.group = open.map_err(|error| refused(&self.source, self.rows + 1, error))?;
            self.next_group += 1;
            if self.group.rows > 0 {
                return Ok(true);
            }
        }
        Ok(false)
    }
}

impl Rows for ParquetRows {
    fn names(&self) -> &[String] {
        &self.names
    }

    fn units(&self) -> Option<&Line> {
        self.units.as_ref()
    }

    fn fill(&mut self, table: &mut Table, most: usize) -> Result<bool, LogError> {
        while table.lines.len() < most {
            let left = self.group.rows - self.group.read;
            if left == 0 {
                if !self.open_group()? {
                    return Ok(false);
                }
                continue;
            }
            let room = most - table.lines.len();
            self.hand_on(table, left.min(room).min(BATCH))?;
        }
        Ok(true)
    }
}

/// Reads from a file that may be damaged: the crate that decodes it panics at some damages, which are errors here.
fn guarded<T>(read: impl FnOnce() -> Result<T, ParquetError>) -> Result<T, ParquetError> {
    let read = panic::catch_unwind(AssertUnwindSafe(read));
    read.unwrap_or_else(|_| Err(ParquetError::General("the file is damaged".to_owned())))
}

/// A file that is written in another way than is read here, or is damaged.
fn refused(source: &str, line: u64, error: ParquetError) -> LogError {
    match error {
        ParquetError::NYI(reason) => LogError::Read {
            source_name: source.to_owned(),
            line,
            reason,
        },
        error => damaged(source, line, &error),
    }
}

/// That pages are packed with what is read here.
fn check_codec(codec: Compression) -> Result<(), ParquetError> {
    let name = match codec {
        Compression::UNCOMPRESSED
        | Compression::SNAPPY
        | Compression::GZIP(_)
        | Compression::ZSTD(_) => return Ok(()),
        Compression::BROTLI(_) => "Brotli",
        Compression::LZO => "LZO",
        Compression::LZ4 | Compression::LZ4_RAW => "LZ4",
    };
    Err(ParquetError::NYI(format!(
        "its pages are packed with {name}, which is not read here; write it with `snappy`, `gzip`, `zstd` or uncompressed, or save it as CSV"
    )))
}

/// Pages of a column. Room is made for as many values as a page says it has, so none may say more than the column has rows, and a
/// dictionary no more than it has bytes. What a page unpacks to is below 2 GiB, as the format has it.
struct Bounded {
    pages: Box<dyn PageReader>,
    rows: usize,
}

impl Iterator for Bounded {
    type Item = Result<Page, ParquetError>;

    fn next(&mut self) -> Option<Self::Item> {
        self.get_next_page().transpose()
    }
}

impl PageReader for Bounded {
    fn get_next_page(&mut self) -> Result<Option<Page>, ParquetError> {
        let page = self.pages.get_next_page()?;
        let (values, most) = match &page {
            Some(page @ Page::DictionaryPage { buf, .. }) => (page.num_values(), buf.len()),
            Some(page) => (page.num_values(), self.rows),
            None => return Ok(None),
        };
        if usize::try_from(values).is_ok_and(|values| values <= most) {
            return Ok(page);
        }
        Err(ParquetError::General(format!(
            "a page claims to have {values} values, but the most are {most}"
        )))
    }

    fn peek_next_page(&mut self) -> Result<Option<PageMetadata>, ParquetError> {
        self.pages.peek_next_page()
    }

    fn skip_next_page(&mut self) -> Result<(), ParquetError> {
        self.pages.skip_next_page()
    }
}

/// Numbers of a column of a group; nothing where it holds something else.
fn column(
    group: &dyn RowGroupReader,
    place: usize,
    rows: usize,
) -> Result<Option<Box<dyn Numbers>>, ParquetError> {
    let metadata = group.metadata().column(place);
    let about = metadata.column_descr_ptr();
    if about.max_rep_level() > 0 {
        return Ok(None);
    }
    // Time stamps are whole numbers; decimals and dates are none.
    let is_unsigned = match about.converted_type() {
        ConvertedType::UINT_8
        | ConvertedType::UINT_16
        | ConvertedType::UINT_32
        | ConvertedType::UINT_64 => true,
        ConvertedType::NONE
        | ConvertedType::INT_8
        | ConvertedType::INT_16
        | ConvertedType::INT_32
        | ConvertedType::INT_64
        | ConvertedType::TIME_MILLIS
        | ConvertedType::TIME_MICROS
        | ConvertedType::TIMESTAMP_MILLIS
        | ConvertedType::TIMESTAMP_MICROS => false,
        _ => return Ok(None),
    };
    check_codec(metadata.compression())?;
    let present = about.max_def_level();
    let pages = Bounded {
        pages: group.get_column_page_reader(place)?,
        rows,
    };
    Ok(Some(match get_column_reader(about, Box::new(pages)) {
        ColumnReader::Int32ColumnReader(reader) if is_unsigned => {
            numbers(reader, present, |value| f64::from(value.cast_unsigned()))
        }
        ColumnReader::Int32ColumnReader(reader) => numbers(reader, present, f64::from),
        ColumnReader::Int64ColumnReader(reader) if is_unsigned => {
            numbers(reader, present, |value| value.cast_unsigned() as f64)
        }
        ColumnReader::Int64ColumnReader(reader) => numbers(reader, present, |value| value as f64),
        ColumnReader::FloatColumnReader(reader) => numbers(reader, present, f64::from),
        ColumnReader::DoubleColumnReader(reader) => numbers(reader, present, |value| value),
        _ => return Ok(None),
    }))
}

#[cfg(test)]
mod tests;

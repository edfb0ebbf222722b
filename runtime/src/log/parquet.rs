//! Parquet files to columns of finite numbers, a row group at a time.
//!
//! Columns of whole and real numbers are read; time stamps are whole numbers in the file's unit. Lists, texts and decimals hold no numbers here.

use std::panic::{self, AssertUnwindSafe};

use bytes::Bytes;
use parquet::basic::{Compression, ConvertedType};
use parquet::column::page::{Page, PageMetadata, PageReader};
use parquet::column::reader::{ColumnReader, ColumnReaderImpl, get_column_reader};
use parquet::data_type::DataType;
use parquet::errors::ParquetError;
use parquet::file::reader::{FileReader, RowGroupReader, SerializedFileReader};

use super::LogError;
use super::limits::{self, MOST_NUMBERS};
use super::rows::{Input, Rows, Table, unreadable};

/// Rows of a Parquet file.
pub(super) struct ParquetRows {
    source: String,
    reader: Box<dyn FileReader>,
    /// Names of the columns; those of nested ones have points in them.
    names: Vec<String>,
    next_group: usize,
    /// Columns of the group that is being handed on, `[column][row]`; none where they hold no numbers.
    group: Vec<Option<Vec<f64>>>,
    next_row: usize,
    rows_of_group: usize,
    /// Rows handed on so far.
    rows: u64,
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
        let reader = reader.map_err(|error| unreadable(source, 1, &error))?;
        let schema = reader.metadata().file_metadata().schema_descr();
        limits::check_columns(source, schema.num_columns())?;
        let columns = schema.columns().iter();
        Ok(Self {
            source: source.to_owned(),
            names: columns
                .map(|column| column.path().string().trim().to_owned())
                .collect(),
            reader: Box::new(reader),
            next_group: 0,
            group: Vec::new(),
            next_row: 0,
            rows_of_group: 0,
            rows: 0,
        })
    }

    /// Rows of the group up to `end`.
    fn hand_on(&mut self, table: &mut Table, end: usize) -> Result<(), LogError> {
        let rows = self.next_row..end;
        // Of each row the first column that has no number in it.
        let mut bad: Vec<Option<usize>> = vec![None; rows.len()];
        for (k, column) in self.group.iter().enumerate() {
            let values = column.as_ref().map(|column| &column[rows.clone()]);
            let has_first =
                values.is_some_and(|values| values.first().is_some_and(|v| v.is_finite()));
            if self.rows == 0 && !table.is_needed[k] {
                table.is_number[k] = has_first;
            }
            if !table.is_number[k] {
                continue;
            }
            let Some(values) = values else {
                return Err(self.no_number(k, 0, "no whole or real number"));
            };
            for (row, _) in values.iter().enumerate().filter(|(_, v)| !v.is_finite()) {
                bad[row].get_or_insert(k);
            }
        }
        for (k, column) in self.group.iter().enumerate() {
            let sound = rows.clone().zip(&bad).filter(|(_, bad)| bad.is_none());
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
                    let error = self.no_number(*k, row, "a null or no finite number");
                    table.lost.push(line, error);
                }
                None => table.lines.push(line),
            }
        }
        self.rows += rows.len() as u64;
        self.next_row = end;
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

    /// What a group says of itself is not what it has: it must not be believed before there is room for it.
    fn check_room(&self, group: usize) -> Result<(), LogError> {
        let rows = self.reader.metadata().row_group(group).num_rows();
        // Fewer than none are refused with the group.
        let rows = u64::try_from(rows).unwrap_or(0);
        let columns = self.names.len();
        let is_room = rows
            .checked_mul(columns as u64)
            .is_some_and(|numbers| numbers <= MOST_NUMBERS as u64);
        if is_room {
            return Ok(());
        }
        Err(limits::too_large(&self.source, rows, columns))
    }

    /// Reads the next group that has rows; false at the end.
    fn read_group(&mut self) -> Result<bool, LogError> {
        while self.next_group < self.reader.num_row_groups() {
            let damaged = |error: ParquetError| unreadable(&self.source, self.rows + 1, &error);
            let place = self.next_group;
            self.check_room(place)?;
            self.next_group += 1;
            self.next_row = 0;
            let read = guarded(|| {
                let group = self.reader.get_row_group(place)?;
                let rows = usize::try_from(group.metadata().num_rows()).map_err(|_| {
                    ParquetError::General("a group of less than no rows".to_owned())
                })?;
                let columns = (0..self.names.len()).map(|k| column(&*group, k, rows));
                Ok((rows, columns.collect::<Result<_, _>>()?))
            });
            (self.rows_of_group, self.group) = read.map_err(damaged)?;
            if self.rows_of_group > 0 {
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

    fn fill(&mut self, table: &mut Table, most: usize) -> Result<bool, LogError> {
        while table.lines.len() < most {
            if self.next_row == self.rows_of_group && !self.read_group()? {
                return Ok(false);
            }
            let room = most - table.lines.len();
            let end = self.rows_of_group.min(self.next_row + room);
            self.hand_on(table, end)?;
        }
        Ok(true)
    }
}

/// Reads from a file that may be damaged: the crate that decodes it panics at some damages, which are errors here.
fn guarded<T>(read: impl FnOnce() -> Result<T, ParquetError>) -> Result<T, ParquetError> {
    let read = panic::catch_unwind(AssertUnwindSafe(read));
    read.unwrap_or_else(|_| Err(ParquetError::General("the file is damaged".to_owned())))
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
    Err(ParquetError::General(format!(
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
            "a page that is said to have {values} values, where {most} are the most"
        )))
    }

    fn peek_next_page(&mut self) -> Result<Option<PageMetadata>, ParquetError> {
        self.pages.peek_next_page()
    }

    fn skip_next_page(&mut self) -> Result<(), ParquetError> {
        self.pages.skip_next_page()
    }
}

/// Numbers of a column of a group, NaN where it has none; nothing where it holds something else.
fn column(
    group: &dyn RowGroupReader,
    place: usize,
    rows: usize,
) -> Result<Option<Vec<f64>>, ParquetError> {
    let metadata = group.metadata().column(place);
    let about = metadata.column_descr_ptr();
    if about.max_rep_level() > 0 {
        return Ok(None);
    }
    // Time stamps are whole numbers in whatever unit the file has; decimals and dates are no numbers.
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
    let values = match get_column_reader(about, Box::new(pages)) {
        ColumnReader::Int32ColumnReader(reader) if is_unsigned => {
            all(reader, rows, present, |value| {
                f64::from(value.cast_unsigned())
            })
        }
        ColumnReader::Int32ColumnReader(reader) => all(reader, rows, present, f64::from),
        ColumnReader::Int64ColumnReader(reader) if is_unsigned => {
            all(reader, rows, present, |value| value.cast_unsigned() as f64)
        }
        ColumnReader::Int64ColumnReader(reader) => all(reader, rows, present, |value| value as f64),
        ColumnReader::FloatColumnReader(reader) => all(reader, rows, present, f64::from),
        ColumnReader::DoubleColumnReader(reader) => all(reader, rows, present, |value| value),
        _ => return Ok(None),
    }?;
    Ok(Some(values))
}

/// All rows of a column; levels of definition below `present` are nulls.
fn all<T: DataType>(
    mut reader: ColumnReaderImpl<T>,
    rows: usize,
    present: i16,
    number: impl Fn(T::T) -> f64,
) -> Result<Vec<f64>, ParquetError>
where
    T::T: Copy,
{
    let (mut levels, mut values) = (Vec::new(), Vec::new());
    let mut read = 0;
    loop {
        let (more, ..) = reader.read_records(rows - read, Some(&mut levels), None, &mut values)?;
        read += more;
        if more == 0 || read == rows {
            break;
        }
    }
    if reader
        .read_records(1, Some(&mut levels), None, &mut values)?
        .0
        > 0
    {
        return Err(ParquetError::General(format!(
            "a column of more than {rows} rows in a group of {rows}"
        )));
    }
    let mut numbers = values.into_iter().map(number);
    let numbers: Vec<f64> = if present == 0 {
        numbers.collect()
    } else {
        let of_level = |level: &i16| {
            let is_there = *level == present;
            is_there
                .then(|| numbers.next())
                .flatten()
                .unwrap_or(f64::NAN)
        };
        levels.iter().map(of_level).collect()
    };
    if numbers.len() == rows {
        return Ok(numbers);
    }
    Err(ParquetError::General(format!(
        "a column of {} rows in a group of {rows}",
        numbers.len()
    )))
}

#[cfg(test)]
mod tests;

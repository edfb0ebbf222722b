//! Columns of a text that are none: row numbers without a name in front, and what ends of lines with a separator make.

use csv::ByteRecord;

use super::super::LogError;
use super::super::note::Note;
use super::number;

/// Which fields of a row are columns.
#[derive(Debug)]
pub(super) struct Layout {
    /// A column in front without a name.
    has_index: bool,
    /// Columns with names.
    width: usize,
    /// Fields of the header without a name behind them.
    unnamed: usize,
    /// Such fields of the rows, as the first has them: they are empty.
    tail: Option<usize>,
    /// The last number in front.
    index: Option<f64>,
    note: Option<Note>,
}

impl Layout {
    /// Takes names of no columns away.
    pub fn of(names: &mut Vec<String>) -> Self {
        let mut unnamed = 0;
        while names.len() > 1 && names.last().is_some_and(String::is_empty) {
            names.pop();
            unnamed += 1;
        }
        let has_index = names.len() > 1 && names[0].is_empty();
        if has_index {
            names.remove(0);
        }
        Self {
            has_index,
            width: names.len(),
            unnamed,
            tail: None,
            index: None,
            note: has_index.then_some(Note::RowNumbers),
        }
    }

    /// Fields below the names, whatever else there is.
    pub fn named<'a>(&self, record: &'a ByteRecord) -> impl Iterator<Item = &'a [u8]> + use<'a> {
        let skipped = usize::from(self.has_index);
        record.iter().skip(skipped).take(self.width)
    }

    /// The fields of a row that are columns.
    ///
    /// # Errors
    /// [`LogError::ColumnCount`]; [`LogError::UnnamedColumn`] where a field without a name is none of the row's number or nothing.
    pub fn columns<'a>(
        &mut self,
        source: &str,
        line: u64,
        record: &'a ByteRecord,
    ) -> Result<impl Iterator<Item = &'a [u8]> + use<'a>, LogError> {
        let expected = usize::from(self.has_index) + self.width;
        let found = record.len();
        let unnamed = |column: usize| LogError::UnnamedColumn {
            source_name: source.to_owned(),
            line,
            column: column + 1,
        };
        let in_tail = (expected..found).find(|k| !record[*k].is_empty());
        let is_wide = match self.tail {
            Some(tail) => found == expected + tail,
            None => found >= expected,
        };
        match in_tail {
            Some(column) if found <= expected + self.unnamed => return Err(unnamed(column)),
            None if is_wide => self.tail = Some(found - expected),
            _ => {
                return Err(LogError::ColumnCount {
                    source_name: source.to_owned(),
                    line,
                    found,
                    expected: expected + self.tail.unwrap_or_default(),
                    is_cut: false,
                });
            }
        }
        if self.has_index && !self.counts(&record[0]) {
            return Err(unnamed(0));
        }
        Ok(self.named(record))
    }

    /// Whether a field in front is no column: a number of the row above that of the one before, or nothing.
    fn counts(&mut self, field: &[u8]) -> bool {
        if field.is_empty() {
            return self.index.is_none();
        }
        let number = number::lenient(&String::from_utf8_lossy(field));
        let number = number.filter(|number| number.fract() == 0.0);
        let is_next = number.is_some_and(|own| self.index.is_none_or(|last| own > last));
        self.index = number;
        is_next
    }

    /// What is assumed, once.
    pub fn note(&mut self) -> Option<Note> {
        self.note.take()
    }
}

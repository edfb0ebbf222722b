//! Columns of one type of numbers.

use parquet::column::reader::ColumnReaderImpl;
use parquet::data_type::DataType;
use parquet::errors::ParquetError;

use super::Numbers;

/// A column whose values are made numbers; levels of definition below `present` are nulls.
struct Typed<T: DataType, N> {
    reader: ColumnReaderImpl<T>,
    present: i16,
    number: N,
}

pub(super) fn numbers<T: DataType, N: Fn(T::T) -> f64 + 'static>(
    reader: ColumnReaderImpl<T>,
    present: i16,
    number: N,
) -> Box<dyn Numbers>
where
    T::T: Copy,
{
    Box::new(Typed {
        reader,
        present,
        number,
    })
}

impl<T: DataType, N: Fn(T::T) -> f64> Numbers for Typed<T, N>
where
    T::T: Copy,
{
    fn next(&mut self, count: usize) -> Result<Vec<f64>, ParquetError> {
        let (mut levels, mut values) = (Vec::new(), Vec::new());
        let mut read = 0;
        while read < count {
            let (more, ..) =
                self.reader
                    .read_records(count - read, Some(&mut levels), None, &mut values)?;
            if more == 0 {
                break;
            }
            read += more;
        }
        let mut numbers = values.into_iter().map(&self.number);
        if self.present == 0 {
            return Ok(numbers.collect());
        }
        let of_level = |level: i16| {
            let is_there = level == self.present;
            is_there
                .then(|| numbers.next())
                .flatten()
                .unwrap_or(f64::NAN)
        };
        Ok(levels.into_iter().map(of_level).collect())
    }
}

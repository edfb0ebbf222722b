//! Units of the columns that a schema has as times.

use parquet::basic::{ConvertedType, LogicalType, TimeUnit};
use parquet::schema::types::{ColumnDescriptor, SchemaDescriptor};

use super::super::units::Line;

/// A word for each column that has one; none where no column has.
pub(super) fn units(schema: &SchemaDescriptor) -> Option<Line> {
    let words = schema.columns().iter().map(|column| unit(column));
    Line::of_schema(words.collect())
}

/// The unit of a time.
fn unit(column: &ColumnDescriptor) -> &'static str {
    let logical = match column.logical_type_ref() {
        Some(LogicalType::Timestamp(time) | LogicalType::Time(time)) => Some(time.unit),
        _ => None,
    };
    match (logical, column.converted_type()) {
        (Some(TimeUnit::MILLIS), _)
        | (None, ConvertedType::TIMESTAMP_MILLIS | ConvertedType::TIME_MILLIS) => "ms",
        (Some(TimeUnit::MICROS), _)
        | (None, ConvertedType::TIMESTAMP_MICROS | ConvertedType::TIME_MICROS) => "us",
        (Some(TimeUnit::NANOS), _) => "ns",
        _ => "",
    }
}

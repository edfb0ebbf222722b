//! How much of a log is taken. A file may hold, unpack to, or claim more than any arm says; what does not fit is refused before memory ends.

use super::LogError;

/// Columns of a log. An arm of forty joints with ten channels each has four hundred.
pub(super) const MOST_COLUMNS: usize = 10_000;

/// Bytes of a row of text, a hundred for each of the columns that a log may have.
pub(super) const LONGEST_ROW: u64 = 100 * MOST_COLUMNS as u64;

/// Numbers in memory at a time, 2 GiB of them. A log of fifty columns at 1 kHz comes to that in an hour and a half.
pub(super) const MOST_NUMBERS: usize = 1 << 28;

/// Refuses files with more columns than a log has.
///
/// # Errors
/// [`LogError::TooManyColumns`]
pub(super) fn check_columns(source: &str, found: usize) -> Result<(), LogError> {
    if found <= MOST_COLUMNS {
        return Ok(());
    }
    Err(LogError::TooManyColumns {
        source_name: source.to_owned(),
        found,
        most: MOST_COLUMNS,
    })
}

/// What is said of rows that do not fit into memory.
pub(super) fn too_large(source: &str, rows: u64, columns: usize) -> LogError {
    LogError::TooLarge {
        source_name: source.to_owned(),
        rows,
        columns,
    }
}

//! What can be wrong with the text of a log.

use thiserror::Error;

use super::super::words::{field, list};

/// What a byte that is no text stands in, and how the file becomes a text that is read.
fn not_text(source_name: &str, text: &str, byte: u8, is_binary: bool) -> String {
    if is_binary {
        return format!(
            "byte 0x{byte:02x} begins binary data: the file is damaged, or none of text; copy it again, or remove the rows from here on"
        );
    }
    let way_out = match byte {
        0 => convert(source_name, "utf16"),
        0x80.. => convert(source_name, "latin1"),
        _ => "no text contains such a byte: name the file that has the numbers".to_owned(),
    };
    format!("byte 0x{byte:02x} in `{text}` is not UTF-8 text; {way_out}")
}

fn convert(source_name: &str, encoding: &str) -> String {
    format!(
        "save the log as CSV in UTF-8, or convert it: `iconv -f {encoding} -t utf8 {source_name} > utf8.csv`"
    )
}

/// Why a text is no table of numbers. `source_name` is the file, `line` counts from 1.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum TextError {
    /// Numbers stand where the header should.
    #[error(
        "{source_name}:{line}: the log has no header; write `time,q1,..,tau1,..` as a line above its numbers"
    )]
    NoHeader {
        /// The file.
        source_name: String,
        /// The first line of numbers.
        line: u64,
    },
    /// Text without a line end where rows have one.
    #[error(
        "{source_name}:{line}: the row is longer than {most} bytes; end every row with a line end, and close every quotation mark"
    )]
    LongRow {
        /// The file.
        source_name: String,
        /// The line in which it begins.
        line: u64,
        /// The most that are taken.
        most: u64,
    },
    /// The text is JSON.
    #[error(
        "{source_name}:{line}: this looks like JSON, and logs are CSV (plain or gzip), Parquet or MCAP; parameter files go behind `--parameters`"
    )]
    Json {
        /// The file.
        source_name: String,
        /// Its first line.
        line: u64,
    },
    /// The header has one field.
    #[error(
        "{source_name}:{line}: the header `{header}` is one column; write one name per column, separated by `,`, `;`, `|`, tabs or blanks"
    )]
    Separator {
        /// The file.
        source_name: String,
        /// Line of the header.
        line: u64,
        /// What it says.
        header: String,
    },
    /// Lines above the header that may be columns, too.
    #[error(
        "{source_name}:{line}: both this line and line {header} above the rows may be the header; remove the lines above the header, or \
         begin each with `#`"
    )]
    Above {
        /// The file.
        source_name: String,
        /// The line that may name the columns.
        line: u64,
        /// The line that names the columns of the rows.
        header: u64,
    },
    /// Lines between the header and the numbers that are not one of units.
    #[error(
        "{source_name}:{line}: the header is line {header}, and only one line of units may follow it before the numbers; remove the others, \
         such as this one"
    )]
    Between {
        /// The file.
        source_name: String,
        /// The line, or one of several.
        line: u64,
        /// The line that names the columns.
        header: u64,
    },
    /// Bytes that are no text.
    #[error(
        "{source_name}:{line}: {}",
        not_text(source_name, text, *.byte, *.is_binary)
    )]
    NotText {
        /// The file.
        source_name: String,
        /// Line of the first such bytes.
        line: u64,
        /// The first of them.
        byte: u8,
        /// The field that has it.
        text: String,
        /// Whether the field has control characters beside it, as text in no encoding has.
        is_binary: bool,
    },
    /// A line of words below the names that are no units of their columns.
    #[error(
        "{source_name}:{line}: the line below the header has no numbers, and `{text}` is not a unit of column `{}`; write one of {}, or \
         remove the line and give units in the spec's `log`, or in its settings{hint}",
        field(column),
        list(known)
    )]
    Unit {
        /// The file.
        source_name: String,
        /// Its line.
        line: u64,
        /// Its column.
        column: String,
        /// The field.
        text: String,
        /// Units that may stand there.
        known: Vec<String>,
        /// What else to do, where there is more.
        hint: &'static str,
    },
    /// A decimal comma beside decimal points, or the other way round.
    #[error(
        "{source_name}:{line}: `{text}` in column `{}` is not a number: decimals above use a {mark}; write all with a point",
        field(column)
    )]
    MixedDecimals {
        /// The file.
        source_name: String,
        /// Its line.
        line: u64,
        /// Its column.
        column: String,
        /// The field.
        text: String,
        /// What stands before the decimals of others.
        mark: &'static str,
    },
}

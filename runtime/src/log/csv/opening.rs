//! Where a text's header is, and what separates its columns: `numpy.savetxt` writes the header as a comment, spreadsheets write
//! semicolons, test rigs write what they know above it.

use std::cmp::Ordering;
use std::io::Read;

use super::super::note::Note;
use super::super::rows::damaged;
use super::super::words;
use super::super::{Columns, LogError, TextError};
use super::lines::Lines;
use super::separator;
use super::{clock, number};

/// What comments begin with, in `NumPy`, in MATLAB, and in languages of programs.
const MARKS: [&[u8]; 3] = [b"#", b"%", b"//"];

/// Lines of comments that are looked through.
const MOST_COMMENTS: usize = 1000;

/// Lines of other text that are looked through.
const MOST_REMARKS: usize = 100;

/// A text from its header on.
pub(super) struct Opening<'a> {
    pub text: Box<dyn Read + 'a>,
    /// Lines before the header.
    pub above: u64,
    /// What stands between columns; blanks are any number of them.
    pub separator: u8,
    /// Lines that were passed over, and are no comments.
    pub note: Option<Note>,
}

impl<'a> Opening<'a> {
    /// Leaves out comments above the header. The header is the last of them where numbers follow at once.
    pub fn of(source: &str, text: Box<dyn Read + 'a>, columns: &Columns) -> Result<Self, LogError> {
        let mut lines = Lines::of(text);
        let (mut number, mut told, mut comment) = (0, None, None);
        while let Some(line) = lines.get(number).filter(|_| number < MOST_COMMENTS) {
            if number == 0 && separator::said(line).is_some() {
                told = separator::said(line);
            } else if let Some(rest) = unmarked(line) {
                comment = Some((number, rest.to_vec()));
            } else if !line.is_empty() {
                break;
            }
            number += 1;
        }
        if let Some(error) = lines.error_at_once() {
            return Err(damaged(source, 1, &error));
        }
        let row = lines.get(number).unwrap_or_default();
        if let Some((of_comment, mut header)) = comment
            && of_comment + 1 == number
            && is_row_of(&header, row, told)
        {
            let separator = told.unwrap_or_else(|| separator::of(&header));
            header.push(b'\n');
            return Ok(Self {
                text: lines.from(of_comment, Some(header)),
                above: of_comment as u64,
                separator,
                note: None,
            });
        }
        let first = number;
        let number = below_remarks(source, &mut lines, first, told, columns)?;
        let note = (number > first).then(|| Note::Above {
            lines: number - first,
            first: words::field(&String::from_utf8_lossy(
                lines.get(first).unwrap_or_default(),
            )),
            header: number as u64 + 1,
        });
        let header = lines.get(number).unwrap_or_default();
        Ok(Self {
            separator: told.unwrap_or_else(|| separator::of(header)),
            above: number as u64,
            text: lines.from(number, None),
            note,
        })
    }
}

/// The line of the header, which is the first or stands below others: remarks such as `robot: UR5` or `robot,UR5`, and groups of columns
/// such as `,joint 1,,joint 2`.
///
/// # Errors
/// [`TextError::Above`] where what stands above the header may name its columns, too, [`TextError::Between`] where it surely does.
fn below_remarks(
    source: &str,
    lines: &mut Lines,
    first: usize,
    told: Option<u8>,
    columns: &Columns,
) -> Result<usize, LogError> {
    let mut line = |number: usize| lines.get(number).map(<[u8]>::to_vec);
    let mut above: Vec<Vec<u8>> = Vec::new();
    for number in first..first + MOST_REMARKS {
        let (Some(own), Some(next)) = (line(number), line(number + 1)) else {
            break;
        };
        // Units between names and numbers.
        let mut is_above_units = || {
            let third = line(number + 2).unwrap_or_default();
            is_header(&next)
                && is_row_of(&next, &third, told)
                && names_columns_of(&own, &next, told, columns)
        };
        if is_header(&own) && (is_row_of(&own, &next, told) || is_above_units()) {
            let mut above = above.iter().enumerate();
            let rival = above.find(|(_, line)| names_columns_of(line, &own, told, columns));
            let Some((above, line)) = rival else {
                return Ok(number);
            };
            let [rival, header] = [first + above, number].map(|line| line as u64 + 1);
            let source_name = source.to_owned();
            let [of_rival, of_own] =
                [line, &own].map(|line| asked(&fields(line, separator_of(&own, told)), columns));
            return Err(if of_rival > of_own {
                TextError::Between {
                    source_name,
                    line: header,
                    header: rival,
                }
            } else {
                TextError::Above {
                    source_name,
                    line: rival,
                    header,
                }
            }
            .into());
        }
        if number == first && starts_with_number(&own) {
            break;
        }
        above.push(own);
    }
    Ok(first)
}

/// Whether a line may name the columns of another below it: more of those that are asked for, or as many of them, a name for each column
/// and none twice.
fn names_columns_of(line: &[u8], other: &[u8], told: Option<u8>, columns: &Columns) -> bool {
    let separator = separator_of(other, told);
    let [own, others] = [line, other].map(|line| fields(line, separator));
    let full = |fields: &[&[u8]]| fields.iter().filter(|field| !field.is_empty()).count();
    let mut distinct = own.clone();
    distinct.retain(|name| !name.is_empty());
    distinct.sort_unstable();
    distinct.dedup();
    let is_whole = distinct.len() == full(&own) && full(&own) >= full(&others);
    let may_name = match asked(&own, columns).cmp(&asked(&others, columns)) {
        Ordering::Less => false,
        Ordering::Equal => is_whole,
        Ordering::Greater => true,
    };
    may_name && is_header(line) && is_as_wide(line, other, told)
}

/// How many fields are names that are asked for.
fn asked(fields: &[&[u8]], columns: &Columns) -> usize {
    let is_asked = |field: &&&[u8]| columns.all().any(|own| own.name.as_bytes() == **field);
    fields.iter().filter(is_asked).count()
}

/// What separates the columns of a header where the file does not say it.
fn separator_of(header: &[u8], told: Option<u8>) -> u8 {
    told.unwrap_or_else(|| separator::of(header))
}

/// Fields of a line without the quotes around them.
fn fields(line: &[u8], separator: u8) -> Vec<&[u8]> {
    let fields = separator::fields(line, separator).into_iter();
    let bare = fields.map(|field| {
        let behind = field.strip_prefix(b"\"");
        let inner = behind.and_then(|behind| behind.strip_suffix(b"\""));
        inner.unwrap_or(field).trim_ascii()
    });
    bare.collect()
}

/// What a comment says. A line that begins with a semicolon and has no other is one, too: it is no row of columns.
fn unmarked(content: &[u8]) -> Option<&[u8]> {
    let rest = MARKS.iter().find_map(|mark| content.strip_prefix(*mark));
    let rest = rest.or_else(|| {
        let rest = content.strip_prefix(b";");
        rest.filter(|rest| !rest.contains(&b';'))
    });
    rest.map(<[u8]>::trim_ascii)
}

/// Names of two columns at least, none of which is a number.
fn is_header(line: &[u8]) -> bool {
    let fields = fields(line, separator::of(line));
    fields.len() > 1 && fields.iter().all(|field| !is_number(field))
}

fn is_number(field: &[u8]) -> bool {
    let text = String::from_utf8_lossy(field);
    number::lenient(&text).is_some() || clock::Stamp::parse(&text).is_some()
}

fn starts_with_number(line: &[u8]) -> bool {
    let fields = fields(line, separator::of(line));
    fields.first().is_some_and(|field| is_number(field))
}

/// Whether a line has a field for each of the columns that another names; one that is empty may be missing at the end.
fn is_as_wide(header: &[u8], row: &[u8], told: Option<u8>) -> bool {
    let separator = separator_of(header, told);
    let [names, own] = [header, row].map(|line| fields(line, separator));
    let full = |fields: &[&[u8]]| fields.len() - usize::from(fields.ends_with(&[b""]));
    names.len() == own.len() || full(&names) == full(&own)
}

/// Whether a line is a row of the columns that a comment names: as many fields, the first of which is a number, of whatever decimals, or
/// lost.
fn is_row_of(header: &[u8], row: &[u8], told: Option<u8>) -> bool {
    let own = fields(row, separator_of(header, told));
    let is_blank = own.iter().all(|field| field.is_empty());
    let begins = own
        .first()
        .is_some_and(|field| field.is_empty() || is_number(field));
    is_as_wide(header, row, told) && begins && !is_blank
}

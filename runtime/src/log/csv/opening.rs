//! Where a text's header is, and what separates its columns: `numpy.savetxt` writes the header as a comment, spreadsheets write
//! semicolons, test rigs write what they know above it.

use std::io::Read;

use super::super::note::Note;
use super::super::rows::damaged;
use super::super::words;
use super::super::{LogError, TextError};
use super::lines::Lines;
use super::separator::{self, BLANKS, fields};
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
    pub fn of(source: &str, text: Box<dyn Read + 'a>) -> Result<Self, LogError> {
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
        let number = below_remarks(source, &mut lines, first, told)?;
        let note = (number > first).then(|| Note::Above {
            lines: number - first,
            first: words::field(&String::from_utf8_lossy(
                lines.get(first).unwrap_or_default(),
            )),
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

/// The line of the header, which is the first or stands below lines such as `robot: UR5` that are no row of columns.
///
/// # Errors
/// [`TextError::Above`] where what stands above the header may be columns.
fn below_remarks(
    source: &str,
    lines: &mut Lines,
    first: usize,
    told: Option<u8>,
) -> Result<usize, LogError> {
    let mut line = |number: usize| lines.get(number).map(<[u8]>::to_vec);
    let mut are_remarks = true;
    let mut header = None;
    for number in first..first + MOST_REMARKS {
        let (Some(own), Some(next)) = (line(number), line(number + 1)) else {
            break;
        };
        if is_header(&own) && is_row_of(&own, &next, told) {
            header = Some(number);
            break;
        }
        // Units between names and numbers.
        let third = line(number + 2).unwrap_or_default();
        let is_above_units = is_header(&next) && is_row_of(&next, &third, told);
        if is_above_units && is_header(&own) && is_as_wide(&own, &next, told) {
            header = Some(number);
            break;
        }
        are_remarks &= own.is_empty() || unmarked(&own).is_some() || is_remark(&own);
        if number == first && starts_with_number(&own) {
            break;
        }
    }
    match header {
        Some(header) if header == first || are_remarks => Ok(header),
        Some(header) => Err(TextError::Above {
            source_name: source.to_owned(),
            line: first as u64 + 1,
            header: header as u64 + 1,
        }
        .into()),
        None => Ok(first),
    }
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

/// `robot: UR5`, `date = Monday`, `Recorded by hand`: text that begins with a letter, and a name of something or no columns.
fn is_remark(line: &[u8]) -> bool {
    let is_separator = |byte: &u8| separator::ALL.contains(byte) && *byte != BLANKS;
    let name = line.split(|byte| [b':', b'='].contains(byte)).next();
    let begins = line.first().is_some_and(u8::is_ascii_alphabetic);
    begins && name.is_some_and(|name| !name.iter().any(is_separator))
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
    let separator = told.unwrap_or_else(|| separator::of(header));
    let [names, own] = [header, row].map(|line| fields(line, separator));
    let full = |fields: &[&[u8]]| fields.len() - usize::from(fields.ends_with(&[b""]));
    names.len() == own.len() || full(&names) == full(&own)
}

/// Whether a line is a row of the columns that a comment names: as many fields, the first of which is a number, of whatever decimals, or
/// lost.
fn is_row_of(header: &[u8], row: &[u8], told: Option<u8>) -> bool {
    let own = fields(row, told.unwrap_or_else(|| separator::of(header)));
    let is_blank = own.iter().all(|field| field.is_empty());
    let begins = own
        .first()
        .is_some_and(|field| field.is_empty() || is_number(field));
    is_as_wide(header, row, told) && begins && !is_blank
}

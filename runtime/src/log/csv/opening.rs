//! Where a text's header is, and what separates its columns: `numpy.savetxt` writes the header as a comment, spreadsheets write semicolons.

use std::io::{BufRead, BufReader, Cursor, Read};

use super::super::LogError;
use super::super::limits::LONGEST_ROW;
use super::super::rows::damaged;

/// What may separate columns. Blanks do not: names and times are written with them.
const SEPARATORS: [u8; 3] = [b',', b';', b'\t'];

/// What comments begin with, in `NumPy` and in MATLAB.
const MARKS: [u8; 2] = [b'#', b'%'];

/// Lines of comments that are looked through.
const MOST_COMMENTS: u64 = 1000;

/// A text from its header on.
pub(super) struct Opening<'a> {
    pub text: Box<dyn Read + 'a>,
    /// Lines before the header.
    pub above: u64,
    /// What stands between columns.
    pub separator: u8,
}

impl<'a> Opening<'a> {
    /// Leaves out comments above the header. The header is the last of them where numbers follow at once.
    pub fn of(source: &str, text: impl Read + 'a) -> Result<Self, LogError> {
        let mut text = BufReader::new(text);
        let mut comment = None;
        for above in 0.. {
            let mut line = Vec::new();
            let read = text
                .by_ref()
                .take(LONGEST_ROW + 1)
                .read_until(b'\n', &mut line);
            read.map_err(|error| damaged(source, above + 1, &error))?;
            let content = content(&line);
            let may_go_on = !line.is_empty() && above < MOST_COMMENTS;
            if may_go_on && content.is_empty() {
                continue;
            }
            if let Some(rest) = unmarked(content).filter(|_| may_go_on) {
                comment = Some((above, rest.to_vec()));
                continue;
            }
            let (above, header) = match comment {
                Some((of_comment, mut header))
                    if is_row_of(&header, content) && of_comment + 1 == above =>
                {
                    header.push(b'\n');
                    (of_comment, [header, line].concat())
                }
                _ => (above, line),
            };
            return Ok(Self {
                separator: separator(&header),
                text: Box::new(Cursor::new(header).chain(text)),
                above,
            });
        }
        unreachable!("a text has an end, and comments are counted")
    }
}

/// A line without blanks around it, and without the mark of its encoding.
fn content(line: &[u8]) -> &[u8] {
    line.trim_ascii()
        .strip_prefix("\u{feff}".as_bytes())
        .unwrap_or(line)
        .trim_ascii()
}

/// What a comment says.
fn unmarked(content: &[u8]) -> Option<&[u8]> {
    let (first, rest) = content.split_first()?;
    MARKS.contains(first).then(|| rest.trim_ascii())
}

/// That which there is most of in the header, quoted names left out.
fn separator(text: &[u8]) -> u8 {
    let header = text.split(|byte| *byte == b'\n').next().unwrap_or(text);
    let plain = || header.split(|byte| *byte == b'"').step_by(2).flatten();
    let count = |separator: u8| plain().filter(|byte| **byte == separator).count();
    let most = |best: u8, next: u8| {
        if count(next) > count(best) {
            next
        } else {
            best
        }
    };
    SEPARATORS.into_iter().reduce(most).unwrap_or(b',')
}

/// Whether a line is a row of the columns that a comment names: as many fields, the first of which is a number, of whatever decimals, or
/// lost.
fn is_row_of(header: &[u8], row: &[u8]) -> bool {
    let separator = separator(header);
    let fields = |line: &[u8]| line.split(|byte| *byte == separator).count();
    let mut own = row.split(|byte| *byte == separator).map(<[u8]>::trim_ascii);
    let is_number = |field: &[u8]| {
        let text = String::from_utf8_lossy(field).replace(',', ".");
        text.is_empty() || text.parse::<f64>().is_ok()
    };
    let is_blank = || {
        row.iter()
            .all(|byte| *byte == separator || byte.is_ascii_whitespace())
    };
    fields(header) == fields(row) && own.next().is_some_and(is_number) && !is_blank()
}

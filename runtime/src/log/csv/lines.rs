//! The first lines of a text, looked at before they are read.

use std::io::{self, BufRead, BufReader, Cursor, Read};

use super::super::limits::LONGEST_ROW;

/// Bytes that are held: lines behind them are not looked at.
const MOST: u64 = 2 * LONGEST_ROW;

/// Lines of a text that were read ahead, each with its end.
pub(super) struct Lines<'a> {
    text: BufReader<Box<dyn Read + 'a>>,
    held: Vec<Vec<u8>>,
    /// What stopped reading, to be said where the rows come there.
    error: Option<io::Error>,
    size: u64,
}

impl<'a> Lines<'a> {
    pub fn of(text: Box<dyn Read + 'a>) -> Self {
        Self {
            text: BufReader::new(text),
            held: Vec::new(),
            error: None,
            size: 0,
        }
    }

    /// A line without its end, by its number from 0; none behind the end, or too far to be looked at.
    pub fn get(&mut self, number: usize) -> Option<&[u8]> {
        while self.held.len() <= number && self.error.is_none() && self.size <= MOST {
            let mut line = Vec::new();
            let text = self.text.by_ref();
            let read = text.take(LONGEST_ROW + 1).read_until(b'\n', &mut line);
            self.error = read.err();
            if line.is_empty() {
                break;
            }
            self.size += line.len() as u64;
            self.held.push(line);
        }
        self.held.get(number).map(|line| content(line))
    }

    /// What stopped reading, if it was before any line.
    pub fn error_at_once(&mut self) -> Option<io::Error> {
        self.error.take_if(|_| self.held.is_empty())
    }

    /// The text from a line on, which may be another than it was.
    pub fn from(mut self, number: usize, line: Option<Vec<u8>>) -> Box<dyn Read + 'a> {
        if let Some(line) = line {
            self.held[number] = line;
        }
        let held = self.held.split_off(number.min(self.held.len())).concat();
        let rest: Box<dyn Read + 'a> = match self.error {
            Some(error) => Box::new(Broken(Some(error))),
            None => Box::new(self.text),
        };
        Box::new(Cursor::new(held).chain(rest))
    }
}

/// A line without blanks around it, and without the mark of its encoding.
fn content(line: &[u8]) -> &[u8] {
    line.trim_ascii()
        .strip_prefix("\u{feff}".as_bytes())
        .unwrap_or(line)
        .trim_ascii()
}

/// A text that breaks off.
struct Broken(Option<io::Error>);

impl Read for Broken {
    fn read(&mut self, _: &mut [u8]) -> io::Result<usize> {
        self.0.take().map_or(Ok(0), Err)
    }
}

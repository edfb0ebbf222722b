//! How a text ends: in a row that goes on and on, or in the middle of a number.

use std::cell::Cell;
use std::io::{self, Read};
use std::rc::Rc;

use csv::ByteRecord;

use super::super::limits::LONGEST_ROW;
use super::super::note::Note;

/// Text that ends with an error inside a row that does not: what is unpacked may be of any length, and a row is in memory as a whole.
pub(super) struct Bounded<'a> {
    pub text: Box<dyn Read + 'a>,
    /// Bytes since the row before was done, but for those that were read ahead.
    pub count: Rc<Cell<u64>>,
    /// The last byte.
    pub last: Rc<Cell<u8>>,
}

impl Read for Bounded<'_> {
    fn read(&mut self, into: &mut [u8]) -> io::Result<usize> {
        if self.count.get() > LONGEST_ROW {
            return Err(io::ErrorKind::FileTooLarge.into());
        }
        let read = self.text.read(into)?;
        self.count.set(self.count.get() + read as u64);
        if let Some(last) = into[..read].last() {
            self.last.set(*last);
        }
        Ok(read)
    }
}

/// What is known of the end of a text once all of it is read.
#[derive(Default)]
pub(super) struct Ending {
    last: Rc<Cell<u8>>,
    /// Digits of the last field of the record before, and of the last one.
    digits: [usize; 2],
    line: u64,
}

impl Ending {
    pub fn last_byte(&self) -> Rc<Cell<u8>> {
        Rc::clone(&self.last)
    }

    pub fn passes(&mut self, record: &ByteRecord, line: u64) {
        let last = record.iter().next_back().unwrap_or_default();
        self.digits = [self.digits[1], last.len()];
        self.line = line;
    }

    /// A last line without an end, whose last number is shorter than the one above it.
    pub fn note(&self) -> Option<Note> {
        let [above, last] = self.digits;
        let is_cut = last < above && !matches!(self.last.get(), b'\n' | b'\r');
        is_cut.then_some(Note::NoLineEnd { line: self.line })
    }
}

//! Text in UTF-16, as Windows writes it, to UTF-8.

use std::io::{self, Read};

/// The marks in front of such a text, little end first and big end first.
const MARKS: [[u8; 2]; 2] = [[0xff, 0xfe], [0xfe, 0xff]];

/// Bytes that are read at a time.
const PIECE: usize = 8192;

/// A text in UTF-8 from one in UTF-16 behind its mark. What is no text there comes out as bytes that are none here.
pub(super) struct FromUtf16<R> {
    text: R,
    of_bytes: fn([u8; 2]) -> u16,
    /// Bytes that wait for more: half a unit, or half a pair.
    rest: Vec<u8>,
    out: Vec<u8>,
    /// How much of that was handed on.
    done: usize,
}

/// How the text that such a mark stands in front of is to be decoded.
pub(super) fn order(mark: [u8; 2]) -> Option<fn([u8; 2]) -> u16> {
    let found = MARKS.iter().position(|own| mark == *own)?;
    let orders: [fn([u8; 2]) -> u16; 2] = [u16::from_le_bytes, u16::from_be_bytes];
    Some(orders[found])
}

impl<R: Read> FromUtf16<R> {
    pub fn new(text: R, of_bytes: fn([u8; 2]) -> u16) -> Self {
        Self {
            text,
            of_bytes,
            rest: Vec::new(),
            out: Vec::new(),
            done: 0,
        }
    }

    /// Decodes what is next; false behind the end.
    fn decode(&mut self) -> io::Result<bool> {
        let mut piece = std::mem::take(&mut self.rest);
        let text = self.text.by_ref();
        let read = text.take(PIECE as u64).read_to_end(&mut piece)?;
        let units: Vec<u16> = piece
            .as_chunks::<2>()
            .0
            .iter()
            .map(|pair| (self.of_bytes)(*pair))
            .collect();
        let is_half_pair = |unit: &u16| (0xd800..0xdc00).contains(unit);
        let waits = usize::from(read > 0 && units.last().is_some_and(is_half_pair));
        let whole = units.len() - waits;
        let kept = if read > 0 { 2 * whole } else { piece.len() };
        self.rest = piece.split_off(kept);
        self.out.clear();
        self.done = 0;
        for unit in char::decode_utf16(units[..whole].iter().copied()) {
            match unit {
                Ok(c) => self.out.extend(c.encode_utf8(&mut [0; 4]).as_bytes()),
                Err(_) => self.out.push(0xff),
            }
        }
        if piece.len() > 2 * units.len() {
            self.out.push(0xff);
        }
        Ok(read > 0)
    }
}

impl<R: Read> Read for FromUtf16<R> {
    fn read(&mut self, into: &mut [u8]) -> io::Result<usize> {
        while self.done == self.out.len() {
            if !self.decode()? && self.out.is_empty() {
                return Ok(0);
            }
        }
        let count = into.len().min(self.out.len() - self.done);
        into[..count].copy_from_slice(&self.out[self.done..][..count]);
        self.done += count;
        Ok(count)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn decoded(bytes: &[u8]) -> Vec<u8> {
        let order = order(*bytes.first_chunk().expect("two bytes")).expect("a mark");
        let mut out = Vec::new();
        let mut text = FromUtf16::new(&bytes[2..], order);
        text.read_to_end(&mut out).expect("memory");
        out
    }

    #[test]
    fn texts_of_either_order_are_decoded() {
        // A pair of units falls on the border of two pieces.
        let text = format!("{}\u{1f916} q\u{b0}\n", "x".repeat(PIECE / 2 - 1));
        let little = text.encode_utf16().flat_map(u16::to_le_bytes);
        let big = text.encode_utf16().flat_map(u16::to_be_bytes);
        let little: Vec<u8> = MARKS[0].into_iter().chain(little).collect();
        let big: Vec<u8> = MARKS[1].into_iter().chain(big).collect();
        for bytes in [&little, &big] {
            assert_eq!(decoded(bytes), text.as_bytes());
        }
        // Half a unit at the end, and half a pair.
        assert_eq!(decoded(b"\xff\xfea\0b"), b"a\xff");
        assert_eq!(decoded(b"\xff\xfe\x3d\xd8a\0"), b"\xffa");
        assert_eq!(decoded(b"\xff\xfe\x3d\xd8"), b"\xff");
    }
}

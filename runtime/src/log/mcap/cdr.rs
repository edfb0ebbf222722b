//! `sensor_msgs/msg/JointState` in CDR, both ways.
//!
//! Four bytes in front say the representation; numbers are aligned to their size, counted from behind these four bytes (in the
//! newer representation to four bytes at most); lists and texts have their length in front, texts a zero at their end.
//!
//! Source: OMG, Extensible and Dynamic Topic Types for DDS (DDS-XTypes) 1.3, 7.4.

use std::fmt;

/// A message, whose lists are as long as its publisher made them.
#[derive(Debug, Clone, PartialEq, Default)]
pub(super) struct JointState {
    pub seconds: i32,
    pub nanoseconds: u32,
    pub frame: String,
    pub names: Vec<String>,
    pub positions: Vec<f64>,
    pub velocities: Vec<f64>,
    pub efforts: Vec<f64>,
}

/// Why bytes are no such message.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Fault {
    Representation(u16),
    Ends(&'static str),
    NoText(&'static str),
    Nanoseconds(u32),
}

impl fmt::Display for Fault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Representation(kind) => write!(
                f,
                "its representation is 0x{kind:04x}, but only plain CDR (0x0000, 0x0001, 0x0006, 0x0007) is read"
            ),
            Self::Ends(what) => write!(f, "the message ends inside {what}"),
            Self::NoText(what) => write!(f, "{what} is not UTF-8 text"),
            Self::Nanoseconds(value) => {
                write!(f, "its stamp has {value} nanoseconds, more than a second")
            }
        }
    }
}

/// Bytes of a message behind the representation.
struct Reader<'a> {
    bytes: &'a [u8],
    at: usize,
    is_big_endian: bool,
    /// No number is aligned to more.
    most: usize,
}

impl<'a> Reader<'a> {
    fn new(message: &'a [u8]) -> Result<Self, Fault> {
        let Some((&[high, low, _, _], bytes)) = message.split_first_chunk::<4>() else {
            return Err(Fault::Ends("its first four bytes"));
        };
        let kind = u16::from_be_bytes([high, low]);
        let (is_big_endian, most) = match kind {
            0x0000 => (true, 8),
            0x0001 => (false, 8),
            0x0006 => (true, 4),
            0x0007 => (false, 4),
            _ => return Err(Fault::Representation(kind)),
        };
        Ok(Self {
            bytes,
            at: 0,
            is_big_endian,
            most,
        })
    }

    fn take(&mut self, count: usize, what: &'static str) -> Result<&'a [u8], Fault> {
        let rest = self.bytes.get(self.at..).unwrap_or(&[]);
        let taken = rest.get(..count).ok_or(Fault::Ends(what))?;
        self.at += count;
        Ok(taken)
    }

    /// A number of `N` bytes, the most significant first.
    fn number<const N: usize>(&mut self, what: &'static str) -> Result<[u8; N], Fault> {
        self.at = self.at.next_multiple_of(N.min(self.most));
        let taken = self.take(N, what)?;
        let mut bytes = [0; N];
        bytes.copy_from_slice(taken);
        if !self.is_big_endian {
            bytes.reverse();
        }
        Ok(bytes)
    }

    fn unsigned(&mut self, what: &'static str) -> Result<u32, Fault> {
        self.number(what).map(u32::from_be_bytes)
    }

    fn length(&mut self, what: &'static str) -> Result<usize, Fault> {
        let length = self.unsigned(what)?;
        usize::try_from(length).map_err(|_| Fault::Ends(what))
    }

    fn text(&mut self, what: &'static str) -> Result<String, Fault> {
        let length = self.length(what)?;
        let bytes = self.take(length, what)?;
        // Some writers of empty texts leave the zero out.
        let text = bytes.strip_suffix(&[0]).unwrap_or(bytes);
        let text = std::str::from_utf8(text).map_err(|_| Fault::NoText(what))?;
        Ok(text.to_owned())
    }

    fn list<T>(
        &mut self,
        what: &'static str,
        item: impl Fn(&mut Self) -> Result<T, Fault>,
    ) -> Result<Vec<T>, Fault> {
        let length = self.length(what)?;
        // A length of a damaged message may be anything: room is made as items come.
        (0..length).map(|_| item(self)).collect()
    }
}

impl JointState {
    pub fn read(message: &[u8]) -> Result<Self, Fault> {
        let mut reader = Reader::new(message)?;
        let seconds = reader.number("its stamp").map(i32::from_be_bytes)?;
        let nanoseconds = reader.unsigned("its stamp")?;
        if nanoseconds >= 1_000_000_000 {
            return Err(Fault::Nanoseconds(nanoseconds));
        }
        let frame = reader.text("the name of its frame")?;
        let names = reader.list("the names of joints", |r| r.text("the names of joints"))?;
        let mut numbers = |what| {
            reader.list(what, |r: &mut Reader| {
                r.number(what).map(f64::from_be_bytes)
            })
        };
        Ok(Self {
            seconds,
            nanoseconds,
            frame,
            names,
            positions: numbers("the positions")?,
            velocities: numbers("the velocities")?,
            efforts: numbers("the efforts")?,
        })
    }

    /// In the representation that ROS 2 writes: `CDR_LE`.
    pub fn write(&self) -> Vec<u8> {
        let mut bytes = Vec::new();
        bytes.extend(self.seconds.to_le_bytes());
        bytes.extend(self.nanoseconds.to_le_bytes());
        write_text(&mut bytes, &self.frame);
        write_length(&mut bytes, self.names.len());
        for name in &self.names {
            write_text(&mut bytes, name);
        }
        for numbers in [&self.positions, &self.velocities, &self.efforts] {
            write_length(&mut bytes, numbers.len());
            for number in numbers {
                bytes.resize(bytes.len().next_multiple_of(8), 0);
                bytes.extend(number.to_le_bytes());
            }
        }
        [&[0, 1, 0, 0], bytes.as_slice()].concat()
    }
}

fn write_length(bytes: &mut Vec<u8>, length: usize) {
    bytes.resize(bytes.len().next_multiple_of(4), 0);
    let length =
        u32::try_from(length).expect("no arm has so many joints, and no name so many letters");
    bytes.extend(length.to_le_bytes());
}

fn write_text(bytes: &mut Vec<u8>, text: &str) {
    write_length(bytes, text.len() + 1);
    bytes.extend(text.as_bytes());
    bytes.push(0);
}

#[cfg(test)]
mod tests {
    use super::*;

    fn message() -> JointState {
        JointState {
            seconds: 1_700_000_000,
            nanoseconds: 999_999_999,
            frame: "base".to_owned(),
            names: ["a", "elbow", "éé"].map(str::to_owned).to_vec(),
            positions: vec![0.5, -1.0, f64::NAN],
            velocities: Vec::new(),
            efforts: vec![1e-300, 2.0, 3.0],
        }
    }

    /// Byte by byte: one joint `j`, position 1, effort -2.
    #[test]
    fn a_message_is_read_as_the_standard_says() {
        let bytes = [
            &[0, 1, 0, 0][..],                         // little endian
            &[3, 0, 0, 0, 4, 0, 0, 0],                 // 3 s, 4 ns
            &[1, 0, 0, 0, 0, 0, 0, 0], // an empty frame, and three bytes to the next number
            &[1, 0, 0, 0, 2, 0, 0, 0, b'j', 0, 0, 0], // one name, and two bytes
            &[1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0xf0, 63], // one position, 32 bytes behind the representation
            &[0, 0, 0, 0],                             // no velocities
            &[1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0xc0],  // one effort, 48 bytes behind
        ];
        let message = JointState::read(&bytes.concat()).expect("a message");
        assert_eq!((message.seconds, message.nanoseconds), (3, 4));
        assert_eq!(message.names, ["j"]);
        assert_eq!(
            (&message.positions, &message.efforts),
            (&vec![1.0], &vec![-2.0])
        );
        assert!(message.velocities.is_empty());
        assert_eq!(message.write(), bytes.concat());
    }

    #[test]
    fn what_is_written_is_read() {
        let (written, read) = (
            message(),
            JointState::read(&message().write()).expect("a message"),
        );
        assert_eq!(written.names, read.names);
        assert!(read.positions[2].is_nan());
        assert_eq!(written.positions[..2], read.positions[..2]);
        assert_eq!(written.efforts, read.efforts);
        assert_eq!(
            (written.seconds, written.nanoseconds, written.frame),
            (read.seconds, read.nanoseconds, read.frame)
        );
    }

    #[test]
    fn other_byte_orders_and_alignments_are_read() {
        let text = |bytes: &mut Vec<u8>, big: bool, text: &str| {
            bytes.resize(bytes.len().next_multiple_of(4), 0);
            let length = u32::try_from(text.len() + 1).expect("short");
            bytes.extend(if big {
                length.to_be_bytes()
            } else {
                length.to_le_bytes()
            });
            bytes.extend(text.bytes().chain([0]));
        };
        for (kind, big, align) in [(0_u8, true, 8), (1, false, 8), (6, true, 4), (7, false, 4)] {
            let mut bytes = Vec::new();
            let word = |value: u32| {
                if big {
                    value.to_be_bytes()
                } else {
                    value.to_le_bytes()
                }
            };
            bytes.extend(word(7));
            bytes.extend(word(8));
            text(&mut bytes, big, "");
            bytes.resize(bytes.len().next_multiple_of(4), 0);
            bytes.extend(word(1));
            text(&mut bytes, big, "ab");
            for value in [1.5_f64, 2.5, 3.5] {
                bytes.resize(bytes.len().next_multiple_of(4), 0);
                bytes.extend(word(1));
                bytes.resize(bytes.len().next_multiple_of(align), 0);
                bytes.extend(if big {
                    value.to_be_bytes()
                } else {
                    value.to_le_bytes()
                });
            }
            let message = [&[0, kind, 0, 0], bytes.as_slice()].concat();
            let read = JointState::read(&message).expect("a message");
            assert_eq!((read.seconds, read.nanoseconds), (7, 8), "{kind}");
            assert_eq!(
                (read.positions, read.velocities, read.efforts),
                (vec![1.5], vec![2.5], vec![3.5]),
                "{kind}"
            );
        }
    }

    #[test]
    fn what_is_no_message_is_told() {
        let whole = message().write();
        for cut in 0..whole.len() {
            let fault = JointState::read(&whole[..cut]).expect_err("it is cut");
            assert!(matches!(fault, Fault::Ends(_)), "{cut}: {fault}");
        }
        let changed = |place: usize, to: u8| {
            let mut bytes = whole.clone();
            bytes[place] = to;
            JointState::read(&bytes)
        };
        assert_eq!(changed(1, 3), Err(Fault::Representation(3)));
        assert!(matches!(changed(11, 0xff), Err(Fault::Nanoseconds(_))));
        // The frame's first letter, and lists that would fill all memory.
        assert_eq!(
            changed(16, 0xff),
            Err(Fault::NoText("the name of its frame"))
        );
        assert_eq!(changed(27, 0xff), Err(Fault::Ends("the names of joints")));
    }
}

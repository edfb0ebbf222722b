//! Files that hold, unpack to, or claim more than memory is there for: each is refused after little of it was read.

use std::io::{self, Cursor, Read};

use super::super::limits::{LONGEST_ROW, MOST_COLUMNS};
use super::*;

/// A text without an end: a start, then the same again and again; it fails a test that reads more than so much of it.
struct Endless {
    start: Cursor<Vec<u8>>,
    again: Vec<u8>,
    at: usize,
    left: usize,
}

impl Endless {
    fn new(start: &[u8], again: &[u8], most: usize) -> Self {
        Self {
            start: Cursor::new(start.to_vec()),
            again: again.to_vec(),
            at: 0,
            left: most,
        }
    }
}

impl Read for Endless {
    fn read(&mut self, into: &mut [u8]) -> io::Result<usize> {
        let start = self.start.read(into)?;
        if start > 0 || into.is_empty() {
            return Ok(start);
        }
        let part = &self.again[self.at..];
        let count = part.len().min(into.len());
        into[..count].copy_from_slice(&part[..count]);
        self.at = (self.at + count) % self.again.len();
        self.left = self.left.checked_sub(count).expect("it reads on and on");
        Ok(count)
    }
}

fn packed(text: &[u8]) -> Vec<u8> {
    let mut packer = GzEncoder::new(Vec::new(), Compression::best());
    packer.write_all(text).expect("memory takes all");
    packer.finish().expect("memory takes all")
}

fn said(reader: impl Read) -> String {
    let refused = Log::from_reader("bomb.csv", reader, 1);
    refused.expect_err("it is refused").to_string()
}

const SOUND: &str = "time,q1,tau1\n0.00,1,2\n0.01,1,2\n";

#[test]
fn a_row_without_an_end_is_refused() {
    let most = 2 * usize::try_from(LONGEST_ROW).expect("small");
    let wanted =
        |line: u32| format!("bomb.csv:{line}: the row is longer than {LONGEST_ROW} bytes; ");
    // In a header, in a row, in quotation marks that are not closed, and lines with nothing in them.
    let text =
        |start: &str, again: &str| said(Endless::new(start.as_bytes(), again.as_bytes(), most));
    let quoted = format!("{SOUND}\"");
    for (start, again, line) in [
        ("time", "0", 1),
        ("time,q1,", "x,", 1),
        (SOUND, "0", 4),
        (&quoted, "\n0,", 4),
        (SOUND, "\n", 4),
    ] {
        let said = text(start, again);
        assert!(said.starts_with(&wanted(line)), "{again:?}: {said}");
    }
    // A thousand bytes each for a million.
    let bomb = packed(&vec![b'0'; 1 << 20]);
    let again = Endless::new(&packed(SOUND.as_bytes()), &bomb, 4 * bomb.len() + 10_000);
    assert!(said(again).starts_with(&wanted(4)));
}

#[test]
fn more_columns_than_an_arm_has_are_refused() {
    let names = |count: usize| {
        let names: Vec<String> = (0..count).map(|k| format!(",c{k}")).collect();
        names.concat()
    };
    let most = text(&format!("time,q1,tau1{}", names(MOST_COLUMNS - 3)), &[]);
    assert!(said(most.as_bytes()).contains("the log has 0 samples"));
    let more = format!("time,q1,tau1{}\n", names(MOST_COLUMNS));
    assert_eq!(
        said(more.as_bytes()),
        "bomb.csv:1: the log has 10003 columns, more than 10000; remove those that are not channels of the arm"
    );
    let million = format!("time,q1,tau1{}\n", names(1_000_000));
    assert!(said(million.as_bytes()).contains("bomb.csv:1: the row is longer"));
}

/// A log within so many numbers.
fn within(reader: impl Read, most: usize) -> Result<Log, LogError> {
    let columns = Columns::standard(1);
    let rows = rows::of_reader("bomb.csv", reader, &columns)?;
    Log::from_rows("bomb.csv".to_owned(), rows, &columns, most)
}

#[test]
fn more_rows_than_fit_into_memory_are_refused() {
    let endless = || Endless::new(SOUND.as_bytes(), b"0.02,1,2\n", 50_000);
    let refused = within(endless(), 3000)
        .expect_err("it is refused")
        .to_string();
    assert_eq!(
        refused,
        "bomb.csv: the log has 1000 rows or more, of 3 columns: more than 2 GiB of numbers; cut it into several logs, or leave columns out"
    );
    // Rows that count as missing take memory, too.
    let gaps = Endless::new(
        SOUND.as_bytes(),
        &[b"0.02,1,2\n".repeat(30), b"0.03,,2\n".to_vec()].concat(),
        10_000_000,
    );
    let refused = within(gaps, 3_000_000).expect_err("it is refused");
    assert!(
        matches!(
            refused,
            LogError::TooLarge {
                rows: 1_000_000,
                ..
            }
        ),
        "{refused}"
    );
    let whole = text("time,q1,tau1", &rows(1000));
    assert_eq!(
        within(whole.as_bytes(), 3003)
            .expect("a sound log")
            .time
            .len(),
        1000
    );
}

#[cfg(feature = "mcap")]
#[test]
fn bags_that_claim_everything_are_refused() {
    let magic = b"\x89MCAP0\r\n".as_slice();
    let record = |kind: u8, length: u64, content: &[u8]| {
        [magic, &[kind], &length.to_le_bytes(), content].concat()
    };
    let chunk = |packing: &[u8], packed: u64| {
        let text = u32::try_from(packing.len()).expect("short").to_le_bytes();
        [
            &[0; 16],
            (1_u64 << 60).to_le_bytes().as_slice(),
            &[0; 4],
            &text,
            packing,
            &packed.to_le_bytes(),
            &[0; 64],
        ]
        .concat()
    };
    let columns = Columns {
        joints: vec!["elbow".to_owned()],
        ..Columns::standard(1)
    };
    for bag in [
        record(1, 1 << 60, &[0; 64]),
        record(5, u64::MAX, &[0; 64]),
        record(6, 120, &chunk(b"zstd", 64)),
        record(6, 120, &chunk(b"lz4", 1 << 60)),
        record(6, 120, &chunk(b"", 1 << 60)),
        record(6, 1 << 60, &chunk(b"", 1 << 60)),
    ] {
        let refused = Log::from_reader_as("bomb.mcap", bag.as_slice(), &columns);
        let said = refused.expect_err("it is refused").to_string();
        assert!(
            said.starts_with("bomb.mcap:1: cannot read the log: "),
            "{said}"
        );
    }
}

//! Logs, and what has to hold of each that is read.

use std::collections::BTreeMap;
use std::io::{Cursor, Write as _};
use std::sync::Arc;

use flate2::write::GzEncoder;
use mcap::WriteOptions;
use mcap::records::MessageHeader;
use parquet::basic::{Compression, GzipLevel, ZstdLevel};
use parquet::data_type::{DoubleType, Int64Type};
use parquet::file::properties::{WriterProperties, WriterVersion};
use parquet::file::writer::SerializedFileWriter;
use parquet::schema::parser::parse_message_type;
use robot_model::log::{Columns, JointStates, Log, LogError, Pieces};

use crate::answer::{Answer, skeleton};

/// What stands in logs.
pub(crate) const WORDS: [&str; 24] = [
    "time",
    "q1",
    "dq1",
    "tau1",
    "q2",
    "Q1",
    "temperature",
    "\"",
    "\"\"",
    ",",
    ",,",
    "\n",
    "\r\n",
    "\r",
    "\u{feff}",
    ";",
    "NaN",
    "inf",
    "-inf",
    "1e999",
    "1e-320",
    "0x10",
    "99999999999999999999",
    "-",
];

const NAME: &str = "fuzz.log";
const SAMPLES: u32 = 40;

/// What a log of two joints is made of.
fn columns() -> Columns {
    Columns {
        joints: vec!["shoulder".to_owned(), "elbow".to_owned()],
        ..Columns::standard(2)
    }
}

/// Time, positions, torques.
fn sample(k: u32) -> [f64; 5] {
    let t = f64::from(k) / 100.0;
    [t, t.sin(), t.cos(), 3.0 * t, -0.5]
}

/// Sound logs in text.
pub(crate) fn csv() -> Vec<Vec<u8>> {
    let table = |header: &str, end: &str, extra: &str| {
        let rows = (0..SAMPLES).map(|k| {
            let [t, a, b, c, d] = sample(k);
            format!("{t},{a:.6},{b:.6},{c},{d}{extra}{end}")
        });
        format!("{header}{end}{}", rows.collect::<String>()).into_bytes()
    };
    let plain = table("time,q1,q2,tau1,tau2", "\n", "");
    let mut packer = GzEncoder::new(Vec::new(), flate2::Compression::default());
    packer.write_all(&plain).expect("memory takes all");
    vec![
        packer.finish().expect("memory takes all"),
        table(
            "\u{feff}time,q1,q2,tau1,tau2,mode",
            "\r\n",
            ",\"a \"\"b\"\"\"",
        ),
        table("time, q1, q2, tau1, tau2, temperature", "\n", ", 20.5"),
        plain,
    ]
}

/// Sound logs in Parquet: packed and not, in pages of both versions, with dictionaries, and with values that may be missing.
pub(crate) fn parquet() -> Vec<Vec<u8>> {
    let packings = [
        Compression::UNCOMPRESSED,
        Compression::SNAPPY,
        Compression::ZSTD(ZstdLevel::default()),
        Compression::GZIP(GzipLevel::default()),
    ];
    let versions = [WriterVersion::PARQUET_1_0, WriterVersion::PARQUET_2_0];
    let mut files = Vec::new();
    for packing in packings {
        for version in versions {
            for has_dictionary in [false, true] {
                let properties = WriterProperties::builder()
                    .set_compression(packing)
                    .set_writer_version(version)
                    .set_dictionary_enabled(has_dictionary);
                files.push(one_parquet(properties.build()));
            }
        }
    }
    files
}

fn one_parquet(properties: WriterProperties) -> Vec<u8> {
    let schema = "message log { required double time; required double q1; required double q2; optional double tau1; required double tau2; \
                  required int64 count; }";
    let schema = Arc::new(parse_message_type(schema).expect("a schema"));
    let mut bytes = Vec::new();
    let mut writer =
        SerializedFileWriter::new(&mut bytes, schema, Arc::new(properties)).expect("a writer");
    for rows in [0..SAMPLES / 2, SAMPLES / 2..SAMPLES] {
        let mut group = writer.next_row_group().expect("a group");
        let count = usize::try_from(SAMPLES / 2).expect("small");
        for place in 0..5 {
            let values: Vec<f64> = rows.clone().map(|k| sample(k)[place]).collect();
            let there = vec![1; count];
            let levels = (place == 3).then_some(there.as_slice());
            let mut column = group.next_column().expect("a column").expect("a column");
            let written = column
                .typed::<DoubleType>()
                .write_batch(&values, levels, None);
            written.expect("values");
            column.close().expect("a column");
        }
        let counts: Vec<i64> = rows.map(i64::from).collect();
        let mut column = group.next_column().expect("a column").expect("a column");
        let written = column.typed::<Int64Type>().write_batch(&counts, None, None);
        written.expect("values");
        column.close().expect("a column");
        group.close().expect("a group");
    }
    writer.close().expect("a file");
    bytes
}

/// Sound bags: as this project writes them, and in other packings, without sums that would tell damage.
pub(crate) fn mcap() -> Vec<Vec<u8>> {
    let channel = |place: usize| -> Vec<f64> { (0..SAMPLES).map(|k| sample(k)[place]).collect() };
    let (q, tau) = (vec![channel(1), channel(2)], vec![channel(3), channel(4)]);
    let states = JointStates {
        topic: "/joint_states",
        joints: &columns().joints,
        time: &channel(0),
        q: &q,
        dq: &[],
        tau: &tau,
    };
    let packed = states.to_mcap().expect("a sound bag");
    let packings = [
        None,
        Some(mcap::Compression::Zstd),
        Some(mcap::Compression::Lz4),
    ];
    let mut files: Vec<Vec<u8>> = packings
        .into_iter()
        .map(|packing| without_sums(&packed, packing))
        .collect();
    files.push(packed);
    files
}

/// The messages of a bag again, packed otherwise.
fn without_sums(bag: &[u8], packing: Option<mcap::Compression>) -> Vec<u8> {
    let options = WriteOptions::new()
        .compression(packing)
        .compression_threads(0)
        .chunk_size(Some(2000))
        .calculate_chunk_crcs(false)
        .calculate_data_section_crc(false)
        .calculate_summary_section_crc(false)
        .calculate_attachment_crcs(false);
    let mut writer = options.create(Cursor::new(Vec::new())).expect("a writer");
    let schema = writer.add_schema("sensor_msgs/msg/JointState", "ros2msg", b"");
    let schema = schema.expect("a schema");
    let channel = writer.add_channel(schema, "/joint_states", "cdr", &BTreeMap::new());
    let channel_id = channel.expect("a channel");
    for message in mcap::MessageStream::new(bag).expect("a sound bag") {
        let message = message.expect("a message");
        let header = MessageHeader {
            channel_id,
            sequence: message.sequence,
            log_time: message.log_time,
            publish_time: message.publish_time,
        };
        let written = writer.write_to_known_channel(&header, &message.data);
        written.expect("a message");
    }
    writer.finish().expect("an end");
    writer.into_inner().into_inner()
}

/// What comes of a log in text or Parquet.
pub(crate) fn answer(file: &[u8]) -> Answer {
    of_columns(file, &Columns::standard(2))
}

/// What comes of a bag.
pub(crate) fn answer_of_bag(file: &[u8]) -> Answer {
    of_columns(file, &columns())
}

fn of_columns(file: &[u8], columns: &Columns) -> Answer {
    let pieces = match Pieces::new(NAME, file, columns, 20, 0.03) {
        Ok(pieces) => pieces.collect(),
        Err(error) => vec![Err(error)],
    };
    for piece in pieces {
        drop(checked(piece));
    }
    match checked(Log::from_reader_as(NAME, file, columns)) {
        Err(message) => Answer::refused(&message),
        Ok(log) => {
            let (samples, channels) = (log.time.len(), log.dq.len() + log.extra.len());
            let mended = log.mended();
            is_sound(&mended.log);
            let faults = mended
                .faults
                .iter()
                .map(|fault| skeleton(&fault.to_string()));
            let notes = mended
                .log
                .report
                .iter()
                .map(|note| skeleton(&note.to_string()));
            let mut remarks: Vec<String> = notes.chain(faults).collect();
            remarks.sort();
            remarks.dedup();
            Answer::Read {
                size: samples.ilog2(),
                parts: u32::try_from(channels).unwrap_or(u32::MAX),
                remarks,
            }
        }
    }
}

/// A log that holds what it promises, or a message that names the file.
fn checked(read: Result<Log, LogError>) -> Result<Log, String> {
    match read {
        Ok(log) => {
            is_sound(&log);
            Ok(log)
        }
        Err(error) => {
            let message = error.to_string();
            assert!(message.starts_with(NAME), "a message that names no place");
            Err(message)
        }
    }
}

/// What [`Log`] promises of itself.
fn is_sound(log: &Log) {
    let extra = log.extra.iter().map(|channel| &channel.values);
    let channels = log.q.iter().chain(&log.dq).chain(&log.tau).chain(extra);
    for channel in channels {
        assert_eq!(channel.len(), log.time.len(), "a channel of another length");
        assert!(
            channel.iter().all(|x| x.is_finite()),
            "a value that is no number"
        );
    }
    assert!(log.time.len() >= 16, "too few samples");
    assert!(
        (log.q.len(), log.tau.len()) == (2, 2),
        "channels of other joints"
    );
    assert!([0, 2].contains(&log.dq.len()), "velocities of other joints");
    let step = 1.0 / log.rate_hz();
    let steps = log.time.windows(2).map(|pair| pair[1] - pair[0]);
    for found in steps {
        // Time stamps of a clock that counts from 1970 keep half a microsecond.
        let rounding =
            1e-9 * step + 1e-15 * log.time[0].abs().max(log.time[log.time.len() - 1].abs());
        assert!(
            (found - step).abs() <= 4.0 * rounding,
            "time that is not uniform"
        );
    }
}

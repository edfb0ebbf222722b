//! Parquet files that the reader takes, and damaged ones.

#![expect(
    clippy::float_cmp,
    reason = "what is read is the number that was written, to the last bit"
)]

use std::sync::Arc;

use parquet::data_type::{ByteArray, ByteArrayType, DoubleType, FloatType, Int32Type, Int64Type};
use parquet::file::metadata::{ParquetMetaDataReader, ParquetMetaDataWriter};
use parquet::file::properties::WriterProperties;
use parquet::file::writer::SerializedFileWriter;
use parquet::schema::parser::parse_message_type;

use super::super::{Column, Columns, Log};

/// A Parquet file has the log that a CSV file has, from memory, from a file and in pieces; a row with a null counts as missing.
#[test]
fn parquet_files_are_read_as_csv_is() {
    let dir = std::env::temp_dir().join(format!("robot-model-parquet-{}", std::process::id()));
    std::fs::create_dir_all(&dir).expect("a folder");
    let file = dir.join("monday.parquet");
    let bytes = written_parquet(None);
    std::fs::write(&file, &bytes).expect("a file");
    let columns = parquet_columns();
    let log = Log::from_reader_as("memory", bytes.as_slice(), &columns).expect("a sound log");
    assert_eq!((log.time.len(), log.rate_hz().round()), (1000, 1000.0));
    assert_eq!((log.q[0][700], log.tau[0][700]), (70.0, -350.0));
    let extra: Vec<(&str, f64)> = log
        .extra
        .iter()
        .map(|own| (own.name.as_str(), own.values[700]))
        .collect();
    // One that has no number in its first rows is held from the first one on.
    assert_eq!(extra, [("count", 693.0), ("gaps", 1.0)]);
    // An unsigned one, whose first bit is not a sign.
    assert_eq!(log.extra[0].values[3], 4_294_967_292.0);
    let told: Vec<String> = log.report.iter().map(ToString::to_string).collect();
    assert!(told[0].ends_with("are ignored: `mode`"), "{told:?}");
    assert!(told[1].ends_with("are interpolated: `gaps`"), "{told:?}");

    let again = Log::read_as(&file, &columns).expect("a sound log");
    assert_eq!((again.time, again.q), (log.time, log.q));
    let pieces = Log::pieces(&file, &columns, 300, 0.1).expect("a header");
    let pieces: Vec<Log> = pieces.map(|piece| piece.expect("a sound piece")).collect();
    let last = pieces.last().expect("pieces");
    assert_eq!((pieces.len(), last.q[0].last()), (4, Some(&99.9)));
    std::fs::remove_dir_all(&dir).expect("the folder");

    let null = written_parquet(Some(617));
    let log = Log::from_reader_as("tuesday", null.as_slice(), &columns).expect("one of a thousand");
    assert_eq!(
        (log.time.len(), log.tau[0][616], log.tau[0][618]),
        (1000, -308.0, -309.0)
    );
    assert!((log.tau[0][617] + 308.5).abs() < 1e-9);
    let told: Vec<String> = log.report.iter().map(ToString::to_string).collect();
    assert_eq!(
        told[0],
        "one row counts as missing, since tuesday:618: `null or NaN` in column `tau1` is not a number; \
         repair or remove the row"
    );
}

/// A schema that has the unit of a time stamp is heeded where settings say none, and what settings say holds.
#[test]
fn time_stamps_have_the_unit_of_the_schema() {
    let bytes = written_parquet(None);
    let columns = |unit: Option<f64>| Columns {
        time: Column {
            name: "stamp".to_owned(),
            unit,
        },
        ..Columns::standard(1)
    };
    let read = |unit| Log::from_reader_as("monday", bytes.as_slice(), &columns(unit));
    let log = read(None).expect("a sound log");
    assert_eq!(log.rate_hz().round(), 1000.0);
    let told = |log: &Log| {
        let told = log.report.iter().map(ToString::to_string);
        told.filter(|told| told.contains("schema"))
            .collect::<Vec<_>>()
    };
    assert_eq!(
        told(&log),
        ["the file's schema says units: `stamp` in us are read so"]
    );
    let same = read(Some(1e-6)).expect("a sound log");
    assert_eq!(told(&same), [""; 0]);
    let other = read(Some(1e-5)).expect("a slower log");
    assert_eq!(other.rate_hz().round(), 100.0);
    let told = told(&other);
    assert!(
        told[0].contains("`stamp` in us, but settings give another unit"),
        "{told:?}"
    );
}

/// Damaged Parquet files are refused, or read where the damage is in a number.
#[test]
fn damaged_parquet_files_are_refused() {
    let sound = written_parquet(None);
    let columns = parquet_columns();
    let mut refused = 0;
    let mut count = |bytes: &[u8]| {
        if Log::from_reader_as("damaged", bytes, &columns).is_err() {
            refused += 1;
        }
    };
    for cut in (4..sound.len()).step_by(97) {
        count(&sound[..cut]);
    }
    for place in (4..sound.len()).step_by(13) {
        for mask in [0x01, 0x80, 0xff] {
            let mut bytes = sound.clone();
            bytes[place] ^= mask;
            count(&bytes);
        }
    }
    assert!(refused > sound.len() / 97, "{refused}");
}

/// A codec that is not read is named, and so is the way out.
#[test]
fn a_codec_that_is_not_read_is_named() {
    // Field 4 of a column's metadata, in the footer: the codec as an integer; Snappy is 1.
    let field = |codec: u8| [0x15, 2 * codec, 0x16];
    for (codec, name) in [(3, "LZO"), (4, "Brotli"), (5, "LZ4"), (7, "LZ4")] {
        let mut bytes = written_parquet(None);
        let places = bytes.windows(3).enumerate();
        let places: Vec<usize> = places
            .filter(|(_, bytes)| *bytes == field(1))
            .map(|(k, _)| k)
            .collect();
        assert_eq!(places.len(), 12, "six columns of two groups");
        for place in places {
            bytes[place..place + 3].copy_from_slice(&field(codec));
        }
        let refused = Log::from_reader_as("packed", bytes.as_slice(), &parquet_columns());
        let said = refused.expect_err("not read").to_string();
        assert!(
            said.contains(&format!(
                "its pages are packed with {name}, which is not read here"
            )),
            "{said}"
        );
        assert!(said.contains("write it with `snappy`"), "{said}");
        assert!(!said.contains("damaged"), "{said}");
    }
}

/// Text in a channel is no damage, and a file that breaks off is.
#[test]
fn columns_of_text_and_half_files_are_told() {
    let sound = written_parquet(None);
    let said = |bytes: &[u8], columns: &Columns| {
        let refused = Log::from_reader_as("monday", bytes, columns);
        refused.expect_err("refused").to_string()
    };
    let mut of_text = parquet_columns();
    of_text.tau[0].name = "mode".to_owned();
    assert_eq!(
        said(&sound, &of_text),
        "monday:1: cannot read the log: column `mode` is not numeric: write it as a column of doubles"
    );
    let half = said(&sound[..sound.len() / 2], &parquet_columns());
    assert!(
        half.ends_with("the file is damaged: copy it again, as binary, or write it again"),
        "{half}"
    );
}

/// A footer that claims `rows` in each group, over the pages of a sound file.
fn claiming(rows: i64) -> Vec<u8> {
    let sound = written_parquet(None);
    let bytes = bytes::Bytes::from(sound.clone());
    let metadata = ParquetMetaDataReader::new().parse_and_finish(&bytes);
    let metadata = metadata.expect("a sound footer");
    let groups = metadata.row_groups().iter().map(|group| {
        let builder = group.clone().into_builder().set_num_rows(rows);
        builder.build().expect("a group")
    });
    let groups = groups.collect();
    let metadata = metadata.clone().into_builder().set_row_groups(groups);
    let mut written = sound;
    ParquetMetaDataWriter::new(&mut written, &metadata.build())
        .finish()
        .expect("a footer");
    written
}

/// What a file claims is no reason to make room for it.
#[test]
fn rows_that_are_not_there_are_refused() {
    for (rows, words) in [
        (
            1 << 60,
            "a column of 400 rows in a group of 1152921504606846976",
        ),
        (
            i64::MAX / 2,
            "a column of 400 rows in a group of 4611686018427387903",
        ),
        (40_000_000, "a column of 400 rows in a group of 40000000"),
        (
            399,
            "a page claims to have 400 values, but the most are 399",
        ),
        (-1, "a group of less than no rows"),
    ] {
        let bytes = claiming(rows);
        let refused = Log::from_reader_as("bomb", bytes.as_slice(), &parquet_columns());
        let said = refused.expect_err("refused").to_string();
        assert!(
            said.contains(words) && said.starts_with("bomb:"),
            "{rows}: {said}"
        );
    }
    let sound = claiming(400);
    let refused = Log::from_reader_as("bomb", sound.as_slice(), &parquet_columns());
    let said = refused.expect_err("the second has 600").to_string();
    assert!(said.contains("600 values, but the most are 400"), "{said}");
}

/// A table as wide as its schema says.
#[test]
fn more_columns_than_an_arm_has_are_refused() {
    let columns: Vec<String> = (0..10_001)
        .map(|k| format!("required double c{k}; "))
        .collect();
    let columns = columns.concat();
    let schema = parse_message_type(&format!("message log {{ {columns} }}")).expect("a schema");
    let mut bytes = Vec::new();
    let writer = SerializedFileWriter::new(&mut bytes, Arc::new(schema), Arc::default());
    writer.expect("a writer").close().expect("a file");
    let refused = Log::from_reader_as("wide", bytes.as_slice(), &parquet_columns());
    assert_eq!(
        refused.expect_err("refused").to_string(),
        "wide:1: the log has 10001 columns, more than 10000; remove those that are not channels of the arm"
    );
}

fn parquet_columns() -> Columns {
    Columns {
        time: Column {
            name: "stamp".to_owned(),
            unit: Some(1e-6),
        },
        ..Columns::standard(1)
    }
}

/// A thousand samples in two groups: time in microseconds, positions, torques that may be null, a count, words, and a column
/// that begins with a null.
fn written_parquet(null: Option<i32>) -> Vec<u8> {
    let schema = "message log { required int64 stamp (TIMESTAMP(MICROS,true)); required double q1; optional double tau1; \
                  required int32 count (INTEGER(32,false)); required binary mode (UTF8); optional float gaps; }";
    let schema = Arc::new(parse_message_type(schema).expect("a schema"));
    let properties = WriterProperties::builder()
        .set_compression(parquet::basic::Compression::SNAPPY)
        .build();
    let mut bytes = Vec::new();
    let mut writer =
        SerializedFileWriter::new(&mut bytes, schema, Arc::new(properties)).expect("a writer");
    for rows in [0..400_i32, 400..1000] {
        let mut group = writer.next_row_group().expect("a group");
        let there: Vec<i16> = rows.clone().map(|k| i16::from(Some(k) != null)).collect();
        let torque: Vec<f64> = rows
            .clone()
            .zip(&there)
            .filter(|(_, level)| **level == 1)
            .map(|(k, _)| -0.5 * f64::from(k))
            .collect();
        let stamps: Vec<i64> = rows.clone().map(|k| 1000 * i64::from(k)).collect();
        let positions: Vec<f64> = rows.clone().map(|k| f64::from(k) / 10.0).collect();
        let counts: Vec<i32> = rows.clone().map(|k| k - 7).collect();
        let words = vec![ByteArray::from("idle"); rows.len()];
        let gaps: Vec<i16> = rows.clone().map(|k| i16::from(k > 3)).collect();
        let held = vec![1.0_f32; gaps.iter().filter(|level| **level == 1).count()];
        macro_rules! column {
            ($kind:ty, $values:expr, $levels:expr) => {{
                let mut column = group.next_column().expect("a column").expect("a column");
                column
                    .typed::<$kind>()
                    .write_batch($values, $levels, None)
                    .expect("values");
                column.close().expect("a column");
            }};
        }
        column!(Int64Type, &stamps, None);
        column!(DoubleType, &positions, None);
        column!(DoubleType, &torque, Some(&there));
        column!(Int32Type, &counts, None);
        column!(ByteArrayType, &words, None);
        column!(FloatType, &held, Some(&gaps));
        group.close().expect("a group");
    }
    writer.close().expect("a file");
    bytes
}

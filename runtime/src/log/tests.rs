//! What the reader accepts, and the full text of every refusal.

#![expect(
    clippy::float_cmp,
    reason = "what is read is the number that was written, to the last bit"
)]

use std::io::Write;

use flate2::Compression;
use flate2::write::GzEncoder;

use super::*;

mod close;
mod columns;
mod dialects;
mod gaps;
mod limits;
mod opening;

/// A log of one joint: rows of `time, q1, tau1` at 10 ms.
fn rows(count: usize) -> Vec<String> {
    (0..count)
        .map(|k| {
            format!(
                "{:.3},{},{}",
                0.01 * k as f64,
                0.1 * k as f64,
                2.0 * k as f64
            )
        })
        .collect()
}

fn text(header: &str, rows: &[String]) -> String {
    format!("{header}\n{}\n", rows.join("\n"))
}

fn notes(log: &Log) -> Vec<String> {
    log.report.iter().map(ToString::to_string).collect()
}

/// The same numbers, whatever is said of them.
#[track_caller]
fn assert_same(log: &Log, other: &Log) {
    assert_eq!(
        (&log.time, &log.q, &log.tau),
        (&other.time, &other.q, &other.tau)
    );
}

fn read(text: &str, dof: usize) -> Result<Log, LogError> {
    Log::from_reader("monday.csv", text.as_bytes(), dof)
}

fn refusal(text: &str, dof: usize) -> String {
    read(text, dof).expect_err("must be refused").to_string()
}

#[test]
fn columns_may_stand_in_any_order() {
    let rows: Vec<String> = (0..20)
        .map(|k| format!("{}, {k} ,7,{},{}", -k, 0.0625 * f64::from(k), 10 * k))
        .collect();
    let log = read(&text("tau1,q1,temperature,time,dq1", &rows), 1).expect("a sound log");
    assert_eq!(log.q[0][3], 3.0);
    assert_eq!(log.dq[0][3], 30.0);
    assert_eq!(log.tau[0][3], -3.0);
    assert_eq!(
        log.extra,
        [Channel {
            name: "temperature".to_owned(),
            values: vec![7.0; 20]
        }]
    );
    assert_eq!(log.rate_hz(), 16.0);
    assert_eq!(log.seconds(), 1.1875);
    let report: Vec<String> = log.report.iter().map(ToString::to_string).collect();
    assert_eq!(report, ["extra channels: `temperature`"]);
}

#[test]
fn gzip_is_told_by_its_first_bytes() {
    let plain = text("time,q1,tau1", &rows(50));
    let mut encoder = GzEncoder::new(Vec::new(), Compression::default());
    encoder.write_all(plain.as_bytes()).expect("memory");
    let packed = encoder.finish().expect("memory");
    let log = Log::from_reader("monday.csv", packed.as_slice(), 1).expect("a sound log");
    assert_eq!(log, read(&plain, 1).expect("a sound log"));

    let cut = &packed[..packed.len() / 2];
    let error = Log::from_reader("monday.csv", cut, 1)
        .expect_err("half a file")
        .to_string();
    assert!(
        error.starts_with("monday.csv:") && error.contains("cannot read the log: "),
        "{error}"
    );
    assert!(error.ends_with("copy it again, as binary, or write it again"));
}

#[test]
fn byte_order_mark_and_windows_lines_are_accepted() {
    let plain = text("\u{feff}time,q1,tau1", &rows(20)).replace('\n', "\r\n");
    assert_eq!(read(&plain, 1).expect("a sound log").dof(), 1);
}

#[test]
fn bad_fields_are_told_with_line_and_column() {
    let with = |line: usize, row: &str| {
        let mut rows = rows(20);
        row.clone_into(&mut rows[line - 2]);
        refusal(&text("time,q1,tau1", &rows), 1)
    };
    assert_eq!(
        with(5, "0.03,nan,1"),
        "monday.csv:5: `nan` in column `q1` is not finite; remove or repair the row"
    );
    let mut holes = rows(20);
    for line in [3, 9, 11] {
        holes[line - 2] = String::from("0,nan,1");
    }
    assert_eq!(
        refusal(&text("time,q1,tau1", &holes), 1),
        "monday.csv:3: `nan` in column `q1` is not finite; remove or repair the row; 3 of 20 rows have such a field, too many to interpolate"
    );
    assert_eq!(
        with(6, "0.04,1,-inf"),
        "monday.csv:6: `-inf` in column `tau1` is not finite; remove or repair the row"
    );
    assert_eq!(
        with(7, "0.05,1,1.2.3"),
        "monday.csv:7: `1.2.3` in column `tau1` is not a number; repair or remove the row"
    );
    assert_eq!(
        with(8, "0.06,,1"),
        "monday.csv:8: an empty field in column `q1` is not a number; repair or remove the row"
    );
    assert_eq!(
        with(9, "0.07,1"),
        "monday.csv:9: the row has 2 fields, the header has 3; give every row one field per column, or remove the row"
    );
    assert_eq!(
        with(9, "0.07,1,2,3"),
        "monday.csv:9: the row has 4 fields, the header has 3; give every row one field per column, or remove the row"
    );
}

#[test]
fn time_that_does_not_rise_is_told_with_its_line() {
    let with = |line: usize, row: &str| {
        let mut rows = rows(40);
        row.clone_into(&mut rows[line - 2]);
        refusal(&text("time,q1,tau1", &rows), 1)
    };
    assert_eq!(
        with(7, "0.04,1,1"),
        "monday.csv:7: time does not increase: 0.04 s follows 0.04 s; remove the row if it is a duplicate, or split the log here and give \
         both parts"
    );
    assert_eq!(
        with(7, "0.01,1,1"),
        "monday.csv:7: time does not increase: 0.01 s follows 0.04 s; remove the row if it is a duplicate, or split the log here and give \
         both parts"
    );
    let mut gap = rows(40);
    gap.drain(10..20);
    assert_eq!(
        refusal(&text("time,q1,tau1", &gap), 1),
        "monday.csv:12: gap in time from 0.09 s to 0.2 s, 11 times the median step; split the log here and give both parts"
    );
}

#[test]
fn headers_are_checked() {
    let header = |header: &str, dof: usize| {
        let row = vec!["0"; header.split(',').count()].join(",");
        refusal(&text(header, &[row]), dof)
    };
    assert_eq!(
        header("time,q1,q2,tau1,vir1", 2),
        "monday.csv:1: missing column `tau2`; the header has `time`, `q1`, `q2`, `tau1`, `vir1`"
    );
    assert_eq!(
        header("time,q1,q2,dq1,tau1,tau2", 2),
        "monday.csv:1: missing column `dq2`; the header has `time`, `q1`, `q2`, `dq1`, `tau1`, `tau2`"
    );
    assert_eq!(
        header("time,q1,q2,q3,tau1,tau2", 2),
        "monday.csv:1: unknown column `q3`: the arm has 2 joints, numbers 1 to 2"
    );
    assert_eq!(
        header("time,q1,tau0,tau1", 1),
        "monday.csv:1: unknown column `tau0`: the arm has 1 joint, number 1"
    );
    assert_eq!(
        header("time,qq1,tau1", 1),
        "monday.csv:1: unknown column `qq1`: write `q1`, or give the channel a name that cannot be mistaken for it"
    );
    assert_eq!(
        header("time,q1,tau1,q1", 1),
        "monday.csv:1: column `q1` appears twice; delete or rename one of them"
    );
    assert_eq!(
        header("time,q1,,tau1", 1),
        "monday.csv:1: column 3 has no name; name every column of numbers; only a first column that counts the rows may have none"
    );
    assert_eq!(
        refusal(&rows(20).join("\n"), 1),
        "monday.csv:1: the log has no header; write `time,q1,..,tau1,..` as a line above its numbers"
    );
}

#[test]
fn short_and_empty_logs_are_refused() {
    assert_eq!(
        refusal("", 1),
        "monday.csv: the log is empty; name the file that has the samples, as a header `time,q1,..,tau1,..` and a row for each"
    );
    assert_eq!(
        refusal("\n\n", 1),
        "monday.csv: the log is empty; name the file that has the samples, as a header `time,q1,..,tau1,..` and a row for each"
    );
    assert_eq!(
        refusal("time,q1,tau1\n", 1),
        "monday.csv: the log has 0 samples, at least 16 are needed; record a longer motion, or check whether the file is truncated"
    );
    assert_eq!(
        refusal(&text("time,q1,tau1", &rows(15)), 1),
        "monday.csv: the log has 15 samples, at least 16 are needed; record a longer motion, or check whether the file is truncated"
    );
    let folder = Log::read(env!("CARGO_MANIFEST_DIR"), 1)
        .expect_err("a folder is no log")
        .to_string();
    assert!(folder.contains("cannot"), "{folder}");
}

#[test]
fn rounding_of_time_stamps_is_no_jitter() {
    let rows: Vec<String> = (0..900)
        .map(|k| format!("{:.5},0,0", f64::from(k) / 300.0))
        .collect();
    let log = read(&text("time,q1,tau1", &rows), 1).expect("a sound log");
    assert!(log.report.is_empty());
    let step = log.time[1] - log.time[0];
    assert!(
        log.time
            .windows(2)
            .all(|pair| (pair[1] - pair[0] - step).abs() < 1e-12)
    );
}

#[test]
fn jitter_is_resampled_and_reported() {
    let late = |k: u32| {
        if k == 100 {
            0.003
        } else if k % 10 == 5 {
            0.002
        } else {
            0.0
        }
    };
    let stamp = |k: u32| 0.01 * f64::from(k) + late(k);
    let rows: Vec<String> = (0..=200)
        .map(|k| {
            format!(
                "{:.4},{:.9},{:.9}",
                stamp(k),
                (2.0 * stamp(k)).sin(),
                (3.0 * stamp(k)).cos()
            )
        })
        .collect();
    let log = read(&text("time,q1,tau1", &rows), 1).expect("a sound log");
    assert_eq!(log.time.len(), 201);
    for (k, time) in log.time.iter().enumerate() {
        assert!((time - 0.01 * k as f64).abs() < 1e-12);
        assert!((log.q[0][k] - (2.0 * time).sin()).abs() < 1e-5);
        assert!((log.tau[0][k] - (3.0 * time).cos()).abs() < 1e-5);
    }
    let report: Vec<String> = log.report.iter().map(ToString::to_string).collect();
    assert_eq!(
        report,
        [
            "time stamps are not uniform: 201 samples were resampled to 201 at the median step of 10 ms; \
             steps differ from it by 0.9434 ms RMS, 3 ms at most (line 102)"
        ]
    );
}

#[test]
fn samples_from_memory_are_checked_too() {
    let time: Vec<f64> = (0..20).map(f64::from).collect();
    let text = |time: &[f64], q: Vec<Vec<f64>>| {
        Log::from_samples("plant", time.to_vec(), q, vec![vec![0.0; 20]])
            .expect_err("must be refused")
            .to_string()
    };
    assert_eq!(
        text(&time, vec![vec![0.0; 19]]),
        "plant: every joint needs a position and a torque channel, all as long as the time"
    );
    let mut q = vec![vec![0.0; 20]];
    q[0][4] = f64::NAN;
    assert_eq!(
        text(&time, q),
        "plant: sample 4 is not finite; remove or repair it"
    );
    let mut repeated = time.clone();
    repeated[8] = 7.0;
    let mut q = vec![vec![0.0; 20]];
    q[0][8] = 1.0;
    assert_eq!(
        text(&repeated, q),
        "plant: sample 8: time does not increase: 7 s follows 7 s; remove the row if it is a duplicate, or split the log here and give \
         both parts"
    );
}

#[test]
fn files_that_are_no_csv_are_told() {
    let with = |bytes: &[u8]| {
        Log::from_reader("monday.csv", bytes, 1)
            .expect_err("must be refused")
            .to_string()
    };
    assert!(
        with(b"time,q1,tau1\n0,\xe9,0\n")
            .starts_with("monday.csv:2: byte 0xe9 in `\u{fffd}` is not UTF-8 text")
    );
    // A backslash is a letter of any encoding.
    assert!(with(b"time,q1,tau1\n0,\xe9\\x,0\n").contains("is not UTF-8 text"));
    assert_eq!(
        with(b"time,q1,tau1\n0,\xe9\x03\xf5,0\n"),
        "monday.csv:2: byte 0xe9 begins binary data: the file is damaged, or none of text; copy it again, or remove the rows from here on"
    );
    assert_eq!(
        with(b"time,q1,tau1\n0,0,0\n0.01,0."),
        "monday.csv:3: the last row has 2 fields, the header has 3; the file may be cut short: remove the row"
    );
    for (name, bytes) in [
        ("bag.MCAP", b"\x88MCAP0\r\n".as_slice()),
        ("monday.parquet", b"\0AR1\x15\x04"),
    ] {
        let refused = Log::from_reader(name, bytes, 1).expect_err("damaged");
        let said = format!("{name}:1: cannot read the log: it does not begin like");
        assert!(refused.to_string().starts_with(&said), "{refused}");
    }
    let folder = Log::read(env!("CARGO_MANIFEST_DIR"), 1).expect_err("a folder");
    assert!(
        folder
            .to_string()
            .ends_with("it is a folder; name the log files in it"),
        "{folder}"
    );
}

#[test]
fn implausible_logs_are_refused() {
    let at_step = |step: f64| {
        let rows: Vec<String> = (0..20)
            .map(|k| format!("{},0,0", step * f64::from(k)))
            .collect();
        read(&text("time,q1,tau1", &rows), 1)
    };
    assert_eq!(
        at_step(5.0).expect_err("milliseconds").to_string(),
        "monday.csv: the sample rate is 0.2000 Hz, outside 10 Hz .. 100000 Hz; is time in seconds? in ms it would be plausible: write \
         `time = \"..\": ms;` in the `log` of the spec"
    );
    let in_nanoseconds = at_step(1e7).expect_err("nanoseconds").to_string();
    assert!(in_nanoseconds.contains("rate is 1.0e-7 Hz") && in_nanoseconds.contains(": ns;`"));
    assert!(matches!(at_step(1e-6), Err(LogError::Rate { .. })));
    assert!(at_step(0.1 - 1e-9).is_ok() && at_step(1.1e-5).is_ok());

    let mut broken = rows(20);
    "0.05,1,-3e7".clone_into(&mut broken[5]);
    assert_eq!(
        refusal(&text("time,q1,tau1", &broken), 1),
        "monday.csv:7: `tau1` is -3e7, beyond 1e6 in magnitude; give positions in rad or m and torques in N m or N, or \
         repair the row"
    );
    "0.05,1000001,0".clone_into(&mut broken[5]);
    assert!(refusal(&text("time,q1,tau1", &broken), 1).contains("`q1` is 1.000001e6"));
}

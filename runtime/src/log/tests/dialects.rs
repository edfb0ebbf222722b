//! Logs as spreadsheets, pandas, test rigs and ROS write them: read as they are, with a note of what is assumed.

use super::{Columns, DriveSignal, Log, Note, Pieces};
use super::{assert_same, notes, read, refusal, rows, text};

fn plain() -> Log {
    read(&text("time,q1,tau1", &rows(40)), 1).expect("a log")
}

fn log(text: &str) -> Log {
    read(text, 1).unwrap_or_else(|error| panic!("{error}\n{text}"))
}

#[test]
fn decimal_commas_are_points_where_columns_are_separated_otherwise() {
    for separator in [";", "\t", "  ", "|"] {
        let decimal = |row: &String| row.replace(',', separator).replace('.', ",");
        let rows: Vec<String> = rows(40).iter().map(decimal).collect();
        let log = log(&text(&format!("time{separator}q1{separator}tau1"), &rows));
        assert_same(&log, &plain());
        assert_eq!(
            notes(&log),
            ["commas in numbers are read as decimal points"]
        );
    }
    // A comma that may part thousands.
    let mut mixed: Vec<String> = rows(40).iter().map(|row| row.replace(',', ";")).collect();
    mixed[20] = "0.2;1,234;40".to_owned();
    assert_eq!(
        refusal(&text("time;q1;tau1", &mixed), 1),
        "monday.csv:22: `1,234` in column `q1` is not a number: decimals above use a point; write all with a point"
    );
    let mut commas: Vec<String> = rows(40)
        .iter()
        .map(|row| row.replace(',', ";").replace('.', ","))
        .collect();
    commas[20] = "0,2;1.234;40".to_owned();
    assert_eq!(
        refusal(&text("time;q1;tau1", &commas), 1),
        "monday.csv:22: `1.234` in column `q1` is not a number: decimals above use a comma; write all with a point"
    );
}

#[test]
fn separators_at_ends_of_lines_are_no_columns() {
    let ended: Vec<String> = rows(40).iter().map(|row| format!("{row},")).collect();
    let twice: Vec<String> = rows(40).iter().map(|row| format!("{row},,")).collect();
    for (header, rows) in [
        ("time,q1,tau1,", &ended),
        ("time,q1,tau1", &ended),
        ("time,q1,tau1,,", &rows(40)),
        ("time,q1,tau1,", &twice),
    ] {
        assert_eq!(log(&text(header, rows)), plain(), "{header}");
    }
    let mut other = ended;
    other[3] = rows(4)[3].clone();
    assert!(
        refusal(&text("time,q1,tau1", &other), 1).starts_with("monday.csv:5: the row has 3 fields")
    );
    other[3] = format!("{},7", rows(4)[3]);
    assert!(
        refusal(&text("time,q1,tau1", &other), 1).starts_with("monday.csv:5: the row has 4 fields")
    );
    assert_eq!(
        refusal(&text("time,q1,tau1,", &other), 1),
        "monday.csv:5: column 4 has no name; name every column of numbers; only a first column that counts the rows may have none"
    );
}

#[test]
fn row_numbers_of_pandas_are_no_column() {
    let numbered = |number: &dyn Fn(usize) -> String| {
        let rows = rows(40).into_iter().enumerate();
        let rows: Vec<String> = rows
            .map(|(k, row)| format!("{},{row}", number(k)))
            .collect();
        text(",time,q1,tau1", &rows)
    };
    // With rows that were dropped, too.
    for number in
        [&|k| k.to_string(), &|k: usize| (3 * k + 7).to_string()] as [&dyn Fn(usize) -> String; 2]
    {
        let log = log(&numbered(number));
        assert_same(&log, &plain());
        assert_eq!(
            notes(&log),
            ["the first column has no name and counts the rows: it is ignored"]
        );
    }
    for (number, line) in [
        (
            &(|k: usize| (k % 20).to_string()) as &dyn Fn(usize) -> String,
            22,
        ),
        (&|k| format!("{k}.5"), 2),
        (&|_| "x".to_owned(), 2),
    ] {
        let said = refusal(&numbered(number), 1);
        assert!(
            said.starts_with(&format!("monday.csv:{line}: column 1 has no name")),
            "{said}"
        );
    }
}

#[test]
fn spreadsheets_say_their_separator() {
    let rows: Vec<String> = rows(40).iter().map(|row| row.replace(',', ";")).collect();
    assert_eq!(
        log(&format!("sep=;\n{}", text("time;q1;tau1", &rows))),
        plain()
    );
    // It holds against what the header looks like.
    let rows: Vec<String> = rows.iter().map(|row| format!("{row};1")).collect();
    let log = log(&format!("sep=;\n{}", text("time;q1;tau1;a,b,c,d,e", &rows)));
    assert_same(&log, &plain());
    assert_eq!(notes(&log), ["extra channels: `a,b,c,d,e`"]);
}

#[test]
fn units_below_the_names_are_read() {
    let with = |units: &str| format!("time,q1,tau1\n{units}\n{}\n", rows(40).join("\n"));
    let si = log(&with("s,rad,Nm"));
    assert_same(&si, &plain());
    assert_eq!(
        notes(&si),
        ["line 2 says units: `time` in s, `q1` in rad, `tau1` in Nm are read so"]
    );
    let degrees = log(&with("[s],[\u{b0}],[N m]"));
    assert!((degrees.q[0][7] - 0.7_f64.to_radians()).abs() < 1e-15);
    let sliding = log(&with("s,mm,N"));
    assert!((sliding.q[0][7] - 0.7e-3).abs() < 1e-15);
    // What settings say of a column holds.
    let mut columns = Columns::standard(1);
    columns.q[0].unit = Some(-2.0);
    let own =
        Log::from_reader_as("monday.csv", with("s,counts,Nm").as_bytes(), &columns).expect("a log");
    assert!((own.q[0][7] + 1.4).abs() < 1e-15);
    // Who says another unit of it is told.
    let mut columns = Columns::standard(1);
    (columns.q[0].unit, columns.tau[0].unit) = (Some(1.0), Some(1.0));
    let own = |units: &str| {
        let text = with(units);
        let log = Log::from_reader_as("monday.csv", text.as_bytes(), &columns);
        notes(&log.expect("a log")).remove(0)
    };
    assert_eq!(
        own("s,deg,Nm"),
        "line 2 says units: `time` in s are read so; `q1` in deg, but settings give another unit, which is used; remove the wrong one"
    );
    assert_eq!(
        own("s,rad,Nm"),
        "line 2 says units: `time` in s are read so"
    );
    // A unit that is 1 is said, too.
    let mut columns = Columns::standard(1);
    columns.tau[0].unit = Some(1.0);
    let own = Log::from_reader_as("monday.csv", with("s,rad,A").as_bytes(), &columns);
    assert!((own.expect("a log").tau[0][7] - log(&with("s,rad,Nm")).tau[0][7]).abs() < 1e-15);
    // Where the arm makes torques of currents a line may say these, and no torques.
    let mut columns = Columns::standard(1);
    columns.signals = vec![DriveSignal::Current];
    let read = |units: &str| Log::from_reader_as("monday.csv", with(units).as_bytes(), &columns);
    let amperes = read("s,rad,[A]").expect("a log").tau[0][7];
    assert!((amperes - plain().tau[0][7]).abs() < 1e-15);
    let refused = read("s,rad,Nm").expect_err("a torque").to_string();
    assert!(
        refused.contains("remove it for a log of torques"),
        "{refused}"
    );
    // Of plain numbers it says nothing.
    let mut columns = Columns::standard(1);
    columns.signals = vec![DriveSignal::Number];
    let numbers = Log::from_reader_as("monday.csv", with("s,rad,kN").as_bytes(), &columns);
    assert!((numbers.expect("a log").tau[0][7] - plain().tau[0][7]).abs() < 1e-15);
    for (units, words) in [
        (
            "s,turns,Nm",
            "monday.csv:2: the line below the header has no numbers, and `turns` is not a unit of column `q1`; write one of `rad`, `deg`, \
             `rev`, `m`, `cm`, `mm`, `um`, or remove the line",
        ),
        (
            "s,mm,Nm",
            "`Nm` is not a unit of column `tau1`; write one of `N`, `kN`, or",
        ),
        (
            "s,rad,A",
            "`A` is not a unit of column `tau1`; write one of `Nm`, or remove the line and give units in the spec's `log`, or in its \
             settings (a current needs an `actuator_gain`",
        ),
    ] {
        let said = refusal(&with(units), 1);
        assert!(said.contains(words), "{said}");
    }
    let degrees = with("s,deg,Nm");
    let pieces = Pieces::new(
        "monday.csv",
        degrees.as_bytes(),
        &Columns::standard(1),
        16,
        0.02,
    );
    let pieces: Vec<Log> = pieces
        .expect("a header")
        .map(|piece| piece.expect("a piece"))
        .collect();
    assert!(pieces[1].q[0][0] < 0.05 && pieces[0].report.len() == 1 && pieces[1].report.is_empty());
}

#[test]
fn blanks_and_bars_separate_columns() {
    let padded: Vec<String> = rows(40)
        .iter()
        .map(|row| format!("  {}  ", row.replace(',', "    ")))
        .collect();
    assert_eq!(log(&text("  time   q1  tau1", &padded)), plain());
    let barred: Vec<String> = rows(40).iter().map(|row| row.replace(',', " | ")).collect();
    assert_eq!(log(&text("time | q1 | tau1", &barred)), plain());
    assert_eq!(
        refusal(&text("time:q1:tau1", &rows(40)), 1),
        "monday.csv:1: the header `time:q1:tau1` is one column; write one name per column, separated by `,`, `;`, `|`, tabs or blanks"
    );
}

/// What `identify --json` wrote, say.
#[test]
fn json_is_told_as_what_it_is() {
    assert_eq!(
        refusal("{\n  \"parameters\": []\n}\n", 1),
        "monday.csv:1: this looks like JSON, and logs are CSV (plain or gzip), Parquet or MCAP; parameter files go behind `--parameters`"
    );
}

#[test]
fn utf16_behind_its_mark_is_read() {
    let all = format!("\u{feff}{}", text("time,q1,tau1", &rows(40)));
    let little: Vec<u8> = all.encode_utf16().flat_map(u16::to_le_bytes).collect();
    let big: Vec<u8> = all.encode_utf16().flat_map(u16::to_be_bytes).collect();
    for bytes in [&little, &big] {
        assert_eq!(
            Log::from_reader("monday.csv", &**bytes, 1).expect("a log"),
            plain()
        );
    }
    let refused = |bytes: &[u8]| {
        Log::from_reader("monday.csv", bytes, 1)
            .expect_err("no log")
            .to_string()
    };
    let said = refused(&little[2..]);
    assert!(
        said.starts_with("monday.csv:1: byte 0x00 in `")
            && said.contains("iconv -f utf16 -t utf8 monday.csv"),
        "{said}"
    );
    assert_eq!(
        refused(b"time,q1,Winkel \xb0,tau1\n0,1,2,3\n"),
        "monday.csv:1: byte 0xb0 in `Winkel \u{fffd}` is not UTF-8 text; save the log as CSV in UTF-8, or convert it: `iconv -f latin1 -t \
         utf8 monday.csv > utf8.csv`"
    );
}

#[test]
fn times_of_day_are_seconds_since_the_first() {
    let stamped = |stamp: &dyn Fn(&str) -> String| {
        let rows = rows(40).into_iter().map(|row| {
            let (time, rest) = row.split_once(',').expect("three fields");
            format!("{},{rest}", stamp(&time[1..]))
        });
        rows.collect::<Vec<_>>()
    };
    for stamp in [
        &(|rest: &str| format!("12:59:59{rest}")) as &dyn Fn(&str) -> String,
        &|rest: &str| format!("2024-03-01T12:59:59{rest}Z"),
        &|rest: &str| format!("2024-03-01 12:59:59{rest}"),
    ] {
        let read = log(&text("time,q1,tau1", &stamped(stamp)));
        assert_eq!((&read.q, &read.tau), (&plain().q, &plain().tau));
        assert!((read.time[7] - 0.07).abs() < 1e-9 && read.time[0].abs() < 1e-12);
        assert!(matches!(&read.report[0], Note::Clock { first } if first.contains("12:59:59.000")));
    }
    let mut broken = stamped(&|rest| format!("12:00:00{rest}"));
    broken[9] = "0.09,1,2".to_owned();
    let said = refusal(&text("time,q1,tau1", &broken), 1);
    assert!(
        said.starts_with("monday.csv:11: `0.09` in column `time` is not a number"),
        "{said}"
    );
}

#[test]
fn seconds_and_nanoseconds_are_one_time() {
    let rows = (0..40).map(|k| {
        let nanoseconds = 900_000_000 + 10_000_000 * k;
        let row = (
            1_700_000_000 + nanoseconds / 1_000_000_000,
            nanoseconds % 1_000_000_000,
        );
        format!("{},{},{},{}", row.0, row.1, 0.1 * f64::from(k), 2 * k)
    });
    let read = log(&text("secs,nsecs,q1,tau1", &rows.collect::<Vec<_>>()));
    assert!((read.time[30] - read.time[0] - 0.3).abs() < 1e-9);
    assert_eq!((&read.q[0][30], &read.tau[0][30]), (&3.0, &60.0));
    assert_eq!(
        notes(&read),
        [
            "time is the sum of `secs` and `nsecs`, in seconds since the first",
            "extra channels: `secs`, `nsecs`"
        ]
    );
}

#[test]
fn files_of_other_kinds_are_told_without_their_bytes() {
    for (bytes, words) in [
        (
            b"#ROSBAG V2.0\nE\0\0\0".as_slice(),
            "a bag of ROS 1; `rosbags-convert",
        ),
        (
            b"MATLAB 5.0 MAT-file, \0\0",
            "a file of MATLAB; `writetable(",
        ),
        (
            b"PK\x03\x04\x14\0\0\0",
            "a ZIP archive or a workbook of a spreadsheet; unpack it",
        ),
    ] {
        let said = Log::from_reader("monday.bag", bytes, 1)
            .expect_err("no log")
            .to_string();
        assert!(
            said.starts_with("monday.bag:1: no log is read from ") && said.contains(words),
            "{said}"
        );
    }
    let said = Log::from_reader("a.csv", b"\x1b[31m,\x07q1\n0,1\n".as_slice(), 1)
        .expect_err("no log")
        .to_string();
    assert!(
        said.starts_with("a.csv:1: byte 0x1b in `\\u{1b}[31m`"),
        "{said}"
    );
}

#[test]
fn columns_of_nearly_standard_names_come_with_the_settings_that_name_them() {
    let lines = |header: &str, dof: usize| {
        let row = vec!["0"; header.split(',').count()].join(",");
        match read(&text(header, &[row]), dof).expect_err("must be refused") {
            super::LogError::Misspelled { lines, .. }
            | super::LogError::NoSuchJoint { lines, .. } => lines,
            other => panic!("{other}"),
        }
    };
    assert_eq!(
        lines("Time,Q1,Q2,tau_1,tau_2", 2),
        [
            "time = \"Time\"",
            "q = [\"Q1\", \"Q2\"]",
            "tau = [\"tau_1\", \"tau_2\"]"
        ]
    );
    assert_eq!(
        lines("time,q1,q0,tau0,tau1", 2),
        ["q = [\"q0\", \"q1\"]", "tau = [\"tau0\", \"tau1\"]"]
    );
    assert_eq!(lines("time,q1,q2,q3,tau1,tau2", 2), [""; 0]);
    // Units in brackets are those of the columns, where all of a family are known.
    assert_eq!(
        lines(
            "time [ms],q1 [\u{b0}],q[2] (mm),dq1 [rpm],dq2,tau_1 (N m),tau_2 [Nm]",
            2
        ),
        [
            "time = { column = \"time [ms]\", unit = \"ms\" }",
            "q = { columns = [\"q1 [\u{b0}]\", \"q[2] (mm)\"], unit = [\"deg\", \"mm\"] }",
            "dq = [\"dq1 [rpm]\", \"dq2\"]",
            "tau = { columns = [\"tau_1 (N m)\", \"tau_2 [Nm]\"], unit = \"Nm\" }",
        ]
    );
    // Velocities of joints that are not there are not asked for.
    let row = "0,0,0,0,0,0,0".to_owned();
    assert!(
        refusal(&text("time,q1,q2,dq1,dq2,tau1,tau2", &[row]), 3)
            .starts_with("monday.csv:1: missing columns `q3`, `tau3`; ")
    );
}

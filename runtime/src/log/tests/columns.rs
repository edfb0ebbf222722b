//! Columns of other names and units than the standard ones.

use super::*;

/// Columns of other names and units: the same log as with standard ones; those that hold no numbers are left out, and told.
#[test]
fn columns_may_have_other_names_and_units() {
    let column = |name: &str, unit: f64| Column {
        name: name.to_owned(),
        unit: Some(unit),
    };
    let columns = Columns {
        time: column("stamp", 1e-3),
        q: vec![column("pos.b", 2.0), column("pos.a", -1.0)],
        dq: vec![column("v.b", 1.0), column("v.a", 1.0)],
        tau: vec![column("i.b", 0.5), column("i.a", 1.0)],
        extra: vec![("temperature".to_owned(), column("T", 0.1))],
        ..Columns::standard(2)
    };
    let rows: Vec<String> = (0..40)
        .map(|k| format!("{},{k},OK,{},{},7,{},305", 10 * k, 2 * k, 3 * k, 4 * k))
        .collect();
    let text = text("stamp,pos.a,mode,pos.b,i.a,q9,i.b,T", &rows);
    let log = Log::from_reader_as("monday.csv", text.as_bytes(), &columns).expect("a sound log");
    assert!((log.time[3] - 0.03).abs() < 1e-15);
    let at_three: Vec<f64> = log
        .q
        .iter()
        .chain(&log.tau)
        .map(|channel| channel[3])
        .collect();
    assert_eq!(at_three, [12.0, -3.0, 6.0, 9.0]);
    assert!(log.dq.is_empty());
    let extra: Vec<(&str, f64)> = log
        .extra
        .iter()
        .map(|own| (own.name.as_str(), own.values[3]))
        .collect();
    assert_eq!(extra, [("temperature", 30.5), ("q9", 7.0)]);
    let report: Vec<String> = log.report.iter().map(ToString::to_string).collect();
    assert_eq!(
        report,
        [
            "columns without numbers are ignored: `mode`",
            "extra channels: `temperature`, `q9`"
        ]
    );
    let pieces = Pieces::new("monday.csv", text.as_bytes(), &columns, 16, 0.02).expect("a header");
    let pieces: Vec<Log> = pieces.map(|piece| piece.expect("a sound piece")).collect();
    assert_eq!(pieces[0].q[0][3], 12.0);
    assert!(pieces.iter().all(|piece| piece.extra.len() == 2));
}

/// What a simulation writes is read by its own names, and so told; what has neither is refused with the names that were asked for.
#[test]
fn standard_columns_stand_in_for_others() {
    let columns = Columns {
        tau: vec![Column {
            name: "current".to_owned(),
            unit: Some(2.0),
        }],
        ..Columns::standard(1)
    };
    let read = |header: &str| {
        let text = text(header, &rows(20));
        Log::from_reader_as("monday.csv", text.as_bytes(), &columns)
    };
    let log = read("time,q1,tau1").expect("a sound log");
    assert_eq!(
        (log.tau[0][3], &log.report[0]),
        (
            6.0,
            &Note::StandardColumns {
                missing: vec!["current".to_owned()]
            }
        )
    );
    let log = read("time,q1,current").expect("a sound log");
    assert_eq!((log.tau[0][3], log.report.len()), (12.0, 0));
    let refused = |header: &str| read(header).expect_err("no torque").to_string();
    assert_eq!(
        refused("time,q1,curent"),
        "monday.csv:1: missing column `current`; the header has `time`, `q1`, `curent`"
    );
    // Positions keep their standard names here, and slips in them are told.
    assert!(refused("time,qq1,current").contains("write `q1`"));
}

/// One column cannot be two channels, and a raw column does not take the place of an input's own.
#[test]
fn columns_are_not_mixed_up() {
    let column = |name: &str| Column {
        name: name.to_owned(),
        unit: Some(0.1),
    };
    let mut columns = Columns::standard(1);
    columns.extra = vec![("temperature".to_owned(), column("tau1"))];
    let read = |columns: &Columns, header: &str| {
        let rows: Vec<String> = rows(20).iter().map(|row| format!("{row},7")).collect();
        let text = text(header, &rows);
        Log::from_reader_as("monday.csv", text.as_bytes(), columns)
            .expect_err("must be refused")
            .to_string()
    };
    let refused = read(&columns, "time,q1,tau1,temperature");
    assert!(
        refused.contains("`tau1` would be two channels"),
        "{refused}"
    );
    columns.extra = vec![("temperature".to_owned(), column("temp"))];
    columns.q = vec![column("pos")];
    let refused = read(&columns, "time,pos,tau1,temperature");
    assert!(refused.contains("missing column `temp`"), "{refused}");
}

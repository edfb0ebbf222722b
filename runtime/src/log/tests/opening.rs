//! Where a text's header is, and what separates its columns.

use super::{Log, assert_same, notes, read, refusal, rows, text};

#[test]
fn comments_above_a_header_are_passed_over() {
    let plain = read(&text("time,q1,tau1", &rows(40)), 1).expect("a log");
    let above = "# of Monday, cold\n% export 3\n\n";
    for header in [
        // As NumPy writes a header, alone and below other comments.
        "# time,q1,tau1".to_owned(),
        "\u{feff}#time, q1, tau1".to_owned(),
        format!("{above}# time,q1,tau1"),
        format!("{above}time,q1,tau1"),
        format!("# time,q1,tau1 in s, deg, Nm\n{above}time,q1,tau1"),
    ] {
        let log = read(&text(&header, &rows(40)), 1).unwrap_or_else(|error| panic!("{error}"));
        assert_eq!(log, plain, "{header}");
    }
    // Text in a column that nobody asks for, and a name with commas.
    let texts: Vec<String> = rows(40).iter().map(|row| format!("{row},run")).collect();
    for header in ["# time,q1,tau1,mode", "time,q1,tau1,\"a; b; c; d; e\""] {
        let log = read(&text(header, &texts), 1).unwrap_or_else(|error| panic!("{error}"));
        assert_eq!((&log.q, &log.tau), (&plain.q, &plain.tau), "{header}");
    }
    // A row that has lost a number is no header either.
    let mut lost = rows(40);
    lost[0] = "0.000,,0".to_owned();
    let [commented, plain] =
        ["# time,q1,tau1", "time,q1,tau1"].map(|header| read(&text(header, &lost), 1));
    assert_eq!(commented.expect("a log").q, plain.expect("a log").q);
}

#[test]
fn lines_are_counted_from_the_top_of_the_file() {
    let mut broken = rows(40);
    broken[5] = "0.05,x,1".to_owned();
    for (header, line) in [
        ("time,q1,tau1", 7),
        ("# a\n\n% b\ntime,q1,tau1", 10),
        ("# a\n# time,q1,tau1", 8),
    ] {
        assert_eq!(
            refusal(&text(header, &broken), 1),
            format!(
                "monday.csv:{line}: `x` in column `q1` is not a number; repair or remove the row"
            )
        );
    }
}

#[test]
fn comments_alone_are_no_log() {
    for empty in ["", "\n\n", "# time,q1,tau1\n", "# a\n% b"] {
        assert_eq!(
            refusal(empty, 1),
            "monday.csv: the log is empty; name the file that has the samples, as a header `time,q1,..,tau1,..` and a row for each",
            "{empty:?}"
        );
    }
    // A comment that is no header does not become one, as it is apart from the numbers.
    let apart = text("# time,q1,tau1\n\n", &rows(40));
    assert!(refusal(&apart, 1).contains("the log has no header"));
}

#[test]
fn columns_are_separated_as_the_header_is() {
    let plain = read(&text("time,q1,tau1", &rows(40)), 1).expect("a log");
    for separator in [";", "\t", " ; "] {
        let other = text("time,q1,tau1", &rows(40)).replace(',', separator);
        let log = read(&other, 1).unwrap_or_else(|error| panic!("{error}"));
        assert_eq!(log, plain, "{separator:?}");
    }
}

#[test]
fn what_stands_above_the_header_is_passed_over_or_told() {
    let body = text("time,q1,tau1", &rows(40));
    let plain = plain_log(&body);
    for above in ["// by hand\n", "; by hand\n% b\n", "# a\n// b\n\n"] {
        assert_eq!(plain_log(&format!("{above}{body}")), plain, "{above}");
    }
    let read = plain_log(&format!(
        "Robot: UR5, left\nDate = Monday\n\nRecorded by hand\n{body}"
    ));
    assert_same(&read, &plain);
    assert_eq!(
        notes(&read),
        ["the header is line 5: 4 lines above it are passed over: `Robot: UR5, left` and so on"]
    );
    // Lines are counted from the top.
    let mut broken = rows(40);
    broken[5] = "0.05,x,1".to_owned();
    let said = refusal(&format!("Robot: UR5\n{}", text("time,q1,tau1", &broken)), 1);
    assert!(
        said.starts_with("monday.csv:8: `x` in column `q1`"),
        "{said}"
    );
}

#[test]
fn groups_of_columns_and_fields_above_a_header_are_passed_over() {
    let two: Vec<String> = rows(40).iter().map(|row| format!("{row},3,4")).collect();
    let header = "time,q1,tau1,q2,tau2";
    let plain = read(&text(header, &two), 2).expect("a log");
    for above in [
        ",joint 1,,joint 2,",
        "drive,joint 1,joint 1,joint 2,joint 2",
        "Robot,UR5",
        "Robot,UR5\nStarted,2024-03-01\n\n,joint 1,,joint 2,",
        // As wide as the header and all distinct, and nothing that is asked for.
        "clock,angle of 1,load of 1,angle of 2,load of 2",
    ] {
        for units in ["", "s,deg,Nm,deg,Nm\n"] {
            let all = format!("{above}\n{header}\n{units}{}\n", two.join("\n"));
            let log = read(&all, 2).unwrap_or_else(|error| panic!("{error}\n{all}"));
            assert_eq!((&log.time, &log.tau), (&plain.time, &plain.tau), "{above}");
            let degrees = if units.is_empty() {
                1.0
            } else {
                1_f64.to_radians()
            };
            assert!(
                (log.q[0][7] - degrees * plain.q[0][7]).abs() < 1e-15,
                "{above}"
            );
            let line = above.lines().count() + 1;
            let said = format!("the header is line {line}: ");
            let notes = notes(&log);
            assert!(
                notes.iter().any(|note| note.starts_with(&said)),
                "{notes:?}"
            );
        }
    }
    // What may be names as well is not passed over.
    let twice = format!("time,q1,tau1\n\n{}", text("time,q1,tau1", &rows(40)));
    assert_eq!(
        refusal(&twice, 1),
        "monday.csv:1: both this line and line 3 above the rows may be the header; remove the lines above the header, or begin each with `#`"
    );
    let below = refusal(&format!("Robot,UR5\n\n{twice}"), 1);
    assert!(
        below.starts_with("monday.csv:3: both this line and line 5"),
        "{below}"
    );
}

#[test]
fn names_that_are_asked_for_are_the_header_and_not_units() {
    let in_degrees = |header: &str, units: &str, more: &str| {
        let rows = rows(40).into_iter().enumerate();
        let front = |k: usize| {
            if header.starts_with(',') {
                format!("{k},")
            } else {
                String::new()
            }
        };
        let rows: Vec<String> = rows
            .map(|(k, row)| format!("{}{row}{more}", front(k)))
            .collect();
        format!("{header}\n{units}\n{}\n", rows.join("\n"))
    };
    let plain = read(&text("time,q1,tau1", &rows(40)), 1).expect("a log");
    // The first column counts rows; names may be quoted.
    for (header, units, more) in [
        (",time,q1,tau1", "-,s,deg,Nm", ""),
        ("\"time\",\"q1\",\"tau1\"", "s,deg,Nm", ""),
    ] {
        let log = read(&in_degrees(header, units, more), 1)
            .unwrap_or_else(|error| panic!("{header}: {error}"));
        assert_eq!((&log.time, &log.tau), (&plain.time, &plain.tau), "{header}");
        assert!(
            (log.q[0][7] - plain.q[0][7].to_radians()).abs() < 1e-15,
            "{header}"
        );
    }
    for (header, units, more, said) in [
        (
            "time,q1,tau1,",
            "s,deg,Nm,degC",
            ",20",
            "monday.csv:3: column 4 has no name",
        ),
        (
            "time,q1,tau1,temp,temp",
            "s,deg,Nm,degC,degC",
            ",20,21",
            "monday.csv:1: column `temp` appears twice",
        ),
        (
            "\"time\",\"q1\",\"tau1\",\"temp\",\"temp\"",
            "s,deg,Nm,degC,degC",
            ",20,21",
            "monday.csv:1: column `temp` appears twice",
        ),
        (
            "time,q1,tau1\nclock,angle,load",
            "s,deg,Nm",
            "",
            "monday.csv:2: the header is line 1, and only one line of units may follow it before",
        ),
    ] {
        let told = refusal(&in_degrees(header, units, more), 1);
        assert!(told.starts_with(said), "{told}");
    }
}

#[test]
fn channels_beside_those_that_are_meant_are_extra() {
    for name in [
        "q1 (ref)",
        "tau1 (filtered)",
        "dq1 [est]",
        "q1 [deg]",
        "q_1",
        "time (host)",
        "q7 (lift)",
    ] {
        let rows: Vec<String> = rows(40).iter().map(|row| format!("{row},3")).collect();
        let log = read(&text(&format!("time,q1,tau1,{name}"), &rows), 1)
            .unwrap_or_else(|error| panic!("{name}: {error}"));
        assert_eq!(log.extra[0].name, name);
        assert!(
            log.extra[0]
                .values
                .iter()
                .all(|value| (value - 3.0).abs() < 1e-15)
        );
    }
}

#[test]
fn mistakes_of_a_header_have_its_line() {
    let above = "Robot,UR5\n\n,joint 1,\n";
    for (header, said) in [
        (
            "time,q1,load",
            "missing column `tau1`; the header has `time`, `q1`, `load`",
        ),
        ("time,q1,q1", "column `q1` appears twice"),
        ("time,q1,tau_1", "unknown column `tau_1`: write `tau1`"),
        ("time,q1,tau7", "unknown column `tau7`: the arm has 1 joint"),
        (
            "time [s],q1,tau1",
            "unknown column `time [s]`: write `time`",
        ),
    ] {
        let told = refusal(&format!("{above}{}", text(header, &rows(40))), 1);
        assert!(told.starts_with(&format!("monday.csv:4: {said}")), "{told}");
    }
    let numbers = format!("# of Monday\n\n{}\n", rows(40).join("\n"));
    assert!(refusal(&numbers, 1).starts_with("monday.csv:3: the log has no header; write"));
}

fn plain_log(text: &str) -> Log {
    read(text, 1).unwrap_or_else(|error| panic!("{error}\n{text}"))
}

/// A file that was cut inside its last number has one that is shorter than the others; one without a last line end is whole where it is not.
#[test]
fn a_last_number_that_may_be_cut_is_told() {
    let text = text("time,q1,tau1", &rows(40));
    let whole = text.trim_end();
    assert_eq!(notes(&read(whole, 1).expect("a log")), [""; 0]);
    let cut = &whole[..whole.len() - 1];
    let wanted = "line 41, the last one, has no end, and its last number is shorter than the one above: if the file was cut there, remove that line";
    assert_eq!(notes(&read(cut, 1).expect("a log")), [wanted]);
    assert_eq!(
        notes(&read(&format!("{cut}\n"), 1).expect("a log")),
        [""; 0]
    );
}

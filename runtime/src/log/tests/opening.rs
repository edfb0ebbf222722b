//! Where a text's header is, and what separates its columns.

use super::{read, refusal, rows, text};

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
            "monday.csv: the log is empty",
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

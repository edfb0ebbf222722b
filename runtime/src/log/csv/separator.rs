//! What separates columns.

/// What stands for any number of blanks.
pub(super) const BLANKS: u8 = b' ';

/// What may separate columns. Names and times are written with blanks, so these do only where nothing else does.
pub(super) const ALL: [u8; 5] = [b',', b';', b'\t', b'|', BLANKS];

/// That which there is most of in a header, quoted names left out.
pub(super) fn of(text: &[u8]) -> u8 {
    let header = text.split(|byte| *byte == b'\n').next().unwrap_or(text);
    let header = header.trim_ascii();
    let plain = || header.split(|byte| *byte == b'"').step_by(2).flatten();
    let count = |separator: u8| plain().filter(|byte| **byte == separator).count();
    let most = |best: u8, next: u8| {
        let is_more = count(next) > count(best);
        if is_more && (next != BLANKS || count(best) == 0) {
            next
        } else {
            best
        }
    };
    ALL.into_iter().reduce(most).unwrap_or(b',')
}

/// What a first line `sep=;` says, as spreadsheets write it.
pub(super) fn said(line: &[u8]) -> Option<u8> {
    let line = line
        .strip_prefix(b"\"")
        .and_then(|line| line.strip_suffix(b"\""))
        .unwrap_or(line);
    let (name, said) = line.split_at_checked(4)?;
    match said {
        // A tab at the end is no part of the line any more.
        _ if !name.eq_ignore_ascii_case(b"sep=") => None,
        [] => Some(b'\t'),
        [separator] if ALL.contains(separator) => Some(*separator),
        _ => None,
    }
}

/// Fields of a line, without blanks around them.
pub(super) fn fields(line: &[u8], separator: u8) -> Vec<&[u8]> {
    let fields = line.split(|byte| *byte == separator || is_blank(*byte, separator));
    let fields = fields.map(<[u8]>::trim_ascii);
    if separator == BLANKS {
        fields.filter(|field| !field.is_empty()).collect()
    } else {
        fields.collect()
    }
}

fn is_blank(byte: u8, separator: u8) -> bool {
    separator == BLANKS && byte.is_ascii_whitespace()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_header_says_what_separates_its_columns() {
        for (header, separator) in [
            ("time,q1,tau1", b','),
            ("time;q 1;\"a, b, c, d\"", b';'),
            ("time\tq1\ttau1", b'\t'),
            ("time | q1 | tau1", b'|'),
            ("time   q1 tau1", BLANKS),
            ("time of day, q1", b','),
            ("time", b','),
        ] {
            assert_eq!(of(header.as_bytes()), separator, "{header}");
        }
    }

    #[test]
    fn spreadsheets_say_it_above() {
        for (line, separator) in [
            ("sep=;", Some(b';')),
            ("\"SEP=,\"", Some(b',')),
            ("sep=", Some(b'\t')),
            ("sep=x", None),
            ("separator", None),
            ("s", None),
        ] {
            assert_eq!(said(line.as_bytes()), separator, "{line}");
        }
    }
}

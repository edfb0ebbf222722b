//! Tables that the program writes: one home for their headers and their numbers, by which they are told from measured ones.

use std::fmt::Write;

/// Columns of a table, and how its numbers are written.
pub(crate) struct Table {
    /// Families of one column a joint, behind the time.
    families: &'static [&'static str],
    /// Whether other columns may follow.
    has_more: bool,
    time: fn(f64) -> String,
    value: fn(f64) -> String,
    /// Significant digits that one of its numbers has, at least.
    digits: usize,
}

/// A motion of `excite`.
pub(crate) const MOTION: Table = Table {
    families: &["q", "dq", "ddq"],
    has_more: false,
    time: |time| time.to_string(),
    value: |value| format!("{value:.12e}"),
    digits: 0,
};

/// Torques that `trace` predicts: nanoseconds, and more digits than any torque has.
pub(crate) const PREDICTION: Table = Table {
    families: &["tau"],
    has_more: false,
    time: |time| format!("{time:.9}"),
    value: |value| format!("{value:.8e}"),
    digits: 0,
};

/// A log of `simulate`. A measured log may have its columns, but hardly ever all digits of a computed number.
pub(crate) const SIMULATION: Table = Table {
    families: &["q", "dq", "tau"],
    has_more: true,
    time: |time| time.to_string(),
    value: |value| value.to_string(),
    digits: 16,
};

impl Table {
    /// The names of the columns of an arm, without those that may follow.
    pub(crate) fn header(&self, joints: usize) -> String {
        let mut header = String::from("time");
        for family in self.families {
            for joint in 1..=joints {
                let _ = write!(header, ",{family}{joint}");
            }
        }
        header
    }

    /// Writes a row below others.
    pub(crate) fn push(&self, text: &mut String, time: f64, values: impl Iterator<Item = f64>) {
        text.push_str(&(self.time)(time));
        for value in values {
            text.push(',');
            text.push_str(&(self.value)(value));
        }
        text.push('\n');
    }

    /// Whether a text begins as such a table does that this program has written.
    pub(super) fn begins(&self, text: &str) -> bool {
        let whole = text.rsplit_once('\n').map_or("", |(whole, _)| whole);
        let mut lines = whole.split('\n');
        let header = lines.next().unwrap_or_default();
        let numbers = header
            .split(',')
            .filter_map(|name| name.strip_prefix(self.families[0]));
        let joints = numbers
            .filter(|number| number.parse::<u32>().is_ok())
            .count();
        let more = header.strip_prefix(&self.header(joints));
        let is_more = |more: &str| more.is_empty() || (self.has_more && more.starts_with(','));
        let is_header = joints > 0 && more.is_some_and(is_more);
        let rows: Vec<&str> = lines.collect();
        let mut fields = rows.iter().flat_map(|row| row.split(',').skip(1));
        is_header
            && rows.iter().all(|row| self.is_own(row))
            && fields.any(|field| digits(field) >= self.digits)
    }

    /// Whether a row has its numbers as this program writes them.
    fn is_own(&self, row: &str) -> bool {
        let numbers: Result<Vec<f64>, _> = row.split(',').map(str::parse).collect();
        let Some((time, values)) = numbers.as_deref().ok().and_then(<[f64]>::split_first) else {
            return false;
        };
        let mut again = String::new();
        self.push(&mut again, *time, values.iter().copied());
        again.trim_end() == row
    }
}

/// Digits of a number from the first that is not zero on.
fn digits(field: &str) -> usize {
    let mantissa = field.split('e').next().unwrap_or_default();
    let digits = mantissa.chars().filter(char::is_ascii_digit);
    digits.skip_while(|digit| *digit == '0').count()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn written(table: &Table, more: &str) -> String {
        let mut text = format!("{}{more}\n", table.header(1));
        let columns = text.trim_end().split(',').count() - 1;
        for time in [0.001, 0.002] {
            let values = (1..=columns).map(|k| (k as f64).sqrt() * time);
            table.push(&mut text, time, values);
        }
        text
    }

    #[test]
    fn tables_are_told_by_their_headers_and_numbers() {
        let all = [&MOTION, &PREDICTION, &SIMULATION];
        for (k, own) in all.iter().enumerate() {
            let text = written(own, "");
            for (other, table) in all.iter().enumerate() {
                assert_eq!(table.begins(&text), k == other, "{text}");
            }
            // A file is looked at no further than to some byte.
            assert!(own.begins(&text[..text.len() - 3]), "{text}");
            assert!(!own.begins(own.header(1).as_str()), "no row");
        }
        assert!(SIMULATION.begins(&written(&SIMULATION, ",temp")));
        assert!(!MOTION.begins(&written(&MOTION, ",temp")));
    }

    #[test]
    fn measured_tables_are_none_of_them() {
        for (table, text) in [
            (&PREDICTION, "time,tau1\n0,1\n0.001,2\n"),
            (&PREDICTION, "time,tau1\n0.000000000,1.25\n"),
            (&PREDICTION, "time,tau1\n0.000000000,1.25000000e+00\n"),
            (&MOTION, "time,q1,dq1,ddq1\n0,1.5,0.5,0\n"),
            (&SIMULATION, "time,q1,dq1,tau1\n0,0.12,0.5,1.5\n"),
            (
                &SIMULATION,
                "time,q1,dq1,tau1\n0.0,0.8414709848078965,0.5,1.5\n",
            ),
            (
                &SIMULATION,
                "time [s],q1 [rad],dq1 [rad/s],tau1 [Nm]\n0,0.8414709848078965,1,1\n",
            ),
            (
                &SIMULATION,
                "time;q1;dq1;tau1\n0;0.8414709848078965;0.5;1.5\n",
            ),
        ] {
            assert!(!table.begins(text), "{text}");
        }
    }
}

//! Time in two columns, seconds and nanoseconds, as messages of ROS have it: one column more, with their sum.

use super::super::note::Note;

/// Ends of names of seconds, and of what is added to them.
const ENDS: [(&str, &[&str]); 4] = [
    ("secs", &["nsecs"]),
    ("sec", &["nanosec", "nsec"]),
    ("seconds", &["nanoseconds"]),
    ("s", &["ns"]),
];

/// Where the time of a row is in two columns.
#[derive(Debug)]
pub(super) struct TwoTimes {
    pub seconds: usize,
    pub nanoseconds: usize,
    /// Seconds of the first row, which are taken off: a sum since 1970 has no room for nanoseconds.
    first: Option<f64>,
    note: Option<Note>,
}

impl TwoTimes {
    /// Two columns, of names with the same beginning, where there is exactly one such pair.
    pub fn of(names: &[String]) -> Option<Self> {
        let mut pairs = names.iter().enumerate().flat_map(|(seconds, name)| {
            let others = ENDS.iter().filter_map(|(end, others)| {
                let before = name.strip_suffix(end)?;
                let is_word = before.is_empty() || before.ends_with(['.', '_', ' ', '/']);
                is_word.then(|| others.iter().map(move |other| format!("{before}{other}")))
            });
            let others = others.flatten();
            others.filter_map(move |other| {
                let nanoseconds = names.iter().position(|name| *name == other)?;
                Some((seconds, nanoseconds))
            })
        });
        let (seconds, nanoseconds) = pairs.next()?;
        pairs.next().is_none().then(|| Self {
            seconds,
            nanoseconds,
            first: None,
            note: Some(Note::TwoTimes {
                seconds: names[seconds].clone(),
                nanoseconds: names[nanoseconds].clone(),
            }),
        })
    }

    /// Seconds since the first row's.
    pub fn time(&mut self, row: &[f64]) -> f64 {
        let seconds = row[self.seconds];
        if self.first.is_none() && seconds.is_finite() {
            self.first = Some(seconds);
        }
        (seconds - self.first.unwrap_or_default()) + 1e-9 * row[self.nanoseconds]
    }

    /// What is assumed, once.
    pub fn note(&mut self) -> Option<Note> {
        self.note.take()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_pair_of_one_beginning_is_a_time() {
        let of = |names: &[&str]| {
            let names: Vec<String> = names.iter().map(|name| (*name).to_owned()).collect();
            TwoTimes::of(&names).map(|two| (two.seconds, two.nanoseconds))
        };
        assert_eq!(of(&["secs", "nsecs", "q1"]), Some((0, 1)));
        assert_eq!(of(&["q1", "stamp.nanosec", "stamp.sec"]), Some((2, 1)));
        assert_eq!(
            of(&["header.stamp.sec", "q1", "header.stamp.nanosec"]),
            Some((0, 2))
        );
        for names in [
            ["secs", "q1", "q2", "q3"],
            ["sec", "a.nanosec", "q1", "q2"],
            ["a.sec", "a.nanosec", "b.sec", "b.nanosec"],
            ["axis", "axins", "q1", "q2"],
        ] {
            assert_eq!(of(&names), None, "{names:?}");
        }
    }

    #[test]
    fn nanoseconds_since_1970_keep_their_digits() {
        let names = ["secs".to_owned(), "nsecs".to_owned()];
        let mut two = TwoTimes::of(&names).expect("a pair");
        let first = two.time(&[1_700_000_000.0, 999_999_999.0]);
        let second = two.time(&[1_700_000_001.0, 1_000_000.0]);
        assert!(
            (second - first - 0.001_000_001).abs() < 1e-15,
            "{first} {second}"
        );
        assert!(two.time(&[f64::NAN, 0.0]).is_nan());
    }
}

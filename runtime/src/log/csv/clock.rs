//! Dates and times of day, as ISO 8601 has them, to seconds.

use super::super::note::Note;
use super::super::words;

/// Seconds of a day.
const DAY: f64 = 86_400.0;

/// A time of day, perhaps of a date.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Stamp {
    /// Days since 1970; none where there is no date.
    day: Option<i64>,
    /// Seconds of the day, in UTC where an offset is said.
    seconds: f64,
}

impl Stamp {
    /// `2024-03-01T12:00:00.25Z`, `2024-03-01 12:00:00,25+01:00`, `12:00:00.250`
    pub fn parse(text: &str) -> Option<Self> {
        let (date, time) = match text.split_once(['T', ' ']) {
            Some((date, time)) => (Some(day(date)?), time),
            None => (None, text),
        };
        let (time, offset) = match time.find(['Z', '+', '-']) {
            Some(at) => (&time[..at], offset(&time[at..])?),
            None => (time, 0.0),
        };
        let mut parts = time.split(':');
        let hours = digits(parts.next()?, 23)?;
        let minutes = digits(parts.next()?, 59)?;
        let seconds = parts.next().unwrap_or("0").replace(',', ".");
        let is_plain = seconds
            .bytes()
            .all(|byte| byte.is_ascii_digit() || byte == b'.');
        let seconds: f64 = seconds.parse().ok().filter(|_| is_plain)?;
        let is_sound = seconds < 61.0 && parts.next().is_none();
        is_sound.then_some(Self {
            day: date,
            seconds: 3600.0 * hours as f64 + 60.0 * minutes as f64 + seconds - offset,
        })
    }
}

/// Seconds that a place's time is ahead.
fn offset(text: &str) -> Option<f64> {
    if text == "Z" {
        return Some(0.0);
    }
    let (sign, rest) = match text.split_at_checked(1)? {
        ("+", rest) => (1.0, rest),
        ("-", rest) => (-1.0, rest),
        _ => return None,
    };
    let rest = rest.replace(':', "");
    let (hours, minutes) = rest.split_at_checked(2)?;
    let minutes = if minutes.is_empty() { "0" } else { minutes };
    Some(sign * (3600.0 * digits(hours, 23)? as f64 + 60.0 * digits(minutes, 59)? as f64))
}

/// A number of one or two digits, up to the most.
fn digits(text: &str, most: i64) -> Option<i64> {
    let is_short = (1..=2).contains(&text.len()) && text.bytes().all(|byte| byte.is_ascii_digit());
    let number = text.parse().ok().filter(|_| is_short)?;
    (number <= most).then_some(number)
}

/// Days since 1970 of `2024-03-01`, by the calendar of 400 years.
fn day(text: &str) -> Option<i64> {
    let mut parts = text.split(['-', '/']);
    let year = parts.next().filter(|year| year.len() == 4)?;
    let year: i64 = year.parse().ok().filter(|year| *year > 0)?;
    let month = digits(parts.next()?, 12).filter(|month| *month > 0)?;
    let day = digits(parts.next()?, 31).filter(|day| *day > 0)?;
    // Years that begin in March have the day of leap years at their end.
    let (year, month) = if month > 2 {
        (year, month - 3)
    } else {
        (year - 1, month + 9)
    };
    let of_year = (153 * month + 2) / 5 + day - 1;
    let leaps = year / 4 - year / 100 + year / 400;
    parts
        .next()
        .is_none()
        .then_some(365 * year + leaps + of_year - 719_468)
}

/// Times of rows, since the first.
#[derive(Debug)]
pub(super) struct Clock {
    first: Stamp,
    /// The last time, s.
    last: f64,
    /// Days that began, where times have no date.
    nights: f64,
    note: Option<Note>,
}

impl Clock {
    /// A clock that begins with a field.
    pub fn begin(text: &str) -> Option<Self> {
        Some(Self {
            first: Stamp::parse(text)?,
            last: 0.0,
            nights: 0.0,
            note: Some(Note::Clock {
                first: words::field(text),
            }),
        })
    }

    /// Seconds since the first time; none where a field is no time like that.
    pub fn seconds(&mut self, text: &str) -> Option<f64> {
        let stamp = Stamp::parse(text)?;
        let days = match (self.first.day, stamp.day) {
            (Some(first), Some(day)) => (day - first) as f64,
            (None, None) => self.nights,
            _ => return None,
        };
        let mut seconds = days * DAY + (stamp.seconds - self.first.seconds);
        if stamp.day.is_none() && seconds < self.last - DAY / 2.0 {
            self.nights += 1.0;
            seconds += DAY;
        }
        self.last = seconds;
        Some(seconds)
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
    fn times_are_seconds_since_the_first() {
        let since = |fields: &[&str]| -> Option<Vec<f64>> {
            let mut clock = Clock::begin(fields[0])?;
            fields.iter().map(|field| clock.seconds(field)).collect()
        };
        for (fields, seconds) in [
            (
                ["12:00:00.250", "12:00:00,75", "12:01:00"],
                [0.0, 0.5, 59.75],
            ),
            (["23:59:59", "00:00:00", "00:00:01.5"], [0.0, 1.0, 2.5]),
            (
                [
                    "2024-02-29T23:59:59Z",
                    "2024-03-01T00:00:01.5Z",
                    "2024-03-01T01:00:02+01:00",
                ],
                [0.0, 2.5, 3.0],
            ),
            (
                [
                    "2023/12/31 23:59:59",
                    "2024/01/01 0:00:00",
                    "2024-01-01 00:00",
                ],
                [0.0, 1.0, 1.0],
            ),
        ] {
            assert_eq!(since(&fields), Some(seconds.to_vec()), "{fields:?}");
        }
        assert_eq!(day("1970-01-01"), Some(0));
        assert_eq!(day("2024-03-01"), Some(19_783));
        for other in [
            "12",
            "12:61:00",
            "25:00:00",
            "12:00:-1",
            "12:00:NaN",
            "01.03.2024 12:00:00",
            "2024-13-01 12:00:00",
            "2024-03-01",
            "\u{b5}:00:00",
            "",
        ] {
            assert_eq!(Stamp::parse(other), None, "{other}");
        }
        // A date in some rows only.
        assert_eq!(since(&["12:00:00", "2024-03-01 12:00:01"]), None);
    }
}

//! Fields to numbers, with a point or a comma before the decimals.

use super::super::note::Note;
use super::super::words;
use super::super::{LogError, TextError};

/// What stands before decimals, as far as rows were read.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
enum Mark {
    #[default]
    Unknown,
    Point,
    Comma,
}

/// Numbers of a text. A comma is a decimal point where it separates no columns, and no number of the text has a point.
#[derive(Debug)]
pub(super) struct Numbers {
    may_be_comma: bool,
    mark: Mark,
    is_told: bool,
}

impl Numbers {
    pub fn of(separator: u8) -> Self {
        Self {
            may_be_comma: separator != b',',
            mark: Mark::default(),
            is_told: false,
        }
    }

    /// The number of a field; none where it is not one.
    pub fn value(&mut self, text: &str) -> Option<f64> {
        if let Ok(value) = text.parse::<f64>() {
            if !text.contains('.') {
                return Some(value);
            }
            if self.mark == Mark::Unknown {
                self.mark = Mark::Point;
            }
            return (self.mark == Mark::Point).then_some(value);
        }
        let value = comma(text).filter(|_| self.may_be_comma && self.mark != Mark::Point)?;
        self.mark = Mark::Comma;
        Some(value)
    }

    /// What is assumed, once.
    pub fn note(&mut self) -> Option<Note> {
        let is_new = self.mark == Mark::Comma && !self.is_told;
        self.is_told |= is_new;
        is_new.then_some(Note::DecimalCommas)
    }

    /// What to do about a field that is no number.
    pub fn refusal(&self, source: &str, line: u64, column: &str, text: &str) -> LogError {
        let (source_name, column) = (source.to_owned(), column.to_owned());
        let other = match self.mark {
            Mark::Point if self.may_be_comma && comma(text).is_some() => Some("point"),
            Mark::Comma if text.parse::<f64>().is_ok() => Some("comma"),
            _ => None,
        };
        let text = words::field(text);
        match other {
            Some(mark) => TextError::MixedDecimals {
                source_name,
                line,
                column,
                text,
                mark,
            }
            .into(),
            None => LogError::NotANumber {
                source_name,
                line,
                column,
                text,
            },
        }
    }
}

/// A number with one comma in place of the point.
fn comma(text: &str) -> Option<f64> {
    let (whole, decimals) = text.split_once(',')?;
    if text.contains('.') || decimals.contains(',') {
        return None;
    }
    format!("{whole}.{decimals}").parse().ok()
}

/// A number of whatever decimals.
pub(super) fn lenient(text: &str) -> Option<f64> {
    text.parse().ok().or_else(|| comma(text))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_comma_is_a_point_where_no_number_has_one() {
        let read = |separator: u8, fields: &[&str]| {
            let mut numbers = Numbers::of(separator);
            let values = fields.iter().map(|field| numbers.value(field));
            (
                values.collect::<Option<Vec<f64>>>(),
                numbers.note().is_some(),
            )
        };
        let commas = (Some(vec![3.0, 0.5, -1.25e-3]), true);
        assert_eq!(read(b';', &["3", "0,5", "-1,25e-3"]), commas);
        assert_eq!(read(b';', &["3", "0.5"]), (Some(vec![3.0, 0.5]), false));
        for fields in [
            ["0.5", "0,5"],
            ["0,5", "0.5"],
            ["1", "1,234,567"],
            ["1", "1.234,5"],
        ] {
            assert_eq!(read(b';', &fields).0, None, "{fields:?}");
        }
        assert_eq!(read(b',', &["0,5"]), (None, false));
    }
}

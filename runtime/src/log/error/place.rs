//! Where an error is in a text.

use super::{LogError, TextError};

/// A line of a text that an error is about.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct TextPlace<'a> {
    /// The file.
    pub source_name: &'a str,
    /// The line, from 1.
    pub line: u64,
    /// What is at fault there, where it is less than the whole line.
    pub words: Option<&'a str>,
    /// The number that is at fault there, as it was read.
    pub number: Option<f64>,
}

impl LogError {
    /// The line that the error is about; none where it is about the whole file, or where the log has no lines.
    ///
    /// # Examples
    /// ```
    /// # use robot_model::log::Log;
    /// let error = Log::from_reader("arm.csv", "time,q1,tau1\n0,0.1,2\n0.01,O.1,2\n".as_bytes(), 1).expect_err("a letter for a digit");
    /// let place = error.place().expect("a line");
    /// assert_eq!((place.source_name, place.line, place.words), ("arm.csv", 3, Some("O.1")));
    /// ```
    #[must_use]
    pub fn place(&self) -> Option<TextPlace<'_>> {
        let (source_name, line, words) = match self {
            Self::NotANumber {
                source_name,
                line,
                text,
                ..
            }
            | Self::NotFinite {
                source_name,
                line,
                text,
                ..
            } => (source_name, line, Some(text)),
            Self::DuplicateColumn {
                source_name,
                line,
                name,
            }
            | Self::NoSuchJoint {
                source_name,
                line,
                name,
                ..
            }
            | Self::Misspelled {
                source_name,
                line,
                name,
                ..
            } => (source_name, line, Some(name)),
            Self::UnnamedColumn {
                source_name, line, ..
            }
            | Self::TooManyColumns {
                source_name, line, ..
            }
            | Self::MissingColumns {
                source_name, line, ..
            }
            | Self::ColumnCount {
                source_name, line, ..
            } => (source_name, line, None),
            Self::Text(error) => return error.place(),
            Self::ManyLost { first, .. } => return first.place(),
            Self::TimeOrder {
                place,
                time: number,
                ..
            }
            | Self::Gap {
                place,
                time: number,
                ..
            }
            | Self::Implausible {
                place,
                value: number,
                ..
            } => return of_number(place, *number),
            _ => return None,
        };
        Some(TextPlace {
            source_name,
            line: *line,
            words: words.map(String::as_str),
            number: None,
        })
    }
}

impl TextError {
    fn place(&self) -> Option<TextPlace<'_>> {
        let (source_name, line, words) = match self {
            Self::NoHeader { source_name, line }
            | Self::Json { source_name, line }
            | Self::Separator {
                source_name, line, ..
            }
            | Self::Above {
                source_name, line, ..
            }
            | Self::Between {
                source_name, line, ..
            } => (source_name, line, None),
            Self::Unit {
                source_name,
                line,
                text,
                ..
            }
            | Self::MixedDecimals {
                source_name,
                line,
                text,
                ..
            } => (source_name, line, Some(text)),
            // What has no end, or is no text, is nothing to look at.
            Self::LongRow { .. } | Self::NotText { .. } => return None,
        };
        Some(TextPlace {
            source_name,
            line: *line,
            words: words.map(String::as_str),
            number: None,
        })
    }
}

/// `arm.csv:17`; a log of no lines has a sample's number there.
fn of_number(place: &str, number: f64) -> Option<TextPlace<'_>> {
    let (source_name, line) = place.rsplit_once(':')?;
    Some(TextPlace {
        source_name,
        line: line.parse().ok()?,
        words: None,
        number: Some(number),
    })
}

//! Where results go: standard output, and files that are there whole or not at all.

mod content;
mod files;
mod out_file;
mod record;
pub(crate) mod table;

use std::io::{self, Write};
use std::path::Path;

pub(crate) use content::{Content, MARK};
pub(crate) use files::Files;
pub(crate) use out_file::OutFile;
pub(crate) use record::Record;
pub(crate) use robot_model_spec::words::{counted, names};
use serde::Serialize;

use crate::Error;

/// What the errors in a table are.
pub(crate) const ERRORS: &str = "RMSE: raw samples, N m (prismatic joints: N), first and last second cut; relative: in the filtered band";

/// The same where all of them are told, of some series of torques.
pub(crate) fn errors(series: &str) -> String {
    format!(
        "RMSE, MAE, NRMSE fit: {series}, N m (prismatic joints: N), first and last second cut; RMS%: relative, in the filtered band"
    )
}

/// Six digits of a number, without what rounding left behind them.
pub(crate) fn rounded(value: f64) -> f64 {
    format!("{value:.5e}").parse().unwrap_or(value)
}

/// Prints a result. A reader that has gone away has read what it wanted.
pub(crate) fn print(text: &str) -> Result<(), Error> {
    let mut stdout = io::stdout().lock();
    match stdout
        .write_all(text.as_bytes())
        .and_then(|()| stdout.flush())
    {
        Err(error) if error.kind() != io::ErrorKind::BrokenPipe => Err(Error::Print(error)),
        _ => Ok(()),
    }
}

/// Says a line on standard error. Where nobody listens any more, nothing is left to say.
pub(crate) fn say(line: &str) {
    let _ = writeln!(io::stderr().lock(), "{line}");
}

/// JSON text with a line end.
pub(crate) fn json(value: &impl Serialize) -> String {
    let mut text = serde_json::to_string_pretty(value).expect("results are plain lists and names");
    text.push('\n');
    text
}

/// What was found, with what the program says of it besides numbers.
#[derive(Serialize)]
struct Noted<'a, R> {
    #[serde(flatten)]
    report: &'a R,
    notes: Vec<&'a str>,
}

/// The same with notes, which a terminal has with a word before them.
pub(crate) fn json_with_notes(report: &impl Serialize, notes: &[String]) -> String {
    let notes = notes.iter();
    let notes = notes.map(|note| unmarked(note));
    json(&Noted {
        report,
        notes: notes.collect(),
    })
}

/// What was said of columns that are read otherwise than they are meant: all numbers are in doubt.
pub(crate) const WARNING: &str = "warning: ";

/// The same without the word that stands before it on a terminal.
pub(crate) fn unmarked(note: &str) -> &str {
    let plain = note.strip_prefix("note: ");
    plain.or(note.strip_prefix(WARNING)).unwrap_or(note)
}

/// A word as a shell takes it.
pub(crate) fn quoted(word: &str) -> String {
    let is_plain = |c: char| c.is_ascii_alphanumeric() || "._-/=,:+".contains(c);
    if !word.is_empty() && word.chars().all(is_plain) {
        return word.to_owned();
    }
    format!("'{}'", word.replace('\'', r"'\''"))
}

/// A path as a shell and the program take it: none that begins with `-` is an option.
pub(crate) fn path_word(path: &Path) -> String {
    let text = path.display().to_string();
    if text.starts_with('-') {
        quoted(&format!("./{text}"))
    } else {
        quoted(&text)
    }
}

/// With a capital and a full stop.
pub(crate) fn sentence(text: &str) -> String {
    let mut letters = text.chars();
    let first = letters.next().map(|first| first.to_uppercase().to_string());
    let end = if text.ends_with(['.', '?']) { "" } else { "." };
    format!("{}{}{end}", first.unwrap_or_default(), letters.as_str())
}

/// A number with so many digits.
pub(crate) fn significant(number: f64, digits: usize) -> String {
    let decimals = decimals(number, digits);
    format!("{number:.decimals$}")
}

/// Decimals that show so many digits of a number.
pub(crate) fn decimals(number: f64, digits: usize) -> usize {
    let ahead = digits.saturating_sub(1);
    let text = format!("{number:.ahead$e}");
    let exponent = text.split_once('e').and_then(|(_, e)| e.parse().ok());
    let behind = i64::try_from(ahead).unwrap_or(0) - exponent.unwrap_or(0_i64);
    usize::try_from(behind).unwrap_or(0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rounding_leaves_what_was_meant() {
        assert_eq!(
            rounded(-0.002_080_000_000_000_000_3).to_string(),
            "-0.00208"
        );
        assert_eq!(rounded(-2.0).to_string(), "-2");
        assert_eq!(rounded(123_456_789.0).to_string(), "123457000");
        assert!(rounded(f64::NAN).is_nan());
    }

    #[test]
    fn paths_are_words_of_a_shell() {
        let said = |path: &str| path_word(Path::new(path));
        assert_eq!(said("monday.csv"), "monday.csv");
        assert_eq!(said("my log.csv"), "'my log.csv'");
        assert_eq!(said("-a.csv"), "./-a.csv");
    }
}

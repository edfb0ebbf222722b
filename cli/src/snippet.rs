//! The line of a file that an error is about, shown as compilers do.

use std::fs::File;
use std::io::{BufRead as _, BufReader, Read as _};
use std::ops::Range;
use std::path::Path;

use annotate_snippets::{AnnotationKind, Group, Level, Renderer, Snippet};

/// What the caret is under.
#[derive(Debug, Clone)]
pub(crate) enum Mark<'a> {
    /// The first letter of the line.
    Line,
    /// A letter, from 1.
    Column(usize),
    /// Letters, from 1.
    Letters(Range<usize>),
    /// Words, where they stand in the line once; else the first letter of the line.
    Words(&'a str),
    /// The field that is this number, where one is; else the first letter of the line.
    Number(f64),
}

/// Bytes up to the end of the line. What is farther behind is not looked for.
const FARTHEST: u64 = 1 << 28;

/// The line, from 1, with the mark under it. None where the file cannot be read a second time, as a pipe cannot, or is no text there.
pub(crate) fn render(file: &Path, line: u64, mark: Mark<'_>, color: bool) -> Option<String> {
    let text = line_of(file, line)?;
    let marked = AnnotationKind::Primary.span(mark.range(&text));
    let snippet = Snippet::source(text.as_str())
        .line_start(usize::try_from(line).ok()?)
        .annotation(marked);
    let renderer = if color {
        Renderer::styled()
    } else {
        Renderer::plain()
    };
    Some(renderer.render(&[Group::with_level(Level::ERROR).element(snippet)]))
}

fn line_of(file: &Path, line: u64) -> Option<String> {
    let before = usize::try_from(line.checked_sub(1)?).ok()?;
    let file = File::open(file).ok()?;
    if !file.metadata().ok()?.is_file() {
        return None;
    }
    let mut lines = BufReader::new(file.take(FARTHEST)).split(b'\n');
    let text = String::from_utf8(lines.nth(before)?.ok()?).ok()?;
    let text = text.trim_end();
    (!text.contains(|c: char| c.is_control() && c != '\t')).then(|| text.to_owned())
}

impl Mark<'_> {
    fn range(self, line: &str) -> Range<usize> {
        let letter = |at: usize| at..at + line[at..].chars().next().map_or(0, char::len_utf8);
        let first = letter(line.len() - line.trim_start().len());
        match self {
            Self::Line => first,
            Self::Letters(letters) => {
                let mut places = line.char_indices().map(|(at, _)| at).chain([line.len()]);
                let place = places.nth(letters.start.saturating_sub(1));
                let from = place.unwrap_or(line.len());
                let count = letters.end.saturating_sub(letters.start);
                let mut behind = line[from..].char_indices().map(|(at, _)| from + at);
                from..behind.nth(count).unwrap_or(line.len())
            }
            Self::Column(column) => {
                let mut letters = line.char_indices().skip(column.saturating_sub(1));
                letter(letters.next().map_or(line.len(), |(at, _)| at))
            }
            Self::Number(number) => {
                let mut begin = 0;
                let fields = line.split([',', ';', '\t', '|', ' ']).map(|field| {
                    let at = begin;
                    begin += field.len() + 1;
                    at..at + field.len()
                });
                let mut fields = fields.filter(|at| line[at.clone()].parse() == Ok(number));
                match (fields.next(), fields.next()) {
                    (Some(field), None) => field,
                    _ => first,
                }
            }
            Self::Words(words) => {
                let mut places = line.match_indices(words).filter(|(at, words)| {
                    let belongs = |c: char| c.is_alphanumeric() || "_.+-".contains(c);
                    let (before, behind) = (&line[..*at], &line[at + words.len()..]);
                    !words.is_empty() && !before.ends_with(belongs) && !behind.starts_with(belongs)
                });
                match (places.next(), places.next()) {
                    (Some((at, words)), None) => at..at + words.len(),
                    _ => first,
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn shown(text: &str, line: u64, mark: Mark<'_>) -> Option<String> {
        let file = tempfile::NamedTempFile::new().expect("a temporary file");
        std::fs::write(file.path(), text).expect("it can be written");
        render(file.path(), line, mark, false)
    }

    #[test]
    fn the_mark_is_under_what_is_at_fault() {
        let log = "time,q1,tau1\r\n0,1,2\r\n0.1,abc,2\r\n";
        for (line, mark, below) in [
            (3, Mark::Words("abc"), "3 | 0.1,abc,2\n  |     ^^^"),
            // Two of them, and as a part of another word.
            (2, Mark::Words("0"), "2 | 0,1,2\n  | ^"),
            (1, Mark::Words("tau"), "1 | time,q1,tau1\n  | ^"),
            (1, Mark::Column(6), "1 | time,q1,tau1\n  |      ^"),
            (3, Mark::Number(0.1), "3 | 0.1,abc,2\n  | ^^^"),
            (3, Mark::Number(7.0), "3 | 0.1,abc,2\n  | ^"),
            (3, Mark::Line, "3 | 0.1,abc,2\n  | ^"),
        ] {
            let shown = shown(log, line, mark.clone()).expect("a line");
            assert!(shown.contains(below), "{mark:?}:\n{shown}");
        }
    }

    #[test]
    fn what_is_not_there_or_no_text_is_not_shown() {
        assert_eq!(shown("one\n", 2, Mark::Line), None);
        assert_eq!(shown("one\n", 0, Mark::Line), None);
        assert_eq!(shown("bell \u{7}\n", 1, Mark::Line), None);
        assert!(render(Path::new("/nowhere/at/all"), 1, Mark::Line, false).is_none());
    }

    #[test]
    fn of_a_long_line_the_part_with_the_mark_is_shown() {
        let line = format!("{},abc,{}", "1,".repeat(400), "2,".repeat(400));
        let shown = shown(&line, 1, Mark::Words("abc")).expect("a line");
        let longest = shown.lines().map(str::len).max().expect("lines");
        assert!(longest < 200 && shown.contains("abc"), "{shown}");
    }
}

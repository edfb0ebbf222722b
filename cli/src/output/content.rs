//! What results are, and whether a file holds such a one: a name that was meant for another file costs a log that nobody can measure again.

use std::fs::File;
use std::io::Read;
use std::path::Path;

use crate::misplaced::{is_log, is_markup};

/// Bytes that tell what a file holds.
const START: u64 = 4096;

/// Kinds of results.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Content {
    /// Numbers by name.
    Json,
    /// A drawing, SVG.
    Figure,
    /// A report, HTML.
    Page,
    /// A log or a motion.
    Table,
    /// A robot in the language.
    Spec,
    /// A robot in XML, URDF or MJCF.
    Xml,
}

impl Content {
    const fn name(self) -> &'static str {
        match self {
            Self::Json => "JSON",
            Self::Figure => "SVG figure",
            Self::Page => "page",
            Self::Table => "log or motion",
            Self::Spec => "spec",
            Self::Xml => "XML",
        }
    }

    /// What is said of a file that is there and holds something else; an empty one holds nothing.
    pub(super) fn unlike(self, path: &Path) -> Option<String> {
        let mut start = Vec::new();
        // What cannot be read is told where it is written.
        File::open(path)
            .and_then(|file| file.take(START).read_to_end(&mut start))
            .ok()?;
        let is_other = !start.trim_ascii().is_empty() && !self.begins(&start);
        is_other.then(|| format!("what is there is no {}", self.name()))
    }

    fn begins(self, start: &[u8]) -> bool {
        let text = String::from_utf8_lossy(start);
        let text = text.trim_start_matches('\u{feff}').trim_start();
        let is_json = text.starts_with(['{', '[']);
        match self {
            Self::Json => is_json,
            Self::Figure => is_markup(text) && text.contains("<svg"),
            Self::Page => text.to_ascii_lowercase().starts_with("<!doctype html"),
            Self::Table => is_log(start),
            Self::Spec => !is_json && !is_markup(text) && !is_log(start),
            Self::Xml => is_markup(text),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn kinds_of_files_are_told_by_their_first_bytes() {
        let all = [
            (Content::Json, b"\n{\"method\": \"wls\"}".as_slice()),
            (Content::Figure, b"<svg width=\"640\" xmlns=\"..\">"),
            (Content::Page, b"<!DOCTYPE html>\n<html lang=\"en\">"),
            (Content::Table, b"time,tau1\n0,1\n"),
            (
                Content::Spec,
                b"// a, b, c\nrobot A { gravity = [0, 0, -9.81]; }",
            ),
            (
                Content::Xml,
                b"<?xml version=\"1.0\"?>\n<robot name=\"a\"/>",
            ),
        ];
        for (content, _) in all {
            for (other, start) in all {
                let is_like = content.begins(start);
                // Drawings and pages are markup, too.
                let is_known = content == other || (content == Content::Xml && is_markup_of(other));
                assert_eq!(is_like, is_known, "{content:?} of {other:?}");
            }
        }
        assert!(Content::Table.begins(b"\x89MCAP0\r\n"));
        assert!(!Content::Spec.begins(b"PAR1"));
    }

    fn is_markup_of(content: Content) -> bool {
        matches!(content, Content::Figure | Content::Page)
    }
}

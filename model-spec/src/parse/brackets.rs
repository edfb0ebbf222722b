//! Brackets that do not match: told before tokens are made, because the tokenizer only says that it failed.

use std::ops::Range;

use crate::diagnostic::Diagnostic;

/// The first bracket without its partner.
pub(super) fn unbalanced(text: &str) -> Option<Diagnostic> {
    let mut open: Vec<(char, Range<usize>)> = Vec::new();
    // A block that ends further left than it began: most likely its own bracket is the one that is missing.
    let mut suspect: Option<(char, Range<usize>)> = None;
    let mut rest = text.char_indices();
    while let Some((at, c)) = rest.next() {
        let here = at..at + c.len_utf8();
        match c {
            '/' if text[at..].starts_with("//") => skip(&mut rest, text, at, "\n"),
            '/' if text[at..].starts_with("/*") => skip(&mut rest, text, at, "*/"),
            '(' | '[' | '{' => open.push((c, here)),
            ')' | ']' | '}' => match open.pop() {
                Some((opening, place)) if closing(opening) == c => {
                    let ends_a_block = text[line_start(text, at)..at].trim().is_empty();
                    if ends_a_block && indent(text, at) < indent(text, place.start) {
                        suspect.get_or_insert((opening, place));
                    }
                }
                Some((opening, place)) => {
                    return Some(
                        Diagnostic::in_text(
                            here,
                            format!("`{opening}` is closed by `{c}`"),
                            "closed here",
                        )
                        .also_in_text(place, "opened here")
                        .help(format!(
                            "write `{}` before this `{c}`, or remove one of the two",
                            closing(opening)
                        )),
                    );
                }
                None => {
                    return Some(
                        Diagnostic::in_text(
                            here,
                            format!("`{c}` closes nothing"),
                            "nothing is open here",
                        )
                        .help(format!("remove it, or open a `{}` before it", opening(c))),
                    );
                }
            },
            _ => {}
        }
    }
    let unclosed = open.pop()?;
    let (c, place) = suspect.unwrap_or(unclosed);
    Some(
        Diagnostic::in_text(place, format!("`{c}` is never closed"), "opened here")
            .help(format!("write `{}` where the block ends", closing(c))),
    )
}

fn line_start(text: &str, at: usize) -> usize {
    text[..at].rfind('\n').map_or(0, |newline| newline + 1)
}

/// Bytes of white space at the start of the line.
fn indent(text: &str, at: usize) -> usize {
    let line = &text[line_start(text, at)..];
    line.len() - line.trim_start_matches([' ', '\t']).len()
}

/// Goes on behind the next `end`.
fn skip(rest: &mut std::str::CharIndices, text: &str, at: usize, end: &str) {
    let stop = text[at..]
        .find(end)
        .map_or(text.len(), |length| at + length + end.len());
    while rest.offset() < stop && rest.next().is_some() {}
}

fn closing(opening: char) -> char {
    match opening {
        '(' => ')',
        '[' => ']',
        _ => '}',
    }
}

fn opening(closing: char) -> char {
    match closing {
        ')' => '(',
        ']' => '[',
        _ => '{',
    }
}

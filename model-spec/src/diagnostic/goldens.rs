//! Every line of this crate that says a mistake has a golden: a spec of `tests/specs/fail` that makes it speak.
//!
//! What says mistakes is marked `#[track_caller]`, so that a message knows the line that asked for it. The lines are
//! enumerated from the tokens of the source and compared with those that spoke in the goldens. Nothing escapes: a
//! [`Diagnostic`] has no other constructors, a line that spoke and was not enumerated fails the test, and so does a `syn`
//! error that is made past [`syn_error`]. The words of `syn` itself ("expected `=`") come from no line of ours; `remedy` adds
//! their help.

use std::cell::RefCell;
use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::panic::Location;
use std::path::{Path, PathBuf};

use proc_macro2::{Delimiter, Span, TokenStream, TokenTree};

/// Functions that are marked `#[track_caller]`, with what stands before their name in a call: a type, the dot of a method, or
/// nothing.
const SPEAKERS: [(&str, &str); 8] = [
    ("", "check_unique"),
    (".", "fault"),
    ("Diagnostic", "in_text"),
    ("Diagnostic", "new"),
    ("Fault", "new"),
    ("", "shape_of"),
    ("", "syn_error"),
    ("", "unused"),
];

/// A line without a golden: file, words of its call, and why no spec makes it speak.
const SILENT: [(&str, &str, &str); 1] = [(
    "parse/expr.rs",
    "this is not a number",
    "a literal's digits are those of a number; the line stands in for a panic",
)];

thread_local! {
    static SAID: RefCell<Vec<(Place, String)>> = const { RefCell::new(Vec::new()) };
}

/// File below `src`, line, column, all as an editor counts them.
type Place = (String, usize, usize);

/// Notes which line says a message.
#[track_caller]
pub(crate) fn note(message: &str) {
    let caller = Location::caller();
    let file = caller.file().replace('\\', "/");
    let file = file
        .split_once("src/")
        .map_or(file.as_str(), |(_, below)| below);
    let place = (
        file.to_owned(),
        caller.line() as usize,
        caller.column() as usize,
    );
    SAID.with_borrow_mut(|said| said.push((place, message.to_owned())));
}

/// What the source has.
#[derive(Default)]
struct Source {
    /// Lines that say a mistake, with what they hand to the speaker.
    lines: BTreeMap<Place, String>,
    /// Functions that are marked `#[track_caller]`.
    marked: BTreeSet<String>,
    /// Ways around the enumeration.
    bypasses: Vec<String>,
}

/// Reads the tokens of one file.
struct Reader<'a> {
    file: &'a str,
    source: &'a mut Source,
}

impl Reader<'_> {
    fn read(&mut self, tokens: TokenStream) {
        let tokens: Vec<TokenTree> = tokens.into_iter().collect();
        let mut at = 0;
        while at < tokens.len() {
            match &tokens[at] {
                TokenTree::Group(group) if is_attribute(&tokens, at) => {
                    match group.stream().to_string().replace(' ', "").as_str() {
                        "cfg(test)" => at = end_of_item(&tokens, at),
                        "track_caller" => {
                            let name = tokens[at..].iter().position(|token| is_word(token, "fn"));
                            let name = &tokens[at + name.expect("a function is marked") + 1];
                            self.source.marked.insert(name.to_string());
                            at = end_of_item(&tokens, at);
                        }
                        _ => {}
                    }
                }
                TokenTree::Group(group) => self.read(group.stream()),
                TokenTree::Ident(_) => self.word(&tokens, at),
                _ => {}
            }
            at += 1;
        }
    }

    /// A word that may be the name of a function which is called.
    fn word(&mut self, tokens: &[TokenTree], at: usize) {
        let name = tokens[at].to_string();
        let (before, start) = before(tokens, at);
        let place = self.place(tokens[start].span());
        let is_called = is_group(tokens.get(at + 1), Delimiter::Parenthesis);
        if SPEAKERS.contains(&(before.as_str(), name.as_str())) {
            if is_called {
                let handed = tokens[at + 1].to_string();
                self.source.lines.insert(place, handed);
            } else if !before.is_empty() {
                self.source
                    .bypasses
                    .push(format!("{place:?}: `{before}::{name}` as a value"));
            }
            return;
        }
        let made_past = [("Error", "new"), ("Error", "new_spanned"), (".", "error")];
        let literal = name == "Fault" && is_group(tokens.get(at + 1), Delimiter::Brace);
        let declared = at > 0
            && ["struct", "impl"]
                .iter()
                .any(|word| is_word(&tokens[at - 1], word));
        if is_called && made_past.contains(&(before.as_str(), name.as_str()))
            || literal && !declared
        {
            self.source
                .bypasses
                .push(format!("{place:?}: `{name}` past the speakers"));
        }
    }

    fn place(&self, span: Span) -> Place {
        let start = span.start();
        (self.file.to_owned(), start.line, start.column + 1)
    }
}

/// The type or the dot before a function's name, and where the path or the method begins.
fn before(tokens: &[TokenTree], at: usize) -> (String, usize) {
    let is =
        |k: usize, c: char| matches!(tokens.get(k), Some(TokenTree::Punct(p)) if p.as_char() == c);
    if at > 0 && is(at - 1, '.') {
        return (".".to_owned(), at);
    }
    let mut start = at;
    while start > 2 && is(start - 1, ':') && is(start - 2, ':') {
        start -= 3;
    }
    let parent = if start < at {
        tokens[at - 3].to_string()
    } else {
        String::new()
    };
    // A module is no type.
    let parent = if parent.starts_with(char::is_lowercase) {
        String::new()
    } else {
        parent
    };
    (parent, start)
}

fn is_attribute(tokens: &[TokenTree], at: usize) -> bool {
    at > 0
        && is_group(tokens.get(at), Delimiter::Bracket)
        && matches!(&tokens[at - 1], TokenTree::Punct(punct) if punct.as_char() == '#')
}

fn is_word(token: &TokenTree, word: &str) -> bool {
    matches!(token, TokenTree::Ident(ident) if ident == word)
}

fn is_group(token: Option<&TokenTree>, delimiter: Delimiter) -> bool {
    matches!(token, Some(TokenTree::Group(group)) if group.delimiter() == delimiter)
}

/// The `;` or the braces at which an item with an attribute ends.
fn end_of_item(tokens: &[TokenTree], attribute: usize) -> usize {
    let ends = |token: &TokenTree| match token {
        TokenTree::Punct(punct) => punct.as_char() == ';',
        token => is_group(Some(token), Delimiter::Brace),
    };
    let length = tokens[attribute..].iter().position(ends);
    attribute + length.unwrap_or(tokens.len() - attribute)
}

/// Every Rust file below a folder.
fn files(folder: &Path) -> Vec<PathBuf> {
    let mut found = Vec::new();
    for entry in fs::read_dir(folder).expect("a folder of the source") {
        let path = entry.expect("a readable folder").path();
        if path.is_dir() {
            found.extend(files(&path));
        } else if path.extension().is_some_and(|extension| extension == "rs") {
            found.push(path);
        }
    }
    found
}

fn source() -> Source {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    let mut source = Source::default();
    for path in files(&folder) {
        let file = path.strip_prefix(&folder).expect("below the folder");
        let file = file.to_string_lossy().replace('\\', "/");
        let text = fs::read_to_string(&path).expect("a readable file");
        let mut own = Source::default();
        let mut reader = Reader {
            file: &file,
            source: &mut own,
        };
        reader.read(text.parse().expect("the compiler reads it too"));
        source.marked.append(&mut own.marked);
        // The home of the speakers hands on what others say; this file says nothing.
        if file != "diagnostic.rs" && file != "diagnostic/goldens.rs" {
            source.lines.append(&mut own.lines);
            source.bypasses.append(&mut own.bypasses);
        }
    }
    source
}

/// The lines whose message a golden shows.
fn spoken() -> BTreeSet<Place> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../tests/specs/fail");
    let mut spoken = BTreeSet::new();
    for entry in fs::read_dir(folder).expect("the goldens") {
        let path = entry.expect("a readable folder").path();
        let text = fs::read_to_string(&path).expect("a readable spec");
        SAID.with_borrow_mut(Vec::clear);
        let mistakes = crate::load("a golden", &text)
            .err()
            .unwrap_or_else(|| panic!("the folder is its fate: {text}"));
        let shown: Vec<&str> = mistakes.messages().collect();
        let said = SAID.take();
        let said = said
            .into_iter()
            .filter(|(_, message)| shown.contains(&message.as_str()));
        spoken.extend(said.map(|(place, _)| place));
    }
    spoken
}

#[test]
fn every_line_that_says_a_mistake_has_a_golden() {
    let source = source();
    assert_eq!(source.bypasses, [] as [String; 0]);
    let marked: BTreeSet<&str> = source.marked.iter().map(String::as_str).collect();
    let own = ["at", "note"];
    let speakers: BTreeSet<&str> = SPEAKERS.iter().map(|(_, name)| *name).chain(own).collect();
    assert_eq!(marked, speakers);

    let spoken = spoken();
    let inside = |(file, ..): &&Place| !file.starts_with("diagnostic");
    let unknown: Vec<&Place> = spoken
        .iter()
        .filter(inside)
        .filter(|place| !source.lines.contains_key(place))
        .collect();
    assert!(
        unknown.is_empty(),
        "spoke, but is not enumerated: {unknown:?}"
    );

    let mut reasons: Vec<_> = SILENT.to_vec();
    let mut missing = Vec::new();
    for (place, handed) in source
        .lines
        .iter()
        .filter(|(place, _)| !spoken.contains(place))
    {
        match reasons
            .iter()
            .position(|(file, words, _)| *file == place.0 && handed.contains(words))
        {
            Some(reason) => drop(reasons.remove(reason)),
            None => missing.push(format!("{}:{}:{}", place.0, place.1, place.2)),
        }
    }
    assert!(
        missing.is_empty(),
        "no spec in `tests/specs/fail` makes these lines speak: {missing:#?}"
    );
    assert!(reasons.is_empty(), "spoken after all, or gone: {reasons:?}");
}

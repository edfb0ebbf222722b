//! The lines of a source that say a mistake, from its tokens.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};

use proc_macro2::{Delimiter, Span, TokenStream, TokenTree};

use crate::{Place, Speakers};

/// What a source has.
#[derive(Debug, Default)]
pub struct Source {
    /// Lines that say a mistake, with what they hand to the speaker.
    pub(crate) lines: BTreeMap<Place, String>,
    /// Functions that are marked `#[track_caller]`.
    pub(crate) marked: BTreeSet<String>,
    /// Ways around the enumeration.
    pub(crate) bypasses: Vec<String>,
}

impl Source {
    /// Reads every file below `folder`, which stands below `src` or is it.
    ///
    /// # Panics
    /// Where the folder is not there or holds what is no Rust.
    #[must_use]
    pub fn read(src: &Path, folder: &str, speakers: &Speakers) -> Self {
        let mut source = Self::default();
        for path in files(&src.join(folder)) {
            let file = path.strip_prefix(src).expect("below the folder");
            let file = file.to_string_lossy().replace('\\', "/");
            let text = fs::read_to_string(&path).expect("a readable file");
            let mut own = Self::default();
            let mut reader = Reader {
                file: &file,
                speakers,
                source: &mut own,
            };
            reader.read(text.parse().expect("the compiler reads it too"));
            source.marked.append(&mut own.marked);
            if !speakers.homes.contains(&file.as_str()) {
                source.lines.append(&mut own.lines);
                source.bypasses.append(&mut own.bypasses);
            }
        }
        source
    }
}

/// Reads the tokens of one file.
struct Reader<'a> {
    file: &'a str,
    speakers: &'a Speakers,
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
        if self
            .speakers
            .calls
            .contains(&(before.as_str(), name.as_str()))
        {
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
        let literal = self.speakers.types.contains(&name.as_str())
            && is_group(tokens.get(at + 1), Delimiter::Brace);
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

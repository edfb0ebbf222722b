//! Whether every line of a source that says a mistake has a golden that shows it.
//!
//! What says mistakes, a speaker, is marked `#[track_caller]` and [`note`]s its message, so the line that asked for it is known.
//! The lines that call speakers are enumerated from the tokens of the source and compared with those that spoke while the
//! goldens ran. Nothing escapes: a line that spoke and was not enumerated fails the test, and so does a mistake that is made
//! past the speakers.

mod source;

use std::cell::RefCell;
use std::collections::BTreeSet;
use std::panic::Location;

pub use source::Source;

/// File below `src`, line, column, all as an editor counts them.
pub type Place = (String, usize, usize);

/// What says the mistakes of a source.
#[derive(Debug, Clone, Copy)]
pub struct Speakers {
    /// Functions that are marked `#[track_caller]`, with what stands before their name in a call: a type, the dot of a method,
    /// or nothing.
    pub calls: &'static [(&'static str, &'static str)],
    /// Further functions with this mark, which only hand on to a speaker.
    pub inside: &'static [&'static str],
    /// Types of mistakes that their literal would make past the speakers.
    pub types: &'static [&'static str],
    /// Files below the folder whose lines are none: the home of the speakers, and tests.
    pub homes: &'static [&'static str],
}

/// A line without a golden.
#[derive(Debug, Clone, Copy)]
pub struct Silent {
    /// Below the folder.
    pub file: &'static str,
    /// Words of its call.
    pub words: &'static str,
    /// Why nothing makes it speak.
    pub reason: &'static str,
}

thread_local! {
    static SAID: RefCell<Vec<(Place, String)>> = const { RefCell::new(Vec::new()) };
}

/// Notes which line says a message.
#[track_caller]
pub fn note(message: &str) {
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

/// The lines that spoke in a golden, which gives the messages that a reader is shown.
pub fn spoken(golden: impl FnOnce() -> Vec<String>) -> BTreeSet<Place> {
    SAID.with_borrow_mut(Vec::clear);
    let shown = golden();
    let said = SAID.take().into_iter();
    said.filter(|(_, message)| shown.contains(message))
        .map(|(place, _)| place)
        .collect()
}

/// Compares the lines of a source with those that spoke.
///
/// # Panics
/// Where a line has no golden and no reason for it, or where something escapes the enumeration.
pub fn assert_complete(
    source: &Source,
    speakers: &Speakers,
    spoken: &BTreeSet<Place>,
    silent: &[Silent],
) {
    assert_eq!(source.bypasses, [] as [String; 0]);
    let marked: BTreeSet<&str> = source.marked.iter().map(String::as_str).collect();
    let calls = speakers.calls.iter().map(|(_, name)| *name);
    let known: BTreeSet<&str> = calls.chain(speakers.inside.iter().copied()).collect();
    assert_eq!(marked, known);

    let outside = |(file, ..): &&Place| !speakers.homes.contains(&file.as_str());
    let unknown: Vec<&Place> = spoken
        .iter()
        .filter(outside)
        .filter(|place| !source.lines.contains_key(place))
        .collect();
    assert!(
        unknown.is_empty(),
        "spoke, but is not enumerated: {unknown:?}"
    );

    let mut reasons = silent.to_vec();
    let mut missing = Vec::new();
    let lines = source.lines.iter();
    for (place, handed) in lines.filter(|(place, _)| !spoken.contains(place)) {
        let is_meant = |one: &Silent| one.file == place.0 && handed.contains(one.words);
        match reasons.iter().position(is_meant) {
            Some(reason) => drop(reasons.remove(reason)),
            None => missing.push(format!("{}:{}:{}", place.0, place.1, place.2)),
        }
    }
    assert!(
        missing.is_empty(),
        "no golden makes these lines speak: {missing:#?}"
    );
    assert!(reasons.is_empty(), "spoken after all, or gone: {reasons:?}");
}

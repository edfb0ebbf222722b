//! What a trace is doing.

use std::fmt;

/// A stage of a trace, as [`Trace::run`](super::Trace::run) tells it.
///
/// # Examples
/// ```
/// # mod pendulum { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/doc/pendulum.rs")); }
/// # use pendulum::{dry_friction, measure, pendulum};
/// use robot_model::trace::Trace;
/// let (arm, candidate) = (pendulum(), dry_friction());
/// let mut told = Vec::new();
/// Trace::new(vec![&candidate]).run(&arm, &[measure(0.7)], &mut |stage| told.push((stage.to_string(), stage.done)))?;
/// let begins = ("round 1: 1 candidates".to_owned(), Some(0.0));
/// assert_eq!(told.iter().filter(|stage| **stage == begins).count(), 1, "{told:?}");
/// # Ok::<(), robot_model::identify::IdentifyError>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct Stage<'a> {
    /// In words.
    pub words: &'a str,
    /// What part of it is done, from 0 to 1, where it has parts.
    pub done: Option<f64>,
}

impl<'a> Stage<'a> {
    /// One that has no parts.
    pub(super) const fn whole(words: &'a str) -> Self {
        Self { words, done: None }
    }

    /// One of which so much is done.
    pub(super) const fn part(words: &'a str, done: f64) -> Self {
        Self {
            words,
            done: Some(done),
        }
    }
}

impl fmt::Display for Stage<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.words)
    }
}

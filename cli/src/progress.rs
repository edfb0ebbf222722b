//! Progress of long work, on standard error.

use std::io::IsTerminal;
use std::time::Duration;

use indicatif::{ProgressBar, ProgressStyle};

use crate::output;

/// A line that says what is being done: a spinner on a terminal, one plain line a step elsewhere.
#[derive(Debug)]
pub struct Progress {
    bar: Option<ProgressBar>,
    is_silent: bool,
}

impl Progress {
    /// Nothing is shown before the first step.
    #[must_use]
    pub fn new() -> Self {
        let bar = std::io::stderr().is_terminal().then(|| {
            let bar = ProgressBar::new_spinner();
            bar.set_style(ProgressStyle::default_spinner());
            bar.enable_steady_tick(Duration::from_millis(100));
            bar
        });
        Self {
            bar,
            is_silent: false,
        }
    }

    /// Nothing is shown at all.
    #[must_use]
    pub fn silent() -> Self {
        Self {
            bar: None,
            is_silent: true,
        }
    }

    /// Says what comes now.
    pub(crate) fn step(&self, what: &str) {
        match &self.bar {
            Some(bar) => bar.set_message(what.to_owned()),
            None if self.is_silent => {}
            None => output::say(what),
        }
    }

    /// Says something that stays.
    pub(crate) fn note(&self, what: &str) {
        match &self.bar {
            Some(bar) => bar.println(what),
            None if self.is_silent => {}
            None => output::say(what),
        }
    }
}

impl Default for Progress {
    fn default() -> Self {
        Self::new()
    }
}

impl Drop for Progress {
    fn drop(&mut self) {
        if let Some(bar) = &self.bar {
            bar.finish_and_clear();
        }
    }
}

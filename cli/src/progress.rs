//! Progress of long work, on standard error.

use std::io::IsTerminal;
use std::sync::Mutex;
use std::time::{Duration, Instant};

use indicatif::{ProgressBar, ProgressStyle};

use crate::output;

/// Where steps follow each other fast, one plain line in so long.
const SELDOM: Duration = Duration::from_secs(10);

/// A line that says what is being done: a spinner on a terminal, one plain line a step elsewhere.
#[derive(Debug)]
pub struct Progress {
    bar: Option<ProgressBar>,
    is_silent: bool,
    /// When one of many steps was said last.
    said: Mutex<Option<Instant>>,
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
            said: Mutex::new(None),
        }
    }

    /// Nothing is shown at all.
    #[must_use]
    pub fn silent() -> Self {
        Self {
            bar: None,
            is_silent: true,
            said: Mutex::new(None),
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

    /// Says one of many steps; elsewhere than on a terminal only now and then.
    pub(crate) fn often(&self, what: &str) {
        if self.bar.is_none() {
            let Ok(mut said) = self.said.lock() else {
                return;
            };
            if said.is_some_and(|last| last.elapsed() < SELDOM) {
                return;
            }
            *said = Some(Instant::now());
        }
        self.step(what);
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

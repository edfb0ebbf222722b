//! What is said behind a result, on whatever way it goes.

use std::sync::{Mutex, PoisonError};

use crate::output;

/// Lines that are said when this goes.
#[derive(Debug, Default)]
pub(crate) struct Behind(Mutex<Vec<String>>);

impl Behind {
    pub(super) fn push(&self, line: String) {
        let mut lines = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        lines.push(line);
    }
}

impl Drop for Behind {
    fn drop(&mut self) {
        let lines = self.0.get_mut().unwrap_or_else(PoisonError::into_inner);
        for line in lines {
            output::say(line);
        }
    }
}

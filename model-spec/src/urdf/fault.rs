//! Where and why a text is no URDF.

use std::fmt;

/// What cannot be read in a URDF.
#[derive(Debug, Clone, PartialEq, Eq)]
#[non_exhaustive]
pub struct UrdfFault {
    /// The line at fault, from 1; none where the text as a whole is.
    pub line: Option<u64>,
    /// What is wrong there, and what to write.
    pub reason: String,
}

impl UrdfFault {
    pub(super) fn in_line(line: u64, reason: impl Into<String>) -> Self {
        Self {
            line: Some(line),
            reason: reason.into(),
        }
    }

    pub(super) fn of_all(reason: impl Into<String>) -> Self {
        Self {
            line: None,
            reason: reason.into(),
        }
    }
}

impl fmt::Display for UrdfFault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.line {
            Some(line) => write!(f, "line {line}: {}", self.reason),
            None => f.write_str(&self.reason),
        }
    }
}

//! What the command line refuses, and the words for it.

use std::path::{Path, PathBuf};

use robot_model::identify::IdentifyError;
use robot_model::log::LogError;
use robot_model_spec::Diagnostics;
use thiserror::Error;

/// Why a command ended without a result. Exit code 1, the message on stderr.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum Error {
    /// A file cannot be read.
    #[error("cannot read `{}`: {reason}", path.display())]
    Read {
        /// The file.
        path: PathBuf,
        /// What the system says.
        reason: String,
    },
    /// A file cannot be written.
    #[error("cannot write `{}`: {reason}", path.display())]
    Write {
        /// The file.
        path: PathBuf,
        /// What the system says.
        reason: String,
    },
    /// The results cannot be printed.
    #[error("cannot write to standard output: {0}")]
    Print(std::io::Error),
    /// The spec has mistakes.
    #[error("{0}")]
    Spec(#[from] Diagnostics),
    /// The log has mistakes.
    #[error(transparent)]
    Log(#[from] LogError),
    /// The arm cannot be identified from its logs.
    #[error(transparent)]
    Identify(#[from] IdentifyError),
    /// A JSON file is not what it should be.
    #[error("{}{}: {reason}", path.display(), place(*.line))]
    Json {
        /// The file.
        path: PathBuf,
        /// Line and column, where it is no JSON at all.
        line: Option<(usize, usize)>,
        /// What is wrong with it, with the part that is at fault.
        reason: String,
    },
    /// An argument that is well formed and makes no sense.
    #[error("{0}")]
    Argument(String),
}

/// What to do about columns of other names.
const COLUMNS_HELP: &str = "  = help: say which columns are meant, in the `log` of the spec or in a `robot-model.toml` beside the file: under `[log]` lines as \
     `q = { columns = [\"axis1\", \"axis2\"], unit = \"deg\" }`";

impl Error {
    /// The message as stderr shows it; spec mistakes carry their own headings.
    #[must_use]
    pub fn render(&self, color: bool) -> String {
        match self {
            Self::Spec(diagnostics) => diagnostics.render(color),
            Self::Log(LogError::MissingColumns { .. }) => format!("error: {self}\n{COLUMNS_HELP}"),
            other => format!("error: {other}"),
        }
    }

    pub(crate) fn read(path: &Path, error: &std::io::Error) -> Self {
        Self::Read {
            path: path.to_owned(),
            reason: error.to_string(),
        }
    }

    pub(crate) fn json(path: &Path, reason: &impl ToString) -> Self {
        Self::Json {
            path: path.to_owned(),
            line: None,
            reason: reason.to_string(),
        }
    }
}

/// `:3:14` behind a file's name.
fn place(line: Option<(usize, usize)>) -> String {
    line.map_or_else(String::new, |(line, column)| format!(":{line}:{column}"))
}

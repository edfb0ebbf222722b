//! What the command line refuses, and the words for it.

use std::path::{Path, PathBuf};

use robot_model::identify::IdentifyError;
use robot_model::log::LogError;
use robot_model_spec::Diagnostics;
use robot_model_spec::suggest::nearest;
use robot_model_spec::urdf::{UrdfFault, UrdfPlace};
use thiserror::Error;

use crate::snippet::{self, Mark};

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
        /// Line and column, where it is not JSON at all.
        line: Option<(usize, usize)>,
        /// What is wrong with it, with the part that is at fault.
        reason: String,
    },
    /// A URDF cannot be read.
    #[error("{}: the URDF does not parse: {fault}", path.display())]
    Urdf {
        /// The file.
        path: PathBuf,
        /// What is wrong with it, with the line.
        fault: UrdfFault,
    },
    /// A URDF whose arm cannot be said in a spec.
    #[error("{}: {}{reason}", path.display(), in_line(place.as_ref()))]
    Import {
        /// The file.
        path: PathBuf,
        /// Where it is, where that is one place.
        place: Option<UrdfPlace>,
        /// What is wrong there, and what to do.
        reason: String,
    },
    /// An argument that is well formed and makes no sense.
    #[error("{0}")]
    Argument(String),
}

/// What to do about columns of other names.
const COLUMNS_HELP: &str = "  = help: name the columns in the `log` of the spec, or in a `robot-model.toml` beside the file, under `[log]`, \
                            with lines like `q = { columns = [\"axis1\", \"axis2\"], unit = \"deg\" }`";

impl Error {
    /// The message as stderr shows it, the line at fault below; spec mistakes carry their own headings.
    #[must_use]
    pub fn render(&self, color: bool) -> String {
        if let Self::Spec(diagnostics) = self {
            return diagnostics.render(color);
        }
        let parts = [self.snippet(color), self.help()];
        let parts = parts.into_iter().flatten().map(|part| format!("\n{part}"));
        format!("error: {self}{}", parts.collect::<String>())
    }

    /// The line of a text that is at fault.
    fn snippet(&self, color: bool) -> Option<String> {
        match self {
            Self::Log(error) => {
                let place = error.place()?;
                let number = place.number.map_or(Mark::Line, Mark::Number);
                let mark = place.words.map_or(number, Mark::Words);
                snippet::render(Path::new(place.source_name), place.line, mark, color)
            }
            Self::Json {
                path,
                line: Some((line, column)),
                ..
            } => {
                let line = u64::try_from(*line).ok()?;
                snippet::render(path, line, Mark::Column(*column), color)
            }
            Self::Urdf { path, fault } => of_urdf(path, fault.place.as_ref()?, color),
            Self::Import {
                path,
                place: Some(place),
                ..
            } => of_urdf(path, place, color),
            _ => None,
        }
    }

    /// What to do, where that takes more than a sentence.
    fn help(&self) -> Option<String> {
        match self {
            Self::Log(LogError::Misspelled { lines, .. } | LogError::NoSuchJoint { lines, .. })
                if !lines.is_empty() =>
            {
                let lines = lines.iter().map(|line| format!("\n      {line}"));
                let lines: String = lines.collect();
                Some(format!(
                    "  = help: name the columns in a `robot-model.toml` beside the file, which stays unchanged, or in the `log {{ .. }}` of \
                     the spec:\n\n      [log]{lines}\n"
                ))
            }
            Self::Log(LogError::MissingColumns { .. } | LogError::NoSuchJoint { .. }) => {
                Some(COLUMNS_HELP.to_owned())
            }
            _ => None,
        }
    }

    pub(crate) fn read(path: &Path, error: &std::io::Error) -> Self {
        Self::Read {
            path: path.to_owned(),
            reason: match error.kind() {
                std::io::ErrorKind::NotFound => not_there(path),
                std::io::ErrorKind::IsADirectory => "it is a folder; name a file in it".to_owned(),
                std::io::ErrorKind::PermissionDenied => "you have no permission to read it or to enter its folder; see `ls -ld`, or name a copy".to_owned(),
                _ => error.to_string(),
            },
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

/// What is said of a file that is not there, with one of nearly its name.
fn not_there(path: &Path) -> String {
    let folder = path
        .parent()
        .filter(|folder| !folder.as_os_str().is_empty());
    let folder = folder.unwrap_or(Path::new("."));
    let Ok(entries) = std::fs::read_dir(folder) else {
        return format!("there is no folder `{}`; check its name", folder.display());
    };
    let names = entries.filter_map(|entry| entry.ok()?.file_name().into_string().ok());
    let mut names: Vec<String> = names.take(1000).collect();
    names.sort();
    let own = path
        .file_name()
        .and_then(std::ffi::OsStr::to_str)
        .unwrap_or_default();
    match nearest(own, names.iter().map(String::as_str)) {
        Some(near) => format!(
            "there is no such file; did you mean `{}`?",
            path.with_file_name(near).display()
        ),
        None => format!(
            "there is no such file in `{}`; check its name",
            folder.display()
        ),
    }
}

/// `line 3: ` before a reason.
fn in_line(place: Option<&UrdfPlace>) -> String {
    place.map_or_else(String::new, |place| format!("line {}: ", place.line))
}

/// The line of a URDF with what is at fault.
fn of_urdf(path: &Path, place: &UrdfPlace, color: bool) -> Option<String> {
    let letters = place.letters.clone();
    let mark = letters.map_or(Mark::Line, Mark::Letters);
    snippet::render(path, place.line, mark, color)
}

/// `:3:14` behind a file's name.
fn place(line: Option<(usize, usize)>) -> String {
    line.map_or_else(String::new, |(line, column)| format!(":{line}:{column}"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_nobody_may_read_is_told_with_the_way_out() {
        let denied = std::io::Error::from(std::io::ErrorKind::PermissionDenied);
        let said = Error::read(Path::new("my log.csv"), &denied).to_string();
        assert_eq!(
            said,
            "cannot read `my log.csv`: you have no permission to read it or to enter its folder; see `ls -ld`, or name a copy"
        );
    }
}

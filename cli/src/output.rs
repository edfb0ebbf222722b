//! Where results go: standard output, and files that are there whole or not at all.

use std::io::{self, Write};
use std::path::{Path, PathBuf};

use serde::Serialize;
use tempfile::NamedTempFile;

use crate::Error;

/// Prints a result. A reader that has gone away has read what it wanted.
pub(crate) fn print(text: &str) -> Result<(), Error> {
    let mut stdout = io::stdout().lock();
    match stdout
        .write_all(text.as_bytes())
        .and_then(|()| stdout.flush())
    {
        Err(error) if error.kind() != io::ErrorKind::BrokenPipe => Err(Error::Print(error)),
        _ => Ok(()),
    }
}

/// A file that is to be written: its place is claimed at once, so that a folder that is missing or closed is told before the
/// work, and its content appears under its name in one step.
#[derive(Debug)]
pub(crate) struct OutFile {
    path: PathBuf,
    file: NamedTempFile,
}

impl OutFile {
    /// Claims a place in the file's folder.
    pub(crate) fn create(path: &Path) -> Result<Self, Error> {
        let failed = |reason| Error::Write {
            path: path.to_owned(),
            reason,
        };
        if path.is_dir() {
            return Err(failed("it is a folder".to_owned()));
        }
        let folder = match path.parent() {
            Some(folder) if !folder.as_os_str().is_empty() => folder,
            _ => Path::new("."),
        };
        let file = builder()
            .tempfile_in(folder)
            .map_err(|error| failed(reason(&error)))?;
        Ok(Self {
            path: path.to_owned(),
            file,
        })
    }

    /// Puts the content in place.
    pub(crate) fn commit(mut self, content: &[u8]) -> Result<(), Error> {
        self.file
            .write_all(content)
            .map_err(|error| Error::write(&self.path, &error))?;
        self.file
            .persist(&self.path)
            .map_err(|error| Error::write(&self.path, &error.error))?;
        Ok(())
    }
}

/// Temporary files that get the permissions of any new file.
fn builder() -> tempfile::Builder<'static, 'static> {
    let mut builder = tempfile::Builder::new();
    builder.prefix(".robot-model-");
    #[cfg(unix)]
    {
        use std::os::unix::fs::PermissionsExt;
        builder.permissions(std::fs::Permissions::from_mode(0o666));
    }
    builder
}

/// What the system said; the name of the temporary file, which `tempfile` puts behind it, is of no use.
fn reason(error: &io::Error) -> String {
    let text = error.to_string();
    text.split_once(" at path ")
        .map_or(text.as_str(), |(said, _)| said)
        .to_owned()
}

/// JSON text with a line end.
pub(crate) fn json(value: &impl Serialize) -> String {
    let mut text = serde_json::to_string_pretty(value).expect("results are plain lists and names");
    text.push('\n');
    text
}

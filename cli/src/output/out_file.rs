//! A file that is there whole or not at all.

use std::fs::{self, File, OpenOptions};
use std::io::{self, BufRead, BufReader, Write};
use std::path::{Path, PathBuf};

use tempfile::NamedTempFile;

use super::content::Content;
use super::say;
use crate::{Error, interrupt};

/// A file that is to be written: whether it can be is found out at once, before the work, and nothing is left in its folder
/// until its content appears under its name in one step.
#[derive(Debug)]
pub(crate) struct OutFile {
    path: PathBuf,
    /// The file itself, where the path is a link to it.
    target: PathBuf,
    /// Whether what is there already stays.
    is_new: bool,
    /// What is there already is told of where it is replaced, and is such a result.
    content: Option<Content>,
}

impl OutFile {
    /// Makes sure that the file can be written.
    pub(crate) fn create(path: &Path) -> Result<Self, Error> {
        if path.file_name().is_none() {
            return Err(refused(path, "it does not name a file"));
        }
        let target = match fs::symlink_metadata(path) {
            Ok(found) => existing(path, found.is_symlink())?,
            Err(_) => path.to_owned(),
        };
        let folder = folder_of(&target);
        if !folder.exists() {
            let reason = format!("there is no folder `{}`; create it first", folder.display());
            return Err(refused(path, &reason));
        }
        if !folder.is_dir() {
            return Err(refused(
                path,
                &format!("`{}` is not a folder", folder.display()),
            ));
        }
        // A file without a name is a trial that leaves nothing behind, whatever ends the program.
        tempfile::tempfile_in(folder).map_err(|error| {
            let reason = format!(
                "no file can be made in folder `{}` ({}); name one where you may write",
                folder.display(),
                reason(&error)
            );
            refused(path, &reason)
        })?;
        Ok(Self {
            path: path.to_owned(),
            target,
            is_new: false,
            content: None,
        })
    }

    /// The same for a file that is not there yet, nor comes there before this one is written.
    pub(crate) fn create_new(path: &Path) -> Result<Self, Error> {
        if fs::symlink_metadata(path).is_ok() {
            return Err(there_already(path));
        }
        let file = Self::create(path)?;
        Ok(Self {
            is_new: true,
            ..file
        })
    }

    /// The same for a result of a kind: it takes the place of its like, and of nothing else.
    pub(super) fn holding(self, content: Content) -> Result<Self, Error> {
        let Some(other) = content.unlike(&self.target) else {
            return Ok(Self {
                content: Some(content),
                ..self
            });
        };
        let reason =
            format!("{other}, and would be lost; give another name, or remove that file first");
        Err(refused(&self.path, &reason))
    }

    /// Where the content goes, as it was asked for.
    pub(crate) fn path(&self) -> &Path {
        &self.path
    }

    /// Puts the content in place.
    pub(crate) fn commit(self, content: &[u8]) -> Result<(), Error> {
        Self::commit_all(vec![(self, content)])
    }

    /// Puts the contents of several files in place, once all of them are written.
    pub(crate) fn commit_all(files: Vec<(Self, &[u8])>) -> Result<(), Error> {
        interrupt::whole(|| {
            let written = files.into_iter().map(|(file, content)| {
                let temporary = file.write(content)?;
                let replaced = file.replaced(content);
                Ok((file, temporary, replaced))
            });
            let written = written.collect::<Result<Vec<_>, Error>>()?;
            written
                .into_iter()
                .try_for_each(|(file, temporary, replaced)| {
                    file.put(temporary)?;
                    if let Some(note) = replaced {
                        say(&note);
                    }
                    Ok(())
                })
        })
    }

    /// The content in a file without its name, with the permissions of what it takes the place of.
    fn write(&self, content: &[u8]) -> Result<NamedTempFile, Error> {
        // Else the next run would not know it for its like. Of a log of `simulate` that is so by its digits, which an arm that stands may not have.
        debug_assert!(
            self.content
                .is_none_or(|kind| kind == Content::Simulation || kind.begins(content)),
            "{} is no {:?}",
            self.path.display(),
            self.content
        );
        let failed = |error: &io::Error| refused(&self.path, &reason(error));
        let mut file = builder()
            .tempfile_in(folder_of(&self.target))
            .map_err(|error| failed(&error))?;
        file.write_all(content).map_err(|error| failed(&error))?;
        if let Ok(about) = fs::metadata(&self.target) {
            file.as_file()
                .set_permissions(about.permissions())
                .map_err(|error| failed(&error))?;
        }
        Ok(file)
    }

    /// What is said of a file that another content is taken from; the same content takes nothing.
    fn replaced(&self, content: &[u8]) -> Option<String> {
        self.content?;
        let before = File::open(&self.target).ok()?;
        let length = before.metadata().ok()?.len();
        let is_other = length > 0 && (length != content.len() as u64 || !is_same(before, content));
        is_other.then(|| {
            format!(
                "note: `{}` existed; this run's result replaces it",
                self.path.display()
            )
        })
    }

    fn put(self, file: NamedTempFile) -> Result<(), Error> {
        let failed = |error: &io::Error| refused(&self.path, &reason(error));
        let persisted = if self.is_new {
            file.persist_noclobber(&self.target)
        } else {
            file.persist(&self.target)
        };
        persisted.map_err(|error| match error.error.kind() {
            io::ErrorKind::AlreadyExists => there_already(&self.path),
            _ => failed(&error.error),
        })?;
        interrupt::wrote(&self.path);
        Ok(())
    }
}

/// Whether a file holds a content, a piece at a time: results may be as large as the memory.
fn is_same(file: File, content: &[u8]) -> bool {
    let mut file = BufReader::new(file);
    let mut rest = content;
    loop {
        match file.fill_buf() {
            Ok([]) => return rest.is_empty(),
            Ok(piece) => {
                let Some(left) = rest.strip_prefix(piece) else {
                    return false;
                };
                rest = left;
                let taken = piece.len();
                file.consume(taken);
            }
            Err(_) => return false,
        }
    }
}

fn there_already(path: &Path) -> Error {
    refused(
        path,
        "this file exists; give another name, or `--force` to replace it",
    )
}

/// The regular file, open to writing, that is at a path already.
fn existing(path: &Path, is_link: bool) -> Result<PathBuf, Error> {
    let about = fs::metadata(path)
        .map_err(|error| refused(path, &format!("it is a broken link: {error}")))?;
    if about.is_dir() {
        return Err(refused(path, "it is a folder; name a file in it"));
    }
    // `/dev/stdout` is a link to whatever the shell has put there, a regular file at times.
    let of_the_system = is_link && (path.starts_with("/dev") || path.starts_with("/proc"));
    if !about.is_file() || of_the_system {
        return Err(refused(
            path,
            "it is not a regular file; results are written in one step, which needs one",
        ));
    }
    if about.permissions().readonly() {
        return Err(refused(
            path,
            "it is read-only; give another name, or make it writable",
        ));
    }
    OpenOptions::new()
        .write(true)
        .open(path)
        .map_err(|error| refused(path, &reason(&error)))?;
    fs::canonicalize(path).map_err(|error| refused(path, &reason(&error)))
}

fn folder_of(path: &Path) -> &Path {
    match path.parent() {
        Some(folder) if !folder.as_os_str().is_empty() => folder,
        _ => Path::new("."),
    }
}

pub(super) fn refused(path: &Path, reason: &str) -> Error {
    Error::Write {
        path: path.to_owned(),
        reason: reason.to_owned(),
    }
}

/// Temporary files that get the permissions of any new file.
fn builder() -> tempfile::Builder<'static, 'static> {
    let mut builder = tempfile::Builder::new();
    builder.prefix(".robot-model-");
    #[cfg(unix)]
    {
        use std::os::unix::fs::PermissionsExt;
        builder.permissions(fs::Permissions::from_mode(0o666));
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

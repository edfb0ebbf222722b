//! Where results go: standard output, and files that are there whole or not at all.

use std::fs::{self, OpenOptions};
use std::io::{self, Write};
use std::path::{Component, Path, PathBuf};

pub(crate) use robot_model_spec::words::{counted, names};
use serde::Serialize;
use tempfile::NamedTempFile;

use crate::{Error, interrupt};

/// What the errors in a table are.
pub(crate) const ERRORS: &str = "RMSE: raw samples, N m (prismatic joints: N), first and last second cut; relative: in the filtered band";

/// The same where all of them are told, of some series of torques.
pub(crate) fn errors(series: &str) -> String {
    format!(
        "RMSE, MAE, NRMSE fit: {series}, N m (prismatic joints: N), first and last second cut; RMS%: relative, in the filtered band"
    )
}

/// Six digits of a number, without what rounding left behind them.
pub(crate) fn rounded(value: f64) -> f64 {
    format!("{value:.5e}").parse().unwrap_or(value)
}

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

/// Says a line on standard error. Where nobody listens any more, nothing is left to say.
pub(crate) fn say(line: &str) {
    let _ = writeln!(io::stderr().lock(), "{line}");
}

/// The files of one command: what it reads, and what it has claimed to write. No output may take the place of either.
#[derive(Debug, Default)]
pub(crate) struct Files {
    inputs: Vec<(PathBuf, PathBuf)>,
    outputs: Vec<(PathBuf, PathBuf)>,
}

impl Files {
    /// The files that the command reads.
    pub(crate) fn reading<'a>(inputs: impl IntoIterator<Item = &'a Path>) -> Self {
        let known = |path: &'a Path| (identity(path), path.to_owned());
        Self {
            inputs: inputs.into_iter().map(known).collect(),
            outputs: Vec::new(),
        }
    }

    /// Files that it reads besides.
    pub(crate) fn and(mut self, inputs: impl IntoIterator<Item = PathBuf>) -> Self {
        let known = inputs.into_iter().map(|path| (identity(&path), path));
        self.inputs.extend(known);
        self
    }

    /// All that it reads, as they were given.
    pub(crate) fn inputs(&self) -> Vec<PathBuf> {
        let given = self.inputs.iter().map(|(_, as_given)| as_given);
        given.cloned().collect()
    }

    /// Claims a file to write, which is neither read nor written by the same command otherwise.
    pub(crate) fn claim(&mut self, path: &Path) -> Result<OutFile, Error> {
        let file = OutFile::create(path)?;
        let identity = identity(path);
        let same = |files: &[(PathBuf, PathBuf)]| {
            let same = files.iter().find(|(known, _)| *known == identity);
            same.map(|(_, as_given)| as_given.display().to_string())
        };
        if let Some(input) = same(&self.inputs) {
            return Err(refused(
                path,
                &format!("it is the same file as the input `{input}`; give another name"),
            ));
        }
        if let Some(output) = same(&self.outputs) {
            return Err(refused(
                path,
                &format!(
                    "it is the same file as the output `{output}`; give each a name of its own"
                ),
            ));
        }
        self.outputs.push((identity, path.to_owned()));
        Ok(file)
    }

    /// The same for a file that is not there yet, nor comes there before this one is written.
    pub(crate) fn claim_new(&mut self, path: &Path) -> Result<OutFile, Error> {
        let _ = self.claim(path)?;
        OutFile::create_new(path)
    }

    /// Claims a file that may not be asked for.
    pub(crate) fn claim_if(&mut self, path: Option<&Path>) -> Result<Option<OutFile>, Error> {
        path.map(|path| self.claim(path)).transpose()
    }
}

impl Files {
    /// Claims a figure that may not be asked for: figures are SVG.
    pub(crate) fn claim_figure(&mut self, path: Option<&Path>) -> Result<Option<OutFile>, Error> {
        let other = path.filter(|path| {
            let end = path.extension();
            end.is_some_and(|end| !end.eq_ignore_ascii_case("svg"))
        });
        if let Some(path) = other {
            let meant = path.with_extension("svg");
            return Err(Error::Argument(format!(
                "--figure {}: figures are written as SVG; name it `{}`",
                path.display(),
                meant.display()
            )));
        }
        self.claim_if(path)
    }
}

/// One path for all names of a file, as far as it exists; the rest is compared as it is written.
fn identity(path: &Path) -> PathBuf {
    if let Ok(found) = fs::canonicalize(path) {
        return found;
    }
    let plain = without_dots(path);
    match (plain.parent().map(fs::canonicalize), plain.file_name()) {
        (Some(Ok(folder)), Some(name)) => folder.join(name),
        _ => plain,
    }
}

/// An absolute path without `.` and `..`.
fn without_dots(path: &Path) -> PathBuf {
    let mut plain = PathBuf::new();
    let absolute = std::path::absolute(path).unwrap_or_else(|_| path.to_owned());
    for component in absolute.components() {
        match component {
            Component::CurDir => {}
            Component::ParentDir => {
                plain.pop();
            }
            other => plain.push(other),
        }
    }
    plain
}

/// A file that is to be written: whether it can be is found out at once, before the work, and nothing is left in its folder
/// until its content appears under its name in one step.
#[derive(Debug)]
pub(crate) struct OutFile {
    path: PathBuf,
    /// The file itself, where the path is a link to it.
    target: PathBuf,
    /// Whether what is there already stays.
    is_new: bool,
}

impl OutFile {
    /// Makes sure that the file can be written.
    pub(crate) fn create(path: &Path) -> Result<Self, Error> {
        if path.file_name().is_none() {
            return Err(refused(path, "it names no file"));
        }
        let target = match fs::symlink_metadata(path) {
            Ok(found) => existing(path, found.is_symlink())?,
            Err(_) => path.to_owned(),
        };
        let folder = folder_of(&target);
        if !folder.exists() {
            let reason = format!("there is no folder `{}`; make it first", folder.display());
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
            let reason = format!("in folder `{}`: {}", folder.display(), reason(&error));
            refused(path, &reason)
        })?;
        Ok(Self {
            path: path.to_owned(),
            target,
            is_new: false,
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
                Ok((file, temporary))
            });
            let written = written.collect::<Result<Vec<_>, Error>>()?;
            written
                .into_iter()
                .try_for_each(|(file, temporary)| file.put(temporary))
        })
    }

    /// The content in a file without its name, with the permissions of what it takes the place of.
    fn write(&self, content: &[u8]) -> Result<NamedTempFile, Error> {
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
        Ok(())
    }
}

fn there_already(path: &Path) -> Error {
    refused(
        path,
        "there is such a file already; give another name, or `--force` to put this one in its place",
    )
}

/// The regular file, open to writing, that is at a path already.
fn existing(path: &Path, is_link: bool) -> Result<PathBuf, Error> {
    let about = fs::metadata(path)
        .map_err(|error| refused(path, &format!("it is a link that leads nowhere: {error}")))?;
    if about.is_dir() {
        return Err(refused(path, "it is a folder"));
    }
    // `/dev/stdout` is a link to whatever the shell has put there, a regular file at times.
    let of_the_system = is_link && (path.starts_with("/dev") || path.starts_with("/proc"));
    if !about.is_file() || of_the_system {
        return Err(refused(
            path,
            "it is no regular file; results appear in one step, which takes a file",
        ));
    }
    if about.permissions().readonly() {
        return Err(refused(path, "it is read-only"));
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

fn refused(path: &Path, reason: &str) -> Error {
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

/// JSON text with a line end.
pub(crate) fn json(value: &impl Serialize) -> String {
    let mut text = serde_json::to_string_pretty(value).expect("results are plain lists and names");
    text.push('\n');
    text
}

/// What was found, with what the program says of it besides numbers.
#[derive(Serialize)]
struct Noted<'a, R> {
    #[serde(flatten)]
    report: &'a R,
    notes: Vec<&'a str>,
}

/// The same with notes, which a terminal has with a word before them.
pub(crate) fn json_with_notes(report: &impl Serialize, notes: &[String]) -> String {
    let notes = notes.iter();
    let notes = notes.map(|note| note.strip_prefix("note: ").unwrap_or(note));
    json(&Noted {
        report,
        notes: notes.collect(),
    })
}

/// A number with so many digits.
pub(crate) fn significant(number: f64, digits: usize) -> String {
    let decimals = decimals(number, digits);
    format!("{number:.decimals$}")
}

/// Decimals that show so many digits of a number.
pub(crate) fn decimals(number: f64, digits: usize) -> usize {
    let ahead = digits.saturating_sub(1);
    let text = format!("{number:.ahead$e}");
    let exponent = text.split_once('e').and_then(|(_, e)| e.parse().ok());
    let behind = i64::try_from(ahead).unwrap_or(0) - exponent.unwrap_or(0_i64);
    usize::try_from(behind).unwrap_or(0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rounding_leaves_what_was_meant() {
        assert_eq!(
            rounded(-0.002_080_000_000_000_000_3).to_string(),
            "-0.00208"
        );
        assert_eq!(rounded(-2.0).to_string(), "-2");
        assert_eq!(rounded(123_456_789.0).to_string(), "123457000");
        assert!(rounded(f64::NAN).is_nan());
    }
}

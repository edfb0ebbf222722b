//! The files of a command, none of which takes the place of another.

use std::fs;
use std::path::{Component, Path, PathBuf};

use super::content::Content;
use super::out_file::{OutFile, refused};
use crate::Error;

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
        self.check_free(path)?;
        self.outputs.push((identity(path), path.to_owned()));
        Ok(file)
    }

    /// The same for what takes the place of its like alone, and says so.
    pub(crate) fn claim_for(&mut self, path: &Path, content: Content) -> Result<OutFile, Error> {
        self.claim(path)?.holding(content)
    }

    /// The same for a file that may not be asked for.
    pub(crate) fn claim_if(
        &mut self,
        path: Option<&Path>,
        content: Content,
    ) -> Result<Option<OutFile>, Error> {
        path.map(|path| self.claim_for(path, content)).transpose()
    }

    /// Refuses a path that the same command reads or writes.
    pub(crate) fn check_free(&self, path: &Path) -> Result<(), Error> {
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
                &format!("it is the same file as the output `{output}`; give each its own name"),
            ));
        }
        Ok(())
    }

    /// Claims a file that is not there yet, nor comes there before this one is written.
    pub(crate) fn claim_new(&mut self, path: &Path) -> Result<OutFile, Error> {
        let _ = self.claim(path)?;
        OutFile::create_new(path)
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
        self.claim_if(path, Content::Figure)
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

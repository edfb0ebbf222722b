//! A file that appears whole or not at all.

use std::io::Write as _;
use std::path::{Path, PathBuf};

use tempfile::NamedTempFile;

use crate::{Error, failed};

/// A file that is to be written when the work is done.
#[derive(Debug)]
pub struct OutFile {
    path: PathBuf,
    folder: PathBuf,
}

impl OutFile {
    /// Makes sure that it can be written, and leaves nothing behind.
    ///
    /// # Errors
    /// Its folder is not there or not to be written to, or the path is a folder.
    pub fn claim(path: &Path) -> Result<Self, Error> {
        if path.is_dir() {
            return Err(failed("write", path, "it is a folder"));
        }
        let folder = path
            .parent()
            .filter(|folder| !folder.as_os_str().is_empty());
        let folder = folder.unwrap_or(Path::new(".")).to_owned();
        if !folder.is_dir() {
            let reason = format!("there is no folder `{}`; make it first", folder.display());
            return Err(failed("write", path, reason));
        }
        tempfile::tempfile_in(&folder).map_err(|error| failed("write", path, error))?;
        Ok(Self {
            path: path.to_owned(),
            folder,
        })
    }

    /// What stands in it now.
    ///
    /// # Errors
    /// It is not there, or no text.
    pub fn current(&self) -> Result<String, Error> {
        std::fs::read_to_string(&self.path).map_err(|error| failed("read", &self.path, error))
    }

    /// Puts the content in place in one step.
    ///
    /// # Errors
    /// The folder takes no file any more.
    pub fn commit(self, content: &str) -> Result<PathBuf, Error> {
        let write = || {
            let mut file = NamedTempFile::new_in(&self.folder)?;
            file.write_all(content.as_bytes())?;
            file.persist(&self.path).map_err(|error| error.error)
        };
        write().map_err(|error| failed("write", &self.path, error))?;
        Ok(self.path)
    }
}

#[cfg(test)]
mod tests {
    use super::OutFile;

    #[test]
    fn a_place_that_cannot_be_written_is_told_at_once() {
        let folder = tempfile::tempdir().expect("a temporary folder");
        let missing = folder.path().join("nowhere/rows.json");
        let error = OutFile::claim(&missing)
            .expect_err("no such folder")
            .to_string();
        assert!(
            error.contains("rows.json") && error.contains("make it first"),
            "{error}"
        );
        let error = OutFile::claim(folder.path())
            .expect_err("a folder")
            .to_string();
        assert!(error.contains("it is a folder"), "{error}");
        // A name alone is in the folder that one stands in.
        assert!(OutFile::claim("rows.json".as_ref()).is_ok());
    }

    #[test]
    fn whole_or_not_at_all() {
        let folder = tempfile::tempdir().expect("a temporary folder");
        let path = folder.path().join("rows.json");
        let files = || std::fs::read_dir(folder.path()).expect("a folder").count();
        let file = OutFile::claim(&path).expect("a writable folder");
        assert_eq!(files(), 0);
        file.commit("{}").expect("a writable folder");
        assert_eq!(files(), 1);
        assert_eq!(std::fs::read_to_string(&path).ok().as_deref(), Some("{}"));
    }
}

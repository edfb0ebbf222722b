//! The folder of a report.

use std::path::{Path, PathBuf};

use crate::Error;
use crate::interrupt::MadeFolder;
use crate::output::{Content, Files, OutFile};

/// The page in the folder.
const PAGE: &str = "index.html";

/// A folder that a report is to be written to; one that is not there is made with its page, so that none stays empty, whatever ends the
/// program before.
#[derive(Debug)]
pub(crate) struct ReportFolder {
    page: OutFile,
    folder: PathBuf,
}

impl ReportFolder {
    /// Claims the page of a folder that is there, or that can be made.
    pub(crate) fn claim(files: &mut Files, folder: &Path) -> Result<Self, Error> {
        files.check_free(folder)?;
        if folder.is_file() {
            return Err(Error::Write {
                path: folder.to_owned(),
                reason: "it is a file, but `--report` takes a folder".to_owned(),
            });
        }
        // It goes away again behind the claim.
        let _trial = if folder.exists() {
            None
        } else {
            Some(made(folder)?)
        };
        Ok(Self {
            page: files.claim_for(&folder.join(PAGE), Content::Page)?,
            folder: folder.to_owned(),
        })
    }

    /// Claims the folder of a report that may not be asked for.
    pub(crate) fn claim_if(
        files: &mut Files,
        folder: Option<&Path>,
    ) -> Result<Option<Self>, Error> {
        folder.map(|folder| Self::claim(files, folder)).transpose()
    }

    /// Puts the page in place and says where it is.
    pub(crate) fn commit(self, html: &str) -> Result<String, Error> {
        let path = self.page.path().display().to_string();
        let _made = if self.folder.exists() {
            None
        } else {
            Some(made(&self.folder)?)
        };
        self.page.commit(html.as_bytes())?;
        Ok(path)
    }
}

/// The folder of the page that comes next to the one in a folder: its name with a word behind it, or the word where it has no name, as `.` has.
pub(crate) fn beside(folder: &Path, word: &str) -> PathBuf {
    match folder.file_name() {
        Some(name) => {
            let mut name = name.to_owned();
            name.push(format!("-{word}"));
            folder.with_file_name(name)
        }
        None => word.into(),
    }
}

fn made(folder: &Path) -> Result<MadeFolder, Error> {
    MadeFolder::make(folder).map_err(|error| {
        let mut around = folder.ancestors().skip(1);
        let file = around.find(|path| path.is_file());
        let reason = match file {
            Some(file) => format!("`{}` is not a folder", file.display()),
            None => format!(
                "the folder of a report cannot be created: {error}; choose one in a folder where you may write"
            ),
        };
        Error::Write {
            path: folder.to_owned(),
            reason,
        }
    })
}

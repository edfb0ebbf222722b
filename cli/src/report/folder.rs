//! The folder of a report.

use std::path::Path;

use crate::Error;
use crate::interrupt::MadeFolder;
use crate::output::{Files, OutFile};

/// The page in the folder.
const PAGE: &str = "index.html";

/// A folder that a report is to be written to; one that was made for it goes away with the report that never came.
#[derive(Debug)]
pub(crate) struct ReportFolder {
    page: OutFile,
    /// Where it was not there before.
    _made: Option<MadeFolder>,
}

impl ReportFolder {
    /// Claims the page of a folder, which is made where it is not there.
    pub(crate) fn claim(files: &mut Files, folder: &Path) -> Result<Self, Error> {
        let made = if folder.exists() {
            None
        } else {
            let made = MadeFolder::make(folder).map_err(|error| Error::Write {
                path: folder.to_owned(),
                reason: format!("the folder of a report cannot be made: {error}"),
            })?;
            Some(made)
        };
        Ok(Self {
            page: files.claim(&folder.join(PAGE))?,
            _made: made,
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
        self.page.commit(html.as_bytes())?;
        Ok(path)
    }
}

//! The folder of a report.

use std::fs;
use std::path::{Path, PathBuf};

use crate::Error;
use crate::output::{Files, OutFile};

/// The page in the folder.
const PAGE: &str = "index.html";

/// A folder that a report is to be written to; one that was made for it goes away with the report that never came.
#[derive(Debug)]
pub(crate) struct ReportFolder {
    page: Option<OutFile>,
    /// The folder, where it was not there before and is still empty.
    made: Option<PathBuf>,
}

impl ReportFolder {
    /// Claims the page of a folder, which is made where it is not there.
    pub(crate) fn claim(files: &mut Files, folder: &Path) -> Result<Self, Error> {
        let made = !folder.exists();
        if made {
            fs::create_dir(folder).map_err(|error| Error::Write {
                path: folder.to_owned(),
                reason: format!("the folder of a report cannot be made: {error}"),
            })?;
        }
        let mut claimed = Self {
            page: None,
            made: made.then(|| folder.to_owned()),
        };
        claimed.page = Some(files.claim(&folder.join(PAGE))?);
        Ok(claimed)
    }

    /// Claims the folder of a report that may not be asked for.
    pub(crate) fn claim_if(
        files: &mut Files,
        folder: Option<&Path>,
    ) -> Result<Option<Self>, Error> {
        folder.map(|folder| Self::claim(files, folder)).transpose()
    }

    /// Puts the page in place and says where it is.
    pub(crate) fn commit(mut self, html: &str) -> Result<String, Error> {
        let page = self.page.take().expect("claimed when it was made");
        let path = page.path().display().to_string();
        page.commit(html.as_bytes())?;
        self.made = None;
        Ok(path)
    }
}

impl Drop for ReportFolder {
    fn drop(&mut self) {
        if let Some(folder) = &self.made {
            // What somebody has put there in the meantime stays.
            let _ = fs::remove_dir(folder);
        }
    }
}

//! Where `identify` writes what it found.

use std::fmt::Write;
use std::path::PathBuf;

use serde::Serialize;

use super::IdentifyArguments;
use super::page::Evidence;
use crate::Error;
use crate::output::{self, Content, Files, OutFile, Record};
use crate::progress::Progress;
use crate::report::ReportFolder;

/// Files of a result that were asked for.
pub(super) struct Results {
    json: Option<OutFile>,
    page: Option<ReportFolder>,
    inputs: Vec<PathBuf>,
    /// The command that comes next.
    next: Option<String>,
    others: Vec<(OutFile, String)>,
}

impl Results {
    pub fn claim(files: &mut Files, asked: &IdentifyArguments) -> Result<Self, Error> {
        Ok(Self {
            json: files.claim_if(asked.json.as_deref(), Content::Json(Record::Identify))?,
            page: ReportFolder::claim_if(files, asked.report.as_deref())?,
            inputs: files.inputs(),
            next: asked.command_of_trace(),
            others: Vec::new(),
        })
    }

    /// With another file.
    pub fn with(mut self, file: OutFile, text: String) -> Self {
        self.others.push((file, text));
        self
    }

    /// Writes and prints what was found. All contents are ready before the first file appears.
    pub fn give(
        self,
        report: &impl Serialize,
        found: &Evidence,
        progress: Progress,
    ) -> Result<(), Error> {
        let page = self.page.map(|folder| {
            Ok::<_, Error>((folder, found.page(&self.inputs, self.next.as_deref())?))
        });
        let page = page.transpose()?;
        let text = || output::json_with_notes(report, &found.notes);
        let json = self.json.map(|file| (file, text()));
        let _behind = progress.ended();
        for (file, text) in self.others.into_iter().chain(json) {
            file.commit(text.as_bytes())?;
        }
        let mut told = found.printed.to_owned();
        if let Some((folder, page)) = page {
            let path = folder.commit(&page)?;
            writeln!(told, "wrote {path}: the report").expect("a string takes all");
        }
        output::print(&told)
    }
}

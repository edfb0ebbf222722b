//! Rows of a study that takes hours: in their file as soon as they are there, and not run again.

use std::path::{Path, PathBuf};
use std::sync::Mutex;

use robot_model_benches::out_file::OutFile;

use crate::experiment::Case;
use crate::judge::Row;

/// Rows, and the file that has them.
pub struct Rows {
    path: Option<PathBuf>,
    rows: Mutex<Vec<Row>>,
}

impl Rows {
    /// With those that the file has, if there is one.
    ///
    /// # Errors
    /// A file that has other things, or that cannot be written.
    pub fn of(path: Option<&Path>) -> Result<Self, String> {
        let mut rows = Vec::new();
        if let Some(path) = path {
            OutFile::claim(path).map_err(|error| error.to_string())?;
            if path.exists() {
                rows = read(path)?;
            }
        }
        Ok(Self {
            path: path.map(Path::to_owned),
            rows: Mutex::new(rows),
        })
    }

    /// That of an experiment.
    pub fn row(&self, case: &Case) -> Option<Row> {
        let rows = self.rows.lock().expect("no panic");
        rows.iter().find(|row| is_of(row, case)).cloned()
    }

    /// That of an experiment, in place of an earlier one, into the file, too.
    ///
    /// # Errors
    /// The file cannot be written any more.
    pub fn put(&self, case: &Case, row: Row) -> Result<(), String> {
        let mut rows = self.rows.lock().expect("no panic");
        rows.retain(|row| !is_of(row, case));
        rows.push(row);
        let Some(path) = &self.path else {
            return Ok(());
        };
        // A line each, for people who look.
        let lines = rows
            .iter()
            .map(|row| serde_json::to_string(row).expect("rows are plain"));
        let text = format!("[\n{}\n]\n", lines.collect::<Vec<_>>().join(",\n"));
        OutFile::claim(path)
            .and_then(|file| file.commit(&text))
            .map_err(|error| error.to_string())?;
        Ok(())
    }
}

fn is_of(row: &Row, case: &Case) -> bool {
    row.arm == case.arm.name
        && row.number == case.number()
        && row.kind == case.injection.kind
        && row.seed == case.seed
        && row.is_of(case.share)
}

/// Rows that an earlier run wrote.
///
/// # Errors
/// No such file, or one that has other things.
pub fn read(path: &Path) -> Result<Vec<Row>, String> {
    let cannot =
        |error: &dyn std::fmt::Display| format!("cannot read `{}`: {error}", path.display());
    let text = std::fs::read_to_string(path).map_err(|error| cannot(&error))?;
    serde_json::from_str(&text).map_err(|error| cannot(&error))
}

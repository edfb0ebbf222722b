//! Input files: specs to models, logs.

use std::fs;
use std::path::Path;

use robot_model::log::Log;
use robot_model_codegen::{Compiled, compile_model};
use robot_model_spec::Model;

use crate::Error;
use crate::progress::Progress;

/// Reads a text file.
pub(crate) fn read_text(path: &Path) -> Result<String, Error> {
    fs::read_to_string(path).map_err(|error| Error::read(path, &error))
}

/// Reads and checks a spec.
pub(crate) fn load(path: &Path) -> Result<Model, Error> {
    let text = read_text(path)?;
    Ok(robot_model_spec::load(&path.display().to_string(), &text)?)
}

/// Reads, checks and compiles a spec.
pub(crate) fn compile(path: &Path) -> Result<Compiled, Error> {
    Ok(compile_model(&load(path)?))
}

/// Reads a log of an arm with `dof` joints, and says what is remarkable about it.
pub(crate) fn read_log(path: &Path, dof: usize, progress: &Progress) -> Result<Log, Error> {
    progress.step(&format!("reading {}", path.display()));
    let log = Log::read(path, dof)?;
    for note in &log.report {
        progress.note(&format!("note: {}: {note}", log.source));
    }
    Ok(log)
}

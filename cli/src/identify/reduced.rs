//! Factors as files, and logs that are read piece by piece into one.

use std::path::{Path, PathBuf};

use robot_model::identify::{Errors, Estimate, Factor, FactorBlock, Identify};
use robot_model::log::{Fault, Log};
use robot_model::signal::Bands;
use serde::{Deserialize, Serialize};
use serde_json::Value;

use super::fit::{ByAcceleration, Fit, mean_errors};
use crate::interpreted::InterpretedArm;
use crate::progress::Progress;
use crate::spec::log_columns;
use crate::{Error, json};

/// Rows of a log in memory at a time, half of them at least.
const PIECE: usize = 16_384;

/// What is written and read; a contract between machines.
#[derive(Serialize, Deserialize)]
struct File {
    /// Of this form.
    factor: u32,
    unknowns: Vec<String>,
    joints: Vec<String>,
    bands_hz: [f64; 3],
    blocks: Vec<Block>,
}

#[derive(Serialize, Deserialize)]
struct Block {
    samples: usize,
    /// Rows of each joint that say something; in files without it all of them do.
    #[serde(default)]
    counts: Option<Vec<usize>>,
    torque_squares: Vec<f64>,
    /// `[joint][row][column]`: columns are the unknowns, then the torque.
    rows: Vec<Vec<Vec<f64>>>,
}

const FORM: u32 = 1;

/// The text of a factor's file.
pub(crate) fn text(factor: &Factor) -> String {
    let blocks = factor.blocks.iter().map(|block| Block {
        samples: block.samples,
        counts: Some(block.counts.clone()),
        torque_squares: block.torque_squares.clone(),
        rows: block.rows.clone(),
    });
    let bands = factor.bands;
    let file = File {
        factor: FORM,
        unknowns: factor.unknowns.clone(),
        joints: factor.joints.clone(),
        bands_hz: [bands.shared_hz, bands.smooth_hz, bands.wide_hz],
        blocks: blocks.collect(),
    };
    let mut text = serde_json::to_string(&file).expect("a factor is lists of numbers and names");
    text.push('\n');
    text
}

/// Reads a factor of an arm.
pub(crate) fn read(path: &Path, arm: &InterpretedArm) -> Result<Factor, Error> {
    let refuse = |reason: &str| Error::json(path, &reason);
    let value: Value = json::read(path)?;
    let file: File = serde_json::from_value(value)
        .map_err(|error| refuse(&format!("it is no factor of `identify --factor`: {error}")))?;
    if file.factor != FORM {
        return Err(refuse(&format!(
            "it is a factor of form {}, this program reads form {FORM}; write it anew with `identify --factor`",
            file.factor
        )));
    }
    let (joints, width) = (file.joints.len(), file.unknowns.len() + 1);
    let fits = |block: &Block| {
        let rows = block.rows.iter().flatten();
        let counts = block.counts.iter().flatten();
        let some = block.counts.iter();
        block.rows.len() == joints
            && block.torque_squares.len() == joints
            && some.into_iter().all(|counts| counts.len() == joints)
            && counts.into_iter().all(|count| *count <= block.samples)
            && block.samples > 0
            && rows.into_iter().all(|row| row.len() == width)
    };
    if let Some(k) = file.blocks.iter().position(|block| !fits(block)) {
        return Err(refuse(&format!(
            "block {} has not one list of rows per joint with {width} numbers each; write it anew with `identify --factor`",
            k + 1
        )));
    }
    let [shared_hz, smooth_hz, wide_hz] = file.bands_hz;
    let bands = Bands {
        smooth_hz,
        wide_hz,
        shared_hz,
    };
    let mut factor = Factor::new(arm, bands)?;
    factor.joints = file.joints;
    factor.unknowns = file.unknowns;
    factor.blocks = file
        .blocks
        .into_iter()
        .map(|block| FactorBlock {
            samples: block.samples,
            counts: block.counts.unwrap_or(vec![block.samples; joints]),
            rows: block.rows,
            torque_squares: block.torque_squares,
        })
        .collect();
    // Of this arm, and of none that is alike.
    Factor::new(arm, bands)?
        .merge(factor.clone())
        .map_err(|error| refuse(&error.to_string()))?;
    Ok(factor)
}

/// Logs whose pieces are looked at one after the other.
pub(super) struct Streams<'a> {
    pub form: &'a ByAcceleration,
    pub logs: &'a [PathBuf],
    pub as_logged: bool,
}

impl Streams<'_> {
    /// Reduces all logs. Without bands those of the first piece are taken.
    pub fn reduce(
        &self,
        identify: &Identify,
        faults: &mut Vec<(String, Fault)>,
        progress: &Progress,
    ) -> Result<Factor, Error> {
        let arm = &self.form.0;
        let effects = arm.compiled().model.effects.iter();
        let mut remembers = effects.filter(|effect| !effect.definition.states.is_empty());
        if let Some(effect) = remembers.next() {
            return Err(Error::Argument(format!(
                "{}:{}: `{}` remembers, and a log that is read piece by piece forgets; identify without `--factor`",
                arm.compiled().model.source,
                effect.line,
                effect.definition.name
            )));
        }
        let mut factor: Option<Factor> = None;
        for path in self.logs {
            let bands = match &factor {
                Some(factor) => factor.bands,
                None => self.bands(identify, path)?,
            };
            let factor = match &mut factor {
                Some(factor) => factor,
                none => none.insert(Factor::new(arm, bands)?),
            };
            self.each(path, &bands, progress, |log, found| {
                let source = path.display().to_string();
                faults.extend(found.into_iter().map(|fault| (source.clone(), fault)));
                factor.push(arm, log).map_err(Error::from)
            })?;
        }
        factor.ok_or_else(|| Error::from(robot_model::identify::IdentifyError::NoLog))
    }

    fn bands(&self, identify: &Identify, path: &Path) -> Result<Bands, Error> {
        let mut pieces = Log::pieces(path, &log_columns(self.form.model()), PIECE, 0.0)?;
        let first = pieces.next();
        let first = first.ok_or(robot_model::identify::IdentifyError::NoLog)??;
        Ok(identify.bands_of(&self.form.0, &first)?)
    }

    /// Every piece of a log, mended, with its faults.
    fn each(
        &self,
        path: &Path,
        bands: &Bands,
        progress: &Progress,
        mut visit: impl FnMut(&Log, Vec<Fault>) -> Result<(), Error>,
    ) -> Result<(), Error> {
        let columns = log_columns(self.form.model());
        // Filters cut one period of the band from either end.
        let overlap = 2.0 / bands.shared_hz;
        for (k, piece) in Log::pieces(path, &columns, PIECE, overlap)?.enumerate() {
            let piece = piece?;
            if k == 0 {
                for note in &piece.report {
                    progress.note(&format!("note: {}: {note}", path.display()));
                }
            }
            progress.step(&format!("{}: from {:.1} s", path.display(), piece.time[0]));
            if self.as_logged {
                visit(&piece, Vec::new())?;
                continue;
            }
            let mended = piece.mended();
            visit(&mended.log, mended.faults)?;
        }
        Ok(())
    }

    /// Errors over all pieces.
    pub fn errors(&self, estimate: &Estimate, progress: &Progress) -> Result<Errors, Error> {
        let mut all = Vec::new();
        for path in self.logs {
            self.each(path, &estimate.bands, progress, |log, _| {
                all.push((log.time.len(), self.form.errors(estimate, log)?));
                Ok(())
            })?;
        }
        Ok(mean_errors(&all))
    }
}

//! Factors as files, and logs that are read piece by piece into one.

use std::path::{Path, PathBuf};

use robot_model::identify::{Errors, Estimate, Factor, FactorBlock, FactorRows, Identify};
use robot_model::log::{Fault, Log, Mended, Note};
use robot_model::signal::Bands;
use serde::{Deserialize, Serialize};
use serde_json::Value;

use super::fit::{ByAcceleration, Fit};
use crate::in_order::in_order;
use crate::interpreted::InterpretedArm;
use crate::log_settings::LogSettings;
use crate::progress::Progress;
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
    /// What the columns are made of, see [`Factor::equations`].
    equations: Vec<[f64; 2]>,
    bands_hz: [f64; 3],
    blocks: Vec<Block>,
}

#[derive(Serialize, Deserialize)]
struct Block {
    samples: usize,
    away: Part,
    /// Rows at turns of joints with dry friction, where there are some.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    at_turns: Option<Part>,
}

#[derive(Serialize, Deserialize)]
struct Part {
    /// Rows of each joint that say something.
    counts: Vec<usize>,
    torque_squares: Vec<f64>,
    /// `[joint][row][column]`: columns are the unknowns, then the torque.
    rows: Vec<Vec<Vec<f64>>>,
}

impl Part {
    fn of(rows: &FactorRows) -> Self {
        Self {
            counts: rows.counts.clone(),
            torque_squares: rows.torque_squares.clone(),
            rows: rows.rows.clone(),
        }
    }

    fn into_rows(self) -> FactorRows {
        FactorRows {
            counts: self.counts,
            rows: self.rows,
            torque_squares: self.torque_squares,
        }
    }

    /// What is wrong with rows of so many joints and columns.
    fn fault(&self, joints: usize, width: usize) -> Option<String> {
        let lists = [
            self.rows.len(),
            self.torque_squares.len(),
            self.counts.len(),
        ];
        let mut rows = self.rows.iter().flatten();
        if lists != [joints; 3] || !rows.all(|row| row.len() == width) {
            return Some(format!(
                "has not one list of rows per joint with {width} numbers each"
            ));
        }
        let is_negative = self.torque_squares.iter().any(|sum| *sum < 0.0);
        is_negative.then(|| "has a sum of squares below zero".to_owned())
    }
}

impl Block {
    fn fault(&self, joints: usize, width: usize) -> Option<String> {
        let parts = std::iter::once(&self.away).chain(&self.at_turns);
        let faults = parts.clone().map(|rows| rows.fault(joints, width));
        if let Some(fault) = faults.flatten().next() {
            return Some(fault);
        }
        let count = |joint: usize| -> usize { parts.clone().map(|rows| rows.counts[joint]).sum() };
        let is_more = self.samples == 0 || (0..joints).any(|joint| count(joint) > self.samples);
        is_more.then(|| "has no samples, or less than rows".to_owned())
    }
}

/// What a factor is not that is refused.
const AS_WRITTEN: &str = "it is no factor as `identify --factor` writes it; write it anew";

/// The first did not say what its columns are made of, nor which rows are at turns.
const FORM: u32 = 2;

/// The text of a factor's file.
pub(crate) fn text(factor: &Factor) -> String {
    let blocks = factor.blocks.iter().map(|block| {
        let has_turns = block.at_turns.rows.iter().any(|rows| !rows.is_empty());
        Block {
            samples: block.samples,
            away: Part::of(&block.away),
            at_turns: has_turns.then(|| Part::of(&block.at_turns)),
        }
    });
    let bands = factor.bands;
    let file = File {
        factor: FORM,
        unknowns: factor.unknowns.clone(),
        joints: factor.joints.clone(),
        equations: factor.equations.clone(),
        bands_hz: [bands.shared_hz, bands.smooth_hz, bands.wide_hz],
        blocks: blocks.collect(),
    };
    let mut text = serde_json::to_string(&file).expect("a factor is lists of numbers and names");
    text.push('\n');
    text
}

/// Whether a file looks like a log: by its first bytes, or by the names in its first line.
fn log_of(path: &Path) -> bool {
    const MAGIC: [&[u8]; 3] = [b"PAR1", b"\x89MCAP", &[0x1f, 0x8b]];
    let Ok(bytes) = std::fs::read(path) else {
        return false;
    };
    let first = bytes.split(|byte| *byte == b'\n').next().unwrap_or(&[]);
    let is_line = |line: &[u8]| line.contains(&b',') && !line.starts_with(b"{");
    MAGIC.iter().any(|magic| bytes.starts_with(magic)) || is_line(first)
}

/// Reads a factor of an arm.
pub(crate) fn read(path: &Path, arm: &InterpretedArm) -> Result<Factor, Error> {
    let refuse = |reason: &str| Error::json(path, &reason);
    let value: Value = json::read(path).map_err(|error| {
        // What is no JSON at all is most likely what the factor was to be made of.
        if log_of(path) {
            refuse("it is a log, and no factor of logs; `identify --factor` makes one of it")
        } else {
            error
        }
    })?;
    if let Some(form) = value["factor"]
        .as_u64()
        .filter(|form| *form != u64::from(FORM))
    {
        return Err(refuse(&format!(
            "it is a factor of form {form}, this program reads form {FORM}; write it anew with `identify --factor`"
        )));
    }
    let file: File = json::typed(path, value, AS_WRITTEN)?;
    let (joints, width) = (file.joints.len(), file.unknowns.len() + 1);
    for (k, block) in file.blocks.iter().enumerate() {
        if let Some(fault) = block.fault(joints, width) {
            return Err(refuse(&format!(
                "block {} {fault}; write it anew with `identify --factor`",
                k + 1
            )));
        }
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
    factor.equations = file.equations;
    factor.blocks = file
        .blocks
        .into_iter()
        .map(|block| FactorBlock {
            samples: block.samples,
            away: block.away.into_rows(),
            at_turns: block
                .at_turns
                .map_or_else(|| FactorRows::none(joints), Part::into_rows),
        })
        .collect();
    // Of this arm, and of none that is alike.
    Factor::new(arm, bands)?
        .merge(factor.clone())
        .map_err(|error| refuse(&error.to_string()))?;
    Ok(factor)
}

/// Logs that are looked at piece by piece.
pub(super) struct Streams<'a> {
    pub form: &'a ByAcceleration,
    pub logs: &'a [PathBuf],
    pub settings: &'a LogSettings,
    pub as_logged: bool,
    /// Pieces that are worked on at a time.
    pub workers: usize,
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
                None => self.bands(identify, progress)?,
            };
            let factor = match &mut factor {
                Some(factor) => factor,
                none => none.insert(Factor::new(arm, bands)?),
            };
            let blocks = |log: &Log| Ok(FactorBlock::of_log(arm, log, &bands)?);
            self.each(path, &bands, progress, blocks, |blocks, found| {
                let source = path.display().to_string();
                for fault in found {
                    // Stamps that jitter do so in every piece.
                    let is_jitter = matches!(fault, Fault::Jitter { .. });
                    let mut before = faults.iter();
                    let same = |(log, told): &(String, Fault)| {
                        *log == source && told.kind() == fault.kind()
                    };
                    if !(is_jitter && before.any(same)) {
                        faults.push((source.clone(), fault));
                    }
                }
                factor.extend(blocks);
            })?;
        }
        factor.ok_or_else(|| Error::from(robot_model::identify::IdentifyError::NoLog))
    }

    /// Those that the beginning of the slowest log bears.
    fn bands(&self, identify: &Identify, progress: &Progress) -> Result<Bands, Error> {
        let first = |path: &PathBuf| -> Result<Log, Error> {
            let columns = self.settings.columns(path, self.form.model(), progress)?;
            let mut pieces = Log::pieces(path, &columns, PIECE, 0.0)?;
            let first = pieces.next();
            Ok(first.ok_or(robot_model::identify::IdentifyError::NoLog)??)
        };
        // One of them at a time is in memory, beside the slowest so far.
        let mut slowest: Option<Log> = None;
        for path in self.logs {
            let log = first(path)?;
            let is_slower = |slowest: &Log| log.rate_hz() < slowest.rate_hz();
            if slowest.as_ref().is_none_or(is_slower) {
                slowest = Some(log);
            }
        }
        let slowest = slowest.ok_or(robot_model::identify::IdentifyError::NoLog)?;
        Ok(identify.bands_of(&self.form.0, &slowest)?)
    }

    /// Works on every piece of a log, mended, in threads; takes what comes of it and the piece's faults in the order of the pieces.
    fn each<R: Send>(
        &self,
        path: &Path,
        bands: &Bands,
        progress: &Progress,
        work: impl Fn(&Log) -> Result<R, Error> + Sync,
        mut take: impl FnMut(R, Vec<Fault>),
    ) -> Result<(), Error> {
        let columns = self.settings.columns(path, self.form.model(), progress)?;
        // Filters cut one period of the band from either end.
        let overlap = 2.0 / bands.shared_hz;
        let mut pieces = Log::pieces(path, &columns, PIECE, overlap)?;
        let mut next = 0..;
        let pieces = std::iter::from_fn(|| Some((next.next()?, pieces.next()?, pieces.done())));
        let pieces = pieces.map(|(k, piece, done)| {
            let piece = piece?;
            // What is wrong with rows is of each piece; all else is alike.
            let is_own = |note: &&Note| {
                matches!(
                    note,
                    Note::Gaps { .. } | Note::Coincident { .. } | Note::LostRows { .. }
                )
            };
            for note in piece.report.iter().filter(|note| k == 0 || is_own(note)) {
                progress.note(&format!("note: {}: {note}", path.display()));
            }
            let what = format!("{}: from {:.1} s", path.display(), piece.time[0]);
            progress.often(&what, done);
            Ok(piece)
        });
        let mend = |piece: Log| {
            if self.as_logged {
                return Ok((work(&piece)?, Vec::new()));
            }
            let Mended { log, faults } = piece.mended();
            Ok((work(&log)?, faults))
        };
        in_order(self.workers, pieces, mend, |(made, faults)| {
            take(made, faults);
            Ok(())
        })
    }

    /// Errors over all pieces.
    pub fn errors(&self, estimate: &Estimate, progress: &Progress) -> Result<Errors, Error> {
        let mut all = Vec::new();
        for path in self.logs {
            let errors = |log: &Log| Ok(self.form.errors(estimate, log)?);
            self.each(path, &estimate.bands, progress, errors, |errors, _| {
                all.push(errors);
            })?;
        }
        Ok(Errors::of_all(&all))
    }
}

#[cfg(test)]
mod tests {
    use std::fmt::Write;

    use robot_model::identify::Method;

    use super::*;

    /// A mass on a rail for six pieces and a half.
    fn log() -> String {
        let mut text = String::from("time,q1,tau1\n");
        for k in 0..PIECE * 13 / 2 {
            let t = 0.005 * k as f64;
            let (q, dq) = (1.3 * t).sin_cos();
            let wave = (7.1 * t).sin();
            let tau = -3.0 * (1.69 * q + 50.41 * 0.1 * wave) + 5.0 * dq + 0.1 * (k as f64).sin();
            writeln!(text, "{t:.3},{:.6},{tau:.6}", q + 0.1 * wave).expect("a string takes all");
        }
        text
    }

    #[test]
    fn factors_are_the_same_for_any_number_of_threads() {
        let spec = "robot Cart { gravity = [0, 0, -9.81]; convention = origin; \
            joint rail: prismatic { xyz = [0, 0, 0]; axis = [1, 0, 0]; link = cart; } effects { viscous_friction on rail; } }";
        let model = robot_model_spec::load("cart.robot", spec);
        let model = model.unwrap_or_else(|errors| panic!("{errors}"));
        let compiled = robot_model_codegen::compile_model(&model);
        let form = ByAcceleration(InterpretedArm::new(compiled));
        let folder = tempfile::tempdir().expect("a temporary folder");
        let logs = [folder.path().join("log.csv")];
        std::fs::write(&logs[0], log()).expect("a file in the folder");
        let of = |workers: usize| {
            let streams = Streams {
                form: &form,
                logs: &logs,
                settings: &LogSettings::default(),
                as_logged: false,
                workers,
            };
            let (identify, progress) = (Identify::default(), Progress::new());
            let mut faults = Vec::new();
            let factor = streams.reduce(&identify, &mut faults, &progress);
            let factor = factor.expect("a sound log");
            let estimate = factor
                .estimate(&form.0, Method::Wls, false)
                .expect("excited");
            let errors = streams.errors(&estimate, &progress).expect("a sound log");
            (text(&factor), errors)
        };
        let alone = of(1);
        assert!(
            alone.0.matches("\"samples\"").count() > 16,
            "pieces in blocks"
        );
        for workers in [2, 3, 16] {
            assert!(of(workers) == alone, "{workers} threads");
        }
    }
}

//! Logs that are read piece by piece into a factor.

use std::path::{Path, PathBuf};

use robot_model::identify::{Errors, Estimate, Factor, Identify};
use robot_model::log::{Fault, Log, Mended, Note};
use robot_model::signal::Bands;

use super::fit::Fit;
use crate::Error;
use crate::in_order::in_order;
use crate::log_settings::LogSettings;
use crate::progress::Progress;
use crate::spec::check_ends;

/// Rows of a log in memory at a time, half of them at least.
const PIECE: usize = 16_384;

/// Logs that are looked at piece by piece.
pub(super) struct Streams<'a> {
    pub form: &'a dyn Fit,
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
        let model = self.form.model();
        let effects = model.effects.iter();
        let mut remembers = effects.filter(|effect| !effect.definition.states.is_empty());
        if let Some(effect) = remembers.next() {
            return Err(Error::Argument(format!(
                "{}:{}: `{}` has a memory, which a log read piece by piece loses; identify without `--factor`",
                model.source, effect.line, effect.definition.name
            )));
        }
        for path in self.logs {
            check_ends(path)?;
        }
        let mut factor: Option<Factor> = None;
        for path in self.logs {
            let bands = match &factor {
                Some(factor) => factor.bands,
                None => self.bands(identify, progress)?,
            };
            let factor = match &mut factor {
                Some(factor) => factor,
                none => none.insert(self.form.factor(bands)?),
            };
            let blocks = |log: &Log| Ok(self.form.reduced(log, &bands)?);
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
        Ok(self.form.bands_of(identify, &slowest)?)
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
            let Mended { log, faults, .. } = piece.mended();
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

    use robot_model::identify::Form;

    use super::super::factor_file::text;
    use super::*;
    use crate::identify::fit::of_form;

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
        let folder = tempfile::tempdir().expect("a temporary folder");
        let logs = [folder.path().join("log.csv")];
        std::fs::write(&logs[0], log()).expect("a file in the folder");
        let of = |form: &dyn Fit, workers: usize| {
            let streams = Streams {
                form,
                logs: &logs,
                settings: &LogSettings::default(),
                as_logged: false,
                workers,
            };
            let (identify, progress) = (Identify::default(), Progress::new());
            let mut faults = Vec::new();
            let factor = streams.reduce(&identify, &mut faults, &progress);
            let factor = factor.expect("a sound log");
            let estimate = factor.estimate(form.arm(), &identify).expect("excited");
            let errors = streams.errors(&estimate, &progress).expect("a sound log");
            (text(&factor), errors)
        };
        for form in [Form::Acceleration, Form::Filtered { corner: 60.0 }] {
            let form = of_form(compiled.clone(), form).expect("no effect of the load");
            let alone = of(&*form, 1);
            assert!(
                alone.0.matches("\"samples\"").count() > 16,
                "pieces in blocks"
            );
            for workers in [2, 3, 16] {
                assert!(of(&*form, workers) == alone, "{workers} threads");
            }
        }
    }
}

//! Input files: specs to models, logs.

use std::fs::File;
use std::io::{self, Read as _};
use std::path::Path;

use robot_model::log::{Log, MOTION_PHASE, Mended};
use robot_model_codegen::base::RankStatus;
use robot_model_codegen::{Compiled, compile_model};
use robot_model_spec::Model;

use crate::log_settings::LogSettings;
use crate::misplaced::instead_of_a_spec;
use crate::parameters::no_body;
use crate::progress::Progress;
use crate::{Error, output};

/// Bytes of a text that is in memory as a whole. A motion of ten joints at 1 kHz has as many in ten minutes.
const LARGEST_TEXT: usize = 1 << 28;

/// Bytes of a spec. The largest arms that compile have a hundredth of this.
const LARGEST_SPEC: usize = 1 << 20;

/// Reads a text file.
pub(crate) fn read_text(path: &Path) -> Result<String, Error> {
    text_of(path, read_at_most(path, LARGEST_TEXT)?, LARGEST_TEXT)
}

/// Reads the text of a spec.
pub(crate) fn read_spec(path: &Path) -> Result<String, Error> {
    let bytes = read_at_most(path, LARGEST_SPEC)?;
    match instead_of_a_spec(path, &bytes) {
        Some(reason) => Err(Error::Read {
            path: path.to_owned(),
            reason,
        }),
        None => text_of(path, bytes, LARGEST_SPEC),
    }
}

/// Refuses what may never begin or never end: named pipes that nobody writes to, and devices. Pipes of a shell, as `<(zcat log.gz)` makes
/// them, have somebody who writes.
pub(crate) fn check_ends(path: &Path) -> Result<(), Error> {
    match endless(path) {
        Some(what) => Err(Error::Read {
            path: path.to_owned(),
            reason: format!("it is {what}; save its content to a file, and name that"),
        }),
        // What nobody may read is told in the same words whatever reads it.
        None if path.is_file() => match File::open(path) {
            Err(error) if error.kind() == io::ErrorKind::PermissionDenied => {
                Err(Error::read(path, &error))
            }
            _ => Ok(()),
        },
        None => Ok(()),
    }
}

#[cfg(unix)]
fn endless(path: &Path) -> Option<&'static str> {
    use std::os::unix::fs::FileTypeExt;
    let kind = std::fs::metadata(path).ok()?.file_type();
    let is_of_shell = path.starts_with("/dev") || path.starts_with("/proc");
    if kind.is_fifo() && !is_of_shell {
        Some("a named pipe, which may never be written to")
    } else if kind.is_char_device() || kind.is_block_device() {
        Some("a device, which may never end")
    } else {
        kind.is_socket().then_some("a socket")
    }
}

#[cfg(not(unix))]
fn endless(_: &Path) -> Option<&'static str> {
    None
}

/// The bytes of a file, and one more where there are more than the most.
fn read_at_most(path: &Path, most: usize) -> Result<Vec<u8>, Error> {
    check_ends(path)?;
    let failed = |error: &io::Error| Error::read(path, error);
    let mut bytes = Vec::new();
    File::open(path)
        .and_then(|file| file.take(most as u64 + 1).read_to_end(&mut bytes))
        .map_err(|error| failed(&error))?;
    Ok(bytes)
}

fn text_of(path: &Path, bytes: Vec<u8>, most: usize) -> Result<String, Error> {
    if bytes.len() > most {
        return Err(Error::Read {
            path: path.to_owned(),
            reason: format!("it has more than {most} bytes; name a smaller file"),
        });
    }
    String::from_utf8(bytes).map_err(|error| {
        let sound = error.utf8_error().valid_up_to();
        let line = String::from_utf8_lossy(&error.as_bytes()[..sound])
            .matches('\n')
            .count()
            + 1;
        Error::Read {
            path: path.to_owned(),
            reason: format!(
                "line {line} is not UTF-8 text; save the file as UTF-8, or name a text file"
            ),
        }
    })
}

/// Reads and checks a spec.
pub(crate) fn load(path: &Path) -> Result<Model, Error> {
    let text = read_spec(path)?;
    Ok(robot_model_spec::load(&path.display().to_string(), &text)?)
}

/// Reads, checks and compiles a spec whose base parameters are beyond doubt.
pub(crate) fn compile(path: &Path) -> Result<Compiled, Error> {
    clear(compile_model(&load(path)?))
}

/// As [`compile`], where equations have to say the whole torque.
pub(crate) fn compile_instantaneous(path: &Path) -> Result<Compiled, Error> {
    let compiled = compile(path)?;
    compiled
        .check_instantaneous()
        .map_err(|reason| Error::Argument(reason.to_string()))?;
    Ok(compiled)
}

/// Reads, checks and compiles a spec to be looked at: base parameters in doubt are told. Where there is no number there are
/// no equations to look at.
pub(crate) fn compile_to_look_at(path: &Path) -> Result<Compiled, Error> {
    let compiled = compile_model(&load(path)?);
    match &compiled.base.rank {
        RankStatus::Clear { .. } => {}
        RankStatus::Unclear(_) => output::say(&format!("warning: {}", doubt(&compiled))),
        RankStatus::NoNumber(_) => return Err(Error::Argument(doubt(&compiled))),
    }
    for link in compiled.model.chain().iter().flat_map(|chain| &chain.links) {
        if !link.inertial.is_possible() {
            output::say(&format!(
                "warning: {}: {}",
                compiled.model.source,
                no_body(&link.name)
            ));
        }
    }
    for remark in far_shapes(&compiled.model) {
        output::say(&format!("warning: {}:{remark}", compiled.model.source));
    }
    for remark in compiled.base.remarks(&compiled.standard) {
        output::say(&format!("warning: {}: {remark}", compiled.model.source));
    }
    Ok(compiled)
}

/// Values of shapes outside of the range in which the definition looks for them, each with its line: laws hold there, and few mechanisms do.
fn far_shapes(model: &Model) -> Vec<String> {
    let mut far = Vec::new();
    for effect in &model.effects {
        let definition = &effect.definition;
        for (shape, value) in definition.shapes.iter().zip(&effect.shapes) {
            let Some(value) = value.filter(|value| !(shape.low..=shape.high).contains(value))
            else {
                continue;
            };
            let said = format!(
                "{}: `{}` of effect `{}` is {value} in SI units, outside its search range {} .. {}; check its unit",
                effect.line, shape.name, definition.name, shape.low, shape.high
            );
            // A declaration on several joints is one line.
            if !far.contains(&said) {
                far.push(said);
            }
        }
    }
    far
}

/// The gate before everything that computes with base parameters.
pub(crate) fn clear(compiled: Compiled) -> Result<Compiled, Error> {
    if compiled.base.rank.is_clear() {
        Ok(compiled)
    } else {
        Err(Error::Argument(doubt(&compiled)))
    }
}

/// Why it is not clear which base parameters the arm has, with the numbers.
fn doubt(compiled: &Compiled) -> String {
    format!("{}: {}", compiled.model.source, compiled.base.rank)
}

/// Whether an effect of a robot is of a part of its motion's period.
fn reads_phase(model: &Model) -> bool {
    let mut effects = model.effects.iter();
    effects.any(|effect| {
        let mut inputs = effect.definition.inputs.iter();
        inputs.any(|input| input.name == MOTION_PHASE)
    })
}

/// Reads a log to identify from: without spikes, with holes where it stood still, and says what is wrong with it.
pub(crate) fn read_mended(
    path: &Path,
    model: &Model,
    settings: &LogSettings,
    progress: &Progress,
) -> Result<Mended, Error> {
    let log = read_log(path, model, settings, progress)?;
    let source = log.source.clone();
    let mended = log.mended();
    for fault in mended.faults.iter().filter(|fault| !fault.is_in_report()) {
        progress.note(&format!("note: {source}: {fault}"));
    }
    Ok(mended)
}

/// Reads a log of a robot, and says what is remarkable about it.
pub(crate) fn read_log(
    path: &Path,
    model: &Model,
    settings: &LogSettings,
    progress: &Progress,
) -> Result<Log, Error> {
    check_ends(path)?;
    let columns = settings.columns(path, model, progress)?;
    progress.step(&format!("reading {}", path.display()));
    let mut log = Log::read_as(path, &columns)?;
    if reads_phase(model) {
        log = log.with_motion_phase(None);
    }
    for note in &log.report {
        progress.note(&format!("note: {}: {note}", log.source));
    }
    Ok(log)
}

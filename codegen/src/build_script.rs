//! The `build.rs` route: a spec beside the crate in, `OUT_DIR/<spec>.rs` out.

use std::collections::BTreeMap;
use std::fmt;
use std::io::ErrorKind;
use std::path::{Path, PathBuf};
use std::sync::{Mutex, PoisonError};

use robot_model_spec::Diagnostics;

use crate::base::RankStatus;
use crate::compiled::compile_model;
use crate::emit;
use crate::measured::NotInstantaneous;

/// Why a spec was not compiled.
#[non_exhaustive]
pub enum CompileError {
    /// The spec was not read or the code was not written.
    Io(PathBuf, std::io::Error),
    /// Cargo sets this variable for build scripts; it is missing.
    NotInBuildScript(&'static str),
    /// The path names no file, so the generated file would have no name.
    NoFileName(PathBuf),
    /// Two specs of one build script have the same name, and so would their generated files.
    SameName(PathBuf, PathBuf),
    /// The spec has mistakes.
    Spec(Box<Diagnostics>),
    /// The base parameters could not be decided.
    Rank(String, RankStatus),
    /// No equation says the whole torque.
    NotInstantaneous(NotInstantaneous),
}

impl fmt::Display for CompileError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Io(path, error) => {
                let help = match error.kind() {
                    ErrorKind::NotFound => {
                        "; the path in `compile(..)` is relative to the folder of Cargo.toml"
                    }
                    ErrorKind::InvalidData => "; it is no text in UTF-8: save it as such",
                    _ => "",
                };
                write!(f, "cannot use `{}`: {error}{help}", path.display())
            }
            Self::NotInBuildScript(variable) => {
                write!(
                    f,
                    "`{variable}` is not set: `compile` is for build scripts; call `emit::rust::module` elsewhere"
                )
            }
            Self::SameName(first, second) => write!(
                f,
                "`{}` and `{}` would both be `{}.rs`: rename one of them",
                first.display(),
                second.display(),
                second.file_stem().unwrap_or_default().display()
            ),
            Self::NoFileName(path) => write!(f, "`{}` names no file", path.display()),
            Self::Spec(diagnostics) => write!(f, "{diagnostics}"),
            Self::NotInstantaneous(reason) => write!(f, "{reason}"),
            Self::Rank(source, status) => write!(f, "{source}: {status}"),
        }
    }
}

/// A build script's `unwrap` prints this: the message, not the enum.
impl fmt::Debug for CompileError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "\n{self}")
    }
}

impl std::error::Error for CompileError {}

/// Compiles a spec in a build script. `spec` is relative to the crate's folder; `robot_model::include_robot!` takes its
/// name without folder and extension.
///
/// # Errors
/// A file that cannot be read or written, mistakes in the spec, base parameters that are not certain.
pub fn compile(spec: impl AsRef<Path>) -> Result<(), CompileError> {
    let variable =
        |name: &'static str| std::env::var_os(name).ok_or(CompileError::NotInBuildScript(name));
    let (root, out) = (variable("CARGO_MANIFEST_DIR")?, variable("OUT_DIR")?);
    let spec = spec.as_ref();
    let path = Path::new(&root).join(spec);
    announce(&path);
    let stem = spec
        .file_stem()
        .ok_or_else(|| CompileError::NoFileName(spec.to_owned()))?;
    let mut file = stem.to_owned();
    file.push(".rs");
    let target = Path::new(&out).join(file);

    claim(spec, &target)?;

    let text = std::fs::read_to_string(&path).map_err(|error| CompileError::Io(path, error))?;
    let page = compile_text(&spec.to_string_lossy(), &text)?;
    std::fs::write(&target, page).map_err(|error| CompileError::Io(target, error))
}

/// Each generated file is that of one spec.
fn claim(spec: &Path, target: &Path) -> Result<(), CompileError> {
    static WRITTEN: Mutex<BTreeMap<PathBuf, PathBuf>> = Mutex::new(BTreeMap::new());
    let mut written = WRITTEN.lock().unwrap_or_else(PoisonError::into_inner);
    let first = written
        .entry(target.to_owned())
        .or_insert_with(|| spec.to_owned());
    if first == spec {
        Ok(())
    } else {
        Err(CompileError::SameName(first.clone(), spec.to_owned()))
    }
}

/// A spec's text to a page of Rust.
///
/// # Errors
/// Mistakes in the spec, base parameters that are not certain.
pub fn compile_text(source_name: &str, text: &str) -> Result<String, CompileError> {
    let model = robot_model_spec::load(source_name, text)
        .map_err(|errors| CompileError::Spec(Box::new(errors)))?;
    let compiled = compile_model(&model);
    compiled
        .check_instantaneous()
        .map_err(CompileError::NotInstantaneous)?;
    if compiled.base.rank.is_clear() {
        Ok(emit::rust::module(&compiled))
    } else {
        let rank = compiled.base.rank;
        Err(CompileError::Rank(source_name.to_owned(), rank))
    }
}

#[expect(
    clippy::print_stdout,
    reason = "standard output is how a build script speaks to Cargo"
)]
fn announce(path: &Path) {
    println!("cargo:rerun-if-changed={}", path.display());
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use super::claim;

    #[test]
    fn two_specs_of_one_name_are_told() {
        let target = Path::new("out/of/this/test.rs");
        let of = |spec: &str| claim(Path::new(spec), target).map_err(|error| error.to_string());
        assert_eq!(of("a/test.robot"), Ok(()));
        assert_eq!(of("a/test.robot"), Ok(()), "the same spec again");
        let said = "`a/test.robot` and `b/test.robot` would both be `test.rs`: rename one of them";
        assert_eq!(of("b/test.robot"), Err(said.to_owned()));
    }
}

//! The `build.rs` route: a spec beside the crate in, and a file of parameters where its numbers go into the equations, `OUT_DIR/<spec>.rs` out.

use std::collections::BTreeMap;
use std::fmt;
use std::io::ErrorKind;
use std::path::{Path, PathBuf};
use std::sync::{Mutex, PoisonError};

use robot_model_spec::Diagnostics;

#[cfg(feature = "parameters")]
use crate::baked::Origin;
use crate::base::RankStatus;
use crate::compiled::{Compiled, compile_model};
use crate::emit;
use crate::measured::NotInstantaneous;
#[cfg(feature = "parameters")]
use crate::parameters::{self, json};

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
    /// A file of parameters is not one of this arm: the file, line and column where it is not JSON, and what is wrong.
    Parameters(PathBuf, Option<(usize, usize)>, String),
    /// One build script gives a spec several sets of numbers, and so would its generated file have.
    SameArm(PathBuf),
}

impl fmt::Display for CompileError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Io(path, error) => {
                let help = match error.kind() {
                    ErrorKind::NotFound => {
                        "; paths in a build script are relative to the folder of Cargo.toml"
                    }
                    ErrorKind::InvalidData => "; it is not UTF-8 text: save it as UTF-8",
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
            Self::NoFileName(path) => write!(f, "`{}` does not name a file", path.display()),
            Self::Spec(diagnostics) => write!(f, "{diagnostics}"),
            Self::NotInstantaneous(reason) => write!(f, "{reason}"),
            Self::Rank(source, status) => write!(f, "{source}: {status}"),
            Self::Parameters(path, place, reason) => {
                write!(f, "{}", path.display())?;
                if let Some((line, column)) = place {
                    write!(f, ":{line}:{column}")?;
                }
                write!(f, ": {reason}")
            }
            Self::SameArm(spec) => write!(
                f,
                "`{}` is compiled more than once, with different parameters: give each arm its own spec file",
                spec.display()
            ),
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
    let script = Script::new(spec.as_ref(), None)?;
    let page = compile_text(&script.name, &script.text)?;
    script.write(&page)
}

/// The same with the numbers of one arm in its equations, in place of arguments. `parameters`, relative to the crate's folder, too, is a file
/// of names and values in JSON, or what `robot-model identify --json` writes: what `robot-model emit --parameters` takes. Values that it
/// does not have are those of the spec. The type in the page is of no size.
///
/// # Errors
/// Those of [`compile`]; parameters without a value, names that no parameter has, numbers that the spec contradicts.
#[cfg(feature = "parameters")]
pub fn compile_with(
    spec: impl AsRef<Path>,
    parameters: impl AsRef<Path>,
) -> Result<(), CompileError> {
    let (spec, parameters) = (spec.as_ref(), parameters.as_ref());
    let script = Script::new(spec, Some(parameters))?;
    let path = script.root.join(parameters);
    announce(&path);
    let text = std::fs::read_to_string(&path).map_err(|error| CompileError::Io(path, error))?;
    let name = parameters.to_string_lossy();
    let (page, doubts) = compile_text_with(&script.name, &script.text, &name, &text)?;
    for doubt in doubts {
        warn(&format!("{name}: {doubt}"));
    }
    script.write(&page)
}

/// What a build script compiles, and where to.
struct Script {
    #[cfg(feature = "parameters")]
    root: PathBuf,
    target: PathBuf,
    /// The spec as it was given, and its text.
    name: String,
    text: String,
}

impl Script {
    fn new(spec: &Path, parameters: Option<&Path>) -> Result<Self, CompileError> {
        let variable =
            |name: &'static str| std::env::var_os(name).ok_or(CompileError::NotInBuildScript(name));
        let (root, out) = (variable("CARGO_MANIFEST_DIR")?, variable("OUT_DIR")?);
        let root = PathBuf::from(root);
        let path = root.join(spec);
        announce(&path);
        let stem = spec
            .file_stem()
            .ok_or_else(|| CompileError::NoFileName(spec.to_owned()))?;
        let mut file = stem.to_owned();
        file.push(".rs");
        let target = Path::new(&out).join(file);
        claim(spec, parameters, &target)?;
        let text = std::fs::read_to_string(&path).map_err(|error| CompileError::Io(path, error))?;
        Ok(Self {
            #[cfg(feature = "parameters")]
            root,
            target,
            name: spec.to_string_lossy().into_owned(),
            text,
        })
    }

    fn write(self, page: &str) -> Result<(), CompileError> {
        let target = self.target;
        std::fs::write(&target, page).map_err(|error| CompileError::Io(target, error))
    }
}

/// Each generated file is that of one spec, with one set of numbers or none.
fn claim(spec: &Path, parameters: Option<&Path>, target: &Path) -> Result<(), CompileError> {
    type Arm = (PathBuf, Option<PathBuf>);
    static WRITTEN: Mutex<BTreeMap<PathBuf, Arm>> = Mutex::new(BTreeMap::new());
    let arm = (spec.to_owned(), parameters.map(Path::to_owned));
    let mut written = WRITTEN.lock().unwrap_or_else(PoisonError::into_inner);
    let first = written
        .entry(target.to_owned())
        .or_insert_with(|| arm.clone());
    if *first == arm {
        Ok(())
    } else if first.0 == spec {
        Err(CompileError::SameArm(arm.0))
    } else {
        Err(CompileError::SameName(first.0.clone(), arm.0))
    }
}

/// A spec's text to a page of Rust.
///
/// # Errors
/// Mistakes in the spec, base parameters that are not certain.
pub fn compile_text(source_name: &str, text: &str) -> Result<String, CompileError> {
    Ok(emit::rust::module(&compiled(source_name, text)?))
}

/// The same with numbers of the text of a file of parameters; and sentences about what no arm has among them.
///
/// # Errors
/// Those of [`compile_with`], but for files.
#[cfg(feature = "parameters")]
pub fn compile_text_with(
    source_name: &str,
    text: &str,
    file: &str,
    parameters: &str,
) -> Result<(String, Vec<String>), CompileError> {
    let refused = |place, reason: String| CompileError::Parameters(file.into(), place, reason);
    let said = |reason: String| refused(None, reason);
    let compiled = compiled(source_name, text)?;
    let value = json::parse(parameters).map_err(|fault| refused(fault.line, fault.reason))?;
    let given = parameters::file::read(&value, &compiled.shape_names());
    let given = given.map_err(|error| {
        let name = error.name.as_deref();
        let place = name.and_then(|name| json::place_of(parameters, name));
        refused(place, error.reason)
    })?;
    let found = parameters::values(&compiled, &given);
    let (values, doubts) = found.map_err(|error| said(error.to_string()))?;
    let baked = compiled.baked(&values.beta, &values.shapes);
    let mut arm = baked.map_err(|error| said(error.to_string()))?;
    arm.origin = Some(Origin {
        file: file.to_owned(),
        given: values.given,
        from_spec: values.from_spec.len(),
    });
    Ok((emit::rust::module(&arm), doubts))
}

/// What code is written of.
fn compiled(source_name: &str, text: &str) -> Result<Compiled, CompileError> {
    let model = robot_model_spec::load(source_name, text)
        .map_err(|errors| CompileError::Spec(Box::new(errors)))?;
    let compiled = compile_model(&model);
    compiled
        .check_instantaneous()
        .map_err(CompileError::NotInstantaneous)?;
    if compiled.base.rank.is_clear() {
        Ok(compiled)
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

/// Says something that Cargo shows.
#[cfg(feature = "parameters")]
#[expect(
    clippy::print_stdout,
    reason = "standard output is how a build script speaks to Cargo"
)]
fn warn(what: &str) {
    println!("cargo:warning={what}");
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use super::claim;

    #[test]
    fn two_specs_of_one_name_are_told() {
        let target = Path::new("out/of/this/test.rs");
        let of =
            |spec: &str| claim(Path::new(spec), None, target).map_err(|error| error.to_string());
        assert_eq!(of("a/test.robot"), Ok(()));
        assert_eq!(of("a/test.robot"), Ok(()), "the same spec again");
        let said = "`a/test.robot` and `b/test.robot` would both be `test.rs`: rename one of them";
        assert_eq!(of("b/test.robot"), Err(said.to_owned()));
        let with = claim(
            Path::new("a/test.robot"),
            Some(Path::new("fit.json")),
            target,
        );
        let said = with.expect_err("no numbers before").to_string();
        assert!(
            said.starts_with("`a/test.robot` is compiled more than once"),
            "{said}"
        );
    }

    #[cfg(feature = "parameters")]
    const ARM: &str = "robot Arm { gravity = [0, -9.81, 0]; convention = standard_dh; \
        joint up: revolute { a = 0.5; alpha = 0; d = 0; } effects { viscous_friction on up; } }";

    #[cfg(feature = "parameters")]
    #[test]
    fn numbers_of_a_file_are_constants_of_the_page() {
        let page = |file: &str| super::compile_text_with("arm.robot", ARM, "fit.json", file);
        let plain = r#"{"up.m": 4, "up.mx": -0.9, "up.my": 0, "up.izz": 0.28125, "up.viscous_friction.fv": 1.0625}"#;
        let (with, doubts) = page(plain).expect("an arm");
        assert_eq!(doubts, [""; 0]);
        assert!(with.contains("S::of(1.0625)"), "{with}");
        assert!(!with.contains("beta: &"), "{with}");
        assert!(with.contains("fit.json"), "{with}");
        let without = super::compile_text("arm.robot", ARM).expect("an arm");
        assert!(without.contains("beta: &"), "{without}");
        // The base parameters of that arm, as `identify` writes them.
        let model = robot_model_spec::load("arm.robot", ARM).expect("a spec");
        let names = crate::compile_model(&model).base.names;
        let one = |name: &String| format!(r#"{{"name": "{name}", "value": 1.0625, "std": 0.1}}"#);
        let list: Vec<String> = names.iter().map(one).collect();
        let fit = format!(r#"{{"parameters": [{}]}}"#, list.join(", "));
        let (with, _) = page(&fit).expect("an arm");
        assert!(with.contains("S::of(1.0625)"), "{with}");
    }

    #[cfg(feature = "parameters")]
    #[test]
    fn a_file_of_another_arm_is_told_with_its_parameter() {
        let said = |file: &str| {
            let page = super::compile_text_with("arm.robot", ARM, "fit.json", file);
            page.expect_err("no arm").to_string()
        };
        let rest = r#""up.m": 4, "up.mx": -0.9, "up.my": 0, "up.izz": 0.28"#;
        assert_eq!(
            said(&format!("{{{rest}}}")),
            "fit.json: no value for `up.viscous_friction.fv`; give it in a file of parameters: {\"up.viscous_friction.fv\": ..}"
        );
        assert_eq!(
            said(&format!(r#"{{{rest}, "up.viscous_friction.f": 1}}"#)),
            "fit.json: Arm has no parameter `up.viscous_friction.f`; is `up.viscous_friction.fv` meant?"
        );
        assert_eq!(
            said("{\"up.m\": 4,}"),
            "fit.json:1:12: it is not JSON: trailing comma; repair it here"
        );
        assert!(said("[]").starts_with("fit.json: it is a list: write "));
        let text = said("{\n \"up.m\": \"four\"}");
        assert!(text.starts_with("fit.json:2:2: `up.m` is text"), "{text}");
    }
}

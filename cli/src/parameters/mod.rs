//! Parameter files and the values that a spec holds itself; what they are is codegen's, for build scripts read them, too.

mod beside;
mod over;

use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

use robot_model_codegen::Compiled;
use robot_model_codegen::parameters::file::{self, FileError};
use robot_model_codegen::parameters::{self, ValuesError};

use crate::output::{self, counted, names};
use crate::{Error, json};

pub(crate) use beside::{Beside, beside};
pub(crate) use over::over;
pub(crate) use robot_model_codegen::parameters::{Known, Values, no_body};

/// Values from a file, and from the spec where the file has none or there is no file. What is remarkable about those of a file
/// is told.
pub(crate) fn resolve(compiled: &Compiled, file: Option<&Path>) -> Result<Values, Error> {
    let (values, doubts, source) = values(compiled, file)?;
    if file.is_some() {
        for doubt in doubts {
            output::say(&format!("warning: {source}: {doubt}"));
        }
        let from_spec: Vec<&str> = values.from_spec.iter().map(String::as_str).collect();
        if !from_spec.is_empty() {
            output::say(&format!(
                "note: {source}: no value for {}: the spec's value is used for {}",
                counted(from_spec.len(), "parameter"),
                names(&from_spec)
            ));
        }
    }
    Ok(values)
}

/// The values of a file by their names.
fn read(compiled: &Compiled, path: &Path) -> Result<BTreeMap<String, f64>, Error> {
    let values = file::read(&json::read(path)?, &compiled.shape_names());
    values.map_err(|error| of_file(path, error))
}

/// An error of a file's form, with the line of the parameter that is at fault.
fn of_file(path: &Path, error: FileError) -> Error {
    let name = error.name.as_deref();
    Error::Json {
        path: path.to_owned(),
        line: name.and_then(|name| json::place_of(path, name)),
        reason: error.reason,
    }
}

/// The values of a file by their names, none where there is no file; and what errors call the source.
fn given(
    compiled: &Compiled,
    file: Option<&Path>,
) -> Result<(BTreeMap<String, f64>, String), Error> {
    Ok(match file {
        Some(path) => (read(compiled, path)?, path.display().to_string()),
        None => (BTreeMap::new(), compiled.model.source.clone()),
    })
}

/// The same, with sentences about what no arm has, and the name of the source; nothing is told.
pub(crate) fn values(
    compiled: &Compiled,
    file: Option<&Path>,
) -> Result<(Values, Vec<String>, String), Error> {
    let (given, source) = given(compiled, file)?;
    let found = parameters::values(compiled, &given);
    let (values, doubts) = found.map_err(|error| refused(&source, file, &error))?;
    Ok((values, doubts, source))
}

/// What a file of `identify` says of how sure its values are, by name: standard deviations, and what no log told.
#[derive(Default)]
pub(crate) struct Sureness {
    pub(crate) deviations: BTreeMap<String, f64>,
    pub(crate) untold: BTreeSet<String>,
}

/// How sure the values of a file are, as far as it says so.
pub(crate) fn sureness(path: &Path) -> Result<Sureness, Error> {
    let file = json::read(path)?;
    Ok(Sureness {
        deviations: file::deviations(&file),
        untold: file::untold(&file),
    })
}

/// Standard deviations that a file of `identify` has for base parameters, in their order; none each where it has none.
pub(crate) fn deviations(compiled: &Compiled, path: &Path) -> Result<Vec<Option<f64>>, Error> {
    let found = file::deviations(&json::read(path)?);
    let names = compiled.base.names.iter();
    Ok(names.map(|name| found.get(name).copied()).collect())
}

/// Values by name, and from the spec where none is given.
pub(crate) fn by_name(compiled: &Compiled, given: &BTreeMap<String, f64>) -> Result<Values, Error> {
    let found = parameters::values(compiled, given).map(|(values, _)| values);
    found.map_err(|error| refused(&compiled.model.source, None, &error))
}

/// What is known from a file, `more` by name and the spec.
pub(crate) fn known(
    compiled: &Compiled,
    file: Option<&Path>,
    more: &[(String, f64)],
) -> Result<Known, Error> {
    let (mut given, source) = given(compiled, file)?;
    if let Err(error @ ValuesError::Unknown { .. }) = parameters::known(compiled, &given) {
        return Err(refused(&source, file, &error));
    }
    given.extend(more.iter().cloned());
    let values = parameters::known(compiled, &given);
    values.map_err(|error| match &error {
        // The file's own names are known.
        ValuesError::Unknown { .. } => refused(&compiled.model.source, None, &error),
        _ => Error::Argument(format!("{source}: {error}")),
    })
}

/// Why values of a source are not those of an arm, with the place in the file or with the arguments that take some.
fn refused(source: &str, file: Option<&Path>, error: &ValuesError) -> Error {
    if let (Some(path), ValuesError::Unknown { names, reason }) = (file, error) {
        let first = names.iter().filter_map(|name| json::place_of(path, name));
        return Error::Json {
            path: path.to_owned(),
            line: first.min(),
            reason: reason.clone(),
        };
    }
    let reason = error.to_string();
    let reason = match error {
        ValuesError::NoValue(_) => reason.replacen(
            "a file of parameters",
            "a file of parameters (`--parameters`; of `identify` it is `--start`)",
            1,
        ),
        _ => reason,
    };
    Error::Argument(format!("{source}: {reason}"))
}

#[cfg(test)]
mod tests {
    use super::*;

    const CART: &str = "robot Cart {
        gravity = [0, 0, -9.81];
        convention = origin;
        joint rail: prismatic { xyz = [0, 0, 0]; axis = [1, 0, 0]; link = cart; }
        effects { viscous_friction on rail; }
    }";

    #[test]
    fn what_is_no_number_has_its_line() {
        let model = robot_model_spec::load("cart.robot", CART).expect("a spec");
        let compiled = robot_model_codegen::compile_model(&model);
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("fit.json");
        for (text, place) in [
            ("{\n \"cart.m\": \"two\"}", Some((2, 2))),
            ("{\"cart.m\": null}", Some((1, 2))),
            (
                "{\"parameters\": [\n{\"name\": \"cart.m\"}]}",
                Some((2, 10)),
            ),
            (
                "{\"parameters\": [{\"name\": \"cart.m\", \"value\": []}]}",
                Some((1, 26)),
            ),
            ("[1]", None),
        ] {
            std::fs::write(&path, text).expect("a file");
            let Err(Error::Json { line, reason, .. }) = read(&compiled, &path) else {
                panic!("{text}");
            };
            assert_eq!(line, place, "{text}: {reason}");
        }
    }

    #[test]
    fn unknown_names_are_of_the_file_or_of_who_asks() {
        let model = robot_model_spec::load("cart.robot", CART).expect("a spec");
        let compiled = robot_model_codegen::compile_model(&model);
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("fit.json");
        let said = |text: &str| {
            std::fs::write(&path, text).expect("a file");
            let more = [("cart.nonsense".to_owned(), 1.0)];
            let known = known(&compiled, Some(&path), &more);
            let Err(error) = known else {
                panic!("an unknown name");
            };
            error.to_string()
        };
        let of_more = said("{\"cart.m\": 2}");
        assert!(
            of_more.starts_with("cart.robot: Cart has no parameter `cart.nonsense`"),
            "{of_more}"
        );
        let of_file = said("{\n\"cart.mass\": 2}");
        assert!(of_file.contains("fit.json:2:"), "{of_file}");
        assert!(!of_file.contains("nonsense"), "{of_file}");
    }
}

//! The two forms of a parameter file: names and values, and what `identify --json` writes.

use std::collections::{BTreeMap, BTreeSet};
use std::fmt;

use serde_json::{Map, Value};

use super::{json, names};

/// How a file is written.
const FORMS: &str =
    "write `{\"NAME\": VALUE, ..}` or `{\"parameters\": [{\"name\": .., \"value\": ..}, ..]}`";

/// Why a file has no values of an arm.
#[derive(Debug, Clone, PartialEq, Eq)]
#[non_exhaustive]
pub struct FileError {
    /// The parameter that is at fault, where one is.
    pub name: Option<String>,
    /// What is wrong, and what to write.
    pub reason: String,
}

impl FileError {
    fn of_all(reason: impl Into<String>) -> Self {
        Self {
            name: None,
            reason: reason.into(),
        }
    }

    fn of(name: &str, reason: String) -> Self {
        Self {
            name: Some(name.to_owned()),
            reason,
        }
    }
}

impl fmt::Display for FileError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.reason)
    }
}

impl std::error::Error for FileError {}

/// The values of a file: every one is a finite number. `shapes` are names of parameters that are in no sum with others.
///
/// # Errors
/// What is written otherwise; values that the logs of an identification did not tell.
pub fn read(file: &Value, shapes: &[String]) -> Result<BTreeMap<String, f64>, FileError> {
    match file {
        Value::Object(entries) => match entries.get("parameters") {
            Some(Value::Array(list)) => match possible(entries, list) {
                Some(standard) => of_possible(standard, list, shapes),
                None => identified(list, entries.get("unexcited")),
            },
            _ => plain(entries),
        },
        other => {
            let kind = json::kind(other);
            Err(FileError::of_all(format!("it is {kind}: {FORMS}")))
        }
    }
}

/// The standard parameters of the arm that a file of `identify` holds beside its base parameters, where it holds one.
///
/// # Errors
/// What is written otherwise.
pub fn beside(file: &Value) -> Result<Option<BTreeMap<String, f64>>, FileError> {
    let Some(standard) = file["possible"]["standard"].as_array() else {
        return Ok(None);
    };
    identified(standard, None).map(Some)
}

/// Standard deviations by name, as far as a file of `identify` has some.
#[must_use]
pub fn deviations(file: &Value) -> BTreeMap<String, f64> {
    let list = file["parameters"].as_array().into_iter().flatten();
    let known = list.filter_map(|entry| {
        let std = entry["std"].as_f64().filter(|std| *std > 0.0)?;
        Some((entry["name"].as_str()?.to_owned(), std))
    });
    known.collect()
}

/// Parameters for which a file of `identify` says that no log told them: their deviations are null.
#[must_use]
pub fn untold(file: &Value) -> BTreeSet<String> {
    let list = file["parameters"].as_array().into_iter().flatten();
    let untold = list.filter(|entry| entry.get("std").is_some_and(Value::is_null));
    let names = untold.filter_map(|entry| Some(entry["name"].as_str()?.to_owned()));
    names.collect()
}

fn plain(entries: &Map<String, Value>) -> Result<BTreeMap<String, f64>, FileError> {
    if entries.contains_key("outcome") && entries.contains_key("effects") {
        return Err(FileError::of_all(
            "this is what `trace --json` writes; the numbers of the amended spec are those of `identify --json`",
        ));
    }
    let entries = entries.iter();
    entries
        .map(|(name, value)| match value.as_f64() {
            Some(value) => Ok((name.clone(), value)),
            None if value.is_null() => Err(FileError::of(
                name,
                format!("`{name}` is null; write its value, or remove it if the spec has one"),
            )),
            None => {
                let kind = json::kind(value);
                let reason = format!("`{name}` is {kind}, but must be a number: {FORMS}");
                Err(FileError::of(name, reason))
            }
        })
        .collect()
}

/// The standard parameters of a possible arm, where the logs did not tell all base parameters apart.
fn possible<'a>(entries: &'a Map<String, Value>, list: &[Value]) -> Option<&'a Vec<Value>> {
    let is_untold = list.iter().any(|entry| entry["value"].is_null());
    let standard = entries.get("possible")?.get("standard")?.as_array();
    standard.filter(|_| is_untold)
}

/// All values of a possible arm, and those of the shapes beside them.
fn of_possible(
    standard: &[Value],
    list: &[Value],
    shapes: &[String],
) -> Result<BTreeMap<String, f64>, FileError> {
    let is_shape = |entry: &&Value| {
        let name = entry["name"].as_str();
        name.is_some_and(|name| shapes.iter().any(|shape| shape == name))
    };
    let shapes: Vec<Value> = list.iter().filter(is_shape).cloned().collect();
    let mut values = identified(standard, None)?;
    values.extend(identified(&shapes, None)?);
    Ok(values)
}

/// All values, where every one of them was measured: a zero in place of one that was not is wrong on every other motion.
fn identified(
    list: &[Value],
    unexcited: Option<&Value>,
) -> Result<BTreeMap<String, f64>, FileError> {
    let mut values = BTreeMap::new();
    let mut without: Vec<&str> = match unexcited {
        None => Vec::new(),
        Some(names) => names
            .as_array()
            .and_then(|names| names.iter().map(Value::as_str).collect())
            .ok_or_else(|| {
                FileError::of(
                    "unexcited",
                    "`unexcited` must be a list of names".to_owned(),
                )
            })?,
    };
    for (k, entry) in list.iter().enumerate() {
        let Some(name) = entry.get("name").and_then(Value::as_str) else {
            return Err(FileError::of_all(format!(
                "entry {} of `parameters` has no text `name`: {FORMS}",
                k + 1
            )));
        };
        let value = match entry.get("value") {
            None => {
                let reason = format!("`{name}` has no `value`: {FORMS}");
                return Err(FileError::of(name, reason));
            }
            Some(Value::Null) => {
                if !without.contains(&name) {
                    without.push(name);
                }
                0.0
            }
            Some(value) => value.as_f64().ok_or_else(|| {
                let kind = json::kind(value);
                let reason = format!("the `value` of `{name}` is {kind}, but must be a number");
                FileError::of(name, reason)
            })?,
        };
        if values.insert(name.to_owned(), value).is_some() {
            let reason = format!("parameter `{name}` appears more than once; keep the right value");
            return Err(FileError::of(name, reason));
        }
    }
    if without.is_empty() {
        return Ok(values);
    }
    Err(FileError::of_all(format!(
        "the logs did not separate {} from other parameters, so the file has no value valid for other motions; identify from logs that \
         excite the joints concerned, or give values in your own file",
        names(&without)
    )))
}

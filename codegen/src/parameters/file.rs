//! The two forms of a parameter file: names and values, and what `identify --json` writes.

use std::collections::{BTreeMap, BTreeSet};

use serde_json::{Map, Value};

use super::{json, names};

/// How a file is written.
const FORMS: &str =
    "write `{\"NAME\": VALUE, ..}` or `{\"parameters\": [{\"name\": .., \"value\": ..}, ..]}`";

/// The values of a file: every one is a finite number. `shapes` are names of parameters that are in no sum with others.
///
/// # Errors
/// What is written otherwise; values that the logs of an identification did not tell.
pub fn read(file: &Value, shapes: &[String]) -> Result<BTreeMap<String, f64>, String> {
    match file {
        Value::Object(entries) => match entries.get("parameters") {
            Some(Value::Array(list)) => match possible(entries, list) {
                Some(standard) => of_possible(standard, list, shapes),
                None => identified(list, entries.get("unexcited")),
            },
            _ => plain(entries),
        },
        other => Err(format!("it is {}: {FORMS}", json::kind(other))),
    }
}

/// The standard parameters of the arm that a file of `identify` holds beside its base parameters, where it holds one.
///
/// # Errors
/// What is written otherwise.
pub fn beside(file: &Value) -> Result<Option<BTreeMap<String, f64>>, String> {
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

fn plain(entries: &Map<String, Value>) -> Result<BTreeMap<String, f64>, String> {
    if entries.contains_key("outcome") && entries.contains_key("effects") {
        return Err(
            "this is what `trace --json` writes; the numbers of the amended spec are those of `identify --json`".to_owned(),
        );
    }
    let entries = entries.iter();
    entries
        .map(|(name, value)| match value.as_f64() {
            Some(value) => Ok((name.clone(), value)),
            None if value.is_null() => Err(format!(
                "`{name}` is null; write its value, or remove it if the spec has one"
            )),
            None => Err(format!(
                "`{name}` is {}, but must be a number: {FORMS}",
                json::kind(value)
            )),
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
) -> Result<BTreeMap<String, f64>, String> {
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
fn identified(list: &[Value], unexcited: Option<&Value>) -> Result<BTreeMap<String, f64>, String> {
    let mut values = BTreeMap::new();
    let mut without: Vec<&str> = match unexcited {
        None => Vec::new(),
        Some(names) => names
            .as_array()
            .and_then(|names| names.iter().map(Value::as_str).collect())
            .ok_or("`unexcited` must be a list of names")?,
    };
    for (k, entry) in list.iter().enumerate() {
        let Some(name) = entry.get("name").and_then(Value::as_str) else {
            return Err(format!(
                "entry {} of `parameters` has no text `name`: {FORMS}",
                k + 1
            ));
        };
        let value = match entry.get("value") {
            None => return Err(format!("`{name}` has no `value`: {FORMS}")),
            Some(Value::Null) => {
                if !without.contains(&name) {
                    without.push(name);
                }
                0.0
            }
            Some(value) => value.as_f64().ok_or_else(|| {
                let kind = json::kind(value);
                format!("the `value` of `{name}` is {kind}, but must be a number")
            })?,
        };
        if values.insert(name.to_owned(), value).is_some() {
            return Err(format!(
                "parameter `{name}` appears more than once; keep the right value"
            ));
        }
    }
    if without.is_empty() {
        return Ok(values);
    }
    Err(format!(
        "the logs did not separate {} from other parameters, so the file has no value valid for other motions; identify from logs that \
         excite the joints concerned, or give values in your own file",
        names(&without)
    ))
}

//! States of a file, read and checked.

use std::collections::BTreeMap;
use std::path::Path;

use robot_model_codegen::Compiled;
use robot_model_codegen::expr::Symbol;
use serde::Deserialize;

use crate::output::counted;
use crate::{Error, json, output};

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct States {
    /// Each is read on its own, so that a mistake has its number.
    states: Vec<serde_json::Value>,
}

/// A state at which the equations have values.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct State {
    pub q: Vec<f64>,
    pub dq: Vec<f64>,
    pub ddq: Vec<f64>,
    /// For effects that depend on it, s.
    #[serde(default)]
    pub time: f64,
    /// For effects that read it, N m or N.
    #[serde(default)]
    pub measured_torque: Vec<f64>,
    /// Columns of the log that effects read, by name.
    #[serde(default)]
    pub inputs: BTreeMap<String, f64>,
    /// Internal states of effects, `JOINT.EFFECT.STATE`; 0 where none is given.
    #[serde(default)]
    pub states: BTreeMap<String, f64>,
}

/// Reads the states of a file, each with as much as the arm's joints and effects take.
pub(super) fn read(path: &Path, compiled: &Compiled) -> Result<Vec<State>, Error> {
    const FORM: &str = "write `{\"states\": [{\"q\": [..], \"dq\": [..], \"ddq\": [..]}, ..]}`";
    let dof = compiled.dof();
    let columns = compiled.regressor();
    let reads_torque = columns
        .program
        .symbols()
        .iter()
        .any(|symbol| matches!(symbol, Symbol::MeasuredTorque(_)));
    let written = json::read(path)?;
    if written.is_array() {
        let reason = "the list of states needs its name: write `{\"states\": [..]}`";
        return Err(Error::json(path, &reason));
    }
    let States { states } = json::typed(path, written, FORM)?;
    let states = states
        .into_iter()
        .enumerate()
        .map(|(k, state)| {
            let read = serde_path_to_error::deserialize::<_, State>(state);
            read.map_err(|error| {
                let reason = format!("state {}: {error}; {FORM}", k + 1);
                Error::json(path, &reason)
            })
        })
        .collect::<Result<Vec<State>, Error>>()?;
    for (k, state) in states.iter().enumerate() {
        for (name, values) in [("q", &state.q), ("dq", &state.dq), ("ddq", &state.ddq)] {
            if values.len() != dof {
                let reason = format!(
                    "state {}: `{name}` has {}, the arm has {}",
                    k + 1,
                    counted(values.len(), "value"),
                    counted(dof, "joint")
                );
                return Err(Error::json(path, &reason));
            }
        }
        let fault = if reads_torque && state.measured_torque.len() != dof {
            Some(format!(
                "`measured_torque` has {}, but a declared effect reads that of {}",
                counted(state.measured_torque.len(), "value"),
                counted(dof, "joint")
            ))
        } else {
            not_as_declared("inputs", &state.inputs, &compiled.model.inputs(), true).or_else(|| {
                not_as_declared("states", &state.states, &compiled.model.states(), false)
            })
        };
        if let Some(fault) = fault {
            return Err(Error::json(path, &format!("state {}: {fault}", k + 1)));
        }
        let absent: Vec<String> = compiled
            .model
            .states()
            .into_iter()
            .filter(|name| !state.states.contains_key(name))
            .collect();
        if !absent.is_empty() {
            output::say(&format!(
                "note: state {}: `states` has no `{}`: 0, as at the start of a log",
                k + 1,
                absent.join("`, `")
            ));
        }
    }
    Ok(states)
}

/// What names and those that the declared effects have do not have in common.
fn not_as_declared(
    what: &str,
    given: &BTreeMap<String, f64>,
    declared: &[String],
    required: bool,
) -> Option<String> {
    let list = || match declared {
        [] => "no effect of the spec has any".to_owned(),
        names => format!("the spec's effects have `{}`", names.join("`, `")),
    };
    if let Some(unknown) = given.keys().find(|name| !declared.contains(name)) {
        return Some(format!("`{what}` has `{unknown}`, {}", list()));
    }
    let missing = declared.iter().find(|name| !given.contains_key(*name));
    missing
        .filter(|_| required)
        .map(|name| format!("`{what}` has no `{name}`, which a declared effect reads"))
}

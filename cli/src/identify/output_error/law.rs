//! Controllers of experiments from files.

use std::collections::BTreeMap;
use std::path::Path;

use robot_model::identify::output_error::{JointLaw, Law, Tap};
use robot_model_spec::model::Joint;
use serde::Deserialize;

use crate::{Error, json};

/// `{"joints": [{"position": [..], "torque": [..], "columns": {"qref1": [..]}, "optional_columns": {..}, "limit": ..}, ..]}`
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct File {
    joints: Vec<FileJoint>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct FileJoint {
    #[serde(default)]
    position: Vec<f64>,
    #[serde(default)]
    torque: Vec<f64>,
    #[serde(default)]
    columns: BTreeMap<String, Vec<f64>>,
    #[serde(default)]
    optional_columns: BTreeMap<String, Vec<f64>>,
    limit: Option<f64>,
}

/// How it is written.
const FORM: &str = "write `{\"joints\": [{\"position\": [..], \"torque\": [..], \"columns\": {\"qref1\": [..]}, \"limit\": ..}, ..]}`";

/// Reads one that has a law for each joint.
pub(super) fn read(path: &Path, joints: &[Joint]) -> Result<Law, Error> {
    let refuse = |reason: &str| Error::json(path, &reason);
    let file: File = json::typed(path, json::read(path)?, FORM)?;
    if file.joints.len() != joints.len() {
        return Err(refuse(&format!(
            "`joints` has {} laws for an arm with {}",
            file.joints.len(),
            crate::output::counted(joints.len(), "joint")
        )));
    }
    let laws = file.joints.into_iter().zip(joints);
    let laws = laws.map(|(law, joint)| {
        if law
            .limit
            .is_some_and(|limit| limit.is_nan() || limit <= 0.0)
        {
            return Err(refuse(&format!(
                "joint {}: `limit` has to be positive",
                joint.name
            )));
        }
        let taps = |columns: BTreeMap<String, Vec<f64>>, is_optional: bool| {
            columns.into_iter().map(move |(channel, weights)| Tap {
                channel,
                weights,
                is_optional,
            })
        };
        Ok(JointLaw {
            position: law.position,
            torque: law.torque,
            channels: taps(law.columns, false)
                .chain(taps(law.optional_columns, true))
                .collect(),
            limit: law.limit,
        })
    });
    Ok(Law {
        joints: laws.collect::<Result<_, Error>>()?,
    })
}

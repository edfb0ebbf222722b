//! Controllers of experiments from files.

use std::collections::BTreeMap;
use std::path::Path;

use robot_model::identify::output_error::{Distance, JointLaw, Law, Tap};
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
                "joint {}: `limit` must be positive",
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

/// Percent of a torque by which a simulated controller's is off, and how many times what the equations leave of raw samples of the logged one,
/// from where on it is another controller.
const OFF_PERCENT: f64 = 10.0;
const OFF_TIMES: f64 = 3.0;

/// Torques that a simulated controller does not give, where the equations, of which `left` stays, say that the arm may well have taken the
/// logged ones.
pub(super) fn doubt(joints: &[String], off: &[Distance], left: &[f64]) -> Option<String> {
    let all = joints.iter().zip(off).zip(left);
    let far = all.filter_map(|((joint, off), left)| {
        let percent = off.relative_percent?;
        let is_far = percent > OFF_PERCENT && off.rmse > OFF_TIMES * left;
        is_far.then(|| {
            format!(
                "`{joint}` {percent:.0} % for {:.0} %",
                percent * left / off.rmse
            )
        })
    });
    let far: Vec<String> = far.collect();
    (!far.is_empty()).then(|| {
        format!(
            "errors of the simulated controller's torques are far larger than the residual of the equations: {}; if its gains, rate or \
             reference differ from those of the experiment, the arm's values compensate for them",
            far.join(", ")
        )
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn torques_of_another_controller_are_told() {
        let joints = ["one", "two"].map(str::to_owned);
        // Percent of a torque of 1 and -1.
        let off = |percent: f64| {
            let off = 0.01 * percent;
            Distance::new(&[(1.0, 1.0 + off), (-1.0, off - 1.0)])
        };
        let said = doubt(&joints, &[off(35.0), off(5.0)], &[0.01, 0.01]).expect("far off");
        assert!(
            said.contains("`one` 35 % for 1 %;") && !said.contains("`two`"),
            "{said}"
        );
        // What the model lacks, or noise of the torque, is in both.
        assert_eq!(doubt(&joints, &[off(35.0), off(35.0)], &[0.2, 0.3]), None);
    }
}

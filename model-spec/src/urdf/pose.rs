//! Poses as a URDF has them, and the angles that are meant.

use std::collections::BTreeSet;

use urdf_rs::{Joint, Robot};

use super::{ImportError, UrdfPart};
use crate::model::Transform;
use crate::transform::{quarter_turns, rotation_rpy, rounded_quarter_turn};

/// The angle that is meant where it is written with few decimals: a quarter turn for 1.5708.
pub(super) fn meant(angle: f64) -> f64 {
    rounded_quarter_turn(angle).unwrap_or(angle)
}

/// What is read otherwise than it is written: angles that round a multiple of a quarter turn.
pub(super) fn notes(robot: &Robot) -> Vec<String> {
    let joints = robot.joints.iter().map(|joint| &joint.origin);
    let links = robot.links.iter().map(|link| &link.inertial.origin);
    let angles = joints.chain(links).flat_map(|pose| pose.rpy.0);
    let short: BTreeSet<String> = angles
        // Closer ones are quarter turns in every spec.
        .filter(|angle| quarter_turns(*angle).is_none() && rounded_quarter_turn(*angle).is_some())
        .map(|angle| angle.to_string())
        .collect();
    if short.is_empty() {
        return Vec::new();
    }
    let short: Vec<String> = short.into_iter().collect();
    vec![format!(
        "Angles of the URDF that round a multiple of a quarter turn are read as one: {}",
        short.join(", ")
    )]
}

/// Where a joint is on the link that carries it.
pub(super) fn origin_of(joint: &Joint) -> Result<Transform, ImportError> {
    let what = format!("the origin of joint `{}`", joint.name);
    let part = UrdfPart::of_joint(&joint.name, "origin");
    origin(&joint.origin, &what, part)
}

/// A URDF pose, with the angles' quarter turns exact, also where they are written short.
pub(super) fn origin(
    pose: &urdf_rs::Pose,
    what: &str,
    part: UrdfPart,
) -> Result<Transform, ImportError> {
    let mut numbers = pose.xyz.iter().chain(pose.rpy.iter());
    if numbers.all(|x| x.is_finite()) {
        return Ok(Transform {
            rotation: rotation_rpy(pose.rpy.0.map(meant)),
            translation: pose.xyz.0,
        });
    }
    Err(ImportError::NotFinite {
        what: what.to_owned(),
        part: Some(part),
    })
}

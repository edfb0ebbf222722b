//! Space that the arm keeps: a file of balls, planes and a distance.
//!
//! `{"balls": [{"link": "elbow", "center": [0, 0, 0.1], "radius": 0.08}], "box": {"low": [-1, -1, 0], "high": [1, 1, 2]},
//! "planes": [{"normal": [0, 0, 1], "offset": 0.02}], "apart": 0.03}`: centers in the axes of the link's frame, the rest in the
//! base frame, in m. All but the balls may be left out.

use std::path::Path;

use robot_model::excite::{Ball, Clearance, Room};
use robot_model_codegen::{Compiled, Nominal};
use serde::Deserialize;

use crate::interpreted::InterpretedFunction;
use crate::output::names;
use crate::{Error, json};

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct File {
    balls: Vec<BallOfFile>,
    #[serde(rename = "box")]
    within: Option<Box3>,
    #[serde(default)]
    planes: Vec<Plane>,
    apart: Option<f64>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct BallOfFile {
    link: String,
    #[serde(default)]
    center: [f64; 3],
    radius: f64,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct Box3 {
    low: [f64; 3],
    high: [f64; 3],
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct Plane {
    normal: [f64; 3],
    offset: f64,
}

/// How it is written.
const FORM: &str = "write `{\"balls\": [{\"link\": .., \"center\": [x, y, z], \"radius\": ..}, ..], \"box\": {\"low\": [..], \"high\": \
                    [..]}, \"planes\": [{\"normal\": [..], \"offset\": ..}], \"apart\": ..}`; only `balls` is required";

/// Reads the file.
pub(super) fn read(
    path: &Path,
    compiled: &Compiled,
    nominal: &Nominal,
    period: f64,
) -> Result<Box<dyn Clearance>, Error> {
    let value = json::read(path)?;
    let file: File = json::typed(path, value, FORM)?;
    let refused = |reason: String| Error::json(path, &reason);
    let Some(chain) = compiled.model.chain() else {
        return Err(refused("the robot has no links to put balls on".to_owned()));
    };
    let links: Vec<&str> = chain.links.iter().map(|link| link.name.as_str()).collect();
    let mut balls = Vec::new();
    let mut points = Vec::new();
    for ball in file.balls {
        let Some(on) = links.iter().position(|link| *link == ball.link) else {
            return Err(refused(format!(
                "no link `{}`; there are {}",
                ball.link,
                names(&links)
            )));
        };
        if !(ball.radius >= 0.0 && ball.radius.is_finite()) {
            return Err(refused(format!(
                "a ball on `{}` has the radius {}",
                ball.link, ball.radius
            )));
        }
        points.push((on, ball.center));
        balls.push(Ball {
            link: ball.link,
            on,
            radius: ball.radius,
        });
    }
    let mut planes = Vec::new();
    for plane in file.planes {
        let length = plane.normal.iter().map(|x| x * x).sum::<f64>().sqrt();
        if !(length > 0.0 && length.is_finite()) {
            return Err(refused(format!(
                "a plane has the normal {:?}",
                plane.normal
            )));
        }
        planes.push((plane.normal.map(|x| x / length), plane.offset / length));
    }
    if let Some(Box3 { low, high }) = file.within {
        for axis in 0..3 {
            if low[axis].is_nan() || high[axis].is_nan() || low[axis] >= high[axis] {
                return Err(refused(
                    "the box is empty: `low` must be below `high` in each axis".to_owned(),
                ));
            }
            let unit = |sign: f64| std::array::from_fn(|k| if k == axis { sign } else { 0.0 });
            planes.push((unit(1.0), low[axis]));
            planes.push((unit(-1.0), -high[axis]));
        }
    }
    if file
        .apart
        .is_some_and(|apart| apart.is_nan() || apart < 0.0)
    {
        return Err(refused("`apart` must be a distance, 0 or more".to_owned()));
    }
    if balls.is_empty() || (planes.is_empty() && file.apart.is_none()) {
        return Err(refused(
            "it limits nothing: write `balls`, and `box`, `planes` or their least distance from each other, `\"apart\": 0.02`"
                .to_owned(),
        ));
    }
    let centers = compiled
        .design_points(&points, nominal)
        .ok_or_else(|| refused("the robot has no links to put balls on".to_owned()))?;
    Ok(Box::new(Room {
        centers: Box::new(InterpretedFunction::new(centers, compiled.dof(), period)),
        balls,
        planes,
        apart: file.apart,
    }))
}

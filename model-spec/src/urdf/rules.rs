//! What elements of a URDF have, and of which kind it is.

/// What an attribute has to be.
#[derive(Clone, Copy)]
pub(super) enum Kind {
    Text,
    Numbers(usize),
    JointType,
}

use Kind::{JointType, Numbers, Text};

/// Its name, what it has to be, whether it has to be there.
pub(super) type Attribute = (&'static str, Kind, bool);

/// Elements below `robot`, their attributes, and whether these have to be there. `collision` is read as `visual`.
pub(super) const ATTRIBUTES: [(&str, &[Attribute]); 23] = [
    ("link", &[("name", Text, true)]),
    ("link/inertial/origin", &POSE),
    ("link/inertial/mass", &[("value", Numbers(1), true)]),
    (
        "link/inertial/inertia",
        &[
            ("ixx", Numbers(1), true),
            ("ixy", Numbers(1), true),
            ("ixz", Numbers(1), true),
            ("iyy", Numbers(1), true),
            ("iyz", Numbers(1), true),
            ("izz", Numbers(1), true),
        ],
    ),
    ("link/visual/origin", &POSE),
    ("link/visual/geometry/box", &[("size", Numbers(3), true)]),
    ("link/visual/geometry/cylinder", &TUBE),
    ("link/visual/geometry/capsule", &TUBE),
    (
        "link/visual/geometry/sphere",
        &[("radius", Numbers(1), true)],
    ),
    (
        "link/visual/geometry/mesh",
        &[("filename", Text, true), ("scale", Numbers(3), false)],
    ),
    ("link/visual/material", &[("name", Text, true)]),
    ("link/visual/material/color", &COLOR),
    ("link/visual/material/texture", &[("filename", Text, true)]),
    ("material", &[("name", Text, true)]),
    ("material/color", &COLOR),
    ("joint", &[("name", Text, true), ("type", JointType, true)]),
    ("joint/origin", &POSE),
    ("joint/parent", &[("link", Text, true)]),
    ("joint/child", &[("link", Text, true)]),
    ("joint/axis", &[("xyz", Numbers(3), true)]),
    (
        "joint/limit",
        &[
            ("lower", Numbers(1), false),
            ("upper", Numbers(1), false),
            ("effort", Numbers(1), false),
            ("velocity", Numbers(1), true),
        ],
    ),
    (
        "joint/dynamics",
        &[
            ("damping", Numbers(1), false),
            ("friction", Numbers(1), false),
        ],
    ),
    (
        "joint/mimic",
        &[
            ("joint", Text, true),
            ("multiplier", Numbers(1), false),
            ("offset", Numbers(1), false),
        ],
    ),
];

const POSE: [Attribute; 2] = [("xyz", Numbers(3), false), ("rpy", Numbers(3), false)];
const TUBE: [Attribute; 2] = [("radius", Numbers(1), true), ("length", Numbers(1), true)];
const COLOR: [Attribute; 1] = [("rgba", Numbers(4), true)];

/// Elements with parts that each stand there once, and which of them have to.
pub(super) const PARTS: [(&str, &[&str], &[&str]); 4] = [
    ("link", &["inertial"], &[]),
    (
        "link/inertial",
        &["origin", "mass", "inertia"],
        &["mass", "inertia"],
    ),
    ("link/visual", &["origin", "geometry"], &["geometry"]),
    (
        "joint",
        &[
            "origin", "parent", "child", "axis", "limit", "dynamics", "mimic",
        ],
        &["parent", "child"],
    ),
];

const JOINT_TYPES: [&str; 7] = [
    "revolute",
    "continuous",
    "prismatic",
    "fixed",
    "floating",
    "planar",
    "spherical",
];

pub(super) const XACRO: &str =
    "is of xacro: expand the file first, `xacro arm.urdf.xacro > arm.urdf`";

/// Why a value is not of its kind.
pub(super) fn wrong(value: &str, kind: Kind) -> Option<String> {
    let is_right = match kind {
        Text => true,
        JointType => JOINT_TYPES.contains(&value),
        Numbers(1) => value.parse::<f64>().is_ok(),
        Numbers(count) => {
            let numbers: Vec<_> = value.split_whitespace().map(str::parse::<f64>).collect();
            numbers.len() == count && numbers.iter().all(Result::is_ok)
        }
    };
    if is_right {
        return None;
    }
    if value.contains("${") || value.contains("$(") {
        return Some(XACRO.to_owned());
    }
    Some(match kind {
        Text => return None,
        JointType => format!(
            "is no type of a joint: write one of {}",
            JOINT_TYPES.join(", ")
        ),
        Numbers(1) => "is no number: write it in SI units, without a unit".to_owned(),
        Numbers(count) => format!(
            "is not {count} numbers: write them with blanks between, in SI units, without units"
        ),
    })
}

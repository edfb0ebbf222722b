//! Links: mass, center of mass, inertia; the ten parameters about the link's origin.

use std::collections::BTreeMap;

use super::chain::CheckedJoint;
use super::setting::Settings;
use super::unit::Dimension;
use super::{Errors, check_unique, optional, value};
use crate::ast::{self, Robot, Value};
use crate::diagnostic::Diagnostic;
use crate::model::Inertial;
use crate::suggest;

/// Inertials by link name.
pub(super) fn check_links(
    robot: &Robot,
    joints: &[CheckedJoint],
    errors: &mut Errors,
) -> BTreeMap<String, Inertial> {
    check_unique(robot.links.iter().map(|link| &link.name), "link", errors);
    let names: Vec<String> = joints.iter().map(|joint| joint.link.to_string()).collect();
    let mut inertials = BTreeMap::new();
    for link in &robot.links {
        let name = link.name.to_string();
        if !names.contains(&name) {
            errors.push(
                Diagnostic::new(
                    link.name.span(),
                    format!("no joint moves a link `{name}`"),
                    "unknown link",
                )
                .help(format!(
                    "{}; a link has its joint's name unless the joint says `link = {name};`",
                    suggest::help(&name, names.iter().map(String::as_str))
                )),
            );
        }
        if let Some(inertial) = check_link(link, errors) {
            inertials.insert(name, inertial);
        }
    }
    inertials
}

const KEYS: [&str; 3] = ["mass", "com", "inertia"];

fn check_link(link: &ast::Link, errors: &mut Errors) -> Option<Inertial> {
    let owner = format!("link `{}`", link.name);
    let settings = Settings::new(&link.settings, &owner, &KEYS, errors);
    let missing: Vec<&str> = KEYS.into_iter().filter(|key| settings.lacks(key)).collect();
    if !missing.is_empty() {
        errors.push(
            Diagnostic::new(
                link.name.span(),
                format!("{owner} does not give {}", suggest::list(missing.iter().copied())),
                "incomplete",
            )
            .help(
                "write `mass = ..; com = [x, y, z]; inertia = [ixx, ixy, ixz, iyy, iyz, izz];`, or remove the link: it is then identified",
            ),
        );
    }
    let mass = optional(settings.get("mass"), check_mass, errors);
    let com = optional(
        settings.get("com"),
        |v| value::vector(v, Dimension::LENGTH),
        errors,
    );
    let inertia = optional(settings.get("inertia"), check_inertia, errors);
    let fixed = check_status(link, errors)?;
    let ten = about_origin(mass?, com?, inertia?);
    Some(if fixed {
        Inertial::Fixed(ten)
    } else {
        Inertial::Nominal(ten)
    })
}

/// Whether the values are exact.
fn check_status(link: &ast::Link, errors: &mut Errors) -> Option<bool> {
    let Some(status) = &link.status else {
        return Some(false);
    };
    let word = status.to_string();
    match word.as_str() {
        "nominal" => Some(false),
        "fixed" => Some(true),
        _ => {
            errors.push(
                Diagnostic::new(
                    status.span(),
                    format!("unknown status `{word}` of a link"),
                    "",
                )
                .help(format!(
                    "{}: nominal values are identified, fixed ones are kept",
                    suggest::help(&word, ["nominal", "fixed"])
                )),
            );
            None
        }
    }
}

fn check_mass(value: &Value) -> Result<f64, Diagnostic> {
    let mass = value::scalar(value, Dimension::MASS)?;
    if mass >= 0.0 {
        return Ok(mass);
    }
    Err(Diagnostic::new(
        value.span(),
        "a mass must not be negative",
        format!("is {mass} kg"),
    )
    .help("write zero or more"))
}

fn check_inertia(value: &Value) -> Result<[f64; 6], Diagnostic> {
    let inertia: [f64; 6] = value::vector(value, Dimension::INERTIA)?;
    match [
        ("ixx", inertia[0]),
        ("iyy", inertia[3]),
        ("izz", inertia[5]),
    ]
    .iter()
    .find(|(_, moment)| *moment < 0.0)
    {
        None => Ok(inertia),
        Some((name, moment)) => Err(Diagnostic::new(
            value.span(),
            "a moment of inertia must not be negative",
            format!("`{name}` is {moment} kg m^2"),
        )
        .help("the order is [ixx, ixy, ixz, iyy, iyz, izz], about the center of mass")),
    }
}

/// Steiner: `I_origin = I_com + m (|c|^2 1 - c c^T)`, in the order of the ten parameters.
fn about_origin(
    m: f64,
    [x, y, z]: [f64; 3],
    [ixx, ixy, ixz, iyy, iyz, izz]: [f64; 6],
) -> [f64; 10] {
    [
        m,
        m * x,
        m * y,
        m * z,
        ixx + m * (y * y + z * z),
        ixy - m * x * y,
        ixz - m * x * z,
        iyy + m * (x * x + z * z),
        iyz - m * y * z,
        izz + m * (x * x + y * y),
    ]
    .map(|entry| entry + 0.0)
}

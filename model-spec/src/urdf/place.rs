//! Why a URDF cannot be read, with its line: a second pass over the text, by the rules that the first one broke.
//!
//! The library that reads URDFs names neither element nor line, so its words are only kept where this pass finds nothing.

use xml::attribute::OwnedAttribute;
use xml::common::Position as _;
use xml::name::OwnedName;
use xml::reader::{EventReader, XmlEvent};

use super::{ImportError, UrdfFault};

/// What an attribute has to be.
#[derive(Clone, Copy)]
enum Kind {
    Text,
    Numbers(usize),
    JointType,
}

use Kind::{JointType, Numbers, Text};

/// Its name, what it has to be, whether it has to be there.
type Attribute = (&'static str, Kind, bool);

/// Elements below `robot`, their attributes, and whether these have to be there. `collision` is read as `visual`.
const ATTRIBUTES: [(&str, &[Attribute]); 23] = [
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
const PARTS: [(&str, &[&str], &[&str]); 4] = [
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

const XACRO: &str = "is of xacro: expand the file first, `xacro arm.urdf.xacro > arm.urdf`";

/// An element that is not closed yet.
struct Open {
    name: String,
    line: u64,
    parts: Vec<String>,
}

fn other_root(name: &str) -> String {
    format!("the file is of `<{name}>`: a URDF has all inside `<robot name=\"..\">`")
}

fn is_of_xacro(name: &OwnedName) -> bool {
    let is_named = |space: &str| space.ends_with("xacro");
    name.prefix.as_deref() == Some("xacro") || name.namespace.as_deref().is_some_and(is_named)
}

/// Refuses a file of another root, of which what reads URDFs would say that it has no links, and one that is to be expanded first.
pub(super) fn check_elements(urdf: &str) -> Result<(), ImportError> {
    let mut reader = EventReader::from_str(urdf);
    let mut is_root = true;
    loop {
        let event = reader.next();
        let line = reader.position().row + 1;
        let fault = match event {
            // What reads URDFs goes past it, and so past all that it would expand to.
            Ok(XmlEvent::StartElement { name, .. }) if is_of_xacro(&name) => {
                let prefix = name.prefix.as_deref().unwrap_or_default();
                format!("`<{prefix}:{}>` {XACRO}", name.local_name)
            }
            Ok(XmlEvent::StartElement { name, .. }) if is_root && name.local_name != "robot" => {
                other_root(&name.local_name)
            }
            Ok(XmlEvent::StartElement { .. }) => {
                is_root = false;
                continue;
            }
            // What is no XML is told by what reads it.
            Ok(XmlEvent::EndDocument) | Err(_) => return Ok(()),
            Ok(_) => continue,
        };
        return Err(ImportError::Parse(UrdfFault::in_line(line, fault)));
    }
}

/// Where and why `urdf` cannot be read; `said`, the library's words, where no rule of this file is broken.
pub(super) fn explain(urdf: &str, said: &str) -> UrdfFault {
    if let Some(declared) = declared_entity(urdf) {
        let line = urdf[..declared].matches('\n').count() as u64 + 1;
        return UrdfFault::in_line(
            line,
            "`<!ENTITY ..>` declares an entity, and URDFs are read without them: write what it stands for in its place",
        );
    }
    let mut reader = EventReader::from_str(urdf);
    let mut open: Vec<Open> = Vec::new();
    let mut owner = String::new();
    loop {
        let event = reader.next();
        let line = reader.position().row + 1;
        let fault = match event {
            Ok(XmlEvent::StartElement {
                name, attributes, ..
            }) => {
                let prefix = name.prefix.as_deref();
                let written = name.local_name;
                if open.len() == 1 {
                    owner = owner_of(&written, &attributes);
                }
                let again = second(&mut open, &written);
                open.push(Open {
                    name: written.clone(),
                    line,
                    parts: Vec::new(),
                });
                let fault = if prefix == Some("xacro") {
                    Some(format!("`<xacro:{written}>` {XACRO}"))
                } else if open.len() == 1 && written != "robot" {
                    Some(other_root(&written))
                } else if again {
                    Some(format!("a second `<{written}>` in {owner}: keep one"))
                } else {
                    fault_of(&path(&open), &written, &attributes, &owner)
                };
                fault.map(|fault| (line, fault))
            }
            Ok(XmlEvent::EndElement { .. }) => {
                let fault = missing_part(&open, &owner);
                open.pop().and_then(|end| Some((end.line, fault?)))
            }
            Ok(XmlEvent::EndDocument) => return UrdfFault::of_all(said),
            Ok(_) => None,
            Err(error) => {
                let line = error.position().row + 1;
                return UrdfFault::in_line(line, not_xml(error.msg(), &open));
            }
        };
        if let Some((line, fault)) = fault {
            return UrdfFault::in_line(line, fault);
        }
    }
}

/// Where an entity is declared, outside of comments.
fn declared_entity(urdf: &str) -> Option<usize> {
    let mut from = 0;
    loop {
        let rest = &urdf[from..];
        let declared = rest.find("<!ENTITY")?;
        match rest.find("<!--").filter(|comment| *comment < declared) {
            Some(comment) => from += comment + rest[comment..].find("-->")?,
            None => return Some(from + declared),
        }
    }
}

/// "link `fore`"
fn owner_of(element: &str, attributes: &[OwnedAttribute]) -> String {
    let name = attributes.iter().find(|a| a.name.local_name == "name");
    match name {
        Some(name) => format!("{element} `{}`", name.value),
        None => format!("`<{element}>`"),
    }
}

/// The path below `robot`.
fn path(open: &[Open]) -> String {
    let names: Vec<&str> = open.iter().skip(1).map(|one| one.name.as_str()).collect();
    names.join("/").replace("link/collision", "link/visual")
}

/// Notes an element in the one around it; whether it stands there a second time and must not.
fn second(open: &mut [Open], name: &str) -> bool {
    let around = path(open);
    let single = PARTS
        .iter()
        .any(|(element, single, _)| *element == around && single.contains(&name));
    let Some(parent) = open.last_mut() else {
        return false;
    };
    let known = parent.parts.iter().any(|part| part == name);
    parent.parts.push(name.to_owned());
    single && known
}

fn missing_part(open: &[Open], owner: &str) -> Option<String> {
    let around = path(open);
    let end = open.last()?;
    let (_, _, needed) = PARTS.iter().find(|(element, ..)| *element == around)?;
    let missing = needed
        .iter()
        .find(|part| !end.parts.iter().any(|known| known == *part))?;
    Some(format!(
        "`<{}>` of {owner} has no `<{missing} ../>`: write one",
        end.name
    ))
}

fn fault_of(
    path: &str,
    element: &str,
    attributes: &[OwnedAttribute],
    owner: &str,
) -> Option<String> {
    let (_, known) = ATTRIBUTES.iter().find(|(known, _)| *known == path)?;
    known.iter().find_map(|(name, kind, needed)| {
        let written = attributes.iter().find(|a| a.name.local_name == *name);
        let Some(written) = written else {
            return needed.then(|| {
                format!("`<{element}>` of {owner} has no `{name}`: write `{name}=\"..\"`")
            });
        };
        let value = written.value.trim();
        let why = wrong(value, *kind)?;
        Some(format!(
            "`{name}=\"{value}\"` in `<{element}>` of {owner} {why}"
        ))
    })
}

/// Why a value is not of its kind.
fn wrong(value: &str, kind: Kind) -> Option<String> {
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
        Numbers(count) => format!("is not {count} numbers: write them with blanks between"),
    })
}

/// What the XML itself breaks.
fn not_xml(said: &str, open: &[Open]) -> String {
    if said.contains("xacro") {
        return format!("an element {XACRO}");
    }
    // Lines of dashes in comments are no XML.
    if said.contains("'--'") {
        return "a comment has `--` in it, which XML has at its end alone: write `==`".to_owned();
    }
    if let Some((_, name)) = said.split_once("entity: ") {
        return format!(
            "`&{name};` stands for nothing here: write what is meant; the sign `&` itself is `&amp;`"
        );
    }
    match open.last() {
        Some(inner) if said.contains("end of stream") => format!(
            "the file ends inside the `<{}>` of line {}: close it, or read the whole file again",
            inner.name, inner.line
        ),
        Some(inner) => format!(
            "{said}, inside the `<{}>` of line {}: mend the XML there",
            inner.name, inner.line
        ),
        None => format!("{said}: a URDF begins with `<robot name=\"..\">`"),
    }
}

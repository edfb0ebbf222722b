//! Why a URDF cannot be read, with its line: a second pass over the text, by the rules that the first one broke.
//!
//! The library that reads URDFs names neither element nor line, so its words are only kept where this pass finds nothing.

use xml::attribute::OwnedAttribute;
use xml::common::Position as _;
use xml::name::OwnedName;
use xml::reader::{EventReader, XmlEvent};

use super::rules::{ATTRIBUTES, PARTS, XACRO, wrong};
use super::{ImportError, UrdfFault, UrdfPlace};

/// An element that is not closed yet.
struct Open {
    name: String,
    line: u64,
    /// Its number among all elements of the text.
    number: usize,
    parts: Vec<String>,
}

/// Something wrong with an element, or with one of its attributes.
struct Wrong {
    element: usize,
    attribute: Option<&'static str>,
    line: u64,
    reason: String,
}

/// What is asked of a text.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Asked {
    /// What the library that reads URDFs goes past without a word, and would read as another robot.
    Unnoticed,
    /// Every rule of this file.
    All,
}

fn other_root(name: &str) -> String {
    format!("the file is of `<{name}>`: a URDF has all inside `<robot name=\"..\">`")
}

fn is_of_xacro(name: &OwnedName) -> bool {
    let is_named = |space: &str| space.ends_with("xacro");
    name.prefix.as_deref() == Some("xacro") || name.namespace.as_deref().is_some_and(is_named)
}

/// Refuses a file of another root, of which what reads URDFs would say that it has no links, one that is to be expanded first, and numbers
/// with words before, between or behind them.
pub(super) fn check_elements(urdf: &str) -> Result<(), ImportError> {
    match first_fault(urdf, Asked::Unnoticed) {
        Some(fault) => Err(ImportError::Parse(fault)),
        None => Ok(()),
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
    first_fault(urdf, Asked::All).unwrap_or_else(|| UrdfFault::of_all(said))
}

/// The first place of the text that breaks a rule.
fn first_fault(urdf: &str, asked: Asked) -> Option<UrdfFault> {
    let mut reader = EventReader::from_str(urdf);
    let mut open: Vec<Open> = Vec::new();
    let mut owner = String::new();
    let mut count = 0;
    loop {
        let event = reader.next();
        let line = reader.position().row + 1;
        let wrong = match event {
            Ok(XmlEvent::StartElement {
                name, attributes, ..
            }) => {
                if open.len() == 1 {
                    owner = owner_of(&name.local_name, &attributes);
                }
                let again = second(&mut open, &name.local_name);
                let number = count;
                count += 1;
                open.push(Open {
                    name: name.local_name.clone(),
                    line,
                    number,
                    parts: Vec::new(),
                });
                let fault = if again && asked == Asked::All {
                    let reason = format!("a second `<{}>` in {owner}: keep one", name.local_name);
                    Some((None, reason))
                } else {
                    opening_fault(&open, &name, &attributes, &owner, asked)
                };
                fault.map(|(attribute, reason)| Wrong {
                    element: number,
                    attribute,
                    line,
                    reason,
                })
            }
            Ok(XmlEvent::EndElement { .. }) => {
                let reason = (asked == Asked::All).then(|| missing_part(&open, &owner));
                let end = open.pop();
                end.zip(reason.flatten()).map(|(end, reason)| Wrong {
                    element: end.number,
                    attribute: None,
                    line: end.line,
                    reason,
                })
            }
            Ok(XmlEvent::EndDocument) => return None,
            Ok(_) => None,
            Err(error) => {
                // What is no XML is told where the library has refused it.
                let line = error.position().row + 1;
                let all = asked == Asked::All;
                return all.then(|| UrdfFault::in_line(line, not_xml(error.msg(), &open)));
            }
        };
        if let Some(wrong) = wrong {
            let place = UrdfPlace::of_element(urdf, wrong.element, wrong.attribute);
            let place = place.unwrap_or_else(|| UrdfPlace::line(wrong.line));
            return Some(UrdfFault::at(place, wrong.reason));
        }
    }
}

/// What is wrong with the beginning of the innermost element, and with which of its attributes.
fn opening_fault(
    open: &[Open],
    name: &OwnedName,
    attributes: &[OwnedAttribute],
    owner: &str,
    asked: Asked,
) -> Option<(Option<&'static str>, String)> {
    let written = &name.local_name;
    // What reads URDFs goes past it, and so past all that it would expand to.
    if is_of_xacro(name) {
        let prefix = name.prefix.as_deref().unwrap_or_default();
        return Some((None, format!("`<{prefix}:{written}>` {XACRO}")));
    }
    if open.len() == 1 && written != "robot" {
        return Some((None, other_root(written)));
    }
    let path = path(open);
    let decides = path.starts_with("joint/") || path.starts_with("link/inertial/");
    if asked == Asked::All || decides {
        return fault_of(&path, written, attributes, owner, asked);
    }
    None
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
    asked: Asked,
) -> Option<(Option<&'static str>, String)> {
    let (_, known) = ATTRIBUTES.iter().find(|(known, _)| *known == path)?;
    known.iter().find_map(|(name, kind, needed)| {
        let written = attributes.iter().find(|a| a.name.local_name == *name);
        let Some(written) = written else {
            let reason =
                || format!("`<{element}>` of {owner} has no `{name}`: write `{name}=\"..\"`");
            return (*needed && asked == Asked::All).then(|| (None, reason()));
        };
        let value = written.value.trim();
        let why = wrong(value, *kind)?;
        Some((
            Some(*name),
            format!("`{name}=\"{value}\"` in `<{element}>` of {owner} {why}"),
        ))
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
        None if said.contains("outside the root element") => {
            "the file is not XML: a URDF begins with `<robot name=\"..\">`".to_owned()
        }
        None => format!("{said}: a URDF begins with `<robot name=\"..\">`"),
    }
}

//! Where and why a text is no URDF.

use std::fmt;
use std::ops::Range;

use roxmltree::{Document, Node};

/// A place in the text of a URDF.
#[derive(Debug, Clone, PartialEq, Eq)]
#[non_exhaustive]
pub struct UrdfPlace {
    /// The line, from 1.
    pub line: u64,
    /// Its letters that are at fault, from 1; none where the whole line is.
    pub letters: Option<Range<usize>>,
}

impl UrdfPlace {
    pub(super) fn line(line: u64) -> Self {
        Self {
            line,
            letters: None,
        }
    }

    /// The element of this number among all, in the order of the text, or its attribute. None where the text is not well-formed.
    pub(super) fn of_element(urdf: &str, number: usize, attribute: Option<&str>) -> Option<Self> {
        let document = Document::parse(urdf).ok()?;
        let mut elements = document.descendants().filter(Node::is_element);
        Some(Self::of_node(elements.nth(number)?, attribute))
    }

    /// A joint or a link by its name, or what is named of it, as far as that is there.
    pub(super) fn of_part(urdf: &str, part: &UrdfPart) -> Option<Self> {
        let document = Document::parse(urdf).ok()?;
        let mut elements = document.root_element().children();
        let named = |node: &Node| node.has_tag_name(part.kind) && has_name(node, &part.name);
        let owner = elements.find(named)?;
        // `inertial/mass` is an element in an element.
        let names = part.element.split('/').filter(|name| !name.is_empty());
        let inner = names.fold(owner, |around, name| {
            let mut parts = around.children();
            parts.find(|node| node.has_tag_name(name)).unwrap_or(around)
        });
        Some(Self::of_node(inner, part.attribute))
    }

    /// The name of an element with its bracket, or an attribute with its value.
    fn of_node(node: Node, attribute: Option<&str>) -> Self {
        let own = attribute.and_then(|name| node.attributes().find(|own| own.name() == name));
        let text = node.document().input_text();
        let range = own.map_or_else(
            || {
                let start = node.range().start;
                let ends = |c: char| c.is_whitespace() || c == '>' || c == '/';
                let length = text[start..].find(ends);
                start..length.map_or(text.len(), |length| start + length)
            },
            |own| own.range(),
        );
        let start = node.document().text_pos_at(range.start);
        let first = usize::try_from(start.col).unwrap_or(usize::MAX);
        let marked = &text[range];
        // A value may go on in the next line; what is shown is one.
        let marked = marked.lines().next().unwrap_or_default();
        Self {
            line: u64::from(start.row),
            letters: Some(first..first.saturating_add(marked.chars().count())),
        }
    }
}

fn has_name(node: &Node, name: &str) -> bool {
    node.attribute("name") == Some(name)
}

/// What of a robot is at fault: a joint or a link, one of its elements, or one of that one's attributes.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct UrdfPart {
    kind: &'static str,
    name: String,
    element: &'static str,
    attribute: Option<&'static str>,
}

impl UrdfPart {
    /// An element of a joint; the joint itself where that is empty.
    pub(super) fn of_joint(name: &str, element: &'static str) -> Self {
        Self {
            kind: "joint",
            name: name.to_owned(),
            element,
            attribute: None,
        }
    }

    pub(super) fn of_link(name: &str, element: &'static str) -> Self {
        Self {
            kind: "link",
            ..Self::of_joint(name, element)
        }
    }

    pub(super) fn attribute(self, name: &'static str) -> Self {
        Self {
            attribute: Some(name),
            ..self
        }
    }
}

/// What cannot be read in a URDF.
#[derive(Debug, Clone, PartialEq, Eq)]
#[non_exhaustive]
pub struct UrdfFault {
    /// Where it is; none where the text as a whole is at fault.
    pub place: Option<UrdfPlace>,
    /// What is wrong there, and what to write.
    pub reason: String,
}

impl UrdfFault {
    pub(super) fn at(place: UrdfPlace, reason: impl Into<String>) -> Self {
        Self {
            place: Some(place),
            reason: reason.into(),
        }
    }

    pub(super) fn in_line(line: u64, reason: impl Into<String>) -> Self {
        Self::at(UrdfPlace::line(line), reason)
    }

    pub(super) fn of_all(reason: impl Into<String>) -> Self {
        Self {
            place: None,
            reason: reason.into(),
        }
    }
}

impl fmt::Display for UrdfFault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match &self.place {
            Some(place) => write!(f, "line {}: {}", place.line, self.reason),
            None => f.write_str(&self.reason),
        }
    }
}

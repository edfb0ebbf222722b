//! Changes of the text of a URDF, each where an element stands; all else stays, blanks and line ends too.

use std::ops::Range;

use roxmltree::Node;

use crate::export::{JointNumbers, comment, number};

/// How the comment at the top begins.
const MARK: &str = "robot-model:";

fn child<'a, 'input>(node: Node<'a, 'input>, name: &str) -> Option<Node<'a, 'input>> {
    node.children().find(|child| child.has_tag_name(name))
}

/// Changes of a text, which are made from its end to its start.
pub(super) struct Edits<'a> {
    text: &'a str,
    changes: Vec<(Range<usize>, String)>,
    newline: &'static str,
}

impl<'a> Edits<'a> {
    pub(super) fn new(text: &'a str) -> Self {
        Self {
            text,
            changes: Vec::new(),
            newline: if text.contains("\r\n") { "\r\n" } else { "\n" },
        }
    }

    /// The text with all changes.
    pub(super) fn done(mut self) -> String {
        self.changes.sort_by_key(|(range, _)| range.start);
        let mut text = self.text.to_owned();
        for (range, new) in self.changes.into_iter().rev() {
            text.replace_range(range, &new);
        }
        text
    }

    /// Blanks in front of the line on which an element begins; nothing where something else is on it.
    fn indent(&self, node: Node) -> Option<&'a str> {
        let before = &self.text[..node.range().start];
        let line = &before[before.rfind('\n').map_or(0, |end| end + 1)..];
        line.trim().is_empty().then_some(line)
    }

    /// What is between lines at an indentation; all stands on one line where there is none.
    fn between(&self, indent: Option<&str>) -> String {
        indent.map_or_else(String::new, |indent| format!("{}{indent}", self.newline))
    }

    /// Lines at an indentation, the first without it.
    fn lines(&self, lines: &[String], indent: Option<&str>) -> String {
        if indent.is_some() {
            return lines.join(&self.between(indent));
        }
        lines.iter().map(|line| line.trim_start()).collect()
    }

    /// Behind the `<name` of an element.
    fn behind_name(&self, node: Node) -> usize {
        let start = node.range().start + 1;
        let is_end = |c: char| c.is_whitespace() || c == '/' || c == '>';
        let length = self.text[start..].find(is_end);
        start + length.unwrap_or(0)
    }

    /// A new first child.
    fn insert_first(&mut self, node: Node, lines: &[String]) {
        if let Some(first) = node.children().find(Node::is_element) {
            let (place, indent) = (first.range().start, self.indent(first));
            let new = self.lines(lines, indent) + &self.between(indent);
            self.changes.push((place..place, new));
            return;
        }
        let outer = self.indent(node);
        let inner = outer.map(|outer| format!("{outer}  "));
        let inner = inner.as_deref();
        let new = self.between(inner) + &self.lines(lines, inner) + &self.between(outer);
        let range = node.range();
        if let Some(head) = self.text[range.clone()].strip_suffix("/>") {
            let start = range.start + head.trim_end().len();
            let name = &self.text[range.start + 1..self.behind_name(node)];
            let new = format!(">{new}</{name}>");
            self.changes.push((start..range.end, new));
        } else {
            let end = self.text[range.clone()].rfind("</").unwrap_or(0) + range.start;
            self.changes.push((end..end, new));
        }
    }

    /// `<inertial>` of a link, a new one or in the place of the old.
    pub(super) fn inertial(&mut self, link: Node, lines: &[String]) {
        match child(link, "inertial") {
            Some(old) => {
                let new = self.lines(lines, self.indent(old));
                self.changes.push((old.range(), new));
            }
            None => self.insert_first(link, lines),
        }
    }

    /// A comment in its place.
    pub(super) fn remove_inertial(&mut self, link: Node) {
        if let Some(old) = child(link, "inertial") {
            let new = "<!-- its inertial is in that of the link that carries it -->".to_owned();
            self.changes.push((old.range(), new));
        }
    }

    /// `damping` and `friction` of a joint, as far as they are known.
    pub(super) fn dynamics(&mut self, joint: Node, numbers: &JointNumbers) {
        let values = [("damping", numbers.damping), ("friction", numbers.friction)];
        let values = values
            .iter()
            .filter_map(|(name, value)| Some((*name, (*value)?)));
        let written = |(name, value): (&str, f64)| format!("{name}=\"{}\"", number(value));
        let Some(old) = child(joint, "dynamics") else {
            let all: Vec<String> = values.map(written).collect();
            if let (false, Some(last)) = (all.is_empty(), joint.last_element_child()) {
                let (place, indent) = (last.range().end, self.indent(last));
                let new = format!("{}<dynamics {}/>", self.between(indent), all.join(" "));
                self.changes.push((place..place, new));
            }
            return;
        };
        let mut new = String::new();
        for (name, value) in values {
            match old.attribute_node(name) {
                Some(attribute) => {
                    let range = attribute.range_value();
                    self.changes.push((range, number(value)));
                }
                None => new = format!("{new} {}", written((name, value))),
            }
        }
        if !new.is_empty() {
            let place = self.behind_name(old);
            self.changes.push((place..place, new));
        }
    }

    /// The comment at the top: a new one, or in the place of that of an earlier export; none where there is nothing to be said.
    pub(super) fn note(&mut self, root: Node, notes: &[String]) {
        let is_ours = |node: &Node| {
            node.is_comment()
                && node
                    .text()
                    .is_some_and(|text| text.trim_start().starts_with(MARK))
        };
        let old = root.children().find(is_ours);
        if notes.is_empty() {
            // With the line that it is on.
            let gone = old.map(|old| {
                let before = self.text[..old.range().start].trim_end().len();
                (before..old.range().end, String::new())
            });
            self.changes.extend(gone);
            return;
        }
        let first = root.first_element_child();
        let indent = first.and_then(|first| self.indent(first)).unwrap_or("");
        let lines = std::iter::once(MARK.to_owned()).chain(notes.iter().map(|note| comment(note)));
        let lines: Vec<String> = lines.collect();
        let text = self.lines(&lines, Some(&format!("{indent}  ")));
        let text = format!("<!-- {text} -->");
        match old {
            Some(old) => self.changes.push((old.range(), text)),
            None => self.insert_first(root, &[text]),
        }
    }
}

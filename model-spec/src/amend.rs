//! Effects into the text of a spec: an edit at a place, so that comments and layout of the author stay as they are.

mod remove;

pub use remove::remove;

use crate::ast::{DeclaredEffect, Effects, Robot};
use crate::diagnostic::Diagnostics;
use crate::{load, parse};

/// An effect to declare.
#[derive(Debug, Clone, PartialEq)]
pub struct Amendment {
    /// Snake-case name of the effect.
    pub effect: String,
    /// Names of the joints, one per formal joint of the effect; none where it acts on the arm as a whole.
    pub joints: Vec<String>,
    /// Shape parameters by name, with their values in SI units.
    pub shapes: Vec<(String, f64)>,
}

/// Adds one line per amendment to the `effects` block of the robot, or adds the block. No amendments, no change.
///
/// # Errors
/// Mistakes of `text`, or, with the line that was added, of what would come out of it.
pub fn amend(
    source_name: &str,
    text: &str,
    amendments: &[Amendment],
) -> Result<String, Diagnostics> {
    load(source_name, text)?;
    let ast = parse(source_name, text)?;
    let (Some(robot), false) = (ast.robots.first(), amendments.is_empty()) else {
        return Ok(text.to_owned());
    };
    let declarations: Vec<String> = amendments.iter().map(declaration).collect();
    let newline = if text.contains("\r\n") { "\r\n" } else { "\n" };
    let (at, insert) = match robot.effects.first() {
        Some(effects) => into_block(text, effects, &declarations, newline),
        None => new_block(text, robot, &declarations, newline),
    };
    let mut amended = text.to_owned();
    amended.insert_str(at, &insert);
    load(source_name, &amended)?;
    Ok(amended)
}

/// `stribeck(vs = 0.213) on elbow;`
fn declaration(amendment: &Amendment) -> String {
    let shapes: Vec<String> = amendment
        .shapes
        .iter()
        .map(|(name, value)| format!("{name} = {value}"))
        .collect();
    let shapes = if shapes.is_empty() {
        String::new()
    } else {
        format!("({})", shapes.join(", "))
    };
    let joints = amendment.joints.join(", ");
    let on = match amendment.joints.len() {
        0 => String::new(),
        1 => format!(" on {joints}"),
        _ => format!(" on ({joints})"),
    };
    format!("{}{shapes}{on};", amendment.effect)
}

/// Lines above the closing brace, or words before it where the block is one line.
fn into_block(
    text: &str,
    effects: &Effects,
    declarations: &[String],
    newline: &str,
) -> (usize, String) {
    let close = effects.close.byte_range().start.min(text.len());
    let line = line_start(text, close);
    let is_alone = text[line..close].trim().is_empty();
    if is_alone {
        let indent = effects
            .declared
            .last()
            .and_then(|last| own_line_indent(text, last));
        let indent = indent.map_or_else(|| format!("{}    ", &text[line..close]), str::to_owned);
        let lines = lines(&indent, declarations, newline);
        return (line, lines);
    }
    let space = if text[..close].ends_with([' ', '{']) {
        ""
    } else {
        " "
    };
    let lead = if text[..close].ends_with('{') {
        " "
    } else {
        space
    };
    (close, format!("{lead}{} ", declarations.join(" ")))
}

/// A block before the robot's closing brace.
fn new_block(text: &str, robot: &Robot, declarations: &[String], newline: &str) -> (usize, String) {
    let close = robot.close.byte_range().start.min(text.len());
    let line = line_start(text, close);
    let is_alone = text[line..close].trim().is_empty();
    let outer = if is_alone { &text[line..close] } else { "" };
    let lines = lines(&format!("{outer}        "), declarations, newline);
    let block = format!("{newline}{outer}    effects {{{newline}{lines}{outer}    }}{newline}");
    if is_alone {
        (line, block)
    } else {
        (close, block)
    }
}

fn lines(indent: &str, declarations: &[String], newline: &str) -> String {
    let separator = format!("{newline}{indent}");
    format!("{indent}{}{newline}", declarations.join(&separator))
}

fn line_start(text: &str, at: usize) -> usize {
    text[..at].rfind('\n').map_or(0, |newline| newline + 1)
}

/// White space in front of a declaration, if it begins its line.
fn own_line_indent<'a>(text: &'a str, declared: &DeclaredEffect) -> Option<&'a str> {
    let at = declared.name.span().byte_range().start.min(text.len());
    let before = &text[line_start(text, at)..at];
    before.trim().is_empty().then_some(before)
}

#[cfg(test)]
mod tests {
    use super::{Amendment, amend};

    const HEAD: &str = "robot R {\n  gravity = [0, 0, 0]; convention = standard_dh;\n  \
                        joint a: revolute { a = 1; alpha = 0; d = 0; }\n";

    fn stribeck() -> Amendment {
        Amendment {
            effect: "stribeck".to_owned(),
            joints: vec!["a".to_owned()],
            shapes: vec![("vs".to_owned(), 0.213)],
        }
    }

    fn amended(tail: &str) -> String {
        let text = format!("{HEAD}{tail}");
        let amended =
            amend("r.robot", &text, &[stribeck()]).unwrap_or_else(|errors| panic!("{errors}"));
        amended
            .strip_prefix(HEAD)
            .expect("the head is not touched")
            .to_owned()
    }

    #[test]
    fn a_line_joins_its_neighbors_behind_their_comments() {
        assert_eq!(
            amended("  effects {\n\t viscous_friction on all; // oil\n\t // more?\n  }\n}\n"),
            "  effects {\n\t viscous_friction on all; // oil\n\t // more?\n\t stribeck(vs = 0.213) on a;\n  }\n}\n"
        );
    }

    #[test]
    fn a_block_in_one_line_stays_in_one_line() {
        assert_eq!(
            amended("  effects { viscous_friction on all; }\n}\n"),
            "  effects { viscous_friction on all; stribeck(vs = 0.213) on a; }\n}\n"
        );
        assert_eq!(
            amended("  effects {}\n}\n"),
            "  effects { stribeck(vs = 0.213) on a; }\n}\n"
        );
    }

    #[test]
    fn a_missing_block_is_made() {
        assert_eq!(
            amended("}\n"),
            "\n    effects {\n        stribeck(vs = 0.213) on a;\n    }\n}\n"
        );
    }

    #[test]
    fn line_ends_are_kept() {
        let text = format!("{HEAD}  effects {{\n  }}\n}}\n").replace('\n', "\r\n");
        let amended =
            amend("r.robot", &text, &[stribeck()]).unwrap_or_else(|errors| panic!("{errors}"));
        assert!(amended.contains("effects {\r\n      stribeck(vs = 0.213) on a;\r\n  }"));
        assert_eq!(
            amended.matches('\n').count(),
            amended.matches("\r\n").count()
        );
    }

    #[test]
    fn a_byte_order_mark_shifts_nothing() {
        let text = format!("\u{feff}{HEAD}  effects {{\n  }}\n}}\n");
        let amended =
            amend("r.robot", &text, &[stribeck()]).unwrap_or_else(|errors| panic!("{errors}"));
        assert!(amended.contains("effects {\n      stribeck(vs = 0.213) on a;\n  }"));
    }

    #[test]
    fn nothing_to_add_changes_nothing() {
        let text = format!("{HEAD}}}");
        assert_eq!(
            amend("r.robot", &text, &[]).unwrap_or_else(|errors| panic!("{errors}")),
            text
        );
    }

    #[test]
    fn an_amendment_that_would_not_load_is_refused() {
        let twice = [Amendment {
            effect: "no_such".to_owned(),
            ..stribeck()
        }];
        let errors = amend("r.robot", &format!("{HEAD}}}"), &twice).expect_err("unknown effect");
        assert_eq!(
            errors.messages().collect::<Vec<_>>(),
            ["unknown effect `no_such`"]
        );
    }
}

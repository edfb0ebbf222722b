//! How much of a URDF is taken: what reads it next recurses into elements, and looks for every link among all others.

use quick_xml::Reader;
use quick_xml::events::Event;

use super::{ImportError, UrdfFault};

/// Bytes. Meshes are files of their own; what is left of the largest robots has a tenth of this.
const LARGEST: usize = 16 * 1024 * 1024;

/// Elements inside one another. A URDF has five levels, and extensions of simulators ten.
const DEEPEST: usize = 100;

/// Elements of all kinds.
const MOST_ELEMENTS: usize = 50_000;

/// Links. A humanoid with its hands and the frames of its sensors has two hundred.
const MOST_LINKS: usize = 1000;

/// Refuses what no robot needs.
///
/// # Errors
/// [`ImportError::Parse`], with the line.
pub(super) fn check(urdf: &str) -> Result<(), ImportError> {
    let refuse = |at: usize, what: String| {
        let lines = urdf.as_bytes()[..at].split(|byte| *byte == b'\n');
        let line = u64::try_from(lines.count()).unwrap_or(u64::MAX);
        Err(ImportError::Parse(UrdfFault::in_line(line, what)))
    };
    if urdf.len() > LARGEST {
        let what = format!(
            "the file has more than {LARGEST} bytes: leave out what is no link and no joint"
        );
        return refuse(0, what);
    }
    let mut reader = Reader::from_str(urdf);
    // Mistakes are told by what knows URDFs; here only the size counts.
    reader.config_mut().check_end_names = false;
    reader.config_mut().allow_unmatched_ends = true;
    let (mut depth, mut elements, mut links) = (0_usize, 0_usize, 0_usize);
    loop {
        let before = usize::try_from(reader.buffer_position()).unwrap_or(usize::MAX);
        let before = before.min(urdf.len());
        let (name, opens) = match reader.read_event() {
            Ok(Event::Start(element)) => (element.name().as_ref().to_owned(), true),
            Ok(Event::Empty(element)) => (element.name().as_ref().to_owned(), false),
            Ok(Event::End(_)) => {
                depth = depth.saturating_sub(1);
                continue;
            }
            // What is no markup here is none for others.
            Ok(Event::Eof) | Err(_) => return Ok(()),
            Ok(_) => continue,
        };
        elements += 1;
        links += usize::from(depth == 1 && name == b"link");
        depth += usize::from(opens);
        if depth > DEEPEST {
            return refuse(
                before,
                format!(
                    "elements are nested more than {DEEPEST} deep: close them, a URDF has five levels"
                ),
            );
        }
        if links > MOST_LINKS {
            return refuse(
                before,
                format!(
                    "the URDF has more than {MOST_LINKS} links: import the robot without its surroundings"
                ),
            );
        }
        if elements > MOST_ELEMENTS {
            return refuse(
                before,
                format!(
                    "the URDF has more than {MOST_ELEMENTS} elements: leave out what is no link and no joint"
                ),
            );
        }
    }
}

#[cfg(test)]
mod tests {
    use std::fmt::Write;

    use crate::export::ExportError;
    use crate::urdf::{ImportOptions, import, write_back};

    const ARM: &str = "robot A { gravity = [0, 0, -9.81]; convention = origin; \
        joint j1: revolute { xyz = [0, 0, 0]; axis = [0, 0, 1]; link = l1; } }";

    /// Both ways in refuse it, with these words.
    fn refused(urdf: &str, words: &str) {
        let said = import(urdf, &ImportOptions::default())
            .expect_err("refused")
            .to_string();
        assert!(said.contains(words), "{said}");
        let model = crate::load("a.robot", ARM).expect("a sound spec");
        let numbers = crate::export::Numbers::default();
        let back = write_back(urdf, &model, &numbers).expect_err("refused");
        assert!(matches!(back, ExportError::Parse(fault) if fault.to_string().contains(words)));
    }

    /// Links one behind the other.
    fn chain(links: usize) -> String {
        let mut urdf = String::from("<robot name=\"a\">\n<link name=\"l0\"/>\n");
        for k in 1..links {
            writeln!(
                urdf,
                "<link name=\"l{k}\"/><joint name=\"j{k}\" type=\"fixed\"><parent link=\"l{}\"/><child link=\"l{k}\"/></joint>",
                k - 1
            )
            .expect("a string takes all");
        }
        urdf + "</robot>\n"
    }

    #[test]
    fn a_hundred_thousand_links_are_refused() {
        refused(
            &chain(100_000),
            "line 1002: the URDF has more than 1000 links",
        );
    }

    #[test]
    fn a_million_elements_inside_one_another_are_refused() {
        let deep = format!("<robot name=\"a\">\n{}", "<a b=\"/>\">\n".repeat(1_000_000));
        refused(&deep, "line 101: elements are nested more than 100 deep");
        let closed = format!(
            "<robot name=\"a\">{}{}</robot>",
            "<a>".repeat(1_000_000),
            "</a>".repeat(1_000_000)
        );
        refused(&closed, "elements are nested more than 100 deep");
    }

    #[test]
    fn more_than_a_robot_needs_is_refused() {
        let many = format!("<robot name=\"a\">\n{}</robot>", "<a/>\n".repeat(60_000));
        refused(&many, "line 50001: the URDF has more than 50000 elements");
        let long = format!("<robot name=\"a\"><!--{}--></robot>", "-".repeat(17 << 20));
        refused(&long, "line 1: the file has more than 16777216 bytes");
    }

    #[test]
    fn dashes_in_comments_are_told() {
        refused(
            "<robot name=\"a\">\n<!-- --- links --- -->\n<link name=\"l\"/></robot>",
            "line 2: a comment has `--` in it",
        );
    }

    #[test]
    fn a_thousand_links_are_read() {
        let urdf = chain(1000).replacen("\"fixed\"", "\"continuous\"", 1);
        let imported = import(&urdf, &ImportOptions::default()).expect("a sound URDF");
        assert!(imported.spec.contains("joint j1"), "{}", imported.spec);
    }
}

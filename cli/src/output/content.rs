//! What results are, and whether a file holds such a one: a name that was meant for another file costs a log that nobody can measure again.

use std::fs::File;
use std::io::Read;
use std::path::Path;

use super::record::Record;
use super::table::{MOTION, PREDICTION, SIMULATION};
use crate::misplaced::{is_markup, is_spec};

/// Bytes that tell what a file holds: a spec may have a license and effects above its robot.
const START: u64 = 1 << 16;

/// What bags begin with, and what those of this program say of who wrote them, a few bytes behind it.
const BAG: (&[u8], &[u8]) = (b"\x89MCAP", b"robot-model/");

/// What robots in XML say of who wrote them: another one may be a maker's, with shapes that are nowhere else.
pub(crate) const MARK: &str = "<!-- written by robot-model -->";

/// Kinds of results.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Content {
    /// Numbers by name.
    Json(Record),
    /// A drawing, SVG.
    Figure,
    /// A report, HTML.
    Page,
    /// A motion of `excite`.
    Motion,
    /// Torques that `trace` predicts.
    Prediction,
    /// A log of `simulate`.
    Simulation,
    /// A robot in the language.
    Spec,
    /// A robot of `export` in the XML of ROS.
    Urdf,
    /// A robot of `export` in that of `MuJoCo`.
    Mjcf,
}

impl Content {
    const fn name(self) -> &'static str {
        match self {
            Self::Json(record) => record.name(),
            Self::Figure => "SVG figure",
            Self::Page => "page",
            Self::Motion => "motion of `excite`",
            Self::Prediction => "prediction of `trace`",
            Self::Simulation => "log of `simulate`",
            Self::Spec => "spec",
            Self::Urdf => "URDF of `export`",
            Self::Mjcf => "MJCF model of `export`",
        }
    }

    /// What is said of a file that is there and holds something else; an empty one holds nothing.
    pub(super) fn unlike(self, path: &Path) -> Option<String> {
        // Names of a JSON object may stand in any order.
        let most = if matches!(self, Self::Json(_)) {
            u64::MAX
        } else {
            START
        };
        let mut start = Vec::new();
        // What cannot be read is told where it is written.
        File::open(path)
            .and_then(|file| file.take(most).read_to_end(&mut start))
            .ok()?;
        let is_other = !start.trim_ascii().is_empty() && !self.begins(&start);
        is_other.then(|| format!("the existing file is not a {}", self.name()))
    }

    /// Whether a file that begins so, or is so where it is JSON, is of this kind.
    pub(super) fn begins(self, start: &[u8]) -> bool {
        let text = String::from_utf8_lossy(start);
        let text = text.trim_start_matches('\u{feff}').trim_start();
        match self {
            Self::Json(record) => record.is(text.as_bytes()),
            Self::Figure => is_markup(text) && text.contains("<svg"),
            Self::Page => text.to_ascii_lowercase().starts_with("<!doctype html"),
            Self::Motion => MOTION.begins(text),
            Self::Prediction => PREDICTION.begins(text),
            Self::Simulation => SIMULATION.begins(text) || is_own_bag(start),
            Self::Spec => is_spec(text),
            Self::Urdf => is_markup(text) && text.contains(MARK) && text.contains("<robot"),
            Self::Mjcf => is_markup(text) && text.contains(MARK) && text.contains("<mujoco"),
        }
    }
}

fn is_own_bag(start: &[u8]) -> bool {
    let (bag, writer) = BAG;
    let about = &start[..start.len().min(128)];
    about.starts_with(bag) && about.windows(writer.len()).any(|part| part == writer)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn kinds_of_files_are_told_by_their_first_bytes() {
        let all = [
            (
                Content::Json(Record::Identify),
                b"\n{\"method\": 1, \"form\": 1, \"parameters\": 1, \"condition\": 1, \"unexcited\": 1}"
                    .as_slice(),
            ),
            (Content::Figure, b"<svg width=\"640\" xmlns=\"..\">"),
            (Content::Page, b"<!DOCTYPE html>\n<html lang=\"en\">"),
            (
                Content::Motion,
                b"time,q1,dq1,ddq1\n0,0.000000000000e0,1.500000000000e-1,0.000000000000e0\n",
            ),
            (
                Content::Prediction,
                b"time,tau1\n0.000000000,1.50000000e0\n",
            ),
            (
                Content::Simulation,
                b"time,q1,dq1,tau1\n0,0,0,0\n0.01,0.8414709848078965,1,2\n",
            ),
            (
                Content::Spec,
                b"// a, b, c\nrobot A { gravity = [0, 0, -9.81]; }",
            ),
            (
                Content::Urdf,
                b"<?xml version=\"1.0\"?>\n<!-- written by robot-model -->\n<robot name=\"a\"/>",
            ),
            (
                Content::Mjcf,
                b"<!-- written by robot-model -->\n<mujoco model=\"a\"></mujoco>",
            ),
        ];
        for (content, _) in all {
            for (other, start) in all {
                let is_like = content.begins(start);
                assert_eq!(is_like, content == other, "{content:?} of {other:?}");
            }
        }
        for of_a_maker in ["<robot name=\"a\"><mesh/></robot>", "<mujoco/>"] {
            let is = |content: Content| content.begins(of_a_maker.as_bytes());
            assert!(!is(Content::Urdf) && !is(Content::Mjcf), "{of_a_maker}");
        }
        let bag = |writer: &str| {
            let begin = b"\x89MCAP0\r\n\x01\x1f\0\0\0\0\0\0\0\x04\0\0\0ros2\x13\0\0\0";
            Content::Simulation.begins(&[begin, writer.as_bytes()].concat())
        };
        assert!(bag("robot-model/0.1.0"));
        assert!(!bag("libmcap 1.4.0"));
    }
}

//! Every line of this crate that says a mistake has a golden: a spec of `tests/specs/fail`, or a file of
//! log settings in `tests/specs/settings/fail`, that makes it speak.
//!
//! A [`Diagnostic`](super::Diagnostic) has no other constructors than the speakers, and `syn` errors that are made past
//! [`syn_error`](super::syn_error) fail the test. The words of `syn` itself ("expected `=`") come from no line of ours;
//! `remedy` adds their help.

use std::fs;
use std::path::Path;

use robot_model_goldens::{Silent, Source, Speakers, assert_complete, spoken};

const SPEAKERS: Speakers = Speakers {
    calls: &[
        ("", "check_unique"),
        (".", "fault"),
        ("Diagnostic", "in_text"),
        ("Diagnostic", "new"),
        ("Fault", "new"),
        ("", "shape_of"),
        ("", "syn_error"),
        ("", "unused"),
    ],
    inside: &["at"],
    types: &["Fault"],
    // It hands on what others say.
    homes: &["diagnostic.rs"],
};

const SILENT: [Silent; 2] = [
    Silent {
        file: "log_settings.rs",
        words: "too large",
        reason: "a golden of 64 kB; `tests/all/log_settings.rs` makes it speak",
    },
    Silent {
        file: "parse/expr.rs",
        words: "this is not a number",
        reason: "a literal's digits are those of a number; the line stands in for a panic",
    },
];

#[test]
fn every_line_that_says_a_mistake_has_a_golden() {
    let crate_folder = Path::new(env!("CARGO_MANIFEST_DIR"));
    let source = Source::read(&crate_folder.join("src"), "", &SPEAKERS);
    let goldens = fs::read_dir(crate_folder.join("../tests/specs/fail")).expect("the goldens");
    let shown_of = |text: &str| -> Vec<String> {
        let mistakes = crate::load("a golden", text)
            .err()
            .unwrap_or_else(|| panic!("the folder is its fate: {text}"));
        mistakes.messages().map(str::to_owned).collect()
    };
    let spec = include_str!("../../../tests/specs/settings/gantry.robot");
    let model = crate::load("gantry.robot", spec).expect("a sound spec");
    let settings = fs::read_dir(crate_folder.join("../tests/specs/settings/fail"));
    let of_settings = settings.expect("the goldens").flat_map(|entry| {
        let path = entry.expect("a readable folder").path();
        let text = fs::read_to_string(&path).expect("a readable file");
        let shown = || -> Vec<String> {
            let mistakes = crate::log_settings(&model, "a golden", &text);
            let mistakes = mistakes.expect_err("the folder is its fate");
            mistakes.messages().map(str::to_owned).collect()
        };
        spoken(shown)
    });
    let spoken = goldens
        .filter(|entry| entry.as_ref().is_ok_and(|entry| entry.path().is_file()))
        .flat_map(|entry| {
            let path = entry.expect("a readable folder").path();
            let text = fs::read_to_string(&path).expect("a readable spec");
            spoken(|| shown_of(&text))
        })
        .chain(of_settings)
        .collect();
    assert_complete(&source, &SPEAKERS, &spoken, &SILENT);
}

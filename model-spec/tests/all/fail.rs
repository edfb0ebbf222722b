//! Specs with one mistake each, named by the mistake: the exact words that an author reads.
use std::fs;
use std::path::Path;

use robot_model_spec::Diagnostics;

/// Mistakes as an author reads them, each with its place and its remedy, against their golden.
fn assert_told(snapshot: &str, path: &Path, load: impl Fn(&str, &str) -> Diagnostics) {
    let name = path.file_name().unwrap().to_string_lossy();
    let errors = load(&name, &fs::read_to_string(path).unwrap());
    let rendered = errors.render(false);
    assert!(rendered.contains(&format!("--> {name}:")), "{rendered}");
    assert_eq!(
        rendered.matches("= help: ").count(),
        errors.len(),
        "{rendered}"
    );
    insta::with_settings!({ prepend_module_to_snapshot => false, omit_expression => true }, {
        insta::assert_snapshot!(snapshot, rendered);
    });
}

#[test]
fn every_mistake_is_told_with_its_place_and_its_remedy() {
    insta::glob!("../../../tests/specs/fail", "*.robot", |path| {
        assert_told("refused", path, |name, text| {
            robot_model_spec::load(name, text).expect_err("has a mistake")
        });
    });
}

#[test]
fn every_mistake_of_log_settings_is_told_with_its_place_and_its_remedy() {
    let spec = include_str!("../../../tests/specs/settings/gantry.robot");
    let model = robot_model_spec::load("gantry.robot", spec).unwrap_or_else(|e| panic!("{e}"));
    insta::glob!("../../../tests/specs/settings/fail", "*.toml", |path| {
        assert_told("settings_refused", path, |name, text| {
            robot_model_spec::log_settings(&model, name, text).expect_err("has a mistake")
        });
    });
}

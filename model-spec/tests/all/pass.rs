//! Specs that load, and what becomes of them.
use std::fs;

/// Every file of `tests/specs/pass`, with its name.
fn specs() -> Vec<(String, String)> {
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/../tests/specs/pass");
    let mut specs: Vec<(String, String)> = fs::read_dir(folder)
        .unwrap()
        .map(|entry| entry.unwrap().path())
        .filter(|path| {
            path.extension()
                .is_some_and(|extension| extension == "robot")
        })
        .map(|path| {
            (
                path.file_name().unwrap().to_string_lossy().into_owned(),
                fs::read_to_string(&path).unwrap(),
            )
        })
        .collect();
    specs.sort();
    specs
}

#[test]
fn every_spec_of_the_folder_loads() {
    let specs = specs();
    assert!(specs.len() >= 5);
    for (name, text) in specs {
        let model =
            robot_model_spec::load(&name, &text).unwrap_or_else(|errors| panic!("{errors}"));
        assert!(!model.joints.is_empty());
        assert_eq!(model.source, name);
    }
}

//! The examples of the language's reference are specs that load.

use robot_model_spec::{load, standard_effects};

const REFERENCE: &str = include_str!("../../LANGUAGE.md");
const README: &str = include_str!("../../../README.md");

/// Blocks of a page between "```text" and "```" that are specs, each with the line it begins on.
fn specs(page: &str) -> Vec<(usize, String)> {
    let mut found = Vec::new();
    let mut lines = page.lines().enumerate();
    while let Some((number, line)) = lines.next() {
        if line != "```text" {
            continue;
        }
        let block = lines
            .by_ref()
            .map(|(_, line)| line)
            .take_while(|line| *line != "```");
        let text = block.collect::<Vec<_>>().join("\n");
        if text.starts_with("robot") || text.starts_with("effect") {
            found.push((number + 2, text));
        }
    }
    found
}

#[test]
fn every_example_loads() {
    for (page, name, count) in [(REFERENCE, "LANGUAGE.md", 8), (README, "README.md", 2)] {
        let specs = specs(page);
        assert_eq!(specs.len(), count, "{name}");
        for (line, text) in specs {
            load(name, &text).unwrap_or_else(|errors| panic!("block at line {line}: {errors}"));
        }
    }
}

#[test]
fn the_first_example_means_what_its_comments_say() {
    let (_, text) = &specs(REFERENCE)[0];
    let model = load("crane.robot", text).unwrap_or_else(|errors| panic!("{errors}"));
    let (swing, column) = (&model.joints[0], &model.chain().unwrap().links[0]);
    assert_eq!(
        (swing.name.as_str(), column.name.as_str()),
        ("swing", "column")
    );
    assert!((swing.actuator_gain - 12.5).abs() < 1e-12);
    assert!((column.placement.offset - 10_f64.to_radians()).abs() < 1e-12);
    assert_eq!(model.joints[1].limits.torque, Some(2000.0));
    let names: Vec<String> = model
        .standard_parameters()
        .into_iter()
        .map(|parameter| parameter.name)
        .collect();
    for name in [
        "column.ixx",
        "swing.stribeck.fs",
        "boom.coulomb_friction.fc",
    ] {
        assert!(names.iter().any(|known| known == name), "{name}: {names:?}");
    }
}

#[test]
fn the_reference_names_the_standard_effects_that_it_uses() {
    for name in [
        "viscous_friction",
        "gear_coupling",
        "stribeck",
        "motor_inertia",
    ] {
        assert!(REFERENCE.contains(name), "{name}");
        assert!(
            standard_effects().iter().any(|effect| effect.name == name),
            "{name}"
        );
    }
}

//! Franka Emika Panda, rigid body: 43 base parameters, 77 coefficients, limits of the data sheet.

use crate::excite::{design, limited, number, rigid, spec};

const ACCELERATIONS: [&str; 7] = ["15", "7.5", "10", "12.5", "15", "20", "20"];

/// What sequential quadratic programming with finite differences reaches in a minute of computing time, in the same columns or in
/// columns of unit length.
const REACHED: [f64; 2] = [14.0, 7.6];

fn arguments<'a>(more: &[&'a str]) -> Vec<&'a str> {
    let plain = [
        "panda.robot",
        "--ends",
        "free",
        "--noise",
        "1",
        "--starts",
        "1",
    ];
    [&plain, more].concat()
}

#[test]
fn one_start_is_better_than_finite_differences_are() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let arm = limited(&rigid(&spec("pass/panda")), "acceleration", &ACCELERATIONS);
    std::fs::write(folder.path().join("panda.robot"), arm).expect("a file");
    let raw = design(folder.path(), &arguments(&["--criterion", "condition"]));
    let [condition, unit] = REACHED;
    assert_eq!(
        (&raw["columns"], &raw["variables"]),
        (&43.into(), &77.into())
    );
    assert!(number(&raw, "max_violation") <= 0.0, "{raw}");
    assert!(number(&raw, "condition") < 0.75 * condition, "{raw}");
    assert!(
        number(&raw, "condition_of_unit_columns") < 0.8 * unit,
        "{raw}"
    );

    let wanted = ["--criterion", "condition", "--unit-columns"];
    let scaled = design(folder.path(), &arguments(&wanted));
    assert!(number(&scaled, "max_violation") <= 0.0, "{scaled}");
    assert!(
        number(&scaled, "condition_of_unit_columns") < 0.5 * unit,
        "{scaled}"
    );

    // The bound that sees lengths alone: longer columns, more alike.
    let by_volume = design(folder.path(), &arguments(&[]));
    let by_length = design(folder.path(), &arguments(&["--criterion", "hadamard"]));
    assert!(number(&by_length, "hadamard") > number(&by_volume, "hadamard"));
    assert!(number(&by_length, "log_det") < number(&by_volume, "log_det"));
    let unit = |report| number(report, "condition_of_unit_columns");
    assert!(
        unit(&by_length) > 1.3 * unit(&by_volume),
        "{by_length} {by_volume}"
    );
}

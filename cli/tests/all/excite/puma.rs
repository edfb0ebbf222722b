//! PUMA 560 with friction: 66 coefficients.

use crate::excite::{design, limited, number, spec};

#[test]
fn friction_is_excited_with_the_rigid_body() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let arm = spec("pass/puma560").replace(" velocity = 8.2;  torque = 97.6;", "");
    // Armstrong, Khatib and Burdick 1986, and the manufacturer's speeds.
    let arm = limited(
        &arm,
        "velocity",
        &["1.4", "0.9", "2.1", "3.9", "3.1", "4.0"],
    );
    let arm = limited(
        &arm,
        "torque",
        &["97.6", "186.4", "89.4", "24.2", "20.1", "21.3"],
    );
    let arm = limited(&arm, "acceleration", &["8", "6", "12", "25", "25", "25"]);
    std::fs::write(folder.path().join("puma.robot"), arm).expect("a file");
    let plain = ["puma.robot", "--ends", "free", "--starts", "1"];
    let report = design(folder.path(), &plain);
    assert_eq!(report["variables"], 66, "{report}");
    assert!(number(&report, "max_violation") <= 0.0, "{report}");
    assert!(
        number(&report, "condition_of_unit_columns") < 20.0,
        "{report}"
    );
}

//! Joints that bend: links follow the load, which is known as noisily as torques are logged.

use crate::verbs::common::{Folder, json, numbers, two_joints_waving};
use crate::verbs::payload::spec;

/// A log without noise tells of a stiff arm far above the band of its motion. An arm that bends stays in the band in which `trace` would judge
/// it, so that an amended spec is not fitted worse than the one that it was made of.
#[test]
fn an_arm_that_bends_is_fitted_in_the_band_of_the_rate_alone() {
    let folder = Folder::new();
    folder.write("stiff.robot", &spec(""));
    folder.write(
        "bends.robot",
        &spec("joint_elasticity(stiffness = 300) on lo;"),
    );
    folder.write(
        "values.json",
        r#"{"up.viscous_friction.fv": 1.0, "lo.viscous_friction.fv": 0.5, "up.coulomb_friction.fc": 0, "lo.coulomb_friction.fc": 0}"#,
    );
    folder.write(
        "wanted.csv",
        &two_joints_waving(5000, 0.25, &[1.9, 4.4, 6.9, 10.1]),
    );
    let simulate = ["simulate", "stiff.robot", "--parameters", "values.json"];
    let motion = ["--trajectory", "wanted.csv", "--rate", "500"];
    folder.succeed(&[&simulate[..], &motion, &["--out", "log.csv"]].concat());
    let [stiff, bends] = ["stiff.robot", "bends.robot"].map(|spec| {
        folder.succeed(&["identify", spec, "log.csv", "--json", "fit.json"]);
        numbers(&json(&folder.read("fit.json"))["bands_hz"])
    });
    assert!(stiff[0] >= 20.0, "{stiff:?}");
    assert_eq!(bends, [10.0, 30.0, 90.0]);
}

//! `import` of every URDF of the shared material against Pinocchio's torques for the same file.

use robot_model_spec::urdf::{Inertials, import};
use robot_model_tests::{shared, urdfs};

/// Largest difference allowed, relative to the largest torque of the state.
///
/// Both sides are double precision, which leaves 1e-11 room for other orders of summation. Quarter turns that a URDF writes
/// short are exact here and not there. Where bodies turn with them they have eight decimals (1.57079633, off by 3.2e-9), so
/// 1e-8 is allowed; the 1.5708 of `tiago` places a frame without mass.
fn tolerance(urdf: &str) -> f64 {
    let short = |text: &str| {
        text.split(['"', '\'', ' ']).any(|word| {
            word.parse::<f64>().is_ok_and(|x| {
                let turns = x / std::f64::consts::FRAC_PI_2;
                let off = (turns - turns.round()).abs();
                turns.round() != 0.0 && off > 1e-15 && off < 1e-4
            })
        })
    };
    if short(urdf) { 1e-8 } else { 1e-11 }
}

#[test]
fn imported_robots_have_pinocchios_torques() {
    let mut compared = 0;
    for reference in urdfs::all() {
        let Some(urdf) = reference.text("its import") else {
            continue;
        };
        for inertials in [Inertials::Fixed, Inertials::Nominal] {
            let spec = import(&urdf, &reference.options(inertials))
                .unwrap_or_else(|error| panic!("{}: {error}", reference.urdf))
                .spec;
            let model = robot_model_spec::load("imported.robot", &spec)
                .unwrap_or_else(|errors| panic!("{errors}"));
            assert_eq!(
                model.joints.len(),
                reference.joints.len(),
                "{}",
                reference.urdf
            );
            reference.assert_torques(&model, tolerance(&urdf));
        }
        compared += 1;
    }
    let wanted = if shared::is_present() { 24 } else { 0 };
    assert_eq!(compared, wanted, "URDFs compared");
}

//! PUMA 560, UR10 and Panda against Pinocchio's numbers, 20 states each.

use nalgebra::DMatrix;
use robot_model_codegen::{Compiled, compile_model};
use robot_model_spec::Model;
use robot_model_spec::parameter::{Owner, Status};
use robot_model_tests::evaluate::{Interpreter, relative_difference};
use robot_model_tests::oracle::{Frames, Oracle};
use robot_model_tests::specs;

/// Largest difference allowed, relative to the largest entry of the same quantity.
///
/// Both sides are double precision with some hundred roundings an entry, and Pinocchio's own forms agree to 3e-14; a sign
/// or a dropped term shows in the first digits. What is left between is room for other orders of summation.
const TOLERANCE: f64 = 1e-11;

const ROBOTS: [&str; 3] = ["puma560", "ur10", "panda"];

fn for_each_present(law: impl Fn(&Oracle)) {
    for robot in ROBOTS {
        if let Some(oracle) = Oracle::read(robot) {
            law(&oracle);
        }
    }
}

fn from_placements(oracle: &Oracle, digits: usize) -> Model {
    let text = oracle.spec(digits);
    robot_model_spec::load("oracle.robot", &text).unwrap_or_else(|errors| panic!("{errors}"))
}

/// Every form of the rigid body against the reference. Parameters of declared effects are zero, which leaves no effect torque.
fn assert_agrees(oracle: &Oracle, compiled: Compiled, frames: Frames) {
    let interpreter = Interpreter::new(compiled);
    let mut standard = oracle.standard(frames);
    let inertial = standard.len();
    standard.resize(interpreter.compiled.standard.len(), 0.0);
    for (number, reference) in oracle.references(frames).enumerate() {
        let forms = interpreter.forms(&standard, &reference.state);
        let dq = DMatrix::from_column_slice(reference.state.dq.len(), 1, &reference.state.dq);
        let regressor = forms.regressor.columns(0, inertial).into_owned();
        let quantities = [
            ("M", &forms.mass_matrix, &reference.mass_matrix),
            (
                "C dq",
                &(&forms.coriolis_matrix * dq),
                &reference.velocity_torque,
            ),
            ("G", &forms.gravity, &reference.gravity),
            ("tau", &forms.inverse_dynamics, &reference.torque),
            ("Y", &regressor, &reference.regressor),
        ];
        for (what, found, wanted) in quantities {
            let difference = relative_difference(found, wanted);
            assert!(
                difference < TOLERANCE,
                "{} {what}, state {number}: {difference:.1e}\nfound {found}wanted {wanted}",
                oracle.robot
            );
        }
    }
}

#[test]
fn arms_from_the_oracles_own_placements_agree() {
    for_each_present(|oracle| {
        assert_agrees(
            oracle,
            compile_model(&from_placements(oracle, 17)),
            Frames::Joint,
        );
    });
}

/// UR10's URDF writes pi/2 as 1.570796325, which is 1.8e-9 short: without snapping, entries of that size would be in every matrix.
#[test]
fn quarter_turns_rounded_as_in_urdf_files_are_meant_exactly() {
    for_each_present(|oracle| {
        // Their numbers as written differ.
        let placements = |digits| -> Vec<_> {
            let model = from_placements(oracle, digits);
            let chain = model.chain().expect("the oracle's arms are chains");
            let links = chain.links.iter();
            links.map(|link| link.placement.clone()).collect()
        };
        assert_eq!(placements(9), placements(17));
    });
}

#[test]
fn the_specs_of_this_repository_agree() {
    for_each_present(|oracle| {
        let frames = if oracle.robot == "puma560" {
            Frames::StandardDh
        } else {
            Frames::Joint
        };
        let spec = specs::named(&format!("pass/{}", oracle.robot));
        assert_agrees(oracle, spec.compiled(), frames);
    });
}

/// The nominal inertials of the specs, written as mass, center of mass and inertia about it, against the oracle's ten about the origin.
#[test]
fn nominal_inertials_are_the_oracles() {
    for_each_present(|oracle| {
        let frames = if oracle.robot == "puma560" {
            Frames::StandardDh
        } else {
            Frames::Joint
        };
        let model = specs::named(&format!("pass/{}", oracle.robot)).model();
        let wanted = oracle.standard(frames);
        let scale = wanted.iter().fold(0.0_f64, |most, x| most.max(x.abs()));
        for (parameter, wanted) in model.standard_parameters().iter().zip(wanted) {
            let Status::Nominal(value) = parameter.status else {
                panic!("{} is nominal in the spec", parameter.name);
            };
            // Panda's last link has its hand and fingers merged into it and is written with 12 digits.
            assert!(
                (value - wanted).abs() < 1e-11 * scale,
                "{} {}: {value} and {wanted}",
                oracle.robot,
                parameter.name
            );
        }
    });
}

#[test]
fn base_parameters_are_as_many_as_the_oracle_counts() {
    for_each_present(|oracle| {
        let spec = specs::named(&format!("pass/{}", oracle.robot)).compiled();
        for compiled in [compile_model(&from_placements(oracle, 17)), spec] {
            let rigid = compiled
                .base
                .kept
                .iter()
                .filter(|&&k| matches!(compiled.standard[k].owner, Owner::Link { .. }));
            assert_eq!(
                rigid.count(),
                oracle.base_parameter_count,
                "{}",
                oracle.robot
            );
        }
    });
}

//! `import` of every URDF of the shared material against Pinocchio's torques for the same file.

use std::fs;
use std::path::Path;

use robot_model_codegen::compile_model;
use robot_model_spec::parameter::Status;
use robot_model_spec::urdf::{ImportOptions, Inertials, import};
use robot_model_tests::evaluate::Interpreter;
use robot_model_tests::shared;
use robot_model_tests::states::State;
use serde::Deserialize;

/// What `tests/oracle/make.py` wrote.
#[derive(Debug, Deserialize)]
struct Case {
    urdf: String,
    joints: Vec<String>,
    states: Vec<Reference>,
}

#[derive(Debug, Deserialize)]
struct Reference {
    q: Vec<f64>,
    dq: Vec<f64>,
    ddq: Vec<f64>,
    tau: Vec<f64>,
}

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
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("oracle/urdf.json");
    let text = fs::read_to_string(path).expect("the oracle is in the repository");
    let cases: Vec<Case> = serde_json::from_str(&text).expect("the oracle is in its format");
    assert_eq!(cases.len(), 24);
    let mut compared = 0;
    for case in cases {
        let Some(path) = shared::find(&case.urdf, "its import") else {
            continue;
        };
        let urdf = fs::read_to_string(path).expect("a readable URDF");
        for inertials in [Inertials::Fixed, Inertials::Nominal] {
            let options = ImportOptions {
                inertials,
                tip: case.urdf.contains("tiago").then(|| "arm_7_link".to_owned()),
                ..ImportOptions::default()
            };
            let spec = import(&urdf, &options)
                .unwrap_or_else(|error| panic!("{}: {error}", case.urdf))
                .spec;
            let model = robot_model_spec::load("imported.robot", &spec)
                .unwrap_or_else(|errors| panic!("{errors}"));
            assert_eq!(model.joints.len(), case.joints.len(), "{}", case.urdf);
            let standard: Vec<f64> = model
                .standard_parameters()
                .iter()
                .map(|parameter| match parameter.status {
                    Status::Nominal(value) | Status::Fixed(value) => value,
                    Status::Unknown => 0.0,
                })
                .collect();
            let interpreter = Interpreter::new(compile_model(&model));
            for (number, reference) in case.states.iter().enumerate() {
                let state = State {
                    q: reference.q.clone(),
                    dq: reference.dq.clone(),
                    ddq: reference.ddq.clone(),
                    ..State::default()
                };
                let torque = interpreter.forms(&standard, &state).inverse_dynamics;
                let scale = reference
                    .tau
                    .iter()
                    .fold(1.0_f64, |most, t| most.max(t.abs()));
                for (joint, (found, wanted)) in torque.iter().zip(&reference.tau).enumerate() {
                    let difference = (found - wanted).abs() / scale;
                    assert!(
                        difference < tolerance(&urdf),
                        "{}, state {number}, joint {}: {found} is not {wanted} ({difference:.1e})",
                        case.urdf,
                        case.joints[joint]
                    );
                }
            }
        }
        compared += 1;
    }
    let wanted = if shared::is_present() { 24 } else { 0 };
    assert_eq!(compared, wanted, "URDFs compared");
}

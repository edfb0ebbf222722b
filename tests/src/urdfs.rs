//! URDFs of the shared material with Pinocchio's torques, which `tests/oracle/make.py` wrote.

use std::fs;
use std::path::Path;

use robot_model_codegen::compile_model;
use robot_model_spec::Model;
use robot_model_spec::parameter::Status;
use robot_model_spec::urdf::{ImportOptions, Inertials};
use serde::Deserialize;

use crate::evaluate::Interpreter;
use crate::shared;
use crate::states::State;

/// A URDF and the torques of its arm.
#[derive(Debug, Deserialize)]
pub struct Reference {
    /// Its path in the shared material.
    pub urdf: String,
    /// Names of the joints.
    pub joints: Vec<String>,
    states: Vec<Torques>,
}

#[derive(Debug, Deserialize)]
struct Torques {
    q: Vec<f64>,
    dq: Vec<f64>,
    ddq: Vec<f64>,
    tau: Vec<f64>,
}

/// All of them.
///
/// # Panics
/// Where the file is not as it was written.
#[must_use]
pub fn all() -> Vec<Reference> {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("oracle/urdf.json");
    let text = fs::read_to_string(path).expect("the oracle is in the repository");
    let all: Vec<Reference> = serde_json::from_str(&text).expect("the oracle is in its format");
    assert_eq!(all.len(), 24);
    all
}

/// The standard parameters that a spec gives, 0 for others.
#[must_use]
pub fn given(model: &Model) -> Vec<f64> {
    let value = |status| match status {
        Status::Nominal(value) | Status::Fixed(value) => value,
        Status::Unknown => 0.0,
    };
    let parameters = model.standard_parameters();
    parameters.iter().map(|one| value(one.status)).collect()
}

impl Reference {
    /// The URDF; none where there is no shared material, which is said.
    ///
    /// # Panics
    /// Where the file cannot be read.
    #[must_use]
    pub fn text(&self, what: &str) -> Option<String> {
        let path = shared::find(&self.urdf, what)?;
        Some(fs::read_to_string(path).expect("a readable URDF"))
    }

    /// Up to which link it is a chain, and what is done with its inertials.
    #[must_use]
    pub fn options(&self, inertials: Inertials) -> ImportOptions {
        ImportOptions {
            inertials,
            // The only one with fingers.
            tip: self.urdf.contains("tiago").then(|| "arm_7_link".to_owned()),
            ..ImportOptions::default()
        }
    }

    /// Fails where an arm with the values of its spec has other torques, by this share of the largest of a state.
    ///
    /// # Panics
    /// Where it has.
    #[track_caller]
    pub fn assert_torques(&self, model: &Model, tolerance: f64) {
        let values = given(model);
        let interpreter = Interpreter::new(compile_model(model));
        for (number, reference) in self.states.iter().enumerate() {
            let state = State {
                q: reference.q.clone(),
                dq: reference.dq.clone(),
                ddq: reference.ddq.clone(),
                ..State::default()
            };
            let torque = interpreter.forms(&values, &state).inverse_dynamics;
            let largest = reference.tau.iter().map(|tau| tau.abs());
            let scale = largest.fold(1.0, f64::max);
            let pairs = torque.iter().zip(&reference.tau).zip(&self.joints);
            for ((found, wanted), joint) in pairs {
                let difference = (found - wanted).abs() / scale;
                assert!(
                    difference < tolerance,
                    "{}, state {number}, joint {joint}: {found} is not {wanted} ({difference:.1e})",
                    self.urdf
                );
            }
        }
    }
}
